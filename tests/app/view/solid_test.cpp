// SPDX-License-Identifier: Apache-2.0
// Instruments and drapes as solids.
#include "app/view/solid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "app/view/drapes.h"
#include "app/view/instrument.h"

namespace solid_test {
namespace {

using namespace incise;
using app::Instrument;
using app::InstrumentKind;
using app::SolidCorner;

/// Twice the area vectors of all triangles, summed, over the sum of their lengths: 0 for a closed surface.
double openness(const std::vector<SolidCorner>& corners) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const Eigen::Vector3f a = corners[i].at, b = corners[i + 1].at, c = corners[i + 2].at;
    const Vec3 one = (b - a).cross(c - a).cast<double>();
    sum += one;
    area += one.norm();
  }
  return sum.norm() / area;
}

/// The corner that is furthest along a direction, against `from`.
double furthest(const std::vector<SolidCorner>& corners, const Vec3& from, const Vec3& along) {
  double most = -std::numeric_limits<double>::infinity();
  for (const SolidCorner& corner : corners) most = std::max(most, (corner.at.cast<double>() - from).dot(along));
  return most;
}

Instrument tilted(InstrumentKind kind) {
  Instrument made;
  made.kind = kind;
  made.tip = Vec3(3, -2, 5);
  made.up = Vec3(0.3, -0.2, 1).normalized();
  made.ahead = Vec3(1, 2, 0.5);
  made.millimetre = 0.7;
  made.opening = 4;
  made.hinge = made.tip + Vec3(-20, 3, 8);
  made.other_tip = made.tip + Vec3(1, 2, 14);
  return made;
}

}  // namespace

TEST(Solid, instruments_are_closed_and_their_normals_are_unit) {
  for (const InstrumentKind kind : {InstrumentKind::kScalpel, InstrumentKind::kForceps, InstrumentKind::kHook,
                                    InstrumentKind::kRetractor, InstrumentKind::kScissors, InstrumentKind::kPunch}) {
    std::vector<SolidCorner> corners;
    add_solid(tilted(kind), corners);
    ASSERT_GT(corners.size(), 100U);
    ASSERT_EQ(corners.size() % 3, 0U);
    EXPECT_LT(openness(corners), 1e-4) << static_cast<int>(kind);
    for (const SolidCorner& corner : corners) {
      ASSERT_TRUE(corner.at.allFinite());
      ASSERT_NEAR(corner.normal.norm(), 1, 1e-3);
    }
  }
}

TEST(Solid, the_deepest_place_of_a_scalpel_is_where_its_edge_is) {
  const Instrument scalpel = tilted(InstrumentKind::kScalpel);
  std::vector<SolidCorner> corners;
  add_solid(scalpel, corners);
  EXPECT_NEAR(furthest(corners, scalpel.tip, -scalpel.up), 0, 1e-4);
  // The handle is behind the stroke.
  Vec3 ahead = scalpel.ahead - scalpel.ahead.dot(scalpel.up) * scalpel.up;
  ahead.normalize();
  EXPECT_GT(furthest(corners, scalpel.tip, -ahead), 5 * furthest(corners, scalpel.tip, ahead));
}

TEST(Solid, a_punch_is_as_wide_as_what_it_cuts) {
  const Instrument punch = tilted(InstrumentKind::kPunch);
  std::vector<SolidCorner> corners;
  add_solid(punch, corners);
  double widest = 0;
  for (const SolidCorner& corner : corners) {
    const Vec3 at = corner.at.cast<double>() - punch.tip;
    if (at.dot(punch.up) < 0.01) widest = std::max(widest, at.norm());
  }
  EXPECT_NEAR(widest, punch.opening, 1e-3);
}

TEST(Solid, an_instrument_without_a_direction_is_one_all_the_same) {
  Instrument scalpel;
  std::vector<SolidCorner> corners;
  add_solid(scalpel, corners);
  for (const SolidCorner& corner : corners) ASSERT_TRUE(corner.at.allFinite() && corner.normal.allFinite());
}

TEST(Solid, blades_reach_as_deep_as_they_cut) {
  EXPECT_GT(app::instrument_millimetre(1e-3, 3), 0.25);
  EXPECT_GE(20 * app::instrument_millimetre(1, 600), 600);
  EXPECT_GE(20 * app::instrument_millimetre(0, 5), 5);
}

TEST(Solid, drapes_leave_the_body_free_whatever_is_up) {
  Box body;
  body.extend(Vec3(0, 0, 0));
  body.extend(Vec3(84, 60, 24));
  for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)}) {
    const std::vector<SolidCorner> corners = app::drapes_around(body, up);
    ASSERT_FALSE(corners.empty());
    Box all;
    for (const SolidCorner& corner : corners) {
      const Vec3 at = corner.at.cast<double>();
      all.extend(at);
      bool is_outside = false;
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(up[axis]) > 0.5) continue;
        is_outside = is_outside || at[axis] <= body.lo[axis] || at[axis] >= body.hi[axis];
      }
      EXPECT_TRUE(is_outside) << at.transpose();
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(up[axis]) > 0.5) continue;
      EXPECT_GT(all.hi[axis] - all.lo[axis], 2 * (body.hi - body.lo)[axis]);
    }
  }
  EXPECT_TRUE(app::drapes_around(Box{}, Vec3::UnitZ()).empty());
}

}  // namespace solid_test
