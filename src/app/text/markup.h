// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace app {

/// A text as the content of an element, or of an attribute in double quotes, of XML or HTML. Cost: O(text).
[[nodiscard]] std::string as_markup(std::string_view text);

}  // namespace app
}  // namespace v0
}  // namespace incise
