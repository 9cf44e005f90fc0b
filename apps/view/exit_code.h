// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "incise/core/result.h"

namespace incise_view {

/// As those of the command `incise`: a contract with scripts.
enum ExitCode : int {
  kDone = 0,
  kFailure = 1,
  kUsage = 2,
  kBadInput = 3,
  kNoDisplay = 5,
};

/// Says what is wrong on stderr, and gives the code back.
int fail(ExitCode code, std::string_view message);
/// Which code an error ends the program with.
ExitCode exit_of(const incise::Error& error);

}  // namespace incise_view
