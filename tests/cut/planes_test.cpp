// SPDX-License-Identifier: Apache-2.0
// Cuts along whole planes: counts, pieces and volumes that one can work out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "incise/geom/predicates.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/strokes.h"

namespace incise::test::planes_test {
namespace {

class BothProfiles : public testing::TestWithParam<Profile> {};
INSTANTIATE_TEST_SUITE_P(profiles, BothProfiles, testing::Values(Profile::kPaper, Profile::kIncise),
                         [](const auto& setting) { return setting.param == Profile::kPaper ? "paper" : "incise"; });

// --- T1: an axis plane through the middle of a layer
// ------------------------------------------------------------------

void expect_mid_layer_cut(std::uint32_t n, int axis, double snap, Profile profile) {
  SCOPED_TRACE(testing::Message() << "n " << n << ", axis " << axis << ", snap " << snap);
  Engine engine = make_engine(kuhn_cube(n), snap, profile);
  Vec3 normal = Vec3::Zero();
  normal[axis] = 1;
  const double place = (n / 2 + 0.5) / n;
  const CutStatistics statistics = cut(engine, plane(engine, normal, place));
  EXPECT_EQ(engine.mesh().tet_count(), 6U * n * n * n + 22U * n * n);
  EXPECT_EQ(statistics.created_tets, 22U * n * n);
  EXPECT_EQ(statistics.cut_tets, 6U * n * n);
  EXPECT_EQ(statistics.incision_faces, 8U * n * n);
  EXPECT_EQ(statistics.copied_vertices, (2U * n + 1) * (2U * n + 1));
  EXPECT_EQ(static_cast<std::uint64_t>(statistics.new_vertices), 2 * statistics.copied_vertices);
  EXPECT_EQ(statistics.snapped_vertices, 0U);
  expect_pieces(engine.mesh(), {place, 1 - place}, 1e-12);
  EXPECT_EQ(euler_characteristics(engine.mesh()), (std::vector<int>{2, 2}));
  EXPECT_NEAR(wall_area(engine.mesh()), 1.0, 1e-12);
}

TEST_P(BothProfiles, cut_the_papers_cube_from_750_to_1300_tets) {
  Engine engine = make_engine(kuhn_cube(5), 0.2, GetParam());
  ASSERT_EQ(engine.mesh().tet_count(), 750U);
  cut(engine, plane(engine, Vec3(0, 0, 1), 0.5));
  EXPECT_EQ(engine.mesh().tet_count(), 1300U);
}

TEST_P(BothProfiles, add_22_tets_per_cell_at_the_middle_of_a_layer) {
  for (const std::uint32_t n : {1U, 2U, 3U, 5U, 8U}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double snap : {0.0, 0.1, 0.2}) expect_mid_layer_cut(n, axis, snap, GetParam());
    }
  }
}

// --- T2: a plane in mesh faces ---------------------------------------------------------------------------------------

void expect_cut_along_faces(const Vec3& normal, double offset) {
  for (const double snap : {0.1, 0.2}) {
    SCOPED_TRACE(testing::Message() << "normal " << normal.transpose() << ", offset " << offset << ", snap " << snap);
    Engine engine = make_engine(kuhn_cube(5), snap);
    const CutStatistics statistics = cut(engine, plane(engine, normal, offset));
    EXPECT_EQ(engine.mesh().tet_count(), 750U);
    EXPECT_EQ(statistics.incision_faces, 50U);
    EXPECT_EQ(statistics.copied_vertices, 36U);
    expect_pieces(engine.mesh(), {0.4, 0.6}, 1e-12);
    EXPECT_EQ(euler_characteristics(engine.mesh()), (std::vector<int>{2, 2}));
  }
}

TEST(Planes, in_mesh_faces_open_them_without_a_new_tet) {
  expect_cut_along_faces(Vec3(1, 0, 0), 0.4);
}

TEST(Planes, one_unit_in_the_last_place_beside_mesh_faces_open_them_without_a_new_tet) {
  expect_cut_along_faces(Vec3(1, 0, 0), std::nextafter(0.4, 1.0));
  expect_cut_along_faces(Vec3(1, 0, 0), std::nextafter(0.4, 0.0));
}

TEST(Planes, tilted_by_1e_13_against_mesh_faces_open_them_without_a_new_tet) {
  expect_cut_along_faces(Vec3(1, 1e-13, 0), 0.4);
  expect_cut_along_faces(Vec3(1, -1e-13, 1e-13), 0.4);
}

TEST(Planes, in_mesh_faces_cut_validly_without_snapping_and_in_the_paper_profile) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    for (const double offset : {0.4, std::nextafter(0.4, 1.0), std::nextafter(0.4, 0.0)}) {
      Engine engine = make_engine(kuhn_cube(5), 0.0, profile);
      cut(engine, plane(engine, Vec3(1, 0, 0), offset));
      if (profile == Profile::kIncise) {
        expect_pieces(engine.mesh(), {0.4, 0.6}, 1e-12);
      }
    }
  }
}

// --- T3: planes along the diagonals of the grid
// -------------------------------------------------------------------------

TEST(Planes, through_grid_vertices_halve_the_cube) {
  for (const std::uint32_t n : {4U, 5U}) {
    for (const double snap : {0.0, 0.1, 0.2}) {
      SCOPED_TRACE(testing::Message() << "n " << n << ", snap " << snap);
      Engine diagonal = make_engine(kuhn_cube(n), snap);
      cut(diagonal, plane(diagonal, Vec3(1, -1, 0), 0.0));
      expect_pieces(diagonal.mesh(), {0.5, 0.5}, 1e-12);
      if (snap > 0) {
        EXPECT_EQ(diagonal.mesh().tet_count(), 6U * n * n * n);
      }
      Engine antidiagonal = make_engine(kuhn_cube(n), snap);
      cut(antidiagonal, plane(antidiagonal, Vec3(1, 1, 0), 1.0));
      expect_pieces(antidiagonal.mesh(), {0.5, 0.5}, 1e-12);
      Engine space = make_engine(kuhn_cube(n), snap);
      cut(space, plane(space, Vec3(1, 1, 1), 1.5));
      expect_pieces(space.mesh(), {0.5, 0.5}, 1e-12);
    }
  }
}

TEST(Planes, swept_by_a_blade_whose_points_are_mesh_vertices_halve_the_cube) {
  for (const double snap : {0.0, 0.2}) {
    SCOPED_TRACE(snap);
    Engine engine = make_engine(kuhn_cube(4), snap);
    cut(engine, quad_stroke(Vec3(0.5, 0, 0), Vec3(0.5, 0, 1), Vec3(0.5, 1, 0), Vec3(0.5, 1, 1), 4));
    EXPECT_LE(find_components(engine.mesh()).count(), 2U);
    Engine diagonal = make_engine(kuhn_cube(4), snap);
    cut(diagonal, quad_stroke(Vec3(-1, -1, -1), Vec3(-1, -1, 2), Vec3(2, 2, -1), Vec3(2, 2, 2), 12));
    expect_pieces(diagonal.mesh(), {0.5, 0.5}, 1e-12);
  }
}

// --- T4: planes through three mesh vertices
// ------------------------------------------------------------------------------

struct ThreePoints {
  Stroke stroke;
  bool has_both_sides = false;
};

/// A triangle that holds the plane of three of the body's points within it, and whether there are others on both sides.
ThreePoints through_three_points(const TetSoup& soup, Random& random) {
  while (true) {
    std::array<Vec3, 3> p;
    for (Vec3& point : p) {
      point =
          soup.points[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(soup.points.size()) - 1))];
    }
    const Vec3 u = p[1] - p[0], v = p[2] - p[0];
    if (u.cross(v).norm() < 1e-9) continue;
    // Integer multiples of the edges: exact where the coordinates are multiples of a power of two.
    const double far = 4096;
    const Vec3 a = p[0] - far * u - far * v, b = p[0] + 2 * far * u - far * v, c = p[0] - far * u + 2 * far * v;
    ThreePoints result;
    result.stroke = stroke_of({{a, b}, {a, c}});
    const Vec3 normal = u.cross(v).normalized();
    bool above = false, below = false;
    for (const Vec3& q : soup.points) {
      above |= normal.dot(q - p[0]) > 1e-11;
      below |= normal.dot(q - p[0]) < -1e-11;
    }
    result.has_both_sides = above && below;
    return result;
  }
}

void cut_through_three_points(const TetSoup& soup, double snap, unsigned count, std::uint64_t seed,
                              Profile profile = Profile::kIncise) {
  Random random(seed);
  for (unsigned i = 0; i < count; ++i) {
    SCOPED_TRACE(testing::Message() << "run " << i << ", seed " << seed << ", snap " << snap);
    const ThreePoints blade = through_three_points(soup, random);
    Engine engine = make_engine(soup, snap, profile);
    cut(engine, blade.stroke);
    EXPECT_EQ(find_components(engine.mesh()).count(), blade.has_both_sides ? 2U : 1U);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Planes, through_three_grid_points_give_two_pieces_without_snapping) {
  cut_through_three_points(kuhn_cube(4), 0.0, 200, 1);
}
TEST(Planes, through_three_scattered_points_give_two_pieces_without_snapping) {
  cut_through_three_points(jittered_cube(4, 2), 0.0, 200, 2);
}
TEST(Planes, through_three_scattered_points_give_two_pieces_in_the_paper_profile) {
  cut_through_three_points(jittered_cube(4, 2), 0.0, 200, 2, Profile::kPaper);
}
TEST(Planes, through_three_grid_points_give_two_pieces_in_the_paper_profile) {
  cut_through_three_points(kuhn_cube(4), 0.0, 200, 1, Profile::kPaper);
}
TEST(Planes, through_three_grid_points_give_sound_tets_at_the_default) {
  cut_through_three_points(kuhn_cube(4), 0.2, 200, 3);
}
TEST(Planes, through_three_scattered_points_give_sound_tets_at_the_default) {
  cut_through_three_points(jittered_cube(4, 4), 0.2, 200, 4);
}

// --- T11: crossing cuts
// ------------------------------------------------------------------------------------------------

TEST(Planes, that_cross_in_time_order_give_four_pieces) {
  for (const double snap : {0.0, 0.1, 0.2}) {
    SCOPED_TRACE(snap);
    Engine engine = make_engine(kuhn_cube(5), snap);
    cut(engine, plane(engine, Vec3(1, 0, 0), 0.47));
    cut(engine, plane(engine, Vec3(0, 1, 0), 0.53));
    expect_pieces(engine.mesh(), {0.47 * 0.53, 0.47 * 0.47, 0.53 * 0.53, 0.53 * 0.47}, 1e-12);
    EXPECT_EQ(euler_characteristics(engine.mesh()), (std::vector<int>{2, 2, 2, 2}));
  }
}

TEST(Planes, that_cross_in_the_paper_profile_give_four_pieces) {
  Engine engine = make_engine(kuhn_cube(5), 0.0, Profile::kPaper);
  cut(engine, plane(engine, Vec3(1, 0, 0), 0.47));
  cut(engine, plane(engine, Vec3(0, 1, 0), 0.53));
  expect_pieces(engine.mesh(), {0.47 * 0.53, 0.47 * 0.47, 0.53 * 0.53, 0.53 * 0.47}, 1e-12);
}

TEST(Planes, in_three_directions_give_eight_pieces) {
  for (const double snap : {0.0, 0.2}) {
    SCOPED_TRACE(snap);
    Engine engine = make_engine(jittered_cube(5, 8), snap);
    cut(engine, plane(engine, Vec3(1, 0.1, 0), 0.52));
    cut(engine, plane(engine, Vec3(0, 1, 0.1), 0.55));
    cut(engine, plane(engine, Vec3(0.1, 0, 1), 0.57));
    EXPECT_EQ(find_components(engine.mesh()).count(), 8U);
    EXPECT_EQ(euler_characteristics(engine.mesh()), std::vector<int>(8, 2));
  }
}

// --- T21: the same place again
// ------------------------------------------------------------------------------------------------

TEST(Planes, cut_again_at_the_same_place_change_nothing) {
  struct Case {
    Vec3 normal;
    double place;
  };
  for (const Case& c : {Case{Vec3(1, 0, 0), 0.47}, Case{Vec3(1, 0, 0), 0.5}, Case{Vec3(0.6, 0.3, 0.74), 0.81}}) {
    for (const double offset : {0.0, 1e-15, 1e-9, 1e-4, -1e-9, -1e-4}) {
      SCOPED_TRACE(testing::Message() << "normal " << c.normal.transpose() << ", offset " << offset);
      Engine engine = make_engine(kuhn_cube(5));
      cut(engine, plane(engine, c.normal, c.place));
      const std::size_t tets = engine.mesh().tet_count();
      ASSERT_EQ(find_components(engine.mesh()).count(), 2U);
      cut(engine, plane(engine, c.normal, c.place + offset * c.normal.norm()));
      EXPECT_EQ(engine.mesh().tet_count(), tets);
      EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
    }
  }
}

// --- T26: blades at vertices, edges and corners
// --------------------------------------------------------------------------------

TEST(Planes, that_touch_a_corner_edge_or_face_of_the_cube_take_nothing_off) {
  for (const double snap : {0.0, 0.2}) {
    SCOPED_TRACE(snap);
    for (const auto& [normal, offset] :
         {std::pair(Vec3(1, 1, 1), 0.0), std::pair(Vec3(1, 1, 1), 3.0), std::pair(Vec3(1, 1, 0), 0.0),
          std::pair(Vec3(1, 0, 0), 0.0), std::pair(Vec3(0, 0, 1), 1.0)}) {
      Engine engine = make_engine(kuhn_cube(4), snap);
      cut(engine, plane(engine, normal, offset));
      EXPECT_EQ(find_components(engine.mesh()).count(), 1U) << normal.transpose() << " " << offset;
    }
  }
}

TEST(Planes, through_a_vertex_an_edge_or_a_corner_give_two_pieces) {
  for (const double snap : {0.0, 0.2}) {
    for (const std::uint32_t n : {3U, 4U}) {
      SCOPED_TRACE(testing::Message() << "snap " << snap << ", n " << n);
      const Vec3 inside(1.0 / n, 1.0 / n, 1.0 / n);
      for (const Vec3& normal : {Vec3(1, 2, -1), Vec3(1, -1, 0.25), Vec3(0.3, -0.9, 0.5)}) {
        for (const Vec3& point : {Vec3(0, 0, 0), inside, Vec3(inside.x(), 0, 0), Vec3(1, 0, 0)}) {
          Engine engine = make_engine(kuhn_cube(n), snap);
          bool above = false, below = false;
          for (unsigned c = 0; c < 8; ++c) {
            const double height = normal.dot(Vec3(c & 1U, (c >> 1U) & 1U, c >> 2U) - point);
            above |= height > 1e-9;
            below |= height < -1e-9;
          }
          cut(engine, plane(engine, normal, normal.dot(point)));
          EXPECT_EQ(find_components(engine.mesh()).count(), above && below ? 2U : 1U)
              << normal.transpose() << " through " << point.transpose();
        }
      }
    }
  }
}

// --- T27, T28: thin and curved bodies
// --------------------------------------------------------------------------------------------

TEST_P(BothProfiles, cut_a_plate_one_element_thick_in_two) {
  for (const double snap : {0.0, 0.2}) {
    Engine engine = make_engine(kuhn_box(Vec3(0, 0, 0), Vec3(8, 8, 0.5), {8, 8, 1}), snap, GetParam());
    cut(engine, plane(engine, Vec3(0.8, 0.6, 0.05), 5.3));
    EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
    EXPECT_EQ(euler_characteristics(engine.mesh()), (std::vector<int>{2, 2}));
  }
}

TEST_P(BothProfiles, cut_a_needle_of_ten_tets_across) {
  const TetSoup soup = needle(10);
  const Vec3 axis = soup.points.back() - soup.points.front();
  for (const double snap : {0.0, 0.2}) {
    for (const double place : {0.31, 0.5, 0.62}) {
      SCOPED_TRACE(testing::Message() << "snap " << snap << ", place " << place);
      Engine engine = make_engine(soup, snap, GetParam());
      ASSERT_EQ(engine.mesh().tet_count(), 10U);
      cut(engine, plane(engine, axis, axis.dot(soup.points.front() + place * axis)));
      EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
    }
  }
}

TEST_P(BothProfiles, cut_a_body_with_a_curved_skin_without_drift) {
  Engine engine = make_engine(ball(8), 0.2, GetParam());
  const double volume = volume_of(engine.mesh());
  cut(engine, plane(engine, Vec3(0.3, 0.5, 0.8), 0.11));
  cut(engine, plane(engine, Vec3(-0.7, 0.4, 0.2), -0.05));
  EXPECT_EQ(find_components(engine.mesh()).count(), 4U);
  expect_valid(engine.mesh(), volume, 1e-12);
}

// --- T35: numbering
// --------------------------------------------------------------------------------------------------------------

TEST(Planes, do_not_depend_on_the_numbers_of_the_vertices) {
  for (const TetSoup& soup : {kuhn_cube(4), jittered_cube(4, 5)}) {
    for (const auto& [normal, offset] : {std::pair(Vec3(1, 0, 0), 0.5), std::pair(Vec3(1, 1, 1), 1.5),
                                         std::pair(Vec3(0.2, 0.7, 0.4), 0.61), std::pair(Vec3(1, -1, 0), 0.0)}) {
      Engine first = make_engine(soup);
      cut(first, plane(first, normal, offset));
      const std::vector<double> expected = piece_volumes(first.mesh());
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(testing::Message() << "normal " << normal.transpose() << ", seed " << seed);
        Engine engine = make_engine(renumbered(soup, seed));
        cut(engine, plane(engine, normal, offset));
        expect_pieces(engine.mesh(), expected, 1e-12);
      }
    }
  }
}

TEST(Planes, that_miss_the_body_change_nothing) {
  Engine engine = make_engine(kuhn_cube(3));
  const std::uint64_t hash = engine.mesh().hash();
  cut(engine, plane(engine, Vec3(0, 0, 1), 1.25));
  EXPECT_EQ(engine.mesh().hash(), hash);
  EXPECT_EQ(engine.journal().size(), 0U);
}

}  // namespace
}  // namespace incise::test::planes_test
