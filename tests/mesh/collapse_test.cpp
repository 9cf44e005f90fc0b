// SPDX-License-Identifier: Apache-2.0
// Merging vertices: the planner against the link condition spelled out, and what every accepted collapse must keep.
#include "incise/mesh/collapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "cut/cutter.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/validate.h"
#include "support/bodies.h"
#include "support/engines.h"
#include "support/random.h"
#include "support/strokes.h"

namespace incise::test::collapse_test {
namespace {

using Simplex = std::array<std::uint32_t, 3>;  // slots, ascending; unused entries are kNone
constexpr std::uint32_t kInfinity = kInvalidIndex - 1;
constexpr std::uint32_t kNone = kInvalidIndex;

/// Adds a simplex with all its faces.
void add_closure(std::vector<Simplex>& complex, std::vector<std::uint32_t> v) {
  for (unsigned subset = 1; subset < (1U << v.size()); ++subset) {
    Simplex face = {kNone, kNone, kNone};
    unsigned count = 0;
    for (unsigned i = 0; i < v.size(); ++i) {
      if (((subset >> i) & 1U) != 0) face[count++] = v[i];
    }
    std::sort(face.begin(), face.end());
    complex.push_back(face);
  }
}

void make_set(std::vector<Simplex>& complex) {
  std::sort(complex.begin(), complex.end());
  complex.erase(std::unique(complex.begin(), complex.end()), complex.end());
}

/// A mesh's complex, closed by a vertex at infinity: every boundary face spans a tet with it. Knows the tets alone.
class ClosedComplex {
 public:
  explicit ClosedComplex(const TetMesh& mesh, const std::vector<TetId>& without_these = {})
      : stars_(mesh.vertex_slots()) {
    std::map<Simplex, unsigned> faces;
    mesh.for_each_tet([&](TetId tet) {
      if (std::find(without_these.begin(), without_these.end(), tet) != without_these.end()) return;
      std::array<std::uint32_t, 4> v{};
      for (unsigned c = 0; c < 4; ++c) v[c] = mesh.vertices(tet)[c].value;
      std::sort(v.begin(), v.end());
      add(v);
      for (unsigned c = 0; c < 4; ++c) ++faces[without(v, c)];
    });
    for (const auto& [face, count] : faces) {
      if (count == 1) add({face[0], face[1], face[2], kInfinity});
    }
  }

  [[nodiscard]] std::vector<Simplex> link(std::uint32_t a) const { return link(a, a); }
  [[nodiscard]] std::vector<Simplex> link(std::uint32_t a, std::uint32_t b) const {
    std::vector<Simplex> result;
    for (const auto& tet : stars_[a]) {
      if (std::find(tet.begin(), tet.end(), b) == tet.end()) continue;
      std::vector<std::uint32_t> rest;
      std::copy_if(tet.begin(), tet.end(), std::back_inserter(rest), [&](auto v) { return v != a && v != b; });
      add_closure(result, rest);
    }
    make_set(result);
    return result;
  }
  [[nodiscard]] bool meets_link_condition(std::uint32_t a, std::uint32_t b) const {
    const std::vector<Simplex> of_a = link(a), of_b = link(b);
    std::vector<Simplex> common;
    std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
    return common == link(a, b);
  }
  /// Whether some tet of `a` is not at the edge.
  [[nodiscard]] bool has_fan(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(stars_[a].begin(), stars_[a].end(), [&](const auto& tet) {
      return tet[3] != kInfinity && std::find(tet.begin(), tet.end(), b) == tet.end();
    });
  }

 private:
  using Tet = std::array<std::uint32_t, 4>;
  static Simplex without(const Tet& v, unsigned corner) {
    Simplex face{};
    for (unsigned c = 0, k = 0; c < 4; ++c) {
      if (c != corner) face[k++] = v[c];
    }
    return face;
  }
  void add(const Tet& tet) {
    for (const std::uint32_t v : tet) {
      if (v != kInfinity) stars_[v].push_back(tet);
    }
  }

  std::vector<std::vector<Tet>> stars_;
};

/// Of every piece the Euler characteristics of the body, V − E + F − T, and of its surface; ascending.
std::vector<std::array<int, 2>> characteristics(const TetMesh& mesh) {
  const Components pieces = find_components(mesh);
  const std::vector<int> surfaces = euler_characteristics(mesh);
  std::vector<std::array<int, 2>> result(pieces.count());
  std::vector<std::array<std::uint32_t, 3>> edges, vertices;
  for (std::size_t i = 0; i < result.size(); ++i) result[i][1] = surfaces[i];
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    const std::uint32_t piece = pieces.label[tet.value];
    for (const auto& [a, b] : kEdgeCorners) {
      edges.push_back({piece, std::min(v[a], v[b]).value, std::max(v[a], v[b]).value});
    }
    for (unsigned c = 0; c < 4; ++c) {
      vertices.push_back({piece, v[c].value, 0});
      const Link link = mesh.links(tet)[c];
      if (link.is_boundary() || link.side().value > Side(tet, c).value) ++result[piece][0];
    }
    --result[piece][0];
  });
  make_set(edges);
  make_set(vertices);
  for (const auto& edge : edges) --result[edge[0]][0];
  for (const auto& vertex : vertices) ++result[vertex[0]][0];
  std::sort(result.begin(), result.end());
  return result;
}

/// The bits tell whether a vertex is on the boundary.
void expect_shape_bits(const TetMesh& mesh) {
  std::vector<bool> is_boundary(mesh.vertex_slots());
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) continue;
      for (const VertexId v : mesh.vertices(Side(tet, s))) is_boundary[v.value] = true;
    }
  });
  mesh.for_each_vertex([&](VertexId v) {
    EXPECT_EQ((mesh.shape_of(v) & (shape::kSkin | shape::kWall)) != 0, is_boundary[v.value]) << v.value;
  });
}

std::vector<std::pair<VertexId, VertexId>> directed_edges(const TetMesh& mesh) {
  std::vector<std::pair<VertexId, VertexId>> edges;
  mesh.for_each_tet([&](TetId tet) {
    for (const auto& [a, b] : kEdgeCorners) {
      const VertexId p = mesh.vertices(tet)[a], q = mesh.vertices(tet)[b];
      edges.emplace_back(p, q);
      edges.emplace_back(q, p);
    }
  });
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

struct Tally {
  unsigned accepted = 0, positive = 0, refused = 0, with_flaps = 0;
};

/// Plans every collapse, carries the accepted ones out one at a time and takes them back.
class EveryEdge {
 public:
  EveryEdge(TetMesh& mesh, Flaps flaps)
      : mesh_(mesh),
        flaps_(flaps),
        complex_(mesh),
        before_(characteristics(mesh)),
        report_(validate(mesh, ValidateLevel::kGeometry)),
        hash_(mesh.hash()) {}

  Tally run() {
    for (const auto& [from, into] : directed_edges(mesh_)) {
      planner_.plan(mesh_, from, into, plan_, flaps_);
      EXPECT_EQ(static_cast<bool>(plan_), is_sound(from, into)) << from.value << " into " << into.value;
      if (plan_) {
        try_out();
      } else {
        ++tally_.refused;
        EXPECT_EQ(plan_.refusal, Refusal::kLinkCondition);
      }
      if (testing::Test::HasFailure()) break;
    }
    return tally_;
  }

 private:
  /// By the link condition spelled out, where there are flaps in the complex without them.
  [[nodiscard]] bool is_sound(VertexId from, VertexId into) const {
    const std::vector<TetId> flaps = flaps_ == Flaps::kTakenAway ? flaps_at(from, into) : std::vector<TetId>();
    const auto may_vanish = [&](const ClosedComplex& complex) {
      return complex.meets_link_condition(from.value, into.value) && complex.has_fan(from.value, into.value);
    };
    return flaps.empty() ? may_vanish(complex_)
                         : leaves_one_fan(from, into, flaps) && may_vanish(ClosedComplex(mesh_, flaps));
  }
  [[nodiscard]] std::vector<TetId> flaps_at(VertexId from, VertexId into) const {
    std::vector<TetId> flaps;
    mesh_.for_each_tet([&](TetId tet) {
      const unsigned a = mesh_.corner_of(tet, from), b = mesh_.corner_of(tet, into);
      const bool is_flap = a < 4 && b < 4 && mesh_.links(tet)[a].is_boundary() && mesh_.links(tet)[b].is_boundary();
      if (is_flap) flaps.push_back(tet);
    });
    return flaps;
  }
  /// Whether the tets at an edge, but for some, hang together by faces, and are any.
  [[nodiscard]] bool leaves_one_fan(VertexId from, VertexId into, const std::vector<TetId>& flaps) const {
    std::vector<TetId> ring;
    mesh_.for_each_tet([&](TetId tet) {
      const bool is_at_edge = mesh_.corner_of(tet, from) < 4 && mesh_.corner_of(tet, into) < 4;
      if (is_at_edge && std::find(flaps.begin(), flaps.end(), tet) == flaps.end()) ring.push_back(tet);
    });
    std::vector<TetId> reached(ring.begin(), ring.begin() + (ring.empty() ? 0 : 1));
    for (std::size_t i = 0; i < reached.size(); ++i) {
      for (const Link link : mesh_.links(reached[i])) {
        const bool is_new = !link.is_boundary() &&
                            std::find(ring.begin(), ring.end(), link.side().tet()) != ring.end() &&
                            std::find(reached.begin(), reached.end(), link.side().tet()) == reached.end();
        if (is_new) reached.push_back(link.side().tet());
      }
    }
    return !ring.empty() && reached.size() == ring.size();
  }
  void try_out() {
    const bool is_positive = stays_positive(mesh_, plan_, mesh_.rest(plan_.into));
    ++tally_.accepted;
    tally_.with_flaps += plan_.flaps.empty() ? 0U : 1U;
    tally_.positive += is_positive ? 1 : 0;
    Transaction transaction(mesh_);
    apply(transaction, plan_);
    EXPECT_EQ(characteristics(mesh_), before_) << plan_.from.value << " into " << plan_.into.value;
    const auto level = is_positive ? ValidateLevel::kGeometry : ValidateLevel::kTopology;
    const ValidityReport report = validate(mesh_, level);
    EXPECT_TRUE(compare_with_input(report_, report).ok) << describe(report);
    expect_shape_bits(mesh_);
    transaction.rollback();
    EXPECT_EQ(mesh_.hash(), hash_);
  }

  TetMesh& mesh_;
  Flaps flaps_;
  ClosedComplex complex_;
  std::vector<std::array<int, 2>> before_;
  ValidityReport report_;
  std::uint64_t hash_;
  CollapsePlanner planner_;
  CollapsePlan plan_;
  Tally tally_;
};

Tally try_every_edge(TetMesh mesh, Flaps flaps = Flaps::kRefused) {
  const Tally tally = EveryEdge(mesh, flaps).run();
  testing::Test::RecordProperty("accepted", static_cast<int>(tally.accepted));
  testing::Test::RecordProperty("positive", static_cast<int>(tally.positive));
  testing::Test::RecordProperty("refused", static_cast<int>(tally.refused));
  return tally;
}

TetMesh cut_body(TetSoup soup, double snap, const std::vector<Stroke>& strokes, Profile profile = Profile::kIncise) {
  TetMesh mesh = build(std::move(soup));
  Cutter cutter({profile, snap});
  Journal journal;
  StageTimes times;
  std::uint32_t tag = 0;
  for (const Stroke& stroke : strokes) {
    const Result<CutStatistics> cut = cutter.cut(mesh, journal, stroke, ++tag, times);
    EXPECT_TRUE(cut.ok() && cut->incision_faces > 0) << "every stroke must cut";
  }
  return mesh;
}

Stroke plane(const Vec3& normal, double offset) {
  return *plane_stroke(Box{Vec3(-1, -1, -1), Vec3(1, 1, 1)}, normal, offset);
}

void expect_both_answers(const Tally& tally) {
  EXPECT_GT(tally.accepted, 20U);
  EXPECT_GT(tally.positive, 10U);
  EXPECT_GT(tally.refused, 20U);
}

// T31
TEST(CollapseEveryEdge, of_an_uncut_cube) {
  expect_both_answers(try_every_edge(build(kuhn_cube(3))));
}
TEST(CollapseEveryEdge, of_a_body_of_few_tets) {
  for (std::uint32_t count = 1; count <= 6; ++count) {
    SCOPED_TRACE(count);
    try_every_edge(build(needle(count)));
  }
  try_every_edge(build(kuhn_cube(1)));
}
TEST(CollapseEveryEdge, near_an_oblique_plane_that_left_slivers) {
  expect_both_answers(try_every_edge(cut_body(kuhn_cube(3), 0.0, {plane({0.3, 1, 0.17}, 0.71)})));
}
TEST(CollapseEveryEdge, near_planes_that_cross) {
  expect_both_answers(
      try_every_edge(cut_body(kuhn_cube(2), 0.0, {plane({0.3, 1, 0.17}, 0.71), plane({1, -0.2, 0.31}, 0.52)})));
}
TEST(CollapseEveryEdge, near_a_cut_with_snapping) {
  expect_both_answers(
      try_every_edge(cut_body(jittered_cube(3, 5), 0.2, {plane({0.3, 1, 0.17}, 0.71), plane({1, -0.2, 0.31}, 0.52)})));
}
TEST(CollapseEveryEdge, near_a_cut_of_the_paper_profile) {
  expect_both_answers(try_every_edge(cut_body(
      jittered_cube(2, 3), 0.0, {plane({0.3, 1, 0.17}, 0.71), plane({1, -0.2, 0.31}, 0.52)}, Profile::kPaper)));
}
TEST(CollapseEveryEdge, near_a_curved_cut) {
  const Stroke arc = profile_stroke(arc_path(Vec3(0.1, 0.1, 0), 0.7, -0.2, 0.5, 12), -0.2, 1.2);
  expect_both_answers(try_every_edge(cut_body(kuhn_cube(3), 0.0, {arc})));
}
TEST(CollapseEveryEdge, near_a_cut_that_ends_inside) {
  const Stroke half =
      quad_stroke(Vec3(0.45, -0.2, 1.2), Vec3(0.45, 1.2, 1.2), Vec3(0.52, -0.2, 0.4), Vec3(0.52, 0.7, 0.4));
  expect_both_answers(try_every_edge(cut_body(jittered_cube(3, 2), 0.1, {half})));
}
TEST(CollapseEveryEdge, of_a_ring_and_its_core) {
  TetMesh mesh = cut_body(kuhn_cube(3), 0.2, {coring_stroke(Vec3(0.5, 0.5, 0), 0.3, 16, -0.2, 1.2)});
  const auto pieces = characteristics(mesh);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0], (std::array<int, 2>{0, 0}));
  EXPECT_EQ(pieces[1], (std::array<int, 2>{1, 2}));
  expect_both_answers(try_every_edge(std::move(mesh)));
}

/// A cube of 4³ cells without some of them.
TetSoup cube_without(const std::vector<std::array<std::uint32_t, 3>>& cells) {
  TetSoup soup = kuhn_cube(4);
  const auto is_left_out = [&](const std::array<std::uint32_t, 4>& tet) {
    Vec3 centre = Vec3::Zero();
    for (const std::uint32_t v : tet) centre += soup.points[v];
    return std::any_of(cells.begin(), cells.end(), [&](const auto& cell) {
      return static_cast<std::uint32_t>(centre.x()) == cell[0] && static_cast<std::uint32_t>(centre.y()) == cell[1] &&
             static_cast<std::uint32_t>(centre.z()) == cell[2];
    });
  };
  soup.tets.erase(std::remove_if(soup.tets.begin(), soup.tets.end(), is_left_out), soup.tets.end());
  return soup;
}

TEST(CollapseEveryEdge, around_a_cavity) {
  TetMesh mesh = build(cube_without({{1, 1, 1}}));
  ASSERT_EQ(characteristics(mesh).front(), (std::array<int, 2>{2, 4}));
  expect_both_answers(try_every_edge(std::move(mesh)));
}
TEST(CollapseEveryEdge, around_cavities_that_touch_in_a_point) {
  expect_both_answers(try_every_edge(build(cube_without({{1, 1, 1}, {2, 2, 2}}))));
}
TEST(CollapseEveryEdge, around_cavities_that_touch_along_an_edge) {
  expect_both_answers(try_every_edge(build(cube_without({{1, 1, 1}, {2, 2, 1}}))));
}
TEST(CollapseEveryEdge, of_a_wall_one_cell_thick) {
  expect_both_answers(try_every_edge(build(kuhn_box(Vec3(0, 0, 0), Vec3(4, 4, 1), {4, 4, 1}))));
}

/// A cube of 3³ cells from which tets were taken away one by one, as long as it stays a ball that nowhere touches
/// itself: what is left has flaps and spikes all over.
TetMesh ragged_cube(std::uint64_t seed, std::size_t tets) {
  TetSoup soup = kuhn_cube(3);
  Random random(seed);
  while (soup.tets.size() > tets) {
    TetSoup less = soup;
    less.tets.erase(less.tets.begin() + static_cast<std::ptrdiff_t>(random.bits() % less.tets.size()));
    const TetMesh mesh = build(less);
    const bool is_ball =
        characteristics(mesh) == std::vector<std::array<int, 2>>{{1, 2}} && !mesh.touched_itself_at_load();
    if (is_ball) soup = std::move(less);
  }
  return build(std::move(soup));
}

TEST(CollapseWithFlaps, keeps_the_topology_of_ragged_bodies) {
  unsigned with_flaps = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    with_flaps += try_every_edge(ragged_cube(seed, 30 + 10 * seed), Flaps::kTakenAway).with_flaps;
  }
  EXPECT_GT(with_flaps, 100U);
}
TEST(CollapseWithFlaps, keeps_the_topology_near_cuts) {
  const Stroke half =
      quad_stroke(Vec3(0.45, -0.2, 1.2), Vec3(0.45, 1.2, 1.2), Vec3(0.52, -0.2, 0.4), Vec3(0.52, 0.7, 0.4));
  expect_both_answers(try_every_edge(cut_body(jittered_cube(3, 2), 0.1, {half}), Flaps::kTakenAway));
  const Tally tally = try_every_edge(
      cut_body(kuhn_cube(2), 0.0, {plane({0.3, 1, 0.17}, 0.71), plane({1, -0.2, 0.31}, 0.52)}), Flaps::kTakenAway);
  EXPECT_GT(tally.with_flaps, 0U);
}
TEST(CollapseWithFlaps, leaves_something_of_a_body_of_few_tets) {
  for (std::uint32_t count = 1; count <= 6; ++count) {
    SCOPED_TRACE(count);
    try_every_edge(build(needle(count)), Flaps::kTakenAway);
  }
  try_every_edge(build(kuhn_cube(1)), Flaps::kTakenAway);
}

/// Merges whatever can be merged, until nothing can.
unsigned coarsen(TetMesh& mesh) {
  CollapsePlanner planner;
  CollapsePlan plan;
  unsigned merged = 0;
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const auto& [from, into] : directed_edges(mesh)) {
      planner.plan(mesh, from, into, plan);
      if (!plan || !stays_positive(mesh, plan, mesh.rest(into))) continue;
      Transaction transaction(mesh);
      apply(transaction, plan);
      transaction.commit();
      has_changed = true;
      ++merged;
    }
  }
  return merged;
}

TEST(Collapse, of_everything_keeps_the_pieces_and_their_holes) {
  TetMesh mesh = cut_body(jittered_cube(4, 9), 0.0,
                          {coring_stroke(Vec3(0.5, 0.5, 0), 0.3, 16, -0.2, 1.2), plane({0.3, 1, 0.17}, 0.71)});
  const auto before = characteristics(mesh);
  const std::size_t tets = mesh.tet_count();
  EXPECT_GT(coarsen(mesh), 100U);
  EXPECT_LT(mesh.tet_count(), tets / 4);
  EXPECT_EQ(characteristics(mesh), before);
  EXPECT_TRUE(validate(mesh, ValidateLevel::kGeometry).ok) << describe(validate(mesh, ValidateLevel::kGeometry));
  expect_shape_bits(mesh);
}

TEST(Collapse, in_a_flat_face_keeps_the_volume_and_the_tags) {
  TetMesh mesh = build(kuhn_cube(4));
  const VertexId from(2 + 5 * 2), into(3 + 5 * 2);  // both in the face z = 0
  CollapsePlanner planner;
  CollapsePlan plan;
  planner.plan(mesh, from, into, plan);
  ASSERT_TRUE(plan);
  ASSERT_TRUE(stays_positive(mesh, plan, mesh.rest(into)));
  const std::size_t ring = plan.ring.size(), tets = mesh.tet_count();
  Transaction transaction(mesh);
  apply(transaction, plan);
  const Step step = transaction.commit();
  EXPECT_EQ(mesh.tet_count(), tets - ring);
  EXPECT_FALSE(mesh.is_live(from));
  EXPECT_EQ(step.died, std::vector<VertexId>{from});
  EXPECT_EQ(step.consumed.size(), ring);
  EXPECT_EQ(step.rewired.size(), plan.fan.size());
  EXPECT_EQ(wall_area(mesh), 0.0);
  expect_valid(mesh, 1.0);
}

TEST(Collapse, into_the_middle_moves_the_vertex_first) {
  TetMesh mesh = build(kuhn_cube(4));
  const VertexId from(2 + 5 * (2 + 5 * 2)), into(2 + 5 * (2 + 5 * 1));
  ASSERT_EQ(mesh.shape_of(from), 0);
  CollapsePlanner planner;
  CollapsePlan plan;
  planner.plan(mesh, from, into, plan);
  const Vec3 middle = 0.5 * (mesh.rest(from) + mesh.rest(into));
  ASSERT_TRUE(plan);
  ASSERT_TRUE(stays_positive(mesh, plan, middle));
  Transaction transaction(mesh);
  apply(transaction, plan_move_vertex(mesh, into, middle));
  apply(transaction, plan);
  transaction.commit();
  expect_valid(mesh, 1.0);
}

TEST(Collapse, that_would_invert_a_tet_is_told) {
  TetMesh mesh = build(kuhn_cube(4));
  const VertexId from(2 + 5 * (2 + 5 * 2)), into(2 + 5 * (2 + 5 * 1));
  CollapsePlanner planner;
  CollapsePlan plan;
  planner.plan(mesh, from, into, plan);
  ASSERT_TRUE(plan);
  EXPECT_TRUE(stays_positive(mesh, plan, mesh.rest(into)));
  EXPECT_FALSE(stays_positive(mesh, plan, Vec3(0.5, 0.5, 1.5)));
  EXPECT_FALSE(stays_positive(mesh, plan, Vec3(0.5, 0.5, 0.0)));  // flat counts too
}

Refusal refusal_of(const TetMesh& mesh, std::uint32_t from, std::uint32_t into) {
  CollapsePlanner planner;
  CollapsePlan plan;
  planner.plan(mesh, VertexId(from), VertexId(into), plan);
  return plan.refusal;
}

TEST(Collapse, refuses_what_is_no_edge) {
  const TetMesh mesh = build(kuhn_cube(2));
  EXPECT_EQ(refusal_of(mesh, 13, 99), Refusal::kDead);
  EXPECT_EQ(refusal_of(mesh, 99, 13), Refusal::kDead);
  EXPECT_EQ(refusal_of(mesh, 13, 13), Refusal::kDead);
  EXPECT_EQ(refusal_of(mesh, 0, 2), Refusal::kNotAnEdge);
}
TEST(Collapse, refuses_to_close_a_body_of_one_tet) {
  EXPECT_EQ(refusal_of(build(needle(1)), 0, 1), Refusal::kLinkCondition);
}
TEST(Collapse, refuses_to_join_two_sides_of_a_wall_one_cell_thick) {
  const TetMesh mesh = build(kuhn_box(Vec3(0, 0, 0), Vec3(4, 4, 1), {4, 4, 1}));
  EXPECT_EQ(refusal_of(mesh, 12, 12 + 25), Refusal::kLinkCondition);
}
TEST(Collapse, refuses_to_take_all_tets_of_a_vertex_away) {
  TetSoup soup;  // a tent on a base: the top's tets are all at the edge to the base's middle
  soup.points = {{0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  soup.tets = {{0, 1, 2, 4}, {0, 2, 3, 4}, {0, 3, 1, 4}, {0, 2, 1, 5}, {0, 3, 2, 5}, {0, 1, 3, 5}};
  EXPECT_EQ(refusal_of(build(soup), 4, 0), Refusal::kLinkCondition);
}
TEST(Collapse, refuses_a_pinched_vertex) {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  soup.tets = {{0, 1, 2, 3}, {0, 5, 4, 6}};
  EXPECT_EQ(refusal_of(build(soup), 0, 1), Refusal::kNoStar);
  EXPECT_EQ(refusal_of(build(soup), 1, 0), Refusal::kNoStar);
}
TEST(Collapse, refuses_a_vertex_between_regions_but_not_one_beside) {
  TetSoup soup = kuhn_cube(4);
  for (const auto& tet : soup.tets) {
    double height = 0;
    for (const std::uint32_t v : tet) height += soup.points[v].z();
    soup.regions.push_back(height < 2.0 ? 1 : 2);
  }
  const TetMesh mesh = build(soup);
  const std::uint32_t between = 2 + 5 * (2 + 5 * 2), beside = 2 + 5 * (2 + 5 * 1);
  EXPECT_EQ(refusal_of(mesh, between, beside), Refusal::kOnSurface);
  EXPECT_EQ(refusal_of(mesh, beside, between), Refusal::kNone);
}

}  // namespace
}  // namespace incise::test::collapse_test
