// SPDX-License-Identifier: Apache-2.0
// Front points: the parity law, and where the points lie.
#include "cut/front_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "cut/flagged_body.h"
#include "cut/strip_crossing.h"
#include "cut/strips.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::front_points_test {
namespace {

/// A blade in a body, strip by strip; nothing is snapped.
struct Advance {
  FlaggedBody body;
  OwnSheet sheet;
  StripCrossings crossings;
  std::vector<std::uint32_t> all;
  std::uint32_t step = 0;

  explicit Advance(TetSoup soup) : body(std::move(soup)), all(body.complex().size()) {
    std::iota(all.begin(), all.end(), 0U);
  }
  /// Returns how many points were guessed.
  std::uint64_t to(std::unique_ptr<Strip> next, const FrontRules& rules) {
    const Strip& strip = sheet.add(std::move(next));
    ++step;
    for (const StripCrossing& c : crossings.find(body.mesh(), strip, all, body.complex(), step)) {
      if (c.count % 2 == 1) body.toggle(c.edge, std::clamp(c.t, 0.02, 0.98));
    }
    return update_front_points(body.mesh(), sheet, all, rules, step, body.complex());
  }
  [[nodiscard]] std::array<SosPoint, 3> face(const Master& master, unsigned side) const {
    std::array<SosPoint, 3> p;
    for (unsigned k = 0; k < 3; ++k) {
      const VertexId v = master.vertices[kSideCorners[side][k]];
      p[k] = {body.mesh().rest(v), v.value};
    }
    return p;
  }
  [[nodiscard]] unsigned count_piercings(const Master& master, unsigned side) const {
    const auto p = face(master, side);
    return static_cast<unsigned>(
        std::count_if(sheet.border().begin(), sheet.border().end(),
                      [&](const Strip::Segment& s) { return segment_crosses_triangle(s[0], s[1], p[0], p[1], p[2]); }));
  }
};

unsigned count_flags(const Master& master, unsigned side) {
  unsigned count = 0;
  for (const unsigned e : kSideEdges[side]) count += (unsigned{master.flagged} >> e) & 1U;
  return count;
}

template <class Visit>
void for_each_side(const ClosedComplex& complex, Visit&& visit) {
  for (std::uint32_t m = 0; m < complex.size(); ++m) {
    for (unsigned s = 0; s < 4; ++s) visit(complex[m], s);
  }
}

// T14
TEST(FrontPoints, stand_in_the_odd_faces_and_every_odd_face_is_pierced_by_the_border) {
  Random random(1);
  for (unsigned run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    Advance blade(run % 2 == 0 ? kuhn_cube(3) : jittered_cube(3, run));
    const Rows rows = random_rows(random, 6, 2 + run % 4, random.real(0.5, 1.5));
    for (std::size_t r = 1; r < rows.size(); ++r) {
      EXPECT_EQ(blade.to(strip_to(rows, r), {}), 0U);
      for_each_side(blade.body.complex(), [&](const Master& master, unsigned s) {
        EXPECT_EQ(count_flags(master, s) % 2, blade.count_piercings(master, s) % 2);
        const std::uint32_t at = master.points[s];
        EXPECT_EQ(at != Master::kNone, count_flags(master, s) % 2 == 1);
        EXPECT_TRUE(at == Master::kNone || blade.body.complex().point(at).is_explained);
      });
    }
  }
}

TEST(FrontPoints, lie_in_their_faces_with_a_margin) {
  Random random(2);
  Advance blade(jittered_cube(3, 1));
  const Rows rows = random_rows(random, 4, 3, 0.8);
  for (std::size_t r = 1; r < rows.size(); ++r) {
    blade.to(strip_to(rows, r), {.reach = 0.0, .margin = 0.2});
    for_each_side(blade.body.complex(), [&](const Master& master, unsigned s) {
      if (master.points[s] == Master::kNone) return;
      const FrontPoint& point = blade.body.complex().point(master.points[s]);
      const auto p = blade.face(master, s);
      const Vec3 normal = (p[1].position - p[0].position).cross(p[2].position - p[0].position);
      for (unsigned k = 0; k < 3; ++k) {
        const Vec3 &a = p[(k + 1) % 3].position, &b = p[(k + 2) % 3].position;
        const double weight = normal.dot((b - a).cross(point.position - a)) / normal.squaredNorm();
        EXPECT_GE(weight, 0.2 - 1e-12);
      }
      EXPECT_NEAR(point.weights[0] + point.weights[1] + point.weights[2], 1.0, 1e-14);
    });
  }
}

TEST(FrontPoints, stand_where_a_straight_border_pierces_their_face) {
  Advance blade(kuhn_cube(2));
  const Rows rows = {{Vec3(0.31, -1, 2), Vec3(0.31, 2, 2)}, {Vec3(0.31, -1, 0.45), Vec3(0.31, 2, 0.45)}};
  EXPECT_EQ(blade.to(strip_to(rows, 1), {.reach = 0.0, .margin = 0.0}), 0U);
  unsigned count = 0;
  for_each_side(blade.body.complex(), [&](const Master& master, unsigned s) {
    if (master.points[s] == Master::kNone) return;
    const Vec3& at = blade.body.complex().point(master.points[s]).position;
    EXPECT_NEAR(at.x(), 0.31, 1e-14);
    EXPECT_NEAR(at.z(), 0.45, 1e-14);
    ++count;
  });
  EXPECT_GT(count, 0U);
}

TEST(FrontPoints, stay_while_the_border_is_within_reach) {
  const auto rows_to = [](double z) {
    return Rows{{Vec3(0.31, -1, 2), Vec3(0.31, 2, 2)},
                {Vec3(0.31, -1, 0.45), Vec3(0.31, 2, 0.45)},
                {Vec3(0.31, -1, z), Vec3(0.31, 2, z)}};
  };
  for (const auto& [z, moves] : {std::pair(0.44, false), std::pair(0.40, true)}) {
    Advance blade(kuhn_cube(1));
    const Rows rows = rows_to(z);
    blade.to(strip_to(rows, 1), {.reach = 0.02, .margin = 0.0});
    blade.body.rebuild();
    blade.to(strip_to(rows, 2), {.reach = 0.02, .margin = 0.0});
    EXPECT_EQ(!blade.body.complex().dirty().empty(), moves);
  }
}

TEST(FrontPoints, go_where_the_border_is_once_the_margin_shrinks) {
  Advance blade(kuhn_cube(2));
  const Rows rows = {{Vec3(0.31, -1, 2), Vec3(0.31, 2, 2)}, {Vec3(0.31, -1, 0.45), Vec3(0.31, 2, 0.45)}};
  blade.to(strip_to(rows, 1), {.reach = 0.0, .margin = 0.25});
  blade.body.rebuild();
  Wake wake;
  wake.find(blade.body.mesh(), blade.body.complex(), {}, 0.0, {});
  place_front_points(blade.body.mesh(), blade.sheet, wake, 0.0, blade.body.complex());
  for_each_side(blade.body.complex(), [&](const Master& master, unsigned s) {
    if (master.points[s] == Master::kNone) return;
    EXPECT_NEAR(blade.body.complex().point(master.points[s]).position.z(), 0.45, 1e-14);
  });
}

TEST(FrontPoints, note_where_the_border_turns_inside_a_tet) {
  Advance blade(kuhn_cube(1));
  const Vec3 turn(0.35, 0.7, 0.55);
  const Rows rows = {{Vec3(0.35, 0.7, 2), Vec3(0.35, 2, 2)}, {turn, Vec3(0.35, 2, 0.55)}};
  blade.to(strip_to(rows, 1), {});
  unsigned corners = 0;
  for (const std::uint32_t m : blade.all) {
    const Master& master = blade.body.complex()[m];
    if (master.corner_key == 0) continue;
    EXPECT_LT((master.corner - turn).norm(), 0.2);
    ++corners;
  }
  EXPECT_EQ(corners, 1U);
}

TEST(FrontPoints, make_a_valid_mesh_that_ends_where_the_blade_stands) {
  Random random(3);
  for (unsigned run = 0; run < 10; ++run) {
    SCOPED_TRACE(run);
    Advance blade(jittered_cube(3, run));
    const double volume = volume_of(blade.body.mesh());
    const Rows rows = random_rows(random, 6, 3, random.real(0.5, 1.5));
    for (std::size_t r = 1; r < rows.size(); ++r) {
      blade.to(strip_to(rows, r), {});
      blade.body.rebuild();
      expect_valid(blade.body.mesh(), volume);
    }
  }
}

}  // namespace
}  // namespace incise::test::front_points_test
