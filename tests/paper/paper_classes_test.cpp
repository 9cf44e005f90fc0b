// SPDX-License-Identifier: Apache-2.0
// Inside, surface and contour vertices.
#include "paper/paper_classes.h"

#include <algorithm>

#include "paper/dividable.h"
#include "paper/paper_support.h"

namespace incise::test::paper_classes_test {
namespace {

using paper::ClassFinder;
using paper::VertexClass;

VertexClass class_at(const TetMesh& mesh, const Vec3& place) {
  return ClassFinder().classify(mesh, vertex_at(mesh, place));
}

TEST(PaperClasses, of_a_cube_are_its_inside_faces_edges_and_corners) {
  const TetMesh mesh = build(kuhn_cube(4));
  EXPECT_EQ(class_at(mesh, Vec3(0.5, 0.5, 0.5)), VertexClass::kInside);
  EXPECT_EQ(class_at(mesh, Vec3(0.5, 0.25, 0)), VertexClass::kSurface);
  EXPECT_EQ(class_at(mesh, Vec3(0.5, 0, 0)), VertexClass::kContour);
  EXPECT_EQ(class_at(mesh, Vec3(1, 0, 0)), VertexClass::kCorner);
}

TEST(PaperClasses, the_contours_neighbours_lie_on_the_line) {
  const TetMesh mesh = build(kuhn_cube(4));
  ClassFinder classes;
  classes.classify(mesh, vertex_at(mesh, Vec3(0.5, 0, 0)));
  ASSERT_EQ(classes.contour().size(), 2U);
  for (const VertexId v : classes.contour()) {
    EXPECT_EQ(mesh.rest(v).y(), 0.0);
    EXPECT_EQ(mesh.rest(v).z(), 0.0);
    EXPECT_EQ(std::abs(mesh.rest(v).x() - 0.5), 0.25);
  }
  EXPECT_GT(classes.rim().size(), 2U);
}

TEST(PaperClasses, a_smooth_curved_skin_is_surface) {
  const TetMesh mesh = build(ball(12));
  ClassFinder classes;
  mesh.for_each_vertex([&](VertexId v) {
    const bool is_skin = (mesh.shape_of(v) & shape::kSkin) != 0;
    EXPECT_EQ(classes.classify(mesh, v), is_skin ? VertexClass::kSurface : VertexClass::kInside) << v.value;
  });
}

TEST(PaperClasses, of_a_cut_are_wall_contour_and_corners_on_the_cubes_edges) {
  const TetMesh mesh = cut_as_paper(kuhn_cube(5), {{Vec3(1, 0, 0), 0.5}}).mesh;
  unsigned walls = 0, contours = 0, corners = 0;
  ClassFinder classes;
  mesh.for_each_vertex([&](VertexId v) {
    if ((mesh.shape_of(v) & shape::kWall) == 0) return;
    const Vec3& p = mesh.rest(v);
    const int ends = static_cast<int>(p.y() == 0 || p.y() == 1) + static_cast<int>(p.z() == 0 || p.z() == 1);
    const VertexClass found = classes.classify(mesh, v);
    EXPECT_EQ(found, ends == 0 ? VertexClass::kSurface : (ends == 1 ? VertexClass::kContour : VertexClass::kCorner));
    walls += found == VertexClass::kSurface ? 1U : 0U;
    contours += found == VertexClass::kContour ? 1U : 0U;
    corners += found == VertexClass::kCorner ? 1U : 0U;
  });
  EXPECT_EQ(walls, 2U * 81U);  // (2N + 1)² vertices on each lip
  EXPECT_EQ(contours, 2U * 36U);
  EXPECT_EQ(corners, 2U * 4U);
}

TEST(PaperClasses, the_front_of_a_cut_that_ends_inside_is_a_contour) {
  const TetMesh mesh = cut_as_paper(kuhn_cube(6), quad_stroke(Vec3(0.5, -0.2, -0.2), Vec3(0.5, -0.2, 1.2),
                                                              Vec3(0.5, 0.55, -0.2), Vec3(0.5, 0.55, 1.2)))
                           .mesh;
  unsigned fronts = 0, contours = 0;
  ClassFinder classes;
  mesh.for_each_vertex([&](VertexId v) {
    if ((mesh.shape_of(v) & shape::kFront) == 0) return;
    const VertexClass found = classes.classify(mesh, v);
    EXPECT_GE(found, VertexClass::kContour);
    ++fronts;
    contours += found == VertexClass::kContour ? 1U : 0U;
  });
  EXPECT_GT(fronts, 4U);
  EXPECT_GT(contours, 0U);
}

TEST(PaperClasses, where_walls_of_two_strokes_meet_is_a_contour_or_a_corner) {
  const TetMesh mesh = cut_as_paper(kuhn_cube(4), {{Vec3(1, 0.1, 0), 0.53}, {Vec3(0.1, 1, 0), 0.57}}).mesh;
  ClassFinder classes;
  unsigned seams = 0;
  mesh.for_each_vertex([&](VertexId v) {
    const Vec3& p = mesh.rest(v);
    const bool is_on_both =
        std::abs(p.x() + 0.1 * p.y() - 0.53) < 1e-12 && std::abs(0.1 * p.x() + p.y() - 0.57) < 1e-12;
    if (!is_on_both) return;
    ++seams;
    EXPECT_EQ(classes.classify(mesh, v), p.z() == 0 || p.z() == 1 ? VertexClass::kCorner : VertexClass::kContour);
  });
  EXPECT_GE(seams, 4U * 5U);
}

TEST(PaperClasses, where_the_front_of_a_cut_turns_sharply_is_a_corner) {
  // A slit in the plane x = ½ from the skin z = 1 down to z = ½, from y = ¼ to y = ¾: its front goes down, along and
  // up.
  TetMesh mesh = build(kuhn_cube(8));
  std::vector<IncisionFace> faces;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (link.is_boundary() || link.side() < Side(tet, s)) continue;
      const auto v = mesh.vertices(Side(tet, s));
      const bool is_in = std::all_of(v.begin(), v.end(), [&](VertexId w) {
        const Vec3& p = mesh.rest(w);
        return p.x() == 0.5 && p.y() >= 0.25 && p.y() <= 0.75 && p.z() >= 0.5;
      });
      if (is_in) faces.push_back({Side(tet, s), link.side()});
    }
  });
  Transaction transaction(mesh);
  StarWalker walker;
  separate_as_paper(transaction, faces, 1, walker);
  transaction.commit();
  EXPECT_EQ(class_at(mesh, Vec3(0.5, 0.5, 0.5)), VertexClass::kContour);
  EXPECT_EQ(class_at(mesh, Vec3(0.5, 0.25, 0.75)), VertexClass::kContour);
  EXPECT_EQ(class_at(mesh, Vec3(0.5, 0.25, 0.5)), VertexClass::kCorner);
}

TEST(PaperClasses, a_border_between_regions_stays) {
  TetSoup soup = kuhn_cube(4);
  for (const auto& tet : soup.tets) {
    const Vec3 centre = (soup.points[tet[0]] + soup.points[tet[1]] + soup.points[tet[2]] + soup.points[tet[3]]) / 4;
    soup.regions.push_back(centre.z() < 0.5 ? 1 : 2);
  }
  const TetMesh mesh = build(std::move(soup));
  EXPECT_EQ(class_at(mesh, Vec3(0.5, 0.5, 0.5)), VertexClass::kCorner);
  EXPECT_EQ(class_at(mesh, Vec3(0.5, 0.5, 0.75)), VertexClass::kInside);
}

}  // namespace
}  // namespace incise::test::paper_classes_test
