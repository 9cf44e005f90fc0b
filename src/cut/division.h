// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <span>
#include <vector>

#include "cut/bisection_order.h"
#include "cut/closed_complex.h"
#include "cut/parity.h"

namespace incise {
inline namespace v0 {

namespace detail {

/// For each set of corners (bit c: corner c) the edges that have none of them, as a set (bit e: edge e).
inline constexpr std::array<std::uint8_t, 16> kEdgesWithout = [] {
  std::array<std::uint8_t, 16> edges{};
  for (unsigned corners = 0; corners < 16; ++corners) {
    for (unsigned e = 0; e < 6; ++e) {
      const bool has_one = ((corners >> kEdgeCorners[e][0] | corners >> kEdgeCorners[e][1]) & 1U) != 0;
      edges[corners] = static_cast<std::uint8_t>(edges[corners] | (has_one ? 0U : 1U << e));
    }
  }
  return edges;
}();

/// The edges of each side, as a set.
inline constexpr std::array<std::uint8_t, 4> kEdgesOfSide = [] {
  std::array<std::uint8_t, 4> edges{};
  for (unsigned s = 0; s < 4; ++s) {
    for (const unsigned e : kSideEdges[s]) edges[s] = static_cast<std::uint8_t>(edges[s] | 1U << e);
  }
  return edges;
}();

}  // namespace detail

/// The edges of a master that are to be split, as a set: flagged, and neither end takes part in the cut itself.
[[nodiscard]] inline unsigned split_edges(const Master& master) {
  return unsigned{master.flagged} & detail::kEdgesWithout[master.on & 15U];
}
/// Whether an edge of a master is to be split.
[[nodiscard]] inline bool needs_split(const Master& master, unsigned edge) {
  return ((split_edges(master) >> edge) & 1U) != 0;
}
/// Whether an odd number of the edges of a side of a master are flagged: the cut ends in it.
[[nodiscard]] inline bool is_odd_side(const Master& master, unsigned side) {
  return std::popcount(master.flagged & unsigned{detail::kEdgesOfSide[side]}) % 2 == 1;
}
/// Whether an edge of a side of a master is to be split.
[[nodiscard]] inline bool has_split_on(const Master& master, unsigned side) {
  return (split_edges(master) & detail::kEdgesOfSide[side]) != 0;
}

/// Finds how masters are to be divided, from their flags, ON vertices and front points.
class Divider {
 public:
  Divider(const TetMesh& mesh, SplitTemplates& templates, const ClosedComplex& complex)
      : mesh_(mesh), templates_(templates), complex_(complex) {}

  /// The template for a master as it is flagged now. Complete ones are bisected in one order of all edges (longest
  /// first, then by ends), so that neighbours agree; those that the blade is still in are coned. Paper §2.2, Figure 2.
  [[nodiscard]] const SplitTemplate& find(const Master& master);
  /// Whether the blade is still in a master, and something in it is split or the cut ends inside a side: it is coned.
  [[nodiscard]] static bool is_cone(const Master& master) {
    return has_odd_face(master.flagged) &&
           (split_edges(master) != 0 ||
            master.points != std::array<std::uint32_t, 4>{Master::kNone, Master::kNone, Master::kNone, Master::kNone});
  }
  /// What a coned master is coned from: at rest, where the front goes straight from side to side, the front point in a
  /// side that the sheet enters once; else a point inside.
  [[nodiscard]] std::uint8_t apex_of(const Master& master) const;
  /// Whether a master has a front point inside.
  [[nodiscard]] bool has_middle(const Master& master) const {
    return is_cone(master) && apex_of(master) == SplitTemplate::kMiddle;
  }
  /// Where the front point inside a coned master belongs: where the border of the sheet turns in it, drawn towards the
  /// front points in its sides as far as it must to keep off the sides; else amid these. So it is on a plane sheet.
  [[nodiscard]] Vec3 middle_of(const Master& master) const;
  /// The rest position of a vertex of a template.
  [[nodiscard]] Vec3 position_of(const Master& master, std::uint8_t code) const;
  /// Whether all children would be positive (and, where asked, not flat).
  [[nodiscard]] bool is_sound(const Master& master, const SplitTemplate& split, bool keeps_shape_floor) const;

 private:
  [[nodiscard]] std::span<const std::uint8_t> order_of(const Master& master);
  [[nodiscard]] Vec3 kept_inside(const Master& master, const Vec3& place, const Vec3& amid) const;

  const TetMesh& mesh_;
  SplitTemplates& templates_;
  const ClosedComplex& complex_;
  BisectionOrder order_;
};

/// Blocks the flagged edges of every master in the list that would get an unsound child, or was flat at load. Returns
/// the edges that were not blocked before.
std::vector<std::uint32_t> block_unsound(const TetMesh& mesh, std::span<const std::uint32_t> masters,
                                         bool keeps_shape_floor, SplitTemplates& templates, ClosedComplex& complex);

}  // namespace v0
}  // namespace incise
