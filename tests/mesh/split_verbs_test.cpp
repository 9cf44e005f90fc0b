// SPDX-License-Identifier: Apache-2.0
// Splitting faces and tets, moving vertices; programs of all verbs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "incise/mesh/journal.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/star.h"
#include "incise/mesh/validate.h"
#include "incise/mesh/verbs.h"
#include "support/random.h"

namespace incise::split_verbs_test {
namespace {

TetMesh cube(std::uint32_t n) {
  TetSoup soup = kuhn_cube(n);
  soup.regions.assign(soup.tets.size(), 0);
  for (std::size_t t = 0; t < soup.regions.size(); ++t) soup.regions[t] = static_cast<std::int32_t>(t % 3);
  return *TetMesh::build(soup);
}

void expect_valid(const TetMesh& mesh, double volume) {
  ValidateOptions options;
  options.expected_volume = volume;
  const ValidityReport report = validate(mesh, ValidateLevel::kGeometry, options);
  EXPECT_TRUE(report.ok);
  for (const Violation& v : report.first) ADD_FAILURE() << name_of(v.kind) << ' ' << v.ids[0] << ' ' << v.ids[1];
}

/// The links of a mesh are those that a new mesh of the same tets gets.
void expect_links_of_rebuild(const TetMesh& mesh) {
  std::vector<std::uint32_t> vertex_number(mesh.vertex_slots()), tet_number(mesh.tet_slots());
  std::vector<TetId> tets;
  TetSoup soup;
  mesh.for_each_vertex([&](VertexId v) {
    vertex_number[v.value] = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(mesh.rest(v));
  });
  mesh.for_each_tet([&](TetId t) {
    tet_number[t.value] = static_cast<std::uint32_t>(tets.size());
    tets.push_back(t);
    const TetVertices& v = mesh.vertices(t);
    soup.tets.push_back(
        {vertex_number[v[0].value], vertex_number[v[1].value], vertex_number[v[2].value], vertex_number[v[3].value]});
  });
  const Result<TetMesh> rebuilt = TetMesh::build(soup);
  ASSERT_TRUE(rebuilt.ok());
  for (const TetId t : tets) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link here = mesh.link({t, s});
      const Link there = rebuilt->link({TetId(tet_number[t.value]), s});
      ASSERT_EQ(here.is_boundary(), there.is_boundary()) << t.value << ' ' << s;
      if (!here.is_boundary()) {
        ASSERT_EQ(tet_number[here.side().tet().value], there.side().tet().value);
        ASSERT_EQ(here.side().side(), there.side().side());
      }
    }
  }
}

class Editor {
 public:
  explicit Editor(TetMesh start) : mesh(std::move(start)), hashes{mesh.hash()} {}

  template <class Plan, class... More>
  auto apply_plan(const Plan& plan, More... more) {
    Transaction transaction(mesh);
    if constexpr (std::is_void_v<decltype(apply(transaction, plan, more...))>) {
      apply(transaction, plan, more...);
      commit(transaction);
    } else {
      auto result = apply(transaction, plan, more...);
      commit(transaction);
      return result;
    }
  }
  /// Undo and redo of everything return every hash.
  void expect_reversible() {
    for (std::size_t i = hashes.size() - 1; i-- > 0;) {
      ASSERT_TRUE(journal.undo(mesh));
      ASSERT_EQ(mesh.hash(), hashes[i]);
    }
    for (std::size_t i = 1; i < hashes.size(); ++i) {
      ASSERT_TRUE(journal.redo(mesh));
      ASSERT_EQ(mesh.hash(), hashes[i]);
    }
  }

  TetMesh mesh;
  Journal journal;
  std::vector<std::uint64_t> hashes;

 private:
  void commit(Transaction& transaction) {
    journal.append(transaction.commit());
    hashes.push_back(mesh.hash());
  }
};

Side inner_face(const TetMesh& mesh) {
  for (std::uint32_t t = 0; t < mesh.tet_slots(); ++t) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.link({TetId(t), s}).is_boundary()) return {TetId(t), s};
    }
  }
  return {};
}

Side outer_face(const TetMesh& mesh) {
  for (std::uint32_t t = 0; t < mesh.tet_slots(); ++t) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.link({TetId(t), s}).is_boundary()) return {TetId(t), s};
    }
  }
  return {};
}

TEST(SplitFace, two_tets_become_six) {
  Editor edit(cube(2));
  const Side face = inner_face(edit.mesh);
  const TetId front = face.tet(), back = edit.mesh.link(face).side().tet();
  const double volume = edit.mesh.rest_volume(front) + edit.mesh.rest_volume(back);
  const std::int32_t front_region = edit.mesh.region(front), back_region = edit.mesh.region(back);
  const std::size_t tets = edit.mesh.tet_count();
  const SplitFaceResult result = edit.apply_plan(plan_split_face(edit.mesh, face, {0.5, 0.25, 0.25}));
  EXPECT_EQ(edit.mesh.tet_count(), tets + 4);
  double sum = 0;
  for (unsigned i = 0; i < 2; ++i) {
    for (const TetId child : result.parts[i].children) {
      if (!child.is_valid()) continue;
      sum += edit.mesh.rest_volume(child);
      EXPECT_EQ(edit.mesh.region(child), i == 0 ? front_region : back_region);
    }
  }
  EXPECT_NEAR(sum, volume, 1e-15);
  EXPECT_EQ(edit.mesh.shape_of(result.vertex), 0);
  EXPECT_EQ(edit.journal.step(0).consumed.size(), 2U);
  EXPECT_EQ(edit.journal.step(0).produced.size(), 6U);
  expect_valid(edit.mesh, 1.0);
  expect_links_of_rebuild(edit.mesh);
  edit.expect_reversible();
}

TEST(SplitFace, a_boundary_tet_becomes_three_and_its_vertex_lies_on_that_surface) {
  Editor edit(cube(2));
  const std::size_t tets = edit.mesh.tet_count();
  const SplitFaceResult result = edit.apply_plan(plan_split_face(edit.mesh, outer_face(edit.mesh), {0.2, 0.3, 0.5}));
  EXPECT_EQ(edit.mesh.tet_count(), tets + 2);
  EXPECT_FALSE(result.parts[1].tet.is_valid());
  EXPECT_EQ(edit.mesh.shape_of(result.vertex), shape::kSkin);
  expect_valid(edit.mesh, 1.0);
  expect_links_of_rebuild(edit.mesh);
  edit.expect_reversible();
}

TEST(SplitFace, parts_of_a_wall_keep_its_tag) {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  soup.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  Editor edit(*TetMesh::build(soup));
  for (const std::uint32_t v : {1U, 2U, 3U}) {
    edit.apply_plan(plan_duplicate_vertex(edit.mesh, VertexId(v), {TetId(1)}), 7U);
  }
  ASSERT_EQ(edit.mesh.link({TetId(0), 0}), Link::boundary(7));
  const SplitFaceResult result = edit.apply_plan(plan_split_face(edit.mesh, {TetId(0), 0}, {0.25, 0.25, 0.5}));
  EXPECT_EQ(edit.mesh.shape_of(result.vertex), shape::kWall);
  for (const TetId child : result.parts[0].children) {
    if (child.is_valid()) {
      EXPECT_EQ(edit.mesh.link({child, 0}), Link::boundary(7));
    }
  }
  expect_links_of_rebuild(edit.mesh);
  edit.expect_reversible();
}

TEST(SplitFace, refuses_what_it_cannot_split) {
  const TetMesh mesh = *TetMesh::build(kuhn_box({1, 1, 1}, {2, 2, 2}, {1, 1, 1}));
  const Side face = inner_face(mesh);
  EXPECT_EQ(plan_split_face(mesh, Side(TetId(99), 0), {0.5, 0.25, 0.25}).refusal, Refusal::kDead);
  EXPECT_EQ(plan_split_face(mesh, Side(), {0.5, 0.25, 0.25}).refusal, Refusal::kDead);
  EXPECT_EQ(plan_split_face(mesh, face, {0.5, 0.5, 0.0}).refusal, Refusal::kOutOfRange);
  EXPECT_EQ(plan_split_face(mesh, face, {0.5, 0.5, 0.5}).refusal, Refusal::kOutOfRange);
  EXPECT_EQ(plan_split_face(mesh, face, {0.5, 0.5, std::nan("")}).refusal, Refusal::kOutOfRange);
  EXPECT_EQ(plan_split_face(mesh, face, {1.0 - 2e-300, 1e-300, 1e-300}).refusal, Refusal::kOutOfRange);
  EXPECT_EQ(plan_split_face(mesh, face, {1.0 - 0x1p-53, 1e-300, 1e-300}).refusal, Refusal::kWouldInvert);
}

TEST(SplitTet, one_tet_becomes_four) {
  Editor edit(cube(2));
  const std::size_t tets = edit.mesh.tet_count();
  const double volume = edit.mesh.rest_volume(TetId(5));
  const SplitTetResult result = edit.apply_plan(plan_split_tet(edit.mesh, TetId(5), {0.125, 0.125, 0.25, 0.5}));
  EXPECT_EQ(edit.mesh.tet_count(), tets + 3);
  const std::array<double, 4> weights = {0.125, 0.125, 0.25, 0.5};
  for (unsigned c = 0; c < 4; ++c) {
    EXPECT_NEAR(edit.mesh.rest_volume(result.parts.children[c]), weights[c] * volume, 1e-16);
    EXPECT_EQ(edit.mesh.vertices(result.parts.children[c])[c], result.vertex);
    EXPECT_EQ(edit.mesh.region(result.parts.children[c]), 5 % 3);
  }
  EXPECT_EQ(edit.mesh.shape_of(result.vertex), 0);
  expect_valid(edit.mesh, 1.0);
  expect_links_of_rebuild(edit.mesh);
  edit.expect_reversible();
}

TEST(SplitTet, refuses_what_it_cannot_split) {
  const TetMesh mesh = *TetMesh::build(kuhn_box({1, 1, 1}, {2, 2, 2}, {1, 1, 1}));
  EXPECT_EQ(plan_split_tet(mesh, TetId(6), {0.25, 0.25, 0.25, 0.25}).refusal, Refusal::kDead);
  EXPECT_EQ(plan_split_tet(mesh, TetId(0), {0.25, 0.25, 0.25, 0.2}).refusal, Refusal::kOutOfRange);
  EXPECT_EQ(plan_split_tet(mesh, TetId(0), {-0.25, 0.5, 0.5, 0.25}).refusal, Refusal::kOutOfRange);
  EXPECT_EQ(plan_split_tet(mesh, TetId(0), {1.0 - 0x1p-53, 1e-300, 1e-300, 1e-300}).refusal, Refusal::kWouldInvert);
}

VertexId centre_of(const TetMesh& mesh) {
  VertexId centre;
  mesh.for_each_vertex([&](VertexId v) {
    if (mesh.shape_of(v) == 0) centre = v;
  });
  return centre;
}

TEST(MoveVertex, keeps_the_volume_around_and_says_where_it_samples) {
  Editor edit(cube(2));
  const VertexId centre = centre_of(edit.mesh);
  const Vec3 place(0.6, 0.45, 0.55);
  const MoveVertexPlan plan = plan_move_vertex(edit.mesh, centre, place);
  ASSERT_TRUE(plan);
  Vec3 sampled = Vec3::Zero();
  for (unsigned c = 0; c < 4; ++c) {
    EXPECT_GE(plan.weights[c], 0);
    sampled += plan.weights[c] * edit.mesh.rest(plan.basis[c]);
  }
  EXPECT_LE((sampled - place).norm(), 1e-15);
  edit.apply_plan(plan);
  EXPECT_EQ(edit.mesh.rest(centre), place);
  EXPECT_EQ(edit.mesh.current(centre), place);
  expect_valid(edit.mesh, 1.0);
  edit.expect_reversible();
}

TEST(MoveVertex, refuses_what_would_invert_a_tet) {
  TetSoup soup = kuhn_cube(2);
  soup.points.emplace_back(5, 5, 5);  // without tets
  const TetMesh mesh = *TetMesh::build(soup);
  const VertexId centre = centre_of(*TetMesh::build(kuhn_cube(2)));
  EXPECT_EQ(plan_move_vertex(mesh, centre, {1.5, 0.5, 0.5}).refusal, Refusal::kWouldInvert);
  EXPECT_EQ(plan_move_vertex(mesh, centre, {1.0, 0.5, 0.5}).refusal, Refusal::kWouldInvert);  // flat counts too
  EXPECT_EQ(plan_move_vertex(mesh, centre, {0.5, 0.5, std::nan("")}).refusal, Refusal::kOutOfRange);
  EXPECT_EQ(plan_move_vertex(mesh, VertexId(99), {0.5, 0.5, 0.5}).refusal, Refusal::kDead);
  EXPECT_EQ(plan_move_vertex(mesh, VertexId(27), {0.5, 0.5, 0.5}).refusal, Refusal::kNoStar);
}

TEST(MoveVertex, refuses_a_pinched_vertex) {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  soup.tets = {{0, 1, 2, 3}, {0, 5, 4, 6}};
  const TetMesh mesh = *TetMesh::build(soup);
  EXPECT_EQ(plan_move_vertex(mesh, VertexId(0), {0.01, 0, 0}).refusal, Refusal::kNoStar);
}

/// Draws edits that a mesh admits.
class Program {
 public:
  Program(Editor& editor, std::uint64_t seed) : edit_(editor), random_(seed) {}

  void run(unsigned edits, bool may_duplicate) {
    for (unsigned i = 0; i < edits; ++i) {
      switch (random_.integer(0, may_duplicate ? 4 : 3)) {
        case 0:
          split_edge();
          break;
        case 1:
          split_face();
          break;
        case 2:
          split_tet();
          break;
        case 3:
          move();
          break;
        default:
          duplicate();
          break;
      }
    }
  }

 private:
  TetId any_tet() {
    TetId tet;
    do {
      tet = TetId(static_cast<std::uint32_t>(random_.integer(0, edit_.mesh.tet_slots() - 1)));
    } while (!edit_.mesh.is_live(tet));
    return tet;
  }
  unsigned corner() { return static_cast<unsigned>(random_.integer(0, 3)); }
  void split_edge() {
    const TetId tet = any_tet();
    const TetVertices& v = edit_.mesh.vertices(tet);
    const auto [a, b] = kEdgeCorners[static_cast<std::size_t>(random_.integer(0, 5))];
    run_plan(plan_split_edge(edit_.mesh, v[a], v[b], tet, random_.real(0.2, 0.8)));
  }
  void split_face() {
    const double a = random_.real(0.2, 0.4), b = random_.real(0.2, 0.4);
    run_plan(plan_split_face(edit_.mesh, {any_tet(), corner()}, {a, b, 1.0 - a - b}));
  }
  void split_tet() {
    const double a = random_.real(0.1, 0.3), b = random_.real(0.1, 0.3), c = random_.real(0.1, 0.3);
    run_plan(plan_split_tet(edit_.mesh, any_tet(), {a, b, c, 1.0 - a - b - c}));
  }
  void move() {
    const VertexId v = edit_.mesh.vertices(any_tet())[corner()];
    if (edit_.mesh.shape_of(v) == 0) {
      run_plan(plan_move_vertex(edit_.mesh, v, edit_.mesh.rest(v) + random_.point(-0.03, 0.03)));
    }
  }
  /// Gives one tet a corner of its own where the rest of the star stays together.
  void duplicate() {
    const TetId tet = any_tet();
    const VertexId v = edit_.mesh.vertices(tet)[corner()];
    StarWalker walker;
    const std::vector<TetId> star = walker.star(edit_.mesh, v);
    for (const TetId other : star) {
      if (other == tet) continue;
      const auto leads_to = [&](Side side) { return edit_.mesh.link(side).side().tet() == tet; };
      if (walker.flood(edit_.mesh, v, other, leads_to).size() + 1 == star.size()) {
        edit_.apply_plan(plan_duplicate_vertex(edit_.mesh, v, {tet}), 1U);
      }
      return;
    }
  }
  template <class Plan>
  void run_plan(const Plan& plan) {
    if (plan) edit_.apply_plan(plan);
  }

  Editor& edit_;
  test::Random random_;
};

TEST(VerbProgram, splits_and_moves_keep_the_mesh_valid) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Editor edit(cube(2));
    Program program(edit, seed);
    for (unsigned round = 0; round < 5; ++round) {
      program.run(30, false);
      expect_valid(edit.mesh, 1.0);
      expect_links_of_rebuild(edit.mesh);
    }
    edit.expect_reversible();
  }
}

TEST(VerbProgram, links_equal_those_of_a_rebuild_and_undo_returns_every_hash) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Editor edit(cube(2));
    Program program(edit, seed);
    for (unsigned round = 0; round < 10; ++round) {
      program.run(10, true);
      expect_links_of_rebuild(edit.mesh);
    }
    EXPECT_GT(edit.hashes.size(), 50U);
    edit.expect_reversible();
  }
}

}  // namespace
}  // namespace incise::split_verbs_test
