// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/journal.h"

#include <gtest/gtest.h>

#include "cut/bodies.h"
#include "cut/support.h"
#include "incise/mesh/verbs.h"

namespace incise::test {
namespace {

/// A few random splits of longest edges, as one step.
Step random_step(TetMesh& mesh, Random& random) {
  Transaction transaction(mesh);
  for (unsigned i = 0; i < 6; ++i) {
    TetId tet;
    do {
      tet = TetId(static_cast<std::uint32_t>(random.integer(0, mesh.tet_slots() - 1)));
    } while (!mesh.is_live(tet));
    unsigned longest = 0;
    double length = 0;
    const TetVertices v = mesh.vertices(tet);
    for (unsigned e = 0; e < 6; ++e) {
      const double l = (mesh.rest(v[kEdgeCorners[e][0]]) - mesh.rest(v[kEdgeCorners[e][1]])).norm();
      if (l > length) {
        length = l;
        longest = e;
      }
    }
    apply(transaction, plan_split_edge(mesh, v[kEdgeCorners[longest][0]], v[kEdgeCorners[longest][1]], tet, 0.5));
  }
  return transaction.commit();
}

TEST(Journal, undoes_and_redoes_random_programs_bit_for_bit) {
  Random random(1);
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  std::vector<std::uint64_t> hashes = {mesh.hash()};
  for (unsigned i = 0; i < 60; ++i) {
    journal.append(random_step(mesh, random));
    hashes.push_back(mesh.hash());
  }
  // Back and forth at random, then all the way.
  std::size_t at = hashes.size() - 1;
  for (unsigned i = 0; i < 300; ++i) {
    if (random.integer(0, 1) == 0) {
      EXPECT_EQ(journal.undo(mesh), at > 0);
      at -= at > 0 ? 1U : 0U;
    } else {
      EXPECT_EQ(journal.redo(mesh), at + 1 < hashes.size());
      at += at + 1 < hashes.size() ? 1U : 0U;
    }
    ASSERT_EQ(mesh.hash(), hashes[at]);
    ASSERT_EQ(journal.position(), at);
  }
  while (journal.undo(mesh)) {
  }
  EXPECT_EQ(mesh.hash(), hashes[0]);
  expect_valid(mesh, 1.0);
  while (journal.redo(mesh)) {
  }
  EXPECT_EQ(mesh.hash(), hashes.back());
  expect_valid(mesh, 1.0);
}

TEST(Journal, forgets_undone_steps_when_another_is_appended) {
  Random random(2);
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  for (unsigned i = 0; i < 3; ++i) journal.append(random_step(mesh, random));
  journal.undo(mesh);
  journal.undo(mesh);
  journal.append(random_step(mesh, random));
  EXPECT_EQ(journal.size(), 2U);
  EXPECT_EQ(journal.position(), 2U);
  EXPECT_FALSE(journal.redo(mesh));
  expect_valid(mesh, 1.0);
}

TEST(Journal, undo_only_raises_generations) {
  Random random(3);
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  journal.append(random_step(mesh, random));
  std::vector<std::uint32_t> before;
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) before.push_back(mesh.generation(TetId(slot)));
  std::vector<TetId> made;
  for (const TetId tet : journal.step(0).new_tets) {
    if (mesh.is_live(tet)) made.push_back(tet);
  }
  journal.undo(mesh);
  for (const TetId tet : made) EXPECT_GT(mesh.generation(tet), before[tet.value]);
  journal.redo(mesh);
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    EXPECT_GE(mesh.generation(TetId(slot)), before[slot]);
  }
  expect_valid(mesh, 1.0);
}

}  // namespace
}  // namespace incise::test
