// SPDX-License-Identifier: Apache-2.0
// The surfaces of several strips in one, the last first, so that its triangles keep their numbers (docs/internals.md,
// 3.12).
#include "paper/sheet_so_far.h"

namespace incise {
inline namespace v0 {

SheetSoFar::SheetSoFar(const Strip& strip, std::span<const std::shared_ptr<const Strip>> before)
    : strip_(strip.sheet), border_(strip.border), whole_(&strip.sheet) {
  if (before.empty()) return;
  together_ = strip.surface;
  for (const auto& earlier : before) append(together_, earlier->surface);
  whole_ = &together_sheet_.emplace(together_);
}

}  // namespace v0
}  // namespace incise
