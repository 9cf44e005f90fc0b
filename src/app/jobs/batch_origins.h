// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "app/jobs/batch_lines.h"
#include "app/jobs/batch_plan.h"
#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What the results of a batch were made from: one version of the program, and one mesh under each name of the plan.
/// Workers on several machines may have had others, whose results must not be mixed. The plan has to outlive it.
class BatchOrigins {
 public:
  explicit BatchOrigins(const BatchPlan& plan) : plan_(plan) {}

  /// A result was made by `program`; `where` says which one, for messages. Errors: kBadFile, naming both, where one
  /// before it was made by another program.
  Status add_program(const std::string& program, const std::string& where);
  /// The mesh that an item of the plan begins with had this key (`BatchItemResult::input_key`). Errors: likewise.
  Status add_input(std::uint64_t item, std::uint64_t key, const std::string& where);
  /// What a line says of both.
  Status add(const BatchLine& line);

 private:
  const BatchPlan& plan_;
  std::pair<std::string, std::string> program_;                            // and where it was seen first
  std::map<std::uint64_t, std::pair<std::uint64_t, std::string>> inputs_;  // by `BatchItem::source`: keys, likewise
};

}  // namespace app
}  // namespace v0
}  // namespace incise
