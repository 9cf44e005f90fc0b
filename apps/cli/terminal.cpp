// SPDX-License-Identifier: Apache-2.0
#include "terminal.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace incise_cli {
namespace {

volatile std::sig_atomic_t is_writing = 0;
volatile std::sig_atomic_t pending_signal = 0;

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

/// No message is longer; one that would be keeps its beginning and, with the remedy, its end.
constexpr std::size_t kLongest = 480, kEnd = 160;

/// One line of readable characters.
std::string shortened(std::string_view text) {
  std::string line(text);
  if (line.size() > kLongest) {
    const auto is_inside = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U; };
    std::size_t head = kLongest - kEnd - 5, tail = text.size() - kEnd;  // not within a character of several bytes
    while (head > 0 && is_inside(head)) --head;
    while (tail < text.size() && is_inside(tail)) ++tail;
    line = std::string(text.substr(0, head)) + " ... " + std::string(text.substr(tail));
  }
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  std::replace_if(line.begin(), line.end(), is_control, ' ');
  return line;
}

void print_line(std::string_view label, std::string_view colour, std::string_view text) {
  std::string line = "incise: ";
  if (!label.empty()) {
    const bool is_coloured = wants_colour();
    if (is_coloured) line += colour;
    line += label;
    if (is_coloured) line += "\033[0m";
    line += ": ";
  }
  print(stderr, line.append(shortened(text)).append("\n"));
}

}  // namespace

void Terminal::note(std::string_view text) const {
  if (!is_quiet) print_line("note", "\033[36m", text);
}

void Terminal::detail(std::string_view text) const {
  if (is_verbose && !is_quiet) print_line("", "", text);
}

void Terminal::error(std::string_view text) const {
  print_line("error", "\033[1;31m", text);
}

void Terminal::data(std::string_view text) const {
  print(stdout, text);
}

void Terminal::progress(std::size_t done, std::size_t total, std::string_view unit) const {
  if (is_quiet || total == 0 || !is_terminal(stderr)) return;
  if (done == total) {
    print(stderr, "\r\033[K");
    return;
  }
  constexpr std::size_t kWidth = 30;
  const std::size_t filled = done * kWidth / total;
  std::string bar = "\r\033[K[" + std::string(filled, '#') + std::string(kWidth - filled, ' ') + "] ";
  bar += std::to_string(done) + " of " + std::to_string(total) + " ";
  print(stderr, bar.append(unit));
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

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
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
