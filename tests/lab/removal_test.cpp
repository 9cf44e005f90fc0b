// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "lab/lab_support.h"
#include "support/sections.h"

namespace incise::test::removal_test {
namespace {

/// What one sees of walls.
struct Roughness {
  double ridges = 0;  ///< of edges between two faces of a wall, the share at which it turns by more than 20°
  double spread = 0;  ///< how far corners lie from a plane, root of the mean square
};

Roughness roughness_of(const TetMesh& mesh, const Vec3& normal, double offset) {
  std::map<std::array<VertexId, 2>, std::vector<Vec3>> normals;
  double squares = 0, corners = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (!link.is_boundary() || link.tag() == 0) continue;
      const auto v = mesh.vertices(Side(tet, s));
      const Vec3 out = (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0])).normalized();
      for (unsigned k = 0; k < 3; ++k) {
        normals[{std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])}].push_back(out);
        squares += std::pow(normal.dot(mesh.rest(v[k])) - offset, 2);
        ++corners;
      }
    }
  });
  double inner = 0, turning = 0;
  for (const auto& [edge, at] : normals) {
    if (at.size() != 2) continue;  // one face of skin
    ++inner;
    turning += at[0].dot(at[1]) < 0.94 ? 1 : 0;
  }
  return {turning / inner, std::sqrt(squares / corners)};
}

TEST(Removal, takes_the_layer_of_elements_that_the_plane_passes_through) {
  const LabCut body = cut_by(LabMethod::kRemoval, kuhn_cube(5), plane_through({1, 0, 0}, 0.5));
  EXPECT_EQ(body.mesh.tet_count(), 750U - 150U);
  EXPECT_EQ(body.statistics.cut_tets, 150U);
  EXPECT_NEAR(volume_of(body.mesh), 0.8, 1e-12);
  expect_pieces(body.mesh, {0.4, 0.4}, 1e-12);
  EXPECT_NEAR(wall_area(body.mesh, 1), 1.0, 1e-12);  // of one lip
  expect_sound(body.mesh);
}

/// "… yet the volume loss would create jagged surface" (section 1), where division leaves walls as smooth as the blade.
TEST(Removal, leaves_jagged_walls_and_a_gap_where_division_leaves_smooth_ones) {
  constexpr double kCell = 0.2;
  Random random(2);
  for (const std::uint64_t seed : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U}) {
    SCOPED_TRACE(seed);
    const TetSoup soup = seed % 2 == 0 ? kuhn_cube(5) : jittered_cube(5, seed);
    const Vec3 normal = random_direction(random);
    const double offset = normal.dot(random.point(0.4, 0.6)), area = section_of_unit_cube(normal, offset).area;
    const LabCut removed = cut_by(LabMethod::kRemoval, soup, plane_through(normal, offset));
    const Roughness jagged = roughness_of(removed.mesh, normal, offset);
    EXPECT_LT(volume_of(removed.mesh), 1 - 0.5 * kCell * area);
    EXPECT_GT(jagged.ridges, 0.2);
    EXPECT_GT(jagged.spread, 0.5 * kCell);
    const LabCut divided = cut_by(LabMethod::kMinimal, soup, plane_through(normal, offset));
    const Roughness smooth = roughness_of(divided.mesh, normal, offset);
    EXPECT_NEAR(volume_of(divided.mesh), 1, 1e-12);
    EXPECT_NEAR(wall_area(divided.mesh), area, 1e-9);
    EXPECT_EQ(smooth.ridges, 0);
    EXPECT_LT(smooth.spread, 1e-12);
  }
}

TEST(Removal, leaves_no_vertex_without_tets) {
  const LabCut body = cut_by(LabMethod::kRemoval, kuhn_cube(1), plane_through({1, 0, 0}, 0.5));
  EXPECT_EQ(body.mesh.tet_count(), 0U);
  EXPECT_EQ(body.mesh.vertex_count(), 0U);
}

TEST(Removal, parts_what_hangs_at_vertices_and_edges_alone) {
  LabCut body{build(kuhn_cube(4)), {}, {}};
  cut_on(body, LabMethod::kRemoval, plane_through({1, 1, 1}, 1.4), 1);
  cut_on(body, LabMethod::kRemoval, plane_through({1, -1, 0.3}, 0.1), 2);
  expect_sound(body.mesh);
}

}  // namespace
}  // namespace incise::test::removal_test
