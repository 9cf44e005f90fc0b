// SPDX-License-Identifier: Apache-2.0
// Which template divides a master, where its points lie, and whether all children have volume by exact sign; where one
// has none, the master's edges are blocked (docs/internals.md, 3.6).
#include "cut/division.h"

#include <algorithm>

#include "cut/constants.h"
#include "cut/weights.h"
#include "incise/geom/predicates.h"
#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {

namespace {

Vec3 blend(const std::array<Vec3, 4>& p, const std::array<double, 4>& weights) {
  return weights[0] * p[0] + weights[1] * p[1] + weights[2] * p[2] + weights[3] * p[3];
}

}  // namespace

std::span<const std::uint8_t> Divider::order_of(const Master& master) {
  order_.clear();
  const unsigned split = split_edges(master);
  for (std::uint8_t e = 0; e < 6; ++e) {
    if (((split >> e) & 1U) == 0) continue;
    const ClosedEdge& edge = complex_.edges()[master.edges[e]];
    order_.add((mesh_.rest(edge.b) - mesh_.rest(edge.a)).squaredNorm(), complex_.rank(edge.a), complex_.rank(edge.b),
               e);
  }
  return order_.numbers();
}

const SplitTemplate& Divider::find(const Master& master) {
  const auto order = order_of(master);
  if (!is_cone(master)) {
    return templates_.find(order);
  }
  unsigned pierced = 0;
  for (unsigned s = 0; s < 4; ++s) {
    pierced |= (master.points[s] != Master::kNone ? 1U : 0U) << s;
  }
  return templates_.find_cone(order, pierced, apex_of(master));
}

std::uint8_t Divider::apex_of(const Master& master) const {
  if (complex_.is_in_motion() || master.corner_key != 0) return SplitTemplate::kMiddle;
  std::uint8_t apex = SplitTemplate::kMiddle;
  unsigned points = 0;
  for (unsigned s = 4; s-- > 0;) {
    if (master.points[s] == Master::kNone) continue;
    ++points;
    const unsigned edges = unsigned{detail::kEdgesOfSide[s]};
    const unsigned on = unsigned{master.on} & ~(1U << s) & 15U;
    if (std::popcount(master.flagged & edges) != 1 || std::popcount(on) > 1) continue;
    apex = static_cast<std::uint8_t>(SplitTemplate::kFirstPoint + s);
  }
  return points == 2 ? apex : SplitTemplate::kMiddle;
}

Vec3 Divider::middle_of(const Master& master) const {
  Vec3 sum = Vec3::Zero();
  unsigned count = 0;
  for (const std::uint32_t point : master.points) {
    if (point == Master::kNone) continue;
    sum += complex_.point(point).position;
    ++count;
  }
  if (count >= 2) {
    const Vec3 amid = sum / count;
    return master.corner_key != 0 ? kept_inside(master, master.corner, amid) : amid;
  }
  for (const VertexId v : master.vertices) sum += mesh_.rest(v);
  const Vec3 amid = sum / (4 + count);
  return master.corner_key != 0 ? kept_inside(master, master.corner, amid) : amid;
}

/// The first place on the way from `place` to `amid` that keeps its share from every side; where that is far, the place
/// next to it that does, off the sheet.
Vec3 Divider::kept_inside(const Master& master, const Vec3& place, const Vec3& amid) const {
  std::array<Vec3, 4> p;
  for (unsigned c = 0; c < 4; ++c) p[c] = mesh_.rest(master.vertices[c]);
  const double whole = signed_volume6(p[0], p[1], p[2], p[3]);
  const auto depths = [&](const Vec3& x) -> std::array<double, 4> {
    return {signed_volume6(x, p[1], p[2], p[3]) / whole, signed_volume6(p[0], x, p[2], p[3]) / whole,
            signed_volume6(p[0], p[1], x, p[3]) / whole, signed_volume6(p[0], p[1], p[2], x) / whole};
  };
  const std::array<double, 4> here = depths(place), there = depths(amid);
  double share = 0;
  for (unsigned c = 0; c < 4; ++c) {
    if (here[c] >= kInnerMargin) continue;
    share = there[c] > kInnerMargin ? std::max(share, (kInnerMargin - here[c]) / (there[c] - here[c])) : 1.0;
  }
  const Vec3 way = std::min(share, 1.0) * (amid - place);
  if (way.squaredNorm() <= kGreatestDraw * kGreatestDraw * (p[1] - p[0]).squaredNorm()) return place + way;
  return blend(p, kept_off(here, kInnerMargin));
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
  std::array<Vec3, SplitTemplate::kCodes> places;
  for (std::uint8_t code = 0; code < SplitTemplate::kCodes; ++code) {
    if (!split.around(code).empty()) places[code] = position_of(master, code);
  }
  return std::all_of(split.children.begin(), split.children.end(), [&](const SplitTemplate::Child& child) {
    const Vec3 &a = places[child[0]], &b = places[child[1]], &c = places[child[2]], &d = places[child[3]];
    // What is not flat has a volume far beyond what rounding can make: its sign is certain.
    return keeps_shape_floor ? !is_flat(a, b, c, d) : orient3d(a, b, c, d) > 0;
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
      const ClosedEdge& edge = complex.edges()[master.edges[e]];
      const bool is_settled = complex.is_settled(edge.a) || complex.is_settled(edge.b);
      if (needs_split(master, e) && edge.is_flagged() && !is_settled) {
        complex.block(master.edges[e]);
        blocked.push_back(master.edges[e]);
      }
    }
  }
  return blocked;
}

}  // namespace v0
}  // namespace incise
