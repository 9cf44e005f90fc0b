// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "soak/motion_run.h"

namespace incise::test {

/// How a case fails: the fault, or the signal that ends the program (a crash, or SIGALRM where it hangs).
struct FailureKind {
  Fault fault = Fault::kNone;
  int signal = 0;

  [[nodiscard]] bool is_none() const { return fault == Fault::kNone && signal == 0; }
  friend bool operator==(const FailureKind& a, const FailureKind& b) {
    return a.fault == b.fault && a.signal == b.signal;
  }
};

/// Runs a case in a process of its own.
FailureKind failure_of(const MotionCase& motion);

/// Drops strokes, then poses, then shrinks the body and whatever else is not needed, while the case fails as before;
/// for five minutes at most.
MotionCase minimise(MotionCase motion, const FailureKind& failure);

/// All about a case but its poses, in words.
std::string describe(const MotionCase& motion);

/// Writes the strokes as a blade file.
bool write_blade_file(const MotionCase& motion, const std::filesystem::path& path);

}  // namespace incise::test
