// SPDX-License-Identifier: Apache-2.0
// Snapping first, in a step of its own, then the division of what is still crossed.
#include "lab/moving.h"

#include "lab/constants.h"
#include "lab/minimal.h"
#include "lab/snapping.h"
#include "paper/contact.h"
#include "paper/crossing.h"

namespace incise {
inline namespace v0 {
namespace lab {

Status move_and_divide(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads) {
  Neighbourhood near;
  find_crossings(context.mesh, sheet, find_near_tets(context.mesh, sheet, threads), near, threads);
  Transaction transaction(context.mesh);
  move_onto(transaction, sheet, near, kReachOfMoves, context.statistics);
  context.journal.append_if_changed(transaction.commit());
  const std::uint64_t moved = context.statistics.snapped_vertices;
  Status status = divide_minimally(context, sheet, tag, threads);
  context.statistics.snapped_vertices = moved;  // the division counts those on the sheet again
  return status;
}

}  // namespace lab
}  // namespace v0
}  // namespace incise
