// SPDX-License-Identifier: Apache-2.0
// A line is whole if it is JSON as a whole: an object that is cut off lacks its last brace.
#include "app/text/line_reader.h"

namespace incise {
inline namespace v0 {
namespace app {

const char* name_of(ErrorCode code) {
  return kErrorNames[static_cast<std::size_t>(code)];
}

std::string line_of(const Json& root) {
  return root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

bool is_whole_json(std::string_view text) {
  return Json::accept(text);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
