// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/recording/simulation_recording.h"
#include "app/scene/scene.h"
#include "incise/core/log.h"
#include "incise/cut/region_guard.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Where and how a scene's simulation runs, beside what the scene says.
struct SceneRun {
  unsigned threads = 1;          ///< in [1, 256]; the result does not depend on them
  LogSink log = {};              ///< hears what a stroke could not do as asked
  std::filesystem::path record;  ///< the recording; empty: none is made
  bool keeps_calls = false;      ///< remembers all calls, so that `start_recording` may come later
  std::size_t keep_undo = 0;     ///< strokes that undo can take back, the last ones; 0: all
};

/// A scene's simulation that keeps a recording of what is asked of it: `run_replay` does the same again.
///
/// Each call does what the call of `Simulation` of the same name does, and fails as it does. Then its line is written,
/// as in `RecordedEngine`: where that fails, the error is kIo and names the file, the call has taken effect, and
/// nothing more is recorded. A call refused with kBadArgument has no line, nor has an undo or redo where there is none.
/// One writer. Cost: the simulation's, plus one hash of mesh and body and one write per call that is recorded.
class RecordedSimulation {
 public:
  /// @param mesh  as `load_model` gave it. Errors: as `make_simulation`.
  static Result<RecordedSimulation> create(const Scene& scene, TetMesh mesh, const SceneRun& run = {});

  [[nodiscard]] const Simulation& simulation() const { return simulation_; }

  /// As `Simulation::frame`. @param stop_at  regions that the blade is held outside of while this stroke lasts, see
  /// `RegionGuard`; a recording has the blade as it was held. Errors: also kBadArgument where it begins in them.
  Result<FrameReport> frame(const FrameInput& input, const std::vector<std::int32_t>& stop_at = {});
  /// As `Simulation::settle`; the recording has the frames that were made where it was stopped.
  Result<unsigned> settle(const SceneSettle& settle, const ShouldStop& should_stop = {});
  Result<bool> undo();
  Result<bool> redo();
  /// Of places of the rest shape.
  Result<std::uint32_t> add_suture(const std::array<Vec3, 2>& rest_places, const Suture& suture);
  Status remove_suture(std::uint32_t id);
  /// As `Simulation::keep_undo`. No call of a recording.
  Status keep_undo(std::size_t operations) { return simulation_.keep_undo(operations); }

  /// Begins a recording of the whole session: what was done so far goes in first, with the hash of the last call alone.
  /// Ends another recording that was under way. Errors: kBadArgument unless calls are kept; kIo, naming the file.
  /// Cost: O(calls so far).
  Status start_recording(const std::filesystem::path& path);
  void stop_recording() { writer_.reset(); }
  /// Writes a recording of the session so far, beside one that is under way. Errors and cost: as `start_recording`.
  [[nodiscard]] Status save_recording(const std::filesystem::path& path) const;
  [[nodiscard]] bool is_recording() const { return writer_.has_value(); }

  /// Milliseconds that the simulation took for the last call, recording not counted.
  [[nodiscard]] double last_ms() const { return last_ms_; }

 private:
  /// What it takes to record later what was done before.
  struct Past {
    Scene scene;
    std::uint64_t mesh_hash = 0;
    std::vector<SimulationCall> calls;  // without hashes
  };

  RecordedSimulation(Simulation simulation, std::optional<SimulationWriter> writer, std::optional<Past> past);

  [[nodiscard]] Result<SimulationWriter> write_past(const std::filesystem::path& path) const;
  Status hold_blade(const std::vector<std::int32_t>& stop_at, FrameInput& input);
  template <class Call>
  auto timed(const Call& call);
  template <class Outcome>
  Outcome recorded(SimulationCall call, Outcome outcome);

  Simulation simulation_;
  std::optional<SimulationWriter> writer_;
  std::optional<Past> past_;
  std::optional<RegionGuard> guard_;  // of the stroke under way
  double last_ms_ = 0;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
