// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/journal.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "mesh/random_step.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::journal_test {
namespace {

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

TEST(Journal, gives_every_step_a_serial_of_its_own) {
  Random random(4);
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  EXPECT_EQ(journal.serial_before(0), 0U);
  journal.append(random_step(mesh, random));
  journal.append(random_step(mesh, random));
  EXPECT_EQ(journal.step(0).serial, 1U);
  EXPECT_EQ(journal.step(1).serial, 2U);
  journal.undo(mesh);
  EXPECT_EQ(journal.serial_before(journal.position()), 1U);
  journal.redo(mesh);
  EXPECT_EQ(journal.step(1).serial, 2U) << "a redo brings the same step back";
  journal.undo(mesh);
  journal.append(random_step(mesh, random));
  EXPECT_EQ(journal.step(1).serial, 3U) << "another step, be it the same to the bit";
  EXPECT_EQ(journal.newest_serial(), 3U);
  expect_valid(mesh, 1.0);
}

TEST(Journal, takes_back_and_drops_what_has_failed) {
  Random random(5);
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  journal.append(random_step(mesh, random));
  const std::uint64_t hash = mesh.hash();
  journal.append(random_step(mesh, random));
  journal.append(random_step(mesh, random));
  journal.take_back(mesh, 1);
  EXPECT_EQ(mesh.hash(), hash);
  EXPECT_EQ(journal.size(), 1U);
  EXPECT_FALSE(journal.redo(mesh));
  journal.append(random_step(mesh, random));
  EXPECT_EQ(journal.step(1).serial, 4U);
  expect_valid(mesh, 1.0);
}

TEST(Journal, names_all_that_a_step_touched_and_keeps_no_room_that_it_does_not_need) {
  Random random(7);
  TetMesh mesh = build(kuhn_cube(2));
  for (unsigned i = 0; i < 10; ++i) {
    const TetMesh before = mesh;
    const Step step = random_step(mesh, random);
    std::set<TetId> touched(step.new_tets.begin(), step.new_tets.end());
    step.for_each_tet_before([&](TetId tet) { EXPECT_TRUE(touched.insert(tet).second) << tet.value << " twice"; });
    before.for_each_tet([&](TetId tet) {
      const bool is_same =
          mesh.is_live(tet) && mesh.vertices(tet) == before.vertices(tet) && mesh.links(tet) == before.links(tet);
      EXPECT_TRUE(is_same || touched.contains(tet)) << tet.value;
    });
    for (std::size_t k = 0; k < step.consumed.size(); ++k) {
      const TetImage image = step.consumed_image(k);
      EXPECT_EQ(image.links, before.links(image.id));
      EXPECT_EQ(image.region, before.region(image.id));
    }
    EXPECT_EQ(step.consumed.capacity(), step.consumed.size());
    EXPECT_EQ(step.produced.capacity(), step.produced.size());
    EXPECT_EQ(step.kept.capacity(), step.kept.size());
    EXPECT_EQ(step.before.sides.capacity(), step.before.sides.size());
    EXPECT_EQ(step.before.vertices.capacity(), step.before.vertices.size());
    EXPECT_EQ(step.before.ties.capacity(), step.before.ties.size());
  }
}

TEST(Journal, undo_in_a_moving_body_leaves_vertices_where_the_step_had_left_them) {
  Random random(8);
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  journal.append(random_step(mesh, random));
  ASSERT_FALSE(journal.step(0).before.ties.empty());
  std::vector<Vec3> moved;
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) moved.push_back(mesh.current(VertexId(v)) + Vec3(0, 0, 0.1));
  mesh.set_current(moved);
  journal.undo(mesh);
  for (const TiedVertex& tie : journal.step(0).before.ties) {
    EXPECT_EQ(mesh.current(tie.id), moved[tie.id.value]);
    EXPECT_EQ(mesh.tet_of(tie.id), tie.tet);
  }
  for (const VertexImage& image : journal.step(0).before.vertices) EXPECT_EQ(mesh.current(image.id), image.current);
  journal.redo(mesh);
  for (const TiedVertex& tie : journal.step(0).before.ties) EXPECT_EQ(mesh.current(tie.id), moved[tie.id.value]);
}

TEST(Journal, trims_steps_and_gives_their_memory_back) {
  Random random(6);
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  std::vector<std::uint64_t> hashes = {mesh.hash()};
  for (unsigned i = 0; i < 20; ++i) {
    journal.append(random_step(mesh, random));
    hashes.push_back(mesh.hash());
  }
  const std::size_t before = journal.memory_bytes();
  journal.trim(17);
  EXPECT_LT(journal.memory_bytes(), before / 4);
  EXPECT_EQ(journal.first(), 17U);
  EXPECT_EQ(journal.position(), 20U);
  EXPECT_EQ(journal.size(), 20U);
  EXPECT_EQ(journal.step(17).serial, 18U);
  EXPECT_EQ(journal.serial_before(17), 17U);
  for (std::size_t at = 20; at-- > 17;) {
    ASSERT_TRUE(journal.undo(mesh));
    EXPECT_EQ(mesh.hash(), hashes[at]);
  }
  EXPECT_FALSE(journal.undo(mesh)) << "what was trimmed stays";
  while (journal.redo(mesh)) {
  }
  EXPECT_EQ(mesh.hash(), hashes.back());
  journal.trim(100);
  EXPECT_EQ(journal.first(), 20U) << "at most all";
  journal.append(random_step(mesh, random));
  EXPECT_EQ(journal.step(20).serial, 21U);
  expect_valid(mesh, 1.0);
}

}  // namespace
}  // namespace incise::test::journal_test
