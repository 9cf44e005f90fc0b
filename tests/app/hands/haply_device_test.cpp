// SPDX-License-Identifier: Apache-2.0
#include "app/hands/haply_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <thread>
#include <vector>

#include "app/hands/fake_haply.h"
#include "app/hands/haptic_loop.h"

namespace haply_device_test {
namespace {

using namespace incise;
using app::HaplyDevice;
using app::HaplyOptions;
using test::FakeHaply;
using Fault = FakeHaply::Fault;

constexpr double kLongEnough = 20;  // s, for what takes a fraction of one
const Vec3 kPush(0, 1.5, 0);        // N

HaplyOptions at(const FakeHaply& service) {
  HaplyOptions options;
  options.host = "127.0.0.1";
  options.port = service.port();
  options.retry = 0.05;
  return options;
}

Vec3 rest(double /*time*/) {
  return {0.01, 0.02, 0.03};
}

/// A service with a hand at rest, and the device of it.
struct Desk {
  FakeHaply service{rest};
  std::unique_ptr<HaplyDevice> device;
  DeviceState state;

  void open() {
    auto opened = HaplyDevice::open(at(service));
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    device = std::move(opened).value();
  }
  /// Commands a force over and over until something is so. False where it never is.
  bool push_until(const std::function<bool()>& is_so, const Vec3& force = kPush) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kLongEnough);
    while (std::chrono::steady_clock::now() < end) {
      state = device->read(0);
      device->command(force);
      if (is_so()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  /// Whether no force comes to the arm while it is pushed on for a time: one force that is zero may be chance.
  bool stays_free() {
    service.forget_strongest();
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
    return push_until([&] { return std::chrono::steady_clock::now() > until; }) && service.strongest() == 0;
  }
  [[nodiscard]] bool pushes() const { return service.force().isApprox(kPush); }
  [[nodiscard]] bool is_free() const { return service.force().isZero(0); }
};

TEST(HaplyDevice, TellsWhereTheHandIsAndPushesIt) {
  Desk desk;
  ASSERT_NO_FATAL_FAILURE(desk.open());
  EXPECT_FALSE(desk.device->read(0).is_live);  // not at once
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes(); }));
  EXPECT_TRUE(desk.state.is_live);
  // The hand gives way to the force: 1.5 N against 150 N/m.
  ASSERT_TRUE(desk.push_until([&] { return desk.state.position.y() > 0.028; }));
  EXPECT_NEAR(desk.state.position.x(), 0.01, 1e-3);
  EXPECT_LE(desk.service.strongest(), kPush.norm() + 1e-12);
  const app::HaplyStatistics statistics = desk.device->statistics();
  EXPECT_TRUE(statistics.is_connected);
  EXPECT_GT(statistics.exchanges, 100U);
  EXPECT_EQ(statistics.bad, 0U);
  EXPECT_EQ(statistics.connections, 1U);
}

/// What a fault does: no force at the arm and no live device, until it is over; then the force comes back by itself.
void expect_survives(Fault fault) {
  Desk desk;
  ASSERT_NO_FATAL_FAILURE(desk.open());
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes(); }));
  desk.service.set_fault(fault);
  ASSERT_TRUE(desk.push_until([&] { return desk.is_free() && !desk.state.is_live; }));
  if (fault != Fault::kClose && fault != Fault::kDrop) {  // which are over by now
    ASSERT_TRUE(desk.stays_free());
  }
  desk.service.set_fault(Fault::kNone);
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes() && desk.state.is_live; }));
}

TEST(HaplyDevice, JsonThatIsCutOffTakesTheForceAway) {
  expect_survives(Fault::kBadJson);
}
TEST(HaplyDevice, AnArmThatIsUnpluggedTakesTheForceAway) {
  expect_survives(Fault::kNoArm);
}
TEST(HaplyDevice, AnArmThatComesBackByAnotherIdIsTaken) {
  Desk desk;
  ASSERT_NO_FATAL_FAILURE(desk.open());
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes(); }));
  desk.service.set_id("\"0479\"");
  ASSERT_TRUE(desk.push_until([&] { return !desk.state.is_live; }));
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes() && desk.state.is_live; }));
  EXPECT_EQ(desk.device->statistics().connections, 2U);
}
TEST(HaplyDevice, AnArmThatHasANumberIsCalledByIt) {
  Desk desk;
  desk.service.set_id("478");
  ASSERT_NO_FATAL_FAILURE(desk.open());
  EXPECT_TRUE(desk.push_until([&] { return desk.pushes(); }));
}
TEST(HaplyDevice, SilenceTakesTheForceAway) {
  expect_survives(Fault::kSilence);
}
TEST(HaplyDevice, ASilentServiceHearsThatTheForceIsZero) {
  Desk desk;
  ASSERT_NO_FATAL_FAILURE(desk.open());
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes(); }));
  desk.service.set_fault(Fault::kSilence);
  // In the same connection: the arm would go on pushing.
  ASSERT_TRUE(desk.push_until([&] { return desk.is_free(); }));
  EXPECT_TRUE(desk.stays_free());
  EXPECT_EQ(desk.service.sessions(), 1U);
  EXPECT_TRUE(desk.service.is_connected());
  EXPECT_EQ(desk.device->statistics().silences, 1U);
}
TEST(HaplyDevice, AConnectionThatIsClosedIsMadeAgain) {
  expect_survives(Fault::kClose);
}
TEST(HaplyDevice, AConnectionThatBreaksOffIsMadeAgain) {
  expect_survives(Fault::kDrop);
}

TEST(HaplyDevice, ASpeedThatNoHandHasTakesTheForceAway) {
  expect_survives(Fault::kSpeed);
}
TEST(HaplyDevice, AServiceThatDoesNotListenIsLeft) {
  expect_survives(Fault::kDeaf);
}
TEST(HaplyDevice, AMessageWithoutAnEndTakesTheForceAway) {
  expect_survives(Fault::kHuge);
}
TEST(HaplyDevice, BytesThatAreNoTextTakeTheForceAway) {
  expect_survives(Fault::kNoText);
}
TEST(HaplyDevice, JsonWithoutABottomTakesTheForceAway) {
  expect_survives(Fault::kDeep);
}

TEST(HaplyDevice, FramesThatAreCutInTwoAreWhole) {
  Desk desk;
  desk.service.set_fault(Fault::kFragments);
  ASSERT_NO_FATAL_FAILURE(desk.open());
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes(); }));
  const std::uint64_t exchanges = desk.device->statistics().exchanges;
  ASSERT_TRUE(desk.push_until([&] { return desk.device->statistics().exchanges > exchanges + 200; }));
  EXPECT_EQ(desk.device->statistics().bad, 0U);
  EXPECT_EQ(desk.device->statistics().connections, 1U);
}

TEST(HaplyDevice, AJumpOfTheHandTakesTheForceAway) {
  Desk desk;
  ASSERT_NO_FATAL_FAILURE(desk.open());
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes(); }));
  const double before = desk.state.position.y();
  desk.service.jump(0.3);
  ASSERT_TRUE(desk.push_until([&] { return desk.is_free() && !desk.state.is_live; }));
  EXPECT_EQ(desk.device->statistics().jumps, 1U);
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes(); }));
  EXPECT_NE(desk.state.position.y(), before);
}

TEST(HaplyDevice, AForceThatNobodyRenewsEnds) {
  Desk desk;
  ASSERT_NO_FATAL_FAILURE(desk.open());
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes(); }));
  // Whoever computes forces hangs.
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kLongEnough);
  while (!desk.is_free() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_TRUE(desk.is_free());
  EXPECT_TRUE(desk.push_until([&] { return desk.pushes(); }));
}

TEST(HaplyDevice, ForcesAreShortenedAndNumbers) {
  Desk desk;
  ASSERT_NO_FATAL_FAILURE(desk.open());
  ASSERT_TRUE(desk.push_until([&] { return std::abs(desk.service.force().norm() - 3.3) < 1e-9; }, Vec3(0, 0, 50)));
  EXPECT_LE(desk.service.strongest(), 3.3 + 1e-9);
  ASSERT_TRUE(desk.push_until([&] { return desk.is_free(); }, Vec3(0, 0, std::nan(""))));
}

TEST(HaplyDevice, LeavesWithoutAForce) {
  Desk desk;
  ASSERT_NO_FATAL_FAILURE(desk.open());
  ASSERT_TRUE(desk.push_until([&] { return desk.pushes(); }));
  desk.device.reset();
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kLongEnough);
  while (desk.service.is_connected() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_FALSE(desk.service.is_connected());
  EXPECT_TRUE(desk.service.parting_force().isZero(0));
}

TEST(HaplyDevice, SaysWhereThereIsNoServiceOrNoArm) {
  HaplyOptions options;
  {
    FakeHaply service(rest);
    options = at(service);
    options.timeout = 0.3;
    service.set_fault(Fault::kNoArm);
    const auto opened = HaplyDevice::open(options);
    ASSERT_FALSE(opened.ok());
    EXPECT_NE(opened.error().message.find("no Inverse3"), std::string::npos) << opened.error().message;
  }
  const auto opened = HaplyDevice::open(options);
  ASSERT_FALSE(opened.ok());
  EXPECT_NE(opened.error().message.find("start Haply's Inverse Service"), std::string::npos) << opened.error().message;
}

TEST(HaplyDevice, AddressesAreHostsAndPorts) {
  const auto read = [](const char* text) {
    HaplyOptions options;
    const Status status = app::parse_haply_address(text, options);
    return status.ok() ? options.host + " " + std::to_string(options.port) : "bad";
  };
  EXPECT_EQ(read("arm.example"), "arm.example 10001");
  EXPECT_EQ(read("arm.example:99"), "arm.example 99");
  EXPECT_EQ(read(":99"), "localhost 99");
  EXPECT_EQ(read("[::1]:99"), "::1 99");
  EXPECT_EQ(read("[::1]"), "::1 10001");
  for (const char* bad : {":", ":0", ":65536", "a:b", "a:9x", "[::1", "[]", "[::1]9", "::1"})
    EXPECT_EQ(read(bad), "bad") << bad;
}

TEST(HaplyDevice, BadOptionsAreNamed) {
  HaplyOptions options;
  options.max_force = 30;
  EXPECT_NE(HaplyDevice::open(options).error().message.find("force"), std::string::npos);
  options = {};
  options.rate = 0;
  EXPECT_NE(check(options).error().message.find("exchanges"), std::string::npos);
  options = {};
  options.guard.silence = 0;
  EXPECT_NE(check(options).error().message.find("silence"), std::string::npos);
}

/// What is measured is the machine's as well, and is printed, not judged.
TEST(HaplyDevice, KeepsThePaceWhileAHandPressesOnTissue) {
  constexpr double kSeconds = 10;
  FakeHaply service([](double time) { return Vec3(0, 0.02 - 0.03 * (1 - std::cos(3 * time)) / 2, 0); });
  auto device = HaplyDevice::open(at(service));
  ASSERT_TRUE(device.ok()) << device.error().message;
  app::HapticLoop loop(**device);
  ASSERT_TRUE(loop.start().ok());
  const std::uint64_t before = (*device)->statistics().exchanges;
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t serial = 0;
  double seconds = 0;
  while (seconds < kSeconds) {
    // Soft tissue below y = 0, as a physics at 60 Hz tells it.
    std::this_thread::sleep_for(std::chrono::microseconds(16667));
    loop.take_tool_state();
    const Vec3 tool = loop.tool_state().tool_position;
    HapticSnapshot snapshot;
    snapshot.serial = ++serial;
    snapshot.touches = tool.y() < 0;
    snapshot.tool_position = tool;
    snapshot.force = Vec3(0, std::max(0.0, -200 * tool.y()), 0);
    snapshot.compliance = Eigen::Vector3d(1e-1, 1.0 / 200, 1e-1).asDiagonal();
    snapshot.cutting_direction = -Vec3::UnitY();
    snapshot.engaged_length = 0.02;
    snapshot.toughness = 200;
    loop.publish(snapshot);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  const auto exchanges = static_cast<double>((*device)->statistics().exchanges - before);
  loop.stop();
  std::vector<double> gaps = service.gaps();
  std::sort(gaps.begin(), gaps.end());
  const auto at_share = [&](double share) { return gaps[static_cast<std::size_t>(share * double(gaps.size() - 1))]; };
  std::printf("haply: %.0f exchanges in %.2f s, %.2f %% of 1 kHz; gaps p50 %.0f, p99 %.0f, max %.0f us; peak %.2f N\n",
              exchanges, seconds, 100 * exchanges / (1000 * seconds), at_share(0.5), at_share(0.99), gaps.back(),
              service.strongest());
  EXPECT_GT(exchanges, 0);
  EXPECT_GT(service.strongest(), 0.2);
  EXPECT_LE(service.strongest(), 3.3 + 1e-9);
  EXPECT_EQ((*device)->statistics().connections, 1U);
}

}  // namespace

}  // namespace haply_device_test
