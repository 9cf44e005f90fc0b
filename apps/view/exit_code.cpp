// SPDX-License-Identifier: Apache-2.0
#include "exit_code.h"

#include <fmt/format.h>

#include <cstdio>

#include "shared/message_text.h"

namespace incise_view {

int fail(ExitCode code, std::string_view message) {
  fmt::print(stderr, "incise-view: error: {}\n", incise_apps::one_line(message));
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
