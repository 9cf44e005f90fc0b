// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/jobs/report.h"
#include "app/text/json_write.h"

namespace incise {
inline namespace v0 {
namespace app {

Json encode(const Percentiles& percentiles);
/// What `to_json` prints.
[[nodiscard]] Json report_tree(const JobReport& report);

}  // namespace app
}  // namespace v0
}  // namespace incise
