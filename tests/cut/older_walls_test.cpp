// SPDX-License-Identifier: Apache-2.0
// What a stroke finds of older cuts.
#include "cut/older_walls.h"

#include <gtest/gtest.h>

#include "cut/split_template.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::older_walls_test {
namespace {

/// A cube with a slit at x = 0.45, from above down to z = 0.4.
class Slit {
 public:
  explicit Slit(bool is_cut) : engine_(make_engine(kuhn_cube(4))) {
    const auto blade = [](double z) { return std::vector<Vec3>{Vec3(0.45, -1, z), Vec3(0.45, 2, z)}; };
    Stroke stroke;
    stroke.times = {0.0, 1.0};
    stroke.edges = {blade(2.0), blade(0.4)};
    if (is_cut) cut(engine_, stroke);
    index_.follow(engine_.mesh(), engine_.journal());
  }
  [[nodiscard]] OlderWalls walls() const { return {engine_.mesh(), index_, complex_}; }
  [[nodiscard]] const TetMesh& mesh() const { return engine_.mesh(); }
  [[nodiscard]] ClosedComplex& complex() { return complex_; }

 private:
  Engine engine_;
  SurfaceIndex index_;
  SplitTemplates templates_;
  ClosedComplex complex_{templates_};
};

const Vec3 kAcross(1, 0, 0), kUp(0, 0, 1);

TEST(OlderWalls, are_none_in_a_body_that_was_never_cut) {
  const Slit slit(false);
  EXPECT_FALSE(slit.walls().exist());
  EXPECT_FALSE(slit.walls().pass(Vec3(0.45, 0.5, 0.7), kAcross, 0.1, 0.1));
  EXPECT_FALSE(slit.walls().meet(Vec3(0, 0.5, 0.7), Vec3(1, 0.5, 0.7)));
}

TEST(OlderWalls, pass_a_place_beside_them_as_far_as_asked) {
  const Slit slit(true);
  ASSERT_TRUE(slit.walls().exist());
  EXPECT_TRUE(slit.walls().pass(Vec3(0.45, 0.5, 0.7), kAcross, 0.01, 0.01));
  EXPECT_TRUE(slit.walls().pass(Vec3(0.48, 0.5, 0.7), kAcross, 0.04, 0.01));
  EXPECT_FALSE(slit.walls().pass(Vec3(0.48, 0.5, 0.7), kAcross, 0.02, 0.02));
}

TEST(OlderWalls, pass_a_place_beyond_their_rim_as_far_as_asked) {
  const Slit slit(true);
  EXPECT_TRUE(slit.walls().pass(Vec3(0.45, 0.5, 0.37), kAcross, 0.05, 0.05));
  EXPECT_FALSE(slit.walls().pass(Vec3(0.45, 0.5, 0.3), kAcross, 0.05, 0.05));
}

TEST(OlderWalls, pass_only_sheets_that_run_along_them) {
  const Slit slit(true);
  EXPECT_FALSE(slit.walls().pass(Vec3(0.45, 0.5, 0.7), kUp, 0.1, 0.1));
  EXPECT_TRUE(slit.walls().pass(Vec3(0.45, 0.5, 0.7), -2.0 * kAcross, 0.1, 0.1));
}

TEST(OlderWalls, meet_what_passes_through_them_and_not_the_skin) {
  const Slit slit(true);
  EXPECT_TRUE(slit.walls().meet(Vec3(0.3, 0.51, 0.7), Vec3(0.6, 0.52, 0.71)));
  EXPECT_FALSE(slit.walls().meet(Vec3(0.3, 0.51, 0.2), Vec3(0.6, 0.52, 0.21)));
  EXPECT_FALSE(slit.walls().meet(Vec3(0.7, 0.51, 0.7), Vec3(1.6, 0.52, 0.71)));
}

TEST(OlderWalls, are_walls_still_where_a_new_stroke_has_met_their_tets) {
  Slit slit(true);
  slit.mesh().for_each_tet([&](TetId tet) { slit.complex().adopt(slit.mesh(), tet); });
  EXPECT_TRUE(slit.walls().pass(Vec3(0.45, 0.5, 0.7), kAcross, 0.01, 0.01));
}

}  // namespace
}  // namespace incise::test::older_walls_test
