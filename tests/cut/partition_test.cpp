// SPDX-License-Identifier: Apache-2.0
// What the cutter takes apart, against the oracle: the same subdivided body, joined again, and separated along the same
// walls.
#include <gtest/gtest.h>

#include <map>

#include "cut/flagged_body.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random_strokes.h"
#include "support/star_separation.h"

namespace incise::test::partition_test {
namespace {

/// A cut body with its copies made one again, and the faces that were walls.
struct Joined {
  std::vector<TetId> tets;  ///< of the cut body, in order
  TetMesh mesh;
  std::vector<IncisionFace> walls;
  bool is_closed = true;  ///< not where a later sheet divided one side of a wall alone

  explicit Joined(const TetMesh& cut) {
    TetSoup soup;
    std::map<std::array<double, 3>, std::uint32_t> points;
    cut.for_each_tet([&](TetId tet) {
      tets.push_back(tet);
      soup.tets.emplace_back();
      for (unsigned c = 0; c < 4; ++c) {
        const Vec3& p = cut.rest(cut.vertices(tet)[c]);
        const auto at = points.emplace(std::array{p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(points.size()));
        if (at.second) soup.points.push_back(p);
        soup.tets.back()[c] = at.first->second;
      }
    });
    mesh = build(std::move(soup));
    find_walls(cut);
  }

 private:
  void find_walls(const TetMesh& cut) {
    for (std::uint32_t t = 0; t < tets.size(); ++t) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = cut.links(tets[t])[s], joined = mesh.links(TetId(t))[s];
        if (!link.is_boundary() || link.tag() == 0) continue;
        is_closed &= !joined.is_boundary();
        if (!joined.is_boundary() && Side(TetId(t), s) < joined.side())
          walls.push_back({Side(TetId(t), s), joined.side()});
      }
    }
  }
};

/// Whether corners share copies alike in both.
bool have_same_copies(const Joined& joined, const TetMesh& cut) {
  std::map<VertexId, VertexId> to_cut, to_joined;
  bool is_same = true;
  for (std::uint32_t t = 0; t < joined.tets.size(); ++t) {
    for (unsigned c = 0; c < 4; ++c) {
      const VertexId v = joined.mesh.vertices(TetId(t))[c], w = cut.vertices(joined.tets[t])[c];
      is_same &= to_cut.try_emplace(v, w).first->second == w && to_joined.try_emplace(w, v).first->second == v;
    }
  }
  return is_same;
}

/// Returns whether there was something to compare.
bool expect_partition_of_oracle(const TetMesh& cut) {
  Joined joined(cut);
  if (!joined.is_closed) return false;
  const std::size_t walls = joined.walls.size(), vertices = joined.mesh.vertex_count();
  const Separation oracle = separate_stars(joined.mesh, joined.walls);
  EXPECT_EQ(oracle.pinched_edges, 0U);
  EXPECT_EQ(oracle.latent_faces, 0U);
  EXPECT_EQ(oracle.opened_faces, walls);
  EXPECT_EQ(vertices + oracle.copied_vertices, cut.vertex_count());
  EXPECT_TRUE(have_same_copies(joined, cut));
  return true;
}

TEST(Partition, of_random_planes_is_the_oracles) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Vec3 normal = random.point(-1, 1);
    Engine engine = make_engine(jittered_cube(4, seed), seed % 2 == 0 ? 0.0 : 0.2);
    const CutStatistics done = cut(engine, plane(engine, normal, normal.dot(random.point(0.2, 0.8))));
    EXPECT_EQ(static_cast<std::size_t>(done.incision_faces), Joined(engine.mesh()).walls.size());
    EXPECT_TRUE(expect_partition_of_oracle(engine.mesh()));
  }
}

TEST(Partition, of_random_strokes_is_the_oracles) {
  unsigned compared = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Engine engine = make_engine(jittered_cube(4, seed), seed % 2 == 0 ? 0.0 : 0.2);
    cut(engine, random_stroke(random, {Vec3(0, 0, 0), Vec3(1, 1, 1)}));
    compared += expect_partition_of_oracle(engine.mesh()) ? 1U : 0U;
  }
  EXPECT_GE(compared, 30U);
}

TEST(Partition, of_any_flags_is_the_oracles_round_after_round) {
  Random random(1);
  for (unsigned run = 0; run < 10; ++run) {
    SCOPED_TRACE(run);
    FlaggedBody body(jittered_cube(3, run));
    for (const double share : {0.05 + 0.1 * run, 0.05, 0.05}) {
      body.toggle_some(random, share);
      body.place_points(random, 0.2);
      body.rebuild();
      EXPECT_TRUE(expect_partition_of_oracle(body.mesh()));
    }
  }
}

}  // namespace
}  // namespace incise::test::partition_test
