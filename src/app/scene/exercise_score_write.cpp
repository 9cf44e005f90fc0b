// SPDX-License-Identifier: Apache-2.0
// The score twice: as a tree of JSON with a figure for all that was measured, and as lines for people without those
// that were not.
#include <cmath>

#include "app/scene/exercise_score_tree.h"
#include "app/text/formatted.h"

namespace incise {
inline namespace v0 {
namespace app {

static void add_goal_figures(const ExerciseScore& s, Json& root) {
  root["undivided_length"] = encode(s.undivided_length);
  root["wounds"] = Json::array();
  for (const ExerciseWound& w : s.wounds) {
    root["wounds"].push_back(
        {{"name", w.name}, {"depth", encode(w.depth)}, {"allowed", w.allowed}, {"area", encode(w.area)}});
  }
  if (!s.removed) return;
  root["removed"] = {{"name", s.removed->name},
                     {"has_piece", s.removed->has_piece},
                     {"share", encode(s.removed->share)},
                     {"volume", encode(s.removed->volume)},
                     {"margin_least", encode(s.removed->margin_least)},
                     {"margin_most", encode(s.removed->margin_most)}};
}

Json score_tree(const ExerciseScore& s) {
  Json root = {{"format", "incise-exercise-score"}, {"version", 1}, {"points", s.points}};
  root["pass"] = s.pass;
  root["is_passed"] = s.is_passed;
  root["deductions"] = Json::array();
  for (const ExerciseDeduction& d : s.deductions) {
    root["deductions"].push_back({{"kind", d.kind}, {"points", d.points}, {"reason", d.reason}});
  }
  root["criteria"] = Json::array();
  for (const ExerciseCriterion& c : s.criteria) {
    root["criteria"].push_back({{"kind", c.kind}, {"most", c.most}, {"lost", c.lost}});
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
  add_goal_figures(s, root);
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

std::string goals_text(const ExerciseScore& s) {
  std::string text;
  for (const ExerciseWound& w : s.wounds) {
    text += formatted("  {}: cut {:.3g} deep, {:.3g} is allowed\n", w.name, w.depth, w.allowed);
  }
  if (!s.removed) return text;
  if (!s.removed->has_piece) return text + formatted("  {}: nothing came off\n", s.removed->name);
  return text + formatted("  {}: {:.3g} % of it is in a piece of {:.4g}, with a margin of {:.3g} to {:.3g}\n",
                          s.removed->name, 100 * s.removed->share, s.removed->volume, s.removed->margin_least,
                          s.removed->margin_most);
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
  text += formatted("  {}: {:.3g} points are asked for\n", score.is_passed ? "passed" : "not passed", score.pass);
  return text + line_text(score) + depth_text(score) + angle_text(score) + goals_text(score) + hand_text(score);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
