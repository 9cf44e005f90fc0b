// SPDX-License-Identifier: Apache-2.0
// A tree over the triangles of the skin as it was, against which pieces of skin are judged before they change.
#include "improve/original_skin.h"

#include <algorithm>
#include <limits>

#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {

namespace {

double mean_edge(const Facet& f) {
  return ((f[1] - f[0]).norm() + (f[2] - f[1]).norm() + (f[0] - f[2]).norm()) / 3.0;
}

Box inflated(Box box, double margin) {
  box.lo.array() -= margin;
  box.hi.array() += margin;
  return box;
}

}  // namespace

void OriginalSkin::measure(const TetMesh& mesh) {
  triangles_.clear();
  points_.clear();
  owned_from_.assign(1, 0);
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> point_of(mesh.vertex_slots(), kNone);
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.links(tet)[s] != Link::boundary(0)) continue;
      TriangleTree::Triangle& triangle = triangles_.emplace_back();
      for (unsigned k = 0; k < 3; ++k) {
        const VertexId v = mesh.vertices(tet)[kSideCorners[s][k]];
        std::uint32_t& point = point_of[v.value];
        if (point == kNone) {
          point = static_cast<std::uint32_t>(points_.size());
          points_.push_back(mesh.rest(v));
        }
        triangle[k] = point;
      }
      owned_from_.push_back(static_cast<std::uint32_t>(points_.size()));
    }
  });
  tree_ = TriangleTree(points_, triangles_);
}

double OriginalSkin::tolerance_at(const Vec3& place, double edge, double share) const {
  const TriangleTree::Hit nearest = tree_.closest(place, share * kFarthest * edge);
  if (!nearest.is_valid()) return share * edge;
  const TriangleTree::Triangle& t = triangles_[nearest.triangle];
  const double original = mean_edge({points_[t[0]], points_[t[1]], points_[t[2]]});
  return share * (share < kBadSkinTolerance ? std::min(edge, original) : original);
}

/// Whether a vertex that the skin had is as near to the new piece as it must be; others than the old piece's own are.
bool OriginalSkin::is_covered(const Vec3& point, const Piece& before, const Piece& after, double tolerance) const {
  const double tolerance2 = tolerance * tolerance, before2 = distance2_to(before, point);
  return before2 > kOwn * kOwn * tolerance2 || distance2_to(after, point) <= std::max(tolerance2, before2);
}

/// Whether a piece lies where the skin was, or no further off than the one before it.
bool OriginalSkin::is_near(const Piece& after, const Piece& before, double tolerance) const {
  double reach2 = -1;
  return std::all_of(after.samples.begin(), after.samples.end(), [&](const Vec3& p) {
    if (tree_.closest(p, tolerance).is_valid()) return true;
    const double farthest = kFarthest * tolerance;
    if (reach2 < 0) {
      for (const Vec3& q : before.samples) reach2 = std::max(reach2, distance2(q, farthest));
      reach2 = std::min(reach2, farthest * farthest);
    }
    return distance2(p, farthest) <= reach2;
  });
}

bool OriginalSkin::keeps_vertex(const Vec3& old_place, const Vec3& place, double edge, double share) const {
  if (is_empty()) return true;
  return is_near({{}, {place}}, {{}, {old_place}}, tolerance_at(old_place, edge, share));
}

bool OriginalSkin::keeps(const Piece& before, const Piece& after, double share) const {
  if (is_empty() || after.facets.empty() || before.samples.empty()) return true;
  double edge = 0;
  for (const Facet& f : after.facets) edge += mean_edge(f) / static_cast<double>(after.facets.size());
  const double tolerance = tolerance_at(before.samples.front(), edge, share);
  if (!is_near(after, before, tolerance)) return false;
  Box box;
  for (const Facet& f : before.facets) box.extend(box_of(f));
  bool are_covered = true;
  tree_.for_each_overlap(inflated(box, kOwn * tolerance), [&](std::uint32_t triangle) {
    for (std::uint32_t i = owned_from_[triangle]; i < owned_from_[triangle + 1]; ++i) {
      are_covered = are_covered && is_covered(points_[i], before, after, tolerance);
    }
  });
  return are_covered;
}

}  // namespace v0
}  // namespace incise
