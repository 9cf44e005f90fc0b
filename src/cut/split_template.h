// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cut/short_list.h"
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
  static constexpr std::size_t kMostChildren = 24;
  static constexpr std::size_t kMostFacets = 6;
  static constexpr std::size_t kMostInner = 2 * kMostChildren - 2;  // at least four sides of children are outer ones

  ShortList<Child, kMostChildren> children;                        ///< as positive as the parent
  ShortList<std::array<ChildSide, 2>, kMostInner> inner;           ///< pairs of sides that meet inside the parent
  std::array<ShortList<ChildSide, kMostFacets>, 4> outer;          ///< sides that lie on each side of the parent
  std::array<ShortList<std::uint16_t, kMostFacets>, 4> on_side;    ///< the codes of each of these, as bits
  ShortList<std::uint16_t, kMostChildren> codes;                   ///< of each child, as bits
  std::array<std::uint8_t, kCodes + std::size_t{1}> first_around;  ///< by code: into `all_around`
  std::array<std::uint8_t, 4 * kMostChildren> all_around;          ///< child · 4 + corner
  std::uint16_t number = 0;                                        ///< among the templates of a `SplitTemplates`
  std::uint8_t apex = kCodes;                                      ///< of a cone: the code that all children have

  /// The children that have a vertex, ascending: child · 4 + corner.
  [[nodiscard]] std::span<const std::uint8_t> around(std::uint8_t code) const {
    return {all_around.data() + first_around[code], all_around.data() + first_around[code + std::size_t{1}]};
  }
};

/// Makes and keeps the templates. Paper §2.2 ("a tetrahedron can be divided into two smaller tetrahedrons according to
/// the collision point"); the paper leaves the order open: it must be one total order of the mesh's edges, or
/// neighbours would triangulate their common face differently.
class SplitTemplates {
 public:
  SplitTemplates();
  /// The template for bisecting `order` (edge numbers, first bisected first, no repeats). The reference lives as long
  /// as this object. Cost: O(1) after the first use of an order.
  const SplitTemplate& find(std::span<const std::uint8_t> order);
  /// The template for a tet that the blade is still in: its sides divided as by bisecting `order`, or, where bit s of
  /// `pierced` is set, as a fan around a front point in side s; and a cone over all of them from a front point inside.
  /// Sound for any front points inside the tet and its sides. Cost: O(1) after the first use.
  const SplitTemplate& find_cone(std::span<const std::uint8_t> order, unsigned pierced) {
    return find_cone(order, pierced, SplitTemplate::kMiddle);
  }
  /// The same, from another point: `SplitTemplate::kFirstPoint + side`, the front point in a side that is pierced. The
  /// facets of this side are faces of the cone itself: there are fewer children, and no point inside.
  const SplitTemplate& find_cone(std::span<const std::uint8_t> order, unsigned pierced, std::uint8_t apex);

 private:
  /// So many templates stand in one piece of memory: few strokes need more.
  static constexpr std::uint32_t kBlock = 512;
  struct Slot {
    std::uint32_t key = 0, number = 0;  // of no template, where the key is 0
  };
  [[nodiscard]] Slot& slot_of(std::uint32_t key);
  template <class Make>
  const SplitTemplate& find_or_make(std::uint32_t key, Make&& make);
  void rehash();

  std::vector<std::unique_ptr<SplitTemplate[]>> blocks_;  // references stay valid
  std::vector<Slot> slots_;
  std::uint32_t count_ = 0;
};

}  // namespace v0
}  // namespace incise
