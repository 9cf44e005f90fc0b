// SPDX-License-Identifier: Apache-2.0
// The surfaces of `from` are collected once for all edges; each edge is asked by classes, lengths, shape, volume and
// surfaces, and last by the link condition (docs/internals.md, 3.13).
#include "improve/edge_collapse.h"

#include <algorithm>
#include <cmath>

#include "improve/constants.h"
#include "improve/smooth.h"
#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {

namespace {

constexpr unsigned kBoundary = shape::kSkin | shape::kWall;

struct RankedEdge {
  double length2;
  VertexId a, b;
};

std::array<RankedEdge, 6> edges_by_length(const TetMesh& mesh, TetId tet) {
  std::array<RankedEdge, 6> edges{};
  const TetVertices& v = mesh.vertices(tet);
  for (unsigned e = 0; e < 6; ++e) {
    const auto [i, j] = kEdgeCorners[e];
    edges[e] = {(mesh.rest(v[i]) - mesh.rest(v[j])).squaredNorm(), v[i], v[j]};
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const RankedEdge& x, const RankedEdge& y) { return x.length2 < y.length2; });
  return edges;
}

/// Calls `visit(tag, tet, side)` for the surface sides of tets that contain `with`, and do not contain `without`.
template <class Visit>
void for_each_face(const TetMesh& mesh, const std::vector<TetId>& tets, VertexId with, VertexId without,
                   Visit&& visit) {
  for (const TetId tet : tets) {
    const TetVertices& v = mesh.vertices(tet);
    for (unsigned s = 0; s < 4; ++s) {
      const unsigned other = mesh.corner_of(tet, without);
      if (v[s] == with || (other < 4 && other != s)) {
        continue;
      }
      const std::int64_t tag = surface_tag(mesh, {tet, s});
      if (tag >= 0) {
        visit(static_cast<std::uint32_t>(tag), Side(tet, s));
      }
    }
  }
}

/// A side with one of its vertices first.
Facet facet_of(const TetMesh& mesh, Side side, VertexId first) {
  const auto v = mesh.vertices(side);
  const auto at = static_cast<std::size_t>(std::find(v.begin(), v.end(), first) - v.begin());
  return {mesh.rest(v[at]), mesh.rest(v[(at + 1) % 3]), mesh.rest(v[(at + 2) % 3])};
}

}  // namespace

bool EdgeCollapser::improve(Care& care, TetId tet) {
  const auto edges = edges_by_length(care.mesh, tet);
  begun_ = VertexId();
  least_gain_ = kLeastGain;
  enough_ = 1.0;
  for (std::size_t i = 0; i < kEdgesTried; ++i) {
    if (try_collapse(care, edges[i].a, edges[i].b) || try_collapse(care, edges[i].b, edges[i].a)) {
      return true;
    }
  }
  return false;
}

bool EdgeCollapser::thin_out(Care& care, VertexId vertex, double enough) {
  neighbours_.clear();
  begun_ = VertexId();
  begin(care, vertex);
  for (const TetId tet : star_) {
    for (const VertexId v : care.mesh.vertices(tet)) {
      if (v != vertex && std::find(neighbours_.begin(), neighbours_.end(), v) == neighbours_.end()) {
        neighbours_.push_back(v);
      }
    }
  }
  const Vec3& centre = care.mesh.rest(vertex);
  std::sort(neighbours_.begin(), neighbours_.end(), [&](VertexId a, VertexId b) {
    const double x = (care.mesh.rest(a) - centre).squaredNorm(), y = (care.mesh.rest(b) - centre).squaredNorm();
    return x != y ? x < y : a.value < b.value;
  });
  neighbours_.resize(std::min(neighbours_.size(), kNeighboursTried));
  least_gain_ = 0.0;
  enough_ = enough;
  return std::any_of(neighbours_.begin(), neighbours_.end(), [&](VertexId v) { return try_collapse(care, vertex, v); });
}

/// Looks at the surroundings of a vertex once for all edges that may swallow it.
void EdgeCollapser::begin(Care& care, VertexId from) {
  plan_.from = from;
  if (begun_ == from) {
    return;
  }
  begun_ = from;
  has_before_ = false;
  star_ = care.walker.star(care.mesh, from);
  is_held_ = !care.may_change(star_);
  if (is_held_) return;
  surfaces_ = surfaces_at(care.mesh, from, star_);
  worst_ = worst_of(care, star_);
  longest_ = 0;
  for (const TetId tet : star_) {
    for (const VertexId v : care.mesh.vertices(tet)) {
      const double length = (care.mesh.rest(v) - care.mesh.rest(from)).norm();
      longest_ = std::max(longest_, length);
    }
  }
}

bool EdgeCollapser::try_collapse(Care& care, VertexId from, VertexId into) {
  const unsigned bits = care.mesh.shape_of(from), into_bits = care.mesh.shape_of(into);
  if ((bits & shape::kPinched) != 0 || ((bits & (kBoundary | shape::kFront)) & ~into_bits) != 0) {
    return false;
  }
  begin(care, from);
  plan_.into = into;
  place_ = care.mesh.rest(into);
  if (is_held_ || !may_merge(care) || !is_short_enough(care) || !improves(care)) {
    return false;
  }
  if (is_curved() && !(keep_volume(care) && improves(care) && keeps_surfaces(care))) {
    return false;
  }
  if (surfaces_.is_front() &&
      !keeps_front(care.mesh, care.mesh.rest(from), surfaces_, skin_tolerance(care) * longest_)) {
    return false;
  }
  planner_.plan(care.mesh, from, into, plan_);
  return plan_ && keeps_current(care) && carry_out(care);
}

/// Whether the edge lies on all surfaces of `from`: one of its two faces on each of two, or both on one.
bool EdgeCollapser::may_merge(const Care& care) const {
  if (surfaces_.count == 0) {
    return true;
  }
  if (surfaces_.mobility == Mobility::kFixed) {
    return false;
  }
  std::array<unsigned, 3> faces{};
  for (const TetId tet : star_) {
    const unsigned into = care.mesh.corner_of(tet, plan_.into);
    for (unsigned s = 0; s < 4 && into < 4; ++s) {
      const std::int64_t tag =
          s == into || care.mesh.vertices(tet)[s] == plan_.from ? -1 : surface_tag(care.mesh, {tet, s});
      if (tag >= 0) {
        const Vec3 normal = incise::vector_area2(care.mesh, {tet, s}).normalized();
        ++faces[std::min(2U, surfaces_.find(static_cast<std::uint32_t>(tag), normal))];
      }
    }
  }
  return surfaces_.count == 1 ? faces[0] == 2 : faces[0] == 1 && faces[1] == 1;
}

/// The faces of every surface around `from`, once for all edges.
void EdgeCollapser::collect_before(const Care& care) {
  for (Patch& patch : patches_) {
    patch.before.clear();
    patch.before.samples.push_back(care.mesh.rest(plan_.from));
    patch.reach.reset();
  }
  for_each_face(care.mesh, star_, plan_.from, VertexId(), [&](std::uint32_t tag, Side side) {
    const Facet facet = facet_of(care.mesh, side, plan_.from);
    const unsigned at = surfaces_.find(tag, vector_area2(facet).normalized());
    if (at < 2) add_facet(patches_[at].before, facet);
  });
  has_before_ = true;
}

/// What becomes of them, and the volume that this costs.
void EdgeCollapser::collect_after(const Care& care) {
  for (Patch& patch : patches_) {
    patch.after.clear();
    patch.lost6 = 0;
  }
  const Vec3& into = care.mesh.rest(plan_.into);
  for (Patch& patch : patches_) {
    for (const Facet& facet : patch.before.facets) {
      if (facet[1] != into && facet[2] != into) {
        patch.lost6 += (facet[0] - place_).cross(facet[1] - place_).dot(facet[2] - place_);
        add_facet(patch.after, {place_, facet[1], facet[2]});
      }
    }
  }
}

/// Finds the place of the merged vertex that keeps the volume under every surface; false where there is none nearby.
/// The volume is linear in the vertex, with its vector area as gradient.
bool EdgeCollapser::keep_volume(const Care& care) {
  if (!has_before_) {
    collect_before(care);
  }
  collect_after(care);
  if (surfaces_.is_front()) {
    return std::abs(patches_[0].lost6 + patches_[1].lost6) <= kFrontVolume * longest_ * longest_ * longest_;
  }
  around_ = care.walker.star(care.mesh, plan_.into);
  if (!care.may_change(around_)) {
    return false;
  }
  VertexSurfaces merged;
  std::array<double, 2> lost6{};
  for_each_face(care.mesh, star_, plan_.from, plan_.into, [&](std::uint32_t tag, Side side) {
    Facet facet = facet_of(care.mesh, side, plan_.from);
    facet[0] = place_;
    add_face(merged, tag, vector_area2(facet));
  });
  for_each_face(care.mesh, around_, plan_.into, plan_.from, [&](std::uint32_t tag, Side side) {
    add_face(merged, tag, vector_area2(facet_of(care.mesh, side, plan_.into)));
  });
  for (unsigned i = 0; i < surfaces_.count; ++i) {
    const unsigned at = merged.find(surfaces_.surfaces[i].tag, surfaces_.surfaces[i].first_normal);
    if (at >= std::min(merged.count, 2U)) {
      return false;
    }
    lost6[at] += patches_[i].lost6;
  }
  Vec3 step = Vec3::Zero();
  if (!find_volume_step(care.mesh, merged, lost6, step)) {
    return false;
  }
  place_ += step;
  collect_after(care);
  return step.norm() <= kGreatestStep * longest_;
}

/// The step of the merged vertex that gives every surface its volume back, and where regions meet each of these. No
/// vertex of a border is merged into another: what is lost is one region's.
bool EdgeCollapser::find_volume_step(const TetMesh& mesh, const VertexSurfaces& merged,
                                     const std::array<double, 2>& lost6, Vec3& step) const {
  if (has_one_region(mesh, star_) && has_one_region(mesh, around_)) {
    return incise::find_volume_step(merged, lost6, step);
  }
  RegionVolumes volumes;
  volumes.lose(mesh.region(star_.front()), patches_[0].lost6 + patches_[1].lost6);
  for (const TetId tet : star_) {
    if (mesh.corner_of(tet, plan_.into) == 4) add_tet(volumes, mesh, tet, plan_.from);
  }
  for (const TetId tet : around_) {
    if (mesh.corner_of(tet, plan_.from) == 4) add_tet(volumes, mesh, tet, plan_.into);
  }
  for (unsigned i = 0; i < std::min(merged.count, 2U); ++i) {
    const SurfaceAt& surface = merged.surfaces[i];
    if (surface.tag != kBorderTag) volumes.add_surface(surface.vector_area, lost6[i]);
  }
  return has_one_region(mesh, star_) && merged.count <= 2 && volumes.find_step(step);
}

bool EdgeCollapser::is_short_enough(const Care& care) const {
  const double cap = kLengthCap * longest_;
  return std::all_of(star_.begin(), star_.end(), [&](TetId tet) {
    const TetVertices& v = care.mesh.vertices(tet);
    return std::all_of(v.begin(), v.end(), [&](VertexId id) {
      return id == plan_.from || (care.mesh.rest(id) - place_).squaredNorm() <= cap * cap;
    });
  });
}

/// Whether the worst tet after the collapse is better than the worst before.
bool EdgeCollapser::improves(Care& care) const {
  double before = worst_;
  if (moves(care)) {
    before = std::min(before, worst_of(care, around_));
  }
  const double bound = std::max(std::min(before * (1.0 + least_gain_), enough_), kLeastRatio);
  const auto is_better = [&](TetId tet, VertexId vertex) {
    care.spend(1);
    return inradius_ratio_with(care.mesh, tet, vertex, place_) > bound;
  };
  const auto keeps = [&](TetId tet) { return care.mesh.corner_of(tet, plan_.into) < 4 || is_better(tet, plan_.from); };
  return std::all_of(star_.begin(), star_.end(), keeps) &&
         (!moves(care) || std::all_of(around_.begin(), around_.end(), [&](TetId tet) {
           return care.mesh.corner_of(tet, plan_.from) < 4 || is_better(tet, plan_.into);
         }));
}

bool EdgeCollapser::keeps_surfaces(const Care& care) {
  for (unsigned i = 0; i < surfaces_.count; ++i) {
    const SurfaceAt& surface = surfaces_.surfaces[i];
    const Vec3 normal = surface.vector_area.normalized();
    for (const Facet& facet : patches_[i].after.facets) {
      const Vec3 area2 = vector_area2(facet);
      if (!(normal.dot(area2) > kFaceCosine * area2.norm())) {
        return false;
      }
    }
    const double edge = mean_spoke(patches_[i].before),
                 tolerance = surface_tolerance(care, surface.tag, plan_.from, edge);
    const bool keeps_apex = !moves(care) || care.references.allows_apex(surface.tag, care.mesh.rest(plan_.into), place_,
                                                                        tolerance, edge, skin_share(care));
    const bool keeps_facets =
        surface.is_flat || care.references.allows(surface.tag, patches_[i].before, patches_[i].after, tolerance,
                                                  patches_[i].reach, skin_share(care));
    if (!keeps_apex || !keeps_facets) {
      return false;
    }
  }
  return !moves(care) || (keeps_skin_beside(care) && keeps_borders_beside(care));
}

/// The faces with a tag around `into` that are not merged, before and after it moves.
void EdgeCollapser::collect_beside(const Care& care, std::uint32_t tag, Piece& before, Piece& after) const {
  for_each_face(care.mesh, around_, plan_.into, plan_.from, [&](std::uint32_t own, Side side) {
    if (own != tag) return;
    Facet facet = facet_of(care.mesh, side, plan_.into);
    add_facet(before, facet);
    facet[0] = place_;
    add_facet(after, facet);
  });
}

/// Whether the skin beside the merged faces stays in its place, too: their common vertex moves.
bool EdgeCollapser::keeps_skin_beside(const Care& care) {
  Piece before, after;
  collect_beside(care, 0, before, after);
  return care.references.skin().keeps(before, after, skin_share(care));
}

/// The same for borders between regions, which the step of one region's volume may move.
bool EdgeCollapser::keeps_borders_beside(const Care& care) {
  if (!care.mesh.has_regions()) {
    return true;
  }
  Piece before, after;
  collect_beside(care, kBorderTag, before, after);
  Reach reach;
  return before.facets.empty() ||
         care.references.allows(kBorderTag, before, after,
                                surface_tolerance(care, kBorderTag, plan_.into, mean_spoke(before)), reach);
}

/// Whether tets that stand upright now stay so, with the merged vertex where it will stand.
bool EdgeCollapser::keeps_current(const Care& care) const {
  const TetMesh& mesh = care.mesh;
  const MaterialPoint point = locate(mesh, place_, plan_.around);
  const Vec3 merged =
      moves(care) ? current_after_move(mesh, plan_.into, place_, point.basis, point.weights) : mesh.current(plan_.into);
  return std::all_of(plan_.fan.begin(), plan_.fan.end(), [&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    const auto at = [&](unsigned c) -> const Vec3& { return v[c] == plan_.from ? merged : mesh.current(v[c]); };
    return signed_volume6(at(0), at(1), at(2), at(3)) > 0 || !is_sound_now(mesh, v);
  });
}

bool EdgeCollapser::carry_out(Care& care) {
  const bool has_moved = moves(care);
  if (has_moved && !move_vertex(care, plan_.into, place_, plan_.around)) {
    return false;
  }
  incise::apply(care.transaction, plan_);
  ++care.statistics.collapsed_edges;
  care.changed = plan_.fan;
  if (has_moved) {
    care.changed = care.walker.star(care.mesh, plan_.into);
  }
  return true;
}

}  // namespace v0
}  // namespace incise
