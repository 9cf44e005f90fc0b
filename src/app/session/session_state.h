// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/recording/engine_recording.h"
#include "app/recording/simulation_recording.h"
#include "app/session/session.h"
#include "incise/io/mesh_data.h"

namespace incise {
inline namespace v0 {
namespace app {

struct Session::State {
  /// Who has the blade.
  enum class BladeSource : std::uint8_t { kNone, kScript, kFollowed, kHand };

  /// A suture that a hand has set, and after how many strokes.
  struct Sewn {
    SutureCall call;
    std::uint32_t strokes = 0;
  };

  // What the session was opened with.
  SessionOptions options;
  Scene scene;
  std::string title;
  TetMesh initial;
  std::vector<std::uint32_t> file_vertex;
  io::RegionNames region_names;            // for what is written
  std::vector<SimulationCall> calls;       // of a recording of a simulation
  std::vector<RecordedCall> engine_calls;  // of a recording of an engine
  EngineOptions engine_options;            // likewise
  bool is_engine_replay = false;
  std::string recording_name;  // of what is played

  // What changes.
  std::optional<RecordedSimulation> simulation;
  std::optional<Engine> engine;  // of a recording of an engine
  std::optional<ExerciseScorer> scorer;
  std::optional<std::uint64_t> attempt_began;  // the first frame with a blade
  bool is_replay = false;
  std::size_t next_call = 0;
  bool plays_script = true, plays_hooks = true;  // of the scene
  std::optional<Scene> followed;                 // a stroke that the blade follows, from its frame `followed_frame` on
  std::uint64_t followed_frame = 0;
  BladeSource blade_source = BladeSource::kNone;
  std::vector<std::int32_t> stop_at;  // regions that it is held outside of
  bool is_blade_refused = false;      // it would begin in them
  FrameInput last_input;
  Vec3 blade_way = Vec3::Zero();  // of the blade's edge, last time it moved
  SessionFigures figures;
  OperationLog log;
  std::uint32_t stroke_under_way = 0;
  CutStatistics stroke_cut;
  std::vector<Sewn> sewn, unpicked;                  // in the order in which they were set, and taken out
  bool forgets_undone = false;                       // a suture was set since the last stroke was taken back
  double stroke_peak = 0;                            // N
  std::filesystem::path recording, first_recording;  // those after a reset are named by the first

  [[nodiscard]] const Engine& engine_now() const { return simulation ? simulation->simulation().engine() : *engine; }
  [[nodiscard]] const TetMesh& mesh() const { return engine_now().mesh(); }
  [[nodiscard]] std::size_t call_count() const { return is_engine_replay ? engine_calls.size() : calls.size(); }

  /// Puts the body where it starts.
  Status start();
  FrameInput input_of(const HandState& hands);
  Status run(const FrameInput& input);
  Result<FrameReport> frame(const FrameInput& input);
  Status play_call();
  void note(Operation::Kind kind, std::string text);
  void count();
  Status sew(const std::array<Vec3, 2>& rest_places, const Suture& suture);
  Result<bool> unpick();  // the last one; whether it was the last thing done
  Result<bool> sew_again();
  [[nodiscard]] std::filesystem::path next_recording_name() const;
  Status record(const std::filesystem::path& path);

 private:
  Result<RecordedSimulation> make_simulation() const;
  Result<Engine> make_engine() const;
  void choose_blade(const HandState& hands, FrameInput& input);
  void add(const FrameReport& report);
  void add_force(double force);
  void end_frame();
  void follow_stroke(const FrameReport& report);
  Status play(const SimulationCall& call);
  Status play(const RecordedCall& call);
  void compare_at_end(const SimulationCall& call);
};

}  // namespace app
}  // namespace v0
}  // namespace incise
