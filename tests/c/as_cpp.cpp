// SPDX-License-Identifier: Apache-2.0
// The C example, compiled as C++.
#include "../../examples/cut_a_cube.c"  // NOLINT(bugprone-suspicious-include)
