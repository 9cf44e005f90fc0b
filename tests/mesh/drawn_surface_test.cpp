// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/drawn_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include "incise/engine/engine.h"
#include "incise/geom/triangle_tree.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/edge_length.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/fine_surfaces.h"
#include "support/random.h"
#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test::drawn_surface_test {
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

// ---- What follows the body step by step --------------------------------------------------------------------------

/// The triangles of a drawing, whatever their slots.
using Corner = std::array<double, 10>;
using Drawn = std::multiset<std::tuple<DrawnTriangle::Kind, std::uint32_t, std::array<Corner, 3>>>;

Corner corner_of(const DrawnPoint& point) {
  const Vec3 &p = point.rest, &way = point.binding.offset;
  return {p.x(),   p.y(),   p.z(),   point.texture[0], point.texture[1], static_cast<double>(point.binding.tet.value),
          way.x(), way.y(), way.z(), point.normal.x()};
}

Drawn drawn_by(const SurfaceDrawing& drawing) {
  Drawn drawn;
  for (const DrawnTriangle& t : drawing.triangles()) {
    if (t.kind == DrawnTriangle::Kind::kFree) continue;
    const auto& points = drawing.points();
    drawn.insert({t.kind,
                  t.stroke,
                  {corner_of(points[t.points[0]]), corner_of(points[t.points[1]]), corner_of(points[t.points[2]])}});
  }
  return drawn;
}

/// What the one has and the other has not.
std::vector<Drawn::value_type> without(const Drawn& all, const Drawn& others) {
  std::vector<Drawn::value_type> left;
  std::set_difference(all.begin(), all.end(), others.begin(), others.end(), std::back_inserter(left));
  return left;
}

void expect_as_drawn_anew(const SurfaceDrawing& drawing, const Body& body) {
  const SurfaceDrawing anew(body.surface, body.engine.mesh());
  EXPECT_THAT(without(drawn_by(drawing), drawn_by(anew)), testing::IsEmpty());
  EXPECT_THAT(without(drawn_by(anew), drawn_by(drawing)), testing::IsEmpty());
  std::vector<bool> is_used(drawing.points().size(), false);
  for (const DrawnTriangle& t : drawing.triangles()) {
    if (t.kind == DrawnTriangle::Kind::kFree) continue;
    for (const std::uint32_t p : t.points) is_used[p] = true;
  }
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    const TetId tet = drawing.points()[i].binding.tet;
    EXPECT_EQ(tet.is_valid(), is_used[i]);
    EXPECT_TRUE(!tet.is_valid() || body.engine.mesh().is_live(tet));
  }
}

bool follow(SurfaceDrawing& drawing, Body& body) {
  EXPECT_TRUE(body.surface.follow(body.engine.journal(), body.engine.mesh()).ok());
  return drawing.follow(body.surface, body.engine.mesh(), body.engine.journal());
}

SurfaceDrawing drawing_of(const Body& body) {
  return {body.surface, body.engine.mesh(), body.engine.journal()};
}

/// A blade that goes down through the top of the unit cube at `x`, to a depth, along y.
Stroke incision(double x, double bottom, unsigned steps) {
  return quad_stroke(Vec3(x, -0.1, 1.1), Vec3(x, -0.1, bottom), Vec3(x, 0.8, 1.1), Vec3(x, 0.8, bottom), steps);
}

TEST(SurfaceDrawing, each_step_of_a_blade_leaves_what_would_be_drawn_anew) {
  for (const bool is_maintained : {false, true}) {
    SCOPED_TRACE(is_maintained);
    Body body = make_body(jittered_cube(4, 6), fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 16), is_maintained);
    SurfaceDrawing drawing = drawing_of(body);
    for (const double x : {0.53, 0.31}) {
      const Stroke stroke = incision(x, 0.3, 10);
      ASSERT_TRUE(body.engine.begin_stroke({stroke.edges.front()}).ok());
      for (std::size_t i = 1; i < stroke.edges.size(); ++i) {
        ASSERT_TRUE(body.engine.step({stroke.edges[i]}).ok());
        follow(drawing, body);
        expect_as_drawn_anew(drawing, body);
      }
      ASSERT_TRUE(body.engine.end_stroke().ok());
      follow(drawing, body);
      expect_as_drawn_anew(drawing, body);
    }
    EXPECT_GT(drawing.packed().rim_triangles, 0U);
  }
}

TEST(SurfaceDrawing, walls_that_cross_older_ones_are_drawn_as_anew) {
  Body body = make_body(ball(6), fine_sphere(1.01, 20), true);
  SurfaceDrawing drawing = drawing_of(body);
  for (const Vec3& normal : {Vec3(1, 0.1, 0), Vec3(0, 1, 0.2), Vec3(0.3, 0, 1)}) {
    ASSERT_TRUE(body.engine.cut(plane(body.engine, normal, 0.03)).ok());
    EXPECT_TRUE(follow(drawing, body));
    expect_as_drawn_anew(drawing, body);
  }
}

TEST(SurfaceDrawing, random_strokes_are_drawn_as_anew) {
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const bool is_ball = seed % 2 == 0;
    Body body = make_body(is_ball ? ball(5) : jittered_cube(4, seed),
                          is_ball ? fine_sphere(1.01, 14) : fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 14), seed % 4 < 2);
    SurfaceDrawing drawing = drawing_of(body);
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(body.engine.cut(random_incision(random, rest_bounds(body.engine.mesh()))).ok());
      if (i != 1) follow(drawing, body);  // now and then it comes two steps late
      if (i == 2 && body.engine.undo()) follow(drawing, body);
    }
    expect_as_drawn_anew(drawing, body);
  }
}

TEST(SurfaceDrawing, undo_and_redo_are_drawn_as_anew) {
  Body body = make_body(jittered_cube(4, 5), fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 16), true);
  SurfaceDrawing drawing = drawing_of(body);
  const Drawn whole = drawn_by(drawing);
  for (const double x : {0.53, 0.31}) {
    ASSERT_TRUE(body.engine.cut(incision(x, 0.4, 4)).ok());
    follow(drawing, body);
  }
  const Drawn cut_twice = drawn_by(drawing);
  while (body.engine.undo()) {
    EXPECT_TRUE(follow(drawing, body));
    expect_as_drawn_anew(drawing, body);
  }
  EXPECT_TRUE(drawn_by(drawing) == whole);
  while (body.engine.redo()) follow(drawing, body);
  EXPECT_TRUE(drawn_by(drawing) == cut_twice);
  ASSERT_TRUE(body.engine.undo());
  ASSERT_TRUE(body.engine.cut(incision(0.7, 0.2, 4)).ok());  // another one in its place, before it is drawn
  EXPECT_TRUE(follow(drawing, body));
  expect_as_drawn_anew(drawing, body);
}

TEST(SurfaceDrawing, what_it_could_not_follow_is_drawn_anew) {
  Body body = make_body(jittered_cube(4, 5), fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 16), true);
  SurfaceDrawing drawing = drawing_of(body);
  EXPECT_FALSE(follow(drawing, body));
  cut_and_follow(body, incision(0.53, 0.4, 4));
  cut_and_follow(body, incision(0.31, 0.4, 4));  // the surface has forgotten what the first one changed
  EXPECT_TRUE(drawing.follow(body.surface, body.engine.mesh(), body.engine.journal()));
  expect_as_drawn_anew(drawing, body);
}

TEST(SurfaceDrawing, what_did_not_change_keeps_its_slots) {
  Body body = make_body(jittered_cube(6, 5), fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 24), true);
  SurfaceDrawing drawing = drawing_of(body);
  const std::vector<DrawnTriangle> before = drawing.triangles();
  ASSERT_TRUE(body.engine.cut(incision(0.53, 0.9, 1)).ok());
  follow(drawing, body);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    changed += before[i].points != drawing.triangles()[i].points ? 1U : 0U;
  EXPECT_GT(changed, 0U);
  EXPECT_LT(changed, before.size() / 10);
}

TEST(SurfaceDrawing, a_step_costs_what_it_touched) {
  std::array<std::size_t, 2> most{};
  for (const std::uint32_t size : {1U, 2U}) {
    // The same blade, tets and triangles, on a body eight times as large.
    Body body = make_body(kuhn_box(Vec3(0, 0, 0), Vec3::Constant(size), {8 * size, 8 * size, 8 * size}),
                          fine_box(Vec3(0, 0, 0), Vec3::Constant(size), 24 * size), true);
    SurfaceDrawing drawing = drawing_of(body);
    const double top = size;
    ASSERT_TRUE(body.engine.begin_stroke({{Vec3(0.53, 0.2, top + 0.1), Vec3(0.53, 0.2, top - 0.15)}}).ok());
    for (int i = 1; i <= 20; ++i) {
      const double y = 0.2 + 0.02 * i;
      ASSERT_TRUE(body.engine.step({{Vec3(0.53, y, top + 0.1), Vec3(0.53, y, top - 0.15)}}).ok());
      follow(drawing, body);
      most[size - 1] = std::max(most[size - 1], drawing.looked_at());
    }
    ASSERT_TRUE(body.engine.end_stroke().ok());
  }
  EXPECT_GT(most[0], 0U);
  EXPECT_LE(most[1], most[0] * 3 / 2);
  EXPECT_LT(most[0], 8U * 8U * 8U * 6U / 4U);  // of the tets of the smaller body
}

}  // namespace
}  // namespace incise::test::drawn_surface_test
