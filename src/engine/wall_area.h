// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// By how much the steps of a journal from `first_step` on have made the walls of cuts grow: one side of the two,
/// at rest, in squared length units. `mesh` as it stands. Faces of tets that stay while a step moves their vertices are
/// left out. Cost: O(tets that the steps touched).
[[nodiscard]] double wall_growth(const Journal& journal, std::size_t first_step, const TetMesh& mesh);

}  // namespace detail
}  // namespace v0
}  // namespace incise
