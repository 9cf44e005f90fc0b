// SPDX-License-Identifier: Apache-2.0
// Shapes, bounds, pieces, quality and validity of meshes.
#include <gtest/gtest.h>

#include <cmath>

#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/defects.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/transaction.h"
#include "incise/mesh/validate.h"

namespace services_test {
namespace {

using namespace incise;

TetMesh build(TetSoup soup) {
  Result<TetMesh> mesh = TetMesh::build(std::move(soup));
  EXPECT_TRUE(mesh.ok());
  return std::move(mesh).value();
}

TetSoup one_tet() {
  return {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {{0, 1, 2, 3}}, {}};
}

// Two tets that share one vertex only.
TetSoup two_at_a_vertex() {
  TetSoup soup = one_tet();
  soup.points.insert(soup.points.end(), {Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)});
  soup.tets.push_back({0, 5, 4, 6});
  return soup;
}

// Two tets that share an edge only.
TetSoup two_at_an_edge() {
  TetSoup soup = one_tet();
  soup.points.insert(soup.points.end(), {Vec3(0, -1, 0), Vec3(0, 0, -1)});
  soup.tets.push_back({0, 1, 4, 5});
  return soup;
}

ValidityReport check(const TetMesh& mesh) {
  return validate(mesh, ValidateLevel::kGeometry);
}

TEST(Shapes, kuhn_cube_has_six_positive_tets_per_cell) {
  for (const std::uint32_t n : {1U, 2U, 5U}) {
    const TetSoup soup = kuhn_cube(n);
    EXPECT_EQ(soup.tets.size(), 6U * n * n * n);
    EXPECT_EQ(soup.points.size(), std::size_t{n + 1} * (n + 1) * (n + 1));
    EXPECT_TRUE(find_defects(soup).none());
    const TetMesh mesh = build(soup);
    const ValidityReport report = check(mesh);
    EXPECT_TRUE(report.ok);
    EXPECT_NEAR(report.volume, 1, 1e-15);
  }
}

TEST(Shapes, kuhn_box_refuses_arguments_out_of_range) {
  EXPECT_TRUE(kuhn_cube(0).tets.empty());
  EXPECT_TRUE(kuhn_box(Vec3(0, 0, 0), Vec3(1, 0, 1), {1, 1, 1}).tets.empty());
  EXPECT_TRUE(kuhn_box(Vec3(0, 0, 0), Vec3(1, 1, 1), {4000, 4000, 4000}).tets.empty());
  EXPECT_TRUE(kuhn_box(Vec3(0, 0, std::nan("")), Vec3(1, 1, 1), {1, 1, 1}).tets.empty());
}

TEST(Shapes, jitter_keeps_the_box_and_turns_nothing_over) {
  TetSoup soup = kuhn_box(Vec3(-1, 0, 2), Vec3(2, 1, 4), {6, 4, 5});
  const TetSoup straight = soup;
  jitter(soup, 0.15, 7);
  EXPECT_NE(soup.points, straight.points);
  const TetMesh mesh = build(soup);
  const ValidityReport report = check(mesh);
  EXPECT_TRUE(report.ok);
  EXPECT_NEAR(report.volume, 6, 1e-13);
  EXPECT_EQ(rest_bounds(mesh).lo, Vec3(-1, 0, 2));
  EXPECT_EQ(rest_bounds(mesh).hi, Vec3(2, 1, 4));
  TetSoup again = straight;
  jitter(again, 0.15, 7);
  EXPECT_EQ(again.points, soup.points);
}

TEST(Bounds, leave_out_vertices_without_tets) {
  TetSoup soup = one_tet();
  soup.points.emplace_back(9, 9, 9);
  EXPECT_EQ(rest_bounds(build(soup)).hi, Vec3(1, 1, 1));
  EXPECT_TRUE(rest_bounds(TetMesh()).is_empty());
}

TEST(Components, are_connected_by_faces_alone) {
  EXPECT_EQ(find_components(build(kuhn_cube(3))).count(), 1U);
  EXPECT_EQ(find_components(build(two_at_an_edge())).count(), 2U);
  const Components pieces = find_components(build(two_at_a_vertex()));
  ASSERT_EQ(pieces.count(), 2U);
  EXPECT_EQ(pieces.label, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_DOUBLE_EQ(pieces.volume[1], 1.0 / 6);
  EXPECT_EQ(find_components(TetMesh()).count(), 0U);
}

TEST(QualityStats, of_the_regular_tet) {
  const TetMesh mesh = build({{Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)}, {{0, 1, 2, 3}}, {}});
  const QualityStats q = measure_quality(mesh);
  EXPECT_EQ(q.tets, 1U);
  EXPECT_NEAR(q.lr_min, 2 * std::sqrt(6.0), 1e-12);
  EXPECT_EQ(q.lr_min, q.lr_p99);
  EXPECT_NEAR(q.dihedral_min_deg, 70.528779, 1e-5);
  EXPECT_NEAR(q.dihedral_max_deg, 70.528779, 1e-5);
  EXPECT_EQ(q.lr_over_200_pct, 0);
}

TEST(QualityStats, of_the_papers_cube_and_of_nothing) {
  const TetMesh mesh = build(kuhn_cube(5));
  EXPECT_NEAR(measure_quality(mesh).lr_mean, 8.36, 0.005);  // Paper, Table 2: 8.36
  const QualityStats none = measure_quality(mesh, [](TetId) { return false; });
  EXPECT_EQ(none.tets, 0U);
  EXPECT_EQ(none.lr_max, 0);
  EXPECT_FALSE(touches_cut(mesh, TetId(0)));
}

TEST(QualityStats, flat_tets_count_as_bad_and_stay_out_of_the_figures) {
  TetSoup soup = two_at_a_vertex();
  soup.points[6] = Vec3(-1, -1, 0);
  const QualityStats q = measure_quality(build(soup));
  EXPECT_EQ(q.flat_tets, 1U);
  EXPECT_EQ(q.lr_over_200_pct, 50);
  EXPECT_TRUE(std::isfinite(q.lr_max));
}

TEST(Validate, finds_singleton_vertices_and_the_edges_of_touching_tets) {
  const ValidityReport at_vertex = check(build(two_at_a_vertex()));
  EXPECT_FALSE(at_vertex.ok);
  EXPECT_EQ(at_vertex.count(ViolationKind::kSingletonVertex), 1U);
  EXPECT_EQ(at_vertex.count(ViolationKind::kNonmanifoldEdge), 0U);
  ASSERT_EQ(at_vertex.first.size(), 1U);
  EXPECT_EQ(at_vertex.first[0].ids[0], 0U);
  const ValidityReport at_edge = check(build(two_at_an_edge()));
  EXPECT_EQ(at_edge.count(ViolationKind::kSingletonVertex), 2U);
  EXPECT_EQ(at_edge.count(ViolationKind::kNonmanifoldEdge), 1U);
  EXPECT_EQ(name_of(at_edge.first[0].kind), "nonmanifold_edge");
}

TEST(Validate, finds_orphans_flat_tets_and_overshared_faces) {
  TetSoup soup = one_tet();
  soup.points.emplace_back(2, 2, 2);
  EXPECT_EQ(check(build(soup)).count(ViolationKind::kOrphanVertex), 1U);
  soup = one_tet();
  soup.points[3] = Vec3(1, 1, 0);
  EXPECT_EQ(check(build(soup)).count(ViolationKind::kNotPositive), 1U);
  EXPECT_EQ(validate(build(soup), ValidateLevel::kTopology).count(ViolationKind::kNotPositive), 0U);
  soup = one_tet();
  soup.points.insert(soup.points.end(), {Vec3(0, 0, 2), Vec3(0, 0, 3)});
  soup.tets.insert(soup.tets.end(), {{0, 1, 2, 4}, {0, 1, 2, 5}});
  EXPECT_EQ(check(build(soup)).count(ViolationKind::kOversharedFace), 1U);
}

TEST(Validate, finds_a_face_that_was_opened_without_separating_its_vertices) {
  TetMesh mesh = build(kuhn_cube(1));
  Side inner;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) inner = Side(tet, s);
    }
  });
  const ValidityReport before = check(mesh);
  EXPECT_TRUE(before.ok);
  Transaction edit(mesh);
  edit.open(inner, mesh.link(inner).side(), 1);
  static_cast<void>(edit.commit());
  const ValidityReport after = check(mesh);
  EXPECT_EQ(after.count(ViolationKind::kUnseparatedFace), 1U);
  EXPECT_GT(after.count(ViolationKind::kNonmanifoldCutEdge), 0U);
  const ValidityChange change = compare_with_input(before, after);
  EXPECT_FALSE(change.ok);
  EXPECT_EQ(change.grown[static_cast<std::size_t>(ViolationKind::kUnseparatedFace)], 1U);
  EXPECT_TRUE(compare_with_input(after, after).ok);
}

TEST(Validate, finds_one_way_links_wrong_tets_of_vertices_and_broken_corners) {
  TetMesh mesh = build(kuhn_cube(1));
  Transaction edit(mesh);
  Side inner;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) inner = Side(tet, s);
    }
  });
  edit.set_link(inner, Link::boundary(0));
  EXPECT_EQ(check(mesh).count(ViolationKind::kBadLink), 1U);
  edit.set_tet_of(VertexId(1), TetId(1000));
  EXPECT_EQ(check(mesh).count(ViolationKind::kBadTetOf), 1U);
  edit.set_corner(TetId(0), 0, mesh.vertices(TetId(0))[1]);
  EXPECT_GT(check(mesh).count(ViolationKind::kBadCorner), 0U);
  edit.rollback();
  EXPECT_TRUE(check(mesh).ok);
}

TEST(Validate, compares_the_volume_and_keeps_no_more_ids_than_asked) {
  const TetMesh mesh = build(kuhn_cube(2));
  ValidateOptions options;
  options.expected_volume = 1 + 1e-9;
  const ValidityReport report = validate(mesh, ValidateLevel::kGeometry, options);
  EXPECT_EQ(report.count(ViolationKind::kVolumeDrift), 1U);
  EXPECT_NEAR(report.volume_error, 1e-9, 1e-12);
  options = {};
  options.max_listed = 1;
  EXPECT_EQ(validate(build(two_at_an_edge()), ValidateLevel::kTopology, options).first.size(), 1U);
  EXPECT_TRUE(validate(TetMesh(), ValidateLevel::kGeometry).ok);
}

}  // namespace

}  // namespace services_test
