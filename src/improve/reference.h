// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "incise/geom/triangle_tree.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::inline v0 {

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

/// The surfaces that boundaries shall stay close to: the sweep of each stroke, at rest.
class References {
 public:
  void set(std::uint32_t stroke, TriangleTree sweep) { sweeps_[stroke] = std::move(sweep); }

  /// How far a piece of surface under a tag may lie from what `allows` compares it with once it is replaced:
  /// `tolerance`, or as far as it lies from its reference now. Cost: O(samples) where there is a reference.
  [[nodiscard]] double limit(std::uint32_t tag, const Piece& before, double tolerance) const;

  /// Whether `before` may give way to `after`: no sample of `after` lies further than `limit` from the reference. Where
  /// there is none the pieces are compared with each other. Cost: O(samples of `after`), or O(samples·facets).
  [[nodiscard]] bool allows(std::uint32_t tag, const Piece& before, const Piece& after, double limit) const;

 private:
  std::map<std::uint32_t, TriangleTree> sweeps_;
};

}  // namespace incise::inline v0
