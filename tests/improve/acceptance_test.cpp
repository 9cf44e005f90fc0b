// SPDX-License-Identifier: Apache-2.0
// What maintenance reaches on the paper's cube of 750 tets, on hard cuts, and over many of them.
#include <map>

#include "improve/maintainer_cases.h"
#include "support/random_strokes.h"

namespace incise::test::acceptance_test {
namespace {

/// The figures that a cut with its maintenance must reach at the incision; without snapping, which leaves far worse
/// tets to mend, the bounds on the worst are wider.
void expect_accepted(const Case& scene, double snap) {
  SCOPED_TRACE(scene.name + (snap == 0 ? " without snapping" : ""));
  Engine engine = maintaining_engine(scene.soup, snap, 0);
  const double mean = measure_quality(engine.mesh()).lr_mean;
  const auto tets = static_cast<double>(engine.mesh().tet_count());
  cut_and_maintain(engine, scene.strokes[0]);
  const std::vector<double> volumes = piece_volumes(engine.mesh());
  EXPECT_TRUE(engine.maintain().ok());
  const QualityStats all = measure_quality(engine.mesh()), touched = touched_quality(engine);
  EXPECT_EQ(touched.lr_over_200_pct, 0.0);
  EXPECT_LE(touched.lr_max, snap == 0 ? 40.0 : 25.0);
  EXPECT_LE(all.lr_mean, 1.05 * mean);
  EXPECT_GE(touched.dihedral_min_deg, snap == 0 ? 4.0 : 10.0);
  EXPECT_LE(touched.dihedral_max_deg, snap == 0 ? 168.0 : 160.0);
  EXPECT_LE(static_cast<double>(engine.mesh().tet_count()), 1.40 * tets);
  expect_pieces(engine.mesh(), volumes, 1e-9);
  expect_valid(engine.mesh(), 1.0, 1e-9);
}

TEST(MaintenanceOf750Tets, after_hard_planes_meets_what_is_asked_of_it) {
  for (const char letter : {'A', 'B', 'C', 'D'}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      SCOPED_TRACE(seed);
      for (const double snap : {0.0, 0.2}) expect_accepted(planar_case(letter, 5, seed), snap);
    }
  }
}

TEST(MaintenanceOf750Tets, after_a_wavy_sheet_meets_what_is_asked_of_it) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    SCOPED_TRACE(seed);
    expect_accepted({"wavy", jittered_cube(5, seed), {wavy_sheet(18)}}, 0.2);
  }
}

TEST(MaintenanceOf750Tets, after_random_planes_leaves_no_bad_shapes) {
  Random random(5);
  for (unsigned i = 0; i < 10; ++i) {
    SCOPED_TRACE(i);
    const TetSoup soup = jittered_cube(5, i + 1);
    const Vec3 normal = random_direction(random);
    Engine engine = maintaining_engine(soup, 0.2);
    cut_and_maintain(engine, plane_of(soup, normal, normal.dot(random.point(0.3, 0.7))));
    EXPECT_LE(touched_quality(engine).lr_max, 25.0);
    expect_valid(engine.mesh(), 1.0, 1e-9);
  }
}

// --- many cuts
// --------------------------------------------------------------------------------------------------------------

TEST(MaintenanceOfManyCuts, along_one_path_does_not_let_the_mesh_grow) {
  const TetSoup soup = jittered_cube(6, 1);
  Engine engine = maintaining_engine(soup, 0.2);
  Random random(6);
  std::size_t once = 0;
  for (unsigned i = 0; i < 20; ++i) {
    const double amount = 0.1 / 6;
    const Vec3 normal = (oblique_normal() + amount * random.point(-0.3, 0.3)).normalized();
    cut_and_maintain(engine, plane_of(soup, normal, normal.dot(oblique_point()) + random.real(-0.5, 0.5) * amount));
    expect_valid(engine.mesh(), 1.0, 1e-9);
    if (i == 0) once = engine.mesh().tet_count();
  }
  EXPECT_LE(static_cast<double>(engine.mesh().tet_count()), 1.5 * static_cast<double>(once));
  EXPECT_EQ(measure_quality(engine.mesh()).lr_over_200_pct, 0.0);
}

TEST(MaintenanceOfManyCuts, again_in_the_very_same_place_changes_little) {
  const TetSoup soup = jittered_cube(5, 2);
  Engine engine = maintaining_engine(soup, 0.2);
  cut_and_maintain(engine, oblique_plane(soup));
  const std::size_t once = engine.mesh().tet_count();
  for (unsigned i = 0; i < 19; ++i) cut_and_maintain(engine, oblique_plane(soup));
  EXPECT_LE(static_cast<double>(engine.mesh().tet_count()), 1.05 * static_cast<double>(once));
  EXPECT_EQ(piece_volumes(engine.mesh()).size(), 2U);
  expect_valid(engine.mesh(), 1.0, 1e-9);
}

TEST(MaintenanceOfManyCuts, in_all_directions_keeps_a_mesh_to_simulate) {
  Engine engine = maintaining_engine(jittered_cube(5, 3), 0.2);
  Random random(7);
  for (unsigned i = 0; i < 20; ++i) {
    cut_and_maintain(engine, random_stroke(random, rest_bounds(engine.mesh())));
    expect_valid(engine.mesh(), 1.0, 1e-9);
  }
  EXPECT_LT(measure_quality(engine.mesh()).lr_over_200_pct, 0.5);
}

// --- both lips
// --------------------------------------------------------------------------------------------------------------

struct Lip {
  std::vector<std::array<double, 3>> places;
  double area = 0;
};

/// The wall of each piece.
std::map<std::uint32_t, Lip> lips_of(const TetMesh& mesh) {
  const Components pieces = find_components(mesh);
  std::map<std::uint32_t, Lip> lips;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (!link.is_boundary() || link.tag() == 0) continue;
      Lip& lip = lips[pieces.label[tet.value]];
      lip.area += 0.5 * vector_area2(mesh, {tet, s}).norm();
      for (const VertexId v : mesh.vertices(Side(tet, s))) {
        lip.places.push_back({mesh.rest(v).x(), mesh.rest(v).y(), mesh.rest(v).z()});
      }
    }
  });
  for (auto& [piece, lip] : lips) {
    std::sort(lip.places.begin(), lip.places.end());
    lip.places.erase(std::unique(lip.places.begin(), lip.places.end()), lip.places.end());
  }
  return lips;
}

TEST(MaintenanceOfLips, edits_them_independently_and_keeps_the_sections_area) {
  // The plane meets the four edges along x alone: its section lies over the unit square of y and z.
  const Vec3 normal(1, 0.3, 0.2);
  for (const double snap : {0.0, 0.2}) {
    const TetSoup soup = jittered_cube(5, 4);
    Engine engine = maintaining_engine(soup, snap);
    cut_and_maintain(engine, plane_of(soup, normal, 0.75));
    const auto lips = lips_of(engine.mesh());
    ASSERT_EQ(lips.size(), 2U);
    const Lip &one = lips.begin()->second, &other = lips.rbegin()->second;
    EXPECT_NEAR(one.area, normal.norm(), 1e-9);
    EXPECT_NEAR(other.area, normal.norm(), 1e-9);
    EXPECT_FALSE(one.places == other.places);
    for (const Lip* lip : {&one, &other}) {
      for (const auto& [x, y, z] : lip->places) EXPECT_NEAR(normal.dot(Vec3(x, y, z)), 0.75, 1e-12);
    }
    expect_valid(engine.mesh(), 1.0, 1e-9);
  }
}

// --- the whole mesh
// ---------------------------------------------------------------------------------------------------------

TEST(MaintenanceOfAll, makes_a_jittered_cube_better_and_keeps_its_boundary) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    TetSoup soup = kuhn_cube(5);
    jitter(soup, 0.3, seed);
    if (!validate(build(soup), ValidateLevel::kGeometry).ok) continue;
    Engine engine = maintaining_engine(soup, 0.2);
    const QualityStats before = measure_quality(engine.mesh());
    const std::uint64_t hash = engine.mesh().hash();
    EXPECT_TRUE(engine.improve().ok());
    const QualityStats after = measure_quality(engine.mesh());
    EXPECT_LT(after.lr_max, before.lr_max);
    EXPECT_LT(after.lr_mean, before.lr_mean);
    EXPECT_NEAR(boundary_area(engine.mesh(), 0), 6.0, 1e-12);
    EXPECT_FALSE(engine.has_maintenance());
    expect_valid(engine.mesh(), 1.0, 1e-12);
    ASSERT_TRUE(engine.undo());
    EXPECT_EQ(engine.mesh().hash(), hash);
  }
}

TEST(MaintenanceOfAll, of_a_mesh_that_is_good_enough_does_nothing) {
  Engine engine = maintaining_engine(kuhn_cube(5), 0.2);
  const std::uint64_t hash = engine.mesh().hash();
  const MaintainStatistics done = engine.improve()->maintain;
  EXPECT_EQ(done.moved_vertices + done.collapsed_edges + done.removed_edges + done.removed_faces, 0U);
  EXPECT_EQ(engine.mesh().hash(), hash);
  expect_valid(engine.mesh(), 1.0);
}

TEST(MaintenanceOfAll, stops_where_it_is_told_to_and_goes_on) {
  TetSoup soup = kuhn_cube(5);
  jitter(soup, 0.25, 9);
  Engine engine = maintaining_engine(soup, 0.2), whole = maintaining_engine(soup, 0.2);
  unsigned asked = 0;
  EXPECT_TRUE(engine.improve([&] { return ++asked > 20; }).ok());
  EXPECT_TRUE(engine.has_maintenance());
  EXPECT_TRUE(engine.maintain().ok());
  EXPECT_TRUE(whole.improve().ok());
  EXPECT_TRUE(shape_list(engine.mesh()) == shape_list(whole.mesh()));
  ASSERT_TRUE(engine.undo());
  EXPECT_TRUE(shape_list(engine.mesh()) == shape_list(build(soup)));
  expect_valid(engine.mesh(), 1.0);
}

}  // namespace
}  // namespace incise::test::acceptance_test
