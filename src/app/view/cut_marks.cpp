// SPDX-License-Identifier: Apache-2.0
// Lips lie at one place after a cut at rest: triangles and places are sorted by their coordinates, and equal ones
// drawn once.
#include "app/view/cut_marks.h"

#include <algorithm>
#include <array>
#include <memory>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr float kTrajectoryOpacity = 0.3F, kIncisionOpacity = 0.9F;
constexpr float kEdgeWidth = 1, kBallRadius = 4;  // pixels

template <class Visit>
void for_each_wall(const SurfaceTopology& topology, const Visit& visit) {
  for (std::size_t slot = 0; slot < topology.triangles.size(); ++slot) {
    const std::uint8_t flags = topology.looks[slot].flags;
    if ((flags & TriangleLook::kUnused) == 0 && (flags & TriangleLook::kWall) != 0) visit(topology.triangles[slot]);
  }
}

bool is_less(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

using Corners = std::array<Eigen::Vector3f, 3>;

Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end(), is_less);
  return corners;
}

bool comes_before(const Corners& a, const Corners& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), is_less);
}

void mark_wall(const Corners& wall, Marks& marks) {
  marks.triangles.push_back({wall, Ink::kIncision, kIncisionOpacity});
  for (std::size_t i = 0; i < 3; ++i) {
    marks.lines.push_back({wall[i], wall[(i + 1) % 3], Ink::kIncision, kEdgeWidth, false, false});
  }
}

SurfaceTopology without_walls(SurfaceTopology topology) {
  for (std::size_t slot = 0; slot < topology.triangles.size(); ++slot) {
    if ((topology.looks[slot].flags & TriangleLook::kWall) == 0) continue;
    topology.looks[slot] = {};
    topology.triangles[slot] = {0, 0, 0};
    --topology.used;
  }
  return topology;
}

}  // namespace

void mark_trajectory(const std::vector<Stroke>& strokes, Marks& marks) {
  for (const Stroke& stroke : strokes) {
    const SweptTriangles swept = swept_triangles(stroke);
    for (const auto& t : swept.triangles) {
      marks.triangles.push_back(
          {{swept.points[t[0]].cast<float>(), swept.points[t[1]].cast<float>(), swept.points[t[2]].cast<float>()},
           Ink::kTrajectory,
           kTrajectoryOpacity});
    }
  }
}

void mark_incision(SurfaceFrame& frame, Marks& marks) {
  if (!frame.topology) return;
  std::vector<Corners> walls;
  for_each_wall(*frame.topology, [&](const std::array<std::uint32_t, 3>& t) {
    walls.push_back(sorted({frame.positions[t[0]], frame.positions[t[1]], frame.positions[t[2]]}));
  });
  std::sort(walls.begin(), walls.end(), comes_before);
  walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
  for (const Corners& wall : walls) mark_wall(wall, marks);
  frame.topology = std::make_shared<const SurfaceTopology>(without_walls(*frame.topology));
}

void mark_cut_vertices(const TetMesh& mesh, const SurfaceFrame& frame, Marks& marks) {
  if (!frame.topology) return;
  std::vector<Eigen::Vector3f> places;
  for_each_wall(*frame.topology, [&](const std::array<std::uint32_t, 3>& t) {
    for (const std::uint32_t point : t) {
      const bool is_front = (mesh.shape_of(frame.topology->vertices[point]) & shape::kFront) != 0;
      if (!is_front) places.push_back(frame.positions[point]);
    }
  });
  std::sort(places.begin(), places.end(), is_less);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (const Eigen::Vector3f& at : places) marks.balls.push_back({at, Ink::kVertex, kBallRadius, true});
}

}  // namespace app
}  // namespace v0
}  // namespace incise
