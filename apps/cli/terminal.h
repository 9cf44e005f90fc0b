// SPDX-License-Identifier: Apache-2.0
// What the command says, and how it stops. Data goes to stdout, everything else to stderr.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

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

  void note(std::string_view text) const;     ///< silent under -q
  void warning(std::string_view text) const;  ///< likewise
  /// "wrote FILE (what it is)"; silent under -q.
  void wrote(std::string_view file, std::string_view what) const;
  void detail(std::string_view text) const;  ///< only under -v
  void error(std::string_view text) const;
  /// To stdout, with what was printed there before. Errors: kIo where that cannot take it.
  [[nodiscard]] incise::Status data(std::string_view text) const;
  /// What people read of a result: to stdout, or to stderr where stdout carries a file. Silent under -q.
  void summary(std::string_view text, bool is_stdout_taken) const;
  [[nodiscard]] incise::LogSink log_sink() const;
};

/// A bar on stderr with the time that is left, or, where nobody can tell it, that has gone by; where that is a terminal
/// and nobody asked for quiet. A thread of its own draws it four times a second. It goes with its work.
class ProgressBar {
 public:
  explicit ProgressBar(const Terminal& terminal, std::string unit = {});
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `done` of `total`, timed from the first call. Nothing where `total` is 0.
  void show(std::size_t done, std::size_t total);
  /// Of work in stages: which one it is at, and what percent of the work's time has gone by before it, as a rule.
  void show_stage(std::string_view name, unsigned percent);

 private:
  using Text = std::function<std::string(double seconds)>;

  void tell(Text text);
  void draw_until(const std::stop_token& stop);
  [[nodiscard]] double seconds() const;

  using Clock = std::chrono::steady_clock;

  std::string unit_;
  Clock::time_point began_ = Clock::now();
  std::optional<double> counted_since_;                    ///< the first `show`
  std::optional<std::size_t> done_;                        ///< of the last `show`
  std::optional<std::pair<std::string, unsigned>> stage_;  ///< of the last `show_stage`
  std::mutex mutex_;                                       ///< of `text_`
  std::condition_variable_any is_told_;
  Text text_;             ///< what is drawn, after so many seconds; empty: nothing yet
  std::jthread drawing_;  ///< last: it ends first
};

/// From now on Ctrl-C, SIGTERM and a terminal that closes end the program with 130, 143 or 129: at once while nothing
/// is being written, else after the write.
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
