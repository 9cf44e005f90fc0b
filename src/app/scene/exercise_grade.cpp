// SPDX-License-Identifier: Apache-2.0
// Each kind of fault has points of its own to lose: none up to its tolerance, all from a multiple of it on, and evenly
// between.
#include "app/scene/exercise_grade.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/text/formatted.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

// The most points that each kind of fault costs. A missed line costs its share of the points, and half as much again.
constexpr double kEveryPoint = 100;
constexpr double kLinePoints = 20;
constexpr double kMissedPoints = 75;
constexpr double kOvershootPoints = 15;
constexpr double kDepthPoints = 20;
constexpr double kTooDeepPoints = 20;
constexpr double kThroughPoints = 30;
constexpr double kAnglePoints = 15;
constexpr double kStrokePoints = 10;  // for each stroke beyond those allowed
constexpr double kMostStrokePoints = 30;
constexpr double kAwayPoints = 30;
constexpr double kAwayAreaPoints = 10;
constexpr double kForcePoints = 15;
// What must not happen costs so much that nobody passes by what else was done well.
constexpr double kUndividedPoints = 50;
constexpr double kWoundPoints = 50;
constexpr double kPiecePoints = 60;
constexpr double kSharePoints = 50;
constexpr double kMarginPoints = 40;
constexpr double kVolumePoints = 40;

constexpr double kShareSlack = 1e-6;  // of the share that is asked for: volumes are sums
constexpr double kAwayArea = 0.1;     // of the area asked for, that may lie elsewhere: crumbs and bent walls
constexpr double kFarOff = 0.5;       // of a bound, by which a margin or a volume misses it where it costs all points

/// 0 up to the tolerance, 1 from `kFullFault` tolerances on, linear between.
double fault(double off, double tolerance) {
  return std::clamp((off - tolerance) / ((kFullFault - 1) * tolerance), 0.0, 1.0);
}

/// 0 within the bounds; beyond, 1 from half of the bound on.
double fault_of_span(double value, const std::array<double, 2>& span) {
  const double low = span[0] > 0 ? (span[0] - value) / (kFarOff * span[0]) : 0;
  const double high = (value - span[1]) / (kFarOff * span[1]);
  return std::clamp(std::max(low, high), 0.0, 1.0);
}

/// Takes off points for what was measured.
class Grader {
 public:
  Grader(const Exercise& exercise, ExerciseScore& score) : exercise_(exercise), score_(score) {}

  void run() {
    const bool is_begun = score_.coverage_pct > 0;
    take("nothing", kEveryPoint, is_begun ? 0 : 1,
         score_.cut_area > 0 ? "nothing was cut along the line" : "nothing was cut");
    if (is_begun) {
      judge_line();
      judge_depth();
      judge_angle();
      judge_elsewhere();
      judge_hand();
      judge_regions();
      judge_removed();
    }
    double points = kEveryPoint;
    for (const ExerciseCriterion& c : score_.criteria) points -= c.lost;
    score_.points = std::max(0.0, std::round(10 * points) / 10);
    score_.pass = exercise_.pass;
    score_.is_passed = score_.points >= exercise_.pass;
  }

 private:
  /// Takes a share of a criterion's points off, where it comes to a tenth.
  /// @param share  in [0, 1].
  void take(const char* kind, double most, double share, std::string reason) {
    const double lost = std::round(10 * most * share) / 10;
    score_.criteria.push_back({kind, most, lost});
    if (lost > 0) score_.deductions.push_back({kind, lost, std::move(reason)});
  }

  void judge_line() {
    const double allowed = exercise_.tolerances.line;
    const double ends = is_closed(exercise_) ? 0 : 2 * allowed;
    const double missed = std::max(0.0, score_.missed_length - ends) / score_.target_length;
    take("missed", kMissedPoints, missed, formatted("{:.0f} % of the line was not cut", 100 - score_.coverage_pct));
    take("line", kLinePoints, fault(score_.line_rms, allowed),
         formatted("the cut runs {:.2g} beside the line (RMS); {:.2g} is allowed", score_.line_rms, allowed));
    if (is_closed(exercise_)) return;
    take("overshoot", kOvershootPoints, fault(score_.overshoot, allowed),
         formatted("the cut goes {:.2g} beyond the line's end; {:.2g} is allowed", score_.overshoot, allowed));
  }

  /// Walls that meet below, so that something comes off, are not as deep everywhere as where they meet.
  void judge_depth() {
    const double allowed = exercise_.tolerances.depth;
    const double off = std::isfinite(score_.depth_error_mean) ? score_.depth_error_mean : 0;
    if (!exercise_.remove) {
      take("depth", kDepthPoints, fault(off, allowed),
           formatted("the depth is off by {:.2g} on average; {:.2g} is allowed", off, allowed));
    }
    take("too_deep", kTooDeepPoints, fault(score_.too_deep, allowed),
         formatted("the cut goes {:.2g} too deep; {:.2g} is allowed", score_.too_deep, allowed));
    take("through", kThroughPoints, score_.is_through ? 1 : 0,
         "the blade went through, and out again or into another wall");
  }

  void judge_angle() {
    const double allowed = exercise_.tolerances.angle;
    const double off = std::isfinite(score_.angle_error_mean) ? score_.angle_error_mean : 0;
    take("angle", kAnglePoints, fault(off, allowed),
         formatted("the edge is off by {:.0f} degrees on average; {:.0f} are allowed", off, allowed));
  }

  void judge_elsewhere() {
    const double length = std::max(0.0, score_.away_length - exercise_.tolerances.line) / score_.target_length;
    take("elsewhere", kAwayPoints, std::min(1.0, 2 * length),
         formatted("the skin was cut elsewhere, {:.2g} long", score_.away_length));
    const double area = score_.away_area / (score_.target_length * exercise_.depth);
    take("elsewhere_area", kAwayAreaPoints, fault(area, kAwayArea),
         formatted("an area of {:.2g} was cut away from the line", score_.away_area));
  }

  void judge_hand() {
    const std::uint32_t excess = score_.strokes > exercise_.strokes ? score_.strokes - exercise_.strokes : 0;
    take("strokes", kMostStrokePoints, std::min(kStrokePoints * excess / kMostStrokePoints, 1.0),
         formatted("{} strokes were made; allowed: {}", score_.strokes, exercise_.strokes));
    if (!(exercise_.max_force > 0)) return;
    const double above = score_.peak_force - exercise_.tolerances.force;
    take("force", kForcePoints, std::clamp(above / exercise_.max_force - 1, 0.0, 1.0),
         formatted("the edge was pressed with {:.2g} N, in {} frames above {:.2g} N", score_.peak_force,
                   score_.force_frames, exercise_.max_force));
  }

  void judge_regions() {
    if (exercise_.divide) {
      const double share = score_.undivided_length / score_.target_length;
      take("undivided", kUndividedPoints, std::min(2 * share, 1.0),
           formatted("{} was not cut through on {:.0f} % of the line", exercise_.divide->name, 100 * share));
    }
    for (const ExerciseWound& wound : score_.wounds) {
      take("wound", kWoundPoints, wound.depth > wound.allowed ? 1 : 0,
           wound.allowed > 0
               ? formatted("{} was cut, {:.2g} deep; {:.2g} is allowed", wound.name, wound.depth, wound.allowed)
               : formatted("{} was cut, {:.2g} deep; it must stay whole", wound.name, wound.depth));
    }
  }

  void judge_removed() {
    if (!score_.removed) return;
    const ExerciseRemove& asked = *exercise_.remove;
    const ExerciseRemoved& found = *score_.removed;
    take("piece", kPiecePoints, found.has_piece ? 0 : 1, formatted("no piece with {} came off", found.name));
    if (!found.has_piece) return;
    const bool is_short = found.share < asked.share * (1 - kShareSlack);
    take("share", kSharePoints, is_short ? 1 : 0,
         formatted("the piece holds {:.3g} % of {}; {:.3g} % are asked for", 100 * found.share, found.name,
                   100 * asked.share));
    if (asked.margin) judge_margin(*asked.margin, found);
    if (!asked.volume) return;
    take("volume", kVolumePoints, fault_of_span(found.volume, *asked.volume),
         formatted("the piece has a volume of {:.4g}; {:.4g} to {:.4g} is asked for", found.volume, (*asked.volume)[0],
                   (*asked.volume)[1]));
  }

  void judge_margin(const std::array<double, 2>& asked, const ExerciseRemoved& found) {
    const bool is_narrow = found.margin_least < asked[0];
    const double share = std::max(fault_of_span(found.margin_least, asked), fault_of_span(found.margin_most, asked));
    take("margin", kMarginPoints, share,
         formatted("the margin around {} is {:.2g} {}; {:.2g} to {:.2g} is asked for", found.name,
                   is_narrow ? found.margin_least : found.margin_most, is_narrow ? "at least" : "at most", asked[0],
                   asked[1]));
  }

  const Exercise& exercise_;
  ExerciseScore& score_;
};

}  // namespace

void grade(const Exercise& exercise, ExerciseScore& score) {
  Grader(exercise, score).run();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
