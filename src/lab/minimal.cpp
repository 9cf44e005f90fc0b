// SPDX-License-Identifier: Apache-2.0
// The paper's own division of one sheet, with a front that is thrown away.
#include "lab/minimal.h"

#include "paper/sheet_cut.h"

namespace incise {
inline namespace v0 {
namespace lab {

Status divide_minimally(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads) {
  IncisionFront front;
  SheetCut cut(threads);
  Status status = cut.cut(context, SheetSoFar(sheet), tag, front);
  context.statistics.latent_faces += cut.latent_faces();
  return status;
}

}  // namespace lab
}  // namespace v0
}  // namespace incise
