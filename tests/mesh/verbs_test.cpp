// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/verbs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "incise/mesh/star.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::verbs_test {
namespace {

struct Edge {
  VertexId a, b;
  TetId seed;
};

Edge edge_of(const TetMesh& mesh, TetId tet, unsigned edge) {
  return {mesh.vertices(tet)[kEdgeCorners[edge][0]], mesh.vertices(tet)[kEdgeCorners[edge][1]], tet};
}

TEST(SplitEdge, halves_every_tet_of_the_ring_and_keeps_the_mesh_valid) {
  for (unsigned edge = 0; edge < 6; ++edge) {
    for (const double t : {0.5, 0.1, 0.97}) {
      TetMesh mesh = build(kuhn_cube(3));
      const Edge e = edge_of(mesh, TetId(81), edge);
      const SplitEdgePlan plan = plan_split_edge(mesh, e.a, e.b, e.seed, t);
      ASSERT_TRUE(plan);
      Transaction transaction(mesh);
      const SplitEdgeResult result = apply(transaction, plan);
      const Step step = transaction.commit();
      EXPECT_EQ(result.halves.size(), plan.ring.size());
      EXPECT_EQ(mesh.tet_count(), 162 + plan.ring.size());
      EXPECT_EQ(mesh.rest(result.vertex), Vec3(mesh.rest(e.a) + t * (mesh.rest(e.b) - mesh.rest(e.a))));
      EXPECT_EQ(step.consumed.size(), plan.ring.size());
      EXPECT_EQ(step.produced.size(), 2 * plan.ring.size());
      ASSERT_EQ(step.born.size(), 1U);
      EXPECT_EQ(step.born[0].id, result.vertex);
      expect_valid(mesh, 1.0);
    }
  }
}

TEST(SplitEdge, halves_share_the_volume_of_their_tet) {
  TetMesh mesh = build(jittered_cube(3, 1));
  const Edge e = edge_of(mesh, TetId(80), 2);
  const SplitEdgePlan plan = plan_split_edge(mesh, e.a, e.b, e.seed, 0.3);
  std::vector<double> volumes;
  for (const TetId tet : plan.ring) volumes.push_back(mesh.rest_volume(tet));
  Transaction transaction(mesh);
  const SplitEdgeResult result = apply(transaction, plan);
  transaction.commit();
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    EXPECT_EQ(result.halves[i].tet, plan.ring[i]);
    EXPECT_NEAR(mesh.rest_volume(result.halves[i].keeps_a), 0.3 * volumes[i], 1e-17);
    EXPECT_NEAR(mesh.rest_volume(result.halves[i].keeps_b), 0.7 * volumes[i], 1e-17);
    EXPECT_EQ(mesh.corner_of(result.halves[i].keeps_a, e.b), 4U);
    EXPECT_EQ(mesh.corner_of(result.halves[i].keeps_b, e.a), 4U);
  }
  expect_valid(mesh, 1.0);
}

TEST(SplitEdge, gives_the_new_vertex_the_skin_of_its_edge) {
  TetMesh mesh = build(kuhn_cube(2));
  const auto split = [&](const Vec3& from, const Vec3& to) {
    VertexId a, b;
    mesh.for_each_vertex([&](VertexId v) {
      if (mesh.rest(v) == from) a = v;
      if (mesh.rest(v) == to) b = v;
    });
    StarWalker walker;
    TetId seed;
    for (const TetId tet : walker.star(mesh, a)) {
      if (mesh.corner_of(tet, b) < 4) seed = tet;
    }
    const SplitEdgePlan plan = plan_split_edge(mesh, a, b, seed, 0.5);
    EXPECT_TRUE(plan);
    Transaction transaction(mesh);
    const VertexId vertex = apply(transaction, plan).vertex;
    transaction.commit();
    return mesh.shape_of(vertex);
  };
  EXPECT_EQ(split(Vec3(0, 0, 0), Vec3(0.5, 0, 0)), shape::kSkin);
  EXPECT_EQ(split(Vec3(0.5, 0.5, 0), Vec3(0.5, 0.5, 0.5)), 0);
  EXPECT_EQ(split(Vec3(0, 0, 0.5), Vec3(0.5, 0.5, 0.5)), 0);  // between two vertices, one on the skin
  expect_valid(mesh, 1.0);
}

TEST(SplitEdge, is_refused_where_it_makes_no_sense) {
  TetMesh mesh = build(kuhn_cube(3));
  const std::uint64_t hash = mesh.hash();
  const Edge e = edge_of(mesh, TetId(81), 0);
  VertexId far;
  mesh.for_each_vertex([&](VertexId v) {
    if (mesh.corner_of(e.seed, v) == 4) far = v;
  });
  EXPECT_EQ(plan_split_edge(mesh, e.a, far, e.seed, 0.5).refusal, Refusal::kNotAnEdge);
  EXPECT_EQ(plan_split_edge(mesh, e.a, e.a, e.seed, 0.5).refusal, Refusal::kNotAnEdge);
  EXPECT_EQ(plan_split_edge(mesh, e.a, e.b, TetId(100000), 0.5).refusal, Refusal::kDead);
  EXPECT_EQ(plan_split_edge(mesh, e.a, VertexId(100000), e.seed, 0.5).refusal, Refusal::kDead);
  for (const double t : {0.0, 1.0, -0.5, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(plan_split_edge(mesh, e.a, e.b, e.seed, t).refusal, Refusal::kOutOfRange);
  }
  EXPECT_EQ(plan_split_edge(mesh, e.a, e.b, e.seed, 1e-320).refusal, Refusal::kWouldInvert);
  EXPECT_EQ(mesh.hash(), hash);
  expect_valid(mesh, 1.0);
}

TEST(SplitEdge, survives_a_thousand_random_splits) {
  Random random(2);
  TetMesh mesh = build(kuhn_cube(2));
  for (unsigned i = 0; i < 1000; ++i) {
    TetId tet;
    do {
      tet = TetId(static_cast<std::uint32_t>(random.integer(0, mesh.tet_slots() - 1)));
    } while (!mesh.is_live(tet));
    // The longest edge, so that tets do not become flat.
    unsigned longest = 0;
    double length = 0;
    for (unsigned e = 0; e < 6; ++e) {
      const Edge edge = edge_of(mesh, tet, e);
      if ((mesh.rest(edge.a) - mesh.rest(edge.b)).norm() > length) {
        length = (mesh.rest(edge.a) - mesh.rest(edge.b)).norm();
        longest = e;
      }
    }
    const Edge e = edge_of(mesh, tet, longest);
    Transaction transaction(mesh);
    apply(transaction, plan_split_edge(mesh, e.a, e.b, e.seed, random.real(0.3, 0.7)));
    transaction.commit();
  }
  expect_valid(mesh, 1.0);
}

TEST(DuplicateVertex, opens_the_faces_between_the_group_and_the_rest) {
  TetMesh mesh = build(kuhn_cube(4));
  VertexId vertex;  // in the middle of the top; its tets beyond x = ½ get the copy
  mesh.for_each_vertex([&](VertexId v) {
    if (mesh.rest(v) == Vec3(0.5, 0.5, 1)) vertex = v;
  });
  StarWalker walker;
  std::vector<TetId> group;
  for (const TetId tet : walker.star(mesh, vertex)) {
    double x = 0;
    for (const VertexId v : mesh.vertices(tet)) x += mesh.rest(v).x() / 4;
    if (x > 0.5) group.push_back(tet);
  }
  const DuplicateVertexPlan plan = plan_duplicate_vertex(mesh, vertex, group);
  ASSERT_TRUE(plan);
  Transaction transaction(mesh);
  const VertexId twin = apply(transaction, plan, 5);
  const Step step = transaction.commit();
  EXPECT_EQ(mesh.rest(twin), mesh.rest(vertex));
  EXPECT_EQ(mesh.origin(twin), vertex);
  for (const TetId tet : group) EXPECT_EQ(mesh.corner_of(tet, vertex), 4U);
  ASSERT_EQ(step.copied.size(), 1U);
  EXPECT_EQ(step.copied[0].source, vertex);
  EXPECT_EQ(step.rewired.size(), group.size());
  EXPECT_EQ(step.opened.size(), 3U);
  for (const OpenedFace& face : step.opened) {
    EXPECT_EQ(mesh.link(face.a), Link::boundary(5));
    EXPECT_EQ(mesh.link(face.b), Link::boundary(5));
  }
  EXPECT_EQ(find_components(mesh).count(), 1U);
  expect_valid(mesh, 1.0);
}

TEST(DuplicateVertex, is_refused_where_nothing_would_come_apart) {
  TetMesh mesh = build(kuhn_cube(1));
  const std::uint64_t hash = mesh.hash();
  const VertexId corner(0);
  StarWalker walker;
  const std::vector<TetId> star = walker.star(mesh, corner);
  EXPECT_EQ(star.size(), 6U);
  EXPECT_EQ(plan_duplicate_vertex(mesh, corner, star).refusal, Refusal::kStarIsWhole);
  EXPECT_EQ(plan_duplicate_vertex(mesh, corner, {}).refusal, Refusal::kStarIsWhole);
  EXPECT_EQ(plan_duplicate_vertex(mesh, corner, {TetId(99)}).refusal, Refusal::kDead);
  EXPECT_EQ(plan_duplicate_vertex(mesh, VertexId(99), {TetId(0)}).refusal, Refusal::kDead);
  const VertexId other(1);  // some tet of the six is not at it
  TetId without;
  mesh.for_each_tet([&](TetId tet) {
    if (mesh.corner_of(tet, other) == 4) without = tet;
  });
  EXPECT_EQ(plan_duplicate_vertex(mesh, other, {without}).refusal, Refusal::kOutOfRange);
  EXPECT_EQ(plan_duplicate_vertex(mesh, corner, {star[0]}).refusal, Refusal::kNone);
  EXPECT_EQ(mesh.hash(), hash);
  expect_valid(mesh, 1.0);
}

}  // namespace
}  // namespace incise::test::verbs_test
