// SPDX-License-Identifier: Apache-2.0
// Maintenance of bodies that stand deformed: quality is judged at rest, and what is positive as it stands stays so.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <vector>

#include "incise/geom/quality.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/transaction.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random_strokes.h"

namespace incise::test::maintenance_deformed_test {
namespace {

using Deformation = std::function<Vec3(const Vec3&)>;

double current_volume6(const TetMesh& mesh, const TetVertices& v) {
  return signed_volume6(mesh.current(v[0]), mesh.current(v[1]), mesh.current(v[2]), mesh.current(v[3]));
}

/// The same body at rest, standing where the deformation takes it: every vertex gives way to one with that place.
TetMesh deformed(TetMesh mesh, const Deformation& deformation) {
  Transaction transaction(mesh);
  std::vector<VertexId> twins(mesh.vertex_slots());
  for (std::uint32_t slot = 0; slot < twins.size(); ++slot) {
    const std::array<VertexId, 1> source = {VertexId(slot)};
    const std::array<double, 1> weight = {1.0};
    const Vec3 rest = mesh.rest(source[0]);
    twins[slot] = transaction.add_vertex(source, weight, rest, deformation(rest));
    transaction.set_tet_of(twins[slot], mesh.tet_of(source[0]));
    transaction.set_shape(twins[slot], mesh.shape_of(source[0]));
    transaction.remove_vertex(source[0]);
  }
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned c = 0; c < 4; ++c) transaction.set_corner(tet, c, twins[mesh.vertices(tet)[c].value]);
  });
  transaction.commit();
  return mesh;
}

Vec3 affine(const Vec3& p) {
  return Vec3(3.0, -2.0, 1.0) + 1.3 * p.x() * Vec3(1, 0.2, -0.1) + 0.7 * p.y() * Vec3(-0.3, 1, 0.2) +
         p.z() * Vec3(0.1, 0.4, 1);
}
Vec3 bent(const Vec3& p) {
  return {p.x() + 0.6 * p.y() * p.y(), p.y() * (1.0 + 0.4 * p.x()), p.z() - 0.5 * p.x() * p.y() + 0.3 * p.y()};
}
/// Bent, and each vertex thrown about by up to `reach`.
Deformation shaken(double reach, std::uint64_t seed) {
  return
      [reach, random = Random(seed)](const Vec3& p) mutable -> Vec3 { return bent(p) + random.point(-reach, reach); };
}

Engine make_deformed_engine(const Deformation& deformation, bool maintains, Profile profile = Profile::kIncise) {
  EngineOptions options;
  options.cut = {profile, 0.0};
  options.maintain.merge = options.maintain.improve = maintains;
  options.maintain.work_units = 0;
  return Engine::create(deformed(build(jittered_cube(5, 9)), deformation), options).value();
}

std::size_t inverted_now(const TetMesh& mesh) {
  std::size_t count = 0;
  mesh.for_each_tet([&](TetId tet) { count += current_volume6(mesh, mesh.vertices(tet)) > 0 ? 0U : 1U; });
  return count;
}

/// Cuts three times; after each cut maintenance inverts nothing that stood upright. Where tets are inverted already, a
/// few of them may become more.
void cut_and_maintain(Engine& engine, std::uint64_t seed, std::size_t more = 0) {
  Random random(seed);
  for (unsigned i = 0; i < 3; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", stroke " << i);
    ASSERT_TRUE(engine.cut(random_stroke(random, {Vec3(0, 0, 0), Vec3(1, 1, 1)})).ok());
    const std::size_t inverted = inverted_now(engine.mesh());
    EXPECT_TRUE(engine.maintain().ok());
    EXPECT_LE(inverted_now(engine.mesh()), inverted + more);
    expect_valid(engine.mesh(), 1.0, 1e-9);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(DeformedMaintenance, leaves_no_tet_inverted_in_a_bent_body) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Engine engine = make_deformed_engine(bent, true);
    ASSERT_EQ(inverted_now(engine.mesh()), 0U);
    cut_and_maintain(engine, seed);
    EXPECT_EQ(inverted_now(engine.mesh()), 0U);
  }
}

TEST(DeformedMaintenance, inverts_nothing_more_in_a_body_that_is_partly_inverted) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Engine engine = make_deformed_engine(shaken(0.08, seed), true);
    ASSERT_GT(inverted_now(engine.mesh()), 0U);
    cut_and_maintain(engine, seed, 10);  // of some 360
  }
}

TEST(DeformedMaintenance, makes_tets_better_at_rest) {
  const Stroke stroke = *plane_stroke({Vec3(0, 0, 0), Vec3(1, 1, 1)}, Vec3(1, 0.1, 0.2), 0.57);
  Engine cut_only = make_deformed_engine(bent, false), maintained = make_deformed_engine(bent, true);
  ASSERT_TRUE(cut_only.cut(stroke).ok());
  ASSERT_TRUE(maintained.cut(stroke).ok());
  EXPECT_TRUE(maintained.maintain().ok());
  EXPECT_LT(measure_quality(maintained.mesh()).lr_max, 0.1 * measure_quality(cut_only.mesh()).lr_max);
}

TEST(DeformedMaintenance, is_that_of_the_body_at_rest_where_the_whole_moves_alike) {
  const Stroke stroke = *plane_stroke({Vec3(0, 0, 0), Vec3(1, 1, 1)}, Vec3(1, 0.1, 0.2), 0.57);
  Engine moved = make_deformed_engine(affine, true);
  Engine resting = make_deformed_engine([](const Vec3& p) { return p; }, true);
  for (Engine* engine : {&moved, &resting}) {
    ASSERT_TRUE(engine->cut(stroke).ok());
    EXPECT_TRUE(engine->maintain().ok());
  }
  EXPECT_EQ(moved.mesh().hash(), resting.mesh().hash());
  moved.mesh().for_each_vertex([&](VertexId v) {
    EXPECT_LT((moved.mesh().current(v) - affine(moved.mesh().rest(v))).norm(), 1e-12) << "vertex " << v.value;
  });
}

TEST(DeformedMaintenance, is_taken_back_with_the_places_as_they_were) {
  Engine engine = make_deformed_engine(bent, true);
  const TetMesh before = engine.mesh();
  cut_and_maintain(engine, 1);
  while (engine.undo()) {
  }
  EXPECT_EQ(engine.mesh().hash(), before.hash());
  before.for_each_vertex([&](VertexId v) { EXPECT_EQ(engine.mesh().current(v), before.current(v)); });
}

}  // namespace
}  // namespace incise::test::maintenance_deformed_test
