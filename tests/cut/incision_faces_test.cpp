// SPDX-License-Identifier: Apache-2.0
// The faces of the cut while a rebuild is under way, on a row of three tets.
#include "cut/incision_faces.h"

#include <gtest/gtest.h>

#include "cut/split_template.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::incision_faces_test {
namespace {

struct Row {
  TetMesh mesh = build(needle(3));
  SplitTemplates templates;
  ClosedComplex complex{templates};
  Transaction transaction{mesh};
  RebuildSettings settings;
  RebuildState state{transaction, complex, settings};
  IncisionFaces::Memory memory;
  IncisionFaces faces{state, memory};

  /// The face between a tet and the next one.
  [[nodiscard]] IncisionFace face_after(std::uint32_t tet) const {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(TetId(tet))[s];
      if (!link.is_boundary() && link.side().tet() == TetId(tet + 1)) return {Side(TetId(tet), s), link.side()};
    }
    ADD_FAILURE() << "no face after tet " << tet;
    return {};
  }
};

TEST(IncisionFaces, know_those_that_were_open_before) {
  Row row;
  const IncisionFace first = row.face_after(0), second = row.face_after(1);
  row.faces.note_standing(second.a);
  row.faces.note_standing(first.a);
  row.faces.sort_standing();
  EXPECT_TRUE(row.faces.stands_open(first));
  EXPECT_TRUE(row.faces.stands_open(second));
  EXPECT_FALSE(row.faces.stands_open({second.b, second.a}));
}

TEST(IncisionFaces, are_latent_while_their_sides_have_the_vertices_in_common) {
  const Row row;
  const IncisionFace first = row.face_after(0), second = row.face_after(1);
  EXPECT_TRUE(row.faces.is_latent(first));
  EXPECT_FALSE(row.faces.is_latent({first.a, second.b}));
}

TEST(IncisionFaces, link_both_sides_again_when_they_are_closed) {
  Row row;
  const IncisionFace face = row.face_after(0);
  row.transaction.open(face.a, face.b, 1);
  ASSERT_TRUE(row.mesh.link(face.a).is_boundary());
  row.faces.close(face);
  EXPECT_EQ(row.mesh.link(face.a), Link(face.b));
  EXPECT_EQ(row.mesh.link(face.b), Link(face.a));
}

TEST(IncisionFaces, mark_the_masters_of_one_that_was_left_joined) {
  Row row;
  const std::uint32_t master = row.complex.adopt(row.mesh, TetId(0));
  const std::uint32_t other = row.complex.adopt(row.mesh, TetId(2));
  row.faces.note_closed(row.face_after(0));  // tet 1 belongs to no master
  EXPECT_TRUE(row.complex[master].has_latent_faces);
  EXPECT_FALSE(row.complex[other].has_latent_faces);
}

TEST(IncisionFaces, name_the_closed_vertices_of_faces_between_two_pieces) {
  Row row;
  const std::uint32_t master = row.complex.adopt(row.mesh, TetId(1));
  const Side side = row.face_after(1).a;
  row.faces.note_apart(side);
  ASSERT_EQ(row.faces.apart().size(), 3U);
  for (unsigned k = 0; k < 3; ++k) {
    EXPECT_EQ(row.faces.apart()[k].vertex, row.mesh.vertices(side)[k]);
    EXPECT_EQ(row.faces.apart()[k].master, master);
  }
}

TEST(IncisionFaces, forget_all_when_a_run_begins) {
  Row row;
  const IncisionFace face = row.face_after(0);
  row.faces.all().push_back(face);
  row.faces.note_standing(face.a);
  row.faces.note_apart(face.a);
  IncisionFaces next(row.state, row.memory);
  EXPECT_TRUE(next.all().empty());
  EXPECT_TRUE(next.apart().empty());
  EXPECT_FALSE(next.stands_open(face));
}

}  // namespace
}  // namespace incise::test::incision_faces_test
