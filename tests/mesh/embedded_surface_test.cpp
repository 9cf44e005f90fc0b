// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/embedded_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/edge_length.h"
#include "support/bodies.h"
#include "support/campaign.h"
#include "support/engines.h"
#include "support/fine_surfaces.h"
#include "support/random.h"
#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test::embedded_surface_test {
namespace {

using Place = std::tuple<double, double, double>;

Place place_of(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

EmbeddedSurface bind(FineSurface surface, const Engine& engine) {
  Result<EmbeddedSurface> bound = EmbeddedSurface::bind(std::move(surface), engine.mesh(), engine.journal());
  EXPECT_TRUE(bound.ok()) << (bound.ok() ? "" : bound.error().message);
  return std::move(bound).value();
}

void follow(EmbeddedSurface& surface, const Engine& engine) {
  const Status status = surface.follow(engine.journal(), engine.mesh());
  ASSERT_TRUE(status.ok()) << status.error().message;
}

/// An engine that maintains as users' engines do.
Engine make_maintaining_engine(TetSoup soup) {
  Result<Engine> engine = Engine::create(build(std::move(soup)));
  EXPECT_TRUE(engine.ok());
  return std::move(engine).value();
}

double area_of(std::span<const FinePoint> points, const std::array<std::uint32_t, 3>& t) {
  return (points[t[1]].rest - points[t[0]].rest).cross(points[t[2]].rest - points[t[0]].rest).norm() / 2;
}

double total_area(const EmbeddedSurface& surface) {
  double sum = 0;
  for (const FineTriangle& t : surface.triangles()) sum += t.is_live() ? area_of(surface.points(), t.points) : 0;
  return sum;
}

double given_area(const EmbeddedSurface& surface) {
  double sum = 0;
  for (const auto& t : surface.source().triangles) sum += area_of(surface.points(), t);
  return sum;
}

std::size_t live_triangles(const EmbeddedSurface& surface) {
  return static_cast<std::size_t>(std::count_if(surface.triangles().begin(), surface.triangles().end(),
                                                [](const FineTriangle& t) { return t.is_live(); }));
}

/// What holds of any surface that has caught up: nothing hangs in the air, no area is lost, parts fit at rest.
void expect_sound(const EmbeddedSurface& surface, const TetMesh& mesh) {
  std::map<std::pair<Place, Place>, int> edges;
  for (const FineTriangle& t : surface.triangles()) {
    if (!t.is_live()) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const FinePoint& p = surface.points()[t.points[i]];
      ASSERT_TRUE(p.is_live());
      ASSERT_TRUE(mesh.is_live(p.binding.tet));
      const Place from = place_of(p.rest), to = place_of(surface.points()[t.points[(i + 1) % 3]].rest);
      if (from == to) continue;
      from < to ? ++edges[{from, to}] : --edges[{to, from}];
    }
  }
  const auto is_open = [](const auto& edge) { return edge.second != 0; };
  EXPECT_EQ(std::count_if(edges.begin(), edges.end(), is_open), 0) << "edges at rest without another side";
  EXPECT_NEAR(total_area(surface), given_area(surface), 1e-9 * given_area(surface));
}

/// The pieces that triangles hang together in by their points.
std::size_t count_pieces(const EmbeddedSurface& surface) {
  std::vector<std::uint32_t> parent(surface.points().size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  for (const FineTriangle& t : surface.triangles()) {
    if (!t.is_live()) continue;
    parent[root(t.points[0])] = root(t.points[1]);
    parent[root(t.points[1])] = root(t.points[2]);
  }
  std::set<std::uint32_t> roots;
  for (const FineTriangle& t : surface.triangles()) {
    if (t.is_live()) roots.insert(root(t.points[0]));
  }
  return roots.size();
}

/// Triangles whose corners hang on different pieces of the body.
std::size_t count_between_pieces(const EmbeddedSurface& surface, const TetMesh& mesh) {
  const Components pieces = find_components(mesh);
  std::size_t count = 0;
  for (const FineTriangle& t : surface.triangles()) {
    if (!t.is_live()) continue;
    std::set<std::uint32_t> met;
    for (const std::uint32_t p : t.points) met.insert(pieces.label[surface.points()[p].binding.tet.value]);
    count += met.size() > 1 ? 1U : 0U;
  }
  return count;
}

bool passes_through(const Vec3& from, const Vec3& to, const std::array<Vec3, 3>& t) {
  const auto side = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    return (b - a).cross(c - a).dot(p - a);
  };
  if (side(t[0], t[1], t[2], from) * side(t[0], t[1], t[2], to) >= 0) return false;
  const double u = side(from, to, t[0], t[1]), v = side(from, to, t[1], t[2]), w = side(from, to, t[2], t[0]);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

/// Triangles whose corners hang on tets that no way through faces joins near the triangle: sides of a wound, seen by
/// the links of the mesh alone.
std::size_t count_torn(const EmbeddedSurface& surface, const TetMesh& mesh) {
  std::vector<Box> boxes(mesh.tet_slots());
  mesh.for_each_tet([&](TetId tet) {
    for (const VertexId v : mesh.vertices(tet)) boxes[tet.value].extend(mesh.rest(v));
  });
  std::size_t count = 0;
  for (const FineTriangle& t : surface.triangles()) {
    if (!t.is_live()) continue;
    std::array<TetId, 3> tets;
    Box box;
    for (std::size_t i = 0; i < 3; ++i) {
      tets[i] = surface.points()[t.points[i]].binding.tet;
      box.extend(surface.points()[t.points[i]].rest);
      box.extend(boxes[tets[i].value]);
    }
    std::set<TetId> reached = {tets[0]};
    std::vector<TetId> border = {tets[0]};
    while (!border.empty()) {
      const TetId tet = border.back();
      border.pop_back();
      for (const Link link : mesh.links(tet)) {
        if (link.is_boundary() || !boxes[link.side().tet().value].overlaps(box)) continue;
        if (reached.insert(link.side().tet()).second) border.push_back(link.side().tet());
      }
    }
    count += reached.count(tets[1]) == 0 || reached.count(tets[2]) == 0 ? 1U : 0U;
  }
  return count;
}

/// Triangles that a wall passes through, of those drawn in by a share towards their middles: what the tets say plays no
/// part. The parts of a wall that `is_asked` is false for are left out.
std::size_t count_bridges(const EmbeddedSurface& surface, const TetMesh& mesh, double drawn_in) {
  std::vector<std::array<Vec3, 3>> walls;
  std::vector<Box> boxes;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.link(Side(tet, s));
      if (!link.is_boundary() || link.tag() == 0) continue;
      const auto corners = mesh.vertices(Side(tet, s));
      walls.push_back({mesh.rest(corners[0]), mesh.rest(corners[1]), mesh.rest(corners[2])});
      boxes.emplace_back();
      for (const Vec3& p : walls.back()) boxes.back().extend(p);
    }
  });
  std::size_t count = 0;
  for (const FineTriangle& t : surface.triangles()) {
    if (!t.is_live()) continue;
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = surface.points()[t.points[i]].rest;
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3;
    Box box;
    for (Vec3& corner : p) box.extend(corner = corner + drawn_in * (middle - corner));
    bool is_bridge = false;
    for (std::size_t w = 0; w < walls.size() && !is_bridge; ++w) {
      if (!boxes[w].overlaps(box)) continue;
      for (std::size_t i = 0; i < 3; ++i) is_bridge = is_bridge || passes_through(p[i], p[(i + 1) % 3], walls[w]);
    }
    count += is_bridge ? 1U : 0U;
  }
  return count;
}

/// All of a surface, by what it is and not by its slots: two that are equal look the same however the body moves.
using Content = std::multiset<std::tuple<std::uint32_t, std::vector<std::tuple<Place, std::uint32_t>>>>;
Content content_of(const EmbeddedSurface& surface) {
  Content content;
  for (const FineTriangle& t : surface.triangles()) {
    if (!t.is_live()) continue;
    std::vector<std::tuple<Place, std::uint32_t>> corners;
    for (const std::uint32_t p : t.points) {
      corners.emplace_back(place_of(surface.points()[p].rest), surface.points()[p].binding.tet.value);
    }
    content.emplace(t.root, corners);
  }
  return content;
}

struct Snapshot {
  std::vector<FinePoint> points;
  std::vector<FineTriangle> triangles;

  explicit Snapshot(const EmbeddedSurface& surface)
      : points(surface.points().begin(), surface.points().end()),
        triangles(surface.triangles().begin(), surface.triangles().end()) {}
};

void expect_same(const Snapshot& now, const Snapshot& then) {
  ASSERT_EQ(now.points.size(), then.points.size());
  ASSERT_EQ(now.triangles.size(), then.triangles.size());
  for (std::size_t i = 0; i < now.points.size(); ++i) {
    ASSERT_EQ(now.points[i].rest, then.points[i].rest) << i;
    ASSERT_EQ(now.points[i].binding, then.points[i].binding) << i;
    ASSERT_EQ(now.points[i].texture, then.points[i].texture) << i;
    ASSERT_EQ(now.points[i].normal, then.points[i].normal) << i;
    ASSERT_EQ(now.points[i].next_free, then.points[i].next_free) << i;
  }
  for (std::size_t i = 0; i < now.triangles.size(); ++i) {
    ASSERT_EQ(now.triangles[i], then.triangles[i]) << i;
    ASSERT_EQ(now.triangles[i].next, then.triangles[i].next) << i;
  }
}

/// A blade across the unit cube at x = `x`, down to z = `depth`.
Stroke incision(double x, double depth, unsigned steps = 1) {
  return quad_stroke(Vec3(x, -0.5, 1.5), Vec3(x, 1.5, 1.5), Vec3(x, -0.5, depth), Vec3(x, 1.5, depth), steps);
}

TEST(EmbeddedSurface, a_surface_hangs_on_the_tets_that_hold_it) {
  const Engine engine = make_engine(kuhn_cube(4));
  FineSurface inside = fine_box(Vec3(0.1, 0.1, 0.1), Vec3(0.9, 0.9, 0.9), 12);
  const EmbeddedSurface surface = bind(inside, engine);
  expect_sound(surface, engine.mesh());
  EXPECT_EQ(surface.greatest_distance(), 0);
  std::vector<Vec3> positions;
  surface.fill(engine.mesh(), positions);
  for (std::size_t i = 0; i < inside.points.size(); ++i) EXPECT_LT((positions[i] - inside.points[i]).norm(), 1e-14);
}

TEST(EmbeddedSurface, points_outside_keep_their_distance_when_the_body_turns) {
  Engine engine = make_engine(ball(6));
  const EmbeddedSurface surface = bind(fine_sphere(1.02, 16), engine);
  EXPECT_GT(surface.greatest_distance(), 0.02);
  EXPECT_LT(surface.greatest_distance(), 0.12);
  Mat3 turn;
  turn << 0, -1, 0, 0.6, 0, -0.8, 0.8, 0, 0.6;
  std::vector<Vec3> places;
  for (std::uint32_t v = 0; v < engine.mesh().vertex_slots(); ++v) {
    places.emplace_back(turn * engine.mesh().rest(VertexId(v)) + Vec3(1, 2, 3));
  }
  ASSERT_TRUE(engine.set_positions(places).ok());
  std::vector<Vec3> positions, normals;
  surface.fill(engine.mesh(), positions);
  surface.fill_normals(positions, normals);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_LT((positions[i] - (turn * surface.points()[i].rest + Vec3(1, 2, 3))).norm(), 1e-12);
    EXPECT_LT((normals[i] - turn * surface.points()[i].normal).norm(), 1e-12);
  }
}

TEST(EmbeddedSurface, a_cut_through_a_ball_parts_its_surface_in_two) {
  Engine engine = make_engine(ball(6), 0);
  FineSurface fine = fine_sphere(1, 24);
  add_linear_texture(fine);
  EmbeddedSurface surface = bind(fine, engine);
  cut(engine, plane(engine, Vec3(1, 0.2, 0.1), 0.13));
  follow(surface, engine);
  expect_sound(surface, engine.mesh());
  EXPECT_EQ(count_pieces(surface), 2U);
  EXPECT_EQ(count_between_pieces(surface, engine.mesh()), 0U);
  EXPECT_EQ(count_bridges(surface, engine.mesh(), 1e-3), 0U);
  EXPECT_GT(live_triangles(surface), fine.triangles.size() + 100);
  for (const FinePoint& p : surface.points()) {
    if (!p.is_live()) continue;
    const auto expected = linear_texture(p.rest);
    EXPECT_NEAR(p.texture[0], expected[0], 1e-12);
    EXPECT_NEAR(p.texture[1], expected[1], 1e-12);
    EXPECT_NEAR(p.normal.norm(), 1, 1e-12);
  }
}

TEST(EmbeddedSurface, a_wall_through_points_and_edges_of_the_surface_parts_it_cleanly) {
  Engine engine = make_engine(kuhn_cube(4));
  EmbeddedSurface surface = bind(fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 16), engine);
  const std::size_t before = live_triangles(surface);
  cut(engine, plane(engine, Vec3(1, 0, 0), 0.5));  // along edges of tets and of triangles
  follow(surface, engine);
  expect_sound(surface, engine.mesh());
  EXPECT_EQ(count_pieces(surface), 2U);
  EXPECT_EQ(count_between_pieces(surface, engine.mesh()), 0U);
  EXPECT_EQ(live_triangles(surface), before);
}

TEST(EmbeddedSurface, a_partial_cut_opens_the_surface_down_to_its_front) {
  Engine engine = make_engine(kuhn_cube(4), 0);
  EmbeddedSurface surface = bind(fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 24), engine);
  cut(engine, incision(0.53, 0.4));
  follow(surface, engine);
  expect_sound(surface, engine.mesh());
  EXPECT_EQ(count_pieces(surface), 1U);
  EXPECT_EQ(count_bridges(surface, engine.mesh(), 1e-3), 0U);
  double lowest = 1;
  for (const FineTriangle& t : surface.triangles()) {
    if (!t.is_live() || t.lips == 0) continue;
    for (const std::uint32_t p : t.points) lowest = std::min(lowest, surface.points()[p].rest.z());
  }
  EXPECT_GT(lowest, 0.4 - 2.0 / 24);
  EXPECT_LT(lowest, 0.4 + 2.0 / 24);
}

TEST(EmbeddedSurface, an_open_wound_is_not_bridged) {
  Engine engine = make_engine(kuhn_cube(4), 0);
  EmbeddedSurface surface = bind(fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 24), engine);
  cut(engine, incision(0.53, 0.4));
  follow(surface, engine);
  const TetMesh& mesh = engine.mesh();
  std::vector<Vec3> middle(mesh.vertex_slots(), Vec3::Zero());  // of the tets at each vertex
  mesh.for_each_tet([&](TetId tet) {
    for (const VertexId v : mesh.vertices(tet)) {
      for (const VertexId w : mesh.vertices(tet)) middle[v.value] += (mesh.rest(w) - mesh.rest(v)) / 4;
    }
  });
  std::vector<Vec3> places;
  for (std::uint32_t slot = 0; slot < mesh.vertex_slots(); ++slot) {
    Vec3 p = mesh.rest(VertexId(slot));
    const double side = std::abs(p.x() - 0.53) > 1e-9 ? p.x() - 0.53 : middle[slot].x();
    p.x() += std::max(p.z() - 0.4, 0.0) * (side > 0 ? 1 : -1);
    places.push_back(p);
  }
  ASSERT_TRUE(engine.set_positions(places).ok());
  std::vector<Vec3> positions;
  surface.fill(mesh, positions);
  for (const FineTriangle& t : surface.triangles()) {
    if (!t.is_live()) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t p = t.points[i], q = t.points[(i + 1) % 3];
      // Tets at the front alone shear by more than the opening per height.
      EXPECT_LT((positions[p] - positions[q]).norm(), 0.2);
    }
  }
}

TEST(EmbeddedSurface, cuts_that_cross_part_it_in_four) {
  Engine engine = make_engine(jittered_cube(4, 3), 0);
  EmbeddedSurface surface = bind(fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 20), engine);
  cut(engine, plane(engine, Vec3(1, 0.1, 0.05), 0.53));
  follow(surface, engine);
  cut(engine, plane(engine, Vec3(-0.1, 1, 0.07), 0.47));
  follow(surface, engine);
  expect_sound(surface, engine.mesh());
  EXPECT_EQ(count_between_pieces(surface, engine.mesh()), 0U);
  EXPECT_GE(count_pieces(surface), 4U);
  EXPECT_EQ(content_of(surface), content_of(bind(surface.source(), engine)));
}

TEST(EmbeddedSurface, undo_and_redo_restore_it_bit_for_bit) {
  Engine engine = make_maintaining_engine(jittered_cube(4, 5));
  FineSurface fine = fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 20);
  add_linear_texture(fine);
  EmbeddedSurface surface = bind(fine, engine);
  std::vector<Snapshot> states = {Snapshot(surface)};
  for (const Stroke& stroke : {incision(0.53, 0.4), plane(engine, Vec3(0, 1, 0.1), 0.61), incision(0.31, 0.7)}) {
    ASSERT_TRUE(engine.cut(stroke).ok());
    follow(surface, engine);
    states.emplace_back(surface);
  }
  for (std::size_t i = states.size() - 1; i-- > 0;) {
    ASSERT_TRUE(engine.undo());
    follow(surface, engine);
    expect_same(Snapshot(surface), states[i]);
  }
  for (std::size_t i = 1; i < states.size(); ++i) {
    ASSERT_TRUE(engine.redo());
    follow(surface, engine);
    expect_same(Snapshot(surface), states[i]);
  }
  ASSERT_TRUE(engine.undo());
  ASSERT_TRUE(engine.undo());
  ASSERT_TRUE(engine.cut(incision(0.7, 0.2)).ok());  // another stroke in the place of those
  follow(surface, engine);
  expect_sound(surface, engine.mesh());
  EXPECT_EQ(content_of(surface), content_of(bind(fine, engine)));
}

TEST(EmbeddedSurface, it_depends_on_the_mesh_and_not_on_the_way_there) {
  Engine engine = make_maintaining_engine(jittered_cube(4, 6));
  EmbeddedSurface eager = bind(fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 16), engine);
  EmbeddedSurface lazy = bind(fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 16), engine);
  const Stroke stroke = incision(0.53, 0.3, 12);
  ASSERT_TRUE(engine.begin_stroke({stroke.edges.front()}).ok());
  for (std::size_t i = 1; i < stroke.edges.size(); ++i) {
    ASSERT_TRUE(engine.step({stroke.edges[i]}).ok());
    follow(eager, engine);
    expect_sound(eager, engine.mesh());
  }
  ASSERT_TRUE(engine.end_stroke().ok());
  follow(eager, engine);
  follow(lazy, engine);
  EXPECT_EQ(content_of(eager), content_of(lazy));
  EXPECT_EQ(content_of(eager), content_of(bind(eager.source(), engine)));
  ASSERT_TRUE(engine.undo());
  follow(eager, engine);
  follow(lazy, engine);
  EXPECT_EQ(live_triangles(eager), eager.source().triangles.size());
  EXPECT_EQ(content_of(eager), content_of(lazy));
}

TEST(EmbeddedSurface, seams_of_the_texture_stay_shut) {
  Engine engine = make_engine(ball(6), 0);
  FineSurface fine = fine_sphere(1.01, 20);
  add_linear_texture(fine);
  const std::size_t n = fine.points.size();  // every point twice: one for triangles above, one for those below
  fine.points.insert(fine.points.end(), fine.points.begin(), fine.points.begin() + static_cast<std::ptrdiff_t>(n));
  fine.texture.insert(fine.texture.end(), fine.texture.begin(), fine.texture.begin() + static_cast<std::ptrdiff_t>(n));
  for (auto& t : fine.triangles) {
    if ((fine.points[t[0]] + fine.points[t[1]] + fine.points[t[2]]).z() > 0) continue;
    for (std::uint32_t& p : t) p += static_cast<std::uint32_t>(n);
  }
  EmbeddedSurface surface = bind(fine, engine);
  cut(engine, plane(engine, Vec3(1, 0.2, 0.1), 0.13));
  follow(surface, engine);
  expect_sound(surface, engine.mesh());
  EXPECT_EQ(count_pieces(surface), 4U);
  EXPECT_EQ(count_between_pieces(surface, engine.mesh()), 0U);
}

TEST(EmbeddedSurface, random_strokes_leave_no_bridge_and_lose_no_area) {
  // Of three by day one: balls and cubes, maintained and not, undone and not.
  for (std::uint64_t seed = of_campaign(3U, 1U); seed <= 24; seed += of_campaign(3U, 1U)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const bool is_ball = seed % 2 == 0, is_maintained = seed > 12;
    TetSoup soup = is_ball ? ball(6) : jittered_cube(5, seed);
    Engine engine = is_maintained ? make_maintaining_engine(soup) : make_engine(soup);
    const FineSurface fine = is_ball ? fine_sphere(1 + 0.01 * static_cast<double>(seed % 3), 20)
                                     : fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 20);
    EmbeddedSurface surface = bind(fine, engine);
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(engine.cut(random_incision(random, rest_bounds(engine.mesh()))).ok());
      follow(surface, engine);
      if (i == 1 && seed % 5 == 0 && engine.undo()) follow(surface, engine);
    }
    expect_sound(surface, engine.mesh());
    EXPECT_EQ(content_of(surface), content_of(bind(fine, engine)));
    EXPECT_EQ(count_between_pieces(surface, engine.mesh()), 0U);
    EXPECT_EQ(count_torn(surface, engine.mesh()), 0U);
    if (!is_maintained && !is_ball) {  // beyond the skin of a ball a wall goes on at a right angle to the skin
      EXPECT_EQ(count_bridges(surface, engine.mesh(), 0.2), 0U);
    }
  }
}

TEST(EmbeddedSurface, a_step_costs_what_it_touched) {
  std::array<std::size_t, 2> most{};
  for (const std::uint32_t size : {1U, 2U}) {
    // The same blade, tets and triangles, on a body eight times as large.
    TetSoup soup = kuhn_box(Vec3(0, 0, 0), Vec3::Constant(size), {8 * size, 8 * size, 8 * size});
    Engine engine = make_maintaining_engine(soup);
    EmbeddedSurface surface = bind(fine_box(Vec3(0, 0, 0), Vec3::Constant(size), 24 * size), engine);
    const double top = size;
    std::size_t& looked_at = most[size - 1];
    ASSERT_TRUE(engine.begin_stroke({{Vec3(0.53, 0.2, top + 0.1), Vec3(0.53, 0.2, top - 0.15)}}).ok());
    for (int i = 1; i <= 20; ++i) {
      const double y = 0.2 + 0.02 * i;
      ASSERT_TRUE(engine.step({{Vec3(0.53, y, top + 0.1), Vec3(0.53, y, top - 0.15)}}).ok());
      follow(surface, engine);
      looked_at = std::max(looked_at, surface.looked_at());
    }
    ASSERT_TRUE(engine.end_stroke().ok());
  }
  EXPECT_GT(most[0], 0U);
  EXPECT_LE(most[1], most[0] * 3 / 2);
}

TEST(EmbeddedSurface, what_is_wrong_with_a_surface_is_said) {
  const Engine engine = make_engine(kuhn_cube(2));
  const auto message = [&](const FineSurface& surface) {
    const Result<EmbeddedSurface> bound = EmbeddedSurface::bind(surface, engine.mesh());
    return bound.ok() ? std::string() : bound.error().message;
  };
  EXPECT_NE(message({}).find("no triangles"), std::string::npos);
  FineSurface fine = fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 2);
  FineSurface far = fine;
  for (Vec3& p : far.points) p.x() += 30;
  EXPECT_NE(message(far).find("outside the mesh"), std::string::npos);
  FineSurface short_texture = fine;
  short_texture.texture.resize(3);
  EXPECT_NE(message(short_texture).find("texture coordinates for 3"), std::string::npos);
  FineSurface out_of_range = fine;
  out_of_range.triangles[4][1] = 9999;
  EXPECT_NE(message(out_of_range).find("triangle 4"), std::string::npos);
  FineSurface endless = fine;
  endless.points[1].y() = std::numeric_limits<double>::infinity();
  EXPECT_NE(message(endless).find("point 1"), std::string::npos);
}

TEST(EmbeddedSurface, history_that_was_trimmed_away_is_told) {
  Engine engine = make_maintaining_engine(kuhn_cube(4));
  ASSERT_TRUE(engine.keep_undo(1).ok());
  EmbeddedSurface surface = bind(fine_box(Vec3(0, 0, 0), Vec3(1, 1, 1), 8), engine);
  ASSERT_TRUE(engine.cut(incision(0.53, 0.4)).ok());
  ASSERT_TRUE(engine.cut(incision(0.3, 0.4)).ok());
  const Status status = surface.follow(engine.journal(), engine.mesh());
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("bind it anew"), std::string::npos);
}

}  // namespace
}  // namespace incise::test::embedded_surface_test
