// SPDX-License-Identifier: Apache-2.0
// How many pieces whole planes leave of a body: found on the body as it was before, by the sides on which its tets lie.
// Nothing is said where a piece is so thin that a cutter may well lose it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "incise/mesh/tet_soup.h"

namespace incise::test {

struct SheetPlane {
  Vec3 through, normal;  ///< of length 1

  [[nodiscard]] double height(const Vec3& p) const { return (p - through).dot(normal); }
};

/// Pieces on both sides of a plane; none where one reaches less than `thin` away from it.
[[nodiscard]] std::optional<std::size_t> pieces_of_plane(const TetSoup& soup, const SheetPlane& plane, double thin);

/// Pieces of a convex body between planes that all pass through one line: twice their number; none where one reaches
/// nowhere `thin` away from all planes.
[[nodiscard]] std::optional<std::size_t> pieces_of_star(const TetSoup& soup, const std::vector<SheetPlane>& planes,
                                                        double thin);

/// Pieces of a convex body that is cut along a wall, and then along the part of a divider, across the wall, that lies
/// `from` or more above it: three, two where a gap stays, none where it is hard to say.
[[nodiscard]] std::optional<std::size_t> pieces_of_tee(const TetSoup& soup, const SheetPlane& wall,
                                                       const SheetPlane& divider, double from, double thin);

}  // namespace incise::test
