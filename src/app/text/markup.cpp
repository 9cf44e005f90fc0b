// SPDX-License-Identifier: Apache-2.0
// Four characters have a meaning in markup; all others stand for themselves.
#include "app/text/markup.h"

namespace incise {
inline namespace v0 {
namespace app {

std::string as_markup(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
