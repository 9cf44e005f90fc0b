// SPDX-License-Identifier: Apache-2.0
// The one source that {fmt} is compiled in, of its headers alone: nothing is linked, in WebAssembly neither.
#define FMT_HEADER_ONLY 1
#include "app/text/formatted.h"

#include <fmt/format.h>

namespace incise {
inline namespace v0 {
namespace app {

std::string formatted_values(fmt::string_view pattern, fmt::format_args values) {
  return fmt::vformat(pattern, values);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
