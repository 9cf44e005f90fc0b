// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/drawn_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "incise/engine/engine.h"
#include "incise/geom/triangle_tree.h"
#include "incise/mesh/components.h"
#include "incise/mesh/edge_length.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/fine_surfaces.h"
#include "support/strokes.h"

namespace incise::test {
namespace {

struct Body {
  Engine engine;
  EmbeddedSurface surface;
};

Body make_body(TetSoup soup, FineSurface fine, bool is_maintained) {
  Engine engine =
      is_maintained ? std::move(Engine::create(build(std::move(soup)))).value() : make_engine(std::move(soup));
  Result<EmbeddedSurface> surface = EmbeddedSurface::bind(std::move(fine), engine.mesh(), engine.journal());
  EXPECT_TRUE(surface.ok());
  return {std::move(engine), std::move(surface).value()};
}

void cut_and_follow(Body& body, const Stroke& stroke) {
  ASSERT_TRUE(body.engine.cut(stroke).ok());
  ASSERT_TRUE(body.surface.follow(body.engine.journal(), body.engine.mesh()).ok());
}

/// Moves the pieces of a body apart along x.
void pull_apart(Engine& engine, double distance) {
  const TetMesh& mesh = engine.mesh();
  const Components pieces = find_components(mesh);
  std::vector<Vec3> places;
  for (std::uint32_t slot = 0; slot < mesh.vertex_slots(); ++slot) places.push_back(mesh.rest(VertexId(slot)));
  mesh.for_each_vertex([&](VertexId v) {
    if (!mesh.tet_of(v).is_valid()) return;
    places[v.value].x() += distance * pieces.label[mesh.tet_of(v).value];
  });
  ASSERT_TRUE(engine.set_positions(places).ok());
}

/// The farthest that the rims of the walls, as they are drawn, lie from the fine skin and what fills gaps.
double greatest_gap_of_walls(const DrawnSurface& drawn, const std::vector<Vec3>& positions) {
  const std::size_t bare = drawn.walls.size() - drawn.rim_triangles;
  std::vector<TriangleTree::Triangle> rest(drawn.skin.begin(), drawn.skin.end());
  rest.insert(rest.end(), drawn.walls.begin() + static_cast<std::ptrdiff_t>(bare), drawn.walls.end());
  const TriangleTree tree(positions, rest);
  using Place = std::array<double, 3>;
  std::map<std::pair<Place, Place>, int> edges;
  const auto place = [&](std::uint32_t i) { return Place{positions[i].x(), positions[i].y(), positions[i].z()}; };
  for (std::size_t i = 0; i < bare; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      Place a = place(drawn.walls[i][k]), b = place(drawn.walls[i][(k + 1) % 3]);
      if (b < a) std::swap(a, b);
      ++edges[{a, b}];
    }
  }
  double greatest = 0;
  for (const auto& [edge, count] : edges) {
    if (count != 1) continue;
    const Vec3 a(edge.first.data()), b(edge.second.data());
    for (const double s : {0.0, 0.25, 0.5, 0.75}) {
      greatest = std::max(greatest, std::sqrt(tree.closest(a + s * (b - a)).distance2));
    }
  }
  return greatest;
}

/// The farthest that a point of the fine rim lies from the walls as they are drawn, with or without what fills gaps.
double greatest_gap(const Body& body, const DrawnSurface& drawn, const std::vector<Vec3>& positions, bool with_rims) {
  std::vector<TriangleTree::Triangle> walls(drawn.walls.begin(), drawn.walls.end());
  if (!with_rims) walls.resize(walls.size() - drawn.rim_triangles);
  const TriangleTree tree(positions, walls);
  std::vector<Vec3> fine;
  body.surface.fill(body.engine.mesh(), fine);
  double greatest = 0;
  for (const FineTriangle& t : body.surface.triangles()) {
    if (!t.is_live()) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      if ((t.lips >> i & 1U) == 0) continue;
      for (const double s : {0.0, 0.5}) {
        const Vec3 p = fine[t.points[i]] + s * (fine[t.points[(i + 1) % 3]] - fine[t.points[i]]);
        const double gap = std::sqrt(tree.closest(p).distance2);
        greatest = std::max(greatest, gap);
      }
    }
  }
  return greatest;
}

TEST(DrawnSurface, an_uncut_body_is_its_fine_skin) {
  const Body body = make_body(ball(6), fine_sphere(1, 12), false);
  const DrawnSurface drawn = draw(body.surface, body.engine.mesh());
  EXPECT_EQ(drawn.skin.size(), body.surface.source().triangles.size());
  EXPECT_TRUE(drawn.walls.empty());
  std::vector<Vec3> positions, normals;
  fill(drawn, body.engine.mesh(), positions, normals);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_LT((positions[i] - drawn.points[i].rest).norm(), 1e-12);
    EXPECT_GT(normals[i].dot(positions[i].normalized()), 0.99);
  }
}

TEST(DrawnSurface, walls_meet_the_fine_skin) {
  for (const bool is_maintained : {false, true}) {
    for (const double radius : {1.0, 1.03}) {
      SCOPED_TRACE(std::to_string(radius) + (is_maintained ? " maintained" : ""));
      Body body = make_body(ball(8), fine_sphere(radius, 32), is_maintained);
      cut_and_follow(body, plane(body.engine, Vec3(1, 0.1, 0), 0.02));
      pull_apart(body.engine, 0.5);
      const DrawnSurface drawn = draw(body.surface, body.engine.mesh());
      std::vector<Vec3> positions, normals;
      fill(drawn, body.engine.mesh(), positions, normals);
      const double edge = mean_edge_length(body.engine.mesh());
      const double bare = greatest_gap(body, drawn, positions, false);
      const double filled = greatest_gap(body, drawn, positions, true);
      const double walls = greatest_gap_of_walls(drawn, positions);
      EXPECT_LT(bare, 0.2 * edge);
      EXPECT_LT(filled, 1e-6 * edge);
      EXPECT_LT(walls, 1e-6 * edge);
    }
  }
}

TEST(DrawnSurface, every_point_of_the_skin_stays_as_near_to_the_fine_surface_as_it_was) {
  Body body = make_body(ball(8), fine_sphere(1, 32), true);
  cut_and_follow(body, plane(body.engine, Vec3(1, 0.1, 0), 0.02));
  cut_and_follow(body, plane(body.engine, Vec3(0, 0.2, 1), -0.1));
  const TetMesh& mesh = body.engine.mesh();
  const double edge = mean_edge_length(mesh);
  const DrawnSurface drawn = draw(body.surface, mesh);
  std::vector<Vec3> positions, normals;
  fill(drawn, mesh, positions, normals);
  const TriangleTree tree(positions, drawn.skin);
  double greatest = 0;
  mesh.for_each_vertex([&](VertexId v) {
    if ((mesh.shape_of(v) & shape::kSkin) == 0) return;
    greatest = std::max(greatest, std::sqrt(tree.closest(mesh.rest(v)).distance2));
  });
  EXPECT_LT(greatest, 0.1 * edge);  // sagittas of the sphere and what maintenance gives way
}

TEST(DrawnSurface, walls_have_coordinates_by_their_places_at_rest) {
  Body body = make_body(ball(6), fine_sphere(1, 16), false);
  cut_and_follow(body, plane(body.engine, Vec3(1, 0, 0), 0.03));
  const DrawnSurface drawn = draw(body.surface, body.engine.mesh());
  ASSERT_EQ(drawn.wall_strokes.size(), drawn.walls.size());
  const std::size_t bare = drawn.walls.size() - drawn.rim_triangles;
  ASSERT_GT(bare, 0U);
  double facing_x = 0, points = 0;
  for (std::size_t i = 0; i < bare; ++i) {
    EXPECT_EQ(drawn.wall_strokes[i], 1U);
    for (const std::uint32_t p : drawn.walls[i]) {
      ASSERT_GE(p, drawn.skin_points);
      const Vec3& rest = drawn.points[p].rest;
      const std::array<std::array<double, 2>, 3> faces = {
          {{rest.y(), rest.z()}, {rest.z(), rest.x()}, {rest.x(), rest.y()}}};
      EXPECT_NE(std::find(faces.begin(), faces.end(), drawn.points[p].texture), faces.end());
      facing_x += drawn.points[p].texture == faces[0] ? 1 : 0;
      ++points;
    }
  }
  EXPECT_GT(facing_x, 0.95 * points);  // the wall lies across x
}

TEST(DrawnSurface, points_are_found_in_the_body_before_it_was_cut) {
  Body body = make_body(ball(6), fine_sphere(1.01, 16), true);
  std::vector<Vec3> places;
  const Vec3 shift(0.5, -0.25, 0.125);
  for (std::uint32_t v = 0; v < body.engine.mesh().vertex_slots(); ++v) {
    places.emplace_back(body.engine.mesh().rest(VertexId(v)) + shift);
  }
  ASSERT_TRUE(body.engine.set_positions(places).ok());
  const TetMesh before = body.engine.mesh();
  const Vec3 normal(1, 0.1, 0);
  Result<Stroke> stroke = plane_stroke(Box{Vec3::Constant(-2), Vec3::Constant(2)}, normal, 0.02);
  ASSERT_TRUE(stroke.ok());
  cut_and_follow(body, *stroke);
  const DrawnSurface drawn = draw(body.surface, body.engine.mesh());
  ASSERT_FALSE(drawn.walls.empty());
  const std::vector<Vec3> earlier = earlier_places(drawn, before);
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    EXPECT_LT((earlier[i] - (drawn.points[i].rest + shift)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace incise::test
