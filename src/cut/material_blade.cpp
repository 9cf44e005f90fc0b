// SPDX-License-Identifier: Apache-2.0
// A point in tissue is found by walking through tets as they stand, and taken to rest by its tet's map; one outside
// goes by its neighbours and the surface. It moves on only ahead of its tip (docs/internals.md, 3.11).
#include "cut/material_blade.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cut/blade_constants.h"
#include "cut/contact_walk.h"
#include "cut/far_blade.h"
#include "cut/twist.h"
#include "incise/geom/quality.h"
#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {

namespace {

using Corners = std::array<Vec3, 4>;

Corners current_of(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  return {mesh.current(v[0]), mesh.current(v[1]), mesh.current(v[2]), mesh.current(v[3])};
}
Corners rest_of(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  return {mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])};
}

/// Barycentric coordinates; false where the tet has next to no volume as it stands.
bool weights_in(const Corners& p, const Vec3& x, std::array<double, 4>& weights) {
  const double whole = signed_volume6(p[0], p[1], p[2], p[3]);
  const double size = std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[0]).squaredNorm(), (p[3] - p[0]).squaredNorm()});
  if (!(std::abs(whole) > 1e-9 * size * std::sqrt(size))) return false;
  weights = {signed_volume6(x, p[1], p[2], p[3]) / whole, signed_volume6(p[0], x, p[2], p[3]) / whole,
             signed_volume6(p[0], p[1], x, p[3]) / whole, signed_volume6(p[0], p[1], p[2], x) / whole};
  return true;
}

Vec3 blend(const Corners& p, const std::array<double, 4>& weights) {
  return weights[0] * p[0] + weights[1] * p[1] + weights[2] * p[2] + weights[3] * p[3];
}

Vec3 shortened(const Vec3& way, double most) {
  const double length = way.norm();
  return length > most ? Vec3((most / length) * way) : way;
}

/// The weights of the tet's own place that is taken for the nearest to one with these weights.
std::array<double, 4> drawn_in(std::array<double, 4> weights) {
  double sum = 0;
  for (double& w : weights) sum += w = std::max(w, 0.0);
  for (double& w : weights) w /= sum;
  return weights;
}

/// Takes a place from one shape of a tet to the other as its map does. Of a place outside the tet the map tells no more
/// than the direction, and that material stretches a little: a tet that is nearly flat would take it anywhere.
Vec3 taken(const Corners& from, const Corners& to, const std::array<double, 4>& weights) {
  const Vec3 place = blend(to, weights);
  if (*std::min_element(weights.begin(), weights.end()) >= 0) return place;
  const std::array<double, 4> inner = drawn_in(weights);
  const Vec3 start = blend(to, inner), way = place - start;
  const double most = kGreatestStretch * (blend(from, weights) - blend(from, inner)).norm(), length = way.norm();
  return length > most ? Vec3(start + (most / length) * way) : place;
}

/// A place as the body stands, taken to the rest shape as a tet's own map does; `x` where it has none.
Vec3 to_rest(const TetMesh& mesh, TetId tet, const Vec3& x, bool& is_possible) {
  std::array<double, 4> weights{};
  const Corners current = current_of(mesh, tet);
  is_possible = weights_in(current, x, weights);
  return is_possible ? taken(current, rest_of(mesh, tet), weights) : x;
}

/// Walks through tets as they stand towards a place; the tet that holds it, or none where the walk leaves the body.
TetId walk_to(const TetMesh& mesh, TetId from, const Vec3& x) {
  TetId tet = from, before;
  for (unsigned count = 0; count < kMostWalkedTets && tet.is_valid() && mesh.is_live(tet); ++count) {
    std::array<double, 4> weights{};
    if (!weights_in(current_of(mesh, tet), x, weights)) return {};
    std::array<unsigned, 4> order = {0, 1, 2, 3};
    std::sort(order.begin(), order.end(),
              [&](unsigned a, unsigned b) { return weights[a] != weights[b] ? weights[a] < weights[b] : a < b; });
    if (weights[order[0]] >= 0) return tet;
    TetId next;
    for (const unsigned s : order) {
      const Link link = mesh.links(tet)[s];
      if (weights[s] >= 0) break;
      if (link.is_boundary() || link.side().tet() == before) continue;
      next = link.side().tet();
      break;
    }
    before = tet;
    tet = next;
  }
  return {};
}

/// How far a place is from a tet as that stands; far where the tet has next to no volume.
double distance_from(const TetMesh& mesh, TetId tet, const Vec3& x) {
  std::array<double, 4> weights{};
  const Corners current = current_of(mesh, tet);
  return weights_in(current, x, weights) ? (x - blend(current, drawn_in(weights))).norm() : 1e300;
}

/// Of what the maps of some tets say of a place, what the nearest of them says.
struct NearestMap {
  TetId tet;
  Vec3 rest = Vec3::Zero();
  double distance = 1e300;

  void see(TetId seen, const Vec3& mapped, double away) {
    if (away < distance) *this = {seen, mapped, away};
  }
};

/// The boundary side nearest to a rest point, and its nearest point.
Side nearest_side(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& rest, double spacing, Vec3& place) {
  const SurfaceIndex::Nearest nearest = surface.nearest(mesh, rest, kSurfaceReach * spacing);
  place = nearest.point;
  return nearest.side;
}

}  // namespace

/// Segments are divided evenly; long ones that leave the body's surroundings only near these.
void MaterialBlade::set_shares(const TetMesh& mesh, std::span<const Vec3> row) {
  shares_.clear();
  is_graded_ = false;
  Box near;
  for (std::size_t c = 0; c + 1 < row.size(); ++c) {
    const double parts = std::ceil((row[c + 1] - row[c]).norm() / (kPointSpacing * spacing_));
    if (parts > kManyParts && near.is_empty()) near = enlarged(current_bounds(mesh), kSurroundings);
    if (parts > kManyParts && near.distance2(row[c]) + near.distance2(row[c + 1]) > 0) {
      shares_.push_back(graded_shares(row[c], row[c + 1], kPointSpacing * spacing_, near));
      is_graded_ = true;
      continue;
    }
    const double count = std::clamp(parts, 1.0, kMostBladeParts);
    std::vector<double>& shares = shares_.emplace_back();
    for (double k = 1; k <= count; ++k) shares.push_back(k / count);
  }
}

void MaterialBlade::begin(const TetMesh& mesh, const SurfaceIndex& surface, std::span<const Vec3> row, double spacing,
                          ClosedComplex& complex) {
  spacing_ = spacing;
  course_ = Vec3::Zero();
  set_shares(mesh, row);
  const std::vector<Vec3> places = divided(row, shares_);
  points_.assign(places.size(), {});
  anchors_.resize(places.size());
  // The surface as it stands, once: the blade may come from anywhere.
  TetId nearest;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Point& point = points_[i];
    point.world = point.before = point.reached = places[i];
    point.hint = nearest.is_valid() ? nearest : surface.nearest_as_it_stands(mesh, places[i]);
    find(mesh, surface, point, places[i], /*is_expected=*/false);
    nearest = point.hint;
    anchors_[i] = point.towed = point.candidate;
    point.has_entered = point.tet.is_valid();
    // A blade that is put in place inside tissue has its tip there: without it the blade would never be ahead.
    if (point.has_entered) point.master = complex.adopt(mesh, point.tet);
  }
}

/// Finds the tet that holds a point, or the surface near it and the rest point that its map gives. Where tets name each
/// other in turn, as those of pieces that have drawn apart, a blade that is put in place (nothing `is_expected` of it)
/// goes by the one that is nearest as the body stands: the parity of rounds would choose for each point anew, and the
/// front would lie in zigzags.
void MaterialBlade::find(const TetMesh& mesh, const SurfaceIndex& surface, Point& point, const Vec3& anchor,
                         bool is_expected) {
  point.tet = {};
  const auto accept = [&](TetId tet) {
    if (!tet.is_valid()) return false;
    bool is_possible = false;
    const Vec3 rest = to_rest(mesh, tet, point.world, is_possible);
    if (!is_possible) return false;
    const bool is_nearer = !point.tet.is_valid() || (rest - anchor).norm() < (point.candidate - anchor).norm();
    if (is_nearer) {
      point.tet = point.hint = tet;
      point.candidate = rest;
    }
    return true;
  };
  if (point.hint.is_valid() && mesh.is_live(point.hint)) accept(walk_to(mesh, point.hint, point.world));
  if (point.tet.is_valid()) return;
  Vec3 rest = anchor;
  point.is_mapped = false;
  NearestMap nearest;
  bool is_settled = false;
  for (unsigned round = 0; round < kMostNearingRounds && !is_settled; ++round) {
    if (point.hint.is_valid() && mesh.is_live(point.hint)) {
      bool is_possible = false;
      const Vec3 mapped = to_rest(mesh, point.hint, point.world, is_possible);
      if (is_possible) {
        rest = mapped;
        if (!is_expected) nearest.see(point.hint, rest, distance_from(mesh, point.hint, point.world));
      }
      point.is_mapped = is_possible;
    }
    const TetId inside = incise::locate(mesh, surface, {rest, next_key_++});
    if (inside.is_valid() && accept(walk_to(mesh, inside, point.world))) return;
    Vec3 place;
    const Side side = nearest_side(mesh, surface, rest, spacing_, place);
    if (side.value != kInvalidIndex && accept(walk_to(mesh, side.tet(), point.world))) return;
    is_settled = side.value == kInvalidIndex || side.tet() == point.hint;
    if (!is_settled) point.hint = side.tet();
  }
  if (!is_settled && nearest.tet.is_valid()) {
    point.hint = nearest.tet;
    point.is_mapped = true;
    rest = nearest.rest;
  }
  point.candidate = rest;
}

void MaterialBlade::find_tip(const TetMesh& mesh, const ClosedComplex& complex, Point& point,
                             const Vec3& anchor) const {
  point.tip = point.world;
  if (!is_in_master(complex, point)) {
    point.has_entered = false;  // a new sheet has begun since it left: it goes with its neighbours again
    return;
  }
  double inside = -1e300, beyond = 0;
  for (const TetId child : complex.children(complex[point.master])) {
    std::array<double, 4> weights{};
    if (!weights_in(rest_of(mesh, child), anchor, weights)) continue;
    const double least = *std::min_element(weights.begin(), weights.end());
    if (least <= inside) continue;
    inside = least;
    const Corners rest = rest_of(mesh, child), current = current_of(mesh, child);
    point.tip = taken(rest, current, weights);
    beyond = least < 0 ? (anchor - blend(rest, drawn_in(weights))).norm() : 0.0;
    if (!point.tet.is_valid() && !mesh.is_live(point.hint)) point.hint = child;
    // The direction of cutting goes with the material.
    std::array<double, 4> ahead{};
    const Vec3 come = anchor - point.towed;
    if (!come.isZero(0.0) && weights_in(rest, anchor + come, ahead)) {
      point.direction = (taken(rest, current, ahead) - point.tip).normalized();
    }
  }
  if (beyond > kAwayFromExit * spacing_) {
    point.master = Master::kNone;
    point.has_entered = false;
  }
}

/// Whether there is tissue between the tip and the blade.
bool MaterialBlade::meets_tissue(const TetMesh& mesh, const Point& point) const {
  for (const double t : {0.15, 0.35, 0.55, 0.75, 0.95}) {
    if (walk_to(mesh, point.hint, point.tip + t * (point.world - point.tip)).is_valid()) return true;
  }
  return false;
}

/// Where the edge cuts: the way that the front has come, as the material stands now, of all of the edge that is near.
/// Single tets are bent; and what the edge slides along itself cuts nothing.
void MaterialBlade::find_directions(const Vec3& given) {
  const std::size_t last = points_.size() - 1;
  std::vector<Vec3> sums(points_.size(), Vec3::Zero());
  for (std::size_t i = 0; i <= last; ++i) {
    Point& point = points_[i];
    point.along = (points_[std::min(i + 1, last)].world - points_[i > 0 ? i - 1 : 0].world).normalized();
    const std::size_t end = std::min(i + kNearPoints, last);
    for (std::size_t k = i > kNearPoints ? i - kNearPoints : 0; k <= end; ++k) {
      if (points_[k].has_entered) sums[i] += points_[k].direction;
    }
  }
  for (std::size_t i = 0; i <= last; ++i) {
    Point& point = points_[i];
    const Vec3 way = given.isZero(0.0) ? sums[i] : given;
    const Vec3 across = way - way.dot(point.along) * point.along;
    if (point.has_entered || !given.isZero(0.0)) point.direction = across.normalized();
  }
}

/// Takes the place along that follows the anchor. A point that has just entered tissue has come as the blade moves, or
/// from where it was beside it.
void MaterialBlade::tow(const TetMesh& mesh, std::size_t point, const Vec3& step) {
  Point& p = points_[point];
  const double length = kComeLength * spacing_;
  if (!p.has_entered) {
    const Vec3 motion = shortened(p.world - p.before, kLeastMaterialStep * spacing_);
    bool is_possible = false;
    const Vec3 come = p.candidate - to_rest(mesh, p.tet, p.world - motion, is_possible);
    const Vec3& way = is_possible && come.squaredNorm() > 0 ? come : step;
    if (way.squaredNorm() > 0) p.towed = anchors_[point] - length * way.normalized();
  }
  const Vec3 behind = p.towed - anchors_[point];
  const double distance = behind.norm();
  if (distance > length) p.towed = anchors_[point] + (length / distance) * behind;
}

/// Whether the front follows a point of the blade that is so far away in the rest shape.
bool MaterialBlade::is_due(double step) const {
  const bool is_long = step >= kLeastMaterialStep * spacing_;
  return is_last_ ? !is_long && step >= kLeastLastStep * spacing_ : is_long;
}

/// Whether a point that comes into tissue stands behind the front of the one nearest to it, or beside that: there the
/// blade has cut, or waits.
bool MaterialBlade::is_behind_others(std::size_t i) const {
  const Point& point = points_[i];
  const Point* leader = nullptr;
  for (std::size_t apart = 1; apart <= kNearPoints && leader == nullptr; ++apart) {
    if (i >= apart && points_[i - apart].has_entered) leader = &points_[i - apart];
    if (i + apart < points_.size() && points_[i + apart].has_entered) leader = &points_[i + apart];
  }
  if (leader == nullptr || leader->direction.isZero(0.0)) return false;
  const Vec3 way = point.world - leader->tip, across = way - way.dot(point.along) * point.along;
  const double lead = across.dot(leader->direction), beside = (across - lead * leader->direction).norm();
  return lead < kCone * beside - kLeastMaterialStep * spacing_;
}

void MaterialBlade::judge(const TetMesh& mesh, const SurfaceIndex& surface, std::size_t i) {
  Point& point = points_[i];
  const Vec3& anchor = anchors_[i];
  point.is_accepted = false;
  if (!point.has_entered && !point.tet.is_valid()) return;  // follows one that has
  const Vec3 way = point.world - point.tip, across = way - way.dot(point.along) * point.along;
  const double length = point.direction.norm();
  point.lead = length > 0 ? way.dot(point.direction) / length : way.norm();
  const double beside = length > 0 ? (across - point.lead * point.direction / length).norm() : 0.0;
  const bool is_ahead = point.lead > kCone * beside;
  if (point.tet.is_valid()) {
    const bool is_new = !point.has_entered && !is_behind_others(i);
    const double step = (point.candidate - anchor).norm();
    const bool is_likely = step <= kGreatestStretch * way.norm() + kTrust * spacing_;  // else found in another part
    point.is_accepted = is_new || (is_ahead && is_likely && is_due(step));
    return;
  }
  if (!is_ahead || !(point.lead > kExitLead * spacing_ || meets_tissue(mesh, point))) return;
  // It has left the body: the cut goes straight on, unless the map of the surface there says much the same.
  if (!course_.isZero(0.0)) {
    const Vec3 straight = anchor + point.lead * course_;
    if ((point.candidate - straight).norm() > kTrust * spacing_) point.candidate = straight;
  }
  const bool was_inside =
      incise::locate(mesh, surface, {anchor, next_key_++}).is_valid() || lies_in_cut(mesh, surface, anchor);
  const Vec3 straight = point.candidate;
  point.is_accepted =
      was_inside ? push_out(mesh, surface, anchor, point.candidate) : keep_out(mesh, surface, anchor, point.candidate);
  if (!point.is_accepted && point.lead > kWaitsOutside * spacing_) {
    point.candidate = straight;
    point.is_accepted = keep_out(mesh, surface, anchor, point.candidate, true);
  }
}

/// Whether a rest point lies at the wall of a cut: what that has opened is air.
bool MaterialBlade::lies_in_cut(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& rest) const {
  Vec3 place;
  const Side side = nearest_side(mesh, surface, rest, spacing_, place);
  if (side.value == kInvalidIndex || (place - rest).norm() > kInCut * spacing_) return false;
  const Link link = mesh.link(side);
  return link.is_boundary() && link.tag() != 0;
}

/// The blade has left the body, so its rest point must lie outside, or in a cut: else further along its way.
bool MaterialBlade::push_out(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& from, Vec3& rest) {
  const Vec3 way = rest - from;
  for (const double reach : {1.0, 1.5, 2.0, 3.0, 5.0}) {
    if ((reach - 1) * way.norm() > kFurtherOut * spacing_) return false;
    const Vec3 place = from + reach * way;
    const bool is_inside = incise::locate(mesh, surface, {place, next_key_++}).is_valid();
    if (is_inside && !lies_in_cut(mesh, surface, place)) continue;
    rest = place;
    return true;
  }
  return false;
}

/// A point that is outside the body, and was, has its rest point outside, or in a cut: where that would be inside,
/// beside the surface there. Returns false where a long way leads there through the body: that was not cut, unless the
/// blade `has_passed`.
bool MaterialBlade::keep_out(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& from, Vec3& rest,
                             bool has_passed) {
  Vec3 place = rest;
  const bool is_inside = incise::locate(mesh, surface, {place, next_key_++}).is_valid();
  if (is_inside && !lies_in_cut(mesh, surface, place)) {
    Vec3 near;
    const Side side = nearest_side(mesh, surface, rest, spacing_, near);
    if (side.value == kInvalidIndex) return false;
    const auto v = mesh.vertices(side);
    const Vec3 normal = (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0])).normalized();
    place = near + kOffSurface * spacing_ * normal;
  }
  if (!has_passed && (place - from).norm() > kTrust * spacing_ && !is_clear(mesh, surface, from, place)) return false;
  rest = place;
  return true;
}

/// A way that would lead through the body goes round it: further out, seen from a point of the blade that is within. A
/// point that waited at the surface would leave a thread of tissue behind there.
bool MaterialBlade::go_round(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& from, const Vec3& inner,
                             Vec3& rest) {
  const Vec3 outwards = (from - inner).normalized();
  for (const double reach : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    const Vec3 place = rest + reach * spacing_ * outwards;
    if (!is_clear(mesh, surface, from, place)) continue;
    rest = place;
    return true;
  }
  return false;
}

/// The point nearest to one that has not entered the body which has; the number of points where there is none.
std::size_t MaterialBlade::leader_of(std::size_t point) const {
  std::size_t leader = points_.size(), distance = points_.size();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const std::size_t apart = k > point ? k - point : point - k;
    if ((points_[k].has_entered || points_[k].tet.is_valid()) && apart < distance) {
      leader = k;
      distance = apart;
    }
  }
  return leader;
}

/// Points that have not entered the body go with the nearest one that has, so that the strip stays even; but no further
/// than they went themselves, and drawn to where the surface near them has them: errors must not add up.
void MaterialBlade::follow_entered(const TetMesh& mesh, const SurfaceIndex& surface) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& point = points_[i];
    if (point.has_entered || point.tet.is_valid()) continue;
    const std::size_t leader = leader_of(i);
    const bool is_free = leader == points_.size();
    if (!is_free && !points_[leader].is_accepted) continue;
    const double most = kGreatestStretch * (point.world - point.reached).norm() + kLeastMaterialStep * spacing_;
    Vec3 rest = anchors_[i] + shortened(point.candidate - anchors_[i], most);
    if (!is_free) {
      Vec3 with = anchors_[i] + shortened(points_[leader].candidate - anchors_[leader], most);
      bool is_possible = false;
      const TetId tet = points_[leader].tet;
      const Vec3 mapped = tet.is_valid() ? to_rest(mesh, tet, point.world, is_possible) : with;
      if (is_possible && (mapped - with).norm() <= kTrust * spacing_) with = mapped;
      const Vec3 off = point.candidate - with;
      const bool is_off = point.is_mapped && off.norm() > kDrawnFrom * spacing_;
      rest = is_off ? Vec3(with + shortened(off, kDrawnBy * spacing_)) : with;
    }
    const Vec3& inner = anchors_[is_free ? points_.size() / 2 : leader];
    Vec3 round = rest;
    const Vec3 straight = rest;
    point.is_accepted = keep_out(mesh, surface, anchors_[i], rest);
    if (!point.is_accepted && go_round(mesh, surface, anchors_[i], inner, round)) {
      point.is_accepted = true;
      rest = round;
    }
    if (!point.is_accepted && (straight - anchors_[i]).norm() > kWaitsOutside * spacing_) {
      rest = straight;
      point.is_accepted = keep_out(mesh, surface, anchors_[i], rest, true);
    }
    if (!point.is_accepted) continue;
    point.candidate = rest;
    point.lead = (rest - anchors_[i]).norm();
  }
}

void MaterialBlade::locate(const TetMesh& mesh, const SurfaceIndex& surface, const ClosedComplex& complex,
                           std::span<const Vec3> row, const Vec3& direction, bool is_last) {
  is_last_ = is_last;
  const std::vector<Vec3> places = divided(row, shares_);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& point = points_[i];
    point.before = std::exchange(point.world, places[i]);
    find_tip(mesh, complex, point, anchors_[i]);
  }
  find_directions(direction);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    find(mesh, surface, points_[i], anchors_[i], /*is_expected=*/true);
    judge(mesh, surface, i);
  }
  follow_entered(mesh, surface);
  keep_clear(mesh, surface, 0);
  keep_clear(mesh, surface, points_.size() - 1);
  set_course();
}

/// Whether a segment passes by the body at rest.
bool MaterialBlade::is_clear(const TetMesh& mesh, const SurfaceIndex& surface, const Vec3& from, const Vec3& to) {
  const SosPoint p{from, next_key_++}, q{to, next_key_++};
  if (incise::locate(mesh, surface, p).is_valid() || incise::locate(mesh, surface, q).is_valid()) return false;
  bool is_clear = true;
  for_each_side_near(mesh, surface, {from, to, to}, [&](Side side) {
    const auto v = mesh.vertices(side);
    is_clear = is_clear && !segment_crosses_triangle(p, q, {mesh.rest(v[0]), v[0].value}, {mesh.rest(v[1]), v[1].value},
                                                     {mesh.rest(v[2]), v[2].value});
  });
  return is_clear;
}

bool MaterialBlade::is_front_clear(const TetMesh& mesh, const SurfaceIndex& surface) {
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    if (!is_clear(mesh, surface, anchors_[i], anchors_[i + 1])) return false;
  }
  return true;
}

bool MaterialBlade::is_in_air(const TetMesh& mesh, const SurfaceIndex& surface) {
  for (const Point& point : points_) {
    if (point.has_entered || point.tet.is_valid()) return false;
  }
  if (!is_front_clear(mesh, surface)) return false;
  std::vector<std::array<SosPoint, 3>> way;
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const SosPoint a{points_[i].before, next_key_ + 2 * i}, b{points_[i + 1].before, next_key_ + 2 * i + 2};
    const SosPoint c{points_[i].world, next_key_ + 2 * i + 1}, d{points_[i + 1].world, next_key_ + 2 * i + 3};
    way.push_back({a, b, d});
    way.push_back({a, d, c});
  }
  next_key_ += 2 * points_.size();
  return !surface.meets_as_it_stands(mesh, way);
}

/// An end of the blade outside the body must not take its trace through it, or the cut would end in there: it goes
/// with its neighbours as it may, further out if need be, or waits.
void MaterialBlade::keep_clear(const TetMesh& mesh, const SurfaceIndex& surface, std::size_t end) {
  Point& point = points_[end];
  const Vec3 anchor = anchors_[end];
  if (!point.is_accepted || point.tet.is_valid() || incise::locate(mesh, surface, {anchor, next_key_++}).is_valid() ||
      is_clear(mesh, surface, anchor, point.candidate)) {
    return;
  }
  std::size_t inner = end;
  for (std::size_t k = 0; k < points_.size() && inner == end; ++k) {
    const std::size_t at = end == 0 ? k : points_.size() - 1 - k;
    if (points_[at].has_entered) inner = at;
  }
  const Vec3 along = points_[inner].is_accepted ? Vec3(points_[inner].candidate - anchors_[inner]) : Vec3(Vec3::Zero());
  const Vec3 outwards = inner == end ? Vec3(Vec3::Zero()) : Vec3((anchor - anchors_[inner]).normalized());
  for (const double reach : {0.0, 1.0, 2.0, 4.0, 8.0}) {
    for (const Vec3& place : {point.candidate, Vec3(anchor + along)}) {
      const Vec3 further = place + reach * spacing_ * outwards;
      if (!is_clear(mesh, surface, anchor, further)) continue;
      point.candidate = further;
      return;
    }
  }
  point.is_accepted = false;
}

/// The course of the cut at rest: the mean way of the points in tissue, new ones counting most.
void MaterialBlade::set_course() {
  Vec3 way = Vec3::Zero();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    if (point.is_accepted && point.has_entered && point.tet.is_valid()) way += point.candidate - anchors_[i];
  }
  const double length = way.norm();
  if (!(length > 0)) return;
  course_ = (0.5 * course_ + way / length).normalized();
}

void MaterialBlade::find_tips(const TetMesh& mesh, const ClosedComplex& complex) {
  for (std::size_t i = 0; i < points_.size(); ++i) find_tip(mesh, complex, points_[i], anchors_[i]);
}

bool MaterialBlade::stands_at(const TetMesh& mesh, const ClosedComplex& complex, std::span<const Vec3> row,
                              double distance) const {
  const std::vector<Vec3> places = divided(row, shares_);
  bool is_in_tissue = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point point = points_[i];
    const Vec3 ahead = point.world - point.tip;
    if (!is_in_master(complex, point)) continue;
    find_tip(mesh, complex, point, anchors_[i]);
    if (point.master == Master::kNone) continue;  // it has left by now
    if (!((places[i] - point.tip - ahead).norm() <= distance)) return false;
    is_in_tissue = true;
  }
  return is_in_tissue;
}

void MaterialBlade::carry_to(std::span<const Vec3> row) {
  const std::vector<Vec3> places = divided(row, shares_);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& point = points_[i];
    point.reached += places[i] - point.world;
    point.world = point.before = places[i];
  }
}

std::vector<Vec3> MaterialBlade::front_of(const TetMesh& mesh, const ClosedComplex& complex,
                                          std::span<const Vec3> before, std::span<const Vec3> row) const {
  const std::vector<Vec3> places = divided(row, shares_);
  std::vector<Vec3> front(before.begin(), before.end());
  std::vector<std::size_t> apart(row.size(), points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point point = points_[i];
    if (!is_in_master(complex, point)) continue;
    find_tip(mesh, complex, point, anchors_[i]);
    if (point.master == Master::kNone) continue;
    for (std::size_t c = 0, corner = 0; c < row.size(); corner += c < shares_.size() ? shares_[c].size() : 0, ++c) {
      const std::size_t distance = corner > i ? corner - i : i - corner;
      if (distance >= apart[c]) continue;
      apart[c] = distance;
      front[c] = row[c] - (places[i] - point.tip);
    }
  }
  return front;
}

std::vector<Vec3> MaterialBlade::wanted() const {
  std::vector<Vec3> row = anchors_;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (points_[i].is_accepted) row[i] = points_[i].candidate;
  }
  return row;
}

void MaterialBlade::take_over(const TetMesh& mesh, const SurfaceIndex& surface, std::span<const Vec3> row,
                              std::span<const Vec3> front, double spacing, ClosedComplex& complex) {
  spacing_ = spacing;
  course_ = Vec3::Zero();
  set_shares(mesh, row);
  anchors_ = divided(front, shares_);
  const std::vector<Vec3> places = divided(row, shares_);
  points_.assign(places.size(), {});
  for (std::size_t i = 0; i < points_.size(); ++i) {
    points_[i].world = points_[i].before = points_[i].reached = points_[i].tip = places[i];
    points_[i].candidate = points_[i].towed = anchors_[i];
  }
  find_masters(mesh, surface, complex);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& point = points_[i];
    point.has_entered = point.master != Master::kNone;
    Vec3 place;
    const Side side = nearest_side(mesh, surface, anchors_[i], spacing_, place);
    if (!point.hint.is_valid()) point.hint = side.value == kInvalidIndex ? TetId() : side.tet();
    if (!point.hint.is_valid()) point.hint = surface.nearest_as_it_stands(mesh, places[i]);
  }
}

void MaterialBlade::advance(const TetMesh& mesh, const SurfaceIndex& surface, ClosedComplex& complex) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& point = points_[i];
    if (!point.is_accepted) continue;
    const Vec3 step = point.candidate - anchors_[i];
    anchors_[i] = point.candidate;
    point.reached = point.world;
    if (!point.tet.is_valid()) continue;
    tow(mesh, i, step);
    if (!mesh.is_live(point.tet)) point.tet = incise::locate(mesh, surface, {point.candidate, next_key_++});
    if (point.tet.is_valid()) point.master = complex.adopt(mesh, point.tet);
    point.has_entered = true;
  }
}

std::vector<std::uint32_t> MaterialBlade::masters() const {
  std::vector<std::uint32_t> masters;
  for (const Point& point : points_) {
    if (point.master != Master::kNone) masters.push_back(point.master);
  }
  std::sort(masters.begin(), masters.end());
  masters.erase(std::unique(masters.begin(), masters.end()), masters.end());
  return masters;
}

void MaterialBlade::find_masters(const TetMesh& mesh, const SurfaceIndex& surface, ClosedComplex& complex) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const TetId tet = incise::locate(mesh, surface, {anchors_[i], next_key_++});
    points_[i].master = tet.is_valid() ? complex.adopt(mesh, tet) : Master::kNone;
    if (tet.is_valid()) points_[i].hint = tet;
  }
}

}  // namespace v0
}  // namespace incise
