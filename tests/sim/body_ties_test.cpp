// SPDX-License-Identifier: Apache-2.0
// Springs between two points of the tissue: what holds at rest, what is conserved in motion.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "moving_body.h"
#include "support/campaign.h"

namespace incise::test::body_ties_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kG = 9.81;

/// Two blocks of 40 × 20 × 20 mm, one above the other, 10 mm apart; the upper one is held at its top.
class TwoBlocks {
 public:
  static constexpr double kGap = 0.01;

  explicit TwoBlocks(const BodyOptions& options, double young = 30e3, bool is_held = true)
      : body_(make(options, young)) {
    mesh_.for_each_vertex([&](VertexId v) {
      if (!is_held || mesh_.rest(v).z() < 0.05 - 1e-9) return;
      EXPECT_TRUE(body_.hold(v, kInfinity).ok());
    });
  }

  [[nodiscard]] DeformableBody& body() { return body_; }
  [[nodiscard]] const TetMesh& mesh() const { return mesh_; }
  [[nodiscard]] TissuePoint at(const Vec3& rest) const {
    return find_nearest(mesh_, BodyShape::kRest, rest, 1e-9).value();
  }
  /// From a place above the gap to one below it.
  [[nodiscard]] Tie tie(const Vec3& above, const Vec3& below, double stiffness, double rest_length) const {
    return {{at(above), at(below)}, stiffness, rest_length, true};
  }
  /// Between the middles of what faces each other.
  [[nodiscard]] Tie middle_tie(double stiffness, double rest_length) const {
    return tie({0.02, 0.01, 0.03}, {0.02, 0.01, 0.02}, stiffness, rest_length);
  }
  [[nodiscard]] Vec3 place(const TissuePoint& point) const {
    Vec3 place = Vec3::Zero();
    for (unsigned i = 0; i < 4; ++i) place += point.weights[i] * body_.positions()[point.vertices[i].value];
    return place;
  }
  [[nodiscard]] double length(const Tie& tie) const { return (place(tie.ends[1]) - place(tie.ends[0])).norm(); }
  /// Of the lower block, kg.
  [[nodiscard]] double lower_mass() const {
    double mass = 0;
    mesh_.for_each_vertex([&](VertexId v) { mass += mesh_.rest(v).z() < 0.025 ? body_.mass(v) : 0.0; });
    return mass;
  }
  void advance(unsigned frames) {
    for (unsigned i = 0; i < frames; ++i) ASSERT_TRUE(body_.advance(1.0 / 60).ok());
  }

 private:
  static TetSoup soup() {
    TetSoup both = kuhn_box(Vec3::Zero(), {0.04, 0.02, 0.02}, {8, 4, 4});
    const TetSoup upper = kuhn_box({0, 0, 0.02 + kGap}, {0.04, 0.02, 0.04 + kGap}, {8, 4, 4});
    const auto first = static_cast<std::uint32_t>(both.points.size());
    both.points.insert(both.points.end(), upper.points.begin(), upper.points.end());
    for (const auto& tet : upper.tets)
      both.tets.push_back({tet[0] + first, tet[1] + first, tet[2] + first, tet[3] + first});
    return both;
  }
  DeformableBody make(const BodyOptions& options, double young) const {
    return make_body(mesh_, tissue(young, 0.45, 1000), options);
  }

  TetMesh mesh_ = TetMesh::build(soup()).value();
  DeformableBody body_;
};

BodyOptions calm(double damping = 4) {
  BodyOptions options;
  options.damping = damping;
  return options;
}

BodyOptions weightless() {
  BodyOptions options;
  options.gravity = Vec3::Zero();
  return options;
}

// --- at rest

/// The lower block hangs on the tie alone: its weight stretches it by m g / k.
void expect_hangs(const BodyOptions& options, double stiffness, double rest_length, double tolerance,
                  unsigned frames = 600) {
  TwoBlocks blocks(options);
  const Tie tie = blocks.middle_tie(stiffness, rest_length);
  ASSERT_TRUE(blocks.body().set_ties({tie}).ok());
  blocks.advance(frames);
  const double weight = blocks.lower_mass() * kG;
  EXPECT_NEAR(blocks.length(tie) - rest_length, weight / stiffness, tolerance * weight / stiffness)
      << stiffness << " N/m, " << rest_length << " m";
}

TEST(BodyTies, ABlockThatHangsOnOneStretchesItByItsWeight) {
  for (const double stiffness : {5.0, 50.0, 500.0}) {
    expect_hangs(calm(), stiffness, 0, 0.01);
    expect_hangs(calm(), stiffness, TwoBlocks::kGap, 0.01);
  }
}

/// It is not exact at few iterations.
TEST(BodyTies, SoItDoesByTheOtherMethodNearly) {
  BodyOptions options = calm();
  options.relaxation = Relaxation::kPositionBased;
  options.iterations = 10;
  expect_hangs(options, 20, TwoBlocks::kGap, 0.1, 200);
}

TEST(BodyTies, SoItDoesWhereVolumesAreAveraged) {
  BodyOptions options = calm();
  options.average_volumes = true;
  expect_hangs(options, 50, 0, 0.01);
}

TEST(BodyTies, SeveralShareALoad) {
  TwoBlocks blocks(calm());
  std::vector<Tie> ties;
  for (const double x : {0.005, 0.02, 0.035}) ties.push_back(blocks.tie({x, 0.01, 0.03}, {x, 0.01, 0.02}, 40, 0.01));
  ASSERT_TRUE(blocks.body().set_ties(ties).ok());
  blocks.advance(600);
  double force = 0;
  for (const Tie& tie : ties) force += tie.tension(blocks.length(tie));
  const double weight = blocks.lower_mass() * kG;
  EXPECT_NEAR(force, weight, 0.01 * weight);
  EXPECT_NEAR(blocks.length(ties[0]), blocks.length(ties[2]), 0.01 * weight / 120);
}

/// One end in what is held rigidly: then a tie is a pull to a fixed place, of which other tests speak.
TEST(BodyTies, OneToWhatIsRigidDoesWhatAPullDoes) {
  BodyOptions options = calm();
  options.sleep_below = 0;
  TwoBlocks tied(options), pulled(options);
  const Vec3 above{0.03, 0.012, 0.0499}, below{0.013, 0.008, 0.02};
  for (TwoBlocks* blocks : {&tied, &pulled}) {
    blocks->mesh().for_each_vertex([&](VertexId v) {
      const Vec3& p = blocks->mesh().rest(v);
      if (p.z() < 0.025 && p.x() > 1e-9) return;
      ASSERT_TRUE(blocks->body().hold(v, kInfinity).ok());
    });
  }
  const Tie tie = tied.tie(above, below, 80, 0);
  Pull pull;
  pull.vertices = tie.ends[1].vertices;
  pull.weights = tie.ends[1].weights;
  pull.target = above;
  pull.stiffness = 80;
  ASSERT_TRUE(tied.body().set_ties({tie}).ok());
  ASSERT_TRUE(pulled.body().set_pulls({pull}).ok());
  tied.advance(300);
  pulled.advance(300);
  EXPECT_GT((tied.place(tie.ends[1]) - below).norm(), 1e-3);
  EXPECT_LT((tied.place(tie.ends[1]) - pulled.place(tie.ends[1])).norm(), 1e-6);
  const BodyEnergy a = tied.body().energy(), b = pulled.body().energy();
  EXPECT_NEAR(a.tied, b.pulled, 1e-4 * b.pulled);
  EXPECT_NEAR(a.elastic, b.elastic, 1e-3 * b.elastic);
}

/// Two ends in the same tet are a spring that shortens it.
TEST(BodyTies, BothEndsMayBeInOneTet) {
  TwoBlocks blocks(weightless());
  const TetId tet(40);
  const TetVertices& v = blocks.mesh().vertices(tet);
  const Tie tie{{TissuePoint{tet, v, {0.7, 0.1, 0.1, 0.1}}, TissuePoint{tet, v, {0.1, 0.1, 0.1, 0.7}}}, 300, 0, true};
  const double before = blocks.length(tie);
  ASSERT_TRUE(blocks.body().set_ties({tie}).ok());
  blocks.advance(200);
  EXPECT_LT(blocks.length(tie), 0.95 * before);
  EXPECT_EQ(blocks.body().count_inverted(), 0U);
}

TEST(BodyTies, APlatePushesAndAThreadDoesNot) {
  for (const bool pushes : {true, false}) {
    TwoBlocks blocks(weightless());
    Tie tie = blocks.middle_tie(50, 2 * TwoBlocks::kGap);
    tie.pushes = pushes;
    ASSERT_TRUE(blocks.body().set_ties({tie}).ok());
    blocks.advance(5);
    if (pushes) {
      EXPECT_GT(blocks.length(tie), 1.2 * TwoBlocks::kGap);
    } else {
      EXPECT_NEAR(blocks.length(tie), TwoBlocks::kGap, 1e-7) << "it hangs slack";
    }
  }
}

TEST(BodyTies, LengthsAreInMetresWhateverTheUnit) {
  TetSoup soup = kuhn_box(Vec3::Zero(), {40, 20, 20}, {8, 4, 4});  // mm
  const TetMesh mesh = TetMesh::build(std::move(soup)).value();
  BodyOptions options = calm();
  options.length_unit = 0.001;
  options.gravity = Vec3::Zero();
  DeformableBody body = make_body(mesh, tissue(30e3), options);
  const auto at = [&](const Vec3& p) { return find_nearest(mesh, BodyShape::kRest, p, 1e-9).value(); };
  ASSERT_TRUE(body.set_ties({{{at({1, 10, 10}), at({39, 10, 10})}, 100, 0.03, true}}).ok());
  EXPECT_NEAR(body.energy().tied, 0.5 * 100 * 0.008 * 0.008, 1e-12);
}

// --- in motion

TEST(BodyTies, NoEnergyIsGained) {
  for (const bool pushes : {true, false}) {
    for (const double stiffness : of_campaign<std::vector<double>>({1e3}, {20.0, 1e3, 1e5})) {
      BodyOptions options;
      options.sleep_below = 0;
      TwoBlocks blocks(options);
      Tie tie = blocks.tie({0.031, 0.012, 0.03}, {0.011, 0.004, 0.02}, stiffness, 0.005);
      tie.pushes = pushes;
      ASSERT_TRUE(blocks.body().set_ties({tie}).ok());
      double before = blocks.body().energy().total();
      const double scale = blocks.body().energy().tied + 1e-3;
      for (unsigned i = 0; i < 240; ++i) {
        blocks.advance(1);
        const double now = blocks.body().energy().total();
        ASSERT_LT(now, before + 1e-5 * scale) << "frame " << i << ", " << stiffness << " N/m";
        before = now;
      }
    }
  }
}

TEST(BodyTies, MomentaOfTiedPiecesAreKept) {
  TwoBlocks blocks(weightless(), 30e3, false);
  ASSERT_TRUE(blocks.body().set_ties({blocks.tie({0.03, 0.015, 0.03}, {0.012, 0.004, 0.02}, 100, 0.002)}).ok());
  blocks.mesh().for_each_vertex([&](VertexId v) {
    const Vec3& p = blocks.mesh().rest(v);
    const Vec3 velocity = p.z() > 0.025 ? Vec3(0.1, 0.02, 0.1) : Vec3(-0.03, 0, 0.01);
    ASSERT_TRUE(blocks.body().set_velocity(v, velocity).ok());
  });
  const Vec3 momentum = blocks.body().momentum(), spin = blocks.body().angular_momentum();
  blocks.advance(60);
  EXPECT_LT((blocks.body().momentum() - momentum).norm(), 1e-6 * momentum.norm());
  EXPECT_LT((blocks.body().angular_momentum() - spin).norm(), 1e-6 * spin.norm());
}

TEST(BodyTies, TwoThreadsGiveTheSameBits) {
  for (const bool averages : {false, true}) {
    std::uint64_t hashes[2];
    for (const unsigned threads : {1U, 2U}) {
      BodyOptions options;
      options.threads = threads;
      options.average_volumes = averages;
      TwoBlocks blocks(options);
      // The sweeps' parts are the two halves along x.
      std::vector<Tie> ties = {blocks.tie({0.039, 0.012, 0.03}, {0.001, 0.004, 0.02}, 500, 0),
                               blocks.tie({0.002, 0.012, 0.035}, {0.038, 0.004, 0.012}, 500, 0.01)};
      ASSERT_TRUE(blocks.body().set_ties(ties).ok());
      blocks.advance(1);
      using Part = detail::SweepOrder::Part;
      const DeformableBody::State& s = blocks.body().state();
      for (const Tie& tie : ties) {
        bool in_first = false, in_second = false;
        for (unsigned i = 0; i < 8; ++i) {
          const std::uint32_t v = tie.ends[i / 4].vertices[i % 4].value;
          const auto is_in = [&](Part part) {
            const auto list = s.order.awake(part);
            return std::find(list.begin(), list.end(), v) != list.end();
          };
          in_first = in_first || is_in(Part::kFirst);
          in_second = in_second || is_in(Part::kSecond);
        }
        EXPECT_FALSE(in_first && in_second) << "two threads visit ends of one tie at once";
        EXPECT_TRUE(in_first || in_second) << "the seam has what the parts could have";
      }
      blocks.advance(60);
      hashes[threads - 1] = blocks.body().hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
  }
}

TEST(BodyTies, WhatHangsOnOneFallsAsleepAndFallsWhenItGoes) {
  TwoBlocks blocks(calm(8));
  const Tie tie = blocks.middle_tie(200, TwoBlocks::kGap);
  ASSERT_TRUE(blocks.body().set_ties({tie}).ok());
  blocks.advance(900);
  EXPECT_EQ(blocks.body().active_vertices(), 0U);
  ASSERT_TRUE(blocks.body().set_ties({tie}).ok());
  EXPECT_EQ(blocks.body().active_vertices(), 0U) << "what is as it was wakes nobody";
  const double before = blocks.length(tie);
  ASSERT_TRUE(blocks.body().set_ties({}).ok());
  blocks.advance(15);  // a quarter of a second: 0.31 m without damping
  EXPECT_GT(blocks.length(tie), before + 0.1);
}

TEST(BodyTies, AnEndThatMovesWakesTheOther) {
  TwoBlocks blocks(calm(8));
  const Tie tie = blocks.middle_tie(200, TwoBlocks::kGap);
  ASSERT_TRUE(blocks.body().set_ties({tie}).ok());
  blocks.advance(900);
  ASSERT_EQ(blocks.body().active_vertices(), 0U);
  const Vec3 before = blocks.place(tie.ends[1]);
  blocks.mesh().for_each_vertex([&](VertexId v) {
    if (!blocks.body().is_held(v)) return;
    ASSERT_TRUE(blocks.body().move_hold(v, blocks.body().positions()[v.value] + Vec3(0, 0, 0.005)).ok());
  });
  blocks.advance(300);
  EXPECT_NEAR((blocks.place(tie.ends[1]) - before).z(), 0.005, 2e-4);
}

// --- arguments

TEST(BodyTies, TheFirstMalformedOneIsNamed) {
  TwoBlocks blocks(calm());
  const Tie good = blocks.middle_tie(200, 0);
  ASSERT_TRUE(blocks.body().set_ties({good}).ok());
  const auto expect_bad = [&](const std::function<void(Tie&)>& change, const std::string& start) {
    Tie tie = good;
    change(tie);
    const Status status = blocks.body().set_ties({good, tie});
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::kBadArgument);
    EXPECT_EQ(status.error().message.rfind("tie 1: " + start, 0), 0U) << status.error().message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_bad([](Tie& t) { t.stiffness = -1; }, "the stiffness");
  expect_bad([](Tie& t) { t.stiffness = kInfinity; }, "the stiffness");
  expect_bad([](Tie& t) { t.rest_length = -1; }, "the rest length");
  expect_bad([&](Tie& t) { t.rest_length = nan; }, "the rest length");
  expect_bad([](Tie& t) { t.ends[1].tet = TetId(1U << 20U); }, "an end is in no tet");
  expect_bad([](Tie& t) { std::swap(t.ends[0].vertices[0], t.ends[0].vertices[1]); }, "an end is in no tet");
  expect_bad([&](Tie& t) { t.ends[0].weights[2] = nan; }, "the weights");
  expect_bad([](Tie& t) { t.ends[0].weights[2] += 0.5; }, "the weights");
  EXPECT_EQ(blocks.body().ties(), std::vector<Tie>{good});
}

/// A tie whose tet a cut has taken waits for being set anew, and does no harm.
TEST(BodyTies, OneWhoseTetIsGoneActsNoMore) {
  MovingBody moving(kuhn_cube(4), {tissue(5e3), {}}, weightless());
  const auto at = [&](const Vec3& p) { return find_nearest(moving.mesh(), BodyShape::kRest, p, 1e-9).value(); };
  const Tie tie{{at({0.45, 0.5, 0.5}), at({0.9, 0.5, 0.5})}, 100, 0.1, true};
  ASSERT_TRUE(moving.body().set_ties({tie}).ok());
  moving.cut_plane(Vec3::UnitX(), 0.4);
  ASSERT_FALSE(tie.ends[0].holds(moving.mesh()));
  EXPECT_EQ(moving.body().energy().tied, 0);
  moving.advance(10);
  EXPECT_TRUE(moving.body().is_finite());
}

}  // namespace
}  // namespace incise::test::body_ties_test
