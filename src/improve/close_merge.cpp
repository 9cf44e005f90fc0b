// SPDX-License-Identifier: Apache-2.0
// Both stars are looked at as one surface around two vertices: three places are tried, each moved to where the volume
// is kept, and judged by tets, references and turns alone (docs/internals.md, 3.13).
#include "improve/close_merge.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "improve/constants.h"
#include "improve/smooth.h"
#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {

namespace {

double height_of(const Facet& f) {
  const double longest2 =
      std::max({(f[1] - f[0]).squaredNorm(), (f[2] - f[1]).squaredNorm(), (f[0] - f[2]).squaredNorm()});
  return longest2 > 0 ? vector_area2(f).norm() / std::sqrt(longest2) : 0.0;
}

/// Whether a place is the corner of a facet.
bool is_on(const Piece& piece, const Vec3& place) {
  return std::any_of(piece.facets.begin(), piece.facets.end(),
                     [&](const Facet& f) { return f[0] == place || f[1] == place || f[2] == place; });
}

}  // namespace

bool CloseMerger::improve(Care& care, TetId tet) {
  const TetVertices v = care.mesh.vertices(tet);
  std::array<std::tuple<double, VertexId, VertexId>, 6> edges;
  for (unsigned e = 0; e < 6; ++e) {
    const auto [i, j] = kEdgeCorners[e];
    edges[e] = {(care.mesh.rest(v[i]) - care.mesh.rest(v[j])).squaredNorm(), v[i], v[j]};
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const auto& x, const auto& y) { return std::get<0>(x) < std::get<0>(y); });
  const double short2 = kShort * kShort * std::get<0>(edges.back());
  return std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return std::get<0>(edge) <= short2 && try_merge(care, std::get<1>(edge), std::get<2>(edge));
  });
}

bool CloseMerger::try_merge(Care& care, VertexId from, VertexId into) {
  const Vec3 p = care.mesh.rest(from), q = care.mesh.rest(into);
  if (!may_merge(care, from, into) || (p - q).norm() > kShort * edge_) return false;
  return try_place(care, q) || try_place(care, p) || try_place(care, 0.5 * (p + q));
}

std::optional<double> CloseMerger::merge_loosely(Care& care, VertexId from, VertexId into) {
  const Vec3 p = care.mesh.rest(from), q = care.mesh.rest(into);
  if (!may_merge(care, from, into)) return std::nullopt;
  bend_ = kBentWall;
  const bool is_merged = try_loosely(care, q) || try_loosely(care, p);
  bend_ = 0;
  return is_merged ? std::optional(lost6_) : std::nullopt;
}

/// Plans the merge of two vertices; false where it may not be.
bool CloseMerger::may_merge(Care& care, VertexId from, VertexId into) {
  planner_.plan(care.mesh, from, into, plan_, Flaps::kTakenAway);
  return plan_ && begin(care) && are_flaps_thin(care);
}

/// As `try_place`, but for shapes and for the volume, which it only counts.
bool CloseMerger::try_loosely(Care& care, const Vec3& place) {
  lost6_ = put(place);
  return stays_positive(care.mesh, plan_, place) && keeps_front(care, place) && keeps_current(care, place) &&
         keeps_surfaces(care, place) && carry_out(care, place);
}

/// Whether what stands out between two walls is so thin that these may give way to each other.
bool CloseMerger::are_flaps_thin(const Care& care) const {
  if (plan_.flaps.empty()) return true;
  const double length = (care.mesh.rest(plan_.from) - care.mesh.rest(plan_.into)).norm();
  return std::all_of(tags_.begin(), tags_.end(), [&](std::uint32_t tag) {
    return length <= 2.0 * surface_tolerance(care, tag, plan_.from, edge_);
  });
}

/// Whether neither end moves too far where it is part of a front.
bool CloseMerger::keeps_front(const Care& care, const Vec3& place) const {
  const double reach = std::max(kFrontReach * edge_, bend_at(care, place));
  const auto keeps = [&](VertexId v) {
    return (care.mesh.shape_of(v) & shape::kFront) == 0 || (care.mesh.rest(v) - place).norm() <= reach;
  };
  return keeps(plan_.from) && keeps(plan_.into);
}

/// Looks at both stars; false where they may not change.
bool CloseMerger::begin(Care& care) {
  const TetMesh& mesh = care.mesh;
  star_ = plan_.fan;
  star_.insert(star_.end(), plan_.around.begin(), plan_.around.end());
  if (!care.may_change(star_) || !has_one_region(mesh, star_)) return false;
  worst_ = worst_of(care, star_);
  double sum = 0;
  std::size_t count = 0;
  for (const TetId tet : star_) {
    for (const auto& [i, j] : kEdgeCorners) {
      sum += (mesh.rest(mesh.vertices(tet)[i]) - mesh.rest(mesh.vertices(tet)[j])).norm();
      ++count;
    }
  }
  edge_ = sum / static_cast<double>(count);
  collect_sides(care);
  return true;
}

void CloseMerger::collect_sides(const Care& care) {
  const TetMesh& mesh = care.mesh;
  sides_.clear();
  tags_.clear();
  for (const TetId tet : star_) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (!link.is_boundary()) continue;
      const auto v = mesh.vertices(Side(tet, s));
      const auto from = static_cast<std::size_t>(std::find(v.begin(), v.end(), plan_.from) - v.begin());
      const auto into = static_cast<std::size_t>(std::find(v.begin(), v.end(), plan_.into) - v.begin());
      const std::size_t first = std::min(from, into);
      if (first == 3) continue;
      const Facet before = {mesh.rest(v[first]), mesh.rest(v[(first + 1) % 3]), mesh.rest(v[(first + 2) % 3])};
      const bool is_flap = std::find(plan_.flaps.begin(), plan_.flaps.end(), tet) != plan_.flaps.end();
      sides_.push_back({link.tag(), before, before, (from == 3 || into == 3) && !is_flap});
      if (std::find(tags_.begin(), tags_.end(), link.tag()) == tags_.end()) tags_.push_back(link.tag());
    }
  }
}

bool CloseMerger::try_place(Care& care, Vec3 place) {
  return restore_volume(place) && keeps_front(care, place) && improves(care, place) && keeps_current(care, place) &&
         keeps_surfaces(care, place) && carry_out(care, place);
}

/// Puts the merged vertex in a place. Returns six times the volume that both stars lose: what facets enclose with the
/// place itself, since none of those that stay have any.
double CloseMerger::put(const Vec3& place) {
  double lost6 = 0;
  for (MovedSide& side : sides_) {
    side.after[0] = place;
    lost6 += (side.before[0] - place).cross(side.before[1] - place).dot(side.before[2] - place);
  }
  return lost6;
}

/// How far walls, fronts and rims of skin may leave their place besides, in the mesh's unit: in trials alone.
double CloseMerger::bend_at(const Care& care, const Vec3& place) const {
  return bend_ > 0 ? bend_ * care.references.sizes().at(place) : 0.0;
}

/// Moves the merged vertex to where both stars have the volume that they had: it is linear in the vertex, with the sum
/// of the vector areas around it as gradient.
bool CloseMerger::restore_volume(Vec3& place) {
  const double lost6 = put(place);
  double scale = 0;
  Vec3 area2 = Vec3::Zero();
  for (const MovedSide& side : sides_) {
    if (!side.stays) continue;
    area2 += vector_area2(side.after);
    scale += vector_area2(side.after).norm();
  }
  if (std::abs(lost6) <= kNoVolume * edge_ * edge_ * edge_) return true;
  if (!(area2.norm() > kLeastArea * scale)) return false;
  const Vec3 step = (lost6 / area2.squaredNorm()) * area2;
  place += step;
  for (MovedSide& side : sides_) side.after[0] = place;
  return step.norm() <= kGreatestStep * edge_;
}

bool CloseMerger::improves(Care& care, const Vec3& place) const {
  const double bound = std::max(worst_ * (1.0 + kLeastGain), kLeastRatio);
  const auto is_better = [&](TetId tet, VertexId vertex) {
    care.spend(1);
    return inradius_ratio_with(care.mesh, tet, vertex, place) > bound;
  };
  return std::all_of(plan_.fan.begin(), plan_.fan.end(), [&](TetId tet) { return is_better(tet, plan_.from); }) &&
         std::all_of(plan_.around.begin(), plan_.around.end(),
                     [&](TetId tet) { return care.mesh.corner_of(tet, plan_.from) < 4 || is_better(tet, plan_.into); });
}

bool CloseMerger::keeps_surfaces(Care& care, const Vec3& place) {
  const auto turns = [&](const MovedSide& side) {
    const Vec3 n = vector_area2(side.before), m = vector_area2(side.after);
    return side.stays && height_of(side.before) > kLeastHeight * edge_ &&
           !(n.dot(m) > kFaceCosine * n.norm() * m.norm());
  };
  return std::none_of(sides_.begin(), sides_.end(), turns) &&
         std::all_of(tags_.begin(), tags_.end(), [&](std::uint32_t tag) { return keeps_tag(care, tag, place); });
}

bool CloseMerger::keeps_tag(Care& care, std::uint32_t tag, const Vec3& place) {
  before_.clear();
  after_.clear();
  for (const MovedSide& side : sides_) {
    if (side.tag != tag) continue;
    add_facet(before_, side.before);
    if (side.stays) add_facet(after_, side.after);
  }
  if (after_.facets.empty()) return false;
  after_.samples.push_back(place);
  const double bend = bend_at(care, place), own = surface_tolerance(care, tag, plan_.from, edge_);
  const double tolerance = tag == 0 ? own : std::max(own, bend);
  const auto keeps_end = [&](const Vec3& end) {
    return !is_on(before_, end) || care.references.allows_apex(tag, end, place, tolerance, edge_, skin_share(care));
  };
  Reach reach;
  return keeps_end(care.mesh.rest(plan_.from)) && keeps_end(care.mesh.rest(plan_.into)) &&
         care.references.allows(tag, before_, after_, tolerance, reach, skin_share(care), bend);
}

/// Whether tets that stand upright now stay so.
bool CloseMerger::keeps_current(const Care& care, const Vec3& place) const {
  const TetMesh& mesh = care.mesh;
  const MaterialPoint point = locate(mesh, place, star_);
  const Vec3 merged = place == mesh.rest(plan_.into)
                          ? mesh.current(plan_.into)
                          : current_after_move(mesh, plan_.into, place, point.basis, point.weights);
  return std::all_of(star_.begin(), star_.end(), [&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    const bool vanishes = mesh.corner_of(tet, plan_.from) < 4 && mesh.corner_of(tet, plan_.into) < 4;
    const auto at = [&](unsigned c) -> const Vec3& {
      return v[c] == plan_.from || v[c] == plan_.into ? merged : mesh.current(v[c]);
    };
    return vanishes || signed_volume6(at(0), at(1), at(2), at(3)) > 0 || !is_sound_now(mesh, v);
  });
}

bool CloseMerger::carry_out(Care& care, const Vec3& place) {
  if (place != care.mesh.rest(plan_.into)) {
    const MaterialPoint point = locate(care.mesh, place, star_);
    care.transaction.move(plan_.into, place, point.basis, point.weights);
    ++care.statistics.moved_vertices;
  }
  apply(care.transaction, plan_);
  ++care.statistics.collapsed_edges;
  care.changed = care.walker.star(care.mesh, plan_.into);
  return true;
}

}  // namespace v0
}  // namespace incise
