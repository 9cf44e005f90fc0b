// SPDX-License-Identifier: Apache-2.0
// Which of the tet's sides are open says what comes to light; one vertex then moves, linear in the volume lost, and
// the first whose move leaves all in place is taken (docs/internals.md, 3.13).
#include "improve/peeling.h"

#include <algorithm>
#include <cmath>

#include "improve/edge_removal.h"
#include "improve/smooth.h"

namespace incise {
inline namespace v0 {

namespace {

void add_facet(const TetMesh& mesh, Side side, Piece& piece) {
  const auto v = mesh.vertices(side);
  const Facet f = {mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2])};
  piece.facets.push_back(f);
  piece.samples.push_back((f[0] + f[1] + f[2]) / 3.0);
  for (unsigned k = 0; k < 3; ++k) {
    piece.samples.push_back(0.5 * (f[k] + f[(k + 1) % 3]));
  }
}

double longest_length(const TetMesh& mesh, TetId tet) {
  double longest2 = 0;
  const TetVertices& v = mesh.vertices(tet);
  for (const auto& [a, b] : kEdgeCorners) {
    longest2 = std::max(longest2, (mesh.rest(v[a]) - mesh.rest(v[b])).squaredNorm());
  }
  return std::sqrt(longest2);
}

}  // namespace

bool Peeler::improve(Care& care, TetId tet) {
  tet_ = tet;
  if (!find_sides(care) || is_bound(care)) {
    return false;
  }
  is_spike_ = false;
  if (find_tag(care) && opens_manifold(care) && keeps_surface(care) && peel(care)) {
    return true;
  }
  is_spike_ = ends_in_spike(care);
  return is_spike_ && peel(care);
}

/// Takes the tet away with the first move of a vertex that restores the volume: of one of its own, or behind a spike,
/// whose foot may have two walls that cancel each other, of one beside it.
bool Peeler::peel(Care& care) {
  const TetMesh& mesh = care.mesh;
  const TetVertices own = mesh.vertices(tet_);
  candidates_.assign(own.begin(), own.end());
  if (is_spike_) {
    for (const VertexId v : mesh.vertices(Side(tet_, inner_[0]))) {
      for (const TetId tet : care.walker.star(mesh, v)) add_candidates(mesh, tet);
    }
  }
  const VertexId tip = inner_.size() == 1 ? own[inner_[0]] : VertexId();
  for (const VertexId vertex : candidates_) {
    Vec3 place;
    if (vertex != tip && (mesh.shape_of(vertex) & shape::kFront) == 0 && find_step(care, vertex, place)) {
      take_away(care);
      star_ = care.walker.star(mesh, vertex);
      move_vertex(care, vertex, place, star_);
      care.changed = star_;
      add_heir(care.changed);
      return true;
    }
  }
  return false;
}

/// The tet behind is made anew, and its new faces are open: behind a spike it need not be at the vertex that moved.
void Peeler::add_heir(std::vector<TetId>& changed) const {
  for (const TetId heir : produced_) {
    if (std::find(changed.begin(), changed.end(), heir) == changed.end()) changed.push_back(heir);
  }
}

void Peeler::add_candidates(const TetMesh& mesh, TetId tet) {
  for (const VertexId v : mesh.vertices(tet)) {
    const bool is_open = (mesh.shape_of(v) & (shape::kSkin | shape::kWall)) != 0;
    if (is_open && std::find(candidates_.begin(), candidates_.end(), v) == candidates_.end()) candidates_.push_back(v);
  }
}

bool Peeler::find_sides(const Care& care) {
  outer_.clear();
  inner_.clear();
  for (unsigned s = 0; s < 4; ++s) {
    (care.mesh.links(tet_)[s].is_boundary() ? outer_ : inner_).push_back(s);
  }
  const auto is_free = [&](unsigned s) { return care.may_change(std::array{care.mesh.links(tet_)[s].side().tet()}); };
  return (outer_.size() == 2 || outer_.size() == 3) && std::all_of(inner_.begin(), inner_.end(), is_free);
}

/// The surface that the new faces continue: the one with two of the old ones.
bool Peeler::find_tag(const Care& care) {
  const auto tag_of = [&](std::size_t i) { return care.mesh.links(tet_)[outer_[i]].tag(); };
  const std::uint32_t a = tag_of(0), b = tag_of(1), c = outer_.size() == 3 ? tag_of(2) : b;
  tag_ = a == b || a == c ? a : b;
  return a == b || (outer_.size() == 3 && (a == c || b == c));
}

/// Whether fronts, pinched vertices or borders between regions hold the tet in place. A front stays where neither an
/// end of its edges nor an edge between two of them goes.
bool Peeler::is_bound(const Care& care) const {
  const TetVertices& v = care.mesh.vertices(tet_);
  const auto is = [&](unsigned c, std::uint8_t bit) { return (care.mesh.shape_of(v[c]) & bit) != 0; };
  const auto fronts = is(0, shape::kFront) + is(1, shape::kFront) + is(2, shape::kFront) + is(3, shape::kFront);
  const bool holds_front = inner_.size() == 1 ? is(inner_[0], shape::kFront) : fronts > 1;
  return holds_front || is(0, shape::kPinched) || is(1, shape::kPinched) || is(2, shape::kPinched) ||
         is(3, shape::kPinched) || std::any_of(inner_.begin(), inner_.end(), [&](unsigned s) {
           return care.mesh.region(care.mesh.links(tet_)[s].side().tet()) != care.mesh.region(tet_);
         });
}

/// Whether the edge between two new faces is no boundary edge yet; a vertex with no other tets leaves with the tet.
bool Peeler::opens_manifold(Care& care) {
  if (inner_.size() == 1) {
    return true;
  }
  const TetVertices& v = care.mesh.vertices(tet_);
  const std::array<VertexId, 2> edge = {v[outer_[0]], v[outer_[1]]};
  find_edge_ring(care.mesh, edge[0], edge[1], tet_, ring_);
  return ring_.is_closed && !exists_elsewhere(care, edge, ring_.tets);
}

bool Peeler::keeps_surface(const Care& care) {
  before_.clear();
  after_.clear();
  for (const unsigned s : outer_) {
    if (care.mesh.links(tet_)[s].tag() == tag_) add_facet(care.mesh, {tet_, s}, before_);
  }
  for (const unsigned s : inner_) {
    add_facet(care.mesh, {tet_, s}, after_);
  }
  const double tolerance =
      surface_tolerance(care, tag_, care.mesh.vertices(tet_)[outer_[0]], longest_length(care.mesh, tet_));
  Reach reach;
  return care.references.allows(tag_, before_, after_, tolerance, reach, skin_share(care));
}

/// Whether a spike that a cut made ends with the tet, so thin that its walls may give way to each other: its foot is
/// short, and less high than both walls together may leave their place. What comes to light there continues the
/// largest.
bool Peeler::ends_in_spike(const Care& care) {
  if (inner_.size() != 1) {
    return false;
  }
  const TetMesh& mesh = care.mesh;
  const auto area2_of = [&](unsigned s) { return vector_area2(mesh, {tet_, s}).squaredNorm(); };
  const unsigned widest = *std::max_element(outer_.begin(), outer_.end(),
                                            [&](unsigned a, unsigned b) { return area2_of(a) < area2_of(b); });
  tag_ = mesh.links(tet_)[widest].tag();
  if (tag_ == 0) {
    return false;
  }
  const auto foot = mesh.vertices(Side(tet_, inner_[0]));
  double longest2 = 0;
  for (unsigned k = 0; k < 3; ++k) {
    longest2 = std::max(longest2, (mesh.rest(foot[k]) - mesh.rest(foot[(k + 1) % 3])).squaredNorm());
  }
  const double edge = longest_length(mesh, tet_), height2 = area2_of(inner_[0]) / longest2;
  return longest2 <= kShort * kShort * edge * edge &&
         height2 <= std::pow(2.0 * surface_tolerance(care, tag_, foot[0], edge), 2);
}

/// The step of a vertex that restores the volume: of the surface that is continued, or of all that is open around a
/// vertex at a spike; of each region where there are others than the tet's.
bool Peeler::find_volume_step(const Care& care, VertexId vertex, Vec3& step) const {
  const auto is_own = [&](TetId tet) { return care.mesh.region(tet) == care.mesh.region(tet_); };
  if (!std::all_of(star_.begin(), star_.end(), is_own)) {
    return find_step_of_regions(care, vertex, step);
  }
  return is_spike_ ? find_step_at_spike(care, vertex, step) : find_step_of_surface(care.mesh, vertex, step);
}

bool Peeler::find_step_at_spike(const Care& care, VertexId vertex, Vec3& step) const {
  const TetMesh& mesh = care.mesh;
  const Side foot(tet_, inner_[0]);
  const auto corners = mesh.vertices(foot);
  const bool is_at_foot = std::find(corners.begin(), corners.end(), vertex) != corners.end();
  Vec3 area2 = is_at_foot ? Vec3(-vector_area2(mesh, foot)) : Vec3(Vec3::Zero());
  double scale = area2.norm();
  for (const TetId tet : star_) {
    for (unsigned s = 0; s < 4; ++s) {
      if (tet == tet_ || mesh.vertices(tet)[s] == vertex || !mesh.links(tet)[s].is_boundary()) {
        continue;
      }
      const Vec3 more = vector_area2(mesh, {tet, s});
      area2 += more;
      scale += more.norm();
    }
  }
  if (!(area2.norm() > kLeastArea * scale)) {
    return false;
  }
  step = (mesh.rest_volume6(tet_) / area2.squaredNorm()) * area2;
  return step.norm() <= kSlack * surface_tolerance(care, tag_, vertex, longest_length(mesh, tet_));
}

bool Peeler::find_step_of_surface(const TetMesh& mesh, VertexId vertex, Vec3& step) const {
  return v0::find_volume_step(surfaces_without(mesh, vertex), {mesh.rest_volume6(tet_), 0.0}, step);
}

/// Other regions, and borders with them, stay as they are; so do other surfaces that stand there.
bool Peeler::find_step_of_regions(const Care& care, VertexId vertex, Vec3& step) const {
  const TetMesh& mesh = care.mesh;
  RegionVolumes volumes;
  volumes.lose(mesh.region(tet_), mesh.rest_volume6(tet_));
  for (const TetId tet : star_) {
    if (tet != tet_) add_tet(volumes, mesh, tet, vertex);
  }
  if (!is_spike_) {
    const VertexSurfaces surfaces = surfaces_without(mesh, vertex);
    if (surfaces.count > 2) return false;
    for (unsigned i = 0; i < surfaces.count; ++i) {
      const SurfaceAt& surface = surfaces.surfaces[i];
      if (surface.tag != kBorderTag) volumes.add_surface(surface.vector_area, i == 0 ? mesh.rest_volume6(tet_) : 0.0);
    }
  }
  return volumes.find_step(step) &&
         step.norm() <= kSlack * surface_tolerance(care, tag_, vertex, longest_length(mesh, tet_));
}

/// The surfaces at a vertex once the tet is gone: first the one that its inner sides continue.
VertexSurfaces Peeler::surfaces_without(const TetMesh& mesh, VertexId vertex) const {
  VertexSurfaces surfaces;
  for (const unsigned s : inner_) {
    if (mesh.vertices(tet_)[s] != vertex) {
      add_face(surfaces, tag_, -vector_area2(mesh, {tet_, s}));
    }
  }
  for (const TetId tet : star_) {
    for (unsigned s = 0; s < 4; ++s) {
      const std::int64_t tag = tet == tet_ || mesh.vertices(tet)[s] == vertex ? -1 : surface_tag(mesh, {tet, s});
      if (tag >= 0) {
        add_face(surfaces, static_cast<std::uint32_t>(tag), vector_area2(mesh, {tet, s}));
      }
    }
  }
  return surfaces;
}

/// Where a vertex must go to restore the volume; false where that makes the worst tet no better.
bool Peeler::find_step(Care& care, VertexId vertex, Vec3& place) {
  const TetMesh& mesh = care.mesh;
  star_ = care.walker.star(mesh, vertex);
  Vec3 step;
  if (!care.may_change(star_) || !find_volume_step(care, vertex, step)) {
    return false;
  }
  place = mesh.rest(vertex) + step;
  const double before = std::min(worst_of(care, star_), inradius_ratio(mesh, mesh.vertices(tet_)));
  const double bound = std::max(before * (1.0 + kLeastGain), kLeastRatio);
  care.spend(star_.size());
  const double edge = longest_length(mesh, tet_);
  if ((mesh.shape_of(vertex) & shape::kSkin) != 0 &&
      !care.references.allows_apex(0, mesh.rest(vertex), place, skin_tolerance(care) * edge, edge, skin_share(care))) {
    return false;
  }
  std::erase(star_, tet_);
  return may_move(mesh, vertex, place, star_) && std::all_of(star_.begin(), star_.end(), [&](TetId tet) {
           return inradius_ratio_with(mesh, tet, vertex, place) > bound;
         });
}

/// The tet behind one of its sides takes its material.
void Peeler::take_away(Care& care) {
  const TetMesh& mesh = care.mesh;
  const TetVertices corners = mesh.vertices(tet_);
  const TetId heir = mesh.links(tet_)[inner_[0]].side().tet();
  plan_.consumed.assign({heir, tet_});
  plan_.produced.assign({{mesh.vertices(heir), 0}});
  plan_.tag = tag_;
  for (const VertexId v : corners) {
    if (mesh.tet_of(v) == tet_) {
      const std::vector<TetId>& star = care.walker.star(mesh, v);
      const auto other = std::find_if(star.begin(), star.end(), [&](TetId tet) { return tet != tet_; });
      if (other != star.end()) care.transaction.set_tet_of(v, *other);
    }
  }
  apply(care.transaction, plan_, produced_);
  for (const VertexId v : corners) {
    if (!mesh.is_live(mesh.tet_of(v))) {
      care.transaction.remove_vertex(v);
      continue;
    }
    const std::uint8_t bits = shape_by_faces(mesh, v, care.walker.star(mesh, v));
    if (bits != mesh.shape_of(v)) {
      care.transaction.set_shape(v, bits);
    }
  }
  ++care.statistics.peeled_tets;
}

}  // namespace v0
}  // namespace incise
