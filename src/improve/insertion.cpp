// SPDX-License-Identifier: Apache-2.0
// A cavity grows tet by tet across the face of its worst new tet, while the vertex follows the least energy; the best
// cavity seen is carried out as one remesh plan (docs/internals.md, 3.13).
#include "improve/insertion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/constants.h"
#include "improve/constants.h"
#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {

namespace {

/// Whether the input folds over at a face: tets on either side may overlap.
bool is_pinched(const TetMesh& mesh, Side side) {
  const auto v = mesh.vertices(side);
  return (mesh.shape_of(v[0]) & mesh.shape_of(v[1]) & mesh.shape_of(v[2]) & shape::kPinched) != 0;
}

bool contains(const std::vector<TetId>& tets, TetId tet) {
  return std::find(tets.begin(), tets.end(), tet) != tets.end();
}

}  // namespace

bool VertexInserter::improve(Care& care, TetId tet) {
  const TetVertices v = care.mesh.vertices(tet);
  return improve_inside(care, tet) || std::any_of(kEdgeCorners.begin(), kEdgeCorners.end(), [&](const auto& edge) {
           return improve_at_edge(care, tet, v[edge[0]], v[edge[1]]);
         });
}

bool VertexInserter::improve_inside(Care& care, TetId tet) {
  opened_.is_surface = false;
  cavity_.assign({tet});
  place_ = Vec3::Zero();
  for (const VertexId v : care.mesh.vertices(tet)) place_ += 0.25 * care.mesh.rest(v);
  return search(care);
}

bool VertexInserter::improve_at_edge(Care& care, TetId tet, VertexId a, VertexId b) {
  constexpr unsigned kOnSurface = shape::kSkin | shape::kWall;
  if ((care.mesh.shape_of(a) & care.mesh.shape_of(b) & kOnSurface) == 0) {
    return false;
  }
  find_edge_ring(care.mesh, a, b, tet, ring_);
  if (ring_.is_closed || ring_.tets.empty() || !open_edge(care, a, b)) {
    return false;
  }
  if (!care.may_change(ring_.tets)) {
    return false;
  }
  cavity_ = ring_.tets;
  place_ = 0.5 * (care.mesh.rest(a) + care.mesh.rest(b));
  return search(care);
}

/// Finds the boundary faces at an edge; false where they are no smooth surface, or the tets around have two regions.
bool VertexInserter::open_edge(const Care& care, VertexId a, VertexId b) {
  const TetMesh& mesh = care.mesh;
  const std::size_t last = ring_.tets.size() - 1;
  const Side first(ring_.tets.front(), mesh.corner_of(ring_.tets.front(), ring_.vertices[1]));
  const Side second(ring_.tets.back(), mesh.corner_of(ring_.tets.back(), ring_.vertices[last]));
  const Vec3 n = vector_area2(mesh, first), m = vector_area2(mesh, second);
  const double least = least_cosine(mesh.link(first).tag(), mesh.link(second).tag());
  if (!(n.dot(m) > least * n.norm() * m.norm()) || !has_one_region(mesh, ring_.tets) ||
      (mesh.shape_of(a) & mesh.shape_of(b) & shape::kFront) != 0) {
    return false;
  }
  opened_ = {true, mesh.link(first).tag(), {first, second}, {mesh.rest(a), mesh.rest(b)}, (n + m).normalized(), {}};
  for (const Side side : opened_.faces) {
    const auto v = mesh.vertices(side);
    opened_.piece.facets.push_back({mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2])});
    opened_.piece.samples.push_back((mesh.rest(v[0]) + mesh.rest(v[1]) + mesh.rest(v[2])) / 3.0);
  }
  return true;
}

/// Grows the cavity from what it holds and takes the best one.
bool VertexInserter::search(Care& care) {
  best_gain_ = 1.0 + kLeastInsertionGain;
  best_cavity_.clear();
  before_ = worst_of(care, cavity_);
  do {
    collect_bases(care);
    find_place(care);
    keep_best(rate(care));
  } while (cavity_.size() < kMostTets && grow(care));
  return !best_cavity_.empty() && carry_out(care);
}

void VertexInserter::collect_bases(const Care& care) {
  bases_.clear();
  energy_.clear();
  for (const TetId tet : cavity_) {
    for (unsigned s = 0; s < 4; ++s) {
      const Side side(tet, s);
      const Link link = care.mesh.link(side);
      const bool is_inside = link.is_boundary()
                                 ? opened_.is_surface && (side == opened_.faces[0] || side == opened_.faces[1])
                                 : contains(cavity_, link.side().tet());
      if (is_inside) {
        continue;
      }
      bases_.push_back({side, 0.0});
      const auto [p, q, r] = care.mesh.vertices(side);
      energy_.add(care.mesh.rest(p), care.mesh.rest(r), care.mesh.rest(q));
    }
  }
}

/// The Newton step; on a surface orthogonal to the vector area of what it replaces, which keeps the volume.
Vec3 VertexInserter::newton_step(const StarEnergy::Value& here) const {
  VertexSurfaces surfaces;
  if (opened_.is_surface) {
    surfaces.mobility = Mobility::kSurface;
    surfaces.along = opened_.normal;
  }
  return incise::newton_step(here, surfaces);
}

/// Newton steps from where the vertex is; where it does not see all faces it stays.
void VertexInserter::find_place(Care& care) {
  double reached = energy_.energy(place_);
  for (unsigned i = 0; i < kNewtonSteps && reached < std::numeric_limits<double>::infinity(); ++i) {
    const StarEnergy::Value here = energy_.evaluate(place_);
    Vec3 step = newton_step(here);
    double next = energy_.energy(place_ + step);
    for (unsigned k = 0; k < 4 && !(next < reached); ++k) {
      step *= 0.5;
      next = energy_.energy(place_ + step);
    }
    care.spend(bases_.size());
    if (!(next < reached)) {
      break;
    }
    place_ += step;
    reached = next;
  }
}

/// The worst of the tets that the vertex makes with the cavity's faces.
double VertexInserter::rate(Care& care) {
  double worst = 2.0;
  for (Base& base : bases_) {
    const auto [p, q, r] = care.mesh.vertices(base.side);
    base.ratio = inradius_ratio(care.mesh.rest(p), care.mesh.rest(r), care.mesh.rest(q), place_);
    worst = std::min(worst, base.ratio);
  }
  care.spend(bases_.size());
  return worst;
}

void VertexInserter::keep_best(double worst) {
  if (worst > kLeastRatio && worst > best_gain_ * before_) {
    best_gain_ = worst / before_;
    best_before_ = before_;
    best_cavity_ = cavity_;
    best_place_ = place_;
  }
}

/// Takes the tet behind the worst face in, if there is one that may be.
bool VertexInserter::grow(Care& care) {
  const Base* worst = nullptr;
  for (const Base& base : bases_) {
    const Link link = care.mesh.link(base.side);
    const bool may_grow = !link.is_boundary() &&
                          care.mesh.region(link.side().tet()) == care.mesh.region(base.side.tet()) &&
                          !care.mesh.is_flat_at_load(link.side().tet()) && !is_pinched(care.mesh, base.side) &&
                          care.may_change(std::array{link.side().tet()});
    if (may_grow && (worst == nullptr || base.ratio < worst->ratio)) {
      worst = &base;
    }
  }
  if (worst == nullptr) {
    return false;
  }
  const TetId next = care.mesh.link(worst->side).side().tet();
  before_ = std::min(before_, inradius_ratio(care.mesh, care.mesh.vertices(next)));
  cavity_.push_back(next);
  return true;
}

/// Whether the surface stays in place; in a plane it does by itself.
bool VertexInserter::keeps_surface(const Care& care) {
  if (!opened_.is_surface) {
    return true;
  }
  piece_.clear();
  piece_.samples.push_back(place_);
  double longest2 = 0;
  for (const Facet& f : opened_.piece.facets) {
    for (unsigned k = 0; k < 3; ++k) {
      longest2 = std::max(longest2, (f[k] - f[(k + 1) % 3]).squaredNorm());
      piece_.samples.push_back(0.5 * (place_ + f[k]));
    }
  }
  const double tolerance =
      surface_tolerance(care, opened_.tag, care.mesh.vertices(opened_.faces[0])[0], std::sqrt(longest2));
  Reach reach;
  const auto area = [&](Side side) { return Vec3(vector_area2(care.mesh, side) / longest2); };
  const bool is_flat = area(opened_.faces[0]).cross(area(opened_.faces[1])).squaredNorm() <= kOnePlane * kOnePlane;
  return is_flat || care.references.allows(opened_.tag, opened_.piece, piece_, tolerance, reach, skin_share(care));
}

/// Takes a place that leaves the surface nearer to the edge opened, which lies on it.
bool VertexInserter::come_nearer(Care& care) {
  const Vec3 middle = 0.5 * (opened_.edge[0] + opened_.edge[1]), step = place_ - middle;
  for (const double share : {0.5, 0.25, 0.0}) {
    place_ = middle + share * step;
    const double worst = rate(care);
    if (worst > kLeastRatio && worst > (1.0 + kLeastInsertionGain) * best_before_ && keeps_surface(care)) return true;
  }
  return false;
}

bool VertexInserter::has_simple_hull(const TetMesh& mesh) {
  hull_.clear();
  for (const Base& base : bases_) hull_.add(mesh.vertices(base.side));
  return hull_.is_simple(opened_.is_surface);
}

/// Whether the tets around the new vertex stand upright as the mesh does, if those of the cavity do.
bool VertexInserter::stays_sound(const TetMesh& mesh, const Vec3& current) const {
  const auto is_sound = [&](TetId tet) { return is_sound_now(mesh, mesh.vertices(tet)); };
  return !std::all_of(cavity_.begin(), cavity_.end(), is_sound) ||
         std::all_of(bases_.begin(), bases_.end(), [&](const Base& base) {
           const auto [p, q, r] = mesh.vertices(base.side);
           return signed_volume6(mesh.current(p), mesh.current(r), mesh.current(q), current) > 0;
         });
}

bool VertexInserter::carry_out(Care& care) {
  cavity_ = best_cavity_;
  place_ = best_place_;
  collect_bases(care);
  if (!keeps_surface(care) && !come_nearer(care)) {
    return false;
  }
  const MaterialPoint point = locate(care.mesh, place_, cavity_);
  const Vec3 current = current_at(care.mesh, point);
  if (!has_simple_hull(care.mesh) || !stays_sound(care.mesh, current)) {
    return false;
  }
  const VertexId vertex = care.transaction.add_vertex(point.basis, point.weights, place_, current);
  plan_.consumed = cavity_;
  plan_.produced.clear();
  for (const Base& base : bases_) {
    const auto [p, q, r] = care.mesh.vertices(base.side);
    const auto parent = std::find(cavity_.begin(), cavity_.end(), base.side.tet()) - cavity_.begin();
    plan_.produced.push_back({{p, r, q, vertex}, static_cast<std::uint32_t>(parent)});
  }
  plan_.born = vertex;
  plan_.tag = opened_.tag;
  if (opened_.is_surface) {
    care.transaction.set_shape(vertex, opened_.tag == 0 ? shape::kSkin : shape::kWall);
  }
  enclosed_.clear();
  for (const TetId tet : cavity_) {
    enclosed_.insert(enclosed_.end(), care.mesh.vertices(tet).begin(), care.mesh.vertices(tet).end());
  }
  apply(care.transaction, plan_, care.changed);
  for (const VertexId v : enclosed_) {
    if (care.mesh.is_live(v) && !care.mesh.is_live(care.mesh.tet_of(v))) {
      care.transaction.remove_vertex(v);  // the cavity held all its tets
    }
  }
  care.born = vertex;
  ++care.statistics.inserted_vertices;
  return true;
}

}  // namespace v0
}  // namespace incise
