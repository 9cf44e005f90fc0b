// SPDX-License-Identifier: Apache-2.0
// What tests of the engine ask again and again.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/components.h"
#include "incise/mesh/validate.h"

namespace incise::test {

TetMesh build(TetSoup soup);

/// An engine that cuts and maintains nothing, on a body that must be sound. `snap` is ignored by the paper profile.
Engine make_engine(TetSoup soup, double snap = 0.2, Profile profile = Profile::kIncise);

/// The volume of a mesh, summed with compensation.
double volume_of(const TetMesh& mesh);

/// The kinds and ids of a report's violations, for messages.
std::string describe(const ValidityReport& report);

/// The whole validity contract, with the volume given.
void expect_valid(const TetMesh& mesh, double volume, double tolerance = 1e-12);

/// The volumes of the pieces, ascending.
std::vector<double> piece_volumes(const TetMesh& mesh);
void expect_pieces(const TetMesh& mesh, std::vector<double> volumes, double tolerance);

/// V − E + F of the surface of every piece, in the order of `find_components`: 2 for a ball, 0 for a ring.
std::vector<int> euler_characteristics(const TetMesh& mesh);

/// The area of one side of the cut walls with `tag`; of all for 0.
double wall_area(const TetMesh& mesh, std::uint32_t tag = 0);

/// Cuts, or fails the test. Checks that nothing is broken.
CutStatistics cut(Engine& engine, const Stroke& stroke);

/// Does some work that changes the mesh, takes it back and does it again, each time to the hash there was. Returns the
/// hash after it.
template <class Work>
std::uint64_t expect_undone_and_redone(Engine& engine, Work&& work) {
  const std::uint64_t before = engine.mesh().hash();
  work();
  const std::uint64_t after = engine.mesh().hash();
  EXPECT_NE(after, before);
  EXPECT_TRUE(engine.undo());
  EXPECT_EQ(engine.mesh().hash(), before);
  EXPECT_TRUE(engine.redo());
  EXPECT_EQ(engine.mesh().hash(), after);
  return after;
}

/// The plane n·x = d through the whole body.
Stroke plane(const Engine& engine, const Vec3& normal, double offset);

}  // namespace incise::test
