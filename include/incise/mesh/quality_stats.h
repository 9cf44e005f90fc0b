// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// L/r above which a tet is not fit to simulate. **Source:** Paper §4.3, Table 3 ("measurement > 200").
inline constexpr double kBadRatio = 200.0;

/// The quality of a set of tets at rest, as the paper's tables give it. All zero where the set is empty.
///
/// L/r is the longest edge over the inradius: 2√6 ≈ 4.899 for a regular tet, larger is worse. Flat tets have none;
/// they count as bad and as flat, and stay out of the other figures.
struct QualityStats {
  std::uint64_t tets = 0;       ///< measured, flat ones included
  std::uint64_t flat_tets = 0;  ///< |V| ≤ `kFlatTetRatio` · L³
  double lr_min = 0;            ///< the best
  double lr_mean = 0;           ///< arithmetic
  double lr_p99 = 0;            ///< nearest rank
  double lr_max = 0;            ///< the worst
  double lr_over_200_pct = 0;   ///< percent of `tets` with L/r > 200, flat ones included
  double dihedral_min_deg = 0;  ///< degree, (0, 180)
  double dihedral_max_deg = 0;  ///< degree, (0, 180)
};

/// Measures the live tets for which `is_counted` holds; all where it is empty.
///
/// Deterministic on one platform; angles go through libm and are for reports only.
/// Cost: O(tets), about 0.3 µs per tet and 8 bytes of scratch. Thread-safe between commits.
/// **Source:** Paper §2.5 and §4, Tables 2 and 3.
[[nodiscard]] QualityStats measure_quality(const TetMesh& mesh, const std::function<bool(TetId)>& is_counted = {});

/// Whether a tet has a vertex on a cut wall.
[[nodiscard]] bool touches_cut(const TetMesh& mesh, TetId tet);

}  // namespace v0
}  // namespace incise
