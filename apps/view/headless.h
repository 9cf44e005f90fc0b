// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "arguments.h"

namespace incise_view {

/// Makes pictures without a window and without an X server. Returns the exit code.
int run_headless(const Arguments& arguments);

}  // namespace incise_view
