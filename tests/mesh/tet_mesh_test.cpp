// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/tet_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "incise/mesh/defects.h"
#include "incise/mesh/star.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::tet_mesh_test {
namespace {

TetSoup one_tet() {
  TetSoup soup;
  soup.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  soup.tets = {{0, 1, 2, 3}};
  return soup;
}

TEST(TetMesh, of_one_tet_is_all_boundary) {
  const TetMesh mesh = build(one_tet());
  EXPECT_EQ(mesh.tet_count(), 1U);
  EXPECT_EQ(mesh.vertex_count(), 4U);
  for (unsigned s = 0; s < 4; ++s) EXPECT_EQ(mesh.link(Side(TetId(0), s)), Link::boundary(0));
  for (std::uint32_t v = 0; v < 4; ++v) {
    EXPECT_EQ(mesh.tet_of(VertexId(v)), TetId(0));
    EXPECT_EQ(mesh.shape_of(VertexId(v)), shape::kSkin);
    EXPECT_EQ(mesh.origin(VertexId(v)), VertexId(v));
  }
  EXPECT_EQ(mesh.rest_volume(TetId(0)), 1 / 6.0);
  expect_valid(mesh, 1 / 6.0);
}

TEST(TetMesh, sides_turn_counter_clockwise_seen_from_outside) {
  const TetMesh mesh = build(one_tet());
  for (unsigned s = 0; s < 4; ++s) {
    const auto v = mesh.vertices(Side(TetId(0), s));
    const Vec3 normal = (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0]));
    EXPECT_LT(normal.dot(mesh.rest(mesh.vertices(TetId(0))[s]) - mesh.rest(v[0])), 0.0);
  }
  expect_valid(mesh, 1 / 6.0);
}

TEST(TetMesh, links_equal_those_found_by_comparing_all_faces) {
  const TetMesh mesh = build(kuhn_cube(3));
  std::map<std::set<std::uint32_t>, std::vector<Side>> faces;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const auto v = mesh.vertices(Side(tet, s));
      faces[{v[0].value, v[1].value, v[2].value}].push_back(Side(tet, s));
    }
  });
  for (const auto& [vertices, sides] : faces) {
    if (sides.size() == 1) {
      EXPECT_TRUE(mesh.link(sides[0]).is_boundary());
    } else {
      ASSERT_EQ(sides.size(), 2U);
      EXPECT_EQ(mesh.link(sides[0]), Link(sides[1]));
      EXPECT_EQ(mesh.link(sides[1]), Link(sides[0]));
    }
  }
  expect_valid(mesh, 1.0);
}

TEST(TetMesh, tells_skin_from_inner_vertices) {
  const TetMesh mesh = build(kuhn_cube(4));
  mesh.for_each_vertex([&](VertexId v) {
    const Vec3& p = mesh.rest(v);
    const bool is_on_skin = (p.array() == 0).any() || (p.array() == 1).any();
    EXPECT_EQ(mesh.shape_of(v), is_on_skin ? shape::kSkin : 0);
  });
  EXPECT_FALSE(mesh.touched_itself_at_load());
  expect_valid(mesh, 1.0);
}

TEST(TetMesh, of_two_tets_that_touch_at_a_vertex_marks_it_pinched) {
  TetSoup soup = one_tet();
  soup.points.insert(soup.points.end(), {Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)});
  soup.tets.push_back({0, 5, 4, 6});
  normalise(soup);
  const TetMesh mesh = build(soup);
  EXPECT_NE(mesh.shape_of(VertexId(0)) & shape::kPinched, 0);
  EXPECT_EQ(mesh.shape_of(VertexId(1)) & shape::kPinched, 0);
  EXPECT_TRUE(mesh.touched_itself_at_load());
  EXPECT_EQ(validate(mesh, ValidateLevel::kGeometry).count(ViolationKind::kSingletonVertex), 1U);
}

TEST(TetMesh, of_three_tets_on_one_face_links_none_of_them_there) {
  TetSoup soup = one_tet();
  soup.points.insert(soup.points.end(), {Vec3(0.2, 0.2, -1), Vec3(0.1, 0.1, 2)});
  soup.tets.push_back({0, 2, 1, 4});
  soup.tets.push_back({0, 1, 2, 5});
  const TetMesh mesh = build(soup);
  for (std::uint32_t t = 0; t < 3; ++t) EXPECT_EQ(mesh.link(Side(TetId(t), 3)), Link::boundary(0));
  EXPECT_EQ(validate(mesh, ValidateLevel::kGeometry).count(ViolationKind::kOversharedFace), 1U);
}

TEST(TetMesh, keeps_points_without_tets) {
  TetSoup soup = one_tet();
  soup.points.emplace_back(5, 5, 5);
  const TetMesh mesh = build(soup);
  EXPECT_EQ(mesh.vertex_count(), 5U);
  EXPECT_FALSE(mesh.tet_of(VertexId(4)).is_valid());
  StarWalker walker;
  EXPECT_TRUE(walker.star(mesh, VertexId(4)).empty());
}

TEST(TetMesh, refuses_soups_that_break_its_promises) {
  TetSoup soup = one_tet();
  soup.tets.push_back({0, 1, 2, 9});
  EXPECT_EQ(TetMesh::build(soup).error().code, ErrorCode::kBadArgument);
  soup = one_tet();
  soup.points[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(TetMesh::build(soup).error().code, ErrorCode::kBadArgument);
  soup = one_tet();
  soup.points[2].y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(TetMesh::build(soup).error().code, ErrorCode::kBadArgument);
}

TEST(TetMesh, refuses_inverted_tets_and_says_what_to_do) {
  TetSoup soup = kuhn_cube(2);
  for (const std::size_t tet : {5U, 9U}) std::swap(soup.tets[tet][0], soup.tets[tet][1]);
  const Result<TetMesh> mesh = TetMesh::build(soup);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().code, ErrorCode::kBadArgument);
  EXPECT_EQ(mesh.error().ids, std::vector<std::uint64_t>{5});
  EXPECT_NE(mesh.error().message.find("tet 5 is inverted"), std::string::npos);
  EXPECT_NE(mesh.error().message.find("normalise()"), std::string::npos);
  normalise(soup);
  expect_valid(build(soup), 1.0);
}

TEST(TetMesh, tags_the_sides_that_walls_name_and_marks_their_vertices) {
  TetSoup soup = one_tet();
  soup.walls = {{{2, 0, 1}, 3}, {{0, 1, 2}, 3}};  // the same face twice is one wall
  const TetMesh mesh = build(soup);
  EXPECT_EQ(mesh.link(Side(TetId(0), 3)), Link::boundary(3));
  for (unsigned s = 0; s < 3; ++s) EXPECT_EQ(mesh.link(Side(TetId(0), s)), Link::boundary(0));
  for (std::uint32_t v = 0; v < 3; ++v) EXPECT_EQ(mesh.shape_of(VertexId(v)), shape::kSkin | shape::kWall);
  EXPECT_EQ(mesh.shape_of(VertexId(3)), shape::kSkin);
  expect_valid(mesh, 1 / 6.0);
}

TEST(TetMesh, passes_walls_over_that_are_no_boundary_or_two) {
  TetSoup soup = one_tet();
  soup.points.emplace_back(1, 1, 1.5);
  soup.points.emplace_back(0.2, 0.2, -1);
  soup.points.emplace_back(0.1, 0.1, 2);
  soup.tets.push_back({1, 2, 3, 4});
  soup.walls = {{{1, 2, 3}, 1}, {{0, 1, 4}, 1}, {{0, 1, 3}, 1}, {{0, 1, 3}, 2}};
  const TetMesh plain = build([&] {
    auto s = soup;
    return s.walls.clear(), s;
  }());
  EXPECT_EQ(build(soup).hash(), plain.hash());
  soup.tets.push_back({0, 2, 1, 5});  // three tets on one face
  soup.tets.push_back({0, 1, 2, 6});
  soup.walls = {{{0, 1, 2}, 1}};
  EXPECT_EQ(build(soup).link(Side(TetId(0), 3)), Link::boundary(0));
}

TEST(TetMesh, takes_origins_and_fronts_from_its_input) {
  TetSoup soup = one_tet();
  soup.origins = {7, -1, 0, 1000};
  soup.walls = {{{0, 1, 2}, 1}};
  soup.fronts = {0, 0, 1, 0};
  const TetMesh mesh = build(soup);
  EXPECT_EQ(mesh.origin(VertexId(0)), VertexId(7));
  EXPECT_FALSE(mesh.origin(VertexId(1)).is_valid());
  EXPECT_EQ(mesh.origin(VertexId(3)), VertexId(1000));
  EXPECT_EQ(mesh.shape_of(VertexId(2)), shape::kSkin | shape::kWall | shape::kFront);
  EXPECT_EQ(mesh.shape_of(VertexId(1)), shape::kSkin | shape::kWall);
}

// A thin wedge of material has walls that lie on one another, too, but nothing all around its edge.
TEST(TetMesh, sees_no_front_at_the_edge_of_a_thin_wedge) {
  TetSoup soup;
  soup.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 1, 0.01)};
  soup.tets = {{0, 1, 2, 3}};
  soup.walls = {{{0, 1, 2}, 1}, {{0, 1, 3}, 1}};
  const TetMesh mesh = build(soup);
  for (std::uint32_t v = 0; v < 4; ++v) EXPECT_EQ(mesh.shape_of(VertexId(v)) & shape::kFront, 0);
}

TEST(TetMesh, refuses_walls_origins_and_fronts_that_do_not_fit) {
  const auto is_refused = [](const auto& change) {
    TetSoup soup = one_tet();
    change(soup);
    return TetMesh::build(soup).error().code == ErrorCode::kBadArgument;
  };
  EXPECT_TRUE(is_refused([](TetSoup& soup) { soup.walls = {{{0, 1, 4}, 1}}; }));
  EXPECT_TRUE(is_refused([](TetSoup& soup) { soup.walls = {{{0, 1, 2}, 0}}; }));
  EXPECT_TRUE(is_refused([](TetSoup& soup) { soup.walls = {{{0, 1, 2}, TetMesh::kMaxStroke + 1}}; }));
  EXPECT_TRUE(is_refused([](TetSoup& soup) { soup.origins = {0, 1, 2}; }));
  EXPECT_TRUE(is_refused([](TetSoup& soup) { soup.fronts = {0, 1, 1, 0, 1}; }));
}

TetSoup scaled(TetSoup soup, double by) {
  for (Vec3& p : soup.points) p *= by;
  return soup;
}

TEST(TetMesh, refuses_bodies_whose_lengths_cannot_be_computed_with) {
  for (const double size : {1e150, 1e31, 1e-31, 1e-150}) {
    SCOPED_TRACE(size);
    const Result<TetMesh> mesh = TetMesh::build(scaled(kuhn_cube(2), size));
    ASSERT_FALSE(mesh.ok());
    EXPECT_EQ(mesh.error().code, ErrorCode::kBadArgument);
    EXPECT_NE(mesh.error().message.find("rescale"), std::string::npos) << mesh.error().message;
  }
  TetSoup far_off = one_tet();
  for (Vec3& p : far_off.points) p.x() += 1e150;
  EXPECT_FALSE(TetMesh::build(far_off).ok());
}

TEST(TetMesh, takes_bodies_of_any_other_size_and_points_anywhere_that_no_tet_uses) {
  for (const double size : {0.99e30, 1.01e-30}) {
    expect_valid(build(scaled(one_tet(), size)), size * size * size / 6.0);
  }
  TetSoup soup = one_tet();
  soup.points.emplace_back(1e200, 0, 0);
  EXPECT_TRUE(TetMesh::build(soup).ok());
  EXPECT_TRUE(TetMesh::build(scaled(one_tet(), 0.0)).ok()) << "flat, but sound";
}

TEST(TetMesh, remembers_flat_tets_of_its_input) {
  TetSoup soup = one_tet();
  soup.points.emplace_back(0.25, 0.25, 0);
  soup.tets.push_back({0, 1, 2, 4});
  const TetMesh mesh = build(soup);
  EXPECT_EQ(mesh.flat_at_load(), std::vector<TetId>{TetId(1)});
}

TEST(TetMesh, hash_depends_on_places_connectivity_and_regions) {
  const std::uint64_t base = build(kuhn_cube(2)).hash();
  EXPECT_EQ(build(kuhn_cube(2)).hash(), base);
  TetSoup soup = kuhn_cube(2);
  soup.points[13].x() = std::nextafter(soup.points[13].x(), 1.0);
  EXPECT_NE(build(soup).hash(), base);
  soup = kuhn_cube(2);
  std::swap(soup.tets[0], soup.tets[1]);
  EXPECT_NE(build(soup).hash(), base);
  soup = kuhn_cube(2);
  soup.regions.assign(soup.tets.size(), 0);
  EXPECT_EQ(build(soup).hash(), base);
  soup.regions[3] = 1;
  EXPECT_NE(build(soup).hash(), base);
}

TEST(TetMesh, hands_out_its_arrays_by_slot) {
  const TetMesh mesh = build(kuhn_cube(2));
  const MeshArrays arrays = mesh.arrays();
  EXPECT_EQ(arrays.tets.size(), mesh.tet_slots());
  EXPECT_EQ(arrays.shapes.size(), mesh.vertex_slots());
  mesh.for_each_tet([&](TetId tet) { EXPECT_EQ(&arrays.tets[tet.value], &mesh.vertices(tet)); });
  mesh.for_each_vertex([&](VertexId v) { EXPECT_EQ(&arrays.rest[v.value], &mesh.rest(v)); });
#if defined(__linux__)
  EXPECT_TRUE(mesh.has_stable_addresses());
#endif
}

TEST(StarWalker, finds_all_tets_of_every_vertex) {
  const TetMesh mesh = build(kuhn_cube(3));
  std::map<VertexId, std::set<TetId>> incident;
  mesh.for_each_tet([&](TetId tet) {
    for (const VertexId v : mesh.vertices(tet)) incident[v].insert(tet);
  });
  StarWalker walker;
  mesh.for_each_vertex([&](VertexId v) {
    const auto& star = walker.star(mesh, v);
    EXPECT_EQ(star.size(), incident[v].size());
    for (const TetId tet : star) {
      EXPECT_EQ(incident[v].count(tet), 1U);
      EXPECT_TRUE(walker.is_seen(tet));
    }
  });
  expect_valid(mesh, 1.0);
}

TEST(StarWalker, stops_at_blocked_sides) {
  const TetMesh mesh = build(kuhn_cube(2));
  StarWalker walker;
  const VertexId centre(13);
  const std::size_t all = walker.star(mesh, centre).size();
  // The plane x = ½ blocks: half of the star remains.
  const auto is_blocked = [&](Side side) {
    const auto v = mesh.vertices(side);
    return mesh.rest(v[0]).x() == 0.5 && mesh.rest(v[1]).x() == 0.5 && mesh.rest(v[2]).x() == 0.5;
  };
  const auto& half = walker.flood(mesh, centre, mesh.tet_of(centre), is_blocked);
  EXPECT_EQ(half.size(), all / 2);
  EXPECT_EQ(walker.flood(mesh, centre, mesh.tet_of(centre), [](Side) { return true; }).size(), 1U);
}

TEST(EdgeRing, closes_around_inner_edges_only) {
  const TetMesh mesh = build(kuhn_cube(3));
  std::map<std::set<std::uint32_t>, std::set<TetId>> rings;
  mesh.for_each_tet([&](TetId tet) {
    for (const auto& [a, b] : kEdgeCorners)
      rings[{mesh.vertices(tet)[a].value, mesh.vertices(tet)[b].value}].insert(tet);
  });
  for (const auto& [edge, tets] : rings) {
    const VertexId a(*edge.begin()), b(*edge.rbegin());
    std::set<TetId> walked;
    const bool is_closed = walk_edge_ring(
        mesh, a, b, *tets.begin(), [](Side) { return false; }, [&](TetId tet) { walked.insert(tet); });
    EXPECT_EQ(walked, tets);
    const Vec3 middle = 0.5 * (mesh.rest(a) + mesh.rest(b));
    EXPECT_EQ(is_closed, (middle.array() > 1e-9).all() && (middle.array() < 1 - 1e-9).all());
  }
}

}  // namespace
}  // namespace incise::test::tet_mesh_test
