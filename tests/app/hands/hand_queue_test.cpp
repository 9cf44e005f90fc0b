// SPDX-License-Identifier: Apache-2.0
#include "app/hands/hand_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace incise::app::hand_queue_test {
namespace {

/// A blade that can be told from others by where it is.
BladePose at(double x) {
  return {{{x, 0, 0}, {x, 0, 1}}, Vec3::Zero()};
}

HandState down(double x) {
  HandState hands;
  hands.blade = at(x);
  return hands;
}

/// Where the blade of the next frame is; -1: there is none.
double pop(HandQueue& queue) {
  const HandState hands = queue.pop();
  return hands.blade ? hands.blade->edge[0].x() : -1;
}

TEST(HandQueue, HandsOffAtFirst) {
  HandQueue queue;
  EXPECT_EQ(pop(queue), -1);
  EXPECT_TRUE(queue.pop().hooks.empty());
}

TEST(HandQueue, TheSameAgainWhereNothingNewWasPushed) {
  HandQueue queue;
  queue.push(down(1));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(pop(queue), 1);
}

TEST(HandQueue, AStrokeBetweenTwoFramesIsSeenAsBeginEndAndOff) {
  HandQueue queue;
  for (int x = 1; x <= 9; ++x) queue.push(down(x));
  queue.push({});
  EXPECT_EQ(pop(queue), 1);
  EXPECT_EQ(pop(queue), 9);
  EXPECT_EQ(pop(queue), -1);
  EXPECT_EQ(pop(queue), -1);
}

TEST(HandQueue, AClickIsSeenAndGone) {
  HandQueue queue;
  queue.push(down(1));
  queue.push({});
  EXPECT_EQ(pop(queue), 1);
  EXPECT_EQ(pop(queue), -1);
}

TEST(HandQueue, TwoStrokesAreNeverJoined) {
  HandQueue queue;
  queue.push(down(1));
  EXPECT_EQ(pop(queue), 1);
  queue.push(down(2));
  queue.push({});
  queue.push(down(3));
  queue.push(down(4));
  queue.push(down(5));
  const std::vector<double> expected = {2, -1, 3, 5, 5};
  for (const double x : expected) EXPECT_EQ(pop(queue), x);
}

TEST(HandQueue, ASlowSimulationGetsTheNewestPlace) {
  HandQueue queue;
  queue.push(down(0));
  EXPECT_EQ(pop(queue), 0);
  for (int frame = 1; frame <= 10; ++frame) {
    for (int i = 1; i <= 20; ++i) queue.push(down(frame + 0.01 * i));
    EXPECT_EQ(pop(queue), frame + 0.01 * 20);
  }
}

/// On a circle of radius 10, `share` of its way around. The blade is 1 long.
HandState around(double share) {
  HandState hands;
  const double angle = 2 * M_PI * share;
  hands.blade = BladePose{
      {{10 * std::cos(angle), 10 * std::sin(angle), 0}, {10 * std::cos(angle), 10 * std::sin(angle), 1}}, Vec3::Zero()};
  return hands;
}

TEST(HandQueue, ACircleBetweenTwoFramesStaysACircle) {
  HandQueue queue;
  constexpr int kEvents = 200;
  for (int i = 0; i <= kEvents; ++i) queue.push(around(static_cast<double>(i) / kEvents));
  queue.push({});
  std::vector<Vec3> way;
  for (HandState hands = queue.pop(); hands.blade; hands = queue.pop()) way.push_back(hands.blade->edge[0]);
  EXPECT_TRUE(queue.is_empty());
  EXPECT_LT(way.size(), 60U);  // far fewer than there were events
  ASSERT_GT(way.size(), 10U);
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec3 middle = 0.5 * (way[i - 1] + way[i]);  // the furthest inside
    EXPECT_GT(middle.norm(), 10 - 0.06);
  }
}

TEST(HandQueue, AStrokeThatTurnsBackBetweenTwoFramesGoesAllTheWay) {
  HandQueue queue;
  for (const double x : {0.0, 1.0, 2.0, 3.0, 2.0, 1.0}) queue.push(down(x));
  queue.push({});
  const std::vector<double> expected = {0, 3, 1, -1};
  for (const double x : expected) EXPECT_EQ(pop(queue), x);
}

TEST(HandQueue, HooksPassThrough) {
  HandQueue queue;
  HandState hands = down(1);
  hands.hooks.push_back({7, Vec3::Ones(), 0.1, 50});
  queue.push(hands);
  EXPECT_EQ(queue.pop().hooks.at(0).id, 7U);
  EXPECT_EQ(queue.pop().hooks.size(), 1U);
  queue.push(down(2));
  EXPECT_TRUE(queue.pop().hooks.empty());
}

TEST(HandQueue, ClearTakesTheHandsOff) {
  HandQueue queue;
  HandState hands = down(1);
  hands.hooks.push_back({7, Vec3::Ones(), 0.1, 50});
  queue.push(hands);
  EXPECT_EQ(pop(queue), 1);
  queue.push(down(2));
  queue.clear();
  EXPECT_EQ(pop(queue), -1);
  EXPECT_TRUE(queue.pop().hooks.empty());
  queue.push(down(3));
  EXPECT_EQ(pop(queue), 3);
}

/// Where strokes begin and end.
class Strokes {
 public:
  void add(double x) {
    if (x < 0) {
      is_down_ = false;
    } else if (std::exchange(is_down_, true)) {
      ends_.back().second = x;
    } else {
      ends_.emplace_back(x, x);
    }
  }
  [[nodiscard]] const std::vector<std::pair<double, double>>& ends() const { return ends_; }

 private:
  std::vector<std::pair<double, double>> ends_;
  bool is_down_ = false;
};

TEST(HandQueue, AnySequenceKeepsItsStrokesWithTheirEnds) {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    HandQueue queue;
    Strokes pushed, popped;
    double x = 0;
    const std::uint64_t slowness = 1 + random() % 12;
    for (int event = 0; event < 200; ++event) {
      const bool is_off = random() % 4 == 0;
      queue.push(is_off ? HandState{} : down(++x));
      pushed.add(is_off ? -1 : x);
      if (random() % slowness == 0) popped.add(pop(queue));
    }
    for (int frame = 0; frame < 1000; ++frame) popped.add(pop(queue));
    ASSERT_EQ(popped.ends(), pushed.ends());
  }
}

TEST(HandQueue, IsBehindTheHandByAFewFramesPerStrokeAtMost) {
  HandQueue queue;
  for (int stroke = 0; stroke < 10; ++stroke) {
    for (int x = 1; x <= 100; ++x) queue.push(down(x));
    queue.push({});
  }
  int frames = 0;
  for (int off = 0; off < 10; ++frames) off += pop(queue) < 0 ? 1 : 0;
  EXPECT_EQ(frames, 30);
}

}  // namespace
}  // namespace incise::app::hand_queue_test
