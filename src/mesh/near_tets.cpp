// SPDX-License-Identifier: Apache-2.0
// Which lip of a wall a place belongs to is told by the tet that holds it or is nearest to it. Lips share no vertices
// but at the front of the cut, so that two tets which share any other vertex are joined there; where the way between
// two places changes from tet to tet without such a vertex, and at a wall, it crosses the wall.
#include "mesh/near_tets.h"

#include <algorithm>
#include <limits>

#include "incise/geom/closest.h"
#include "incise/mesh/embedded_surface.h"
#include "mesh/constants.h"

namespace incise {
inline namespace v0 {
namespace {

/// Whether the tets hang together at a vertex: one that is no front, where tets around a wall would share it.
bool share_a_vertex(const TetMesh& mesh, TetId a, TetId b) {
  for (const VertexId v : mesh.vertices(a)) {
    if (mesh.corner_of(b, v) < 4 && (mesh.shape_of(v) & shape::kFront) == 0) return true;
  }
  return false;
}

/// The vertices of a tet that a place at its border lies on, ascending, and how much of it is at walls.
struct Support {
  std::array<VertexId, 4> vertices;
  double wall_share = 0;

  Support(const TetMesh& mesh, TetId tet, const Vec3& place) {
    const Binding binding = bind_to(mesh, tet, place);
    std::size_t count = 0;
    for (unsigned c = 0; c < 4; ++c) {
      const VertexId v = mesh.vertices(tet)[c];
      if ((mesh.shape_of(v) & shape::kWall) != 0) wall_share += binding.weights[c];
      if (binding.weights[c] < kTellingWeight) continue;
      std::size_t at = count++;
      for (; at > 0 && v < vertices[at - 1]; --at) vertices[at] = vertices[at - 1];
      vertices[at] = v;
    }
  }
};

}  // namespace

bool are_parted(const TetMesh& mesh, TetId a, TetId b, const Vec3& place) {
  if (a == b || share_a_vertex(mesh, a, b)) return false;
  const Support of_a(mesh, a, place), of_b(mesh, b, place);
  return of_a.vertices != of_b.vertices && std::max(of_a.wall_share, of_b.wall_share) >= kAtWallShare;
}

struct NearTets::Way {
  const TetMesh& mesh;
  Vec3 from, to;
  std::vector<WallCrossing>& crossings;

  [[nodiscard]] Vec3 at(double t) const { return from + t * (to - from); }
};

NearTets::NearTets(double extent) : aside_(extent * kAsideX, extent * kAsideY, extent * kAsideZ) {}

void NearTets::gather(const TetMesh& mesh, const TetGrid& grid, const Box& box, double reach) {
  entries_.clear();
  has_walls_ = false;
  for (double wider = reach; entries_.empty() && mesh.tet_count() > 0; wider *= 2) {
    const Vec3 margin = Vec3::Constant(wider);
    grid.collect(Box{box.lo - margin, box.hi + margin}, found_);
    for (const TetId tet : found_) add(mesh, tet);
  }
}

void NearTets::add(const TetMesh& mesh, TetId tet) {
  Entry& entry = entries_.emplace_back();
  entry.tet = tet;
  for (unsigned c = 0; c < 4; ++c) {
    const VertexId v = mesh.vertices(tet)[c];
    entry.corners[c] = mesh.rest(v);
    entry.box.extend(entry.corners[c]);
    has_walls_ = has_walls_ || (mesh.shape_of(v) & shape::kWall) != 0;
  }
  const double volume6 = mesh.rest_volume6(tet);
  entry.is_flat = !(volume6 > 0);
  if (entry.is_flat) return;
  for (unsigned s = 0; s < 4; ++s) {
    const auto& [a, b, c] = kSideCorners[s];
    const Vec3& origin = entry.corners[a];
    entry.slopes[s] = (entry.corners[c] - origin).cross(entry.corners[b] - origin) / volume6;
  }
}

bool NearTets::is_inside(const Entry& entry, const Vec3& place) {
  if (entry.is_flat) return false;
  for (unsigned s = 0; s < 4; ++s) {
    if (entry.slopes[s].dot(place - entry.corners[kSideCorners[s][0]]) < 0) return false;
  }
  return true;
}

NearTets::Nearness NearTets::nearness(const Entry& entry, const Vec3& place) {
  ClosestPoint best{Vec3::Zero(), {}, std::numeric_limits<double>::infinity(), TriangleFeature::kFace};
  for (unsigned s = 0; s < 4; ++s) {
    const auto& [a, b, c] = kSideCorners[s];
    if (!entry.is_flat && entry.slopes[s].dot(place - entry.corners[a]) >= 0) continue;
    const ClosestPoint hit = closest_on_triangle(place, entry.corners[a], entry.corners[b], entry.corners[c]);
    if (hit.distance2 < best.distance2) best = hit;
  }
  const Vec3 middle = (entry.corners[0] + entry.corners[1] + entry.corners[2] + entry.corners[3]) / 4;
  return {best.distance2, (place - best.point).dot((middle - best.point).normalized())};
}

TetId NearTets::locate(const Vec3& at) const {
  const Vec3 place = at + aside_;
  TetId tet;
  Nearness best{std::numeric_limits<double>::infinity(), 0};
  for (const Entry& entry : entries_) {
    if (entry.box.distance2(place) > best.distance2 * (1 + kSameDistance)) continue;
    if (is_inside(entry, place)) return entry.tet;
    const Nearness found = nearness(entry, place);
    const bool is_nearer = found.distance2 < best.distance2 * (1 - kSameDistance);
    const bool is_same = !is_nearer && found.distance2 <= best.distance2 * (1 + kSameDistance);
    if (!is_nearer && !(is_same && found.lean > best.lean)) continue;
    best = found;
    tet = entry.tet;
  }
  return tet;
}

void NearTets::find_crossings(const TetMesh& mesh, const Vec3& from, TetId from_tet, const Vec3& to, TetId to_tet,
                              std::vector<WallCrossing>& crossings) const {
  crossings.clear();
  halve(Way{mesh, from, to, crossings}, 0, from_tet, 1, to_tet);
}

/// Tets are convex: where both ends are in one tet, nothing is between.
void NearTets::halve(const Way& way, double low, TetId low_tet, double high, TetId high_tet) const {
  if (low_tet == high_tet || share_a_vertex(way.mesh, low_tet, high_tet)) return;
  const double middle = (low + high) / 2;
  if (high - low < kCrossingPrecision) {
    if (are_parted(way.mesh, low_tet, high_tet, way.at(middle))) way.crossings.push_back({middle, low_tet, high_tet});
    return;
  }
  const TetId middle_tet = locate(way.at(middle));
  halve(way, low, low_tet, middle, middle_tet);
  halve(way, middle, middle_tet, high, high_tet);
}

}  // namespace v0
}  // namespace incise
