// SPDX-License-Identifier: Apache-2.0
// Runs the built command as a user's shell would, without a shell.
#pragma once

#include <string>
#include <vector>

#include "support/folder.h"

namespace incise_test {

struct Outcome {
  int code = -1;  ///< exit code; 128 + signal where one ended it
  std::string out, err;
};

/// Runs `incise` with these arguments, stdin empty.
Outcome run(const std::vector<std::string>& arguments);
/// The same with `input` on stdin, by a pipe.
Outcome run_on(const std::string& input, const std::vector<std::string>& arguments);
/// The same where `text` comes again and again; -1 as the code where the program has taken 64 MiB of it.
Outcome run_on_endless(const std::string& text, const std::vector<std::string>& arguments);
/// The same with stdout to a file or device.
Outcome run_to(const std::string& out, const std::vector<std::string>& arguments);
/// The same, and sends SIGINT after `seconds`.
Outcome run_interrupted(const std::vector<std::string>& arguments, double seconds);
/// The same with SIGHUP, as where its terminal is closed.
Outcome run_hung_up(const std::vector<std::string>& arguments, double seconds);
/// The same with no file growing beyond `bytes`.
Outcome run_limited(const std::vector<std::string>& arguments, unsigned long bytes);
/// The same with SIGKILL, which no program can hear.
Outcome run_killed(const std::vector<std::string>& arguments, double seconds);

}  // namespace incise_test
