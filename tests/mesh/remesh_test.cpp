// SPDX-License-Identifier: Apache-2.0
// Swaps and the removal of edges.
#include "incise/mesh/remesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "cut/cutter.h"
#include "incise/geom/predicates.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/validate.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::remesh_test {
namespace {

/// The tets as a set of positive vertex quadruples, each turned so that its lowest slots come first.
std::set<std::array<std::uint32_t, 4>> tet_set(const TetMesh& mesh) {
  std::set<std::array<std::uint32_t, 4>> tets;
  mesh.for_each_tet([&](TetId tet) {
    std::array<std::uint32_t, 4> v{};
    for (unsigned c = 0; c < 4; ++c) v[c] = mesh.vertices(tet)[c].value;
    bool is_odd = false;
    for (unsigned i = 0; i < 3; ++i) {
      const auto least = static_cast<unsigned>(std::min_element(v.begin() + i, v.end()) - v.begin());
      if (least != i) is_odd = !is_odd;
      std::swap(v[i], v[least]);
    }
    if (is_odd) std::swap(v[2], v[3]);
    tets.insert(v);
  });
  return tets;
}

/// The tags of the boundary faces, by their vertices.
std::map<std::array<std::uint32_t, 3>, std::uint32_t> boundary_tags(const TetMesh& mesh) {
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> tags;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) continue;
      const auto v = mesh.vertices(Side(tet, s));
      std::array<std::uint32_t, 3> key = {v[0].value, v[1].value, v[2].value};
      std::sort(key.begin(), key.end());
      tags[key] = mesh.links(tet)[s].tag();
    }
  });
  return tags;
}

bool is_positive(const TetMesh& mesh, const RemeshPlan& plan) {
  return std::all_of(plan.produced.begin(), plan.produced.end(), [&](const NewTet& tet) {
    const auto& v = tet.vertices;
    return orient3d(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])) > 0;
  });
}

/// Triangles around one vertex of a polygon of `count`.
std::vector<RingTriangle> triangles_around(std::uint8_t apex, std::size_t count) {
  std::vector<RingTriangle> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    RingTriangle t = {apex, static_cast<std::uint8_t>(i), static_cast<std::uint8_t>((i + 1) % count)};
    if (t[1] == apex || t[2] == apex) continue;
    std::sort(t.begin(), t.end());
    triangles.push_back(t);
  }
  return triangles;
}

struct Edge {
  VertexId a, b;
  TetId seed;
};

std::vector<Edge> edges_of(const TetMesh& mesh) {
  std::map<std::pair<VertexId, VertexId>, TetId> edges;
  mesh.for_each_tet([&](TetId tet) {
    for (const auto& [i, j] : kEdgeCorners) {
      const VertexId a = mesh.vertices(tet)[i], b = mesh.vertices(tet)[j];
      edges.emplace(std::minmax(a, b), tet);
    }
  });
  std::vector<Edge> list;
  for (const auto& [ends, seed] : edges) list.push_back({ends.first, ends.second, seed});
  return list;
}

TetMesh cube_with_a_wall() {
  TetMesh mesh = build(jittered_cube(3, 4));
  Cutter cutter({Profile::kIncise, 0.2});
  Journal journal;
  StageTimes times;
  const auto stroke = plane_stroke(rest_bounds(mesh), Vec3(1, 0, 0), 0.45);
  EXPECT_TRUE(cutter.cut(mesh, journal, *stroke, 1, times).ok());
  return mesh;
}

// T34
TEST(Swap, two_to_three_and_back_is_the_identity) {
  TetMesh mesh = build(jittered_cube(3, 1));
  const auto tets = tet_set(mesh);
  const std::uint64_t hash = mesh.hash();
  unsigned swapped = 0;
  for (std::uint32_t side = 0; side < mesh.tet_slots() * 4; ++side) {
    const Side face(TetId(side / 4), side % 4);
    const RemeshPlan there = plan_swap_23(mesh, face);
    if (!there) continue;
    std::vector<TetId> produced;
    Transaction transaction(mesh);
    apply(transaction, there, produced);
    EXPECT_EQ(mesh.tet_count(), tets.size() + 1);
    expect_valid(mesh, 1.0);
    const TetVertices& v = there.produced[0].vertices;  // all three have the new edge at their corners 2 and 3
    const RemeshPlan back = plan_swap_32(mesh, v[2], v[3], produced[1]);
    ASSERT_TRUE(back);
    apply(transaction, back, produced);
    EXPECT_EQ(tet_set(mesh), tets);
    expect_valid(mesh, 1.0);
    transaction.rollback();
    ASSERT_EQ(mesh.hash(), hash);
    ++swapped;
  }
  EXPECT_GT(swapped, 50U);
}

TEST(Swap, of_two_tets_lists_what_it_does) {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -1}};
  soup.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  soup.regions = {5, 5};
  TetMesh mesh = build(soup);
  std::vector<TetId> produced;
  Transaction transaction(mesh, true);
  apply(transaction, plan_swap_23(mesh, {TetId(0), 3}), produced);
  const Step step = transaction.commit();
  ASSERT_EQ(step.edits.size(), 1U);
  EXPECT_EQ(step.edits[0].kind, Edit::Kind::kRemesh);
  EXPECT_EQ(step.edits[0].vertex, kInvalidIndex);
  EXPECT_EQ(step.edits[0].consumed_end, 2U);
  EXPECT_EQ(step.edits[0].produced_end, 3U);
  EXPECT_EQ(step.consumed.size(), 2U);
  EXPECT_EQ(step.produced.size(), 3U);
  for (const ProducedTet& tet : step.edit_produced) EXPECT_EQ(tet.region, 5);
  expect_valid(mesh, 1.0 / 3.0);
}

TEST(Swap, refuses_what_it_cannot_do) {
  TetSoup soup = kuhn_cube(1);
  soup.regions = {0, 0, 0, 1, 1, 1};
  const TetMesh mesh = build(soup);
  EXPECT_EQ(plan_swap_23(mesh, Side()).refusal, Refusal::kDead);
  EXPECT_EQ(plan_swap_23(mesh, Side(TetId(6), 0)).refusal, Refusal::kDead);
  std::map<Refusal, unsigned> faces;
  for (std::uint32_t side = 0; side < 24; ++side) ++faces[plan_swap_23(mesh, {TetId(side / 4), side % 4}).refusal];
  EXPECT_EQ(faces[Refusal::kOnSurface], 12U + 4U);  // the skin, and the two faces between the regions
  EXPECT_EQ(faces[Refusal::kWouldInvert], 8U);      // the line between the apexes passes through an edge
  EXPECT_EQ(plan_swap_32(mesh, VertexId(0), VertexId(0), TetId(0)).refusal, Refusal::kNotAnEdge);
  EXPECT_EQ(plan_swap_32(mesh, VertexId(0), VertexId(9), TetId(0)).refusal, Refusal::kNotAnEdge);
  EXPECT_EQ(plan_swap_32(mesh, VertexId(0), VertexId(7), TetId(6)).refusal, Refusal::kNotAnEdge);
  EXPECT_EQ(plan_swap_32(mesh, VertexId(0), VertexId(7), TetId(0)).refusal, Refusal::kOnSurface);
  const TetMesh one_region = build(kuhn_cube(1));
  EXPECT_EQ(plan_swap_32(one_region, VertexId(0), VertexId(7), TetId(0)).refusal, Refusal::kOutOfRange);
  EXPECT_EQ(plan_swap_32(one_region, VertexId(0), VertexId(1), one_region.tet_of(VertexId(1))).refusal,
            Refusal::kOnSurface);
}

TEST(Swap, of_three_tets_refuses_where_the_edge_misses_the_triangle) {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {0, 0, 1}, {2, 0, 2}, {-1, 2, 2}, {-1, -2, 2}};
  soup.tets = {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 2}};
  const TetMesh mesh = build(soup);
  ASSERT_GT(mesh.rest_volume(TetId(0)), 0);
  EXPECT_EQ(plan_swap_32(mesh, VertexId(0), VertexId(1), TetId(1)).refusal, Refusal::kWouldInvert);
}

TEST(EdgeRing, is_the_same_from_every_tet_in_it) {
  const TetMesh mesh = build(jittered_cube(2, 2));
  for (const Edge& edge : edges_of(mesh)) {
    EdgeRing ring, other;
    find_edge_ring(mesh, edge.a, edge.b, edge.seed, ring);
    ASSERT_EQ(ring.vertices.size(), ring.tets.size() + (ring.is_closed ? 0U : 1U));
    for (std::size_t i = 0; i < ring.tets.size(); ++i) {
      const VertexId p = ring.vertices[i], q = ring.vertices[(i + 1) % ring.vertices.size()];
      for (const VertexId v : {edge.a, edge.b, p, q}) ASSERT_LT(mesh.corner_of(ring.tets[i], v), 4U);
      EXPECT_GT(orient3d(mesh.rest(edge.a), mesh.rest(edge.b), mesh.rest(p), mesh.rest(q)), 0);
      find_edge_ring(mesh, edge.a, edge.b, ring.tets[i], other);
      EXPECT_EQ(other.is_closed, ring.is_closed);
      if (ring.is_closed)
        std::rotate(other.tets.rbegin(), other.tets.rbegin() + static_cast<long>(i), other.tets.rend());
      EXPECT_EQ(other.tets, ring.tets);
    }
  }
}

/// Removes every edge that satisfies a condition, one at a time and each with every fan of triangles, and takes it
/// back. Returns how many removals there were by number of tets around the edge.
template <class IsWanted, class Check>
std::map<std::size_t, unsigned> remove_every_edge(TetMesh& mesh, IsWanted&& is_wanted, Check&& check) {
  std::map<std::size_t, unsigned> removed;
  const double volume = volume_of(mesh);
  const std::uint64_t hash = mesh.hash();
  EdgeRing ring;
  RemeshPlan plan;
  std::vector<TetId> produced;
  for (const Edge& edge : edges_of(mesh)) {
    find_edge_ring(mesh, edge.a, edge.b, edge.seed, ring);
    if (ring.vertices.size() < 3 || !is_wanted(edge, ring)) continue;
    for (std::size_t apex = 0; apex < ring.vertices.size(); ++apex) {
      fill_edge_removal(mesh, edge.a, edge.b, ring,
                        triangles_around(static_cast<std::uint8_t>(apex), ring.vertices.size()), plan);
      if (!is_positive(mesh, plan)) continue;
      Transaction transaction(mesh);
      apply(transaction, plan, produced);
      EXPECT_EQ(produced.size(), 2 * (ring.vertices.size() - 2));
      expect_valid(mesh, volume);
      check(edge, ring);
      transaction.rollback();
      EXPECT_EQ(mesh.hash(), hash);
      ++removed[ring.tets.size()];
    }
  }
  return removed;
}

TEST(EdgeRemoval, of_inner_edges_keeps_volume_and_boundary) {
  TetMesh mesh = build(jittered_cube(3, 6));
  const auto boundary = boundary_tags(mesh);
  const auto removed = remove_every_edge(
      mesh, [](const Edge&, const EdgeRing& ring) { return ring.is_closed; },
      [&](const Edge&, const EdgeRing&) { EXPECT_EQ(boundary_tags(mesh), boundary); });
  EXPECT_GT(removed.at(4), 10U);  // swaps of four for four
  EXPECT_GT(removed.at(6), 10U);
}

TEST(EdgeRemoval, of_three_tets_is_their_swap) {
  TetMesh mesh = build(jittered_cube(3, 6));
  unsigned count = 0;
  for (const Edge& edge : edges_of(mesh)) {
    EdgeRing ring;
    find_edge_ring(mesh, edge.a, edge.b, edge.seed, ring);
    const RemeshPlan swap = plan_swap_32(mesh, edge.a, edge.b, edge.seed);
    EXPECT_EQ(swap.refusal == Refusal::kOnSurface, !ring.is_closed);
    EXPECT_EQ(swap.refusal == Refusal::kOutOfRange, ring.is_closed && ring.tets.size() != 3);
    if (swap) ++count;
  }
  EXPECT_EQ(count, 0U);  // a Kuhn cube has four or six tets at its inner edges
}

bool is_flat(const TetMesh& mesh, const Edge& edge, const EdgeRing& ring) {
  const Vec3 a = mesh.rest(edge.a), b = mesh.rest(edge.b);
  const Vec3 p = mesh.rest(ring.vertices.front()), q = mesh.rest(ring.vertices.back());
  const double length = (b - a).norm();
  return std::abs((b - a).cross(p - a).dot(q - a)) < 1e-12 * length * length * length;
}
std::uint32_t tag_at(const TetMesh& mesh, TetId tet, VertexId away_from) {
  return mesh.links(tet)[mesh.corner_of(tet, away_from)].tag();
}

TEST(EdgeRemoval, of_an_edge_in_a_flat_boundary_turns_its_two_faces) {
  TetMesh mesh = cube_with_a_wall();
  const auto before = boundary_tags(mesh);
  const double wall = wall_area(mesh, 1);
  std::map<std::uint32_t, unsigned> turned;
  const auto removed = remove_every_edge(
      mesh,
      [&](const Edge& edge, const EdgeRing& ring) {
        return !ring.is_closed && is_flat(mesh, edge, ring) &&
               tag_at(mesh, ring.tets.front(), ring.vertices[1]) ==
                   tag_at(mesh, ring.tets.back(), ring.vertices[ring.vertices.size() - 2]);
      },
      [&](const Edge& edge, const EdgeRing& ring) {
        const auto after = boundary_tags(mesh);
        ASSERT_EQ(after.size(), before.size());
        EXPECT_NEAR(wall_area(mesh, 1), wall, 1e-12 * wall);
        for (const auto& [face, tag] : after) {
          const auto old = before.find(face);
          if (old != before.end()) {
            EXPECT_EQ(old->second, tag);
            continue;
          }
          EXPECT_EQ(std::count(face.begin(), face.end(), ring.vertices.front().value), 1);
          EXPECT_EQ(std::count(face.begin(), face.end(), ring.vertices.back().value), 1);
          EXPECT_EQ(
              std::count(face.begin(), face.end(), edge.a.value) + std::count(face.begin(), face.end(), edge.b.value),
              1);
          ++turned[tag];
        }
      });
  EXPECT_GT(removed.at(2), 5U);  // swaps of two for two
  EXPECT_GT(removed.at(3), 5U);
  EXPECT_GT(turned[0], 10U);
  EXPECT_GT(turned[1], 10U);
}

TEST(EdgeRemoval, takes_the_first_triangles_tet_as_parent) {
  const TetMesh mesh = build(jittered_cube(2, 2));
  EdgeRing ring;
  RemeshPlan plan;
  for (const Edge& edge : edges_of(mesh)) {
    find_edge_ring(mesh, edge.a, edge.b, edge.seed, ring);
    if (ring.vertices.size() < 3) continue;
    fill_edge_removal(mesh, edge.a, edge.b, ring, triangles_around(0, ring.vertices.size()), plan);
    EXPECT_EQ(plan.consumed, ring.tets);
    for (const NewTet& tet : plan.produced) ASSERT_LT(tet.parent, plan.consumed.size());
  }
}

}  // namespace
}  // namespace incise::test::remesh_test
