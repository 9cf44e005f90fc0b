// SPDX-License-Identifier: Apache-2.0
// The plan reader on any bytes: an error that names the file, or items that can be told apart. It reads scenes within
// the plan as well; files that a plan names are looked for in a folder that is not there.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string_view>

#include "app/jobs/batch_plan.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto plan = incise::app::parse_batch_plan(text, "fuzz.json", "/nowhere");
  if (!plan.ok()) {
    if (plan.error().message.rfind("fuzz.json:", 0) != 0) std::abort();
    return 0;
  }
  if (plan->items.empty() || plan->items.size() > incise::app::kMaxBatchItems) std::abort();
  std::set<std::string_view> names;
  for (const incise::app::BatchItem& item : plan->items) {
    const bool is_plain = item.name.find_first_of("/\\ ") == std::string::npos && !item.name.empty();
    if (!is_plain || !names.insert(item.name).second) std::abort();
  }
  return 0;
}
