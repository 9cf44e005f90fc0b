// SPDX-License-Identifier: Apache-2.0
// A hand that draws along the line of an exercise makes that incision: slow or fast, on a picture that is late and in
// a simulation that lags behind.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "app/hands/hand_queue.h"
#include "app/hands/tools.h"
#include "app/session/session.h"
#include "app/view/scene_camera.h"
#include "app/view/surface_view.h"
#include "incise/mesh/validate.h"

namespace incise::app::hand_exercise_test {
namespace {

using Kind = PointerEvent::Kind;

constexpr Viewport kWindow{1280, 720};
constexpr double kEventsPerSecond = 60;
constexpr double kMust = 95;  // points of 100

/// How a hand draws, and how the program keeps up with it.
struct Manner {
  const char* name;
  double seconds;            // that the drag takes
  std::size_t lag;           // frames by which the picture is late
  double frames_per_second;  // of the simulation, by the clock
  bool is_curved;

  friend std::ostream& operator<<(std::ostream& out, const Manner& manner) { return out << manner.name; }
};

Scene exercise(bool is_curved) {
  Scene scene = read_scene(std::string(INCISE_SCENES) + "/train_skin.json").value();
  if (!is_curved) return scene;
  scene.exercise->target.clear();
  for (int i = 0; i <= 40; ++i) {
    const double x = 25 + 0.75 * i;
    scene.exercise->target.emplace_back(x, 27.3 + 8 * std::sin(M_PI * i / 40), 24);
  }
  return scene;
}

/// A window without the window: the person sees the surface of some frames ago, and the simulation takes what the hand
/// did when it comes to it.
class Trainee {
 public:
  explicit Trainee(const Manner& manner)
      : manner_(manner),
        session_(Session::open(exercise(manner.is_curved)).value()),
        view_(session_.mesh(), session_.engine().journal()) {
    look();
    const Box body{{0, 0, 0}, {80, 60, 24}};
    tools_.set(settings_for(body, 4000, 1e-3));
    ToolSettings settings = tools_.settings();
    settings.depth = session_.scene().exercise->depth;
    tools_.set(settings);
    camera_ = camera_of(session_.scene(), body, kWindow);
  }

  ExerciseScore draw() {
    const auto events = static_cast<int>(manner_.seconds * kEventsPerSecond);
    send(Kind::kPress, 0);
    for (int i = 1; i <= events; ++i) {
      pass();
      send(Kind::kMove, static_cast<double>(i) / events);
    }
    send(Kind::kRelease, 1);
    for (int i = 0; i < 60; ++i) frame();
    return session_.score().value();
  }
  [[nodiscard]] const Session& session() const { return session_; }

 private:
  /// At a share of the target's length.
  void send(Kind kind, double share) {
    const std::vector<Vec3>& line = session_.scene().exercise->target;
    const double at = share * static_cast<double>(line.size() - 1);
    const std::size_t from = std::min(static_cast<std::size_t>(at), line.size() - 2);
    const Vec3 point = line[from] + (at - static_cast<double>(from)) * (line[from + 1] - line[from]);
    PointerEvent event;
    event.kind = kind;
    event.pixel = to_pixel(camera_, kWindow, point).value();
    tools_.handle(event, {kWindow, &seen_.front(), {{0, 0, 0}, {80, 60, 24}}}, camera_);
    queue_.push(tools_.hands());
  }
  /// The time between two events.
  void pass() {
    for (owed_ += manner_.frames_per_second / kEventsPerSecond; owed_ >= 1; owed_ -= 1) frame();
  }
  void frame() {
    ASSERT_TRUE(session_.frame(queue_.pop()).ok());
    look();
  }
  void look() {
    view_.follow(session_.mesh(), session_.engine().journal());
    SurfaceFrame now;
    view_.fill(session_.mesh(), now);
    seen_.push_back(std::move(now));
    if (seen_.size() > manner_.lag + 1) seen_.pop_front();
  }

  Manner manner_;
  Session session_;
  SurfaceView view_;
  std::deque<SurfaceFrame> seen_;  // the newest last; the first is on the screen
  ToolMachine tools_{ToolSettings{1, 0, 1, 1, 1, 1}};
  HandQueue queue_;
  Camera camera_;
  double owed_ = 0;  // frames
};

class HandOnExercise : public testing::TestWithParam<Manner> {};

TEST_P(HandOnExercise, MakesTheIncision) {
  Trainee trainee(GetParam());
  const ExerciseScore score = trainee.draw();
  EXPECT_GE(score.points, kMust) << to_text(score);
  EXPECT_TRUE(validate(trainee.session().mesh(), ValidateLevel::kGeometry).ok);
}

INSTANTIATE_TEST_SUITE_P(All, HandOnExercise,
                         testing::Values(Manner{"slow", 6, 1, 60, false}, Manner{"usual", 3, 1, 60, false},
                                         Manner{"fast", 0.5, 1, 60, false}, Manner{"late_by_6_frames", 3, 6, 60, false},
                                         Manner{"at_8_frames_a_second", 3, 1, 8, false},
                                         Manner{"fast_at_8_frames_a_second", 0.5, 1, 8, false},
                                         Manner{"curved", 3, 1, 60, true}, Manner{"curved_fast", 0.7, 1, 60, true},
                                         Manner{"curved_late_by_6_frames", 3, 6, 60, true},
                                         Manner{"curved_at_8_frames_a_second", 2, 1, 8, true}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace incise::app::hand_exercise_test
