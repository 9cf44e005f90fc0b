// SPDX-License-Identifier: Apache-2.0
// Rigid regions, and pins that bear only so much.
#include "sim/body/bones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "incise/mesh/shapes.h"
#include "moving_body.h"

namespace incise::bones_test {
namespace {

using test::MovingBody;
using test::tissue;

constexpr double kRigid = std::numeric_limits<double>::infinity();

BodyOptions options_of(double length_unit, double damping = 0, unsigned threads = 1) {
  BodyOptions options;
  options.length_unit = length_unit;
  options.damping = damping;
  options.threads = threads;
  return options;
}

Materials bone_and_flesh(double young = 2e4) {
  Material bone = tissue(1e9, 0.3, 2000);
  bone.rigid = true;
  return {tissue(young), {{7, bone}}};
}

/// A bar along x of unit cells; tets whose centroid satisfies `is_bone` are of region 7.
template <class IsBone>
TetSoup bar(std::uint32_t length, const IsBone& is_bone, std::uint32_t width = 2) {
  TetSoup soup = kuhn_box(Vec3::Zero(), Vec3(length, width, width), {length, width, width});
  for (const auto& tet : soup.tets) {
    Vec3 centre = Vec3::Zero();
    for (const std::uint32_t v : tet) centre += 0.25 * soup.points[v];
    soup.regions.push_back(is_bone(centre) ? 7 : 0);
  }
  return soup;
}

/// By how much lengths within bone differ from those at rest, at most, length unit.
double strain_of_bones(const MovingBody& moving) {
  const DeformableBody::State& s = moving.state();
  double most = 0;
  for (std::uint32_t t = 0; t < s.tets.size(); ++t) {
    if (!s.tets[TetId(t)][0].is_valid() || !s.is_bone(TetId(t))) continue;
    const auto rest = s.corners_at_rest(TetId(t)), now = s.corners(TetId(t));
    for (const auto& [a, b] : kEdgeCorners) {
      most = std::max(most, std::abs((now[a] - now[b]).norm() - (rest[a] - rest[b]).norm()));
    }
  }
  return most;
}

TEST(Bones, a_free_one_flies_and_spins_as_a_rigid_body) {
  const BodyOptions options = options_of(0.01);
  MovingBody moving(bar(4, [](const Vec3&) { return true; }), bone_and_flesh(), options);
  moving.mesh().for_each_vertex([&](VertexId v) {
    const Vec3 arm = 0.01 * (moving.mesh().rest(v) - Vec3(2, 1, 1));
    ASSERT_TRUE(moving.body().set_velocity(v, Vec3(3, 1, 8).cross(arm) + Vec3(0.1, 0, 1)).ok());
  });
  const Vec3 about = moving.body().mass() * Vec3(0.02, 0.01, 0.01).cross(Vec3(0.1, 0, 1));
  const Vec3 spin = moving.body().angular_momentum() - about;
  Vec3 centre = Vec3::Zero();
  moving.advance(60);
  moving.mesh().for_each_vertex([&](VertexId v) {
    centre += 0.01 * moving.body().mass(v) / moving.body().mass() * moving.body().positions()[v.value];
  });
  EXPECT_LT(strain_of_bones(moving), 1e-10);
  EXPECT_EQ(moving.state().bones.count(), 1U);
  EXPECT_NEAR(centre.x() - 0.02, 0.1, 1e-6);
  EXPECT_NEAR(centre.z() - 0.01, 1 - 0.5 * 9.81, 0.025);  // implicit steps fall g t h / 2 further
  const Vec3 momentum = moving.body().momentum();
  EXPECT_NEAR(momentum.z(), moving.body().mass() * (1 - 9.81), 1e-9);
  EXPECT_LT((moving.body().angular_momentum() - centre.cross(momentum) - spin).norm(), 1e-6 * spin.norm());
}

/// Flesh that grows out of held bone sags as flesh that is held there.
TEST(Bones, hold_flesh_as_a_wall_does) {
  BodyOptions options = options_of(0.01, 10);
  MovingBody with(bar(9, [](const Vec3& p) { return p.x() < 3; }), bone_and_flesh(), options);
  MovingBody without(kuhn_box(Vec3(3, 0, 0), Vec3(9, 2, 2), {6, 2, 2}), {tissue(2e4), {}}, options);
  with.hold_where(0);
  without.hold_where(3);
  with.advance(300);
  without.advance(300);
  const auto tip = [](const MovingBody& moving) {
    double low = 0;
    moving.mesh().for_each_vertex([&](VertexId v) {
      if (moving.mesh().rest(v).x() > 9 - 1e-9) low = std::min(low, moving.mesh().current(v).z());
    });
    return low;
  };
  EXPECT_LT(tip(without), -0.1);
  EXPECT_NEAR(tip(with), tip(without), 2e-3 * std::abs(tip(without)));
  EXPECT_EQ(strain_of_bones(with), 0);
}

/// A bone at the end of flesh hangs from it with its weight: the flesh sags as under a load of that, whatever the bone
/// weighs, within what the descent leaves.
TEST(Bones, weigh_on_what_holds_them) {
  BodyOptions options = options_of(0.01, 10);
  Materials stiff = bone_and_flesh();
  stiff.by_region[0].material = tissue(2e7, 0.3, 2000);  // a thousand times as stiff as flesh, and no bone
  options.iterations = 40;
  const auto is_end = [](const Vec3& p) { return p.x() > 6; };
  MovingBody elastic(bar(9, is_end), stiff, options);
  options.iterations = 5;
  MovingBody bony(bar(9, is_end), bone_and_flesh(), options);
  for (MovingBody* moving : {&elastic, &bony}) {
    moving->hold_where(0);
    moving->advance(600);
  }
  const auto centre_of_end = [](const MovingBody& moving) {
    Vec3 sum = Vec3::Zero();
    unsigned count = 0;
    moving.mesh().for_each_vertex([&](VertexId v) {
      if (moving.mesh().rest(v).x() < 9 - 1e-9) return;
      sum += moving.mesh().current(v);
      ++count;
    });
    return Vec3(sum / count);
  };
  const Vec3 expected = centre_of_end(elastic), found = centre_of_end(bony);
  EXPECT_LT(expected.z(), 0.5);
  EXPECT_LT((found - expected).norm(), 0.02 * (Vec3(9, 1, 1) - expected).norm());
  EXPECT_LT(strain_of_bones(bony), 1e-10);
  const double weight = 9.81 * bony.body().mass();
  EXPECT_NEAR(bony.body().force_on_holds().z(), -weight, 0.02 * weight);
}

TEST(Bones, energy_never_rises_where_nothing_is_done) {
  const BodyOptions options = options_of(0.01);
  MovingBody moving(bar(9, [](const Vec3& p) { return p.x() > 3 && p.x() < 7; }), bone_and_flesh(5e3), options);
  moving.hold_where(0);
  double last = moving.body().energy().total(), peak = 0;
  for (int i = 0; i < 180; ++i) {
    moving.advance();
    const double now = moving.body().energy().total();
    peak = std::max({peak, moving.body().energy().elastic, moving.body().energy().kinetic});
    EXPECT_LE(now, last + 1e-3 * peak) << i;
    last = now;
  }
}

TEST(Bones, are_cut_into_two_and_joined_again_by_undo) {
  std::uint64_t hashes[2] = {};
  for (unsigned threads = 1; threads <= 2; ++threads) {
    const BodyOptions options = options_of(0.01, 0, threads);
    MovingBody moving(bar(9, [](const Vec3& p) { return p.x() > 3 && p.x() < 7; }), bone_and_flesh(), options);
    moving.hold_where(0);
    moving.advance(5);
    EXPECT_EQ(moving.state().bones.count(), 1U);
    moving.cut_plane(Vec3(1, 0.1, 0), 5.3);
    EXPECT_EQ(moving.state().bones.count(), 2U);
    EXPECT_LT(strain_of_bones(moving), 1e-9);
    moving.advance(10);
    EXPECT_LT(strain_of_bones(moving), 1e-9);
    double lowest = 0;
    moving.mesh().for_each_vertex([&](VertexId v) { lowest = std::min(lowest, moving.mesh().current(v).z()); });
    EXPECT_LT(lowest, -5);  // what is off falls: g t² / 2 is 14 units
    hashes[threads - 1] = moving.body().hash();
    ASSERT_TRUE(moving.engine().undo());
    moving.follow();
    EXPECT_EQ(moving.state().bones.count(), 1U);
    moving.advance(20);
    EXPECT_LT(strain_of_bones(moving), 1e-9);
    EXPECT_TRUE(moving.body().is_finite());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Bones, fall_asleep_with_the_flesh_that_they_are_in_and_wake_as_a_whole) {
  BodyOptions options = options_of(0.01, 20);
  MovingBody moving(bar(6, [](const Vec3& p) { return p.x() > 2 && p.x() < 4; }), bone_and_flesh(1e5), options);
  moving.hold_where(0);
  moving.advance(600);
  EXPECT_EQ(moving.body().active_vertices(), 0U);
  VertexId inside;
  moving.mesh().for_each_vertex([&](VertexId v) {
    if ((moving.mesh().rest(v) - Vec3(3, 1, 1)).norm() < 1e-9) inside = v;
  });
  ASSERT_TRUE(inside.is_valid());
  const Vec3 before = moving.body().positions()[inside.value];
  Pull pull;
  pull.vertices[0] = inside;
  pull.target = before + Vec3(0, 0, 1);
  pull.stiffness = 100;
  ASSERT_TRUE(moving.body().set_pulls({pull}).ok());
  moving.advance(30);
  EXPECT_GT(moving.body().positions()[inside.value].z(), before.z() + 0.05);
  EXPECT_LT(strain_of_bones(moving), 1e-9);
}

/// Bone in tissue that stiffens, relaxes, has fibres and averages its volumes, and touches itself: through a cut, undo
/// and redo, on one and two threads.
TEST(Bones, go_with_all_else_that_tissue_can_do) {
  std::uint64_t hashes[2] = {};
  for (unsigned threads = 1; threads <= 2; ++threads) {
    Materials materials = bone_and_flesh(1e4);
    materials.fallback.stiffening = 5;
    materials.fallback.fibre = {1, 0, 0};
    materials.fallback.fibre_young = 3e4;
    materials.fallback.prony[0] = {0.5, 0.1};
    BodyOptions options = options_of(0.01, 1, threads);
    options.average_volumes = true;
    options.self.on = true;
    MovingBody moving(bar(9, [](const Vec3& p) { return p.x() > 3 && p.x() < 7; }), materials, options);
    moving.hold_where(0);
    moving.advance(10);
    moving.cut_plane(Vec3(1, 0.1, 0), 5.3);
    moving.advance(10);
    ASSERT_TRUE(moving.engine().undo());
    moving.follow();
    moving.advance(10);
    ASSERT_TRUE(moving.engine().redo());
    moving.follow();
    moving.advance(20);
    EXPECT_TRUE(moving.body().is_finite());
    EXPECT_LT(strain_of_bones(moving), 1e-8);
    hashes[threads - 1] = moving.body().hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

// --- pins

TEST(Pins, refuse_what_is_out_of_range) {
  MovingBody moving(kuhn_cube(2), {tissue(1e4), {}});
  EXPECT_FALSE(moving.body().hold(VertexId(0), kRigid, {1, false}).ok());
  EXPECT_FALSE(moving.body().hold(VertexId(0), 10, {0, false}).ok());
  EXPECT_FALSE(moving.body().hold(VertexId(1000), 10, {1, false}).ok());
  EXPECT_TRUE(moving.body().hold(VertexId(0), 10, {1, true}).ok());
}

class Pinned : public testing::TestWithParam<bool> {};

/// Pins hold a block of 1.6 g, which weighs 15.7 mN: with a limit above that it hangs there, with one below it goes.
TEST_P(Pinned, bear_their_limit_and_no_more) {
  const bool tears = GetParam();
  BodyOptions options = options_of(0.01, 5);
  for (const double share : {4.0, 0.5}) {
    MovingBody moving(kuhn_box(Vec3::Zero(), Vec3(2, 1, 1), {2, 1, 1}), {tissue(1e5, 0.3, 800), {}}, options);
    const double weight = 9.81 * moving.body().mass();
    std::vector<VertexId> top;
    moving.mesh().for_each_vertex([&](VertexId v) {
      if (moving.mesh().rest(v).z() > 1 - 1e-9) top.push_back(v);
    });
    const double limit = share * weight / static_cast<double>(top.size());
    for (const VertexId v : top) ASSERT_TRUE(moving.body().hold(v, 100, {limit, tears}).ok());
    std::size_t torn = 0;
    for (int i = 0; i < 120; ++i) torn += moving.body().advance(1.0 / 60)->torn_holds;
    EXPECT_EQ(torn, tears && share < 1 ? top.size() : 0U);
    const double speed = -moving.body().velocity(top[0]).z(), held = -moving.body().force_on_holds().z();
    if (share > 1) {
      EXPECT_LT(speed, 1e-3);
      EXPECT_NEAR(held, weight, 0.02 * weight);
    } else {
      // It falls with what is left of its weight, against the damping.
      const double left = tears ? 9.81 : 0.5 * 9.81;
      EXPECT_NEAR(speed, left / 5, 0.1 * left / 5);
      EXPECT_NEAR(held, tears ? 0 : share * weight, 0.05 * weight);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Pinned, testing::Bool(),
                         [](const auto& tears) { return tears.param ? "tearing" : "slipping"; });

}  // namespace
}  // namespace incise::bones_test
