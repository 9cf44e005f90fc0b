// SPDX-License-Identifier: Apache-2.0
#include "cut/division.h"

#include <algorithm>

#include "incise/geom/predicates.h"
#include "incise/geom/quality.h"

namespace incise::inline v0 {

std::span<const std::uint8_t> Divider::order_of(const Master& master) {
  order_.clear();
  const unsigned split = split_edges(master);
  for (std::uint8_t e = 0; e < 6; ++e) {
    if (((split >> e) & 1U) == 0) continue;
    const ClosedEdge& edge = complex_.edges()[master.edges[e]];
    order_.add((mesh_.rest(edge.b) - mesh_.rest(edge.a)).squaredNorm(), edge.a, edge.b, e);
  }
  return order_.numbers();
}

const SplitTemplate& Divider::find(const Master& master) {
  const auto order = order_of(master);
  if (order.empty() || !has_odd_face(master.flagged)) {
    return templates_.find(order);
  }
  unsigned pierced = 0;
  for (unsigned s = 0; s < 4; ++s) {
    pierced |= (master.points[s] != Master::kNone ? 1U : 0U) << s;
  }
  return templates_.find_cone(order, pierced);
}

Vec3 Divider::middle_of(const Master& master) const {
  if (master.corner_key != 0) return master.corner;
  Vec3 sum = Vec3::Zero();
  unsigned count = 0;
  for (const std::uint32_t point : master.points) {
    if (point == Master::kNone) continue;
    sum += complex_.point(point).position;
    ++count;
  }
  if (count >= 2) return sum / count;
  for (const VertexId v : master.vertices) sum += mesh_.rest(v);
  return sum / (4 + count);
}

Vec3 Divider::position_of(const Master& master, std::uint8_t code) const {
  if (code < SplitTemplate::kFirstSplit) return mesh_.rest(master.vertices[code]);
  if (code < SplitTemplate::kFirstPoint) {
    return complex_.edges()[master.edges[code - SplitTemplate::kFirstSplit]].position;
  }
  if (code < SplitTemplate::kMiddle) return complex_.point(master.points[code - SplitTemplate::kFirstPoint]).position;
  return middle_of(master);
}

bool Divider::is_sound(const Master& master, const SplitTemplate& split, bool keeps_shape_floor) const {
  std::array<Vec3, 15> places;
  for (const SplitTemplate::Child& child : split.children) {
    for (const std::uint8_t code : child) places[code] = position_of(master, code);
  }
  return std::all_of(split.children.begin(), split.children.end(), [&](const SplitTemplate::Child& child) {
    const Vec3 &a = places[child[0]], &b = places[child[1]], &c = places[child[2]], &d = places[child[3]];
    return orient3d(a, b, c, d) > 0 && !(keeps_shape_floor && is_flat(a, b, c, d));
  });
}

std::vector<std::uint32_t> block_unsound(const TetMesh& mesh, std::span<const std::uint32_t> masters,
                                         bool keeps_shape_floor, SplitTemplates& templates, ClosedComplex& complex) {
  std::vector<std::uint32_t> blocked;
  Divider divider(mesh, templates, complex);
  const auto was_flat = [&](const Master& master) {
    return !master.is_divided() && mesh.is_flat_at_load(complex.children(master)[0]);
  };
  for (const std::uint32_t index : masters) {
    const Master& master = complex[index];
    const SplitTemplate& split = divider.find(master);
    if (split.children.size() == 1 || (!was_flat(master) && divider.is_sound(master, split, keeps_shape_floor))) {
      continue;
    }
    for (unsigned e = 0; e < 6; ++e) {
      if (needs_split(master, e) && complex.edges()[master.edges[e]].is_flagged()) {
        complex.block(master.edges[e]);
        blocked.push_back(master.edges[e]);
      }
    }
  }
  return blocked;
}

}  // namespace incise::inline v0
