// SPDX-License-Identifier: Apache-2.0
// In which order a step is told, and that its records fit the follower at each call.
#include "incise/mesh/journal_visitor.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::journal_visitor_test {
namespace {

/// What is told, as words.
class Listener final : public JournalVisitor {
 public:
  std::vector<std::string> told;
  std::vector<BornVertex> births;

  void born(const BornVertex& vertex) override {
    births.push_back(vertex);
    note("born", vertex.id.value);
  }
  void moved(const MovedVertex& vertex) override { note("moved", vertex.id.value); }
  void copied(const CopiedVertex& vertex) override { note("copied", vertex.id.value); }
  void replaced(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) override {
    told.push_back("replaced " + std::to_string(consumed.size()) + " by " + std::to_string(produced.size()));
  }
  void rewired(const RewiredTet& tet) override { note("rewired", tet.id.value); }
  void opened(const OpenedFace& face) override { note("opened", face.a.tet().value); }
  void closed(const OpenedFace& face) override { note("closed", face.a.tet().value); }
  void died(VertexId vertex) override { note("died", vertex.value); }

 private:
  void note(const char* what, std::uint32_t id) { told.push_back(what + (" " + std::to_string(id))); }
};

BornVertex birth(std::uint32_t id, std::uint32_t a, std::uint32_t b) {
  return {VertexId(id), {VertexId(a), VertexId(b), {}, {}}, {0.5, 0.5, 0, 0}, Vec3::Zero(), Vec3::Zero()};
}
MovedVertex move(std::uint32_t id) {
  MovedVertex moved{};
  moved.id = VertexId(id);
  return moved;
}

/// A step with one record of each kind, or two.
Step every_record() {
  Step step;
  step.born = {birth(10, 0, 1), birth(11, 10, 2)};
  step.moved = {move(3)};
  step.copied = {{VertexId(12), VertexId(11)}};
  step.consumed = {{TetId(0), {}}};
  step.produced = {{TetId(0), TetId(0), {}, 0}, {TetId(5), TetId(0), {}, 0}};
  step.rewired = {{TetId(1), {}, {}}};
  step.opened = {{Side(TetId(5), 0), Side(TetId(1), 0), 1}};
  step.closed = {{Side(TetId(2), 0), Side(TetId(3), 0), 1}};
  step.died = {VertexId(4)};
  return step;
}

const std::vector<std::string> kNetOrder = {"born 10",   "born 11",  "moved 3",  "copied 12", "replaced 1 by 2",
                                            "rewired 1", "opened 5", "closed 2", "died 4"};

TEST(JournalVisitor, tells_the_lists_in_the_order_in_which_they_take_effect) {
  Listener listener;
  visit(every_record(), listener);
  EXPECT_EQ(listener.told, kNetOrder);
}

TEST(JournalVisitor, tells_nothing_of_an_empty_step) {
  Listener listener;
  visit(Step(), listener);
  EXPECT_TRUE(listener.told.empty());
}

TEST(JournalVisitor, names_the_source_where_a_parent_is_a_copy_that_comes_later) {
  Step step;
  step.born = {birth(10, 21, 1)};
  step.copied = {{VertexId(20), VertexId(2)}, {VertexId(21), VertexId(20)}};
  Listener listener;
  visit(step, listener);
  ASSERT_EQ(listener.births.size(), 1U);
  EXPECT_EQ(listener.births[0].parents[0], VertexId(2));
  EXPECT_EQ(listener.births[0].parents[1], VertexId(1));
  EXPECT_FALSE(listener.births[0].parents[2].is_valid());
}

Step with_edits() {
  Step step = every_record();
  step.copied.clear();
  step.rewired.clear();
  step.edits = {
      {Edit::Kind::kRemesh, 0, 1, 2}, {Edit::Kind::kMove, 0, 1, 2}, {Edit::Kind::kRemesh, kInvalidIndex, 3, 3}};
  step.edit_consumed = {{TetId(0), {}}, {TetId(5), {}}, {TetId(6), {}}};
  step.edit_produced = {{TetId(5), TetId(0), {}, 0}, {TetId(6), TetId(0), {}, 0}, {TetId(0), TetId(5), {}, 0}};
  return step;
}

TEST(JournalVisitor, tells_edits_one_by_one_or_their_net_effect_as_asked) {
  Listener edits, net;
  visit(with_edits(), edits);
  EXPECT_EQ(edits.told, (std::vector<std::string>{"born 10", "replaced 1 by 2", "moved 3", "replaced 2 by 1",
                                                  "opened 5", "closed 2", "died 4"}));
  visit(with_edits(), net, StepReading::kNet);
  EXPECT_EQ(net.told, (std::vector<std::string>{"born 10", "born 11", "moved 3", "replaced 1 by 2", "opened 5",
                                                "closed 2", "died 4"}));
}

/// Follows tets and vertices by the visitor alone, and fails where a call relies on something that is not there.
class Follower final : public JournalVisitor {
 public:
  explicit Follower(const TetMesh& mesh) {
    mesh.for_each_vertex([&](VertexId v) { is_live(v) = 1; });
    mesh.for_each_tet([&](TetId t) { vertices(t) = mesh.vertices(t); });
  }
  void born(const BornVertex& born) override {
    for (const VertexId parent : born.parents) EXPECT_TRUE(!parent.is_valid() || is_live(parent) != 0);
    is_live(born.id) = 1;
  }
  void moved(const MovedVertex& moved) override {
    for (const VertexId v : moved.basis) EXPECT_NE(is_live(v), 0);
  }
  void copied(const CopiedVertex& copied) override {
    EXPECT_NE(is_live(copied.source), 0);
    is_live(copied.id) = 1;
  }
  void replaced(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) override {
    for (const ConsumedTet& tet : consumed) {
      EXPECT_EQ(vertices(tet.id), tet.vertices);
      vertices(tet.id) = {};
    }
    for (const ProducedTet& tet : produced) {
      for (const VertexId v : tet.vertices) EXPECT_NE(is_live(v), 0);
      vertices(tet.id) = tet.vertices;
    }
  }
  void rewired(const RewiredTet& tet) override {
    EXPECT_EQ(vertices(tet.id), tet.old_vertices);
    vertices(tet.id) = tet.vertices;
  }
  void died(VertexId vertex) override { is_live(vertex) = 0; }

  void expect_is(const TetMesh& mesh) {
    for (std::uint32_t slot = 0; slot < mesh.vertex_slots(); ++slot) {
      EXPECT_EQ(is_live(VertexId(slot)) != 0, mesh.is_live(VertexId(slot))) << "vertex " << slot;
    }
    for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
      const TetId tet(slot);
      EXPECT_EQ(vertices(tet), mesh.is_live(tet) ? mesh.vertices(tet) : TetVertices{}) << "tet " << slot;
    }
  }

 private:
  std::vector<char> live_;
  std::vector<TetVertices> tets_;

  char& is_live(VertexId v) {
    if (v.value >= live_.size()) live_.resize(v.value + 1);
    return live_[v.value];
  }
  TetVertices& vertices(TetId t) {
    if (t.value >= tets_.size()) tets_.resize(t.value + 1);
    return tets_[t.value];
  }
};

TEST(JournalVisitor, is_enough_to_follow_a_cut_and_its_maintenance) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    EngineOptions options;
    options.cut.profile = profile;
    Result<Engine> engine = Engine::create(build(jittered_cube(4, 3)), options);
    ASSERT_TRUE(engine.ok());
    Follower by_edits(engine->mesh()), by_lists(engine->mesh());
    ASSERT_TRUE(engine->cut(plane(*engine, {1, 0.2, 0.1}, 0.6)).ok());
    ASSERT_TRUE(engine->cut(plane(*engine, {-0.3, 1, 0.2}, 0.4)).ok());
    for (std::size_t i = 0; i < engine->journal().position(); ++i) {
      visit(engine->journal().step(i), by_edits);
      visit(engine->journal().step(i), by_lists, StepReading::kNet);
    }
    by_edits.expect_is(engine->mesh());
    by_lists.expect_is(engine->mesh());
    expect_valid(engine->mesh(), 1.0, profile == Profile::kPaper ? 1e-2 : 1e-9);
  }
}

}  // namespace
}  // namespace incise::test::journal_visitor_test
