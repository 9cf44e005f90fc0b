// SPDX-License-Identifier: Apache-2.0
// Text alone, printed elsewhere: control characters become spaces, and the time left follows from the share that is
// done.
#include "shared/message_text.h"

#include <algorithm>
#include <cmath>

#include "app/text/shortened.h"

namespace incise_apps {
namespace {

constexpr std::size_t kBarWidth = 30;

std::string bar_text(double share) {
  const auto filled = static_cast<std::size_t>(share * kBarWidth);
  return "[" + std::string(filled, '#') + std::string(kBarWidth - filled, ' ') + "] ";
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line = incise::app::shortened(text);
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  std::replace_if(line.begin(), line.end(), is_control, ' ');
  return line;
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<unsigned long>(std::llround(seconds));
  const auto two_digits = [](unsigned long n) { return (n < 10 ? "0" : "") + std::to_string(n); };
  const std::string end = ":" + two_digits(whole % 60);
  if (whole < 3600) return std::to_string(whole / 60) + end;
  return std::to_string(whole / 3600) + ":" + two_digits(whole / 60 % 60) + end;
}

std::string progress_text(const CountProgress& progress) {
  const double share = static_cast<double>(progress.done) / static_cast<double>(progress.total);
  const std::string text = bar_text(share) + std::to_string(progress.done) + " of " + std::to_string(progress.total) +
                           " " + std::string(progress.unit);
  if (progress.now < 1) return text;
  const double left = progress.done > 0 ? progress.changed / share - progress.now : 0;
  return text + ", " + (left > 0 ? clock_text(left) + " left" : clock_text(progress.now));
}

std::string stage_text(const StageProgress& stage) {
  const double share = stage.percent / 100.0;
  const std::string text = bar_text(share) + std::to_string(stage.percent) + " %: " + std::string(stage.name) + ", ";
  const double left = stage.percent > 0 ? stage.begun / share - stage.now : 0;
  return left > 0 ? text + clock_text(left) + " left" : text + clock_text(stage.now);
}

}  // namespace incise_apps
