// SPDX-License-Identifier: Apache-2.0
// A transaction that runs out of memory, wherever it does, leaves the mesh as it was.
#include <gtest/gtest.h>

#include <new>

#include "incise/mesh/transaction.h"
#include "incise/mesh/verbs.h"
#include "support/allocation.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::out_of_memory_test {
namespace {

void split_some_edge(Transaction& transaction, TetId tet, unsigned edge) {
  const TetMesh& mesh = transaction.mesh();
  const TetVertices& v = mesh.vertices(tet);
  const SplitEdgePlan plan = plan_split_edge(mesh, v[kEdgeCorners[edge][0]], v[kEdgeCorners[edge][1]], tet, 0.5);
  if (plan) apply(transaction, plan);
}

/// Takes slots from the free lists and new ones, frees some, moves, opens, revives what `died` had.
void edit(Transaction& transaction, const TetImage& died) {
  const TetMesh& mesh = transaction.mesh();
  transaction.revive_tet(died, TetId(0));
  for (std::uint32_t t = 0; t < 150; t += 30) {
    if (mesh.is_live(TetId(t))) split_some_edge(transaction, TetId(t), t % 6);
  }
  const TetId around = mesh.tet_of(VertexId(21));
  const TetVertices basis = mesh.vertices(around);
  Vec3 centre = Vec3::Zero();
  for (const VertexId v : basis) centre += mesh.rest(v) / 4;
  transaction.move(VertexId(21), centre, basis, {0.25, 0.25, 0.25, 0.25});
  transaction.set_shape(VertexId(22), shape::kFront);
  const TetId last = transaction.new_tets().back();
  transaction.open(Side(last, 0), Side(last, 1), 7);
  transaction.remove_vertex(transaction.copy_vertex(VertexId(5)));
  transaction.remove_tet(transaction.add_tet_beside(mesh.vertices(last), last, {}));
}

/// A mesh with free slots, and the image of one of the tets that were there.
TetMesh used_mesh(TetImage& died) {
  TetMesh mesh = build(kuhn_cube(3));
  Transaction transaction(mesh);
  died = {TetId(40), mesh.vertices(TetId(40)), mesh.links(TetId(40)), mesh.region(TetId(40))};
  split_some_edge(transaction, TetId(40), 0);
  split_some_edge(transaction, TetId(100), 3);
  static_cast<void>(transaction.commit());
  return mesh;
}

TEST(OutOfMemory, a_transaction_leaves_the_mesh_as_it_was) {
  TetImage died{};
  TetMesh mesh = used_mesh(died);
  const std::uint64_t before = mesh.hash();
  std::uint64_t after = 0;
  {
    Transaction transaction(mesh);
    edit(transaction, died);
    after = mesh.hash();
  }
  ASSERT_NE(after, before);
  std::size_t failures = 0;
  for (bool has_failed = true; has_failed; failures += has_failed ? 1 : 0) {
    has_failed = false;
    std::uint64_t reached = 0;
    try {
      const FailingAllocator allocator(failures);
      Transaction transaction(mesh);
      edit(transaction, died);
      reached = mesh.hash();
      static_cast<void>(transaction.commit());
    } catch (const std::bad_alloc&) {
      has_failed = true;
    }
    if (!has_failed) {
      EXPECT_EQ(reached, after);
      break;
    }
    ASSERT_EQ(mesh.hash(), before) << "the allocation after the first " << failures;
    const TetMesh& now = mesh;
    std::size_t live = 0;
    now.for_each_tet([&](TetId) { ++live; });
    ASSERT_EQ(live, now.tet_count());
    expect_valid(mesh, 1.0);
    Transaction again(mesh);  // marks that were left behind would spoil this one
    edit(again, died);
    ASSERT_EQ(mesh.hash(), after);
    again.rollback();
    ASSERT_EQ(mesh.hash(), before);
  }
  EXPECT_GT(failures, 20U);
}

TEST(OutOfMemory, rolling_back_asks_for_no_memory) {
  TetImage died{};
  TetMesh mesh = used_mesh(died);
  const std::uint64_t before = mesh.hash();
  Transaction transaction(mesh);
  edit(transaction, died);
  const std::size_t allocations = allocation_count();
  transaction.rollback();
  EXPECT_EQ(allocation_count(), allocations);
  EXPECT_EQ(mesh.hash(), before);
}

TEST(OutOfMemory, taking_steps_back_asks_for_no_memory) {
  TetMesh mesh = build(kuhn_cube(3));
  const std::uint64_t before = mesh.hash();
  Journal journal;
  for (std::uint32_t t = 0; t < 90; t += 30) {
    Transaction transaction(mesh);
    split_some_edge(transaction, TetId(t), 0);
    EXPECT_TRUE(journal.append_if_changed(transaction.commit()));
  }
  EXPECT_FALSE(journal.append_if_changed(Transaction(mesh).commit()));
  EXPECT_EQ(journal.size(), 3U);
  const std::size_t allocations = allocation_count();
  journal.take_back(mesh, 0);
  EXPECT_EQ(allocation_count(), allocations);
  EXPECT_EQ(mesh.hash(), before);
  EXPECT_EQ(journal.size(), 0U);
  expect_valid(mesh, 1.0);
}

}  // namespace
}  // namespace incise::test::out_of_memory_test
