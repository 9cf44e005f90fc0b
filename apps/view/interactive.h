// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "arguments.h"

namespace incise_view {

/// Opens the window and runs it until the person quits. Returns the exit code.
int run_window(const Arguments& arguments);

}  // namespace incise_view
