// SPDX-License-Identifier: Apache-2.0
// Beams along x to bend: whole ones, and ones that a blade has opened from above.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/geom/quality.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::test {

/// A box from the origin to (length, width, height), in cells of six tets each.
struct Beam {
  std::array<std::uint32_t, 3> cells = {18, 6, 6};
  Vec3 size = Vec3(0.09, 0.03, 0.03);  ///< in the mesh's length unit

  [[nodiscard]] double cell_length() const { return size.x() / cells[0]; }
};

/// The beam as it leaves the mould.
inline TetMesh make_beam(const Beam& beam) {
  Result<TetMesh> mesh = TetMesh::build(kuhn_box(Vec3::Zero(), beam.size, beam.cells));
  return std::move(*mesh);
}

/// The vertices at x = `x`, up to rounding: x = 0 is the end that a wall holds.
inline std::vector<VertexId> vertices_at(const TetMesh& mesh, double x) {
  std::vector<VertexId> result;
  mesh.for_each_vertex([&](VertexId v) {
    if (std::abs(mesh.rest(v).x() - x) < 1e-12) result.push_back(v);
  });
  return result;
}

/// Where each vertex slot is at rest.
inline std::vector<Vec3> rest_positions(const TetMesh& mesh) {
  std::vector<Vec3> result;
  for (std::uint32_t slot = 0; slot < mesh.vertex_slots(); ++slot) result.push_back(mesh.rest(VertexId(slot)));
  return result;
}

/// How far the end at x = length has sunk, on the mean of its vertices.
inline double tip_sag(const TetMesh& mesh, const std::vector<Vec3>& positions, const Beam& beam) {
  double sum = 0;
  const std::vector<VertexId> tip = vertices_at(mesh, beam.size.x());
  for (const VertexId v : tip) sum += mesh.rest(v).z() - positions[v.value].z();
  return sum / static_cast<double>(tip.size());
}

/// The greatest longest edge over inradius of a mesh at rest; 8.36 for cubic Kuhn cells.
inline double worst_aspect(const TetMesh& mesh) {
  double worst = 0;
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    worst =
        std::max(worst, longest_edge_over_inradius(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])));
  });
  return worst;
}

struct CutBeam {
  TetMesh mesh;
  double worst_aspect = 0;  ///< longest edge over inradius
};

/// A beam whose upper half is incised across, `eps` cell lengths beyond the lattice plane at half its length, and to
/// half a cell below half its height: the smaller `eps`, the thinner the slivers, 4/eps the worst. Nothing is snapped
/// or maintained. `eps` from 1e-5 on: below, slivers would be flat, and the engine leaves the edges whole. A failed cut
/// leaves a mesh without tets.
inline CutBeam cut_beam(const Beam& beam, double eps) {
  EngineOptions options;
  options.cut.snap = 0;
  options.maintain.merge = false;
  options.maintain.improve = false;
  Result<Engine> engine = Engine::create(make_beam(beam), options);
  const double x = beam.cell_length() * (beam.cells[0] / 2 + eps);
  const double above = 1.5 * beam.size.z(), depth = 0.5 * (beam.size.z() - beam.cell_length());
  const double near_side = -beam.size.y(), far_side = 2 * beam.size.y();
  Stroke stroke;
  stroke.times = {0, 1};
  stroke.edges = {{Vec3(x, near_side, above), Vec3(x, far_side, above)},
                  {Vec3(x, near_side, depth), Vec3(x, far_side, depth)}};
  if (!engine->cut(stroke)) return {};
  CutBeam result{engine->mesh(), 0};
  result.worst_aspect = worst_aspect(result.mesh);
  return result;
}

}  // namespace incise::test
