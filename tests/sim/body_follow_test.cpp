// SPDX-License-Identifier: Apache-2.0
// What the deformable body makes of the journal: the same data as a body made anew, with mass and momentum kept.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "incise/mesh/star.h"
#include "moving_body.h"
#include "support/campaign.h"

namespace incise::test::body_follow_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TetSoup two_regions(std::uint32_t n, std::uint64_t seed) {
  TetSoup soup = jittered_cube(n, seed);
  soup.regions.clear();
  for (const auto& tet : soup.tets) {
    double x = 0;
    for (const std::uint32_t v : tet) x += soup.points[v].x();
    soup.regions.push_back(x < 2 ? 1 : 2);
  }
  return soup;
}

Materials heavy_and_light() {
  Materials materials{tissue(2e3), {}};
  materials.by_region = {{1, tissue(2e3, 0.4, 500)}, {2, tissue(8e3, 0.3, 2000)}};
  return materials;
}

BodyOptions weightless() {
  BodyOptions options;
  options.gravity = Vec3::Zero();
  return options;
}

/// Gives all vertices velocities of about 1 m/s that change over the body.
void stir(MovingBody& moving) {
  moving.mesh().for_each_vertex([&](VertexId v) {
    const Vec3& x = moving.mesh().rest(v);
    const Vec3 velocity(0.3 + x.y() - x.z(), x.x() * x.y() - 0.2, 0.5 - x.x());
    ASSERT_TRUE(moving.body().set_velocity(v, velocity).ok());
  });
}

/// How much of the mass is in motion: what rounding errors of the momentum are measured by.
double momentum_scale(MovingBody& moving) {
  double sum = 0;
  moving.mesh().for_each_vertex([&](VertexId v) { sum += moving.body().mass(v) * moving.body().velocity(v).norm(); });
  return sum;
}

/// Mass and momentum before and after every call of the engine.
class Balance {
 public:
  explicit Balance(MovingBody& moving) : moving_(moving), mass_(moving.body().mass()) {}
  void check() {
    const DeformableBody& body = moving_.body();
    ASSERT_NEAR(body.mass(), mass_, 1e-12 * mass_);
    const Vec3 off = body.momentum() - expected_momentum();
    worst = std::max(worst, off.norm() / momentum_scale(moving_));
    ASSERT_LT(off.norm(), 1e-12 * momentum_scale(moving_)) << "momentum";
    double lightest = kInfinity;
    moving_.mesh().for_each_vertex([&](VertexId v) { lightest = std::min(lightest, body.mass(v)); });
    ASSERT_GT(lightest, 0);
  }
  /// Nothing but gravity acts: the body's own motion keeps the momentum too, to rounding of its own.
  [[nodiscard]] Vec3 expected_momentum() const { return momentum_; }
  void note() { momentum_ = moving_.body().momentum(); }

  double worst = 0;

 private:
  MovingBody& moving_;
  double mass_;
  Vec3 momentum_ = Vec3::Zero();
};

void expect_kept(TetSoup soup, const Materials& materials, std::uint64_t seed, unsigned calls) {
  SCOPED_TRACE(seed);
  MovingBody moving(std::move(soup), materials, weightless());
  stir(moving);
  moving.advance(5);
  RandomCalls program(moving, seed);
  Balance balance(moving);
  balance.note();
  program.run(calls, [&] { balance.check(); });
  testing::Test::RecordProperty("momentum " + std::to_string(seed), std::to_string(balance.worst));
}

TEST(BodyFollow, MassAndMomentumAreKeptThroughCutsMaintenanceAndUndo) {
  for (std::uint64_t seed = 1; seed <= of_campaign(2U, 6U); ++seed)
    expect_kept(jittered_cube(4, seed), {tissue(5e3), {}}, seed, 25);
}

TEST(BodyFollow, MassAndMomentumAreKeptWithRegionsOfOtherDensity) {
  for (std::uint64_t seed = 11; seed <= of_campaign(12U, 14U); ++seed)
    expect_kept(two_regions(4, seed), heavy_and_light(), seed, 25);
}

void expect_same_as_fresh(TetSoup soup, const Materials& materials, std::uint64_t seed) {
  SCOPED_TRACE(seed);
  MovingBody moving(std::move(soup), materials, weightless());
  stir(moving);
  moving.advance(3);
  RandomCalls program(moving, seed);
  program.run(25, [&] { moving.expect_like_fresh(); });
  EXPECT_GT(program.undone, 0U);
}

TEST(BodyFollow, DataAreThoseOfABodyMadeAnew) {
  for (std::uint64_t seed = 1; seed <= of_campaign(2U, 6U); ++seed) {
    expect_same_as_fresh(jittered_cube(4, seed), {tissue(5e3), {}}, seed);
  }
}

TEST(BodyFollow, DataOfABodyWithRegionsAreThoseOfOneMadeAnew) {
  for (std::uint64_t seed = 11; seed <= of_campaign(12U, 14U); ++seed) {
    expect_same_as_fresh(two_regions(4, seed), heavy_and_light(), seed);
  }
}

TEST(BodyFollow, SweepsVisitEachVertexOnceAndKeepTheTwoPartsApart) {
  for (std::uint64_t seed = 21; seed <= of_campaign(22U, 24U); ++seed) {
    SCOPED_TRACE(seed);
    BodyOptions options = weightless();
    options.sleep_below = 1e-3;
    MovingBody moving(jittered_cube(4, seed), {tissue(5e3), {}}, options);
    stir(moving);
    RandomCalls program(moving, seed);
    program.run(25, [&] {
      moving.advance();  // it brings the lists up to date
      DeformableBody::State& state = const_cast<DeformableBody::State&>(moving.state());
      state.order.refresh();
      expect_sound_order(state);
    });
  }
}

/// Maintenance may bend walls, and the mass stays; cuts alone leave every vertex a quarter of its tets.
TEST(BodyFollow, MassesAreThoseOfABodyMadeAnewWhereNothingIsMaintained) {
  EngineOptions options;
  options.maintain.merge = options.maintain.improve = false;
  for (std::uint64_t seed = 1; seed <= of_campaign(2U, 4U); ++seed) {
    SCOPED_TRACE(seed);
    MovingBody moving(jittered_cube(4, seed), {tissue(5e3), {}}, weightless(), options);
    stir(moving);
    Random random(seed);
    const Box box = rest_bounds(moving.mesh());
    for (int i = 0; i < 12 && !testing::Test::HasFatalFailure(); ++i) {
      if (i % 4 == 3) {
        ASSERT_TRUE(moving.engine().undo());
        moving.follow();
      } else {
        moving.cut(random_stroke(random, box));
      }
      moving.expect_masses_of_fresh(1e-9);
      moving.advance();
    }
  }
}

// --- holds

TEST(BodyFollow, VerticesBornBetweenHeldOnesAreHeld) {
  MovingBody moving(kuhn_cube(4), {tissue(5e3), {}});
  moving.hold_where(0);
  moving.advance(10);
  moving.cut_plane(Vec3(0, 0, 1), 0.45);
  unsigned held = 0;
  moving.mesh().for_each_vertex([&](VertexId v) {
    const bool is_at_wall = std::abs(moving.mesh().rest(v).x()) < 1e-9;
    ASSERT_EQ(moving.body().is_held(v), is_at_wall) << v.value;
    held += is_at_wall ? 1U : 0U;
    if (is_at_wall) {
      ASSERT_LT((moving.body().positions()[v.value] - moving.mesh().rest(v)).norm(), 1e-12);
    }
  });
  EXPECT_GT(held, 25U);  // those of the lattice, and the two sides of the cut
  moving.advance(10);
  moving.mesh().for_each_vertex([&](VertexId v) {
    if (moving.body().is_held(v)) {
      ASSERT_LT((moving.body().positions()[v.value] - moving.mesh().rest(v)).norm(), 1e-12);
      ASSERT_EQ(moving.body().velocity(v), Vec3(Vec3::Zero()));
    }
  });
}

/// Whether skin that faces along x meets at a vertex.
bool has_skin_across(const TetMesh& mesh, VertexId vertex) {
  StarWalker walker;
  const std::vector<TetId>& star = walker.star(mesh, vertex);
  return std::any_of(star.begin(), star.end(), [&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.vertices(tet)[s] == vertex || mesh.links(tet)[s] != Link::boundary(0)) continue;
      const auto v = mesh.vertices(Side(tet, s));
      const Vec3 area = (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0]));
      if (std::abs(area.x()) > 0.7 * area.norm()) return true;
    }
    return false;
  });
}

/// A birth at a blade's front may have its parents beside the wall: it is free although it lies in it.
TEST(BodyFollow, HoldsComeBackWithUndoAndRedo) {
  for (std::uint64_t seed = 1; seed <= of_campaign(2U, 4U); ++seed) {
    SCOPED_TRACE(seed);
    MovingBody moving(jittered_cube(4, seed), {tissue(20e3), {}});
    moving.hold_where(0);
    moving.advance(10);
    RandomCalls program(moving, seed);
    program.run(20, [&] {
      unsigned at_wall = 0, held = 0;
      moving.mesh().for_each_vertex([&](VertexId v) {
        const double x = std::abs(moving.mesh().rest(v).x());  // a cut may draw skin a little off its plane
        const bool is_at_wall = x < 1e-9, is_held = moving.body().is_held(v);
        // What has no skin in the held plane any more has slid along the wall of its piece.
        ASSERT_TRUE(x < 1e-2 || !is_held || !has_skin_across(moving.mesh(), v))
            << v.value << " at " << moving.mesh().rest(v).transpose();
        at_wall += is_at_wall ? 1U : 0U;
        held += is_held ? 1U : 0U;
      });
      ASSERT_GE(20 * held, 16 * at_wall);
    });
  }
}

TEST(BodyFollow, CopiesOfSpringHeldVerticesAreHeldAlike) {
  MovingBody moving(kuhn_cube(4), {tissue(5e3), {}});
  moving.hold_where(0, 50);
  moving.cut_plane(Vec3(0, 0, 1), 0.5);  // through vertices: they are copied
  moving.mesh().for_each_vertex([&](VertexId v) {
    const bool is_of_lattice = std::abs(moving.mesh().rest(v).x()) < 1e-9 && moving.mesh().origin(v).is_valid();
    ASSERT_TRUE(moving.body().is_held(v) || !is_of_lattice) << v.value;
  });
}

TEST(BodyFollow, PullsAtVerticesThatDiedPullNoMore) {
  for (std::uint64_t seed = 1; seed <= of_campaign(2U, 3U); ++seed) {
    MovingBody moving(jittered_cube(4, seed), {tissue(5e3), {}}, weightless());
    std::vector<Pull> pulls;
    moving.mesh().for_each_vertex([&](VertexId v) {
      Pull pull;
      pull.vertices = {v};
      pull.target = moving.mesh().rest(v);
      pull.stiffness = 1;
      pulls.push_back(pull);
    });
    ASSERT_TRUE(moving.body().set_pulls(pulls).ok());
    RandomCalls program(moving, seed);
    program.run(15, [&] {
      for (const Pull& pull : moving.body().pulls()) {
        if (pull.stiffness == 0) continue;
        ASSERT_TRUE(moving.mesh().is_live(pull.vertices[0]));
        ASSERT_LT((pull.target - moving.body().positions()[pull.vertices[0].value]).norm(), 0.3);
      }
    });
  }
}

// --- places

double furthest(const MovingBody& moving, const Vec3& shift) {
  double most = 0;
  moving.mesh().for_each_vertex([&](VertexId v) {
    most = std::max(most, (moving.state().places[v.value] - moving.mesh().rest(v) - shift).norm());
  });
  return most;
}

TEST(BodyFollow, ACutOfABodyThatWasMovedRigidlyLeavesItUndeformed) {
  MovingBody moving(jittered_cube(4, 1), {tissue(5e3), {}}, weightless());
  const Vec3 shift(3, -2, 7);
  moving.mesh().for_each_vertex(
      [&](VertexId v) { ASSERT_TRUE(moving.body().place(v, moving.mesh().rest(v) + shift).ok()); });
  moving.hand_over();
  ASSERT_TRUE(moving.engine().begin_stroke({{Vec3(3.4, -3, 9), Vec3(3.4, 0, 9)}}).ok());
  ASSERT_TRUE(moving.engine().step({{Vec3(3.45, -3, 6), Vec3(3.45, 0, 6)}}).ok());
  ASSERT_TRUE(moving.engine().end_stroke().ok());
  EXPECT_GT(moving.follow().fresh_vertices, 0U);
  EXPECT_LT(furthest(moving, shift), 1e-6);
}

/// What undo and redo put in place goes where the body is, not where the mesh was when it was cut.
TEST(BodyFollow, UndoAndRedoPutVerticesWhereTheBodyIsNow) {
  for (std::uint64_t seed = 1; seed <= of_campaign(2U, 4U); ++seed) {
    SCOPED_TRACE(seed);
    BodyOptions options = weightless();
    options.crumb = std::numeric_limits<double>::min();  // none: what only resists stretch would shrink
    MovingBody moving(jittered_cube(4, seed), {tissue(5e3), {}}, options);
    Random random(seed);
    const Box box = rest_bounds(moving.mesh());
    for (int i = 0; i < 4; ++i) moving.cut(random_stroke(random, box));
    const Vec3 shift(3, -2, 7);
    moving.mesh().for_each_vertex([&](VertexId v) {
      ASSERT_TRUE(moving.body().place(v, moving.mesh().rest(v) + shift).ok());
      ASSERT_TRUE(moving.body().set_velocity(v, Vec3(1, 2, 3)).ok());
    });
    moving.hand_over();
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(moving.engine().undo());
      moving.follow();
      ASSERT_LT(furthest(moving, shift), 1e-5) << "undo " << i;
    }
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(moving.engine().redo());
      moving.follow();
      ASSERT_LT(furthest(moving, shift), 1e-5) << "redo " << i;
    }
    moving.mesh().for_each_vertex(
        [&](VertexId v) { ASSERT_LT((moving.body().velocity(v) - Vec3(1, 2, 3)).norm(), 1e-6); });
  }
}

TEST(BodyFollow, VerticesThatUndoLeavesAloneStayWhereTheBodyHasThem) {
  MovingBody moving(kuhn_cube(4), {tissue(5e3), {}});
  moving.hold_where(0);
  moving.cut_plane(Vec3(0, 0, 1), 0.45);
  moving.advance(20);
  const std::vector<Vec3> before(moving.body().positions().begin(), moving.body().positions().end());
  ASSERT_TRUE(moving.engine().undo());
  moving.follow();
  unsigned kept = 0;
  moving.mesh().for_each_vertex([&](VertexId v) {
    if (std::abs(moving.mesh().rest(v).z() - 0.45) < 0.3) return;
    ASSERT_EQ(moving.body().positions()[v.value], before[v.value]);
    ++kept;
  });
  EXPECT_GT(kept, 20U);
}

TEST(BodyFollow, NothingToFollowChangesNothing) {
  MovingBody moving(kuhn_cube(3), {tissue(5e3), {}});
  moving.advance(3);
  const std::uint64_t hash = moving.body().hash();
  const FollowReport report = moving.follow();
  EXPECT_EQ(report.removed_tets + report.added_tets + report.fresh_vertices, 0U);
  EXPECT_EQ(moving.body().hash(), hash);
}

TEST(BodyFollow, AJournalFromBeforeTheBodyIsRefused) {
  Engine engine = Engine::create(TetMesh::build(kuhn_cube(3)).value()).value();
  ASSERT_TRUE(engine.cut(*plane_stroke(rest_bounds(engine.mesh()), Vec3(0, 0, 1), 0.4)).ok());
  DeformableBody body = DeformableBody::create(engine.mesh(), engine.journal(), {tissue(5e3), {}}).value();
  ASSERT_TRUE(engine.undo());
  const std::uint64_t hash = body.hash();
  const Result<FollowReport> report = body.follow(engine.journal(), engine.mesh());
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::kBadArgument);
  EXPECT_EQ(body.hash(), hash);
}

}  // namespace
}  // namespace incise::test::body_follow_test
