// SPDX-License-Identifier: Apache-2.0
// Lattice points are whole numbers of half the finest edge, so that points are found by number and not by place; at
// each face of a leaf the pattern follows from the neighbour's size.
#include "image/octree.h"

#include <unordered_map>

#include "incise/geom/quality.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// A point of the lattice in half edges of the finest leaves: corners and middles of leaves are all even or all odd.
using Node = std::array<std::int32_t, 3>;

Node operator+(const Node& a, const Node& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Node half(const Node& a, const Node& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

}  // namespace

Octree::Octree(const Vec3& low, double edge, std::array<std::int32_t, 3> roots, int depth)
    : low_(low),
      unit_(edge / static_cast<double>(std::int32_t{1} << static_cast<unsigned>(depth))),
      roots_(roots),
      depth_(depth) {
  for (std::int32_t z = 0; z < roots[2]; ++z) {
    for (std::int32_t y = 0; y < roots[1]; ++y) {
      for (std::int32_t x = 0; x < roots[0]; ++x) {
        child_.push_back(0);
        at_.push_back({x * span(0), y * span(0), z * span(0)});
        level_.push_back(0);
      }
    }
  }
}

Vec3 Octree::low(std::size_t node) const {
  const Cell& at = at_[node];
  return low_ + unit_ * Vec3(at[0], at[1], at[2]);
}

void Octree::split(std::size_t leaf) {
  const Cell at = at_[leaf];
  const int level = level_[leaf] + 1;
  const std::int32_t step = span(level);
  child_[leaf] = static_cast<std::uint32_t>(at_.size());
  for (unsigned c = 0; c < 8; ++c) {
    child_.push_back(0);
    at_.push_back({at[0] + (c & 1U ? step : 0), at[1] + (c & 2U ? step : 0), at[2] + (c & 4U ? step : 0)});
    level_.push_back(static_cast<std::int8_t>(level));
  }
}

std::size_t Octree::find(const Cell& cell, int level) const {
  std::array<std::int32_t, 3> root{};
  for (std::size_t a = 0; a < 3; ++a) {
    if (cell[a] < 0 || cell[a] >= roots_[a] * span(0)) return nodes();
    root[a] = cell[a] / span(0);
  }
  auto node = static_cast<std::size_t>((root[2] * roots_[1] + root[1]) * roots_[0] + root[0]);
  while (child_[node] != 0 && level_[node] < level) {
    const std::int32_t step = span(level_[node] + 1);
    const Cell& at = at_[node];
    const unsigned c =
        (cell[0] - at[0] >= step ? 1U : 0U) + (cell[1] - at[1] >= step ? 2U : 0U) + (cell[2] - at[2] >= step ? 4U : 0U);
    node = child_[node] + c;
  }
  return node;
}

void Octree::balance() {
  for (int level = depth_; level > 1; --level) {
    for (std::size_t n = 0; n < nodes(); ++n) {  // splits below append coarser nodes only
      if (level_[n] != level) continue;
      const std::int32_t step = span(level);
      const Cell at = at_[n];
      for (int d = 0; d < 27; ++d) {
        const Cell beside = {at[0] + (d % 3 - 1) * step, at[1] + (d / 3 % 3 - 1) * step, at[2] + (d / 9 - 1) * step};
        for (std::size_t other = find(beside, level); other < nodes() && level_[other] < level - 1;
             other = find(beside, level)) {
          split(other);
        }
      }
    }
  }
}

/// Makes the tets at the faces of leaves.
class LatticeFiller {
 public:
  LatticeFiller(const Octree& tree, const std::function<bool(std::size_t)>& is_void) : tree_(tree), is_void_(is_void) {}

  LatticeTets run() {
    for (std::size_t n = 0; n < tree_.nodes(); ++n) {
      if (!tree_.is_leaf(n)) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        fill_face(n, axis, false);
        fill_face(n, axis, true);
      }
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] Node middle(std::size_t n) const {
    const Cell& at = tree_.at_[n];
    const std::int32_t s = tree_.span(tree_.level(n));
    return {2 * at[0] + s, 2 * at[1] + s, 2 * at[2] + s};
  }

  /// The corners of a face in order around it.
  [[nodiscard]] std::array<Node, 4> corners(std::size_t n, std::size_t axis, bool is_high) const {
    const Cell& at = tree_.at_[n];
    const std::int32_t s = 2 * tree_.span(tree_.level(n));
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    Node low = {2 * at[0], 2 * at[1], 2 * at[2]};
    if (is_high) low[axis] += s;
    Node right = {0, 0, 0}, up = {0, 0, 0};
    right[u] = s;
    up[v] = s;
    return {low, low + right, low + right + up, low + up};
  }

  /// Whether a leaf smaller than those of this level ends in the middle of an edge between two of its corners.
  [[nodiscard]] bool is_edge_split(const Node& a, const Node& b, int level) const {
    const std::int32_t s = tree_.span(level);
    Cell low = {a[0] / 2, a[1] / 2, a[2] / 2};
    std::size_t along = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(a[d], b[d]) / 2;
      if (a[d] != b[d]) along = d;
    }
    const std::size_t u = (along + 1) % 3, v = (along + 2) % 3;
    for (unsigned c = 0; c < 4; ++c) {
      Cell beside = low;
      beside[u] -= c & 1U ? s : 0;
      beside[v] -= c & 2U ? s : 0;
      const std::size_t n = tree_.find(beside, level);
      if (n < tree_.nodes() && tree_.level(n) == level && !tree_.is_leaf(n)) return true;
    }
    return false;
  }

  void fill_face(std::size_t n, std::size_t axis, bool is_high) {
    Cell beside = tree_.at_[n];
    const int level = tree_.level(n);
    beside[axis] += is_high ? tree_.span(level) : -tree_.span(level);
    const std::size_t other = tree_.find(beside, level);
    if (other == tree_.nodes() || (is_void_(n) && is_void_(other))) return;
    const std::array<Node, 4> corner = corners(n, axis, is_high);
    if (tree_.level(other) < level) {
      halves_of_pyramid(n, corner, middle(other), axis);
    } else if (!tree_.is_leaf(other)) {
      quarters(n, corner);
    } else if (is_high) {
      for (std::size_t e = 0; e < 4; ++e) around_edge(middle(n), middle(other), corner[e], corner[(e + 1) % 4], level);
    }
  }

  /// Between two leaves of one size.
  void around_edge(const Node& m, const Node& o, const Node& a, const Node& b, int level) {
    if (!is_edge_split(a, b, level)) return add(m, o, a, b);
    add(m, o, a, half(a, b));
    add(m, o, half(a, b), b);
  }

  /// Towards four smaller leaves.
  void quarters(std::size_t n, const std::array<Node, 4>& corner) {
    const Node m = middle(n), f = half(corner[0], corner[2]);
    for (std::size_t e = 0; e < 4; ++e) {
      const Node &a = corner[e], &b = corner[(e + 1) % 4];
      add(m, f, a, half(a, b));
      add(m, f, half(a, b), b);
    }
  }

  /// Towards a larger leaf: the diagonal starts at the middle of the larger face.
  void halves_of_pyramid(std::size_t n, const std::array<Node, 4>& corner, const Node& larger, std::size_t axis) {
    std::size_t start = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      if (corner[c][u] == larger[u] && corner[c][v] == larger[v]) start = c;
    }
    const Node m = middle(n), &k = corner[start], &across = corner[(start + 2) % 4];
    add(m, k, corner[(start + 1) % 4], across);
    add(m, k, across, corner[(start + 3) % 4]);
  }

  void add(const Node& a, const Node& b, const Node& c, const Node& d) {
    std::array<std::uint32_t, 4> tet = {id(a), id(b), id(c), id(d)};
    const auto& p = out_.points;
    if (signed_volume6(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]) < 0) std::swap(tet[2], tet[3]);
    out_.tets.push_back(tet);
  }

  std::uint32_t id(const Node& node) {
    const auto part = [&](std::size_t a, unsigned shift) { return static_cast<std::uint64_t>(node[a]) << shift; };
    const std::uint64_t key = part(0, 0) | part(1, 21) | part(2, 42);
    const auto [found, is_new] = ids_.emplace(key, static_cast<std::uint32_t>(out_.points.size()));
    if (is_new) out_.points.push_back(tree_.low_ + 0.5 * tree_.unit_ * Vec3(node[0], node[1], node[2]));
    return found->second;
  }

  const Octree& tree_;
  const std::function<bool(std::size_t)>& is_void_;
  LatticeTets out_;
  std::unordered_map<std::uint64_t, std::uint32_t> ids_;
};

LatticeTets Octree::fill(const std::function<bool(std::size_t)>& is_void) const {
  return LatticeFiller(*this, is_void).run();
}

}  // namespace image
}  // namespace v0
}  // namespace incise
