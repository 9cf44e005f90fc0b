// SPDX-License-Identifier: Apache-2.0
// How well an attempt at an exercise was cut.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/exercise.h"
#include "incise/engine/simulation.h"

namespace incise {
inline namespace v0 {
namespace app {

/// One kind of fault: what it may cost, and what it did cost.
struct ExerciseCriterion {
  std::string kind;  ///< one word for programs: the row of docs/formats.md
  double most = 0;   ///< points that it costs at most, above 0
  double lost = 0;   ///< points that were taken off, in [0, `most`], to a tenth
};

/// A hundredth of the target line, and the cut that belongs to it. Length units, of the rest shape.
struct ExercisePlace {
  Vec3 ideal = Vec3::Zero();    ///< on the skin of the uncut mesh
  Vec3 normal = Vec3::UnitZ();  ///< of the skin, outward and unit
  bool is_cut = false;          ///< the contour of the cut passes here
  Vec3 beside = Vec3::Zero();   ///< from the line to that contour, along the skin, on average
  double depth = 0;             ///< of the deepest wall, at least 0
};

/// What became of tissue that was to stay whole.
struct ExerciseWound {
  std::string name;    ///< for people
  double depth = 0;    ///< into it from its nearest face that walls reach, length units
  double allowed = 0;  ///< of that
  double area = 0;     ///< of one lip of the walls in it
};

/// What became of tissue that was to come off. Length units, of the rest shape.
struct ExerciseRemoved {
  std::string name;        ///< for people
  bool has_piece = false;  ///< some of it came off
  double share = 0;        ///< of its volume that is in the piece with most of it, in [0, 1]
  double volume = 0;       ///< of that piece
  double margin_least =
      std::numeric_limits<double>::quiet_NaN();  ///< from its face to the piece's walls; NaN: no piece
  double margin_most = std::numeric_limits<double>::quiet_NaN();
};

/// Points taken off, and why.
struct ExerciseDeduction {
  std::string kind;    ///< one word for programs: the row of docs/formats.md
  double points = 0;   ///< above 0, at most 100, to a tenth
  std::string reason;  ///< for people, one clause
};

/// What was measured on an attempt, and the grade. Lengths in the model's unit, of the rest shape; angles in degrees.
///
/// A point of the cut belongs to the attempt where it is *near* the target line: within three times the tolerance of
/// the line, and below the skin as much further as the angle asked for, with its tolerance, takes it. What is not near
/// is *elsewhere*. The skin's height and normal are those of the uncut mesh along the line. A figure is NaN where there
/// is nothing to measure it on.
struct ExerciseScore {
  static constexpr double kUnmeasured = std::numeric_limits<double>::quiet_NaN();

  /// How far the near contour of the cut on the skin is beside the line (or its prolongation), by contour length.
  double line_mean = kUnmeasured, line_rms = kUnmeasured, line_max = kUnmeasured;
  double target_length = 0;
  double missed_length = 0;  ///< of the line, beside which there is no near contour, to a hundredth of the line
  double coverage_pct = 0;   ///< share of the line that is not missed, in [0, 100]
  double overshoot = 0;      ///< how far the near contour goes beyond the line's ends, at most

  /// Depth of the deepest wall below the skin, per hundredth of the line where the line is covered, without its ends
  /// (the tolerance of the line): the mean, and the mean and greatest absolute difference to what was asked for.
  double depth_mean = kUnmeasured, depth_error_mean = kUnmeasured, depth_error_max = kUnmeasured;
  double too_deep = 0;      ///< deepest wall near the line below the depth that was asked for, at least 0
  bool is_through = false;  ///< skin was cut from within below that depth and its tolerance: another wall was wounded

  /// Difference of the edge's angle against the skin's normal to the one asked for, over the frames in which the edge
  /// touched tissue near the line; the edge is taken where it is nearest to the line. Strokes taken back left out.
  double angle_error_mean = kUnmeasured, angle_error_max = kUnmeasured;

  /// Of the line, where the cut does not reach the lower side of the layers that must be divided, its ends left out.
  double undivided_length = 0;
  std::vector<ExerciseWound> wounds;       ///< as the exercise's `spare`
  std::optional<ExerciseRemoved> removed;  ///< where the exercise has `remove`
  std::vector<ExercisePlace> profile;      ///< along the line, from its first point

  std::uint32_t strokes = 0;      ///< that touched tissue and were not taken back
  std::uint32_t corrections = 0;  ///< strokes that were taken back
  double cut_area = 0;            ///< of one lip of all cuts
  double away_area = 0;           ///< of that, elsewhere
  double away_length = 0;         ///< of the cuts' contour on the skin, elsewhere

  double peak_force = 0;           ///< of the tissue on the edge, N, strokes taken back included
  std::uint64_t force_frames = 0;  ///< in which it was above what the exercise allows
  std::vector<double> forces;      ///< N, of each frame from the first with a blade to the last with one
  double seconds = 0;              ///< from the first frame with a blade to the last

  /// All that was judged, whether it cost something or not: `points` is 100 without all that was lost, at least 0.
  std::vector<ExerciseCriterion> criteria;
  double points = 0;                          ///< in [0, 100]: 100 without the deductions
  std::vector<ExerciseDeduction> deductions;  ///< the criteria that cost something, and why
  double pass = 0;                            ///< points from which an attempt has passed
  bool is_passed = false;
};

/// A figure of the hand while it cuts.
struct ExerciseGauge {
  const char* name = "";                                    ///< for people
  const char* unit = "";                                    ///< likewise; empty: the mesh's length unit
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no blade touches
  double low = 0, high = 0;                                 ///< within which nothing is lost
  double most = 1;                                          ///< end of the scale, above 0
};
/// Depth of the edge's lowest point below the skin, angle of the edge against the skin's normal, force on the edge.
using ExerciseGauges = std::array<ExerciseGauge, 3>;

/// Watches an attempt frame by frame and judges it.
///
/// One writer. The same frames of the same simulation give the same score, bit for bit.
class ExerciseScorer {
 public:
  /// @param scene  has an exercise; it is copied.
  /// @param mesh   before the first cut; it is not kept. Cost: O(tets).
  ExerciseScorer(const Scene& scene, const TetMesh& mesh);
  ExerciseScorer(ExerciseScorer&&) noexcept;
  ExerciseScorer& operator=(ExerciseScorer&&) noexcept;
  ~ExerciseScorer();

  /// Takes note of a frame that was done: what went in, what came out, and the simulation after it. Strokes that were
  /// taken back or applied again since the frame before are noticed here. Cost: O(points of the edge · of the target).
  void add(const FrameInput& input, const FrameReport& report, const Simulation& simulation);

  /// Judges what stands now. `simulation` is the one that was watched. At any time, also within a stroke.
  /// Cost: O(tets) and about 1 µs per edge of the walls.
  [[nodiscard]] ExerciseScore score(const Simulation& simulation) const;
  /// Of the frame that was added last. Cost: O(1).
  [[nodiscard]] const ExerciseGauges& gauges() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The score as JSON, format "incise-exercise-score" version 1 (docs/formats.md), with a newline at the end.
[[nodiscard]] std::string to_json(const ExerciseScore& score);

/// A few lines for people: the points, what was taken off, and the figures.
[[nodiscard]] std::string to_text(const ExerciseScore& score);

}  // namespace app
}  // namespace v0
}  // namespace incise
