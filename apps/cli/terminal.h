// SPDX-License-Identifier: Apache-2.0
// What the command says, and how it stops. Data goes to stdout, everything else to stderr.
#pragma once

#include <cstddef>
#include <string_view>

#include "incise/core/log.h"
#include "incise/core/result.h"

namespace incise_cli {

/// The command's exit codes: a contract with scripts.
enum ExitCode : int {
  kDone = 0,
  kFailure = 1,
  kUsage = 2,
  kBadInput = 3,
  kCheckFailed = 4,
  kNoDisplay = 5,
  kInterrupted = 130,
};

class Terminal {
 public:
  bool is_quiet = false;
  bool is_verbose = false;

  void note(std::string_view text) const;    ///< silent under -q
  void detail(std::string_view text) const;  ///< only under -v
  void error(std::string_view text) const;
  void data(std::string_view text) const;  ///< to stdout
  /// A bar on stderr, where that is a terminal; `done == total` takes it away.
  void progress(std::size_t done, std::size_t total, std::string_view unit) const;
  [[nodiscard]] incise::LogSink log_sink() const;
};

/// From now on Ctrl-C and SIGTERM end the program with 130 or 143: at once while nothing is being written, else after
/// the write.
void catch_interrupts();

/// Whether an interrupt waits for the end of a `WritingZone`: long work in one asks, and stops early.
bool interrupt_waits();

/// While it lives, an interrupt waits.
class WritingZone {
 public:
  WritingZone();
  ~WritingZone();  ///< ends the program where an interrupt came meanwhile
  WritingZone(const WritingZone&) = delete;
  WritingZone& operator=(const WritingZone&) = delete;
};

}  // namespace incise_cli
