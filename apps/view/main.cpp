// SPDX-License-Identifier: Apache-2.0
// Window or headless run, and the last resort for exceptions: one line and an exit code.
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>

#include "arguments.h"
#include "exit_code.h"
#include "headless.h"
#include "interactive.h"

int main(int argc, char** argv) {
  // Where the processor draws, one thread of it: the other cores are the simulation's.
  setenv("LP_NUM_THREADS", "1", 0);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow further is answered like a full disk
  try {
    incise_view::Arguments arguments;
    if (const std::optional<int> ended = parse(argc, argv, arguments)) return *ended;
    return arguments.is_headless ? run_headless(arguments) : run_window(arguments);
  } catch (const std::bad_alloc&) {
    return incise_view::fail(incise_view::kFailure, "out of memory; use a smaller mesh or a larger machine");
  } catch (const std::exception& error) {
    return incise_view::fail(incise_view::kFailure, error.what());
  }
}
