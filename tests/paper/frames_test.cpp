// SPDX-License-Identifier: Apache-2.0
// The paper's cut frame by frame, in the body as it stands: the same pieces however often the blade is looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "incise/mesh/quality_stats.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/sections.h"
#include "support/strokes.h"

namespace incise::test::frames_test {
namespace {

/// Where a point of the body stands at a share of the stroke's time, and where a blade must be to meet it there.
using Place = std::function<Vec3(const Vec3& rest, double time)>;

Vec3 at_rest(const Vec3& rest, double) {
  return rest;
}
/// The whole body is carried along and turned; a blade at the same place of the world cuts another place of the body.
Vec3 carried(const Vec3& rest, double time) {
  const double c = (1.0 - 0.04 * time * time) / (1.0 + 0.04 * time * time), s = 0.4 * time / (1.0 + 0.04 * time * time);
  return {c * rest.x() - s * rest.y() + 0.3 + 0.2 * time, s * rest.x() + c * rest.y() - 0.1 * time, rest.z() + 0.5};
}
/// Stretched and sheared, more and more: each tet stands otherwise than at rest.
Vec3 sheared(const Vec3& rest, double time) {
  return {rest.x() * (1.1 + 0.2 * time) + 0.3 * rest.z(), rest.y() + 0.2 * time * rest.x(),
          rest.z() * (1 - 0.1 * time)};
}

/// Swept sideways, in a wave: no plane of the world is one of the body.
Vec3 waving(const Vec3& rest, double time) {
  const double w = rest.z() - 0.5 + 0.4 * rest.y();
  return {rest.x() + (0.2 + 0.5 * time) * w * (1 - w * w), rest.y(), rest.z()};
}

void move(Engine& engine, const Place& place, double time) {
  const TetMesh& mesh = engine.mesh();
  std::vector<Vec3> positions(mesh.vertex_slots(), Vec3::Zero());
  mesh.for_each_vertex([&](VertexId v) { positions[v.value] = place(mesh.rest(v), time); });
  ASSERT_TRUE(engine.set_positions(positions).ok());
}

/// A blade's edge at a share of its way, in the body at rest.
using Blade = std::function<std::vector<Vec3>(double time)>;

/// In the plane x = d, along y from below to above.
Blade straight(double d) {
  return [d](double t) { return std::vector<Vec3>{Vec3(d, -0.2, -0.2 + 1.4 * t), Vec3(d, 1.2, -0.2 + 1.4 * t)}; };
}
Blade oblique() {
  return [](double t) {
    const Vec3 along(0.2, 1.0, 0.1), way(-0.15, 0.02, 1.0);
    const Vec3 start = Vec3(0.57, 0.5, 0.5) - 0.85 * way + 1.7 * t * way;
    return std::vector<Vec3>{Vec3(start - 0.9 * along), Vec3(start + 0.9 * along)};
  };
}
/// Bends by a fifth of the body on its way.
Blade curved() {
  return [](double t) {
    const double z = -0.2 + 1.4 * t, x = 0.4 + 0.8 * (t - t * t);
    return std::vector<Vec3>{Vec3(x, -0.2, z), Vec3(x, 1.2, z)};
  };
}

/// A ring with as many corners, around the middle of the cube, pushed through it from below.
Blade ring(unsigned corners, double radius, double turned) {
  return [=](double t) {
    std::vector<Vec3> edge;
    for (unsigned k = 0; k <= corners; ++k) {
      const double angle = turned + 2 * std::numbers::pi * (k % corners) / corners;
      edge.emplace_back(0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle), -0.2 + 1.4 * t);
    }
    return edge;
  };
}

/// A straight edge that is led once round an axis through the middle of the cube.
Blade round(const Vec3& axis, double radius) {
  return [=](double t) {
    const Vec3 n = axis.normalized(), a = n.cross(Vec3::UnitX()).normalized(), b = n.cross(a);
    const double angle = t < 1 ? 2 * std::numbers::pi * t : 0;
    const Vec3 middle = Vec3(0.5, 0.5, 0.5) + radius * (std::cos(angle) * a + std::sin(angle) * b);
    return std::vector<Vec3>{Vec3(middle - 2 * n), Vec3(middle + 2 * n)};
  };
}

/// Cuts in `frames` frames of as many strokes as `strokes`, through the body as it stands.
Engine cut_in_frames(TetSoup soup, const Blade& blade, const Place& place, unsigned frames, unsigned strokes,
                     bool maintains) {
  EngineOptions options;
  options.cut.profile = Profile::kPaper;
  options.maintain.merge = options.maintain.improve = maintains;
  Engine engine = Engine::create(build(std::move(soup)), options).value();
  const double volume = volume_of(engine.mesh());
  const auto pose = [&](double time) {
    BladePose stands;
    for (const Vec3& point : blade(time)) stands.edge.push_back(place(point, time));
    return stands;
  };
  const unsigned parts = frames * strokes;
  for (unsigned i = 0; i < parts; ++i) {
    const double before = static_cast<double>(i) / parts, now = static_cast<double>(i + 1) / parts;
    move(engine, place, before);
    if (i % frames == 0) {
      EXPECT_TRUE(engine.begin_stroke(pose(before)).ok());
    }
    move(engine, place, now);
    EXPECT_TRUE(engine.step(pose(now)).ok());
    expect_valid(engine.mesh(), volume, maintains ? 1e-2 : 1e-12);
    if (i % frames == frames - 1) {
      EXPECT_TRUE(engine.end_stroke().ok());
    }
  }
  expect_valid(engine.mesh(), volume, maintains ? 1e-2 : 1e-12);
  return engine;
}

constexpr std::pair<unsigned, unsigned> kFramesAndStrokes[] = {{1, 1},  {2, 1}, {4, 1},  {7, 1}, {14, 1}, {28, 1},
                                                               {70, 1}, {1, 2}, {1, 4},  {1, 7}, {1, 14}, {1, 28},
                                                               {5, 14}, {2, 2}, {10, 7}, {3, 28}};

TEST(PaperFrames, cut_the_papers_cube_to_1300_tets_in_any_number_of_frames_and_strokes) {
  for (const bool maintains : {false, true}) {
    for (const auto& [frames, strokes] : kFramesAndStrokes) {
      SCOPED_TRACE(testing::Message() << frames << " frames, " << strokes << " strokes, maintains " << maintains);
      const Engine engine = cut_in_frames(kuhn_cube(5), straight(0.5), at_rest, frames, strokes, maintains);
      EXPECT_EQ(engine.mesh().tet_count(), 1300U);
      expect_pieces(engine.mesh(), {0.5, 0.5}, 1e-12);
    }
  }
}

TEST(PaperFrames, merge_nothing_that_smoothing_beside_a_front_has_made_thin) {
  const Blade along_x = [](double t) {
    return std::vector<Vec3>{Vec3(2 * t - 0.5, 0.5, -0.5), Vec3(2 * t - 0.5, 0.5, 1.5)};
  };
  for (const unsigned frames : {4U, 28U}) {
    for (const unsigned strokes : {2U, 4U, 7U}) {
      SCOPED_TRACE(testing::Message() << frames << " frames, " << strokes << " strokes");
      const Engine engine = cut_in_frames(kuhn_cube(5), along_x, at_rest, frames, strokes, true);
      EXPECT_EQ(engine.mesh().tet_count(), 1300U);
      expect_pieces(engine.mesh(), {0.5, 0.5}, 1e-12);
    }
  }
}

/// The plane that `oblique` sweeps: normal · x = offset.
struct SweptPlane {
  Vec3 normal;
  double offset;
};
SweptPlane plane_of_oblique() {
  const Vec3 normal = Vec3(0.2, 1.0, 0.1).cross(Vec3(-0.15, 0.02, 1.0)).normalized();
  return {normal, normal.dot(Vec3(0.57, 0.5, 0.5))};
}

/// Where the edges of a body cross a plane, one place for each edge; of edges and ends alone.
std::vector<Vec3> find_crossings(const TetSoup& soup, const SweptPlane& plane) {
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const auto& tet : soup.tets) {
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned j = 0; j < 4; ++j) {
        if (tet[i] < tet[j]) edges.insert({tet[i], tet[j]});
      }
    }
  }
  std::vector<Vec3> places;
  for (const auto& [i, j] : edges) {
    const Vec3 &a = soup.points[i], &b = soup.points[j];
    const double from = plane.normal.dot(a) - plane.offset, to = plane.normal.dot(b) - plane.offset;
    if (from * to < 0) places.emplace_back(a + from / (from - to) * (b - a));
  }
  return places;
}

/// The vertices of the body that it had not before, at their places.
std::vector<Vec3> find_new_places(const TetMesh& mesh, std::size_t before) {
  std::vector<Vec3> places;
  mesh.for_each_vertex([&](VertexId v) {
    if (v.value >= before) places.push_back(mesh.rest(v));
  });
  return places;
}

std::size_t count_near(const std::vector<Vec3>& places, const Vec3& place) {
  return static_cast<std::size_t>(
      std::count_if(places.begin(), places.end(), [&](const Vec3& p) { return (p - place).norm() < 1e-9; }));
}

/// Each edge that the blade crosses has its collision point there, one for either lip, and nothing else has one.
void expect_collision_points(const TetSoup& soup, const TetMesh& mesh, const SweptPlane& plane) {
  const std::vector<Vec3> expected = find_crossings(soup, plane);
  const std::vector<Vec3> found = find_new_places(mesh, soup.points.size());
  EXPECT_GT(expected.size(), 80U);
  EXPECT_EQ(found.size(), 2 * expected.size());
  for (const Vec3& place : expected) EXPECT_EQ(count_near(found, place), 2U) << place.transpose();
}

TEST(PaperFrames, divide_edges_where_the_blade_crosses_them_and_nowhere_else) {
  const TetSoup soup = jittered_cube(4, 2);
  for (const auto& [frames, strokes] : kFramesAndStrokes) {
    SCOPED_TRACE(testing::Message() << frames << " frames, " << strokes << " strokes");
    const Engine straight_cut = cut_in_frames(soup, straight(0.43), at_rest, frames, strokes, false);
    expect_collision_points(soup, straight_cut.mesh(), {Vec3(1, 0, 0), 0.43});
    expect_pieces(straight_cut.mesh(), {0.43, 0.57}, 1e-9);
    const Engine oblique_cut = cut_in_frames(soup, oblique(), at_rest, frames, strokes, false);
    expect_collision_points(soup, oblique_cut.mesh(), plane_of_oblique());
  }
}

/// Calls `visit` with the corners of each face of the walls.
void for_each_wall(const TetMesh& mesh, const std::function<void(const std::array<Vec3, 3>&)>& visit) {
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (!link.is_boundary() || link.tag() == 0) continue;
      const auto v = mesh.vertices(Side(tet, s));
      visit({mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2])});
    }
  });
}

/// Figure 3: "a complete collection of incision faces that approximates the tool trajectory". Of a plane they are all
/// of its section through the body, and nothing beside it.
TEST(PaperFrames, open_faces_that_make_up_the_plane_of_the_sweep) {
  const SweptPlane plane = plane_of_oblique();
  const Section section = section_of_unit_cube(plane.normal, plane.offset);
  for (const std::uint64_t seed : {3U, 4U}) {
    for (const auto& [frames, strokes] : kFramesAndStrokes) {
      SCOPED_TRACE(testing::Message() << frames << " frames, " << strokes << " strokes, seed " << seed);
      const Engine engine = cut_in_frames(jittered_cube(5, seed), oblique(), at_rest, frames, strokes, false);
      for_each_wall(engine.mesh(), [&](const std::array<Vec3, 3>& face) {
        for (const Vec3& corner : face) EXPECT_NEAR(plane.normal.dot(corner), plane.offset, 1e-9);
      });
      EXPECT_NEAR(wall_area(engine.mesh()), section.area, 1e-9);
      expect_pieces(engine.mesh(), {section.volume, 1 - section.volume}, 1e-9);
    }
  }
}

/// Of a bent sweep their corners lie on it, and seen along x, which it nowhere hides, they cover the body once.
TEST(PaperFrames, open_faces_that_approximate_a_bent_sweep) {
  for (const unsigned frames : {28U, 70U}) {
    SCOPED_TRACE(frames);
    const Engine engine = cut_in_frames(jittered_cube(5, 3), curved(), at_rest, frames, 1, false);
    const Blade bent = curved();
    double covered = 0, off = 0;
    for_each_wall(engine.mesh(), [&](const std::array<Vec3, 3>& face) {
      covered += 0.25 * std::abs((face[1] - face[0]).cross(face[2] - face[0]).x());  // of one of two lips
      for (const Vec3& corner : face) {
        const double step = (corner.z() + 0.2) / 1.4 * frames, along = step - std::floor(step);
        const double from = bent(std::floor(step) / frames)[0].x(), to = bent((std::floor(step) + 1) / frames)[0].x();
        off = std::max(off, std::abs(corner.x() - (from + along * (to - from))));
      }
    });
    EXPECT_LT(off, 1e-9);
    EXPECT_NEAR(covered, 1, 1e-9);
  }
}

TEST(PaperFrames, cut_a_body_that_has_moved_where_it_stands) {
  // The blade stands at x = 0.8 of the world, which is the middle of a body that was moved by 0.3.
  const Place moved = [](const Vec3& rest, double) { return Vec3(rest + Vec3(0.3, 0, 0)); };
  for (const unsigned frames : {1U, 4U, 28U}) {
    SCOPED_TRACE(frames);
    const Engine engine = cut_in_frames(kuhn_cube(5), straight(0.5), moved, frames, 1, true);
    expect_pieces(engine.mesh(), {0.5, 0.5}, 1e-6);
    EXPECT_EQ(engine.mesh().tet_count(), 1300U);
  }
}

TEST(PaperFrames, give_the_same_pieces_at_rest) {
  std::vector<double> pieces;
  for (const auto& [frames, strokes] : kFramesAndStrokes) {
    SCOPED_TRACE(testing::Message() << frames << " frames, " << strokes << " strokes");
    const Engine engine = cut_in_frames(jittered_cube(5, 3), oblique(), at_rest, frames, strokes, false);
    if (pieces.empty()) pieces = piece_volumes(engine.mesh());
    ASSERT_EQ(pieces.size(), 2U);
    expect_pieces(engine.mesh(), pieces, 1e-9);
  }
}

TEST(PaperFrames, give_the_same_pieces_along_a_curve) {
  std::vector<double> pieces;
  for (const auto& [frames, strokes] : kFramesAndStrokes) {
    if (frames * strokes < 28) continue;  // another surface
    SCOPED_TRACE(testing::Message() << frames << " frames, " << strokes << " strokes");
    const Engine engine = cut_in_frames(jittered_cube(5, 3), curved(), at_rest, frames, strokes, false);
    if (pieces.empty()) pieces = piece_volumes(engine.mesh());
    ASSERT_EQ(pieces.size(), 2U);
    expect_pieces(engine.mesh(), pieces, 2e-3);
  }
}

TEST(PaperFrames, take_the_core_out_where_an_edge_is_led_round_it) {
  constexpr std::pair<unsigned, unsigned> kWays[] = {{28, 1}, {70, 1}, {7, 4}, {1, 28}};
  for (const auto& [frames, strokes] : kWays) {
    for (const bool maintains : {false, true}) {
      SCOPED_TRACE(testing::Message() << frames << " frames, " << strokes << " strokes, " << maintains);
      const Engine engine = cut_in_frames(kuhn_cube(5), round({1, 2, 3}, 0.31), at_rest, frames, strokes, maintains);
      EXPECT_EQ(piece_volumes(engine.mesh()).size(), 2U);
    }
  }
}

TEST(PaperFrames, give_the_same_pieces_in_a_body_that_stands_otherwise) {
  for (const Blade& blade : {straight(0.5), oblique()}) {
    const Engine rest = cut_in_frames(jittered_cube(5, 3), blade, at_rest, 28, 1, false);
    const Place stands = [](const Vec3& p, double) { return sheared(carried(p, 0.7), 0.6); };
    for (const auto& [frames, strokes] : kFramesAndStrokes) {
      SCOPED_TRACE(testing::Message() << frames << " frames, " << strokes << " strokes");
      const Engine engine = cut_in_frames(jittered_cube(5, 3), blade, stands, frames, strokes, false);
      expect_pieces(engine.mesh(), piece_volumes(rest.mesh()), 2e-3);
    }
  }
}

TEST(PaperFrames, are_maintained_in_a_body_that_moves_as_at_rest) {
  for (const Blade& blade : {straight(0.47), oblique(), curved()}) {
    const Engine rest = cut_in_frames(jittered_cube(5, 3), blade, at_rest, 28, 1, true);
    const Engine moved = cut_in_frames(jittered_cube(5, 3), blade, waving, 28, 1, true);
    const Engine raw = cut_in_frames(jittered_cube(5, 3), blade, waving, 28, 1, false);
    EXPECT_LT(moved.mesh().tet_count(), 1.1 * static_cast<double>(rest.mesh().tet_count()));
    EXPECT_LT(measure_quality(moved.mesh()).lr_mean, 0.7 * measure_quality(raw.mesh()).lr_mean);
  }
}

TEST(PaperFrames, give_the_same_pieces_in_a_body_that_moves) {
  for (const Place& place : {Place(carried), Place(sheared)}) {
    for (const bool maintains : {false, true}) {
      const Engine rest = cut_in_frames(jittered_cube(5, 3), oblique(), at_rest, 28, 1, maintains);
      for (const auto& [frames, strokes] : kFramesAndStrokes) {
        SCOPED_TRACE(testing::Message() << frames << " frames, " << strokes << " strokes, maintains " << maintains);
        const Engine engine = cut_in_frames(jittered_cube(5, 3), oblique(), place, frames, strokes, maintains);
        ASSERT_EQ(piece_volumes(engine.mesh()).size(), 2U);
        // In a few frames the body moves far in each, under a blade that stands still meanwhile: another surface.
        if (frames * strokes >= 28) expect_pieces(engine.mesh(), piece_volumes(rest.mesh()), 0.02);
      }
    }
  }
}

TEST(PaperFrames, take_out_the_core_that_an_edge_with_corners_is_pushed_round) {
  unsigned crumbs = 0;
  for (unsigned corners = 3; corners <= 6; ++corners) {
    for (const double radius : {0.25, 0.37}) {
      const double core = 0.5 * corners * radius * radius * std::sin(2 * std::numbers::pi / corners);
      for (const unsigned frames : {1U, 4U, 10U, 28U}) {
        SCOPED_TRACE(testing::Message() << corners << " corners, radius " << radius << ", frames " << frames);
        const Engine engine = cut_in_frames(jittered_cube(5, 1), ring(corners, radius, 0.7), at_rest, frames, 1, false);
        const std::vector<double> pieces = piece_volumes(engine.mesh());  // ascending
        ASSERT_GE(pieces.size(), 2U);
        EXPECT_NEAR(pieces[pieces.size() - 2], core, 0.08 * core);
        crumbs += static_cast<unsigned>(pieces.size() - 2);
      }
    }
  }
  EXPECT_LE(crumbs, 1U) << "at the tips of acute corners";
}

TEST(PaperFrames, make_no_slivers_without_end_where_a_leaning_blade_jumps_across_its_own_way) {
  const std::vector<std::vector<Vec3>> rows = {{{1.098, 0.24, -0.195}, {1.127, 0.235, 1.232}},
                                               {{0.036, 0.031, -0.197}, {0.069, 0.012, 1.237}},
                                               {{0.733, 0.14, -0.203}, {0.778, 0.151, 1.164}},
                                               {{0.571, 0.701, -0.183}, {0.615, 0.695, 1.173}},
                                               {{0.343, 0.192, -0.204}, {0.322, 0.219, 1.217}}};
  const Blade jumps = [&](double t) { return rows[static_cast<std::size_t>(std::lround(4 * t))]; };
  for (const std::uint32_t n : {8U, 12U}) {
    TetSoup soup = jittered_cube(n, 1);
    const std::size_t before = soup.tets.size();
    const Engine engine = cut_in_frames(std::move(soup), jumps, at_rest, 4, 1, false);
    EXPECT_LT(engine.mesh().tet_count(), 2 * before);
  }
}

}  // namespace
}  // namespace incise::test::frames_test
