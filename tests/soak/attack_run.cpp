// SPDX-License-Identifier: Apache-2.0
#include "soak/attack_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "soak/models.h"
#include "soak/watch.h"

namespace incise::test {
namespace {

EngineOptions engine_options(const AttackOptions& options) {
  EngineOptions engine;
  engine.check_step = TouchedCheck();
  engine.cut.profile = options.is_paper ? Profile::kPaper : Profile::kIncise;
  engine.cut.snap = options.snap;
  engine.maintain.merge = engine.maintain.improve = options.maintains;
  if (options.is_paper || !options.maintains) engine.maintain.work_units = 0;
  return engine;
}

/// Drives the engine as the command does.
class CutRun {
 public:
  CutRun(const AttackedBody& body, const AttackOptions& options, double limit)
      : options_(options), limit_(limit), engine_(Engine::create(body.mesh, engine_options(options)).value()) {}

  CutOutcome run(const std::vector<Stroke>& strokes) {
    for (const Stroke& stroke : strokes) {
      if (!cut(stroke)) return {std::nullopt, error_};
    }
    return {review(to_soup(engine_.mesh())), {}};
  }

 private:
  bool cut(const Stroke& stroke) {
    const bool is_cut = options_.cuts_whole ? cut_whole(stroke) : cut_by_steps(stroke);
    return is_cut && has_time() && maintain();
  }
  bool cut_whole(const Stroke& stroke) { return is_done(engine_.cut(stroke), stroke); }
  bool cut_by_steps(const Stroke& stroke) {
    if (!is_done(engine_.begin_stroke({stroke.edges.front()}), stroke)) return false;
    for (std::size_t i = 1; i < stroke.edges.size(); ++i) {
      if (!is_done(engine_.step({stroke.edges[i]}), stroke) || !has_time()) return false;
    }
    return is_done(engine_.end_stroke(), stroke);
  }
  bool maintain() {
    if (!options_.maintains) return true;
    const Result<MaintainReport> report = engine_.maintain(kUnlimitedWork, [this] { return is_late(); });
    if (!report.ok()) error_ = "maintenance failed: " + report.error().message;
    return report.ok() && has_time();
  }
  template <class Outcome>
  bool is_done(const Outcome& outcome, const Stroke& stroke) {
    if (!outcome.ok()) error_ = "stroke " + stroke.name + " is refused: " + outcome.error().message;
    return outcome.ok();
  }
  [[nodiscard]] bool is_late() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() > limit_;
  }
  bool has_time() {
    if (is_late()) error_ = "no end within " + std::to_string(std::lround(limit_)) + " s";
    return error_.empty();
  }

  const AttackOptions& options_;
  double limit_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Engine engine_;
  std::string error_;
};

template <class... Numbers>
std::string words(const char* format, Numbers... numbers) {
  char text[160];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

double volume_slack(const AttackOptions& options) {
  return options.is_paper ? 1e-2 : 1e-9;
}

/// The worst L/r has a goal and a limit; a body that was worse may stay so.
void judge_shape(const TetReview& before, const TetReview& after, Shortfall& found) {
  constexpr double kGoal = 25, kLimit = 60;
  const double own = 1.25 * before.worst_ratio;
  if (after.worst_ratio <= std::max(kGoal, own)) return;
  const bool is_soft = after.worst_ratio <= std::max(kLimit, own);
  found.is_shape_alone = is_soft && found.faults.empty();
  found.faults.push_back(
      words(is_soft ? "L/r between the goal and the limit: %.0f (before %.0f)" : "L/r up to %.0f (before %.0f)",
            after.worst_ratio, before.worst_ratio));
}

std::vector<std::string> growth_faults(const Attack& attack, const TetReview& before, const TetReview& after,
                                       const TetReview& single) {
  std::vector<std::string> faults;
  const auto grown = [&](const TetReview& r) { return static_cast<double>(r.tets) - static_cast<double>(before.tets); };
  const double share = grown(after) / std::max(attack.few_tets, grown(single));
  if (share > attack.growth_limit) faults.push_back(words("%.1f times the new tets of one stroke", share));
  if (single.components != after.components) {
    faults.push_back(words("%zu pieces, %zu in one stroke", after.components, single.components));
  }
  return faults;
}

}  // namespace

std::string Shortfall::text() const {
  std::string line;
  for (const std::string& fault : faults) line += (line.empty() ? "" : "; ") + fault;
  return line;
}

CutOutcome cut_body(const AttackedBody& body, const std::vector<Stroke>& strokes, const AttackOptions& options,
                    double limit) {
  go_on_watching();
  CutOutcome outcome = CutRun(body, options, limit).run(strokes);
  stop_watching();
  return outcome;
}

Shortfall judge(const Attack& attack, const AttackOptions& options, const TetReview& before, const TetReview& after,
                const std::optional<TetReview>& single) {
  Shortfall found{grown_defects(before, after)};
  const double drift = after.volume / before.volume - 1;
  if (!(std::abs(drift) <= volume_slack(options))) found.faults.push_back(words("volume off by %.1e", drift));
  if (options.counts_pieces && attack.pieces && after.components != *attack.pieces) {
    found.faults.push_back(words("%zu pieces, %zu expected", after.components, *attack.pieces));
  }
  if (attack.encloses_nothing && after.surfaces != after.components) {
    found.faults.push_back(words("%zu surfaces of %zu pieces", after.surfaces, after.components));
  }
  if (!options.judges_shape) return found;
  if (single) {
    for (std::string& fault : growth_faults(attack, before, after, *single)) {
      found.faults.push_back(std::move(fault));
    }
  }
  judge_shape(before, after, found);
  return found;
}

Shortfall run_attack(const AttackedBody& body, const Attack& attack, const AttackOptions& options, double limit) {
  const CutOutcome cut = cut_body(body, attack.strokes, options, limit);
  if (!cut.after) return {{cut.error}};
  std::optional<TetReview> single;
  if (options.judges_shape && !attack.single.empty()) single = cut_body(body, attack.single, options, limit).after;
  return judge(attack, options, body.before, *cut.after, single);
}

}  // namespace incise::test
