// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cut/cut_context.h"
#include "cut/sweep.h"

namespace incise {
inline namespace v0 {
namespace lab {

/// Divides the tets that the sheet crosses into the fewest children that fill both sides, with new vertices on crossed
/// edges alone: four of a tet with three crossed edges, six of one with four; and separates them. Walls get `tag`.
///
/// **Source:** the paper's [13]: A. B. Mor, T. Kanade, "Modifying soft tissue models: progressive cutting with minimal
/// new element creation", MICCAI 2000. Reading: of whole crossings; its temporary division of a tet that the blade is
/// still in is left out, so that the cut ends at the last tet that is crossed completely. It is what the paper's own
/// subdivision and separation do (`SheetCut`), each sheet by itself. Cost: as `SheetCut::cut`.
Status divide_minimally(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads);

}  // namespace lab
}  // namespace v0
}  // namespace incise
