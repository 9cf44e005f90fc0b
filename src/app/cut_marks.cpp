// SPDX-License-Identifier: Apache-2.0
#include "incise/app/cut_marks.h"

#include <algorithm>

namespace incise::inline v0 {
namespace app {
namespace {

constexpr float kTrajectoryOpacity = 0.3F, kIncisionOpacity = 0.85F;
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

void mark_incision(const SurfaceFrame& frame, Marks& marks) {
  if (!frame.topology) return;
  for_each_wall(*frame.topology, [&](const std::array<std::uint32_t, 3>& t) {
    const Eigen::Vector3f &a = frame.positions[t[0]], &b = frame.positions[t[1]], &c = frame.positions[t[2]];
    marks.triangles.push_back({{a, b, c}, Ink::kIncision, kIncisionOpacity});
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      marks.lines.push_back({from, to, Ink::kBlade, kEdgeWidth, false, false});
    }
  });
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
}  // namespace incise::inline v0
