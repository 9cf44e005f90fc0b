// SPDX-License-Identifier: Apache-2.0
// The energy of a star with value, gradient and Hessian in a few operations for each tet, minimised by Newton steps
// within the vertex's surfaces; what it proposes is judged by L/r (docs/internals.md, 3.13).
#include "improve/smooth.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "improve/constants.h"
#include "incise/geom/predicates.h"
#include "incise/geom/quality.h"
#include "incise/mesh/edge_length.h"

namespace incise {
inline namespace v0 {

namespace {

/// The part of a step that the vertex may take.
Vec3 restrict_step(const Vec3& step, const VertexSurfaces& surfaces) {
  switch (surfaces.mobility) {
    case Mobility::kFree:
      return step;
    case Mobility::kSurface:
      return step - surfaces.along.dot(step) * surfaces.along;
    case Mobility::kLine:
      return surfaces.along.dot(step) * surfaces.along;
    case Mobility::kFixed:
      break;
  }
  return Vec3::Zero();
}

}  // namespace

Vec3 newton_step(const StarEnergy::Value& value, const VertexSurfaces& surfaces) {
  Eigen::Matrix3d hessian = value.hessian;
  Vec3 gradient = value.gradient;
  if (surfaces.mobility == Mobility::kLine) {
    const Vec3& u = surfaces.along;
    return -(gradient.dot(u) / u.dot(hessian * u)) * u;
  }
  if (surfaces.mobility == Mobility::kSurface) {
    // Solved with the normal's row and column replaced: H' = P H P + s n nᵀ, P = 1 − n nᵀ.
    const Vec3& n = surfaces.along;
    const Eigen::Matrix3d project = Eigen::Matrix3d::Identity() - n * n.transpose();
    const double scale = hessian.trace();
    hessian = project * hessian * project + scale * n * n.transpose();
    gradient = project * gradient;
  }
  return restrict_step(-hessian.llt().solve(gradient), surfaces);
}

void StarEnergy::add(const Vec3& p, const Vec3& q, const Vec3& r) {
  const Vec3 normal = (q - p).cross(r - p), centroid = (p + q + r) / 3.0;
  const double sides2 = (q - p).squaredNorm() + (r - p).squaredNorm() + (r - q).squaredNorm();
  // Σ |x − pᵢ|² = 3 |x − c|² + Σ |pᵢ − c|², and the last sum is a third of the sides'.
  faces_.push_back({normal, normal.dot(p), centroid, sides2 + sides2 / 3.0});
}

double StarEnergy::energy(const Vec3& centre) const {
  double sum = 0;
  for (const Face& face : faces_) {
    const double volume6 = face.normal.dot(centre) - face.offset;
    if (!(volume6 > 0)) {
      return std::numeric_limits<double>::infinity();
    }
    const double sides2 = 3.0 * (centre - face.centroid).squaredNorm() + face.constant;
    const double ratio = sides2 * sides2 * sides2 / (volume6 * volume6);
    sum += ratio * ratio;
  }
  return sum;
}

StarEnergy::Value StarEnergy::evaluate(const Vec3& centre) const {
  Value value;
  for (const Face& face : faces_) {
    const double volume6 = face.normal.dot(centre) - face.offset;
    const Vec3 arm = centre - face.centroid;
    const double sides2 = 3.0 * arm.squaredNorm() + face.constant;
    const double ratio = sides2 * sides2 * sides2 / (volume6 * volume6), energy = ratio * ratio;
    // log E = 6 log S − 4 log V; of its Hessian the negative part is left out.
    const Vec3 by_volume = face.normal / volume6;
    const Vec3 gradient = (36.0 / sides2) * arm - 4.0 * by_volume;
    value.energy += energy;
    value.gradient += energy * gradient;
    value.hessian += energy * (gradient * gradient.transpose() + 4.0 * by_volume * by_volume.transpose());
    value.hessian.diagonal().array() += energy * 36.0 / sides2;
  }
  return value;
}

bool move_vertex(Care& care, VertexId vertex, const Vec3& place, const std::vector<TetId>& star) {
  if (!may_move(care.mesh, vertex, place, star)) {
    return false;
  }
  const MaterialPoint point = locate(care.mesh, place, star);
  care.transaction.move(vertex, place, point.basis, point.weights);
  ++care.statistics.moved_vertices;
  return true;
}

bool Smoother::improve(Care& care, VertexId vertex) {
  star_ = care.walker.star(care.mesh, vertex);
  if (!care.may_change(star_)) {
    return false;
  }
  surfaces_ = surfaces_at(care.mesh, vertex, star_);
  if (surfaces_.mobility == Mobility::kFixed) {
    return false;
  }
  const double before = worst_of(care, star_);
  if (!(before > 0)) {
    return false;
  }
  collect(care, vertex);
  const Vec3 start = care.mesh.rest(vertex), step = find_place(care, vertex) - start;
  const double bound = std::max(before * (1.0 + kLeastSmoothingGain), kLeastRatio);
  const unsigned attempts = care.is_bad && is_curved() ? kShortenings + 1 : 1;
  double share = 1.0;
  for (unsigned i = 0; i < attempts && !step.isZero(0.0); ++i, share *= 0.5) {
    const Vec3 place = start + share * step;
    if (worst_at(care, vertex, place, bound) > bound && keeps_surfaces(care, vertex, place)) {
      care.changed = star_;
      return move_vertex(care, vertex, place, star_);
    }
  }
  return false;
}

void Smoother::collect(const Care& care, VertexId vertex) {
  energy_.clear();
  for (const TetId tet : star_) {
    // Seen from outside the side turns counter-clockwise: its normal points away from the centre.
    const auto [p, q, r] = care.mesh.vertices(Side(tet, care.mesh.corner_of(tet, vertex)));
    energy_.add(care.mesh.rest(p), care.mesh.rest(r), care.mesh.rest(q));
  }
}

Vec3 Smoother::find_place(Care& care, VertexId vertex) const {
  Vec3 place = care.mesh.rest(vertex);
  for (unsigned i = 0; i < kMaxSteps; ++i) {
    const StarEnergy::Value here = energy_.evaluate(place);
    care.spend(energy_.size() / 2);
    if (!(here.energy < std::numeric_limits<double>::infinity())) {
      return care.mesh.rest(vertex);
    }
    Vec3 step = newton_step(here, surfaces_);
    double reached = energy_.energy(place + step);
    for (unsigned k = 0; k < kMaxHalvings && !(reached < here.energy); ++k) {
      step *= 0.5;
      reached = energy_.energy(place + step);
      care.spend(energy_.size() / 4);
    }
    if (!(reached < here.energy)) {
      break;
    }
    place += step;
    if (reached > (1.0 - kLeastDescent) * here.energy) {
      break;
    }
  }
  return place;
}

double Smoother::worst_at(Care& care, VertexId vertex, const Vec3& place, double bound) const {
  double worst = 2.0;
  for (const TetId tet : star_) {
    worst = std::min(worst, inradius_ratio_with(care.mesh, tet, vertex, place));
    care.spend(1);
    if (!(worst > bound)) {
      break;
    }
  }
  return worst;
}

/// Whether the boundary around the vertex stays where it is, within the tolerance; in a plane it does by itself.
bool Smoother::keeps_surfaces(const Care& care, VertexId vertex, const Vec3& place) {
  if (!is_curved()) {
    return true;
  }
  const double edge = mean_edge_length_by_tets(care.mesh, vertex, star_);
  const double slack = skin_tolerance(care) * edge;
  if (surfaces_.is_front() && !(keeps_front(care.mesh, care.mesh.rest(vertex), surfaces_, slack) &&
                                keeps_front(care.mesh, place, surfaces_, slack))) {
    return false;
  }
  for (unsigned i = 0; i < surfaces_.count; ++i) {
    const SurfaceAt& surface = surfaces_.surfaces[i];
    if (surface.is_flat) {
      continue;
    }
    collect_pieces(care, vertex, place, i);
    const double tolerance = surface_tolerance(care, surface.tag, vertex, mean_spoke(before_));
    Reach apex_reach, reach;
    const Piece apex_before{before_.facets, {care.mesh.rest(vertex)}}, apex_after{after_.facets, {place}};
    if (!care.references.allows(surface.tag, apex_before, apex_after, tolerance, apex_reach, skin_share(care)) ||
        !care.references.allows(surface.tag, before_, after_, tolerance, reach, skin_share(care))) {
      return false;
    }
  }
  return true;
}

/// The faces of one surface around the vertex, before and after its move. They differ most at the vertex, which is
/// looked at by itself, and along the edges that lead to it.
void Smoother::collect_pieces(const Care& care, VertexId vertex, const Vec3& place, unsigned surface) {
  const std::uint32_t tag = surfaces_.surfaces[surface].tag;
  const Vec3 old_place = care.mesh.rest(vertex);
  before_.clear();
  after_.clear();
  for (const TetId tet : star_) {
    for (unsigned s = 0; s < 4; ++s) {
      const std::int64_t at = care.mesh.vertices(tet)[s] == vertex ? -1 : surface_tag(care.mesh, {tet, s});
      if (at < 0) continue;
      const auto own = static_cast<std::uint32_t>(at);
      if (own != tag && surfaces_.find(own, vector_area2(care.mesh, {tet, s}).normalized()) != surface) continue;
      const auto v = care.mesh.vertices(Side(tet, s));
      const auto centre = static_cast<std::size_t>(std::find(v.begin(), v.end(), vertex) - v.begin());
      const Vec3 &p = care.mesh.rest(v[(centre + 1) % 3]), &q = care.mesh.rest(v[(centre + 2) % 3]);
      before_.facets.push_back({old_place, p, q});
      before_.samples.push_back(0.5 * (old_place + p));
      after_.facets.push_back({place, p, q});
      after_.samples.push_back(0.5 * (place + p));
    }
  }
}

}  // namespace v0
}  // namespace incise
