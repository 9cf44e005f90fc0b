// SPDX-License-Identifier: Apache-2.0
// What all cited methods promise: sound meshes whatever the stroke, the way back, and errors.
#include "incise/mesh/quality_stats.h"
#include "lab/lab_support.h"
#include "support/random_strokes.h"

namespace incise::test::method_test {
namespace {

class EveryMethod : public testing::TestWithParam<LabMethod> {};

TEST_P(EveryMethod, leaves_a_sound_mesh_after_each_of_some_crossing_planes) {
  Random random(11);
  LabCut body{build(jittered_cube(4, 3)), {}, {}};
  for (std::uint32_t k = 1; k <= 5; ++k) {
    const Vec3 normal = random_direction(random);
    cut_on(body, GetParam(), plane_through(normal, normal.dot(Vec3(0.5, 0.5, 0.5)) + 0.05 * k), k);
    expect_sound(body.mesh);
  }
  EXPECT_GT(find_components(body.mesh).count(), 1U);
}

TEST_P(EveryMethod, cuts_along_a_curved_blade_that_ends_in_the_body) {
  const Stroke stroke = path_stroke({{-0.1, 0.3, 0}, {0.3, 0.4, 0}, {0.62, 0.55, 0}}, -0.2, 1.2);
  const LabCut body = cut_by(GetParam(), jittered_cube(5, 5), stroke);
  expect_sound(body.mesh);
  EXPECT_EQ(find_components(body.mesh).count(), 1U);
  EXPECT_GT(body.statistics.incision_faces, 10U);
}

TEST_P(EveryMethod, is_taken_back_bit_for_bit) {
  LabCut body{build(jittered_cube(4, 3)), {}, {}};
  const std::uint64_t before = body.mesh.hash();
  cut_on(body, GetParam(), plane_through({1, 2, 0.5}, 1.6), 1);
  EXPECT_NE(body.mesh.hash(), before);
  body.journal.take_back(body.mesh, 0);
  EXPECT_EQ(body.mesh.hash(), before);
}

TEST_P(EveryMethod, does_not_depend_on_threads) {
  LabCut one{build(jittered_cube(5, 3)), {}, {}}, four{build(jittered_cube(5, 3)), {}, {}};
  const Stroke stroke = plane_through({1, 2, 0.5}, 1.6);
  ASSERT_TRUE(cut_by(GetParam(), one.mesh, one.journal, stroke, 1, 1).ok());
  ASSERT_TRUE(cut_by(GetParam(), four.mesh, four.journal, stroke, 1, 4).ok());
  EXPECT_EQ(one.mesh.hash(), four.mesh.hash());
}

TEST_P(EveryMethod, changes_nothing_where_the_blade_misses) {
  LabCut body{build(kuhn_cube(3)), {}, {}};
  const std::uint64_t before = body.mesh.hash();
  cut_on(body, GetParam(), quad_stroke({2, 0, 0}, {2, 1, 0}, {3, 1, 0}, {3, 0, 0}), 1);
  EXPECT_EQ(body.mesh.hash(), before);
  EXPECT_EQ(body.journal.size(), 0U);
}

TEST_P(EveryMethod, keeps_the_volume_where_it_says_so) {
  const LabCut body = cut_by(GetParam(), jittered_cube(4, 7), plane_through({1, 2, 0.5}, 1.6));
  const double change = std::abs(volume_of(body.mesh) - volume_of(build(jittered_cube(4, 7))));
  EXPECT_EQ(change < 1e-12, keeps_volume(GetParam())) << change;
}

TEST_P(EveryMethod, refuses_a_stroke_that_sweeps_nothing) {
  LabCut body{build(kuhn_cube(2)), {}, {}};
  EXPECT_FALSE(cut_by(GetParam(), body.mesh, body.journal, Stroke(), 1).ok());
}

TEST_P(EveryMethod, leaves_no_flat_tet_after_a_plane) {
  Random random(23);
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Vec3 normal = random_direction(random);
    const double offset = normal.dot(random.point(0.3, 0.7));
    const LabCut body =
        cut_by(GetParam(), k % 2 == 0 ? kuhn_cube(5) : jittered_cube(4, k), plane_through(normal, offset));
    EXPECT_EQ(measure_quality(body.mesh).flat_tets, 0U) << "plane " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Lab, EveryMethod,
                         testing::Values(LabMethod::kRemoval, LabMethod::kSnapping, LabMethod::kMoving,
                                         LabMethod::kAdaptive, LabMethod::kSeventeen, LabMethod::kMinimal),
                         [](const auto& instance) { return std::string(name_of(instance.param)); });

TEST(LabMethods, are_found_by_their_names) {
  for (const std::string_view name : kLabMethodNames) EXPECT_EQ(name_of(find_lab_method(name).value()), name);
  EXPECT_FALSE(find_lab_method("paper").has_value());
}

}  // namespace
}  // namespace incise::test::method_test
