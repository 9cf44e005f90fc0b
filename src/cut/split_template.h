// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {

/// How one tet falls apart when some of its edges are bisected one after the other.
///
/// Vertices are codes: 0 to 3 the corners, 4 + e the split point of edge e, 10 + s the front point in side s, 14 the
/// front point inside.
struct SplitTemplate {
  using Child = std::array<std::uint8_t, 4>;
  /// A side of a child: child · 4 + side.
  using ChildSide = std::uint8_t;
  static constexpr std::uint8_t kFirstSplit = 4, kFirstPoint = 10, kMiddle = 14, kCodes = 15;

  std::vector<Child> children;                  ///< as positive as the parent
  std::vector<std::array<ChildSide, 2>> inner;  ///< pairs of sides that meet inside the parent
  std::array<std::vector<ChildSide>, 4> outer;  ///< sides that lie on each side of the parent
  std::vector<std::uint16_t> codes;             ///< of each child, as bits
  std::array<std::vector<std::uint8_t>, kCodes>
      around;  ///< the children that have a vertex, ascending: child · 4 + corner
};

/// Makes and keeps the templates. Paper §2.2 ("a tetrahedron can be divided into two smaller tetrahedrons according to
/// the collision point"); the paper leaves the order open: it must be one total order of the mesh's edges, or
/// neighbours would triangulate their common face differently.
class SplitTemplates {
 public:
  /// The template for bisecting `order` (edge numbers, first bisected first, no repeats). The reference lives as long
  /// as this object. Cost: O(1) after the first use of an order.
  const SplitTemplate& find(std::span<const std::uint8_t> order);
  /// The template for a tet that the blade is still in: its sides divided as by bisecting `order`, or, where bit s of
  /// `pierced` is set, as a fan around a front point in side s; and a cone over all of them from a front point inside.
  /// Sound for any front points inside the tet and its sides. Cost: O(1) after the first use.
  const SplitTemplate& find_cone(std::span<const std::uint8_t> order, unsigned pierced);

 private:
  std::unordered_map<std::uint32_t, SplitTemplate> templates_;  // node-based: references stay valid; never iterated
};

}  // namespace v0
}  // namespace incise
