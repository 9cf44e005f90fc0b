// SPDX-License-Identifier: Apache-2.0
#include "app/scene/exercise_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/scene/exercise_measure.h"
#include "app/scene/scene.h"
#include "app/text/formatted.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr int kEdgePieces = 16;  // of a part of the edge, looked at for the place nearest to the line

// The most points that each kind of fault costs. A missed line costs its share of the points, and half as much again.
constexpr double kAllPoints = 100;
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
constexpr double kFullAt = 3;  // tolerances, where a fault costs all its points

/// 0 up to the tolerance, 1 from `kFullAt` tolerances on, linear between.
double fault(double off, double tolerance) {
  return std::clamp((off - tolerance) / ((kFullAt - 1) * tolerance), 0.0, 1.0);
}

/// Takes off points for what was measured.
class Grader {
 public:
  Grader(const Exercise& exercise, ExerciseScore& score) : exercise_(exercise), score_(score) {}

  void run() {
    if (score_.coverage_pct > 0) {
      judge_line();
      judge_depth();
      judge_angle();
      judge_elsewhere();
      judge_hand();
    } else {
      take("nothing", kAllPoints, score_.cut_area > 0 ? "nothing was cut along the line" : "nothing was cut");
    }
    double points = kAllPoints;
    for (const ExerciseDeduction& d : score_.deductions) points -= d.points;
    score_.points = std::max(0.0, std::round(10 * points) / 10);
  }

 private:
  /// Takes points off where they come to a tenth.
  void take(const char* kind, double points, std::string reason) {
    const double rounded = std::round(10 * points) / 10;
    if (rounded > 0) score_.deductions.push_back({kind, rounded, std::move(reason)});
  }

  void judge_line() {
    const double allowed = exercise_.tolerances.line;
    const double missed = std::max(0.0, score_.missed_length - 2 * allowed) / score_.target_length;
    take("missed", kMissedPoints * missed, formatted("{:.0f} % of the line was not cut", 100 - score_.coverage_pct));
    take("line", kLinePoints * fault(score_.line_rms, allowed),
         formatted("the cut runs {:.2g} beside the line (RMS); {:.2g} is allowed", score_.line_rms, allowed));
    take("overshoot", kOvershootPoints * fault(score_.overshoot, allowed),
         formatted("the cut goes {:.2g} beyond the line's end; {:.2g} is allowed", score_.overshoot, allowed));
  }

  void judge_depth() {
    const double allowed = exercise_.tolerances.depth;
    const double off = std::isfinite(score_.depth_error_mean) ? score_.depth_error_mean : 0;
    take("depth", kDepthPoints * fault(off, allowed),
         formatted("the depth is off by {:.2g} on average; {:.2g} is allowed", off, allowed));
    take("too_deep", kTooDeepPoints * fault(score_.too_deep, allowed),
         formatted("the cut goes {:.2g} too deep; {:.2g} is allowed", score_.too_deep, allowed));
    take("through", score_.is_through ? kThroughPoints : 0,
         "the blade went through, and out again or into another wall");
  }

  void judge_angle() {
    if (!std::isfinite(score_.angle_error_mean)) return;
    const double allowed = exercise_.tolerances.angle;
    take("angle", kAnglePoints * fault(score_.angle_error_mean, allowed),
         formatted("the edge is off by {:.0f} degrees on average; {:.0f} are allowed", score_.angle_error_mean,
                   allowed));
  }

  void judge_elsewhere() {
    const double length = std::max(0.0, score_.away_length - exercise_.tolerances.line) / score_.target_length;
    take("elsewhere", kAwayPoints * std::min(1.0, 2 * length),
         formatted("the skin was cut elsewhere, {:.2g} long", score_.away_length));
    const double area = score_.away_area / (score_.target_length * exercise_.depth);
    take("elsewhere_area", kAwayAreaPoints * fault(area, kAwayArea),
         formatted("an area of {:.2g} was cut away from the line", score_.away_area));
  }

  void judge_hand() {
    const std::uint32_t excess = score_.strokes > exercise_.strokes ? score_.strokes - exercise_.strokes : 0;
    take("strokes", std::min(kStrokePoints * excess, kMostStrokePoints),
         formatted("{} strokes were made; allowed: {}", score_.strokes, exercise_.strokes));
    if (!(exercise_.max_force > 0)) return;
    const double above = score_.peak_force - exercise_.tolerances.force;
    take("force", kForcePoints * std::clamp(above / exercise_.max_force - 1, 0.0, 1.0),
         formatted("the edge was pressed with {:.2g} N, in {} frames above {:.2g} N", score_.peak_force,
                   score_.force_frames, exercise_.max_force));
  }

  static constexpr double kAwayArea = 0.1;  // of the area asked for, that may lie elsewhere: crumbs and bent walls

  const Exercise& exercise_;
  ExerciseScore& score_;
};

/// What is known of a stroke beside the mesh.
struct StrokeNotes {
  bool has_touched = false;
  double angle_sum = 0, angle_max = 0;  // of the error, degrees
  std::uint64_t angle_frames = 0;
};

bool touches(const FrameReport& report) {
  return report.blade.touches || report.cut.cut_tets > 0 || report.cut.incision_faces != 0;
}

/// Where an edge is nearest to the line.
struct NearestPart {
  Vec3 point = Vec3::Zero(), direction = Vec3::Zero();
  double distance = std::numeric_limits<double>::infinity();
};

NearestPart nearest_part(const TargetLine& line, const std::vector<Vec3>& edge) {
  NearestPart best;
  for (std::size_t i = 1; i < edge.size(); ++i) {
    const Vec3 along = edge[i] - edge[i - 1];
    for (int k = 0; k <= kEdgePieces && !along.isZero(0); ++k) {
      const Vec3 point = edge[i - 1] + static_cast<double>(k) / kEdgePieces * along;
      const double distance = line.distance(point);
      if (distance < best.distance) best = {point, along, distance};
    }
  }
  return best;
}

/// Between a line and a normal, in [0, 90] degrees.
double angle_between(const Vec3& direction, const Vec3& normal) {
  return std::atan2(direction.cross(normal).norm(), std::abs(direction.dot(normal))) * 180 / std::numbers::pi;
}

}  // namespace

struct ExerciseScorer::State {
  State(const Exercise& asked, double seconds, const TetMesh& mesh)
      : exercise(asked), frame_seconds(seconds), line(asked, mesh) {}

  void follow_strokes(const FrameInput& input, const FrameReport& report, std::uint32_t applied);
  void note_blade(const BladePose& pose, const FrameReport& report, StrokeNotes& notes) const;
  void sum_strokes(std::uint32_t applied, ExerciseScore& score) const;

  Exercise exercise;
  double frame_seconds;
  TargetLine line;
  std::vector<StrokeNotes> strokes;  // by their numbers, from 1; those taken back stay, for they may be applied again
  std::uint32_t applied = 0;         // strokes that stood after the last frame
  std::uint32_t corrections = 0;
  bool had_blade = false;
  std::uint64_t frames = 0, first_blade = 0, end_blade = 0;
  double peak_force = 0;
  std::uint64_t force_frames = 0;
};

void ExerciseScorer::State::follow_strokes(const FrameInput& input, const FrameReport& report, std::uint32_t now) {
  const bool begins = input.blade && !had_blade && report.stroke > 0;
  const std::uint32_t before = begins ? report.stroke - 1 : now;
  corrections += applied > before ? applied - before : 0;
  applied = now;
  if (begins) strokes.resize(before);  // what was taken back can be applied no more
  if (strokes.size() < now) strokes.resize(now);
  had_blade = input.blade.has_value();
}

void ExerciseScorer::State::note_blade(const BladePose& pose, const FrameReport& report, StrokeNotes& notes) const {
  if (!touches(report)) return;
  notes.has_touched = true;
  const NearestPart part = nearest_part(line, pose.edge);
  if (part.distance > line.reach(exercise.depth)) return;
  const double angle = angle_between(part.direction, line.normal_at(line.place_of(part.point).arc));
  const double error = std::abs(angle - exercise.angle);
  notes.angle_sum += error;
  notes.angle_max = std::max(notes.angle_max, error);
  ++notes.angle_frames;
}

void ExerciseScorer::State::sum_strokes(std::uint32_t now, ExerciseScore& score) const {
  double sum = 0, most = 0;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < strokes.size() && i < now; ++i) {
    score.strokes += strokes[i].has_touched ? 1U : 0U;
    sum += strokes[i].angle_sum;
    most = std::max(most, strokes[i].angle_max);
    count += strokes[i].angle_frames;
  }
  score.corrections = corrections + (applied > now ? applied - now : 0);
  if (count == 0) return;
  score.angle_error_mean = sum / static_cast<double>(count);
  score.angle_error_max = most;
}

ExerciseScorer::ExerciseScorer(const Scene& scene, const TetMesh& mesh)
    : state_(std::make_unique<State>(*scene.exercise, scene.options.frame_seconds, mesh)) {}
ExerciseScorer::ExerciseScorer(ExerciseScorer&&) noexcept = default;
ExerciseScorer& ExerciseScorer::operator=(ExerciseScorer&&) noexcept = default;
ExerciseScorer::~ExerciseScorer() = default;

void ExerciseScorer::add(const FrameInput& input, const FrameReport& report, const Simulation& simulation) {
  State& s = *state_;
  s.follow_strokes(input, report, std::max(report.stroke, simulation.engine().stroke_count()));
  if (input.blade) {
    if (s.end_blade == 0) s.first_blade = s.frames;
    s.end_blade = s.frames + 1;
    if (report.stroke > 0) s.note_blade(*input.blade, report, s.strokes[report.stroke - 1]);
  }
  const double force = report.blade.force.norm();
  s.peak_force = std::max(s.peak_force, force);
  s.force_frames += s.exercise.max_force > 0 && force > s.exercise.max_force ? 1 : 0;
  ++s.frames;
}

ExerciseScore ExerciseScorer::score(const Simulation& simulation) const {
  const State& s = *state_;
  ExerciseScore score;
  measure_mesh(s.exercise, s.line, simulation.mesh(), score);
  const std::uint32_t under_way = simulation.engine().is_in_stroke() ? s.applied : 0;
  s.sum_strokes(std::max(simulation.engine().stroke_count(), under_way), score);
  score.peak_force = s.peak_force;
  score.force_frames = s.force_frames;
  score.seconds = static_cast<double>(s.end_blade - s.first_blade) * s.frame_seconds;
  Grader(s.exercise, score).run();
  return score;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
