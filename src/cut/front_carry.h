// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cut/surface_index.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

/// Moves the front of older cuts to where a blade stands that goes on from it.
///
/// A stroke shorter than an element that starts where an older one ended cuts nothing anew: it is the same cut, and its
/// front is a little further. What is cut anew beside an old front is made of tets as thin as the stroke is short.
/// `from`, `to`: the blade in the rest shape, then and now, with as many points. `spacing`: the length of a typical
/// edge. No tet around a vertex that moves gets worse than L/r 25, or than it was, volumes stay, and on the skin only
/// vertices on flat parts move; none on a border between regions. Those that cannot go all the way go a part of it, or
/// stay. Cost: O(boundary sides that the blade passes), and that of the stars of the vertices found.
/// @return how far behind the blade the last vertex is left, in length units.
[[nodiscard]] double carry_front(Transaction& transaction, const SurfaceIndex& surface, std::span<const Vec3> from,
                                 std::span<const Vec3> to, double spacing);

}  // namespace v0
}  // namespace incise
