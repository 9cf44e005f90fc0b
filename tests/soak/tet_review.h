// SPDX-License-Identifier: Apache-2.0
// Looks at tets as a stranger would who was handed the file: no code of the library takes part.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "incise/mesh/tet_soup.h"

namespace incise::test {

struct TetReview {
  std::size_t tets = 0;
  std::size_t components = 0;  ///< joined through faces
  std::size_t surfaces = 0;  ///< of the boundary, joined through edges: more than pieces where walls enclose something
  double volume = 0;
  double worst_ratio = 0;  ///< longest edge over inradius; infinite where a tet is flat

  // Defects.
  std::size_t nonpositive = 0;
  std::size_t nonfinite = 0;        ///< points
  std::size_t strange_corners = 0;  ///< tets that name a point twice, or one that is not there
  std::size_t duplicate_tets = 0;
  std::size_t overshared_faces = 0;    ///< with more than two tets
  std::size_t bad_edges = 0;           ///< of the boundary, with other than two of its faces
  std::size_t singleton_vertices = 0;  ///< whose tets do not all hang together through faces at the vertex
  std::size_t loose_vertices = 0;      ///< of no tet
};

/// Tets with strange corners are counted, and otherwise left out. Cost: O(n log n).
[[nodiscard]] TetReview review(const TetSoup& soup);

/// The defects of which there are more than there were, in words; empty where none is.
[[nodiscard]] std::vector<std::string> grown_defects(const TetReview& before, const TetReview& after);

/// Whether there is no defect at all.
[[nodiscard]] bool is_spotless(const TetReview& found);

/// Whether every point lies behind every face of the boundary, up to rounding. Cost: O(faces × points) at worst.
[[nodiscard]] bool is_convex(const TetSoup& soup);

}  // namespace incise::test
