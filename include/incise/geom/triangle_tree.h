// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "incise/geom/box.h"
#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// A tree of boxes over a soup of triangles: nearest point, and triangles near a box.
///
/// Building copies the corners; queries allocate nothing and may run on many threads. Equal inputs give equal trees
/// and equal answers, in equal order, on every target.
class TriangleTree {
 public:
  /// Indices of three points.
  using Triangle = std::array<std::uint32_t, 3>;

  /// The answer to `closest`.
  struct Hit {
    std::uint32_t triangle = std::numeric_limits<std::uint32_t>::max();  ///< index into the triangles given
    Vec3 point = Vec3::Zero();                                           ///< the nearest point of the soup
    double distance2 = std::numeric_limits<double>::infinity();          ///< squared distance to it

    /// Whether a triangle was found.
    [[nodiscard]] bool is_valid() const { return triangle != std::numeric_limits<std::uint32_t>::max(); }
  };

  /// A tree without triangles.
  TriangleTree() = default;

  /// Builds the tree.
  ///
  /// @param points     `n_points`, finite, in any length unit.
  /// @param triangles  `n_triangles × 3`, fewer than 2^32 − 1, indices into `points`; flat ones are allowed.
  /// Cost: O(n log n), about 0.5 µs per triangle at 100 000; about 140 bytes each. The arguments are not kept.
  TriangleTree(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles);

  /// The number of triangles.
  [[nodiscard]] std::size_t size() const { return leaves_.size(); }
  /// The box of all triangles; empty where there is none.
  [[nodiscard]] Box bounds() const { return nodes_.empty() ? Box() : nodes_.front().box; }

  /// Finds the point of the soup nearest to a point.
  ///
  /// @param point         finite.
  /// @param max_distance  points further away do not count; may be infinite.
  /// @return the nearest point, of equally near triangles the lowest; not valid where none is near enough.
  /// Cost: O(log n) where the point is near the surface.
  [[nodiscard]] Hit closest(const Vec3& point, double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Calls `report(triangle)` for every triangle whose box has a point in common with `box` (touching counts).
  ///
  /// Each is reported once, in the order of the tree's leaves: not ascending, but the same on every target.
  /// Cost: O(log n) and the triangles reported.
  template <class Report>
  void for_each_overlap(const Box& box, Report&& report) const {
    std::array<std::uint32_t, kMaxDepth> stack;
    std::size_t height = 0;
    if (!nodes_.empty()) {
      stack[height++] = 0;
    }
    while (height > 0) {
      const std::uint32_t index = stack[--height];
      const Node& node = nodes_[index];
      if (!node.box.overlaps(box)) {
        continue;
      }
      if (node.count == 0) {
        stack[height++] = node.next;
        stack[height++] = index + 1;
        continue;
      }
      for (std::uint32_t i = node.next; i < node.next + node.count; ++i) {
        if (node.count == 1 || box_of(leaves_[i]).overlaps(box)) {
          report(leaves_[i].triangle);
        }
      }
    }
  }

 private:
  /// Halving 2^32 triangles takes 32 levels; a walk keeps at most one pending node for each, and the current one.
  static constexpr std::size_t kMaxDepth = 64;

  // In preorder: the first child of an inner node follows it.
  struct Node {
    Box box;
    std::uint32_t next = 0;   // inner node: second child; leaf: first triangle
    std::uint32_t count = 0;  // triangles; 0 for an inner node
  };
  struct Leaf {
    std::array<Vec3, 3> corners;
    std::uint32_t triangle;
  };
  class Builder;

  static Box box_of(const Leaf& leaf) {
    return {leaf.corners[0].cwiseMin(leaf.corners[1]).cwiseMin(leaf.corners[2]),
            leaf.corners[0].cwiseMax(leaf.corners[1]).cwiseMax(leaf.corners[2])};
  }
  void search_leaf(const Node& node, const Vec3& point, Hit& best) const;

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

}  // namespace v0
}  // namespace incise
