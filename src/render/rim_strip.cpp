// SPDX-License-Identifier: Apache-2.0
// A point where two stretches meet keeps the sum of their other ends: less one end that is the other.
#include "render/rim_strip.h"

#include <algorithm>

namespace incise {
inline namespace v0 {
namespace render {

void RimStrip::join(const Edge& edge) {
  for (std::size_t i = 0; i < 2; ++i) {
    Joint& joint = joints_[edge[i]];
    ++joint.count;
    joint.sum += edge[1 - i];
  }
}

std::uint32_t RimStrip::beyond(std::uint32_t end, std::uint32_t other) const {
  const Joint& joint = joints_[end];
  return joint.count == 2 ? static_cast<std::uint32_t>(joint.sum - other) : end;
}

void RimStrip::find(const std::shared_ptr<const app::SurfaceTopology>& topology) {
  if (topology == topology_) return;
  topology_ = topology;
  stretches_.clear();
  if (!topology || topology->contour_edges.empty()) return;
  const std::size_t points = topology->vertices.size();
  joints_.assign(points, {});
  const auto is_there = [&](const Edge& edge) { return std::max(edge[0], edge[1]) < points; };
  for (const Edge& edge : topology->contour_edges) {
    if (is_there(edge)) join(edge);
  }
  for (const Edge& edge : topology->contour_edges) {
    if (!is_there(edge)) continue;
    const auto& [from, to] = edge;
    stretches_.push_back({beyond(from, to), from, to, beyond(to, from)});
  }
}

}  // namespace render
}  // namespace v0
}  // namespace incise
