// SPDX-License-Identifier: Apache-2.0
// Methods of cutting that the paper compares itself with, each after its own publication, along whole planes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/geom/vec.h"
#include "incise/mesh/tet_soup.h"

namespace incise::bench {

/// The plane normal · x = offset; `normal` of length 1.
struct Plane {
  Vec3 normal;
  double offset = 0;

  [[nodiscard]] double height(const Vec3& point) const { return normal.dot(point) - offset; }
};

/// What a method made of a body, and the points of the walls that it left.
struct Cut {
  TetSoup soup;
  std::vector<std::uint32_t> wall_points;  ///< ascending; those of this cut
  std::uint64_t cut_tets = 0;              ///< tets of the input with corners on both sides
};

/// Removes every tet that the plane passes through: what is left of the cut is a gap with jagged walls. Points without
/// tets stay. **Source:** the paper's [7] and [8]: as in S. Cotin, H. Delingette, N. Ayache, "A hybrid elastic model
/// for real-time cutting", 2000, and C. Forest, H. Delingette, N. Ayache, "Removing tetrahedra from a manifold mesh",
/// 2002. Reading: without the refinement of [8], and tets that are left hanging at a vertex or an edge stay.
Cut remove_tets(TetSoup body, const Plane& plane);

/// Moves vertices onto the plane instead of dividing tets: for each edge that it crosses the nearer end, where no tet
/// turns over; then opens the faces between the tets of the two sides. The number of tets stays. **Source:** H.-W.
/// Nienhuys, A. F. van der Stappen, "A surgery simulation supporting cuts and finite element deformation", 2001 (the
/// paper's [9]). Reading: the path is known in advance, so that faces are chosen by the side of the tets' centres.
Cut snap_nodes(TetSoup body, const Plane& plane);

}  // namespace incise::bench
