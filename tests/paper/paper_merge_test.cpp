// SPDX-License-Identifier: Apache-2.0
// Edge merging: Figure 6, the conditions below it, and what merging keeps.
#include "paper/paper_merge.h"

#include <algorithm>
#include <cmath>

#include "cut/spacing.h"
#include "incise/mesh/collapse.h"
#include "incise/mesh/quality_stats.h"
#include "paper/paper_quality.h"
#include "paper/paper_region.h"
#include "paper/paper_support.h"

namespace incise::test::paper_merge_test {
namespace {

using paper::find_short_edges;
using paper::find_thin_shape;
using paper::is_safe_around;
using paper::is_safe_at_face;
using paper::is_safe_to_merge;
using paper::MergeThresholds;
using paper::ThinShape;
using paper::ThinTet;

MaintainStatistics merge(TetMesh& mesh, const std::vector<TetId>& tets, const MergeThresholds& thresholds = {}) {
  Transaction transaction(mesh, true);
  const MaintainStatistics done = paper::merge_edges(transaction, tets, thresholds);
  transaction.commit();
  return done;
}

MaintainStatistics merge(CutBody& body) {
  return merge(body.mesh, paper::find_tets_at(body.mesh, paper::find_divided_vertices(body.mesh, body.journal, 0)));
}

// --- Figure 6
// ----------------------------------------------------------------------------------------------------------------

TetMesh one_tet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return build({{a, b, c, d}, {{0, 1, 2, 3}}, {}});
}

using Pair = std::array<std::uint32_t, 2>;

std::vector<Pair> edges_of(const ThinTet& thin) {
  std::vector<Pair> edges;
  for (unsigned i = 0; i < thin.count; ++i) edges.push_back({thin.edges[i][0].value, thin.edges[i][1].value});
  return edges;
}

TEST(ThinShape, a_is_one_short_edge) {
  const TetMesh mesh = one_tet(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 0), Vec3(0.5, 1, 0.1));
  const ThinTet thin = find_thin_shape(mesh, TetId(0), 3);
  EXPECT_EQ(thin.shape, ThinShape::kShortEdge);
  EXPECT_EQ(edges_of(thin), (std::vector<Pair>{{2, 3}}));
}

TEST(ThinShape, b_is_two_opposite_short_edges_the_shorter_first) {
  const TetMesh mesh = one_tet(Vec3(0, 0, 0), Vec3(0.2, 0, 0), Vec3(0.1, 1, -0.05), Vec3(0.1, 1, 0.05));
  const ThinTet thin = find_thin_shape(mesh, TetId(0), 3);
  EXPECT_EQ(thin.shape, ThinShape::kTwoShortEdges);
  EXPECT_EQ(edges_of(thin), (std::vector<Pair>{{2, 3}, {0, 1}}));
}

TEST(ThinShape, c_is_a_short_face_with_its_three_edges) {
  const TetMesh mesh = one_tet(Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0.12, 0), Vec3(0, 0, 1));
  const ThinTet thin = find_thin_shape(mesh, TetId(0), 3);
  EXPECT_EQ(thin.shape, ThinShape::kShortFace);
  EXPECT_EQ(edges_of(thin), (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(ThinShape, c_may_have_a_third_edge_that_is_not_short) {
  const TetMesh mesh = one_tet(Vec3(0, 0, 0), Vec3(0.3, 0, 0), Vec3(-0.3, 0.01, 0), Vec3(0, 0, 1));
  const ThinTet thin = find_thin_shape(mesh, TetId(0), 3);
  EXPECT_EQ(thin.shape, ThinShape::kShortFace);
  EXPECT_EQ(edges_of(thin), (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(ThinShape, is_none_where_all_edges_are_alike) {
  const TetMesh mesh = build(kuhn_cube(1));
  mesh.for_each_tet([&](TetId tet) { EXPECT_EQ(find_thin_shape(mesh, tet, 3).shape, ThinShape::kNone); });
  // A flat tet without a short edge is none of Figure 6's.
  const TetMesh flat = one_tet(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0.001));
  EXPECT_EQ(find_thin_shape(flat, TetId(0), 3).shape, ThinShape::kNone);
}

/// Whether all edges that are shorter than the longest by more than a factor are among those found, and those are one
/// of them, two that are opposite, or the three of a side.
bool has_all_short_edges(const TetMesh& mesh, TetId tet, const ThinTet& thin, double factor) {
  const TetVertices& v = mesh.vertices(tet);
  double longest = 0;
  for (const auto& [a, b] : kEdgeCorners) longest = std::max(longest, (mesh.rest(v[a]) - mesh.rest(v[b])).norm());
  unsigned number = 0, found_short = 0, all_found = 0;
  std::array<unsigned, 4> ends{};
  for (const auto& [a, b] : kEdgeCorners) {
    const bool is_short = factor * (mesh.rest(v[a]) - mesh.rest(v[b])).norm() < longest;
    bool is_found = false;
    for (unsigned i = 0; i < thin.count; ++i) {
      const auto& edge = thin.edges[i];
      is_found = is_found || edge == std::array{v[a], v[b]} || edge == std::array{v[b], v[a]};
    }
    number += is_short ? 1 : 0;
    found_short += is_short && is_found ? 1 : 0;
    all_found += is_found ? 1 : 0;
    ends[a] += is_found ? 1 : 0;
    ends[b] += is_found ? 1 : 0;
  }
  std::sort(ends.begin(), ends.end());
  const std::array<std::array<unsigned, 4>, 4> kinds = {{{0, 0, 0, 0}, {0, 0, 1, 1}, {1, 1, 1, 1}, {0, 2, 2, 2}}};
  const bool are_most_short = thin.count == 3 ? number >= 2 : number == thin.count;
  return found_short == number && all_found == thin.count && are_most_short && ends == kinds[thin.count];
}

TEST(ThinShape, of_any_tet_is_one_of_the_three_or_none) {
  Random random(1);
  TetSoup soup;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    // Corners that cluster at random: offsets over four orders of magnitude.
    for (unsigned c = 0; c < 4; ++c) {
      double scale = 1.0;
      for (std::int64_t k = random.integer(0, 4); k > 0; --k) scale *= 0.2;
      soup.points.emplace_back(scale * random.point(-1, 1));
    }
    const Vec3* p = &soup.points[4 * std::size_t{i}];
    const bool is_turned = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) < 0;
    soup.tets.push_back({4 * i, 4 * i + 1, 4 * i + (is_turned ? 3 : 2), 4 * i + (is_turned ? 2 : 3)});
  }
  const TetMesh mesh = build(std::move(soup));
  std::array<unsigned, 4> found{};
  mesh.for_each_tet([&](TetId tet) {
    const ThinTet thin = find_thin_shape(mesh, tet, 3);
    EXPECT_EQ(thin.count, static_cast<unsigned>(thin.shape));  // none, one, two or three edges
    EXPECT_TRUE(has_all_short_edges(mesh, tet, thin, 3)) << tet.value;
    ++found[thin.count];
  });
  for (const unsigned count : found) EXPECT_GT(count, 100U);
}

// --- the conditions
// ----------------------------------------------------------------------------------------------------------------

TEST(SafeMerge, condition_1_one_of_ab_and_ac_is_inside) {
  for (const bool ba : {false, true}) {
    for (const bool ca : {false, true}) {
      const bool expected = !(ba && ca);
      EXPECT_EQ(is_safe_at_face(ba, ca, false, true, true), expected);
      EXPECT_EQ(is_safe_at_face(ba, ca, false, false, false), expected);
    }
  }
}

TEST(SafeMerge, condition_2_the_face_is_on_the_surface_and_not_both_beside_it) {
  EXPECT_TRUE(is_safe_at_face(true, true, true, false, false));
  EXPECT_TRUE(is_safe_at_face(true, true, true, true, false));
  EXPECT_TRUE(is_safe_at_face(true, true, true, false, true));
  EXPECT_FALSE(is_safe_at_face(true, true, true, true, true));
  EXPECT_FALSE(is_safe_at_face(true, true, false, false, false));
}

TEST(SafeMerge, refuses_a_tet_on_its_own) {
  const TetMesh mesh = one_tet(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  for (const auto& [b, c] : kEdgeCorners) {
    EXPECT_FALSE(is_safe_to_merge(mesh, TetId(0), VertexId(b), VertexId(c)));
  }
}

TEST(SafeMerge, allows_an_edge_of_the_skin_unless_a_corner_would_hang_on_nothing) {
  const TetMesh mesh = build(kuhn_cube(3));
  const VertexId a = vertex_at(mesh, Vec3(1.0 / 3, 1.0 / 3, 0)), b = vertex_at(mesh, Vec3(2.0 / 3, 1.0 / 3, 0));
  unsigned tets = 0;
  mesh.for_each_tet([&](TetId tet) {
    if (mesh.corner_of(tet, a) == 4 || mesh.corner_of(tet, b) == 4) return;
    ++tets;
    EXPECT_TRUE(is_safe_to_merge(mesh, tet, a, b));
  });
  EXPECT_GT(tets, 1U);
}

struct Verdicts {
  unsigned both = 0, paper_only = 0, link_only = 0;
};

/// What the paper's conditions, asked of all tets around an edge, and the link condition say about the edges near a
/// cut.
Verdicts compare_verdicts(const CutBody& body) {
  const TetMesh& mesh = body.mesh;
  Verdicts verdicts;
  CollapsePlanner planner;
  CollapsePlan plan;
  for (const TetId tet : paper::find_tets_at(mesh, paper::find_divided_vertices(mesh, body.journal, 0))) {
    for (const auto& [i, j] : kEdgeCorners) {
      const VertexId a = mesh.vertices(tet)[i], b = mesh.vertices(tet)[j];
      planner.plan(mesh, a, b, plan);
      const bool is_safe = is_safe_around(mesh, plan.ring, a, b);
      verdicts.both += is_safe && plan ? 1U : 0U;
      verdicts.paper_only += is_safe && !plan ? 1U : 0U;
      verdicts.link_only += !is_safe && plan ? 1U : 0U;
    }
  }
  return verdicts;
}

// T31
TEST(SafeMerge, is_necessary_for_the_link_condition_but_not_sufficient) {
  Verdicts sum;
  for (const auto& planes : std::vector<std::vector<std::pair<Vec3, double>>>{
           {{Vec3(0.3, 0.5, 0.9), 0.8}},
           {{Vec3(1, 0.2, 0.1), 0.6}, {Vec3(0.1, 1, 0.2), 0.6}, {Vec3(0.5, 0.5, 1), 0.9}}}) {
    const Verdicts v = compare_verdicts(cut_as_paper(jittered_cube(5, 2), planes));
    sum.both += v.both;
    sum.paper_only += v.paper_only;
    sum.link_only += v.link_only;
  }
  EXPECT_EQ(sum.link_only, 0U);
  EXPECT_GT(sum.paper_only, 0U);
  EXPECT_GT(sum.both, 4 * sum.paper_only);
}

/// An edge is refused by any tet around it, in whatever order they come.
TEST(SafeMerge, asks_all_tets_around_an_edge) {
  const CutBody body = cut_as_paper(jittered_cube(4, 2), {{Vec3(0.3, 0.5, 0.9), 0.8}});
  const TetMesh& mesh = body.mesh;
  CollapsePlanner planner;
  CollapsePlan plan;
  std::size_t of_one = 0;
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices v = mesh.vertices(tet);
    for (const auto& [i, j] : kEdgeCorners) {
      planner.plan(mesh, v[i], v[j], plan);
      const auto refuses = [&](TetId other) { return !is_safe_to_merge(mesh, other, v[i], v[j]); };
      const auto count = std::count_if(plan.ring.begin(), plan.ring.end(), refuses);
      EXPECT_EQ(is_safe_around(mesh, plan.ring, v[i], v[j]), count == 0);
      of_one += count > 0 && !refuses(plan.ring.front()) ? 1U : 0U;
    }
  });
  EXPECT_GT(of_one, 10U);
}

/// Whether an edge or face of a tet lies on the boundary, told from its links alone.
bool is_on_surface(const TetMesh& mesh, VertexId a, VertexId b) {
  bool is_on = false;
  mesh.for_each_tet([&](TetId tet) {
    const unsigned i = mesh.corner_of(tet, a), j = mesh.corner_of(tet, b);
    if (i == 4 || j == 4) return;
    for (unsigned s = 0; s < 4; ++s) is_on = is_on || (s != i && s != j && mesh.links(tet)[s].is_boundary());
  });
  return is_on;
}

TEST(SafeMerge, asks_of_bcd_what_it_asks_of_abc) {
  const CutBody body = cut_as_paper(kuhn_cube(3), {{Vec3(1, 0.1, 0.05), 0.55}, {Vec3(1, 0.1, 0.05), 0.65}});
  const TetMesh& mesh = body.mesh;
  unsigned abc_alone = 0, bcd_alone = 0;
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    for (const auto& [b, c] : kEdgeCorners) {
      const unsigned other = opposite_edge(kEdgeOfCorners[b][c]);
      const unsigned a = kEdgeCorners[other][0], d = kEdgeCorners[other][1];
      const auto surf = [&](unsigned x, unsigned y) { return is_on_surface(mesh, v[x], v[y]); };
      const auto face = [&](unsigned opposite) { return mesh.links(tet)[opposite].is_boundary(); };
      const bool abc = is_safe_at_face(surf(b, a), surf(c, a), face(d), face(c), face(b));
      const bool bcd = is_safe_at_face(surf(b, d), surf(c, d), face(a), face(c), face(b));
      EXPECT_EQ(is_safe_to_merge(mesh, tet, v[b], v[c]), abc && bcd);
      abc_alone += abc && !bcd ? 1U : 0U;
      bcd_alone += bcd && !abc ? 1U : 0U;
    }
  });
  EXPECT_GT(abc_alone, 0U);
  EXPECT_GT(bcd_alone, 0U);
}

// --- merging
// ----------------------------------------------------------------------------------------------------------------

TEST(Merge, takes_nothing_from_the_papers_straight_cut) {
  CutBody body = cut_as_paper(kuhn_cube(5), {{Vec3(1, 0, 0), 0.5}});
  EXPECT_EQ(body.mesh.tet_count(), 1300U);
  EXPECT_EQ(merge(body).collapsed_edges, 0U);
  EXPECT_EQ(body.mesh.tet_count(), 1300U);
  expect_valid(body.mesh, 1.0);
}

/// A plane that passes all vertices of a layer closely leaves a carpet of thin tets of all three kinds.
TEST(Merge, eliminates_thin_tets_of_all_three_kinds_beside_a_plane) {
  CutBody body = cut_as_paper(kuhn_cube(5), {{Vec3(1, 0.004, 0.007), 0.612}});
  std::array<unsigned, 4> before{}, after{};
  const auto count = [&](std::array<unsigned, 4>& kinds) {
    paper::QualityMeter meter(body.mesh);
    body.mesh.for_each_tet([&](TetId tet) {
      kinds[static_cast<std::size_t>(find_thin_shape(body.mesh, tet, 3).shape)] += meter.of(tet) > 15 ? 1U : 0U;
    });
  };
  count(before);
  const std::size_t tets = body.mesh.tet_count();
  const MaintainStatistics done = merge(body);
  count(after);
  for (const std::size_t kind : {1U, 2U, 3U}) {
    EXPECT_GT(before[kind], 0U);
    EXPECT_LT(after[kind], before[kind] / 10 + 1) << kind;
  }
  EXPECT_GT(done.collapsed_edges, 50U);
  EXPECT_GT(done.work_units, 0U);
  EXPECT_LT(body.mesh.tet_count(), tets);
  expect_valid(body.mesh, 1.0);
}

TEST(Merge, beside_flat_faces_keeps_pieces_volumes_walls_and_corners) {
  CutBody body = cut_as_paper(kuhn_cube(5), {{Vec3(0.3, 0.5, 0.9), 0.8}, {Vec3(1, -0.3, 0.2), 0.4}});
  const std::vector<double> volumes = piece_volumes(body.mesh);
  const std::vector<int> characteristics = euler_characteristics(body.mesh);
  const double first = wall_area(body.mesh, 1), second = wall_area(body.mesh, 2);
  EXPECT_GT(merge(body).collapsed_edges, 50U);
  expect_valid(body.mesh, 1.0);
  expect_pieces(body.mesh, volumes, 1e-13);
  EXPECT_EQ(euler_characteristics(body.mesh), characteristics);
  EXPECT_NEAR(wall_area(body.mesh, 1), first, 1e-12);
  EXPECT_NEAR(wall_area(body.mesh, 2), second, 1e-12);
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      vertex_at(body.mesh, Vec3(x, y, 0));
      vertex_at(body.mesh, Vec3(x, y, 1));
    }
  }
}

/// The tets without a thin shape whose volume is below a share of the typical one's, and which have a short edge.
std::size_t count_small(const TetMesh& mesh, double typical) {
  std::size_t count = 0;
  const double least6 = MergeThresholds().size * typical * typical * typical / std::sqrt(2.0);
  paper::QualityMeter meter(mesh);
  mesh.for_each_tet([&](TetId tet) {
    const MergeThresholds thresholds;
    const bool is_thin =
        meter.of(tet) > thresholds.shape && find_thin_shape(mesh, tet, thresholds.length).shape != ThinShape::kNone;
    const bool is_small = mesh.rest_volume6(tet) < least6 &&
                          find_short_edges(mesh, tet, thresholds.length, typical).shape == ThinShape::kSmall;
    count += !is_thin && is_small ? 1U : 0U;
  });
  return count;
}

/// How many tets of a mesh are worse than some L/r.
std::size_t count_worse(const TetMesh& mesh, double ratio) {
  std::size_t count = 0;
  paper::QualityMeter meter(mesh);
  mesh.for_each_tet([&](TetId tet) { count += meter.of(tet) > ratio ? 1U : 0U; });
  return count;
}

/// What Figure 7 colours.
struct IllShaped {
  std::size_t thin = 0, bad = 0, small = 0;
};

IllShaped count_ill_shaped(const TetMesh& mesh, double typical) {
  return {count_worse(mesh, MergeThresholds().shape), count_worse(mesh, kBadRatio), count_small(mesh, typical)};
}

/// Figure 7: "the ill-shaped tetras as well as ones with too small size are successfully eliminated"; all of them where
/// the wall passes a layer of vertices closely.
TEST(Merge, eliminates_all_ill_shaped_and_small_tets_of_figure_7) {
  CutBody body = cut_as_paper(kuhn_cube(5), {{Vec3(1, 0.004, 0.007), 0.612}});
  const double typical = typical_spacing(body.mesh);
  const IllShaped before = count_ill_shaped(body.mesh, typical);
  EXPECT_EQ(before.thin, 500U);
  EXPECT_GT(before.bad, 20U);
  EXPECT_GT(before.small, 40U);
  merge(body);
  const IllShaped after = count_ill_shaped(body.mesh, typical);
  EXPECT_EQ(after.thin, 0U);
  EXPECT_EQ(after.small, 0U);
}

/// Layers of a thousandth to a hundred-thousandth of an edge are merged away corner by corner, though some of their
/// tets get worse on the way: nothing of them is left.
TEST(Merge, eliminates_layers_however_thin) {
  for (const double beside : {2e-3, 1e-3, 3e-4, 1e-4, 1e-5, -2e-3, -3e-4, -1e-5}) {
    CutBody body = cut_as_paper(kuhn_cube(5), {{Vec3(1, 0, 0), 0.4 + beside}});
    EXPECT_GT(count_worse(body.mesh, kBadRatio), 100U) << beside;
    merge(body);
    EXPECT_EQ(count_worse(body.mesh, 20), 0U) << beside;
    EXPECT_EQ(body.mesh.tet_count(), 750U) << beside;
  }
}

/// The same of other walls: most of each kind.
TEST(Merge, eliminates_most_ill_shaped_and_small_tets) {
  std::size_t bad_before = 0, bad_after = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 10U}) {
    SCOPED_TRACE(seed);
    CutBody body = cut_as_paper(jittered_cube(5, seed), {{Vec3(0.3, 0.5, 0.9), 0.8}});
    const double typical = typical_spacing(body.mesh);
    const IllShaped before = count_ill_shaped(body.mesh, typical);
    merge(body);
    const IllShaped after = count_ill_shaped(body.mesh, typical);
    EXPECT_GT(before.thin, 400U);
    EXPECT_LT(after.thin, before.thin / 4);
    EXPECT_GT(before.small, 30U);
    EXPECT_LE(after.small, 1U);
    EXPECT_LE(after.bad, before.bad);
    bad_before += before.bad;
    bad_after += after.bad;
  }
  EXPECT_GT(bad_before, 200U);
  EXPECT_LT(bad_after, bad_before / 10);
}

TEST(Merge, makes_no_bad_shaped_tet_and_stops_where_nothing_can_go) {
  CutBody body = cut_as_paper(ball(8), curved_stroke());
  const std::size_t bad_before = count_worse(body.mesh, kBadRatio);
  const double worst_before = measure_quality(body.mesh).lr_max;
  merge(body);
  EXPECT_GT(bad_before, 10U);
  EXPECT_LE(count_worse(body.mesh, kBadRatio), bad_before);
  EXPECT_LE(measure_quality(body.mesh).lr_max, worst_before);
  merge(body);  // what is typical in a mesh with fewer small tets is a little larger
  const std::uint64_t hash = body.mesh.hash();
  EXPECT_EQ(merge(body).collapsed_edges, 0U);
  EXPECT_EQ(body.mesh.hash(), hash);
}

TEST(Merge, eliminates_tets_that_are_too_small_in_all_the_mesh) {
  // Planes just beside rows of vertices cut corners off tets that are as well shaped as the tets, and tiny.
  CutBody body = cut_as_paper(kuhn_cube(5), {{Vec3(1, 0.02, 0.03), 0.632}, {Vec3(0.02, 1, 0.05), 0.441}});
  const double typical = typical_spacing(body.mesh);
  const std::vector<double> volumes = piece_volumes(body.mesh);
  const std::size_t before = count_small(body.mesh, typical);
  MergeThresholds shape_alone;
  shape_alone.size = 0;
  CutBody other = body;
  merge(other.mesh, paper::find_tets_at(other.mesh, paper::find_divided_vertices(other.mesh, other.journal, 0)),
        shape_alone);
  const std::size_t left = count_small(other.mesh, typical);
  merge(body);
  EXPECT_GT(before, 20U);
  EXPECT_GT(left, 20U);
  EXPECT_LT(count_small(body.mesh, typical), left / 4);
  expect_valid(body.mesh, 1.0);
  expect_pieces(body.mesh, volumes, 1e-12);
}

TEST(ThinShape, of_a_small_tet_are_the_edges_short_against_the_mesh) {
  const TetMesh mesh = one_tet(Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0.12, 0), Vec3(0, 0, 0.4));
  const ThinTet small = find_short_edges(mesh, TetId(0), 3, 1.0);
  EXPECT_EQ(small.shape, ThinShape::kSmall);
  EXPECT_EQ(edges_of(small), (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_EQ(find_short_edges(mesh, TetId(0), 3, 0.2).shape, ThinShape::kNone);
}

TEST(Merge, asks_the_papers_conditions_and_is_refused_by_them) {
  // A slab so thin that tets reach from wall to wall: to merge across it would leave it hanging on nothing.
  CutBody body = cut_as_paper(kuhn_cube(5), {{Vec3(1, 0.1, 0.05), 0.6}, {Vec3(1, 0.1, 0.05), 0.62}});
  Transaction transaction(body.mesh, true);
  paper::MergeCensus census;
  paper::merge_edges(transaction,
                     paper::find_tets_at(body.mesh, paper::find_divided_vertices(body.mesh, body.journal, 0)), {}, {},
                     &census);
  transaction.commit();
  EXPECT_GT(census.asked, 100U);
  EXPECT_GT(census.refused, 0U);
  EXPECT_LT(census.refused, census.asked);
}

TEST(Merge, beside_a_curved_wall_changes_the_volume_by_little) {
  CutBody body = cut_as_paper(jittered_cube(6, 3), curved_stroke());
  const std::vector<int> characteristics = euler_characteristics(body.mesh);
  EXPECT_GT(merge(body).collapsed_edges, 10U);
  expect_valid(body.mesh, 1.0, 2e-3);
  EXPECT_EQ(euler_characteristics(body.mesh), characteristics);
}

TEST(Merge, takes_inside_vertices_to_a_wall_and_leaves_the_wall) {
  CutBody body = cut_as_paper(kuhn_cube(3), {{Vec3(1, 0, 0), 0.36}});  // a twelfth of an edge beside vertices
  const double area = wall_area(body.mesh, 1);
  EXPECT_GT(merge(body).collapsed_edges, 0U);
  body.mesh.for_each_vertex([&](VertexId v) {
    const Vec3& p = body.mesh.rest(v);
    const bool is_inside = std::min({p.y(), p.z(), 1 - p.y(), 1 - p.z()}) > 1e-9;
    EXPECT_FALSE(is_inside && std::abs(p.x() - 1.0 / 3) < 1e-9) << p.transpose();
  });
  EXPECT_NEAR(wall_area(body.mesh, 1), area, 1e-12);
}

TEST(Merge, beside_coarse_round_skin_changes_the_volume_by_little) {
  CutBody body =
      cut_as_paper(ball(4), {{Vec3(1, 0.3, 0.2), 0.1}, {Vec3(0.2, 1, -0.3), -0.2}, {Vec3(0.1, 0.2, 1), 0.3}});
  const double before = volume_of(body.mesh);
  EXPECT_GT(merge(body).collapsed_edges, 50U);
  EXPECT_NEAR(volume_of(body.mesh) / before, 1, 2e-3);
}

/// A body that stands crumpled: what is merged at rest must not turn its tets inside out as they stand.
TEST(Merge, turns_no_tet_inside_out_in_a_body_that_stands_deformed) {
  CutBody body = cut_as_paper(jittered_cube(6, 3), curved_stroke());
  TetMesh& mesh = body.mesh;
  Random random(5);
  std::vector<Vec3> current(mesh.vertex_slots());
  mesh.for_each_vertex([&](VertexId v) { current[v.value] = mesh.rest(v) + random.point(-0.03, 0.03); });
  mesh.set_current(current);
  const auto volume6_now = [&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    return signed_volume6(mesh.current(v[0]), mesh.current(v[1]), mesh.current(v[2]), mesh.current(v[3]));
  };
  std::vector<TetId> upright;
  mesh.for_each_tet([&](TetId tet) {
    if (volume6_now(tet) > 1e-5) upright.push_back(tet);
  });
  EXPECT_GT(merge(body).collapsed_edges, 10U);
  for (const TetId tet : upright) EXPECT_TRUE(!mesh.is_live(tet) || volume6_now(tet) > 0) << tet.value;
}

TEST(Merge, passes_over_dead_tets) {
  CutBody body = cut_as_paper(kuhn_cube(3), {{Vec3(1, 0.004, 0.007), 0.7}});
  std::vector<TetId> tets;
  for (std::uint32_t slot = 0; slot < body.mesh.tet_slots(); ++slot) tets.emplace_back(slot);
  EXPECT_GT(merge(body.mesh, tets).collapsed_edges, 0U);
  expect_valid(body.mesh, 1.0);
}

}  // namespace
}  // namespace incise::test::paper_merge_test
