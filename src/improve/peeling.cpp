// SPDX-License-Identifier: Apache-2.0
#include "improve/peeling.h"

#include <algorithm>
#include <cmath>

#include "improve/edge_removal.h"
#include "improve/smooth.h"

namespace incise {
inline namespace v0 {

namespace {

/// The boundary bits that a vertex has by its faces; the others stay.
std::uint8_t bits_of(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star) {
  unsigned bits = mesh.shape_of(vertex) & ~unsigned{shape::kSkin | shape::kWall};
  for (const TetId tet : star) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (mesh.vertices(tet)[s] != vertex && link.is_boundary()) {
        bits |= link.tag() == 0 ? shape::kSkin : shape::kWall;
      }
    }
  }
  return static_cast<std::uint8_t>(bits);
}

void add_facet(const TetMesh& mesh, Side side, Piece& piece) {
  const auto v = mesh.vertices(side);
  const Facet f = {mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2])};
  piece.facets.push_back(f);
  piece.samples.push_back((f[0] + f[1] + f[2]) / 3.0);
  for (unsigned k = 0; k < 3; ++k) {
    piece.samples.push_back(0.5 * (f[k] + f[(k + 1) % 3]));
  }
}

double longest_edge(const TetMesh& mesh, TetId tet) {
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
  if (!find_sides(care) || !find_tag(care) || is_bound(care) || !opens_manifold(care) || !keeps_surface(care)) {
    return false;
  }
  const TetVertices vertices = care.mesh.vertices(tet);
  for (const VertexId vertex : vertices) {
    Vec3 place;
    const bool stays = inner_.size() == 2 || vertex != vertices[inner_[0]];
    if (stays && find_step(care, vertex, place)) {
      take_away(care);
      star_ = care.walker.star(care.mesh, vertex);
      move_vertex(care, vertex, place, star_);
      care.changed = star_;
      return true;
    }
  }
  return false;
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

/// Whether fronts, pinched vertices or borders between regions hold the tet in place.
bool Peeler::is_bound(const Care& care) const {
  const TetVertices& v = care.mesh.vertices(tet_);
  return std::any_of(v.begin(), v.end(),
                     [&](VertexId id) { return (care.mesh.shape_of(id) & (shape::kFront | shape::kPinched)) != 0; }) ||
         std::any_of(inner_.begin(), inner_.end(), [&](unsigned s) {
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
      surface_tolerance(care, tag_, care.mesh.vertices(tet_)[outer_[0]], longest_edge(care.mesh, tet_));
  Reach reach;
  return care.references.allows(tag_, before_, after_, tolerance, reach, skin_share(care));
}

/// Where a vertex must go to restore the volume; false where that makes the worst tet no better.
bool Peeler::find_step(Care& care, VertexId vertex, Vec3& place) {
  const TetMesh& mesh = care.mesh;
  star_ = care.walker.star(mesh, vertex);
  if (!care.may_change(star_)) {
    return false;
  }
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
  Vec3 step;
  if (!find_volume_step(surfaces, {mesh.rest_volume6(tet_), 0.0}, step)) {
    return false;
  }
  place = mesh.rest(vertex) + step;
  const double bound = std::max(worst_of(care, star_) * (1.0 + kLeastGain), kLeastRatio);
  care.spend(star_.size());
  const double edge = longest_edge(mesh, tet_);
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
    const std::uint8_t bits = bits_of(mesh, v, care.walker.star(mesh, v));
    if (bits != mesh.shape_of(v)) {
      care.transaction.set_shape(v, bits);
    }
  }
  ++care.statistics.peeled_tets;
}

}  // namespace v0
}  // namespace incise
