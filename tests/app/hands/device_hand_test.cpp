// SPDX-License-Identifier: Apache-2.0
#include "app/hands/device_hand.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <thread>

#include "app/jobs/simulate_job.h"
#include "app/session/session_thread.h"

namespace device_hand_test {
namespace {

using namespace incise;
using app::DeviceHand;
using app::DeviceHandOptions;
using app::Scene;

/// What a device shares with the test that moves it.
struct Strings {
  std::mutex mutex;
  DeviceState state;
  Vec3 force = Vec3::Zero();
  double strongest = 0;
  std::uint64_t reads = 0;
  std::function<void(double, DeviceState&)> move;  // with the loop's time
};

class Puppet final : public HapticDevice {
 public:
  explicit Puppet(std::shared_ptr<Strings> strings) : strings_(std::move(strings)) {}
  DeviceState read(double time) override {
    const std::lock_guard lock(strings_->mutex);
    ++strings_->reads;
    if (strings_->move) strings_->move(time, strings_->state);
    return strings_->state;
  }
  void command(const Vec3& force) override {
    const std::lock_guard lock(strings_->mutex);
    strings_->force = force;
    strings_->strongest = std::max(strings_->strongest, force.norm());
  }

 private:
  std::shared_ptr<Strings> strings_;
};

/// A block of 10 cm in 8 x 8 x 8 bricks, on a table.
Scene block_scene() {
  Scene scene;
  scene.name = "block";
  scene.model.box.cells = {8, 8, 8};
  scene.options.body.length_unit = 0.1;
  scene.options.body.damping = 2;
  scene.options.materials.fallback.young = 10e3;
  scene.options.materials.fallback.toughness = 5;
  scene.attachments.push_back({app::HalfSpace{Vec3::UnitZ(), 0.001}});
  scene.frames = 60;
  return scene;
}

const Box kBlock{Vec3::Zero(), Vec3::Ones()};

struct Bench {
  std::shared_ptr<Strings> strings = std::make_shared<Strings>();
  std::unique_ptr<DeviceHand> hand;
  explicit Bench(const DeviceHandOptions& options = {}) {
    hand = DeviceHand::create(std::make_unique<Puppet>(strings), options).value();
  }
  void set(const std::function<void(DeviceState&)>& change) {
    std::uint64_t seen = 0;
    {
      const std::lock_guard lock(strings->mutex);
      change(strings->state);
      seen = strings->reads;
    }
    // The loop has to have come by, and to have published.
    while (reads() < seen + 3) std::this_thread::yield();
  }
  std::uint64_t reads() {
    const std::lock_guard lock(strings->mutex);
    return strings->reads;
  }
};

TEST(DeviceHand, HoldsTheEdgeAboveTheBodyAndBringsItIntoFramesWhereItIsNear) {
  Bench bench;
  EXPECT_FALSE(bench.hand->blade(kBlock));  // no body yet
  bench.hand->begin(block_scene(), kBlock);
  bench.set([](DeviceState&) {});
  EXPECT_FALSE(bench.hand->blade(kBlock));  // too far above
  EXPECT_TRUE(bench.hand->is_live());
  // An edge of 2 cm: its middle begins at 12 cm, in metres.
  bench.set([](DeviceState& state) { state.position.z() = -0.03; });
  // The tool follows the device within its coupling.
  std::optional<BladePose> pose;
  for (int i = 0; i < 2000 && !(pose && pose->edge.back().z() < 0.81); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    pose = bench.hand->blade(kBlock);
  }
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->edge.back().z(), 0.8, 0.01);
  EXPECT_NEAR(pose->edge.front().z(), 1.0, 0.01);
  EXPECT_NEAR(pose->edge.front().x(), 0.5, 1e-9);
  app::Marks marks;
  bench.hand->draw(marks);
  EXPECT_EQ(marks.lines.size(), 4U);
}

TEST(DeviceHand, LiftsTheBladeWhileTheButtonIsDownOrTheDeviceIsGone) {
  Bench bench;
  bench.hand->begin(block_scene(), kBlock);
  bench.set([](DeviceState&) {});
  bench.set([](DeviceState& state) { state.position.z() = -0.03; });
  ASSERT_TRUE(bench.hand->blade(kBlock));
  bench.set([](DeviceState& state) { state.buttons = app::PlacedDevice::kLift; });
  EXPECT_FALSE(bench.hand->blade(kBlock));
  EXPECT_TRUE(bench.hand->is_live());
  bench.set([](DeviceState& state) { state.buttons = 0; });
  EXPECT_TRUE(bench.hand->blade(kBlock));
  bench.set([](DeviceState& state) { state.is_live = false; });
  EXPECT_FALSE(bench.hand->blade(kBlock));
  EXPECT_FALSE(bench.hand->is_live());
  app::Marks marks;
  bench.hand->draw(marks);
  EXPECT_TRUE(marks.lines.empty());
}

TEST(DeviceHand, BadOptionsAreNamed) {
  DeviceHandOptions options;
  options.scale = 0;
  EXPECT_NE(DeviceHand::create(std::make_unique<NullDevice>(), options).error().message.find("scale"),
            std::string::npos);
  options = {};
  options.blade_length = -1;
  EXPECT_NE(check(options).error().message.find("edge"), std::string::npos);
  options = {};
  options.loop.rate = 1;
  EXPECT_NE(check(options).error().message.find("rate"), std::string::npos);
}

/// From above the block down into it, and then along x out of its side.
void saw(double time, DeviceState& state) {
  const double down = std::min(time / 0.2, 1.0), along = std::clamp((time - 0.25) / 0.5, 0.0, 1.0);
  state.position = Vec3(0.07 * along, 0, -0.03 * down);
}

TEST(DeviceHand, CutsInASceneWithoutAWindowAndFeelsTheTissue) {
  Bench bench;
  bench.strings->move = saw;
  const std::filesystem::path recording = std::filesystem::path(testing::TempDir()) / "device_hand.jsonl";
  app::SimulateJob job;
  job.hand = bench.hand.get();
  job.run.record = recording;
  const auto start = std::chrono::steady_clock::now();
  const auto result = run_simulate(block_scene(), job);
  ASSERT_TRUE(result.ok()) << result.error().message;
  // At the pace of the clock.
  EXPECT_GE(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 59.0 / 60);
  EXPECT_TRUE(result->report.job.change.ok);
  EXPECT_GT(result->report.job.cut.cut_tets, 5U);
  EXPECT_EQ(result->report.job.strokes, 1U);
  EXPECT_GT(result->report.haptics.ticks, 300U);
  EXPECT_GT(bench.strings->strongest, 0.01);
  EXPECT_LE(bench.strings->strongest, 3.3 + 1e-9);
  EXPECT_TRUE(std::filesystem::exists(recording));
  bench.hand.reset();
  EXPECT_TRUE(bench.strings->force.isZero(0));
}

TEST(DeviceHand, ADeviceThatGoesAwayInTissueEndsTheStrokeAndNotTheScene) {
  Bench bench;
  bench.strings->move = [](double time, DeviceState& state) {
    saw(time, state);
    state.is_live = time < 0.5;
    if (time > 0.5) state.position.setConstant(1e3);
  };
  app::SimulateJob job;
  job.hand = bench.hand.get();
  const auto result = run_simulate(block_scene(), job);
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_TRUE(result->report.job.change.ok);
  EXPECT_GT(result->report.job.cut.cut_tets, 0U);
  EXPECT_EQ(result->report.job.strokes, 1U);
  EXPECT_EQ(result->report.frames, 60U);
  EXPECT_TRUE(bench.strings->force.isZero(0));
}

TEST(DeviceHand, HasTheBladeOfASession) {
  auto bench = std::make_unique<Bench>();
  const std::shared_ptr<Strings> strings = bench->strings;
  strings->move = saw;
  app::SessionThreadOptions options;
  options.device = std::move(bench->hand);
  app::SessionThread session(app::Session::open(block_scene()).value(), options);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  const auto wait_for = [&](const auto& is_so) {
    while (std::chrono::steady_clock::now() < end) {
      session.take();
      if (is_so(session.view())) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  };
  ASSERT_TRUE(wait_for([](const app::SessionView& view) { return view.figures.cut.cut_tets > 2; }));
  EXPECT_FALSE(session.view().marks.lines.empty());
  {
    const std::lock_guard lock(strings->mutex);
    strings->move = [](double, DeviceState& state) { state.is_live = false; };
  }
  ASSERT_TRUE(wait_for([](const app::SessionView& view) {
    return view.notice.find("does not answer") != std::string::npos && view.figures.blade.force.isZero(0);
  }));
  const std::uint64_t frames = session.view().figures.frames;
  ASSERT_TRUE(wait_for([&](const app::SessionView& view) { return view.figures.frames > frames + 10; }));
  {
    const std::lock_guard lock(strings->mutex);
    EXPECT_TRUE(strings->force.isZero(0));
  }
}

}  // namespace

}  // namespace device_hand_test
