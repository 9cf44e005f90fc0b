// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/journal_cursor.h"

#include <gtest/gtest.h>

#include "mesh/random_step.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::journal_cursor_test {
namespace {

using Way = JournalCursor::Way;

/// A mesh with three steps, and a follower that has seen two of them.
struct Followed {
  Followed() {
    for (unsigned i = 0; i < 2; ++i) step();
    cursor.move_to(journal);
  }
  void step() { journal.append(random_step(mesh, random)); }
  [[nodiscard]] Way way() const { return cursor.way_to(journal); }

  Random random{1};
  TetMesh mesh = build(kuhn_cube(2));
  Journal journal;
  JournalCursor cursor;
};

TEST(JournalCursor, stands_where_it_was_moved_to) {
  Followed f;
  EXPECT_EQ(f.way(), Way::kNone);
  EXPECT_EQ(f.cursor.position(), 2U);
  EXPECT_EQ(JournalCursor(f.journal).way_to(f.journal), Way::kNone);
  EXPECT_EQ(JournalCursor().way_to(Journal()), Way::kNone);
  expect_valid(f.mesh, 1.0);
}

TEST(JournalCursor, goes_forward_over_new_steps) {
  Followed f;
  f.step();
  f.step();
  EXPECT_EQ(f.way(), Way::kForward);
  EXPECT_EQ(JournalCursor().way_to(f.journal), Way::kForward);
  expect_valid(f.mesh, 1.0);
}

TEST(JournalCursor, sees_an_undo_and_what_took_its_place) {
  Followed f;
  f.journal.undo(f.mesh);
  EXPECT_EQ(f.way(), Way::kElsewhere);
  f.step();
  EXPECT_EQ(f.way(), Way::kElsewhere) << "the position is what it was, the step is another";
  f.step();
  EXPECT_EQ(f.way(), Way::kElsewhere);
  expect_valid(f.mesh, 1.0);
}

TEST(JournalCursor, does_not_notice_an_undo_that_was_redone) {
  Followed f;
  f.journal.undo(f.mesh);
  f.journal.redo(f.mesh);
  EXPECT_EQ(f.way(), Way::kNone);
  expect_valid(f.mesh, 1.0);
}

TEST(JournalCursor, tells_a_redo_from_a_new_step) {
  Followed f;
  f.step();
  f.journal.undo(f.mesh);
  f.cursor.move_to(f.journal);  // knows of the third step, and that it is undone
  f.journal.redo(f.mesh);
  EXPECT_EQ(f.way(), Way::kElsewhere);
  f.journal.undo(f.mesh);
  f.step();
  EXPECT_EQ(f.way(), Way::kForward);
  expect_valid(f.mesh, 1.0);
}

TEST(JournalCursor, sees_that_steps_it_has_not_seen_were_trimmed) {
  Followed f;
  f.step();
  f.journal.trim(2);
  EXPECT_EQ(f.way(), Way::kForward) << "what it has not seen is there";
  f.journal.trim(3);
  EXPECT_EQ(f.way(), Way::kElsewhere);
  f.cursor.move_to(f.journal);
  EXPECT_EQ(f.way(), Way::kNone);
  f.step();
  EXPECT_EQ(f.way(), Way::kForward);
  expect_valid(f.mesh, 1.0);
}

}  // namespace
}  // namespace incise::test::journal_cursor_test
