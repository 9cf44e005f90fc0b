// SPDX-License-Identifier: Apache-2.0
// A plane through a body and the edges of a blade that lie in it: what attacks are made of.
#pragma once

#include <vector>

#include "soak/attack_strokes.h"
#include "soak/sheet_pieces.h"

namespace incise::test {

using Edge = std::vector<Vec3>;
using Edges = std::vector<Edge>;

/// A piece thinner than this many edges may be lost without blame.
inline constexpr double kThin = 0.6;

/// A part of a line.
struct Span {
  double from, to;

  [[nodiscard]] double at(double share) const { return from + share * (to - from); }
  [[nodiscard]] double length() const { return to - from; }
};

/// Directions at right angles, of length 1.
struct Frame {
  Vec3 n, a, b;
};

[[nodiscard]] Frame random_frame(Random& random);

/// A point inside the body: the middle of any tet.
[[nodiscard]] Vec3 inner_point(const TetSoup& soup, Random& random);

/// A plane through a point inside the body: a straight edge along `a`, moved along `b`.
class Sheet {
 public:
  Sheet(const AttackedBody& body, const Frame& frame, Random& random)
      : Sheet(body, frame, inner_point(body.soup, random)) {}
  Sheet(const AttackedBody& body, const Frame& frame, const Vec3& through);

  /// The edge at `s` along the way, `lift` above the plane.
  [[nodiscard]] Edge at(double s, const Span& w, double lift = 0) const;
  [[nodiscard]] Edges sweep(const Span& s, unsigned steps, const Span& w, double lift = 0) const;
  [[nodiscard]] Edges whole(unsigned steps) const { return sweep(way, steps, width); }
  [[nodiscard]] SheetPlane plane() const { return {q, n}; }
  /// A point of a circle in the plane of two directions.
  [[nodiscard]] static Vec3 turned(const Vec3& x, const Vec3& y, double turns);

  Vec3 n, a, b, q;
  Span way{}, width{};  ///< along b, along a; both leave the body
};

}  // namespace incise::test
