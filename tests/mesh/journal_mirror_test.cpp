// SPDX-License-Identifier: Apache-2.0
// What the mirror tells solvers beside the mesh itself, which the tests of the journal compare bit for bit.
#include "incise/mesh/journal_mirror.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/shapes.h"

namespace journal_mirror_test {
namespace {

using namespace incise;

constexpr std::uint32_t kHeld = 4;

class Mirror : public testing::Test {
 protected:
  Mirror() {
    TetSoup soup = kuhn_cube(4);
    jitter(soup, 0.1, 3);
    engine_.emplace(Engine::create(std::move(TetMesh::build(soup)).value()).value());
    mirror_.emplace(engine_->mesh());
    for (std::uint32_t v = 0; v < mirror_->vertices().size(); ++v) {
      JournalMirror::Vertex& vertex = mirror_->vertex(VertexId(v));
      if (vertex.rest.x() == 0) vertex.marks = kHeld;
    }
  }
  void cut(const Vec3& normal, double offset) {
    ASSERT_TRUE(engine_->cut(*plane_stroke(rest_bounds(engine_->mesh()), normal, offset)).ok());
  }
  void follow() {
    mirror_->follow(engine_->journal());
    ASSERT_EQ(mirror_->difference(engine_->mesh()), "");
  }
  void expect_marks_on_the_held_side_alone() const {
    for (const JournalMirror::Vertex& vertex : mirror_->vertices()) {
      if (!vertex.is_live) continue;
      EXPECT_EQ(vertex.marks, vertex.rest.x() == 0 ? kHeld : 0) << vertex.rest.transpose();
    }
  }
  /// The tets of each vertex are those that have it.
  void expect_sound_stars() const {
    std::vector<std::vector<TetId>> wanted(mirror_->vertices().size());
    for (std::uint32_t t = 0; t < mirror_->tets().size(); ++t) {
      if (!mirror_->tets()[t].is_live()) continue;
      for (const VertexId v : mirror_->tets()[t].vertices) wanted[v.value].push_back(TetId(t));
    }
    for (std::uint32_t v = 0; v < wanted.size(); ++v) EXPECT_EQ(mirror_->tets_of(VertexId(v)), wanted[v]) << v;
  }
  /// Corners of all live tets at rest, by slot.
  using Shapes = std::vector<std::vector<Vec3>>;
  [[nodiscard]] Shapes shapes() const {
    Shapes found(mirror_->tets().size());
    for (std::size_t t = 0; t < found.size(); ++t) {
      const JournalMirror::Tet& tet = mirror_->tets()[t];
      if (!tet.is_live()) continue;
      for (const VertexId v : tet.vertices) {
        found[t].push_back(mirror_->vertex(v).rest);
        found[t].push_back(Vec3(v.value, tet.region, 0));
      }
    }
    return found;
  }
  /// What differs from `before` is told, in order, and only what is live.
  void expect_all_changes_told(const Shapes& before) const {
    const Shapes now = shapes();
    const std::vector<TetId>& told = mirror_->changed_tets();
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    for (const TetId tet : told) EXPECT_TRUE(mirror_->tet(tet).is_live());
    for (std::uint32_t t = 0; t < now.size(); ++t) {
      const bool is_same = t < before.size() && before[t] == now[t];
      if (now[t].empty() || is_same) continue;
      EXPECT_TRUE(std::binary_search(told.begin(), told.end(), TetId(t))) << t;
    }
  }

  std::optional<Engine> engine_;
  std::optional<JournalMirror> mirror_;
};

TEST_F(Mirror, copies_of_held_vertices_are_held) {
  cut(Vec3(0, 1, 0.1), 0.52);  // through the held side
  follow();
  const auto& copied = engine_->journal().step(0).copied;
  EXPECT_TRUE(std::any_of(copied.begin(), copied.end(),
                          [&](const CopiedVertex& copy) { return mirror_->vertex(copy.id).marks == kHeld; }));
  expect_marks_on_the_held_side_alone();
  cut(Vec3(0.1, 0, 1), 0.6);
  follow();
  expect_marks_on_the_held_side_alone();
}

TEST_F(Mirror, vertices_at_a_front_are_held_where_all_their_parents_are) {
  for (unsigned i = 0; i <= 12; ++i) {
    const double z = 1.1 - 0.1 * i;
    const BladePose pose{{Vec3(-0.2, 0.47, z), Vec3(0.5, 0.5, z), Vec3(1.2, 0.55, z)}, Vec3(0, 0, -1)};
    ASSERT_TRUE(i == 0 ? engine_->begin_stroke(pose).ok() : engine_->step(pose).ok());
    const Shapes before = shapes();
    follow();
    expect_marks_on_the_held_side_alone();
    expect_all_changes_told(before);
  }
}

TEST_F(Mirror, tells_which_tets_have_changed) {
  cut(Vec3(1, 0, 0), 0.5);
  Shapes before = shapes();
  follow();
  expect_all_changes_told(before);
  before = shapes();
  follow();
  EXPECT_TRUE(mirror_->changed_tets().empty());
  cut(Vec3(1, 1, 1), 0.2);  // a corner
  follow();
  expect_all_changes_told(before);
  EXPECT_LT(mirror_->changed_tets().size(), engine_->mesh().tet_count() / 2);
  before = shapes();
  ASSERT_TRUE(engine_->improve().ok());
  follow();
  expect_all_changes_told(before);
}

TEST_F(Mirror, tells_what_undo_and_redo_have_changed) {
  const Shapes at_first = shapes();
  cut(Vec3(0, 1, 0.1), 0.52);
  follow();
  const Shapes cut_once = shapes();
  engine_->undo();
  follow();
  EXPECT_EQ(shapes(), at_first);
  expect_all_changes_told(cut_once);
  expect_sound_stars();
  engine_->redo();
  follow();
  EXPECT_EQ(shapes(), cut_once);
  expect_all_changes_told(at_first);
  expect_sound_stars();
  expect_marks_on_the_held_side_alone();
}

TEST_F(Mirror, knows_the_tets_of_each_vertex) {
  expect_sound_stars();
  cut(Vec3(1, 0.3, 0), 0.5);
  cut(Vec3(0, 0.3, 1), 0.5);
  follow();
  expect_sound_stars();
  ASSERT_TRUE(engine_->improve().ok());
  follow();
  expect_sound_stars();
}

}  // namespace

}  // namespace journal_mirror_test
