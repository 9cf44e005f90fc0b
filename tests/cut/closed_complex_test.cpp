// SPDX-License-Identifier: Apache-2.0
// The closed complex: masters, their neighbours, edges and stars, against searches of the whole mesh.
#include "cut/closed_complex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cut/flagged_body.h"
#include "incise/mesh/defects.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::closed_complex_test {
namespace {

using Indices = std::set<std::uint32_t>;

/// The tets that have all of some vertices.
std::set<TetId> tets_with(const TetMesh& mesh, std::initializer_list<VertexId> vertices) {
  std::set<TetId> found;
  mesh.for_each_tet([&](TetId tet) {
    const bool has_all =
        std::all_of(vertices.begin(), vertices.end(), [&](VertexId v) { return mesh.corner_of(tet, v) < 4; });
    if (has_all) found.insert(tet);
  });
  return found;
}

Indices masters_around(const ClosedComplex& complex, std::uint32_t edge) {
  Indices found;
  complex.for_each_around(edge, [&](std::uint32_t master) { EXPECT_TRUE(found.insert(master).second); });
  return found;
}

struct SomeMasters {
  TetMesh mesh = build(jittered_cube(3, 5));
  SplitTemplates templates;
  ClosedComplex complex{templates};

  /// Adopts tets with some probability.
  explicit SomeMasters(double share) {
    Random random(1);
    mesh.for_each_tet([&](TetId tet) {
      if (random.real(0, 1) < share) complex.adopt(mesh, tet);
    });
  }
  [[nodiscard]] Indices masters_of(const std::set<TetId>& tets) const {
    Indices found;
    for (const TetId tet : tets) {
      if (complex.find(tet) != Master::kNone) found.insert(complex.find(tet));
    }
    return found;
  }
};

TEST(ClosedComplex, takes_a_tet_up_once_as_its_own_child) {
  SomeMasters some(0.0);
  EXPECT_EQ(some.complex.find(TetId(7)), Master::kNone);
  const std::uint32_t master = some.complex.adopt(some.mesh, TetId(7));
  EXPECT_EQ(some.complex.adopt(some.mesh, TetId(7)), master);
  EXPECT_EQ(some.complex.find(TetId(7)), master);
  EXPECT_EQ(some.complex.size(), 1U);
  EXPECT_EQ(some.complex[master].vertices, some.mesh.vertices(TetId(7)));
  EXPECT_FALSE(some.complex[master].is_divided());
  EXPECT_EQ(some.complex.children(some.complex[master])[0], TetId(7));
}

TEST(ClosedComplex, links_masters_that_share_a_face_and_leaves_the_others_to_the_mesh) {
  const SomeMasters some(0.5);
  for (std::uint32_t m = 0; m < some.complex.size(); ++m) {
    const Master& master = some.complex[m];
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = some.mesh.links(some.complex.children(master)[0])[s];
      const std::uint32_t expected = link.is_boundary() ? Master::kNone : some.complex.find(link.side().tet());
      EXPECT_EQ(master.behind[s], expected);
      EXPECT_EQ(some.complex.outside(some.mesh, master, s), link);
    }
  }
}

TEST(ClosedComplex, knows_the_masters_around_every_edge) {
  const SomeMasters some(0.5);
  for (std::uint32_t e = 0; e < some.complex.edges().size(); ++e) {
    const ClosedEdge& edge = some.complex.edges()[e];
    EXPECT_LT(edge.a, edge.b);
    EXPECT_EQ(masters_around(some.complex, e), some.masters_of(tets_with(some.mesh, {edge.a, edge.b})));
  }
}

TEST(ClosedComplex, takes_up_the_whole_star_of_a_vertex) {
  SomeMasters some(0.1);
  some.mesh.for_each_vertex([&](VertexId v) {
    const auto expected = tets_with(some.mesh, {v});
    const std::uint32_t seed = some.complex.adopt(some.mesh, *expected.begin());
    const auto& star = some.complex.star(some.mesh, seed, v);
    EXPECT_EQ(star.size(), expected.size());
    EXPECT_EQ(Indices(star.begin(), star.end()), some.masters_of(expected));
  });
}

TEST(ClosedComplex, finds_the_rest_of_a_pinched_star_among_its_masters) {
  TetSoup soup;  // two tets that share vertex 0 alone
  soup.points = {Vec3(0, 0, 0),  Vec3(1, 0, 0),  Vec3(0, 1, 0), Vec3(0, 0, 1),
                 Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)};
  soup.tets = {{0, 1, 2, 3}, {0, 4, 6, 5}};
  normalise(soup);
  const TetMesh mesh = build(soup);
  SplitTemplates templates;
  ClosedComplex complex(templates);
  const std::uint32_t first = complex.adopt(mesh, TetId(0));
  EXPECT_EQ(complex.star(mesh, first, VertexId(0)).size(), 1U);
  const std::vector<std::uint32_t> both = {first, complex.adopt(mesh, TetId(1))};
  EXPECT_EQ(complex.star(mesh, both[0], VertexId(0)), both);
  EXPECT_EQ(complex.star(mesh, both[0], VertexId(1)).size(), 1U);
}

TEST(ClosedComplex, lets_go_of_a_master) {
  SomeMasters some(1.0);
  const std::uint32_t gone = some.complex.find(TetId(20));
  const Master was = some.complex[gone];
  some.complex.release(gone);
  EXPECT_EQ(some.complex.find(TetId(20)), Master::kNone);
  for (const std::uint32_t e : was.edges) EXPECT_EQ(masters_around(some.complex, e).count(gone), 0U);
  for (const std::uint32_t behind : was.behind) {
    if (behind == Master::kNone) continue;
    const auto& sides = some.complex[behind].behind;
    EXPECT_EQ(std::count(sides.begin(), sides.end(), gone), 0);
  }
}

TEST(ClosedComplex, keeps_links_and_children_through_rebuilds) {
  Random random(3);
  FlaggedBody body(jittered_cube(3, 2));
  for (unsigned round = 0; round < 4; ++round) {
    body.toggle_some(random, 0.2);
    body.place_points(random, 0.2);
    body.rebuild();
    std::size_t children = 0;
    for (std::uint32_t m = 0; m < body.complex().size(); ++m) {
      for (const TetId tet : body.complex().children(body.complex()[m])) {
        EXPECT_TRUE(body.mesh().is_live(tet));
        EXPECT_EQ(body.complex().find(tet), m);
        ++children;
      }
    }
    EXPECT_EQ(children, body.mesh().tet_count());
  }
}

TEST(ClosedComplex, counts_the_flagged_edges_of_a_vertex) {
  SomeMasters some(1.0);
  ClosedComplex& complex = some.complex;
  const ClosedEdge edge = complex.edges()[3];
  complex.toggle(3);
  EXPECT_EQ(complex.flagged_at(edge.a), 1U);
  EXPECT_EQ(complex.flagged_at(edge.b), 1U);
  const std::uint32_t master = *masters_around(complex, 3).begin();
  complex.refresh_flags(master);
  EXPECT_NE(complex[master].flagged, 0);
  complex.block(3);
  EXPECT_EQ(complex.flagged_at(edge.a), 0U);
  complex.toggle(3);  // blocked: no flag to take back
  EXPECT_EQ(complex.flagged_at(edge.a), 0U);
  complex.refresh_flags(master);
  EXPECT_EQ(complex[master].flagged, 0);
}

TEST(ClosedComplex, takes_copies_of_a_vertex_for_one) {
  SomeMasters some(0.0);
  ClosedComplex& complex = some.complex;
  const VertexId v(3), first(70), second(71);
  EXPECT_EQ(complex.closed(first), first);
  complex.add_copy(v, first);
  complex.add_copy(v, second);
  EXPECT_TRUE(complex.has_copies(v));
  EXPECT_EQ(complex.closed(first), v);
  EXPECT_EQ(complex.copies_of(v), (std::vector<VertexId>{first, second}));
  complex.drop_copies(v);
  EXPECT_FALSE(complex.has_copies(v));
  EXPECT_EQ(complex.closed(first), first);
  complex.add_copy(VertexId(4), first);  // the list is used again
  EXPECT_EQ(complex.closed(first), VertexId(4));
}

TEST(ClosedComplex, knows_a_corner_by_its_new_name_and_ranks_it_by_its_first) {
  SomeMasters some(1.0);
  ClosedComplex& complex = some.complex;
  const VertexId from(13), to(500);
  const std::uint32_t seed = complex.master_at(from);
  const std::vector<std::uint32_t> star = complex.star(some.mesh, seed, from);
  ASSERT_TRUE(complex.is_known_around(from, star));
  EXPECT_FALSE(complex.is_known_around(from, std::span(star).first(1)));
  struct Known {
    std::uint32_t index;
    VertexId other;
    double t;  // from the corner
  };
  std::vector<Known> edges;
  for (std::uint32_t e = 0; e < complex.edges().size(); ++e) {
    ClosedEdge& edge = complex.edges()[e];
    if (edge.a != from && edge.b != from) continue;
    edge.t = 0.25;
    complex.toggle(e);
    edges.push_back({e, edge.a == from ? edge.b : edge.a, edge.a == from ? 0.25 : 0.75});
  }
  complex.set_on(from);
  complex.rename(from, to, star);
  EXPECT_EQ(complex.flagged_at(to), edges.size());
  EXPECT_EQ(complex.flagged_at(from), 0U);
  EXPECT_TRUE(complex.is_on(to));
  EXPECT_FALSE(complex.is_on(from));
  EXPECT_EQ(complex.rank(to), 13U);
  EXPECT_GT(complex.rank(from), 1000U) << "who has the slot next ranks as nobody does";
  for (const Known& known : edges) {
    EXPECT_EQ(complex.edges().find_or_add(to, known.other), known.index);
    const ClosedEdge& edge = complex.edges()[known.index];
    EXPECT_LT(edge.a, edge.b);
    EXPECT_EQ(edge.a == to ? edge.t : 1 - edge.t, known.t);
  }
  for (const std::uint32_t master : star) {
    const auto& v = complex[master].vertices;
    EXPECT_EQ(std::count(v.begin(), v.end(), to), 1);
    EXPECT_EQ(std::count(v.begin(), v.end(), from), 0);
  }
  for (const std::uint32_t master : star) complex.release(master);
  EXPECT_NE(complex.rank(to), 13U) << "nobody has that name any more";
}

TEST(ClosedComplex, turns_what_goes_with_a_face_whose_corner_has_another_name) {
  SomeMasters some(1.0);
  ClosedComplex& complex = some.complex;
  const Master& master = complex[5];
  FrontPoint point;
  point.face = {master.vertices[0], master.vertices[1], master.vertices[2]};
  std::sort(point.face.begin(), point.face.end());
  point.weights = point.slide = {0.1, 0.2, 0.7};
  point.masters = {5, Master::kNone};
  complex[5].points[3] = complex.add_point(point);
  const VertexId from = point.face[0], to(500);
  const std::vector<std::uint32_t> star = complex.star(some.mesh, 5, from);
  complex.rename(from, to, star);
  const FrontPoint& turned = complex.point(complex[5].points[3]);
  EXPECT_EQ(turned.face, (std::array<VertexId, 3>{point.face[1], point.face[2], to}));
  EXPECT_EQ(turned.weights, (std::array<double, 3>{0.2, 0.7, 0.1}));
  EXPECT_EQ(turned.slide, turned.weights);
}

/// The vertices that masters have as split points or front points.
std::set<VertexId> made_by(ClosedComplex& complex) {
  std::set<VertexId> made;
  const auto note = [&](VertexId vertex) {
    if (!vertex.is_valid()) return;
    made.insert(vertex);
    if (complex.has_copies(vertex)) made.insert(complex.copies_of(vertex).begin(), complex.copies_of(vertex).end());
  };
  for (std::uint32_t m = 0; m < complex.size(); ++m) {
    if (complex[m].split == nullptr) continue;
    for (const std::uint32_t e : complex[m].edges) note(complex.edges()[e].split);
    for (const std::uint32_t at : complex[m].points) note(at == Master::kNone ? VertexId() : complex.point(at).vertex);
    note(complex[m].middle);
  }
  return made;
}

/// Else a corner of such a master would have a star with tets in it whose corners are split points: those around it
/// would never be found, and a walk around their edges would not end.
TEST(ClosedComplex, may_adopt_no_tet_with_a_vertex_of_one_that_was_let_go_beside_split_points) {
  Random random(3);
  FlaggedBody body(jittered_cube(4, 2));
  body.toggle_some(random, 0.02);
  body.place_points(random, 0.2);
  body.rebuild();
  ClosedComplex& complex = body.complex();
  for (std::uint32_t m = 0; m < complex.size(); m += 2) complex.release(m);
  complex.hold_vertices(body.mesh());
  const std::set<VertexId> made = made_by(complex);
  std::set<VertexId> beside;
  body.mesh().for_each_tet([&](TetId tet) {
    const TetVertices& v = body.mesh().vertices(tet);
    const bool has_made = std::any_of(v.begin(), v.end(), [&](VertexId vertex) { return made.count(vertex) > 0; });
    if (has_made && complex.find(tet) == Master::kNone) beside.insert(v.begin(), v.end());
  });
  std::size_t free = 0, kept = 0;
  body.mesh().for_each_tet([&](TetId tet) {
    if (complex.find(tet) != Master::kNone) return;
    const TetVertices& v = body.mesh().vertices(tet);
    const bool is_near = std::any_of(v.begin(), v.end(), [&](VertexId vertex) { return beside.count(vertex) > 0; });
    EXPECT_TRUE(!is_near || complex.is_at_settled(body.mesh(), tet)) << tet.value;
    ++(complex.is_at_settled(body.mesh(), tet) ? kept : free);
  });
  EXPECT_GT(kept, 0U);
  EXPECT_GT(free, 0U);
}

TEST(ClosedComplex, removes_front_points_from_both_masters) {
  SomeMasters some(1.0);
  ClosedComplex& complex = some.complex;
  const std::uint32_t behind = complex[0].behind[1] != Master::kNone ? complex[0].behind[1] : complex[0].behind[0];
  FrontPoint point;
  point.masters = {0, behind};
  point.vertex = VertexId(9);
  const std::uint32_t at = complex.add_point(point);
  complex[0].points[1] = complex[behind].points[2] = at;
  complex.remove_point(at);
  EXPECT_EQ(complex[0].points[1], Master::kNone);
  EXPECT_EQ(complex[behind].points[2], Master::kNone);
  EXPECT_EQ(complex.retired(), std::vector<VertexId>{VertexId(9)});
  EXPECT_EQ(complex.add_point(FrontPoint()), at);
}

TEST(ClosedComplex, forgets_everything) {
  SomeMasters some(1.0);
  ClosedComplex& complex = some.complex;
  complex.toggle(0);
  complex.set_on(VertexId(5));
  complex.add_copy(VertexId(6), VertexId(80));
  complex.mark_dirty(0);
  const VertexId end = complex.edges()[0].a;
  complex.clear();
  EXPECT_EQ(complex.size(), 0U);
  EXPECT_EQ(complex.edges().size(), 0U);
  EXPECT_EQ(complex.find(TetId(0)), Master::kNone);
  EXPECT_EQ(complex.flagged_at(end), 0U);
  EXPECT_FALSE(complex.is_on(VertexId(5)));
  EXPECT_EQ(complex.closed(VertexId(80)), VertexId(80));
  EXPECT_TRUE(complex.dirty().empty());
}

}  // namespace
}  // namespace incise::test::closed_complex_test
