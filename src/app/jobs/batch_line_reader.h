// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "app/jobs/batch_lines.h"
#include "app/jobs/batch_plan.h"
#include "app/text/range_reader.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Reads a line of results, and checks that it is one: of this plan, and with all the fields that the program writes of
/// such an item, each of its type, and no others. Of a line of another version of the program only what is needed is
/// asked for: what its fields are is not known here.
class BatchLineReader {
 public:
  /// The plan has to outlive it; `file_name` is for messages.
  BatchLineReader(const BatchPlan& plan, std::string_view file_name) : plan_(plan), read_(file_name) {}

  /// Whether the line is a result; else `error` says what is wrong with it.
  bool run(const JsonValue& root, BatchLine& line);
  [[nodiscard]] const Error& error() const { return read_.error(); }
  [[nodiscard]] bool is_of_another_plan() const { return is_of_another_plan_; }

 private:
  bool read_item(const JsonValue& root, BatchLine& line);
  bool read_head(const JsonValue& root, BatchLine& line);
  bool read_words(const JsonValue& root);
  bool read_failure(const JsonValue& root);
  bool read_figures(const JsonValue& root, BatchLine& line);
  bool has_fields_of_a_cut(const JsonValue& root);
  bool read_input(const JsonValue& root, BatchLine& line);
  bool read_files(const JsonValue& root, BatchLine& line);
  bool read_file_name(const JsonValue& object, const std::string& path, const char* key, const std::string& wanted,
                      std::string& out);
  bool read_hash(const JsonValue& value, const std::string& path, std::uint64_t& out);

  const BatchPlan& plan_;
  RangeReader read_;
  const BatchItem* item_ = nullptr;  // of the plan
  bool is_of_another_plan_ = false;
  bool is_own_ = false;  // of this version of the program
};

}  // namespace app
}  // namespace v0
}  // namespace incise
