// SPDX-License-Identifier: Apache-2.0
// A vertex that moves at rest stands for another point of the material, which is found in its star and taken to where
// that stands now.
#include "improve/standing.h"

#include <algorithm>

#include "incise/geom/quality.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

namespace {

MaterialPoint coordinates_in(const TetMesh& mesh, TetId tet, const Vec3& place) {
  const TetVertices& v = mesh.vertices(tet);
  std::array<Vec3, 4> p = {mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])};
  const double whole = signed_volume6(p[0], p[1], p[2], p[3]);
  MaterialPoint point{v, {}};
  for (unsigned c = 0; c < 4; ++c) {
    const Vec3 kept = p[c];
    p[c] = place;
    point.weights[c] = signed_volume6(p[0], p[1], p[2], p[3]) / whole;
    p[c] = kept;
  }
  return point;
}

double least_weight(const MaterialPoint& point) {
  return *std::min_element(point.weights.begin(), point.weights.end());
}

/// Whether the star stands deformed without inverted tets once its centre stands for another material point.
bool stays_sound(const TetMesh& mesh, VertexId vertex, const Vec3& moved, const std::vector<TetId>& star) {
  return std::all_of(star.begin(), star.end(), [&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    const auto at = [&](unsigned c) -> const Vec3& { return v[c] == vertex ? moved : mesh.current(v[c]); };
    return signed_volume6(at(0), at(1), at(2), at(3)) > 0 || !is_sound_now(mesh, v);
  });
}

bool is_deformed(const TetMesh& mesh, const std::vector<TetId>& star) {
  return std::any_of(star.begin(), star.end(), [&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    return std::any_of(v.begin(), v.end(), [&](VertexId id) { return mesh.current(id) != mesh.rest(id); });
  });
}

}  // namespace

bool is_sound_now(const TetMesh& mesh, const TetVertices& v) {
  const bool is_at_rest = mesh.current(v[0]) == mesh.rest(v[0]) && mesh.current(v[1]) == mesh.rest(v[1]) &&
                          mesh.current(v[2]) == mesh.rest(v[2]) && mesh.current(v[3]) == mesh.rest(v[3]);
  return is_at_rest ||
         signed_volume6(mesh.current(v[0]), mesh.current(v[1]), mesh.current(v[2]), mesh.current(v[3])) > 0;
}

MaterialPoint locate(const TetMesh& mesh, const Vec3& place, const std::vector<TetId>& star) {
  MaterialPoint best = coordinates_in(mesh, star.front(), place);
  for (std::size_t i = 1; i < star.size() && !(least_weight(best) >= 0); ++i) {
    const MaterialPoint point = coordinates_in(mesh, star[i], place);
    if (!(least_weight(best) >= least_weight(point))) {
      best = point;
    }
  }
  return best;
}

Vec3 current_at(const TetMesh& mesh, const MaterialPoint& point) {
  Vec3 current = Vec3::Zero();
  for (unsigned c = 0; c < 4; ++c) {
    current += point.weights[c] * mesh.current(point.basis[c]);
  }
  return current;
}

bool may_move(const TetMesh& mesh, VertexId vertex, const Vec3& place, const std::vector<TetId>& star) {
  if (!is_deformed(mesh, star)) return true;
  const MaterialPoint point = locate(mesh, place, star);
  return stays_sound(mesh, vertex, current_after_move(mesh, vertex, place, point.basis, point.weights), star);
}

}  // namespace v0
}  // namespace incise
