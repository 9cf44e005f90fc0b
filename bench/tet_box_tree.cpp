// SPDX-License-Identifier: Apache-2.0
#include "tet_box_tree.h"

#include <algorithm>
#include <bit>

#include "incise/mesh/bounds.h"

namespace incise::bench {

namespace {

/// Every third bit of the result is one of the lowest 21 of `x`.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1FFFFFU;
  x = (x | x << 32U) & 0x1F00000000FFFFULL;
  x = (x | x << 16U) & 0x1F0000FF0000FFULL;
  x = (x | x << 8U) & 0x100F00F00F00F00FULL;
  x = (x | x << 4U) & 0x10C30C30C30C30C3ULL;
  return (x | x << 2U) & 0x1249249249249249ULL;
}

/// Whether all corners of a tet lie strictly beyond one of the planes that bound a triangle's prism, or on one side of
/// its own plane.
bool is_apart(const TetMesh& mesh, TetId tet, const std::array<Vec3, 3>& triangle) {
  const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const auto all_beyond = [&](const Vec3& direction, const Vec3& through) {
    const TetVertices& v = mesh.vertices(tet);
    return std::all_of(v.begin(), v.end(), [&](VertexId x) { return direction.dot(mesh.rest(x) - through) > 0; });
  };
  if (all_beyond(normal, triangle[0]) || all_beyond(-normal, triangle[0])) return true;
  for (unsigned k = 0; k < 3; ++k) {
    const Vec3 &from = triangle[k], &to = triangle[(k + 1) % 3];
    if (all_beyond((to - from).cross(normal), from)) return true;
  }
  return false;
}

}  // namespace

TetBoxTree::TetBoxTree(const TetMesh& mesh) {
  const Box bounds = rest_bounds(mesh);
  const Vec3 extent = bounds.hi - bounds.lo;
  std::vector<std::pair<std::uint64_t, TetId>> order;
  order.reserve(mesh.tet_count());
  mesh.for_each_tet([&](TetId tet) {
    Vec3 middle = Vec3::Zero();
    for (const VertexId v : mesh.vertices(tet)) middle += 0.25 * mesh.rest(v);
    std::uint64_t code = 0;
    for (int k = 0; k < 3; ++k) {
      const double share = (middle[k] - bounds.lo[k]) / std::max(extent[k], 1e-300);
      code |= spread(static_cast<std::uint64_t>(share * 2097151.0)) << static_cast<unsigned>(k);
    }
    order.emplace_back(code, tet);
  });
  std::sort(order.begin(), order.end());
  tets_.reserve(order.size());
  for (const auto& entry : order) tets_.push_back(entry.second);
  const std::size_t leaves = std::bit_ceil((tets_.size() + kLeafSize - 1) / kLeafSize);
  first_leaf_ = leaves - 1;
  boxes_.resize(2 * leaves - 1);
  refit(mesh);
}

std::span<const TetId> TetBoxTree::leaf(std::size_t index) const {
  const std::size_t first = std::min(tets_.size(), (index - first_leaf_) * kLeafSize);
  return std::span(tets_).subspan(first, std::min(kLeafSize, tets_.size() - first));
}

void TetBoxTree::refit(const TetMesh& mesh) {
  for (std::size_t i = first_leaf_; i < boxes_.size(); ++i) {
    Box box;
    for (const TetId tet : leaf(i)) {
      for (const VertexId v : mesh.vertices(tet)) box.extend(mesh.rest(v));
    }
    boxes_[i] = box;
  }
  for (std::size_t i = first_leaf_; i-- > 0;) {
    boxes_[i] = boxes_[2 * i + 1];
    boxes_[i].extend(boxes_[2 * i + 2]);
  }
}

std::size_t TetBoxTree::count_hits(const TetMesh& mesh, std::span<const std::array<Vec3, 3>> triangles) const {
  Box all;
  for (const auto& triangle : triangles) {
    for (const Vec3& point : triangle) all.extend(point);
  }
  std::size_t hits = 0;
  std::array<std::size_t, 64> stack{};
  std::size_t depth = 1;
  while (depth > 0) {
    const std::size_t i = stack[--depth];
    if (!boxes_[i].overlaps(all)) continue;
    if (i < first_leaf_) {
      stack[depth++] = 2 * i + 1;
      stack[depth++] = 2 * i + 2;
      continue;
    }
    for (const TetId tet : leaf(i)) {
      const bool is_hit = std::any_of(triangles.begin(), triangles.end(),
                                      [&](const auto& triangle) { return !is_apart(mesh, tet, triangle); });
      hits += is_hit ? 1U : 0U;
    }
  }
  return hits;
}

}  // namespace incise::bench
