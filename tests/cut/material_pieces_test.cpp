// SPDX-License-Identifier: Apache-2.0
#include "cut/material_pieces.h"

#include <gtest/gtest.h>

#include <vector>

#include "incise/mesh/defects.h"
#include "support/engines.h"

namespace incise::test::material_pieces_test {
namespace {

/// Two tets side by side that share no face, and a third that shares one with the first.
TetMesh two_pieces() {
  TetSoup soup;
  soup.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1),
                 Vec3(5, 0, 0), Vec3(6, 0, 0), Vec3(5, 1, 0), Vec3(5, 0, 1)};
  soup.tets = {{0, 1, 2, 3}, {1, 4, 2, 3}, {5, 6, 7, 8}};
  normalise(soup);
  return build(soup);
}

TEST(MaterialPieces, tells_tets_and_vertices_of_two_pieces_apart) {
  const TetMesh mesh = two_pieces();
  const std::vector<TetId> tets = {TetId(0), TetId(1), TetId(2)};
  MaterialPieces pieces;
  pieces.find(mesh, tets);
  EXPECT_TRUE(pieces.has_several());
  EXPECT_FALSE(pieces.are_apart(TetId(0), TetId(1)));
  EXPECT_TRUE(pieces.are_apart(TetId(0), TetId(2)));
  EXPECT_TRUE(pieces.are_apart(TetId(0), VertexId(5)));
  EXPECT_FALSE(pieces.are_apart(TetId(2), VertexId(5)));
  EXPECT_TRUE(pieces.hang_together(mesh, TetId(0), TetId(1)));
  EXPECT_FALSE(pieces.hang_together(mesh, TetId(0), TetId(2)));
}

TEST(MaterialPieces, says_nothing_of_what_it_does_not_know) {
  const TetMesh mesh = two_pieces();
  const std::vector<TetId> tets = {TetId(0), TetId(2)};
  MaterialPieces pieces;
  pieces.find(mesh, tets);
  EXPECT_FALSE(pieces.knows(TetId(1)));
  EXPECT_FALSE(pieces.are_apart(TetId(1), TetId(2)));
  EXPECT_FALSE(pieces.are_apart(TetId(0), VertexId(4)));
  pieces.follow(TetId(1), TetId(0));
  EXPECT_TRUE(pieces.are_apart(TetId(1), TetId(2)));
  pieces.forget();
  EXPECT_FALSE(pieces.has_several());
  EXPECT_FALSE(pieces.are_apart(TetId(0), TetId(2)));
}

TEST(MaterialPieces, knows_that_all_hangs_together) {
  const TetMesh mesh = two_pieces();
  const std::vector<TetId> tets = {TetId(0), TetId(1)};
  MaterialPieces pieces;
  pieces.find(mesh, tets);
  EXPECT_FALSE(pieces.has_several());
  EXPECT_TRUE(pieces.knows(TetId(0)));
  EXPECT_FALSE(pieces.are_apart(TetId(0), VertexId(4)));
}

}  // namespace
}  // namespace incise::test::material_pieces_test
