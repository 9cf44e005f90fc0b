// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "app/recording/engine_recording.h"
#include "incise/engine/engine.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Where a session is recorded, and what its header says beside the engine's options.
struct RecordTo {
  std::filesystem::path file;       ///< the recording; empty: none is made
  std::filesystem::path mesh_file;  ///< that the mesh was loaded from, as seen from here; empty: none
  std::uint64_t seed = 0;
};

/// An engine that keeps a recording of what is asked of it: `run_replay` does the same again.
///
/// Each call does what the call of `Engine` of the same name does, and fails as it does. Then its line is written:
/// where that fails, the error is kIo and names the file, the call has taken effect, and nothing more is recorded.
/// What changes nothing has no line: a call refused with kBadArgument, an undo or redo where there is none. Without a
/// recording it is the engine and nothing else. One writer, as for `Engine`.
/// Cost: the engine's, plus one hash of the mesh (about 20 ns per tet) and one write per call.
class RecordedEngine {
 public:
  /// Takes the mesh as it was loaded. Errors: as `Engine::create`.
  static Result<RecordedEngine> create(TetMesh mesh, EngineOptions options, const RecordTo& to = {});

  [[nodiscard]] const Engine& engine() const { return engine_; }
  [[nodiscard]] const TetMesh& mesh() const { return engine_.mesh(); }

  Result<StrokeReport> cut(const Stroke& stroke);
  Result<std::uint32_t> begin_stroke(const BladePose& pose);
  Result<StepReport> step(const BladePose& pose);
  Result<StrokeReport> end_stroke();
  Status set_positions(std::span<const Vec3> positions);
  /// Where `should_stop` ends it, the recording keeps after how many of its questions: the same happens again whatever
  /// the clock.
  Result<MaintainReport> maintain(std::uint64_t work_units = kUnlimitedWork, const ShouldStop& should_stop = {});
  /// Within the engine's work units alone; go on with `maintain` where a clock shall decide.
  Result<MaintainReport> improve();
  Result<bool> undo();
  Result<bool> redo();

  /// Milliseconds that the engine took for the last call, recording not counted.
  [[nodiscard]] double last_ms() const { return last_ms_; }

 private:
  RecordedEngine(Engine engine, std::optional<RecordingWriter> writer);

  template <class Call>
  auto timed(const Call& call);
  template <class Fill, class Outcome>
  Outcome recorded(CallKind kind, Outcome outcome, const Fill& fill);

  Engine engine_;
  std::optional<RecordingWriter> writer_;
  double last_ms_ = 0;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
