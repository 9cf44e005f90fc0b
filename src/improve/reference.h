// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "improve/constants.h"
#include "improve/original_sizes.h"
#include "improve/original_skin.h"
#include "improve/piece.h"
#include "incise/geom/triangle_tree.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// The mean length of the edges that lead from the first corners of a piece's facets, the vertex that they share.
[[nodiscard]] double mean_spoke(const Piece& piece);

/// How far a piece of surface lies from its reference; measured when it is first asked for.
using Reach = std::optional<double>;

/// The surfaces that boundaries shall stay close to: the sweep of each stroke, at rest, and the skin as it was.
class References {
 public:
  /// Skin and sizes are to be compared with those of a mesh as it stands at rest. Without this call no skin and no size
  /// is known. Cost: O(tets).
  void set_original(const TetMesh& mesh);
  [[nodiscard]] const OriginalSkin& skin() const { return skin_; }
  [[nodiscard]] const OriginalSizes& sizes() const { return sizes_; }

  /// Begins a stroke: nothing is known of one of that number before.
  void begin(std::uint32_t stroke) { sweeps_.erase(stroke); }
  /// What a stroke has swept so far: the triangles given last time, with others behind them. Cost: O(log n) per
  /// triangle, all in all.
  void extend(std::uint32_t stroke, std::span<const Vec3> points, std::span<const TriangleTree::Triangle> triangles);

  /// Measures how far the walls of a stroke lie from its sweep right after the cut, by samples of `opened`, those of
  /// earlier calls included: later they may lie no further from it.
  void measure(const TetMesh& mesh, const std::vector<OpenedFace>& opened);

  /// Whether the sweep of a stroke is known.
  [[nodiscard]] bool knows(std::uint32_t tag) const { return sweeps_.count(tag) != 0; }
  /// How far the wall of a stroke may lie from its sweep, as a share of the local edge: as far as most of the fresh
  /// wall did; to mend a bad tet as far as any of it.
  [[nodiscard]] double tolerance(std::uint32_t tag, bool is_bad) const;

  /// Whether the surface under a tag may change from `before` to `after`: no sample of `after` lies further from the
  /// reference than `tolerance`, or than `before` did. Where there is no sweep the pieces are compared with each other,
  /// skin with the skin as it was besides, from which it may lie `skin_share` of the local edge; its rim may draw back
  /// by `retreat`, in the mesh's unit, where that is more than `tolerance`. `reach` is that of `before`. Cost:
  /// O(samples), or O(samples·facets).
  [[nodiscard]] bool allows(std::uint32_t tag, const Piece& before, const Piece& after, double tolerance, Reach& reach,
                            double skin_share = kSkinTolerance, double retreat = 0) const;

  /// The same for a vertex of the surface that moves: it may lie as far from the reference as it did, or as the facets
  /// of a fresh wall with this mean edge do; on skin see `OriginalSkin::keeps_vertex`. True where there is no
  /// reference. Cost: O(1) searches.
  [[nodiscard]] bool allows_apex(std::uint32_t tag, const Vec3& old_place, const Vec3& place, double tolerance,
                                 double edge, double skin_share = kSkinTolerance) const;

 private:
  /// A part of a sweep, by its triangles [first, last).
  struct Part {
    TriangleTree tree;
    std::size_t first = 0, last = 0;
  };
  struct Sweep {
    std::vector<Part> parts;     ///< each less than half as large as the one before
    std::vector<double> shares;  ///< of the fresh wall's facets measured so far: their distance by their edges
    double chord = 0;            ///< how far the fresh wall's facets lie from it, as a share of their edges
    double usual = kWallTolerance, greatest = kWallTolerance;  ///< tolerances
  };

  static TriangleTree::Hit closest(const Sweep& sweep, const Vec3& place,
                                   double greatest = std::numeric_limits<double>::infinity());
  static double farthest(const Sweep& sweep, const Piece& piece);

  std::map<std::uint32_t, Sweep> sweeps_;
  OriginalSkin skin_;
  OriginalSizes sizes_;
};

}  // namespace v0
}  // namespace incise
