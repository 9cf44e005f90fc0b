// SPDX-License-Identifier: Apache-2.0
// Sutures of a simulation: they follow the material through cuts, undo and redo, and tear.
#include "engine/sutures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "incise/engine/simulation.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/validate.h"
#include "support/random.h"
#include "support/random_strokes.h"

namespace incise::sutures_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kG = 9.81;

/// A bar of 60 × 20 × 20 mm that hangs from its top, along z; a blade goes across it at the middle.
class Bar {
 public:
  explicit Bar(unsigned threads = 1, const Vec3& gravity = {0, 0, -kG}) {
    SimulationOptions options;
    options.body.gravity = gravity;
    options.body.damping = 3;
    options.body.threads = options.engine.threads = threads;
    options.materials.fallback.young = 30e3;
    Result<TetMesh> mesh = TetMesh::build(kuhn_box(Vec3::Zero(), {0.02, 0.02, 0.06}, {4, 4, 12}));
    simulation_.emplace(Simulation::create(std::move(mesh).value(), options).value());
    sim().mesh().for_each_vertex([&](VertexId v) {
      if (sim().mesh().rest(v).z() < 0.06 - 1e-9) return;
      EXPECT_TRUE(sim().body().hold(v, kInfinity).ok());
    });
  }

  [[nodiscard]] Simulation& sim() { return *simulation_; }
  FrameReport frame(const FrameInput& input = {}) {
    const Result<FrameReport> report = sim().frame(input);
    EXPECT_TRUE(report.ok()) << report.error().message;
    return report.ok() ? *report : FrameReport{};
  }
  void frames(unsigned count) {
    for (unsigned i = 0; i < count; ++i) frame();
  }
  /// Across the bar at a height, along x, from `from` to `to`.
  void cut(double z, double from = -0.002, double to = 0.022) {
    for (unsigned i = 0; i <= 12; ++i) {
      const double x = from + (to - from) * i / 12;
      FrameInput input;
      input.blade = BladePose{{{x, -0.002, z}, {x, 0.022, z}}, Vec3::Zero()};
      frame(input);
    }
    frame();
  }
  std::uint32_t suture(double x, double y, double high, double low, const Suture& suture) {
    const auto id = sim().add_suture({Vec3(x, y, high), Vec3(x, y, low)}, suture);
    EXPECT_TRUE(id.ok()) << id.error().message;
    return id.ok() ? *id : 0;
  }
  /// Of what lies below a height at rest, kg.
  [[nodiscard]] double mass_below(double z) {
    double mass = 0;
    sim().mesh().for_each_tet([&](TetId t) {
      const TetVertices& v = sim().mesh().vertices(t);
      const Vec3 &a = sim().mesh().rest(v[0]), &b = sim().mesh().rest(v[1]), &c = sim().mesh().rest(v[2]),
                 &d = sim().mesh().rest(v[3]);
      if ((a + b + c + d).z() < 4 * z) mass += 1000 * std::abs((b - a).cross(c - a).dot(d - a)) / 6;
    });
    return mass;
  }
  /// What must hold of sutures that are neither torn nor lost.
  void expect_ends_hold(double tolerance = 1e-9) {  // m; maintenance smooths skin
    for (const SutureState& state : sim().sutures()) {
      for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_TRUE(state.ends[i].holds(sim().mesh()));
        EXPECT_LT((state.ends[i].place(sim().mesh(), BodyShape::kRest) - state.rest[i]).norm(), tolerance);
        for (const double weight : state.ends[i].weights) EXPECT_GE(weight, -1e-9);
      }
    }
  }

 private:
  std::optional<Simulation> simulation_;
};

std::vector<std::array<TissuePoint, 2>> ends_of(const Simulation& simulation) {
  std::vector<std::array<TissuePoint, 2>> ends;
  for (const SutureState& state : simulation.sutures()) ends.push_back(state.ends);
  return ends;
}

void add_three(Bar& bar, const Suture& suture) {
  bar.suture(0.004, 0.0101, 0.0371, 0.0231, suture);
  bar.suture(0.0101, 0.0042, 0.0371, 0.0231, suture);
  bar.suture(0.0157, 0.0151, 0.0371, 0.0231, suture);
}

TEST(Sutures, TheyHoldWhatIsCutOff) {
  Bar bar;
  const Suture suture{200, 0.014, true, kInfinity, 0};
  add_three(bar, suture);
  bar.cut(0.0302);
  ASSERT_EQ(find_components(bar.sim().mesh()).count(), 2U);
  bar.expect_ends_hold();
  bar.frames(400);
  const double weight = kG * bar.mass_below(0.0302);
  double force = 0;
  for (const SutureState& state : bar.sim().sutures()) {
    EXPECT_EQ(state.status, SutureStatus::kHolds);
    EXPECT_NEAR(state.force, 200 * (state.length - 0.014), 1e-9);
    force += state.force;
  }
  EXPECT_NEAR(force, weight, 0.01 * weight);
}

TEST(Sutures, WithoutThemItFalls) {
  Bar bar;
  bar.cut(0.0302);
  bar.frames(60);
  const auto below = find_nearest(bar.sim().mesh(), BodyShape::kRest, {0.01, 0.01, 0.01}, 1e-9);
  EXPECT_LT(below->place(bar.sim().mesh()).z(), -0.1);
}

/// The blade goes through the tets that the ends are in, again and again.
TEST(Sutures, TheirEndsStayWithTheMaterialThroughCuts) {
  Bar bar(1, Vec3::Zero());
  add_three(bar, {200, 0.014, true, kInfinity, 0});
  const auto before = ends_of(bar.sim());
  for (const double z : {0.0302, 0.0367, 0.0236, 0.0226, 0.0377}) {
    bar.cut(z, -0.002, z > 0.03 ? 0.022 : 0.018);
    bar.expect_ends_hold();
    EXPECT_TRUE(validate(bar.sim().mesh(), ValidateLevel::kGeometry).ok);
  }
  unsigned changed = 0;
  const auto after = ends_of(bar.sim());
  for (std::size_t i = 0; i < 3; ++i) changed += before[i][0] != after[i][0] && before[i][1] != after[i][1] ? 1U : 0U;
  EXPECT_EQ(changed, 3U) << "the cuts are to go through the tets of the ends";
  bar.frames(60);
  EXPECT_TRUE(bar.sim().body().is_finite());
  bar.expect_ends_hold();
}

TEST(Sutures, UndoAndRedoGiveTheSameState) {
  Bar bar(1, Vec3::Zero());
  add_three(bar, {200, 0.01, true, kInfinity, 0});
  const auto uncut = ends_of(bar.sim());
  bar.cut(0.0367);
  const auto cut = ends_of(bar.sim());
  ASSERT_FALSE(cut == uncut);
  for (unsigned round = 0; round < 3; ++round) {
    ASSERT_TRUE(bar.sim().undo());
    EXPECT_TRUE(ends_of(bar.sim()) == uncut);
    EXPECT_EQ(bar.sim().body().ties().size(), 3U);
    EXPECT_GT(bar.sim().body().energy().tied, 0);
    bar.frames(3);
    ASSERT_TRUE(bar.sim().redo());
    EXPECT_TRUE(ends_of(bar.sim()) == cut);
    EXPECT_GT(bar.sim().body().energy().tied, 0);
    bar.frames(3);
  }
  for (const SutureState& state : bar.sim().sutures()) EXPECT_EQ(state.status, SutureStatus::kHolds);
}

TEST(Sutures, TwoThreadsGiveTheSameBits) {
  std::uint64_t hashes[2];
  for (const unsigned threads : {1U, 2U}) {
    Bar bar(threads);
    add_three(bar, {300, 0.002, true, 0.2, 0});
    bar.cut(0.0302);
    bar.cut(0.0236);
    bar.frames(40);
    hashes[threads - 1] = bar.sim().hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

/// Random strokes through a body that sutures bend, undo and redo in between.
TEST(Sutures, NoneIsLostWhateverIsDone) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    test::Random random(seed);
    Bar bar;
    const Box box = rest_bounds(bar.sim().mesh());
    for (unsigned i = 0; i < 5; ++i) {
      const auto place = [&] {
        return Vec3(random.real(0, 0.02), random.real(0, 0.02), i % 2 == 0 ? 0.0 : random.real(0, 0.06));
      };
      const std::array<Vec3, 2> places = {place(), place()};
      const double rest_length = 0.8 * (places[1] - places[0]).norm();
      ASSERT_TRUE(bar.sim().add_suture(places, {100, rest_length, i % 3 == 0, kInfinity, 0}).ok());
    }
    for (unsigned round = 0; round < 3; ++round) {
      const Stroke stroke = test::random_stroke(random, box);
      for (const auto& edge : stroke.edges) {
        FrameInput input;
        input.blade = BladePose{edge, Vec3::Zero()};
        bar.frame(input);
        bar.expect_ends_hold(1e-3);
      }
      bar.frames(3);
      if (random.integer(0, 1) == 0) {
        EXPECT_TRUE(bar.sim().undo());
        bar.expect_ends_hold(1e-3);
        if (random.integer(0, 1) == 0) {
          EXPECT_TRUE(bar.sim().redo());
        }
      }
      bar.frames(3);
      bar.expect_ends_hold(1e-3);
    }
    ASSERT_EQ(bar.sim().body().ties().size(), 5U);
    EXPECT_TRUE(bar.sim().body().is_finite());
  }
}

TEST(Sutures, OneTearsAtItsStrengthAndTheNextFollow) {
  Bar bar;
  const double weight = kG * bar.mass_below(0.03);
  for (const double y : {0.005, 0.01, 0.015}) bar.suture(0.01, y, 0.034, 0.026, {300, 0.008, true, 0.9 * weight, 0});
  bar.cut(0.03);
  bar.frames(240);
  for (const SutureState& state : bar.sim().sutures()) ASSERT_EQ(state.status, SutureStatus::kHolds);
  ASSERT_TRUE(bar.sim().remove_suture(0).ok());
  bar.frames(240);
  for (const SutureState& state : bar.sim().sutures()) ASSERT_EQ(state.status, SutureStatus::kHolds);
  ASSERT_TRUE(bar.sim().remove_suture(2).ok());
  ASSERT_EQ(bar.sim().sutures().size(), 1U);
  std::vector<std::uint32_t> torn;
  double greatest = 0;
  for (unsigned i = 0; i < 240 && torn.empty(); ++i) {
    greatest = std::max(greatest, bar.sim().sutures()[0].force);
    torn = bar.frame().torn_sutures;
  }
  EXPECT_EQ(torn, std::vector<std::uint32_t>{1});
  EXPECT_LE(greatest, 0.9 * weight);
  EXPECT_GT(greatest, 0.5 * weight);
  EXPECT_EQ(bar.sim().sutures()[0].status, SutureStatus::kTorn);
  EXPECT_EQ(bar.sim().sutures()[0].force, 0);
  EXPECT_TRUE(bar.sim().body().ties().empty());
  EXPECT_TRUE(bar.frame().torn_sutures.empty());
  ASSERT_TRUE(bar.sim().undo());
  bar.frames(5);
  EXPECT_EQ(bar.sim().sutures()[0].status, SutureStatus::kTorn) << "undo takes cuts back, not what tore";
}

TEST(Sutures, OneWaitsForItsFirstFrame) {
  Bar bar(1, Vec3::Zero());
  bar.suture(0.01, 0.01, 0.04, 0.02, {100, 0, true, kInfinity, 5});
  for (unsigned i = 0; i < 5; ++i) {
    EXPECT_EQ(bar.sim().sutures()[0].status, SutureStatus::kWaits);
    bar.frame();
    EXPECT_EQ(bar.sim().sutures()[0].force, 0);
    EXPECT_NEAR(bar.sim().sutures()[0].length, 0.02, 1e-6);
  }
  bar.frame();
  EXPECT_EQ(bar.sim().sutures()[0].status, SutureStatus::kHolds);
  EXPECT_LT(bar.sim().sutures()[0].length, 0.0199);
  EXPECT_GT(bar.sim().sutures()[0].force, 1);
}

/// Of a simulation no tissue goes away as yet; of the mesh that a place is looked up in it may.
TEST(Sutures, OneIsLostWhileItsTissueIsGone) {
  const TetMesh whole = TetMesh::build(kuhn_box(Vec3::Zero(), {1, 1, 2}, {2, 2, 4})).value();
  const TetMesh half = TetMesh::build(kuhn_box(Vec3::Zero(), {1, 1, 1}, {2, 2, 2})).value();
  detail::Sutures sutures(0.1, 1);
  ASSERT_TRUE(sutures.add(whole, {Vec3(0.3, 0.3, 0.4), Vec3(0.3, 0.3, 1.7)}, {}).ok());
  sutures.begin_frame(0);
  ASSERT_EQ(sutures.ties().size(), 1U);
  const std::vector<Tie> before = sutures.ties();
  sutures.follow(half);
  EXPECT_EQ(sutures.states(half)[0].status, SutureStatus::kLost);
  EXPECT_TRUE(sutures.ties().empty());
  sutures.follow(whole);
  EXPECT_EQ(sutures.states(whole)[0].status, SutureStatus::kHolds);
  EXPECT_EQ(sutures.ties(), before);
}

TEST(Sutures, WhatMakesNoneIsRefused) {
  Bar bar;
  const auto expect_bad = [&](const Result<std::uint32_t>& result, const std::string& part) {
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::kBadArgument);
    EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
  };
  const std::array<Vec3, 2> places = {Vec3(0.01, 0.01, 0.04), Vec3(0.01, 0.01, 0.02)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Simulation& sim = bar.sim();
  expect_bad(sim.add_suture(places, {0, 0, true, kInfinity, 0}), "stiffness must be above 0");
  expect_bad(sim.add_suture(places, {kInfinity, 0, true, kInfinity, 0}), "stiffness must be above 0");
  expect_bad(sim.add_suture(places, {1, -1, true, kInfinity, 0}), "rest length must be at least 0");
  expect_bad(sim.add_suture(places, {1, 0, true, 0, 0}), "strength must be above 0");
  expect_bad(sim.add_suture(places, {1, 0, true, nan, 0}), "strength must be above 0");
  expect_bad(sim.add_suture({places[0], Vec3(0.01, 0.01, -0.02)}, {}),
             "end 1 of a suture is at (0.01, 0.01, -0.02), where there is no tissue at rest; the nearest is at (0.01, "
             "0.01, 0)");
  expect_bad(sim.add_suture({places[0], Vec3(nan, 0, 0)}, {}), "end 1 of a suture is not finite");
  const TissuePoint good = find_nearest(sim.mesh(), BodyShape::kRest, places[0], 1e-9).value();
  TissuePoint other = good;
  std::swap(other.vertices[0], other.vertices[1]);
  expect_bad(sim.add_suture({good, other}, {}), "end 1 of a suture: its tet");
  other = good;
  other.weights = {0.5, 0.5, 0.5, -0.5};
  expect_bad(sim.add_suture({other, good}, {}), "end 0 of a suture: its weights");
  EXPECT_TRUE(sim.sutures().empty());
  const Status removed = sim.remove_suture(7);
  ASSERT_FALSE(removed.ok());
  EXPECT_EQ(removed.error().message, "there is no suture 7");
}

TEST(Sutures, APlaceJustOutsideIsTakenToTheSurface) {
  Bar bar;
  const auto id = bar.sim().add_suture({Vec3(0.01, -0.0005, 0.04), Vec3(0.01, -0.0005, 0.02)}, {});
  ASSERT_TRUE(id.ok());
  for (const Vec3& rest : bar.sim().sutures()[0].rest) EXPECT_NEAR(rest.y(), 0, 1e-12);
}

TEST(Sutures, TheyAreOfTheHash) {
  Bar bar, other;
  EXPECT_EQ(bar.sim().hash(), other.sim().hash());
  bar.suture(0.01, 0.01, 0.04, 0.02, {});
  EXPECT_NE(bar.sim().hash(), other.sim().hash());
}

}  // namespace
}  // namespace incise::sutures_test
