// SPDX-License-Identifier: Apache-2.0
// A signal that comes while a file is written waits until it is whole; at any other moment it ends the program at
// once.
#include "terminal.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "shared/message_text.h"

namespace incise_cli {
namespace {

volatile std::sig_atomic_t is_writing = 0;
volatile std::sig_atomic_t pending_signal = 0;

constexpr const char* kClearLine = "\r\033[K";
std::atomic<bool> is_bar_drawn = false;

[[noreturn]] void end_by(int signal_number) {
  _exit(128 + signal_number);
}

extern "C" void on_signal(int signal_number) {
  if (is_writing == 0) end_by(signal_number);
  pending_signal = signal_number;
}

bool is_terminal(std::FILE* file) {
  return isatty(fileno(file)) != 0;
}

bool wants_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  return is_terminal(stderr) && (no_colour == nullptr || *no_colour == '\0');
}

void print(std::FILE* file, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), file);
}

/// What is read from stdin has one name in messages, whatever it was opened by.
std::string with_stdin_named(std::string_view text) {
  constexpr std::string_view kDevice = "/dev/stdin";
  std::string named(text);
  for (std::size_t at = named.find(kDevice); at != std::string::npos; at = named.find(kDevice, at + 1)) {
    const bool is_whole = at == 0 || named[at - 1] == ' ' || named[at - 1] == '\'' || named[at - 1] == '"';
    const std::size_t end = at + kDevice.size();
    const bool ends = end == named.size() || std::string_view(": ;,'\"").find(named[end]) != std::string_view::npos;
    if (is_whole && ends) named.replace(at, kDevice.size(), "stdin");
  }
  return named;
}

void print_line(std::string_view label, std::string_view colour, std::string_view text) {
  std::string line = is_bar_drawn ? kClearLine : "";
  line += "incise: ";
  if (!label.empty()) {
    const bool is_coloured = wants_colour();
    if (is_coloured) line += colour;
    line += label;
    if (is_coloured) line += "\033[0m";
    line += ": ";
  }
  print(stderr, line.append(incise_apps::one_line(with_stdin_named(text))).append("\n"));
}

}  // namespace

void Terminal::note(std::string_view text) const {
  if (!is_quiet) print_line("note", "\033[36m", text);
}

void Terminal::warning(std::string_view text) const {
  if (!is_quiet) print_line("warning", "\033[1;33m", text);
}

void Terminal::wrote(std::string_view file, std::string_view what) const {
  if (!is_quiet) print_line("", "", "wrote " + std::string(file) + " (" + std::string(what) + ")");
}

void Terminal::detail(std::string_view text) const {
  if (is_verbose && !is_quiet) print_line("", "", text);
}

void Terminal::error(std::string_view text) const {
  print_line("error", "\033[1;31m", text);
}

incise::Status Terminal::data(std::string_view text) const {
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0 &&
                          std::ferror(stdout) == 0;
  if (is_written) return {};
  return incise::Error{incise::ErrorCode::kIo, "stdout: writing failed; is the disk full?", {}};
}

void Terminal::summary(std::string_view text, bool is_stdout_taken) const {
  if (!is_quiet) print(is_stdout_taken ? stderr : stdout, text);
}

incise::LogSink Terminal::log_sink() const {
  return [this](incise::LogLevel level, std::string_view text) {
    if (level == incise::LogLevel::kWarning) {
      note(text);
    } else {
      detail(text);
    }
  };
}

ProgressBar::ProgressBar(const Terminal& terminal, std::string unit) : unit_(std::move(unit)) {
  if (terminal.is_quiet || !is_terminal(stderr)) return;
  drawing_ = std::jthread([this](const std::stop_token& stop) { draw_until(stop); });
}

ProgressBar::~ProgressBar() = default;

double ProgressBar::seconds() const {
  return std::chrono::duration<double>(Clock::now() - began_).count();
}

void ProgressBar::show(std::size_t done, std::size_t total) {
  if (!drawing_.joinable() || total == 0) return;
  done = std::min(done, total);
  if (done_ == done) return;
  done_ = done;
  if (!counted_since_) counted_since_ = seconds();
  tell([this, done, total, begun = *counted_since_, changed = seconds()](double now) {
    return incise_apps::progress_text({done, total, unit_, changed - begun, now - begun});
  });
}

void ProgressBar::show_stage(std::string_view name, unsigned percent) {
  if (!drawing_.joinable()) return;
  std::pair<std::string, unsigned> stage(name, percent);
  if (stage_ == stage) return;
  stage_ = std::move(stage);
  tell([name = std::string(name), percent, begun = seconds()](double now) {
    return incise_apps::stage_text({name, percent, begun, now});
  });
}

void ProgressBar::tell(Text text) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    text_ = std::move(text);
  }
  is_told_.notify_all();
}

void ProgressBar::draw_until(const std::stop_token& stop) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!is_told_.wait(lock, stop, [this] { return text_ != nullptr; })) return;
  is_bar_drawn = true;
  while (!stop.stop_requested()) {
    print(stderr, kClearLine + text_(seconds()));
    is_told_.wait_for(lock, stop, std::chrono::milliseconds(250), [] { return false; });
  }
  is_bar_drawn = false;
  print(stderr, kClearLine);
}

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
#ifdef SIGHUP
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
#endif
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow further is answered like a full disk
#endif
}

bool interrupt_waits() {
  return pending_signal != 0;
}

WritingZone::WritingZone() {
  is_writing = 1;
}

WritingZone::~WritingZone() {
  is_writing = 0;
  if (pending_signal != 0) end_by(pending_signal);
}

}  // namespace incise_cli
