// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cut/cut_context.h"
#include "cut/sweep.h"

namespace incise {
inline namespace v0 {
namespace lab {

/// Divides every tet that the sheet crosses completely into 17 parts, four at each corner and one in the middle, with
/// points on all edges and sides, and separates those on its two sides. Walls get `tag`.
///
/// **Source:** the paper's [12]: D. Bielser, V. A. Maiwald, M. H. Gross, "Interactive cuts through 3-dimensional soft
/// tissue", Computer Graphics Forum 18(3), 1999. Readings: of 17 parts we have the number alone; this is the division
/// of that number that follows from a point on every edge and side. Points on crossed edges lie where the sheet crosses
/// them, others in the middle; on sides halfway between two crossings, and a little beside the sheet, since else the
/// part in the middle of a tet cut in half would be flat. Tets beside divided ones are divided as well, because this
/// mesh has no vertices in the middle of an edge or side: publications of springs at vertices and edges need not.
/// Whole crossings only. Cost: O(cut tets · log).
Status divide_into_17(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads);

/// The same with points on crossed edges, and on the sides between them, alone: eleven parts of a tet with a corner cut
/// off, fifteen of one cut in half. Walls lie on the sheet.
///
/// **Source:** the paper's [11]: D. Bielser, M. H. Gross, "Interactive simulation of surgical cuts", Pacific Graphics
/// 2000, which divides adaptively: only what the blade has crossed. Readings: the parts follow from the points; the
/// states that a tet goes through while the blade is in it are left out, so that the cut ends at the last tet that is
/// crossed completely. Cost: as above.
Status divide_adaptively(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads);

}  // namespace lab
}  // namespace v0
}  // namespace incise
