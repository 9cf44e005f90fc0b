// SPDX-License-Identifier: Apache-2.0
// Says what was being done when a program hangs or crashes.
#pragma once

#include <string>

namespace incise::test {

/// Nothing takes nearly as long on the largest real mesh, under the sanitizers included.
constexpr unsigned kStrokeSeconds = 120;

/// Reports hangs and crashes from now on.
void start_watch();
/// Names what begins now, which must end within `kStrokeSeconds`.
void watch(const std::string& what);
/// What was named last.
const char* watched();
/// Starts its time anew.
void go_on_watching();
void stop_watching();

}  // namespace incise::test
