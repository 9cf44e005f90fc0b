// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <string>

namespace incise {
inline namespace v0 {
namespace app {

/// What `formatted` comes to: its values with their types kept beside them, so that {fmt} itself is compiled once.
[[nodiscard]] std::string formatted_values(fmt::string_view pattern, fmt::format_args values);

/// A pattern of {fmt} with its values put in: formatted("{} of {:.3g} mm", count, length). The pattern is checked while
/// compiling. Thread-safe. Cost: O(length).
template <class... T>
[[nodiscard]] std::string formatted(fmt::format_string<const T&...> pattern, const T&... values) {
  return formatted_values(pattern, fmt::make_format_args(values...));
}

}  // namespace app
}  // namespace v0
}  // namespace incise
