// SPDX-License-Identifier: Apache-2.0
// Figure 8: two tets or three, whichever are better by their worst.
#include "paper/face_swap.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "incise/geom/quality.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/remesh.h"
#include "incise/mesh/tet_tables.h"
#include "paper/paper_quality.h"
#include "paper/paper_region.h"
#include "paper/paper_support.h"
#include "paper/smart_laplacian.h"

namespace incise::test::face_swap_test {
namespace {

MaintainStatistics swap_all(TetMesh& mesh) {
  std::vector<TetId> tets;
  mesh.for_each_tet([&](TetId tet) { tets.push_back(tet); });
  Transaction transaction(mesh, true);
  const MaintainStatistics done = paper::swap_faces(transaction, tets);
  transaction.commit();
  return done;
}

double worst(const TetMesh& mesh) {
  return measure_quality(mesh).lr_max;
}

/// Two tets on the triangle 0 1 2, with apexes at ±height.
TetSoup two_tets(double height) {
  return {{Vec3(1, 0, 0), Vec3(-0.5, 0.75, 0), Vec3(-0.5, -0.75, 0), Vec3(0, 0, height), Vec3(0, 0, -height)},
          {{0, 1, 2, 3}, {0, 2, 1, 4}},
          {}};
}
/// The same hull, filled with three tets around the line between the apexes.
TetSoup three_tets(double height) {
  TetSoup soup = two_tets(height);
  soup.tets = {{0, 1, 3, 4}, {1, 2, 3, 4}, {2, 0, 3, 4}};
  for (auto& tet : soup.tets) {
    const Vec3 &a = soup.points[tet[0]], &b = soup.points[tet[1]], &c = soup.points[tet[2]], &d = soup.points[tet[3]];
    if ((b - a).cross(c - a).dot(d - a) < 0) std::swap(tet[2], tet[3]);
  }
  return soup;
}

TEST(FaceSwap, turns_two_flat_tets_into_three) {
  TetMesh mesh = build(two_tets(0.3));
  const double volume = volume_of(mesh), before = worst(mesh), other = worst(build(three_tets(0.3)));
  ASSERT_LT(other, before);
  const MaintainStatistics done = swap_all(mesh);
  EXPECT_EQ(done.removed_faces, 1U);
  EXPECT_EQ(done.removed_edges, 0U);
  EXPECT_GE(done.work_units, 5U);
  EXPECT_EQ(mesh.tet_count(), 3U);
  EXPECT_DOUBLE_EQ(worst(mesh), other);
  expect_valid(mesh, volume);
  EXPECT_EQ(swap_all(mesh).removed_edges, 0U);
}

TEST(FaceSwap, turns_three_long_tets_into_two) {
  TetMesh mesh = build(three_tets(2.0));
  const double volume = volume_of(mesh), other = worst(build(two_tets(2.0)));
  ASSERT_LT(other, worst(mesh));
  const MaintainStatistics done = swap_all(mesh);
  EXPECT_EQ(done.removed_faces, 0U);
  EXPECT_EQ(done.removed_edges, 1U);
  EXPECT_EQ(mesh.tet_count(), 2U);
  EXPECT_DOUBLE_EQ(worst(mesh), other);
  expect_valid(mesh, volume);
}

TEST(FaceSwap, keeps_what_is_better_as_it_is) {
  for (const TetSoup& soup : {two_tets(2.0), three_tets(0.3)}) {
    TetMesh mesh = build(soup);
    const std::uint64_t hash = mesh.hash();
    const MaintainStatistics done = swap_all(mesh);
    EXPECT_EQ(done.removed_faces + done.removed_edges, 0U);
    EXPECT_EQ(mesh.hash(), hash);
  }
}

/// The third configuration: two tets (0 1 | 2 3 4) whose outer faces 0 1 3 and 0 1 4 lie in the plane z = 0. The line
/// 3 4 meets the edge 0 1; `reach` is how far 3 and 4 lie from it, half the edge's length 1, and 2 lies below.
TetSoup flat_pair(double reach) {
  return {{Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, -0.8), Vec3(0.1, -reach, 0), Vec3(0, reach, 0)},
          {{0, 1, 2, 4}, {1, 0, 2, 3}},
          {}};
}
/// The same with its mirror image above the plane: four tets around the edge 0 1.
TetSoup two_flat_pairs(double reach) {
  TetSoup soup = flat_pair(reach);
  soup.points.emplace_back(0, 0, 0.8);
  soup.tets.push_back({1, 0, 5, 4});
  soup.tets.push_back({0, 1, 5, 3});
  return soup;
}
TetSoup made_positive(TetSoup soup) {
  for (auto& tet : soup.tets) {
    const Vec3 &a = soup.points[tet[0]], &b = soup.points[tet[1]], &c = soup.points[tet[2]], &d = soup.points[tet[3]];
    if ((b - a).cross(c - a).dot(d - a) < 0) std::swap(tet[2], tet[3]);
  }
  return soup;
}

TEST(FaceSwap, turns_a_flat_pair_on_the_boundary) {
  TetMesh mesh = build(made_positive(flat_pair(0.2)));
  const double volume = volume_of(mesh), before = worst(mesh);
  const MaintainStatistics done = swap_all(mesh);
  EXPECT_EQ(done.removed_edges, 1U);
  EXPECT_EQ(done.removed_faces, 0U);
  EXPECT_EQ(mesh.tet_count(), 2U);
  EXPECT_LT(worst(mesh), before);
  mesh.for_each_tet([&](TetId tet) {  // both have the edge 3 4 now
    EXPECT_LT(mesh.corner_of(tet, VertexId(3)), 4U);
    EXPECT_LT(mesh.corner_of(tet, VertexId(4)), 4U);
  });
  expect_valid(mesh, volume);
}

TEST(FaceSwap, turns_two_flat_pairs_inside_four_into_four) {
  TetMesh mesh = build(made_positive(two_flat_pairs(0.2)));
  const double volume = volume_of(mesh), before = worst(mesh);
  EXPECT_EQ(swap_all(mesh).removed_edges, 1U);
  EXPECT_EQ(mesh.tet_count(), 4U);
  EXPECT_LT(worst(mesh), before);
  expect_valid(mesh, volume);
}

TEST(FaceSwap, leaves_a_flat_pair_that_is_better_as_it_is_or_not_flat_or_of_two_surfaces) {
  TetSoup bent = flat_pair(0.2);
  bent.points[3].z() = -0.01;
  TetSoup cut = flat_pair(0.2);
  cut.walls.push_back({{0, 1, 3}, 1});
  for (const TetSoup& soup : {flat_pair(2.0), bent, cut}) {
    TetMesh mesh = build(made_positive(soup));
    const std::uint64_t hash = mesh.hash();
    EXPECT_EQ(swap_all(mesh).removed_edges, 0U);
    EXPECT_EQ(mesh.hash(), hash);
  }
}

// --- a search of its own: every swap of Figure 8 that would make the worst of its tets better
// ----------------------------------------------------------------------------------------------------------------

using Tet = std::array<VertexId, 4>;

/// How many swaps of each kind are left.
struct SwapsLeft {
  unsigned two_to_three = 0, three_to_two = 0, two_to_two = 0, four_to_four = 0;

  void operator+=(const SwapsLeft& other) {
    two_to_three += other.two_to_three;
    three_to_two += other.three_to_two;
    two_to_two += other.two_to_two;
    four_to_four += other.four_to_four;
  }
};

/// Asks every face and every edge of a mesh, told from the corners of its tets alone, whether the tets there could be
/// others on the same vertices, and better by a millionth at least.
class SwapSearch {
 public:
  explicit SwapSearch(const TetMesh& mesh) : mesh_(mesh) {
    mesh.for_each_tet([&](TetId id) {
      const TetVertices& v = mesh.vertices(id);
      const Tet tet{v[0], v[1], v[2], v[3]};
      for (unsigned i = 0; i < 4; ++i) {
        faces_[sorted(std::array{tet[(i + 1) % 4], tet[(i + 2) % 4], tet[(i + 3) % 4]})].push_back(tet);
        for (unsigned j = 0; j < i; ++j) edges_[sorted(std::array{tet[i], tet[j]})].push_back(tet);
      }
      for (unsigned s = 0; s < 4; ++s) {
        if (const Link link = mesh.links(id)[s]; link.is_boundary())
          tags_[sorted(mesh.vertices(Side(id, s)))] = link.tag();
      }
    });
  }

  SwapsLeft count() {
    SwapsLeft left;
    for (const auto& [face, tets] : faces_)
      left.two_to_three += tets.size() == 2 && would_be_three(face, tets) ? 1U : 0U;
    for (const auto& [edge, tets] : edges_) {
      const std::vector<VertexId> ring = ring_of(edge, tets);
      const bool is_closed = ring.size() == tets.size();
      left.three_to_two += is_closed && ring.size() == 3 && would_be_two(edge, tets, ring) ? 1U : 0U;
      left.two_to_two += !is_closed && ring.size() == 3 && would_turn_on_surface(edge, tets, ring) ? 1U : 0U;
      left.four_to_four += is_closed && ring.size() == 4 && would_turn_inside(edge, tets, ring) ? 1U : 0U;
    }
    return left;
  }

 private:
  template <class Corners>
  static Corners sorted(Corners corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
  }
  [[nodiscard]] bool has_edge(VertexId a, VertexId b) const { return edges_.count(sorted(std::array{a, b})) > 0; }
  [[nodiscard]] double volume6(const Tet& v) const {
    const Vec3& a = mesh_.rest(v[0]);
    return (mesh_.rest(v[1]) - a).cross(mesh_.rest(v[2]) - a).dot(mesh_.rest(v[3]) - a);
  }
  /// The worst L/r of some tets, in whatever order their corners are.
  [[nodiscard]] double worst_of(const std::vector<Tet>& tets) const {
    double worst = 0;
    for (Tet v : tets) {
      if (volume6(v) < 0) std::swap(v[0], v[1]);
      worst = std::max(
          worst, longest_edge_over_inradius(mesh_.rest(v[0]), mesh_.rest(v[1]), mesh_.rest(v[2]), mesh_.rest(v[3])));
    }
    return worst;
  }
  /// Tets that fill the same space as others have the same volume; overlapping or sticking out, they have more.
  [[nodiscard]] bool fill_the_same(const std::vector<Tet>& old_tets, const std::vector<Tet>& new_tets) const {
    double before = 0, after = 0;
    for (const Tet& v : old_tets) before += std::abs(volume6(v));
    for (const Tet& v : new_tets) after += std::abs(volume6(v));
    return std::abs(after - before) < 1e-9 * before;
  }
  [[nodiscard]] bool would_get_better(const std::vector<Tet>& old_tets, const std::vector<Tet>& new_tets) const {
    return fill_the_same(old_tets, new_tets) && worst_of(new_tets) < (1 - 1e-6) * worst_of(old_tets);
  }
  static VertexId apex_of(const Tet& tet, const std::array<VertexId, 3>& face) {
    return *std::find_if(tet.begin(), tet.end(),
                         [&](VertexId v) { return std::find(face.begin(), face.end(), v) == face.end(); });
  }
  bool would_be_three(const std::array<VertexId, 3>& face, const std::vector<Tet>& tets) const {
    const VertexId d = apex_of(tets[0], face), e = apex_of(tets[1], face);
    const auto& [a, b, c] = face;
    return !has_edge(d, e) && would_get_better(tets, {{a, b, d, e}, {b, c, d, e}, {c, a, d, e}});
  }
  /// The vertices around an edge in order, one more than its tets where it lies on the surface; none where they are not
  /// one fan.
  static std::vector<VertexId> ring_of(const std::array<VertexId, 2>& edge, const std::vector<Tet>& tets) {
    std::map<VertexId, std::set<VertexId>> beside;
    for (const Tet& tet : tets) {
      std::vector<VertexId> other;
      for (const VertexId v : tet) {
        if (v != edge[0] && v != edge[1]) other.push_back(v);
      }
      beside[other[0]].insert(other[1]);
      beside[other[1]].insert(other[0]);
    }
    VertexId at = beside.begin()->first;
    for (const auto& [v, others] : beside) at = others.size() == 1 ? v : at;
    std::vector<VertexId> ring;
    std::set<VertexId> seen;
    for (bool goes_on = true; goes_on;) {
      ring.push_back(at);
      seen.insert(at);
      const auto& next = beside[at];
      const auto unseen = std::find_if(next.begin(), next.end(), [&](VertexId v) { return seen.count(v) == 0; });
      goes_on = unseen != next.end();
      if (goes_on) at = *unseen;
    }
    return ring.size() == beside.size() && ring.size() <= tets.size() + 1 ? ring : std::vector<VertexId>();
  }
  bool would_be_two(const std::array<VertexId, 2>& edge, const std::vector<Tet>& tets,
                    const std::vector<VertexId>& ring) const {
    return faces_.count(sorted(std::array{ring[0], ring[1], ring[2]})) == 0 &&
           would_get_better(tets, {{edge[0], ring[0], ring[1], ring[2]}, {edge[1], ring[0], ring[1], ring[2]}});
  }
  /// Whether the quadrilateral (a, p, b, q) is flat, within rounding.
  [[nodiscard]] bool is_flat(const std::array<VertexId, 2>& edge, VertexId p, VertexId q) const {
    const Vec3 &at = mesh_.rest(edge[0]), along = mesh_.rest(edge[1]) - at;
    const Vec3 n = along.cross(mesh_.rest(p) - at).normalized(), m = (mesh_.rest(q) - at).cross(along).normalized();
    return n.dot(m) > 0 && n.cross(m).norm() < 1e-9;
  }
  bool would_turn_on_surface(const std::array<VertexId, 2>& edge, const std::vector<Tet>& tets,
                             const std::vector<VertexId>& ring) const {
    const auto tag_at = [&](VertexId v) { return tags_.at(sorted(std::array{edge[0], edge[1], v})); };
    return is_flat(edge, ring[0], ring[2]) && tag_at(ring[0]) == tag_at(ring[2]) && !has_edge(ring[0], ring[2]) &&
           would_get_better(tets, {{edge[0], ring[0], ring[1], ring[2]}, {edge[1], ring[0], ring[1], ring[2]}});
  }
  bool would_turn_inside(const std::array<VertexId, 2>& edge, const std::vector<Tet>& tets,
                         const std::vector<VertexId>& ring) const {
    const auto turns = [&](unsigned i, unsigned j) {
      const VertexId p = ring[i], q = ring[i + 2], r = ring[j], s = ring[(j + 2) % 4];
      return is_flat(edge, p, q) && !has_edge(p, q) &&
             would_get_better(tets, {{edge[0], p, q, r}, {edge[1], p, q, r}, {edge[0], p, q, s}, {edge[1], p, q, s}});
    };
    return turns(0, 1) || turns(1, 2);
  }

  const TetMesh& mesh_;
  std::map<std::array<VertexId, 3>, std::vector<Tet>> faces_;
  std::map<std::array<VertexId, 2>, std::vector<Tet>> edges_;
  std::map<std::array<VertexId, 3>, std::uint32_t> tags_;
};

/// Swaps until a pass changes nothing.
std::uint64_t swap_to_the_end(TetMesh& mesh) {
  std::uint64_t swapped = 0;
  for (unsigned round = 0; round < 20; ++round) {
    const MaintainStatistics done = swap_all(mesh);
    if (done.removed_edges + done.removed_faces == 0) return swapped;
    swapped += done.removed_edges + done.removed_faces;
  }
  ADD_FAILURE() << "swaps go on";
  return swapped;
}

/// The tets that are flat though none of their edges is short.
std::size_t count_flat(const TetMesh& mesh) {
  constexpr double kFlatRatio = 15, kShortShare = 0.2;
  std::size_t count = 0;
  paper::QualityMeter meter(mesh);
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    double longest = 0, shortest = 1e300;
    for (const auto& [i, j] : kEdgeCorners) {
      const double length = (mesh.rest(v[i]) - mesh.rest(v[j])).norm();
      longest = std::max(longest, length);
      shortest = std::min(shortest, length);
    }
    count += meter.of(tet) > kFlatRatio && shortest > kShortShare * longest ? 1U : 0U;
  });
  return count;
}

/// "This algorithm can effectively eliminate some flat tetrahedrons that the smoothing method can't" (3.3): those that
/// are left once smoothing moves nothing any more.
TEST(FaceSwap, eliminates_flat_tets_that_smoothing_leaves) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    SCOPED_TRACE(seed);
    TetMesh mesh = cut_as_paper(jittered_cube(5, seed), {{Vec3(0.3, 0.5, 0.9), 0.8}}).mesh;
    const std::size_t cut = count_flat(mesh);
    unsigned rounds = 0;
    for (bool goes_on = true; goes_on && rounds < 50; ++rounds) {
      Transaction transaction(mesh, true);
      goes_on = paper::smooth_inside(transaction, paper::find_all_vertices(mesh)).moved_vertices > 0;
      transaction.commit();
    }
    EXPECT_LT(rounds, 50U);
    const auto smoothed = static_cast<double>(count_flat(mesh));
    EXPECT_GT(smoothed, 0.5 * static_cast<double>(cut));
    swap_all(mesh);
    EXPECT_LT(static_cast<double>(count_flat(mesh)), 0.85 * smoothed);
    expect_valid(mesh, 1.0);
  }
}

/// Turns two tets into three at as many random faces, whatever comes of their shapes.
void scramble(TetMesh& mesh, unsigned count, std::uint64_t seed) {
  Random random(seed);
  std::vector<TetId> produced;
  Transaction transaction(mesh, true);
  for (unsigned done = 0; done < count;) {
    const TetId tet(static_cast<std::uint32_t>(random.integer(0, static_cast<std::int64_t>(mesh.tet_slots()) - 1)));
    const auto side = static_cast<unsigned>(random.integer(0, 3));
    if (!mesh.is_live(tet)) continue;
    const RemeshPlan plan = plan_swap_23(mesh, Side(tet, side));
    if (!plan) continue;
    apply(transaction, plan, produced);
    ++done;
  }
  transaction.commit();
}

/// The cube, squeezed along x, cut by three planes that cross.
TetMesh cut_by_crossing_planes(TetSoup soup, double squeeze) {
  for (Vec3& p : soup.points) p.x() *= squeeze;
  return cut_as_paper(std::move(soup),
                      {{Vec3(1, 0.1 * squeeze, 0), 0.5 * squeeze}, {Vec3(0, 1, 0.1), 0.52}, {Vec3(0.1, 0, 1), 0.54}})
      .mesh;
}

/// Bodies in which all of Figure 8's configurations are found, that of three tets where faces were removed at random.
std::vector<TetMesh> bodies_to_swap_in() {
  std::vector<TetMesh> bodies;
  for (const double squeeze : {1.0, 0.4}) {
    for (const std::uint64_t seed : {0U, 1U}) {
      for (const unsigned scrambled : {0U, 100U}) {
        bodies.push_back(cut_by_crossing_planes(seed == 0 ? kuhn_cube(5) : jittered_cube(5, seed), squeeze));
        scramble(bodies.back(), scrambled, seed);
      }
    }
  }
  return bodies;
}

TEST(FaceSwap, leaves_no_swap_of_figure_8_that_would_make_the_worst_tet_better) {
  SwapsLeft before;
  for (TetMesh& mesh : bodies_to_swap_in()) {
    const double volume = volume_of(mesh);
    before += SwapSearch(mesh).count();
    swap_to_the_end(mesh);
    const SwapsLeft left = SwapSearch(mesh).count();
    EXPECT_EQ(left.two_to_three, 0U);
    EXPECT_EQ(left.three_to_two, 0U);
    EXPECT_EQ(left.two_to_two, 0U);
    EXPECT_EQ(left.four_to_four, 0U);
    expect_valid(mesh, volume);
  }
  EXPECT_GT(before.two_to_three, 30U);
  EXPECT_GT(before.three_to_two, 400U);
  EXPECT_GT(before.two_to_two, 1000U);
  EXPECT_GT(before.four_to_four, 300U);
}

TEST(FaceSwap, to_the_end_keeps_pieces_and_walls_where_planes_cross) {
  TetMesh mesh = cut_by_crossing_planes(kuhn_cube(5), 1);
  const std::vector<double> volumes = piece_volumes(mesh);
  const double area = wall_area(mesh), worst_before = worst(mesh);
  EXPECT_GT(swap_to_the_end(mesh), 100U);
  EXPECT_LE(worst(mesh), worst_before);
  EXPECT_NEAR(wall_area(mesh), area, 1e-9);
  expect_valid(mesh, 1.0);
  expect_pieces(mesh, volumes, 1e-12);
}

TEST(FaceSwap, is_judged_by_the_worst_tet_and_not_by_the_average) {
  Random random(4);
  unsigned swapped = 0, average_alone = 0;
  for (unsigned i = 0; i < 2000; ++i) {
    TetSoup soup = two_tets(random.real(0.1, 1.5));
    for (Vec3& p : soup.points) p += random.point(-0.3, 0.3);
    const auto is_positive = [&](const TetSoup& of) {
      return std::all_of(of.tets.begin(), of.tets.end(), [&](const auto& t) {
        const Vec3 &a = of.points[t[0]], &b = of.points[t[1]], &c = of.points[t[2]], &d = of.points[t[3]];
        return (b - a).cross(c - a).dot(d - a) > 0;
      });
    };
    TetSoup other = soup;
    other.tets = made_positive(three_tets(1)).tets;
    if (!is_positive(soup) || !is_positive(other)) continue;
    TetMesh mesh = build(soup);
    const QualityStats before = measure_quality(mesh), after = measure_quality(build(other));
    swap_all(mesh);
    EXPECT_EQ(mesh.tet_count(), after.lr_max < before.lr_max ? 3U : 2U);
    swapped += mesh.tet_count() == 3 ? 1U : 0U;
    average_alone += after.lr_mean < before.lr_mean && !(after.lr_max < before.lr_max) ? 1U : 0U;
  }
  EXPECT_GT(swapped, 20U);
  EXPECT_GT(average_alone, 5U);
}

TEST(FaceSwap, leaves_boundaries_and_borders_between_regions) {
  TetSoup soup = two_tets(0.3);
  soup.regions = {1, 2};
  TetMesh mesh = build(std::move(soup));
  EXPECT_EQ(swap_all(mesh).removed_faces, 0U);
}

TEST(FaceSwap, beside_a_cut_keeps_volumes_and_walls) {
  TetMesh mesh = cut_as_paper(jittered_cube(6, 8), {{Vec3(0.3, 0.5, 0.9), 0.8}, {Vec3(1, 0.2, 0.1), 0.6}}).mesh;
  const double worst_before = worst(mesh), area = wall_area(mesh);
  const std::vector<double> volumes = piece_volumes(mesh);
  const MaintainStatistics done = swap_all(mesh);
  EXPECT_GT(done.removed_faces, 0U);
  EXPECT_GT(done.removed_edges, 0U);
  EXPECT_LE(worst(mesh), worst_before);
  EXPECT_NEAR(wall_area(mesh), area, 1e-12);
  expect_valid(mesh, 1.0);
  expect_pieces(mesh, volumes, 1e-13);
}

}  // namespace
}  // namespace incise::test::face_swap_test
