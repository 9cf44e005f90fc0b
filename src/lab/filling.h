// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace lab {

/// A point of a tet: a corner in [0, 3], the point on one of its edges or sides, or one inside.
using PointCode = std::uint8_t;
constexpr PointCode edge_code(unsigned edge) {
  return static_cast<PointCode>(4 + edge);
}
constexpr PointCode side_code(unsigned side) {
  return static_cast<PointCode>(10 + side);
}
inline constexpr PointCode kInside = 14;
inline constexpr unsigned kPointCodes = 15;

/// The corners, as bits, of the smallest corner, edge, side or tet that a point lies on.
[[nodiscard]] unsigned support_of(PointCode code);

/// A part of a tet, by its points.
struct Child {
  std::array<PointCode, 4> points;
  bool is_beyond = false;  ///< on the other side of the sheet than the tet's other parts

  bool operator==(const Child&) const = default;
};

/// The vertices of a tet and of the points on it; those that are not there are invalid.
using PointVertices = std::array<VertexId, kPointCodes>;

/// Parts that fill a tet all of whose edges and sides have a point: four at each corner, and one in the middle.
/// `beyond`: bits of the corners on one side; of one, or of two. **Source:** see `divide_into_17`.
[[nodiscard]] std::vector<Child> fill_with_17(unsigned beyond);

/// Parts that fill a tet that has points on its crossed edges and on the sides with two of them alone: eleven where
/// one corner is cut off, fifteen where two are. `beyond` as above. `vertices` decide between equal ways. **Source:**
/// see `divide_adaptively`.
[[nodiscard]] std::vector<Child> fill_adaptively(unsigned beyond, const PointVertices& vertices);

/// Parts that fill a tet beside divided ones, which has points on some edges and sides: lines from one of its points
/// where these reach all others, else from one inside. Neighbours agree on common sides.
[[nodiscard]] std::vector<Child> fill_beside(const PointVertices& vertices);

/// Swaps points of parts so that all turn like the tet.
void orient(std::vector<Child>& children);

}  // namespace lab
}  // namespace v0
}  // namespace incise
