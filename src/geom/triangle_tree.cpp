// SPDX-License-Identifier: Apache-2.0
// Halves the triangles at the median of their boxes' centres, along the longest side of the box of these centres.
#include "incise/geom/triangle_tree.h"

#include <algorithm>
#include <utility>

#include "geom/constants.h"
#include "incise/geom/closest.h"

namespace incise {
inline namespace v0 {

class TriangleTree::Builder {
 public:
  Builder(TriangleTree& tree, const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) : tree_(tree) {
    items_.reserve(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      Item item;
      item.leaf = {{points[triangles[i][0]], points[triangles[i][1]], points[triangles[i][2]]}, i};
      const Box box = box_of(item.leaf);
      item.centre2 = box.lo + box.hi;
      items_.push_back(item);
    }
  }

  void build() {
    if (items_.empty()) {
      return;
    }
    tree_.leaves_.reserve(items_.size());
    tree_.nodes_.reserve(items_.size());
    add(0, items_.size());
  }

 private:
  struct Item {
    Leaf leaf;
    Vec3 centre2;  // twice the centre of the box
  };

  void add(std::size_t first, std::size_t last) {
    const std::size_t index = tree_.nodes_.size();
    tree_.nodes_.push_back({box_of_range(first, last), 0, 0});
    if (last - first <= kTreeLeafSize) {
      add_leaf(index, first, last);
      return;
    }
    const std::size_t middle = halve(first, last);
    add(first, middle);
    tree_.nodes_[index].next = static_cast<std::uint32_t>(tree_.nodes_.size());
    add(middle, last);
  }

  void add_leaf(std::size_t index, std::size_t first, std::size_t last) {
    std::sort(begin() + offset(first), begin() + offset(last),
              [](const Item& a, const Item& b) { return a.leaf.triangle < b.leaf.triangle; });
    tree_.nodes_[index].next = static_cast<std::uint32_t>(tree_.leaves_.size());
    tree_.nodes_[index].count = static_cast<std::uint32_t>(last - first);
    for (std::size_t i = first; i < last; ++i) {
      tree_.leaves_.push_back(items_[i].leaf);
    }
  }

  /// Which triangles go where depends on a total order alone, not on how the library selects.
  std::size_t halve(std::size_t first, std::size_t last) {
    Box centres;
    for (std::size_t i = first; i < last; ++i) {
      centres.extend(items_[i].centre2);
    }
    const Vec3 size = centres.hi - centres.lo;
    const Eigen::Index axis = size.x() >= size.y() && size.x() >= size.z() ? 0 : (size.y() >= size.z() ? 1 : 2);
    const std::size_t middle = first + (last - first) / 2;
    std::nth_element(begin() + offset(first), begin() + offset(middle), begin() + offset(last),
                     [axis](const Item& a, const Item& b) {
                       return a.centre2[axis] < b.centre2[axis] ||
                              (a.centre2[axis] == b.centre2[axis] && a.leaf.triangle < b.leaf.triangle);
                     });
    return middle;
  }

  [[nodiscard]] Box box_of_range(std::size_t first, std::size_t last) const {
    Box box;
    for (std::size_t i = first; i < last; ++i) {
      box.extend(box_of(items_[i].leaf));
    }
    return box;
  }

  std::vector<Item>::iterator begin() { return items_.begin(); }
  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  TriangleTree& tree_;
  std::vector<Item> items_;
};

TriangleTree::TriangleTree(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  Builder(*this, points, triangles).build();
}

void TriangleTree::search_leaf(const Node& node, const Vec3& point, Hit& best) const {
  for (std::uint32_t i = node.next; i < node.next + node.count; ++i) {
    const Leaf& leaf = leaves_[i];
    const ClosestPoint found = closest_on_triangle(point, leaf.corners[0], leaf.corners[1], leaf.corners[2]);
    if (found.distance2 < best.distance2 || (found.distance2 == best.distance2 && leaf.triangle < best.triangle)) {
      best = {leaf.triangle, found.point, found.distance2};
    }
  }
}

TriangleTree::Hit TriangleTree::closest(const Vec3& point, double max_distance) const {
  struct Pending {
    std::uint32_t node;
    double distance2;
  };
  std::array<Pending, kMaxDepth> stack;
  std::size_t height = 0;
  Hit best;
  best.distance2 = max_distance >= 0.0 ? max_distance * max_distance : -1.0;
  if (!nodes_.empty()) {
    stack[height++] = {0, nodes_.front().box.distance2(point)};
  }
  while (height > 0) {
    const Pending top = stack[--height];
    if (top.distance2 * kBoxSlack > best.distance2) {
      continue;
    }
    const Node& node = nodes_[top.node];
    if (node.count != 0) {
      search_leaf(node, point, best);
      continue;
    }
    Pending near{top.node + 1, nodes_[top.node + 1].box.distance2(point)};
    Pending far{node.next, nodes_[node.next].box.distance2(point)};
    if (far.distance2 < near.distance2) {
      std::swap(near, far);
    }
    stack[height++] = far;
    stack[height++] = near;
  }
  return best.is_valid() ? best : Hit();
}

}  // namespace v0
}  // namespace incise
