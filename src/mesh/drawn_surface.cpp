// SPDX-License-Identifier: Apache-2.0
// Places follow from bindings, and normals turn as the triangles around them have turned; places before a cut are
// asked a little inside the triangles, so that each lip finds its own tet.
#include "incise/mesh/drawn_surface.h"

#include <algorithm>
#include <cmath>

#include "incise/mesh/edge_length.h"
#include "mesh/constants.h"
#include "mesh/near_tets.h"
#include "mesh/tet_grid.h"
#include "mesh/turned_normals.h"

namespace incise {
inline namespace v0 {
DrawnSurface draw(const EmbeddedSurface& surface, const TetMesh& mesh) {
  return SurfaceDrawing(surface, mesh).packed();
}

void fill(const DrawnSurface& drawn, const TetMesh& mesh, std::vector<Vec3>& positions, std::vector<Vec3>& normals) {
  const std::size_t count = drawn.points.size();
  positions.resize(count);
  for (std::size_t i = 0; i < count; ++i) positions[i] = current_place(mesh, drawn.points[i].binding);
  std::vector<Vec3> at_rest(count, Vec3::Zero()), now(count, Vec3::Zero());
  for (const auto* triangles : {&drawn.skin, &drawn.walls}) {
    for (const auto& [a, b, c] : *triangles) {
      const Vec3 &p = drawn.points[a].rest, &q = drawn.points[b].rest, &r = drawn.points[c].rest;
      const Vec3 rest = (q - p).cross(r - p);
      const Vec3 current = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
      for (const std::uint32_t i : {a, b, c}) {
        at_rest[i] += rest;
        now[i] += current;
      }
    }
  }
  normals.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_wall = i >= drawn.skin_points;
    const double length = now[i].norm();
    if (is_wall) normals[i] = length > 0 ? Vec3(now[i] / length) : Vec3(Vec3::UnitZ());
    if (!is_wall) normals[i] = turned_with(drawn.points[i].normal, at_rest[i], now[i]);
  }
}

std::vector<Vec3> earlier_places(const DrawnSurface& drawn, const TetMesh& mesh) {
  std::vector<Vec3> middles(drawn.points.size(), Vec3::Zero());  // sums over the triangles at each point
  std::vector<double> counts(drawn.points.size(), 0);
  Box box;
  double reach = 0;
  for (const auto* triangles : {&drawn.skin, &drawn.walls}) {
    for (const auto& triangle : *triangles) {
      Vec3 middle = Vec3::Zero();
      for (const std::uint32_t i : triangle) middle += drawn.points[i].rest / 3;
      for (const std::uint32_t i : triangle) {
        middles[i] += middle;
        counts[i] += 1;
      }
    }
  }
  for (const DrawnPoint& point : drawn.points) {
    box.extend(point.rest);
    reach = std::max(reach, point.binding.offset.norm());
  }
  reach += kReachMargin * mean_edge_length(mesh);
  const TetGrid grid(mesh);
  NearTets near((box.hi - box.lo).norm());
  std::vector<Vec3> places(drawn.points.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3& rest = drawn.points[i].rest;
    const Vec3 inwards = counts[i] > 0 ? Vec3(rest + kAskedInwards * (middles[i] / counts[i] - rest)) : rest;
    Box around;
    around.extend(inwards);
    near.gather(mesh, grid, around, reach);
    places[i] = current_place(mesh, bind_to(mesh, near.locate(inwards), rest));
  }
  return places;
}

}  // namespace v0
}  // namespace incise
