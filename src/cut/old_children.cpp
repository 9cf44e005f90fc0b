// SPDX-License-Identifier: Apache-2.0
// A point belongs to the tet in which its least barycentric weight is greatest: inside if there is such a tet, else
// the nearest to holding it (docs/internals.md, 3.7).
#include "cut/old_children.h"

#include <algorithm>
#include <cmath>

#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {

namespace {

/// Barycentric weights: exact where `x` is a corner.
std::array<double, 4> weights_in(const std::array<Vec3, 4>& p, const Vec3& x) {
  for (unsigned c = 0; c < 4; ++c) {
    if (x != p[c]) continue;
    std::array<double, 4> at_corner{};
    at_corner[c] = 1.0;
    return at_corner;
  }
  std::array<double, 4> weights = {signed_volume6(x, p[1], p[2], p[3]), signed_volume6(p[0], x, p[2], p[3]),
                                   signed_volume6(p[0], p[1], x, p[3]), 0.0};
  const double whole = signed_volume6(p[0], p[1], p[2], p[3]);
  double rest = 1.0;
  for (unsigned c = 0; c < 3; ++c) {
    weights[c] /= whole;
    rest -= weights[c];
  }
  weights[3] = rest;
  return weights;
}

bool is_in(const Box& box, const Vec3& x) {
  bool is_in = true;
  for (int k = 0; k < 3; ++k) is_in &= box.lo[k] <= x[k] && x[k] <= box.hi[k];
  return is_in;
}

/// The least of them; that of a flat tet, which has no weights, is below all.
double least_of(const std::array<double, 4>& weights) {
  const bool is_flat = !std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w); });
  return is_flat ? MaterialPlace().inside : *std::min_element(weights.begin(), weights.end());
}

/// Whether no weight of a place is below 0, as `weights_in` has them: most tets are told by a sign.
bool holds(const std::array<Vec3, 4>& p, const Vec3& x) {
  const double whole = signed_volume6(p[0], p[1], p[2], p[3]);
  if (whole > 0 && (signed_volume6(x, p[1], p[2], p[3]) < 0 || signed_volume6(p[0], x, p[2], p[3]) < 0 ||
                    signed_volume6(p[0], p[1], x, p[3]) < 0)) {
    return false;
  }
  return least_of(weights_in(p, x)) >= 0;
}

}  // namespace

OldChildren::OldTet OldChildren::image_of(const TetMesh& mesh, TetId tet) {
  OldTet old{tet, mesh.vertices(tet), {}, {}, {}};
  for (unsigned c = 0; c < 4; ++c) {
    old.rest[c] = mesh.rest(old.vertices[c]);
    old.current[c] = mesh.current(old.vertices[c]);
  }
  return old;
}

void OldChildren::add(const TetMesh& mesh, TetId tet) {
  tets_.push_back(image_of(mesh, tet));
  const auto& p = tets_.back().rest;
  tets_.back().around = {p[0].cwiseMin(p[1]).cwiseMin(p[2].cwiseMin(p[3])),
                         p[0].cwiseMax(p[1]).cwiseMax(p[2].cwiseMax(p[3]))};
}

std::uint32_t OldChildren::holding(const Vec3& rest, std::uint32_t first, std::uint32_t last) const {
  if (last - first <= 1) return first;
  for (std::uint32_t i = first; i < last; ++i) {
    if (is_in(tets_[i].around, rest) && holds(tets_[i].rest, rest)) return i;
  }
  std::uint32_t best = first;
  double inside = -1e300;
  for (std::uint32_t i = first; i < last; ++i) {
    const double least = least_of(weights_in(tets_[i].rest, rest));
    if (least > inside) {
      inside = least;
      best = i;
    }
  }
  return best;
}

MaterialPlace OldChildren::place_in(std::uint32_t index, const Vec3& rest) const {
  return place_in(tets_[index], rest);
}

MaterialPlace place_in(const TetMesh& mesh, TetId tet, const Vec3& rest) {
  return OldChildren::place_in(OldChildren::image_of(mesh, tet), rest);
}

MaterialPlace OldChildren::place_in(const OldTet& tet, const Vec3& rest) {
  MaterialPlace place;
  place.basis = tet.vertices;
  place.weights = weights_in(tet.rest, rest);
  place.inside = least_of(place.weights);
  bool is_at_rest = true;
  for (unsigned c = 0; c < 4; ++c) {
    is_at_rest = is_at_rest && tet.current[c] == tet.rest[c];
    place.current += place.weights[c] * tet.current[c];
  }
  if (is_at_rest) place.current = rest;
  return place;
}

VertexId add_vertex_at(Transaction& transaction, const Vec3& rest, const MaterialPlace& place) {
  return transaction.add_vertex(place.basis, place.weights, rest, place.current);
}

}  // namespace v0
}  // namespace incise
