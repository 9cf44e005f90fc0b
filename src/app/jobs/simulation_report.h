// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/jobs/report.h"
#include "app/jobs/scene_hand.h"
#include "app/scene/exercise_score.h"
#include "incise/sim/body.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What the hands felt and did, over all frames. SI units.
struct ForceFigures {
  double peak_force = 0;              ///< of the tissue on the blade's edge, N
  double engaged_length = 0;          ///< of the edge at most, m
  double fracture_work = 0;           ///< J
  double friction_work = 0;           ///< J
  double tool_work = 0;               ///< of the hand with the edge, J
  std::uint64_t touching_frames = 0;  ///< in which the edge pressed on tissue
  std::uint64_t yielding_frames = 0;  ///< in which tissue gave way
  double peak_hook_force = 0;         ///< of the tissue on one hook, N
  double peak_suture_force = 0;       ///< with which one suture pulled or pushed, N
  std::uint64_t torn_sutures = 0;     ///< how many tore
  std::uint64_t contacts = 0;         ///< vertices that tools touched at once, at most
};

/// Share of the time of the stages (paper, Figure 15's terms), in [0, 1]; all zero where nothing took time.
struct TimeShare {
  double collision = 0;  ///< "cd"
  double geometry = 0;   ///< "gm": subdivide, separate, merge, improve
  double relax = 0;      ///< "rlx"
  double render = 0;     ///< "rd": 0 where nothing is drawn
};
[[nodiscard]] TimeShare share_of(const StageTimes& times);

/// Everything that `incise simulate` reports.
struct SimulationReport {
  /// As for a cut: `step_ms` are the frames with a blade without their relaxation, `stage_ms` all frames; `quality_cut`
  /// is before the last stroke's blade was lifted off. At rest.
  JobReport job;
  std::string scene;  ///< the file
  std::string name;   ///< of the scene
  std::uint64_t frames = 0;
  double frame_seconds = 0;
  std::uint64_t settle_frames = 0;
  std::vector<double> frame_ms;  ///< by the clock
  BodyEnergy energy_before;      ///< after settling
  BodyEnergy energy_after;
  ForceFigures forces;
  HapticFigures haptics;            ///< of a simulated hand that holds the blade; no ticks where the scene has none
  std::uint64_t inverted_tets = 0;  ///< as the body stands at the end
  bool is_finite = true;            ///< the body's positions
  std::uint64_t state_hash = 0;     ///< of the mesh and the body at the end
  std::optional<ExerciseScore> exercise;  ///< where the scene is one
};

/// The report as JSON, format "incise-report" version 1, with a newline at the end. Cost: O(frames + pieces).
[[nodiscard]] std::string to_json(const SimulationReport& report);

/// A few lines for people.
[[nodiscard]] std::string to_text(const SimulationReport& report);

}  // namespace app
}  // namespace v0
}  // namespace incise
