// SPDX-License-Identifier: Apache-2.0
// What completion and manual pages ask of an option of CLI11.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

namespace incise_apps {

/// A flag takes no value.
[[nodiscard]] inline bool is_flag(const CLI::Option& option) {
  return option.get_items_expected_max() == 0;
}

/// Its names with their dashes: "-o", "--output".
[[nodiscard]] inline std::vector<std::string> dashed_names(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// The words that it takes, where it takes no others: CLI11 describes a set as "TEXT:{a,b}".
[[nodiscard]] inline std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find('{'), close = type.rfind('}');
  std::vector<std::string> choices;
  if (open == std::string::npos || close == std::string::npos || close < open) return choices;
  for (std::size_t at = open + 1; at < close;) {
    const std::size_t end = std::min(type.find(',', at), close);
    choices.push_back(type.substr(at, end - at));
    at = end + 1;
  }
  return choices;
}

/// Whether its value may be the name of a file: numbers and sets are none.
[[nodiscard]] inline bool takes_file(const CLI::Option& option) {
  return !is_flag(option) && choices_of(option).empty() && option.get_type_name().rfind("TEXT", 0) == 0;
}

}  // namespace incise_apps
