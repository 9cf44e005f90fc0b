// SPDX-License-Identifier: Apache-2.0
// What averaged volumes do, in double precision, for questions about a body as it stands.
#include <algorithm>

#include "sim/body/body_state.h"

namespace incise {
inline namespace v0 {

namespace {

unsigned corner_of(const TetVertices& tet, VertexId vertex) {
  unsigned corner = 0;
  while (tet[corner] != vertex) ++corner;
  return corner;
}

}  // namespace

double DeformableBody::State::pressure_at(VertexId v) const {
  double more = 0;
  stars.for_each_tet(v, [&](TetId t) {
    if (nodal.has(t)) more += detail::six_volumes(corners(t)) - detail::six_volumes(corners_at_rest(t));
  });
  return nodal.stiffness(v) * more;
}

/// Calls `visit(vertex, change)` for a vertex and its neighbours: how their six volumes change with it.
template <class Visit>
void DeformableBody::State::for_each_volume_around(VertexId v, const Visit& visit) const {
  Vec3 own = Vec3::Zero();
  std::vector<VertexId> around;
  detail::SweepOrder::for_each_neighbour(stars, v, [&](VertexId n) { around.push_back(n); });
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  for (const VertexId n : around) {
    Vec3 change = Vec3::Zero();
    stars.for_each_tet(v, [&](TetId t) {
      const bool has_both = std::find(tets[t].begin(), tets[t].end(), n) != tets[t].end();
      if (has_both && nodal.has(t)) change += detail::volume_slope(corners(t), corner_of(tets[t], v));
    });
    visit(n, change);
    own += change / 3;  // each tet has three other corners
  }
  visit(v, own);
}

/// The slope of the pressures' energies in a vertex.
Vec3 DeformableBody::State::pressure_slope(VertexId v) const {
  Vec3 slope = Vec3::Zero();
  for_each_volume_around(v, [&](VertexId n, const Vec3& change) { slope += pressure_at(n) * change; });
  return slope;
}

/// What they add to the stiffness that a vertex meets while its neighbours stay.
Mat3 DeformableBody::State::pressure_stiffness(VertexId v) const {
  Mat3 stiffness = Mat3::Zero();
  for_each_volume_around(
      v, [&](VertexId n, const Vec3& change) { stiffness += nodal.stiffness(n) * change * change.transpose(); });
  return stiffness;
}

double DeformableBody::State::pressure_energy() const {
  std::vector<double> more(places.size());
  for (std::uint32_t slot = 0; slot < tets.size(); ++slot) {
    const TetId t(slot);
    if (!tets[t][0].is_valid() || !nodal.has(t)) continue;
    const double by = detail::six_volumes(corners(t)) - detail::six_volumes(corners_at_rest(t));
    for (const VertexId v : tets[t]) more[v.value] += by;
  }
  double energy = 0;
  for (std::uint32_t v = 0; v < more.size(); ++v) energy += 0.5 * nodal.stiffness(VertexId(v)) * more[v] * more[v];
  return energy;
}

}  // namespace v0
}  // namespace incise
