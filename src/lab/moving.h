// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cut/cut_context.h"
#include "cut/sweep.h"

namespace incise {
inline namespace v0 {
namespace lab {

/// Moves vertices near the sheet onto it, where no tet turns over, and divides what it still crosses as
/// `divide_minimally` does. Walls get `tag`.
///
/// **Source:** the paper's [10], of which its text names O. Çakır alone: O. Çakır, R. Yazıcı, "Real-time cutting
/// simulation based on stiffness-warped FEM", ISCIS 2009, is what we take it for. Readings: the paper says of it that
/// it "moves the vertexes along the cutting trajectory and then subdivides the mesh" and that it thereby keeps the
/// complexity low; we have no more of it. Of each crossed edge the nearer end moves, where the edge is crossed within
/// `kReachOfMoves` of it, to the nearest point of the sheet, vertices of the skin like all others. Cost: one pass over
/// the mesh, then as `divide_minimally`.
Status move_and_divide(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads);

}  // namespace lab
}  // namespace v0
}  // namespace incise
