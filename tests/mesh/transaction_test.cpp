// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/transaction.h"

#include <gtest/gtest.h>

#include "incise/mesh/verbs.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::transaction_test {
namespace {

SplitEdgeResult split_some_edge(Transaction& transaction, TetId tet, unsigned edge, double t = 0.5) {
  const TetVertices& v = transaction.mesh().vertices(tet);
  const SplitEdgePlan plan =
      plan_split_edge(transaction.mesh(), v[kEdgeCorners[edge][0]], v[kEdgeCorners[edge][1]], tet, t);
  EXPECT_TRUE(plan);
  return apply(transaction, plan);
}

Vec3 centre_of(const TetMesh& mesh, TetId tet) {
  Vec3 sum = Vec3::Zero();
  for (const VertexId v : mesh.vertices(tet)) sum += mesh.rest(v) / 4;
  return sum;
}

TEST(Transaction, without_edits_is_an_empty_step) {
  TetMesh mesh = build(kuhn_cube(2));
  const std::uint64_t hash = mesh.hash();
  Transaction transaction(mesh);
  EXPECT_TRUE(transaction.commit().is_empty());
  EXPECT_EQ(mesh.hash(), hash);
  expect_valid(mesh, 1.0);
}

TEST(Transaction, rolled_back_restores_the_hash) {
  TetMesh mesh = build(kuhn_cube(3));
  const std::uint64_t hash = mesh.hash();
  {
    Transaction transaction(mesh);
    for (std::uint32_t t = 0; t < 150; t += 30) split_some_edge(transaction, TetId(t), t % 6);
    const TetId around = mesh.tet_of(VertexId(21));
    transaction.move(VertexId(21), centre_of(mesh, around), mesh.vertices(around), {0.25, 0.25, 0.25, 0.25});
    transaction.set_shape(VertexId(22), shape::kFront);
    EXPECT_NE(mesh.hash(), hash);
    transaction.rollback();
    EXPECT_EQ(mesh.hash(), hash);
  }
  EXPECT_EQ(mesh.hash(), hash);
  expect_valid(mesh, 1.0);
}

TEST(Transaction, that_dies_uncommitted_restores_the_hash) {
  TetMesh mesh = build(kuhn_cube(3));
  const std::uint64_t hash = mesh.hash();
  {
    Transaction transaction(mesh);
    split_some_edge(transaction, TetId(40), 0);
  }
  EXPECT_EQ(mesh.hash(), hash);
  expect_valid(mesh, 1.0);
}

TEST(Transaction, rolled_back_after_earlier_commits_restores_the_free_lists) {
  TetMesh mesh = build(kuhn_cube(3));
  for (unsigned round = 0; round < 20; ++round) {
    const std::uint64_t hash = mesh.hash();
    {
      Transaction transaction(mesh);
      for (unsigned i = 0; i < 5; ++i) {
        TetId tet(round * 7 + i * 20);
        while (!mesh.is_live(tet)) ++tet.value;
        split_some_edge(transaction, tet, (round + i) % 6, 0.4);
      }
    }
    EXPECT_EQ(mesh.hash(), hash);
    Transaction transaction(mesh);
    TetId tet(round * 5);
    while (!mesh.is_live(tet)) ++tet.value;
    split_some_edge(transaction, tet, round % 6, 0.6);
    transaction.commit();
    expect_valid(mesh, 1.0);
  }
}

TEST(Transaction, does_not_reuse_slots_that_it_freed) {
  TetMesh mesh = build(kuhn_cube(2));
  Transaction transaction(mesh);
  const SplitEdgeResult first = split_some_edge(transaction, TetId(10), 0);
  const SplitEdgeResult second = split_some_edge(transaction, first.halves[0].keeps_a, 1);
  for (const SplitHalves& freed : first.halves) {
    for (const SplitHalves& made : second.halves) {
      EXPECT_NE(freed.tet, made.keeps_a);
      EXPECT_NE(freed.tet, made.keeps_b);
    }
  }
  transaction.commit();
  expect_valid(mesh, 1.0);
}

TEST(Transaction, reuses_freed_slots_afterwards_with_a_higher_generation) {
  TetMesh mesh = build(kuhn_cube(2));
  Transaction first(mesh);
  const SplitEdgeResult split = split_some_edge(first, TetId(10), 0);
  first.commit();
  const TetId freed = split.halves.back().tet;
  const std::uint32_t generation = mesh.generation(freed);
  EXPECT_FALSE(mesh.is_live(freed));
  Transaction second(mesh);
  const std::uint32_t slots = mesh.tet_slots();
  split_some_edge(second, split.halves[0].keeps_a, 1);
  second.commit();
  EXPECT_LE(mesh.tet_slots(), slots + 8);
  if (mesh.is_live(freed)) {
    EXPECT_GE(mesh.generation(freed), generation);
  }
  EXPECT_GE(generation, 1U);
  expect_valid(mesh, 1.0);
}

TEST(Transaction, records_the_net_effect_only) {
  TetMesh mesh = build(kuhn_cube(2));
  Transaction transaction(mesh);
  const SplitEdgeResult first = split_some_edge(transaction, TetId(10), 0);
  const SplitEdgeResult second = split_some_edge(transaction, first.halves[0].keeps_a, 1);
  const Step step = transaction.commit();
  // Tets made and consumed within the step are nowhere in it; parents are tets that lived before it.
  for (const ConsumedTet& consumed : step.consumed) EXPECT_LT(consumed.id.value, 48U);
  for (const ProducedTet& produced : step.produced) {
    EXPECT_TRUE(mesh.is_live(produced.id));
    EXPECT_LT(produced.parent.value, 48U);
    EXPECT_FALSE(mesh.is_live(produced.parent));
    EXPECT_EQ(produced.vertices, mesh.vertices(produced.id));
  }
  EXPECT_EQ(step.born.size(), 2U);
  EXPECT_EQ(mesh.tet_count(), 48 + step.produced.size() - step.consumed.size());
  EXPECT_NE(first.vertex, second.vertex);
  expect_valid(mesh, 1.0);
}

TEST(Transaction, moves_a_vertex_to_a_place_in_a_tet_and_says_where) {
  TetMesh mesh = build(kuhn_cube(2));
  const VertexId inner(13);
  const TetId around = mesh.tet_of(inner);
  const TetVertices basis = mesh.vertices(around);
  std::array<double, 4> weights = {0.1, 0.1, 0.1, 0.1};
  weights[mesh.corner_of(around, inner)] = 0.7;
  Vec3 place = Vec3::Zero();
  for (unsigned c = 0; c < 4; ++c) place += weights[c] * mesh.rest(basis[c]);
  const Vec3 before = mesh.rest(inner);
  Transaction transaction(mesh);
  transaction.move(inner, place, basis, weights);
  const Step step = transaction.commit();
  EXPECT_EQ(mesh.rest(inner), place);
  EXPECT_LT((mesh.current(inner) - place).norm(), 1e-15);
  ASSERT_EQ(step.moved.size(), 1U);
  EXPECT_EQ(step.moved[0].id, inner);
  EXPECT_EQ(step.moved[0].old_rest, before);
  EXPECT_EQ(step.moved[0].rest, place);
  EXPECT_EQ(step.moved[0].basis, basis);
  EXPECT_EQ(step.moved[0].weights, weights);
  expect_valid(mesh, 1.0);
}

}  // namespace
}  // namespace incise::test::transaction_test
