// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "incise/cut/stroke.h"
#include "incise/geom/predicates.h"
#include "incise/geom/triangle_tree.h"

namespace incise {
inline namespace v0 {

/// One triangle of a swept surface.
struct SweptTriangle {
  std::array<std::uint32_t, 3> points;  ///< indices into `SweptSurface::points`
  std::uint32_t step;                   ///< the step that swept it
  std::uint32_t column;                 ///< the segment of the edge that swept it
  bool reaches_on = false;              ///< not swept: it joins the border of the sheet to an older cut
};

/// What a blade swept: triangles in the order of time, then along the edge.
///
/// Neighbouring strips share points, keys included, so that every mesh edge sees one surface without seams.
/// Paper §2.2 (sweep face). Differs: triangles with a fixed diagonal instead of quads, exact on every strip.
struct SweptSurface {
  std::vector<SosPoint> points;
  std::vector<SweptTriangle> triangles;
  std::vector<std::uint32_t> front = {};  ///< indices of the points at which a whole stroke has left the blade's front
};

/// The key of the first blade point; every vertex slot is below.
inline constexpr std::uint64_t kFirstBladeKey = std::uint64_t{1} << 32U;

/// The surface that a stroke sweeps.
///
/// A blade that turns back moves in its own slit until it gets ahead of its deepest place again: times at which all its
/// points lie within `slit` of what it swept before are passed over, and the next strip starts where the last one
/// ended. Equal points of one column at consecutive times are one point, and so are the first and last column of a
/// closed edge and the first and last row of a motion that returns (within 1e-12 of its extent). Triangles that name a
/// point twice are left out. `stroke` must pass `check`.
SweptSurface sweep(const Stroke& stroke, double slit = 0.0);

/// Parts of a sweep that are each free of self-crossing, in time order: lists of ascending triangle indices.
///
/// A sweep that meets itself must be cut one part after the other: taken as one surface its two passes would cancel
/// where they cross. Consecutive parts overlap by up to `overlap` in length, so that the cut stays whole where they
/// join (cutting the same place again changes nothing). Strips that fold back onto earlier ones within `slit` count as
/// meeting them. Cost: O(n log n) triangle pairs whose boxes overlap.
std::vector<std::vector<std::uint32_t>> split_at_self_crossings(const SweptSurface& surface, double overlap,
                                                                double slit);

/// Whether a sweep meets itself otherwise than as neighbours on one sheet: triangles cross, or one covers another
/// within `slit`. Cost: O(n log n) triangle pairs whose boxes overlap.
bool meets_itself(const SweptSurface& surface, double slit);

/// Whether a blade ends, within a length, where it began. Cost: O(points of a row).
bool comes_round(const Stroke& stroke, double length);
/// How often a blade turns on its way by more than 45°: the point of its edge that does so most. Moves up to a length
/// are left out; where it comes round, its first move follows on its last. What it sweeps lies in as many folds. Cost:
/// O(points).
std::size_t count_sharp_turns(const Stroke& stroke, double length);

class Sheet;

/// Whether a strip meets an earlier one, given with its sheet, otherwise than as its neighbour on one sheet: their
/// triangles cross, or one lies on the other within `slit`. Cost: O(n log n) in their triangles.
bool strips_meet(const SweptSurface& strip, const SweptSurface& earlier, const Sheet& sheet, double slit);
/// How far the blade travels over a surface at the point that travels furthest, step by step.
double travel_of(const SweptSurface& surface);
/// The last steps of what a whole stroke has swept: at least a length of travel, if there is so much. Cost: O(points).
SweptSurface last_part(const SweptSurface& surface, double length);
/// Adds the triangles of another surface; points with equal keys are one.
void append(SweptSurface& surface, const SweptSurface& more);

/// A part of a surface with a search tree: what one cut is made with.
class Sheet {
 public:
  Sheet(const SweptSurface& surface, const std::vector<std::uint32_t>& triangles);
  /// Of all its triangles.
  explicit Sheet(const SweptSurface& surface);

  [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }
  [[nodiscard]] const SosPoint& point(std::uint32_t triangle, unsigned corner) const {
    return (*surface_).points[triangles_[triangle][corner]];
  }
  /// Whether a triangle only joins the border of the sheet to an older cut.
  [[nodiscard]] bool reaches_on(std::uint32_t triangle) const { return reaches_on_[triangle]; }
  [[nodiscard]] const TriangleTree& tree() const { return tree_; }
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  /// Unit mean normal, or zero where the sheet has none (closed).
  [[nodiscard]] const Vec3& mean_normal() const { return mean_normal_; }
  /// Unnormalised normal of a triangle: twice its area vector. One without area, which closes a seam, has that of the
  /// nearest triangle that has one.
  [[nodiscard]] const Vec3& normal(std::uint32_t triangle) const { return normals_[triangle]; }

 private:
  const SweptSurface* surface_;
  void find_normals();

  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Vec3> normals_;
  std::vector<bool> reaches_on_;
  TriangleTree tree_;
  Box bounds_;
  Vec3 mean_normal_ = Vec3::Zero();
};

}  // namespace v0
}  // namespace incise
