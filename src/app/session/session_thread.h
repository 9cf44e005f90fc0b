// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/hands/device_hand.h"
#include "app/session/probe.h"
#include "app/session/quality_monitor.h"
#include "app/session/session.h"
#include "app/session/starting_body.h"
#include "app/session/starting_exercise.h"
#include "app/session/validity_monitor.h"
#include "app/view/surface_view.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What another thread sees of a session after a frame. A value: it stays as it is while the session goes on.
struct SessionView {
  std::uint64_t session = 0;  ///< grows with every file that is opened: the camera and the tools begin anew
  std::uint64_t serial = 0;   ///< grows with everything that happens
  SurfaceFrame surface;
  Box body;     ///< around the body, what a clip plane hides included
  Marks marks;  ///< of the session, of what is probed, and of the worst tets where they are asked for
  std::shared_ptr<const Scene> scene;
  std::string title;
  SessionFigures figures;
  QualityFigures quality, quality_before;
  ValidityLight validity;
  std::shared_ptr<const std::vector<Operation>> log = std::make_shared<const std::vector<Operation>>();  ///< never null
  std::optional<ProbeInfo> probe;
  std::optional<ExerciseScore> score;    ///< once it was asked for, until the body starts anew
  std::uint64_t scores = 0;              ///< how many there were
  std::optional<ExerciseGauges> gauges;  ///< of an exercise
  ReplayPlace place;
  double steps_per_second = 0;  ///< of the simulation, by the clock
  double real_time = 0;         ///< seconds simulated per second, where it runs; 1: it keeps up
  bool is_replay = false, is_paused = false, is_recording = false;
  std::string busy;           ///< what is under way that takes long, for instance "Opening x.mesh"; empty: nothing
  std::string notice;         ///< the newest message to the person
  std::uint64_t notices = 0;  ///< how many there were
};

struct SessionThreadOptions {
  SessionOptions session;  ///< of every file that is opened
  double speed = 1;        ///< of the simulation against the clock; 0: as fast as it can
  bool is_paused = false;
  std::size_t worst_shown = 0;
  /// A hand at a haptic device, which then has the blade; that of `set_hands` counts no more. May be null.
  std::shared_ptr<DeviceHand> device;
};

/// Runs a session on a thread of its own, at the pace of the clock, and shows every frame to one other thread: neither
/// waits for the other, for a file that is opened included.
///
/// All calls return at once and take effect between two frames, in order. What fails becomes a notice; the session
/// goes on as it was. Calls from one thread.
class SessionThread {
 public:
  explicit SessionThread(Session session, const SessionThreadOptions& options = {});
  SessionThread(const SessionThread&) = delete;
  SessionThread& operator=(const SessionThread&) = delete;
  ~SessionThread();  ///< ends the thread after its frame; a recording is whole then

  /// Takes the newest view where there is a new one.
  bool take();
  [[nodiscard]] const SessionView& view() const;

  void set_hands(const HandState& hands);
  void open(const std::filesystem::path& path);
  /// One of the bodies, or of the exercises, that need no file.
  void open(StartingBody body);
  void open(StartingExercise exercise);
  void pause(bool is_paused);
  void pause_or_go_on();  ///< whichever it does not do then
  void step();            ///< one frame, and pauses
  void reset();
  void undo();
  void redo();
  void follow(const Stroke& stroke, std::optional<ToolKind> tool = {});
  void end_script();
  void add_suture(const std::array<Vec3, 2>& rest_places, const Suture& suture);
  void probe(Side side);
  void seek(std::uint64_t call);
  void seek_next_step();
  void take_over();
  void start_recording(const std::filesystem::path& path);
  void stop_recording();
  /// Ends the recording where there is one then.
  void start_or_stop_recording(const std::filesystem::path& path);
  void export_mesh(const std::filesystem::path& path);
  void show(const SurfaceOptions& surface, std::size_t worst);
  void set_speed(double speed);
  /// Scores the exercise as it stands, pauses, and writes the score (JSON) and the attempt (a recording).
  void score(const std::filesystem::path& json, const std::filesystem::path& attempt);
  /// Whether the ideal of the exercise is shown beside the blade.
  void show_ideal(bool is_shown);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
