// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace app {

/// The longest message, in bytes.
inline constexpr std::size_t kLongestMessage = 480;

/// A message of at most `kLongestMessage` bytes: of a longer one its beginning, " ... ", and with the remedy its end.
/// No character of several bytes is cut within.
[[nodiscard]] std::string shortened(std::string_view text);

}  // namespace app
}  // namespace v0
}  // namespace incise
