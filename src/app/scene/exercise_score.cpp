// SPDX-License-Identifier: Apache-2.0
// Notes what only frames know, stroke by stroke: forces, angles, depth at the place nearest to the line. The mesh is
// measured when the score is asked for; strokes that were undone fall out by their numbers.
#include "app/scene/exercise_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/scene/exercise_goals.h"
#include "app/scene/exercise_grade.h"
#include "app/scene/exercise_measure.h"
#include "app/scene/scene.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr int kEdgePieces = 16;                // of a part of the edge, looked at for the place nearest to the line
constexpr std::size_t kMaxForces = 1'000'000;  // frames whose force is kept
constexpr double kRightAngle = 90;             // degrees
constexpr double kGaugeReach = 2;              // of what was asked for: the end of a gauge's scale

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

/// Where an edge is a ring, the axis of the ring; else zero.
Vec3 ring_axis(const std::vector<Vec3>& edge) {
  Vec3 axis = Vec3::Zero();
  if (edge.size() < 4 || edge.front() != edge.back()) return axis;
  for (std::size_t i = 1; i < edge.size(); ++i) axis += (edge[i - 1] - edge[0]).cross(edge[i] - edge[0]);
  return axis;
}

/// Between a line and a normal, in [0, 90] degrees.
double angle_between(const Vec3& direction, const Vec3& normal) {
  return std::atan2(direction.cross(normal).norm(), std::abs(direction.dot(normal))) * 180 / std::numbers::pi;
}

}  // namespace

struct ExerciseScorer::State {
  State(const Exercise& asked, double seconds, const TetMesh& mesh)
      : exercise(asked), frame_seconds(seconds), line(asked, mesh), goals(exercise, line, mesh) {
    begin_gauges();
  }

  void begin_gauges();
  void follow_gauges(const FrameInput& input, const FrameReport& report);
  [[nodiscard]] double angle_at(const BladePose& pose, const NearestPart& part) const;

  void follow_strokes(const FrameInput& input, const FrameReport& report, std::uint32_t applied);
  void note_blade(const BladePose& pose, const FrameReport& report, StrokeNotes& notes) const;
  void sum_strokes(std::uint32_t applied, ExerciseScore& score) const;

  Exercise exercise;
  double frame_seconds;
  TargetLine line;
  ExerciseGoals goals;
  ExerciseGauges gauges;
  std::vector<StrokeNotes> strokes;  // by their numbers, from 1; those taken back stay, for they may be applied again
  std::uint32_t applied = 0;         // strokes that stood after the last frame
  std::uint32_t corrections = 0;
  bool had_blade = false;
  std::uint64_t frames = 0, first_blade = 0, end_blade = 0;
  double peak_force = 0;
  std::uint64_t force_frames = 0;
  std::vector<double> forces;  // from the first frame with a blade on
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

/// Of the edge, or of the axis of a ring, against the skin's normal, in [0, 90] degrees.
double ExerciseScorer::State::angle_at(const BladePose& pose, const NearestPart& part) const {
  const Vec3 axis = ring_axis(pose.edge);
  return angle_between(axis.isZero(0) ? part.direction : axis, line.normal_at(line.place_of(part.point).arc));
}

void ExerciseScorer::State::begin_gauges() {
  const ExerciseTolerances& allowed = exercise.tolerances;
  const double depth = exercise.depth, angle = exercise.angle, force = exercise.max_force;
  gauges[0] = {"Depth",
               "",
               ExerciseScore::kUnmeasured,
               std::max(0.0, depth - allowed.depth),
               depth + allowed.depth,
               kGaugeReach * depth + allowed.depth};
  gauges[1] = {"Angle",
               "deg",
               ExerciseScore::kUnmeasured,
               std::max(0.0, angle - allowed.angle),
               std::min(kRightAngle, angle + allowed.angle),
               kRightAngle};
  gauges[2] = {"Force",
               "N",
               ExerciseScore::kUnmeasured,
               0,
               force > 0 ? force + allowed.force : 0,
               force > 0 ? kGaugeReach * (force + allowed.force) : 1};
}

/// Without a limit the scale of force goes to the greatest one so far.
void ExerciseScorer::State::follow_gauges(const FrameInput& input, const FrameReport& report) {
  for (ExerciseGauge& gauge : gauges) gauge.value = ExerciseScore::kUnmeasured;
  if (!input.blade) return;
  const double force = report.blade.force.norm();
  gauges[2].value = force;
  if (!(exercise.max_force > 0)) gauges[2].high = gauges[2].most = std::max(gauges[2].most, force);
  if (!touches(report)) return;
  const NearestPart part = nearest_part(line, input.blade->edge);
  gauges[1].value = angle_at(*input.blade, part);
  gauges[0].value = 0;
  for (const Vec3& point : input.blade->edge) {
    gauges[0].value = std::max(gauges[0].value, line.place_of(point).depth);
  }
}

void ExerciseScorer::State::note_blade(const BladePose& pose, const FrameReport& report, StrokeNotes& notes) const {
  if (!touches(report)) return;
  notes.has_touched = true;
  const NearestPart part = nearest_part(line, pose.edge);
  if (part.distance > line.reach(exercise.depth)) return;
  const double error = std::abs(angle_at(pose, part) - exercise.angle);
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
  s.follow_gauges(input, report);
  const double force = report.blade.force.norm();
  s.peak_force = std::max(s.peak_force, force);
  if (s.end_blade > 0 && s.forces.size() < kMaxForces) s.forces.push_back(force);
  s.force_frames += s.exercise.max_force > 0 && force > s.exercise.max_force ? 1 : 0;
  ++s.frames;
}

ExerciseScore ExerciseScorer::score(const Simulation& simulation) const {
  const State& s = *state_;
  ExerciseScore score;
  measure_mesh(s.exercise, s.line, simulation.mesh(), score);
  s.goals.measure(simulation.mesh(), score);
  const std::uint32_t under_way = simulation.engine().is_in_stroke() ? s.applied : 0;
  s.sum_strokes(std::max(simulation.engine().stroke_count(), under_way), score);
  score.peak_force = s.peak_force;
  score.force_frames = s.force_frames;
  score.forces = s.forces;
  score.forces.resize(static_cast<std::size_t>(std::min<std::uint64_t>(s.forces.size(), s.end_blade - s.first_blade)));
  score.seconds = static_cast<double>(s.end_blade - s.first_blade) * s.frame_seconds;
  grade(s.exercise, score);
  return score;
}

const ExerciseGauges& ExerciseScorer::gauges() const {
  return state_->gauges;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
