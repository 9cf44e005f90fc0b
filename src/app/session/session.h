// SPDX-License-Identifier: Apache-2.0
// What a window, a headless run and a test open, run and ask alike: a body under the hands of a person, or a recording
// that is played again. No clock, no thread, no window.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/hands/hand_queue.h"
#include "app/hands/tools.h"
#include "app/recording/recorded_simulation.h"
#include "app/scene/exercise_score.h"
#include "app/scene/scene.h"
#include "app/session/operation_log.h"
#include "app/view/picture.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The scene of a mesh without one: soft tissue (20 kPa, 1000 kg/m³) whose longest side is 10 cm, held by its
/// lowest tenth on a table under gravity along −`up`. Regions whose names speak of a tissue are made of it.
///
/// @param body  the mesh's bounds, in its own unit. @param up  unit.
[[nodiscard]] Scene scene_of_mesh(const std::filesystem::path& mesh, const Box& body, const Vec3& up);

/// Strokes that a session can take back unless told otherwise; the history of one takes the memory of all that it
/// changed, before and after.
inline constexpr std::size_t kKeptStrokes = 100;

struct SessionOptions {
  unsigned threads = 1;          ///< in [1, 256]; the result does not depend on them
  LogSink log;                   ///< hears what a stroke could not do as asked
  std::filesystem::path record;  ///< from the start; empty: no recording, until one is begun
  Vec3 up = Vec3::UnitZ();       ///< of a mesh without a scene; unit
  std::string surface = {};      ///< takes the place of the scene's `model.surface`; empty: that stays
  bool plays_script = true;      ///< the strokes of a scene are made until a hand takes over
  /// Strokes that undo can take back, the last ones: the memory of those before them is freed, so that a session may
  /// last. 0: all. While a recording is played all are kept, since it may take any back.
  std::size_t keep_undo = kKeptStrokes;
};

/// The force on the blade at one moment.
struct ForceSample {
  float time = 0;   ///< s of the simulation
  float force = 0;  ///< N
};

/// Running figures of a session: sums since it was opened or reset, unless they say otherwise.
struct SessionFigures {
  static constexpr std::size_t kForceSamples = 600;

  std::uint64_t frames = 0;
  double seconds = 0;                                 ///< of the simulation
  StageTimes times;                                   ///< summed over the frames
  double frame_ms = 0;                                ///< of the last frame, by the clock
  double busy_ms = 0;                                 ///< of all frames
  std::uint64_t tets = 0, vertices = 0, strokes = 0;  ///< now
  std::uint64_t tets_at_start = 0;
  CutStatistics cut;
  MaintainStatistics maintain;
  BladeState blade;                ///< of the last frame
  double peak_force = 0;           ///< N
  std::vector<ForceSample> force;  ///< the newest `kForceSamples`, oldest first
};

/// How far a recording has been played.
struct ReplayPlace {
  std::uint64_t call = 0, calls = 0;
};

/// One writer. All calls but `open` leave the session usable when they fail.
class Session {
 public:
  /// Opens a scene, a mesh, or a recording of either kind (of `incise simulate` or `incise cut`), told apart by what is
  /// in it. A scene's body has come to rest when this returns.
  /// Errors: as `read_scene`, `load_model`, `SimulationReader` and `RecordingReader`, naming the file.
  static Result<Session> open(const std::filesystem::path& path, const SessionOptions& options = {});
  /// The same for a scene in memory.
  static Result<Session> open(const Scene& scene, const SessionOptions& options = {});
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  /// One frame: the scene's script, or the next call of a recording, and what the hands do. At the end of a recording
  /// nothing happens. Errors: kIo where the recording fails; others as `Simulation::frame`.
  Status frame(const HandState& hands = {});
  /// Has the blade follow a stroke over the next frames, at its own times, after those that it follows already. Does
  /// nothing while a recording is played, or for a stroke that breaks its promises.
  /// @param tool  whose stroke it is: it spares the regions that the scene's `spare` names for it.
  void follow(const Stroke& stroke, std::optional<ToolKind> tool = {});
  /// Whether such a stroke is under way.
  [[nodiscard]] bool is_following() const;
  /// Ends the strokes and hooks of the scene where they are, until the body starts anew: a person goes on.
  void end_script();
  /// Sets a suture or a staple between two places of the rest shape, length unit. `undo` takes it out again. Errors:
  /// kBadArgument while a recording is played; as `Simulation::add_suture`.
  Status add_suture(const std::array<Vec3, 2>& rest_places, const Suture& suture);
  /// Takes the last stroke or suture back, whichever came later.
  Result<bool> undo();
  Result<bool> redo();
  /// Back to the start, a recording of the session included: it begins again under the same name with a number,
  /// the first that no file has.
  Status reset();

  [[nodiscard]] bool is_replay() const;
  [[nodiscard]] ReplayPlace place() const;
  /// Plays a recording up to a call, from the start where it lies behind. Stops early where `should_stop` says so.
  Status seek(std::uint64_t call, const ShouldStop& should_stop = {});
  /// Plays up to the end of the next stroke, undo or redo.
  Status seek_next_step(const ShouldStop& should_stop = {});
  /// Goes on by hand from where the recording stands. Does nothing for recordings of `incise cut`, which have no body
  /// to simulate. Returns whether the session is live now.
  bool take_over();

  /// Records the session from its start to this file; see `RecordedSimulation`.
  Status start_recording(const std::filesystem::path& path);
  void stop_recording();
  [[nodiscard]] bool is_recording() const;
  /// Writes a recording of the session so far, beside one that is under way. Errors: as `start_recording`.
  [[nodiscard]] Status save_recording(const std::filesystem::path& path) const;
  /// Writes the mesh as it is at rest, with regions, pieces and strokes. Errors: as `io::write_mesh`.
  Status export_mesh(const std::filesystem::path& path) const;

  [[nodiscard]] const Scene& scene() const;
  [[nodiscard]] const std::string& title() const;  ///< the scene's name, or the file's
  [[nodiscard]] const Engine& engine() const;
  [[nodiscard]] const TetMesh& mesh() const { return engine().mesh(); }
  [[nodiscard]] const Simulation* simulation() const;  ///< null for a recording of `incise cut`
  [[nodiscard]] const SessionFigures& figures() const;
  [[nodiscard]] const OperationLog& log() const;
  [[nodiscard]] OperationLog& log();
  /// How well the exercise of the scene was done so far; nothing where it has none. Cost: O(tets).
  [[nodiscard]] std::optional<ExerciseScore> score() const;
  /// Depth, angle and force of the blade in the last frame; nothing where the scene has no exercise. Cost: O(1).
  [[nodiscard]] std::optional<ExerciseGauges> gauges() const;
  /// Adds the marks of what the scene or the recording does: its blade, hooks, tools and sutures, and an
  /// exercise's target and what is to come off.
  /// @param shows_ideal  the ideal blade of the exercise as well, where it would be now.
  void draw(Marks& marks, bool shows_ideal = false) const;

 private:
  struct State;
  explicit Session(std::unique_ptr<State> state);
  static Result<Session> open_simulation_recording(const std::filesystem::path& path, const SessionOptions& options);
  static Result<Session> open_engine_recording(const std::filesystem::path& path, const SessionOptions& options);
  static Result<Session> begin(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
