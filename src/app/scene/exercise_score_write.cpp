// SPDX-License-Identifier: Apache-2.0

#include <cmath>

#include "app/scene/exercise_score_tree.h"
#include "app/text/formatted.h"

namespace incise {
inline namespace v0 {
namespace app {

Json score_tree(const ExerciseScore& s) {
  Json root = {{"format", "incise-exercise-score"}, {"version", 1}, {"points", s.points}};
  root["deductions"] = Json::array();
  for (const ExerciseDeduction& d : s.deductions) {
    root["deductions"].push_back({{"kind", d.kind}, {"points", d.points}, {"reason", d.reason}});
  }
  root["line"] = {{"mean", encode(s.line_mean)},
                  {"rms", encode(s.line_rms)},
                  {"max", encode(s.line_max)},
                  {"length", encode(s.target_length)},
                  {"missed_length", encode(s.missed_length)},
                  {"coverage_pct", encode(s.coverage_pct)},
                  {"overshoot", encode(s.overshoot)}};
  root["depth"] = {{"mean", encode(s.depth_mean)},
                   {"error_mean", encode(s.depth_error_mean)},
                   {"error_max", encode(s.depth_error_max)},
                   {"too_deep", encode(s.too_deep)},
                   {"is_through", s.is_through}};
  root["angle"] = {{"error_mean", encode(s.angle_error_mean)}, {"error_max", encode(s.angle_error_max)}};
  root["cuts"] = {{"strokes", s.strokes},
                  {"corrections", s.corrections},
                  {"area", encode(s.cut_area)},
                  {"away_area", encode(s.away_area)},
                  {"away_length", encode(s.away_length)}};
  root["force"] = {{"peak", encode(s.peak_force)}, {"frames_above", s.force_frames}};
  root["seconds"] = encode(s.seconds);
  return root;
}

std::string to_json(const ExerciseScore& score) {
  return score_tree(score).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

/// Figures that were measured, or nothing.
std::string line_text(const ExerciseScore& s) {
  std::string text = formatted("  line: {:.0f} % cut, {:.3g} missed, {:.3g} beyond its ends", s.coverage_pct,
                               s.missed_length, s.overshoot);
  if (std::isfinite(s.line_rms)) text += formatted("; {:.3g} beside it (RMS), {:.3g} at most", s.line_rms, s.line_max);
  return text + "\n";
}

std::string depth_text(const ExerciseScore& s) {
  if (!std::isfinite(s.depth_mean)) return {};
  return formatted("  depth: {:.3g}, off by {:.3g} on average and {:.3g} at most{}\n", s.depth_mean, s.depth_error_mean,
                   s.depth_error_max, s.is_through ? "; another wall was wounded" : "");
}

std::string angle_text(const ExerciseScore& s) {
  if (!std::isfinite(s.angle_error_mean)) return {};
  return formatted("  angle: off by {:.3g} degrees on average and {:.3g} at most\n", s.angle_error_mean,
                   s.angle_error_max);
}

std::string hand_text(const ExerciseScore& s) {
  std::string text = formatted("  {} stroke{} in {:.3g} s, at most {:.3g} N", s.strokes, s.strokes == 1 ? "" : "s",
                               s.seconds, s.peak_force);
  if (s.corrections > 0) text += formatted("; {} taken back", s.corrections);
  return text + "\n";
}

}  // namespace

std::string to_text(const ExerciseScore& score) {
  std::string text = formatted("exercise: {:.1f} of 100 points\n", score.points);
  for (const ExerciseDeduction& d : score.deductions) text += formatted("  -{:.1f}: {}\n", d.points, d.reason);
  return text + line_text(score) + depth_text(score) + angle_text(score) + hand_text(score);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
