// SPDX-License-Identifier: Apache-2.0
// Masters made anew: any flags give a valid mesh, again and again, and what stays keeps its slots and places.
#include "cut/rebuild.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "cut/flagged_body.h"
#include "incise/mesh/validate.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::rebuild_test {
namespace {

/// A body as it stood before a rebuild.
struct Before {
  TetMesh mesh;
  std::vector<std::array<VertexId, 2>> halves;  ///< of every edge
  std::vector<Vec3> splits;                     ///< the rest places of its split points
  std::vector<VertexId> closed;                 ///< by vertex slot

  explicit Before(const FlaggedBody& body) : mesh(body.mesh()) {
    for (const ClosedEdge& edge : body.complex().edges().edges()) {
      halves.push_back(edge.halves);
      splits.push_back(edge.split.is_valid() ? mesh.rest(edge.split) : Vec3(Vec3::Zero()));
    }
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) closed.push_back(body.complex().closed(VertexId(v)));
  }
  [[nodiscard]] bool lives_on(const TetMesh& after, TetId tet) const {
    return mesh.is_live(tet) && after.is_live(tet) && mesh.generation(tet) == after.generation(tet);
  }
};

bool was_moved(const Step& step, VertexId vertex) {
  return std::any_of(step.moved.begin(), step.moved.end(), [&](const MovedVertex& m) { return m.id == vertex; });
}

/// Vertices that live on stand where they stood, bit for bit, unless the step tells that they moved.
void expect_kept_places(const Before& before, const FlaggedBody& body) {
  before.mesh.for_each_vertex([&](VertexId v) {
    const TetMesh& after = body.mesh();
    if (!after.is_live(v) || before.mesh.generation(v) != after.generation(v)) return;
    if (body.steps() > 0 && was_moved(body.last_step(), v)) return;
    EXPECT_EQ(before.mesh.rest(v), after.rest(v)) << v.value;
    EXPECT_EQ(before.mesh.current(v), after.current(v)) << v.value;
  });
}

/// Tets that live on and had one copy of a vertex to themselves, and have one now, have the same one; or the closed
/// vertex itself in its place.
void expect_kept_copies(const Before& before, const FlaggedBody& body) {
  const TetMesh& after = body.mesh();
  std::map<VertexId, std::set<TetId>> tets_before, tets_after;
  after.for_each_tet([&](TetId tet) {
    if (!before.lives_on(after, tet)) return;
    for (unsigned c = 0; c < 4; ++c) {
      tets_before[before.mesh.vertices(tet)[c]].insert(tet);
      tets_after[after.vertices(tet)[c]].insert(tet);
    }
  });
  for (const auto& [v, tets] : tets_before) {
    const TetId first = *tets.begin();
    const VertexId now = after.vertices(first)[before.mesh.corner_of(first, v)];
    if (now == v || tets_after[now] != tets) continue;
    EXPECT_EQ(now, before.closed[v.value]);
    EXPECT_EQ(after.current(now), before.mesh.current(v));
  }
}

/// Whether the blade has passed through all masters around an edge.
bool is_complete_around(const FlaggedBody& body, std::uint32_t edge) {
  bool is_complete = true;
  body.complex().for_each_around(
      edge, [&](std::uint32_t master) { is_complete &= !has_odd_face(body.complex()[master].flagged); });
  return is_complete;
}

/// Both sides of a split point that stays keep their copies, even where all tets around are new.
unsigned expect_kept_halves(const Before& before, const std::vector<bool>& was_complete, const FlaggedBody& body) {
  unsigned compared = 0;
  for (std::uint32_t e = 0; e < before.halves.size(); ++e) {
    const ClosedEdge& edge = body.complex().edges()[e];
    if (!edge.split.is_valid() || before.splits[e] != edge.position || !was_complete[e]) continue;
    const auto &was = before.halves[e], &is = edge.halves;
    if (!is_complete_around(body, e) || was[0] == was[1] || is[0] == is[1]) continue;
    EXPECT_EQ(was, is);
    for (const VertexId v : is) EXPECT_EQ(before.mesh.current(v), body.mesh().current(v));
    ++compared;
  }
  return compared;
}

/// Rebuilds, and checks all that must hold. Returns how many split points were compared side by side.
unsigned rebuild_and_check(FlaggedBody& body, double volume, const std::vector<bool>& was_complete) {
  const Before before(body);
  body.rebuild();
  expect_valid(body.mesh(), volume);
  expect_kept_places(before, body);
  expect_kept_copies(before, body);
  return expect_kept_halves(before, was_complete, body);
}

std::vector<bool> complete_edges(const FlaggedBody& body) {
  std::vector<bool> complete;
  for (std::uint32_t e = 0; e < body.complex().edges().size(); ++e) complete.push_back(is_complete_around(body, e));
  return complete;
}

/// One more change at random, with the wound open, and a rebuild.
unsigned change(FlaggedBody& body, Random& random, double flag_share, double on_share, double volume) {
  const std::vector<bool> was_complete = complete_edges(body);
  body.toggle_some(random, flag_share);
  body.put_some_on(random, on_share);
  body.place_points(random, 0.3);
  body.stand(random, 0.05);
  return rebuild_and_check(body, volume, was_complete);
}

void expect_undone(FlaggedBody& body, const std::vector<std::uint64_t>& hashes) {
  for (std::size_t i = hashes.size(); i-- > 1;) {
    EXPECT_EQ(body.mesh().hash(), hashes[i]);
    body.undo();
    EXPECT_EQ(body.mesh().hash(), hashes[i - 1]);
    body.redo();
    EXPECT_EQ(body.mesh().hash(), hashes[i]);
    body.undo();
  }
}

/// Four rounds of changes to a jittered cube, the first the largest.
void change_round_after_round(Random& random, std::uint64_t seed, double flag_share, double on_share) {
  SCOPED_TRACE(testing::Message() << seed << " " << flag_share << " " << on_share);
  FlaggedBody body(jittered_cube(3, seed));
  const double volume = volume_of(body.mesh());
  std::vector<std::uint64_t> hashes = {body.mesh().hash()};
  for (const double share : {1.0, 0.3, 0.03, 0.3}) {
    SCOPED_TRACE(hashes.size());
    change(body, random, share * flag_share, hashes.size() % 2 == 1 ? on_share : 0.0, volume);
    hashes.push_back(body.mesh().hash());
  }
  expect_undone(body, hashes);
}

// T5
TEST(Rebuild, makes_a_valid_mesh_of_any_flags_round_after_round) {
  Random random(4);
  for (const double flag_share : {0.05, 0.2, 0.5, 0.8, 1.0}) {
    for (std::uint64_t seed = 40; seed < 44; ++seed) change_round_after_round(random, seed, flag_share, 0.0);
  }
}

// Fails where faces are closed beside pinched edges: masters that are not rebuilt have walls there too, and points
// inside the body are passed over; where the rounds run out, sides are joined to themselves.
TEST(Rebuild, makes_a_valid_mesh_of_any_flags_beside_any_on_vertices) {
  Random random(4);
  for (const double flag_share : {0.05, 0.2, 0.5, 0.8, 1.0}) {
    for (std::uint64_t seed = 40; seed < 44; ++seed) change_round_after_round(random, seed, flag_share, 0.2);
  }
}

// --- single tets -----------------------------------------------------------------------------------------------------

TetSoup one_tet() {
  TetSoup soup;
  soup.points = {Vec3(0, 0, 0), Vec3(1, 0.1, 0), Vec3(0.2, 1, -0.1), Vec3(0.1, 0.3, 1)};
  soup.tets = {{0, 1, 2, 3}};
  return soup;
}

void expect_any_pattern_into_any_other(bool has_inner_points) {
  Random random(5);
  for (unsigned flags = 0; flags < 64; ++flags) {
    for (unsigned on = 0; on < 15; ++on) {
      SCOPED_TRACE(testing::Message() << flags << " " << on);
      FlaggedBody body(one_tet());
      body.complex().set_in_motion(has_inner_points);
      const double volume = volume_of(body.mesh());
      for (unsigned e = 0; e < 6; ++e) {
        if (((flags >> e) & 1U) != 0) body.toggle(body.complex()[0].edges[e], random.real(0.05, 0.95));
      }
      change(body, random, 0.0, 0.0, volume);
      for (unsigned c = 0; c < 4; ++c) {
        if (((on >> c) & 1U) != 0) body.put_on(VertexId(c));
      }
      for (const double share : {0.0, 0.4, 0.7}) change(body, random, share, 0.0, volume);
    }
  }
}

// T5
TEST(Rebuild, divides_a_tet_by_any_pattern_into_any_other) {
  for (const bool has_inner_points : {false, true}) expect_any_pattern_into_any_other(has_inner_points);
}

// T6
TEST(Rebuild, gives_one_corner_against_three_four_children_and_two_against_two_six) {
  const auto count_children = [](std::initializer_list<unsigned> edges) {
    FlaggedBody body(one_tet());
    for (const unsigned e : edges) body.toggle(body.complex()[0].edges[e], 0.5);
    const RebuildStatistics done = body.rebuild();
    return std::pair(body.mesh().tet_count(), (done.own_sides_after - done.own_sides_before) / 2);
  };
  EXPECT_EQ(count_children({0, 1, 2}), std::pair(std::size_t{4}, std::uint64_t{1}));
  EXPECT_EQ(count_children({1, 2, 3, 4}), std::pair(std::size_t{6}, std::uint64_t{2}));
}

// A front that goes straight through needs no point inside; in a body that moves it has one.
TEST(Rebuild, gives_a_tet_with_one_crossed_edge_six_children_at_rest_and_ten_in_a_body_that_moves) {
  const auto count = [](bool moves, unsigned edge) {
    Random random(edge);
    FlaggedBody body(one_tet());
    body.complex().set_in_motion(moves);
    body.toggle(body.complex()[0].edges[edge], 0.5);
    body.place_points(random, 0.0);
    body.rebuild();
    EXPECT_TRUE(validate(body.mesh(), ValidateLevel::kGeometry).ok);
    return std::pair(body.mesh().tet_count(), body.mesh().vertex_count());
  };
  for (unsigned edge = 0; edge < 6; ++edge) {  // corners, copies of the split point, front points, the one inside
    EXPECT_EQ(count(false, edge), std::pair(std::size_t{6}, std::size_t{4 + 2 + 2}));
    EXPECT_EQ(count(true, edge), std::pair(std::size_t{10}, std::size_t{4 + 2 + 2 + 1}));
  }
}

// --- colours ---------------------------------------------------------------------------------------------------------

/// A colour for every vertex: edges between colours are crossed, so that every tet is complete.
class Colouring {
 public:
  explicit Colouring(FlaggedBody& body) : body_(body), colours_(body.mesh().vertex_slots(), false) {}

  void change_some(Random& random, double share) {
    for (std::size_t v = 0; v < colours_.size(); ++v) colours_[v] = colours_[v] != (random.real(0, 1) < share);
    for (std::uint32_t e = 0; e < body_.complex().edges().size(); ++e) {
      const ClosedEdge& edge = body_.complex().edges()[e];
      if (edge.is_crossed != is_between(edge)) body_.toggle(e, random.real(0.05, 0.95));
    }
  }
  /// How many parts the vertices form that edges of one colour connect.
  [[nodiscard]] std::size_t count_parts() const {
    std::vector<std::size_t> part(colours_.size());
    for (std::size_t v = 0; v < part.size(); ++v) part[v] = v;
    for (std::size_t changes = 1; changes > 0;) {
      changes = 0;
      for (const ClosedEdge& edge : body_.complex().edges().edges()) {
        if (is_between(edge) || part[edge.a.value] == part[edge.b.value]) continue;
        part[edge.a.value] = part[edge.b.value] = std::min(part[edge.a.value], part[edge.b.value]);
        ++changes;
      }
    }
    return std::set<std::size_t>(part.begin(), part.end()).size();
  }
  /// Every piece of the body has vertices of one colour alone.
  void expect_pieces() const {
    const Components pieces = find_components(body_.mesh());
    EXPECT_EQ(pieces.count(), count_parts());
    std::vector<int> colour_of_piece(pieces.count(), -1);
    body_.mesh().for_each_tet([&](TetId tet) {
      for (const VertexId v : body_.mesh().vertices(tet)) {
        if (body_.complex().closed(v).value >= colours_.size()) continue;  // a split point
        int& seen = colour_of_piece[pieces.label[tet.value]];
        const int colour = colours_[body_.complex().closed(v).value] ? 1 : 0;
        EXPECT_TRUE(seen == -1 || seen == colour);
        seen = colour;
      }
    });
  }

 private:
  [[nodiscard]] bool is_between(const ClosedEdge& edge) const {
    return colours_[edge.a.value] != colours_[edge.b.value];
  }

  FlaggedBody& body_;
  std::vector<bool> colours_;
};

TEST(Rebuild, cuts_off_random_sets_of_vertices_whole_and_joins_them_again) {
  Random random(6);
  unsigned compared = 0;
  for (unsigned run = 0; run < 10; ++run) {
    SCOPED_TRACE(run);
    FlaggedBody body(jittered_cube(4, 60 + run));
    const double volume = volume_of(body.mesh());
    Colouring colouring(body);
    const std::vector<bool> all_complete(body.complex().edges().size(), true);
    for (const double share : {0.3, 0.1, 0.02, 0.02}) {
      SCOPED_TRACE(share);
      colouring.change_some(random, share);
      body.stand(random, 0.05);
      compared += rebuild_and_check(body, volume, all_complete);
      colouring.expect_pieces();
    }
  }
  EXPECT_GT(compared, 1000U);
}

// Fails as above.
TEST(Rebuild, stays_valid_where_vertices_take_part_in_the_cut) {
  Random random(8);
  for (unsigned run = 0; run < 10; ++run) {
    SCOPED_TRACE(run);
    FlaggedBody body(jittered_cube(4, 80 + run));
    const double volume = volume_of(body.mesh());
    Colouring colouring(body);
    const std::vector<bool> all_complete(body.complex().edges().size(), true);
    for (const double share : {0.3, 0.1, 0.02, 0.02}) {
      SCOPED_TRACE(share);
      colouring.change_some(random, share);
      body.put_some_on(random, 0.1);
      body.stand(random, 0.05);
      rebuild_and_check(body, volume, all_complete);
    }
  }
}

TEST(Rebuild, changes_nothing_where_nothing_has_changed) {
  Random random(7);
  FlaggedBody body(jittered_cube(3, 1));
  const double volume = volume_of(body.mesh());
  change(body, random, 0.1, 0.05, volume);
  const std::uint64_t hash = body.mesh().hash();
  for (std::uint32_t m = 0; m < body.complex().size(); ++m) body.complex().mark_dirty(m);
  body.rebuild();
  EXPECT_EQ(body.mesh().hash(), hash);
}

}  // namespace
}  // namespace incise::test::rebuild_test
