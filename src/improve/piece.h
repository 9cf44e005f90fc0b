// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "incise/geom/box.h"
#include "incise/geom/closest.h"
#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// A triangle of a surface, by its corners.
using Facet = std::array<Vec3, 3>;

/// A piece of surface that an operation replaces: its facets, and where it may be furthest from the other piece. Both
/// pieces have one rim, so that points inside are enough.
struct Piece {
  std::vector<Facet> facets;
  std::vector<Vec3> samples;

  void clear() {
    facets.clear();
    samples.clear();
  }
};

/// Adds a facet, sampled at its centroid and along the edge from its first corner: the rim of a piece does not move.
inline void add_facet(Piece& piece, const Facet& f) {
  piece.facets.push_back(f);
  piece.samples.push_back((f[0] + f[1] + f[2]) / 3.0);
  piece.samples.push_back(0.5 * (f[0] + f[1]));
}

/// Twice the vector area.
inline Vec3 vector_area2(const Facet& f) {
  return (f[1] - f[0]).cross(f[2] - f[0]);
}

/// Squared; infinite from a piece without facets.
inline double distance2_to(const Piece& piece, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Facet& f : piece.facets) least = std::min(least, closest_on_triangle(p, f[0], f[1], f[2]).distance2);
  return least;
}

inline Box box_of(const Facet& f) {
  return {f[0].cwiseMin(f[1]).cwiseMin(f[2]), f[0].cwiseMax(f[1]).cwiseMax(f[2])};
}

}  // namespace v0
}  // namespace incise
