// SPDX-License-Identifier: Apache-2.0
// The same codes as the command, with one more for a machine that cannot draw.
#include "exit_code.h"

#include <cstdio>

#include "app/text/formatted.h"
#include "shared/message_text.h"

namespace incise_view {

int fail(ExitCode code, std::string_view message) {
  std::fputs(incise::app::formatted("incise-view: error: {}\n", incise_apps::one_line(message)).c_str(), stderr);
  return code;
}

ExitCode exit_of(const incise::Error& error) {
  switch (error.code) {
    case incise::ErrorCode::kBadFile:
    case incise::ErrorCode::kBadArgument:
      return kBadInput;
    case incise::ErrorCode::kUnsupported:
      return kNoDisplay;  // of drawing: readers of files do not get here
    default:
      return kFailure;
  }
}

}  // namespace incise_view
