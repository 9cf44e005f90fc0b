// SPDX-License-Identifier: Apache-2.0
// Flat tets on a surface are taken away, and the volume comes back beside them.
#include "improve/peeling.h"

#include <algorithm>
#include <array>
#include <functional>

#include "improve/support.h"

namespace incise::test::peeling_test {
namespace {

/// The number of a point of a Kuhn cube of 4³ cells.
std::uint32_t point_of(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  return i + 5 * (j + 5 * k);
}

/// Adds a tet, turned such that it is positive.
void add_positive(TetSoup& soup, std::array<std::uint32_t, 4> t) {
  const auto& p = soup.points;
  if ((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).dot(p[t[3]] - p[t[0]]) < 0) std::swap(t[2], t[3]);
  soup.tets.push_back(t);
}

/// A cube with a flat tip on one face of its top.
TetSoup cube_with_tip(double height) {
  TetSoup soup = kuhn_cube(4);
  const std::uint32_t a = point_of(1, 1, 4), b = point_of(2, 1, 4), c = point_of(2, 2, 4);
  Vec3 tip = (soup.points[a] + soup.points[b] + soup.points[c]) / 3.0;
  tip.z() += height;
  soup.points.push_back(tip);
  add_positive(soup, {a, b, c, static_cast<std::uint32_t>(soup.points.size() - 1)});
  return soup;
}

/// A cube whose top has a valley along an edge, filled with a flat tet.
TetSoup cube_with_filled_valley(double height) {
  TetSoup soup = kuhn_cube(4);
  const std::uint32_t a = point_of(1, 1, 4), b = point_of(2, 1, 4), c = point_of(2, 2, 4), d = point_of(1, 2, 4);
  soup.points[b].z() += height;
  soup.points[d].z() += height;
  add_positive(soup, {a, b, c, d});
  return soup;
}

/// Which of two regions a tet belongs to, by its centroid.
using IsFirst = std::function<bool(const Vec3&)>;

void label(TetSoup& soup, const IsFirst& is_first) {
  for (const auto& [a, b, c, d] : soup.tets) {
    soup.regions.push_back(is_first(0.25 * (soup.points[a] + soup.points[b] + soup.points[c] + soup.points[d])) ? 1
                                                                                                                : 2);
  }
}

std::array<double, 2> region_volumes6(const TetMesh& mesh) {
  std::array<double, 2> volumes{};
  mesh.for_each_tet([&](TetId tet) { volumes[mesh.region(tet) == 1 ? 0 : 1] += mesh.rest_volume6(tet); });
  return volumes;
}

/// A cube with a spike on a small triangle of its top, of this width and of 0.6 in length; its sides have this tag.
TetMesh cube_with_spike(double width, std::uint32_t tag, const IsFirst& is_first = {}) {
  TetSoup soup = kuhn_cube(4);
  const std::uint32_t a = point_of(1, 1, 4), b = point_of(2, 1, 4), c = point_of(2, 2, 4);
  const auto holds = [](const std::array<std::uint32_t, 4>& t, std::uint32_t v) {
    return std::find(t.begin(), t.end(), v) != t.end();
  };
  const auto below = std::find_if(soup.tets.begin(), soup.tets.end(),
                                  [&](const auto& t) { return holds(t, a) && holds(t, b) && holds(t, c); });
  const std::uint32_t d =
      *std::find_if(below->begin(), below->end(), [&](std::uint32_t v) { return v != a && v != b && v != c; });
  soup.tets.erase(below);
  const Vec3 mid = (soup.points[a] + soup.points[b] + soup.points[c]) / 3.0;
  const auto n = static_cast<std::uint32_t>(soup.points.size());
  for (const std::uint32_t v : {a, b, c}) soup.points.push_back(mid + width * (soup.points[v] - mid).normalized());
  soup.points.push_back(mid + Vec3(0, 0, 0.6));
  const std::array<std::uint32_t, 3> outer = {a, b, c};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t next = (k + 1) % 3;
    add_positive(soup, {outer[k], outer[next], n + k, d});
    add_positive(soup, {outer[next], n + next, n + k, d});
  }
  add_positive(soup, {n, n + 1, n + 2, d});
  add_positive(soup, {n, n + 1, n + 2, n + 3});
  if (is_first) label(soup, is_first);
  TetMesh mesh = build(std::move(soup));
  const TetId spike(static_cast<std::uint32_t>(mesh.tet_count() - 1));
  Transaction transaction(mesh);
  for (unsigned s = 0; s < 4; ++s) {
    if (mesh.links(spike)[s].is_boundary()) transaction.set_link({spike, s}, Link::boundary(tag));
  }
  transaction.commit();
  return mesh;
}

bool peel(TetMesh& mesh, TetId tet) {
  CareOf care(mesh);
  std::vector<std::pair<VertexId, double>> worst;
  for (const VertexId v : mesh.vertices(tet)) worst.emplace_back(v, worst_ratio(mesh, star_of(mesh, v)));
  const bool is_done = Peeler().improve(care.care, tet);
  EXPECT_EQ(care.statistics.peeled_tets, is_done ? 1U : 0U);
  const Step step = care.commit();
  for (const auto& [v, before] : worst) {
    if (is_done && step.moved.at(0).id == v) {
      EXPECT_GT(worst_ratio(mesh, star_of(mesh, v)), before);
    }
  }
  for (const ProducedTet& made : step.produced) {
    EXPECT_NE(std::find(care.changed.begin(), care.changed.end(), made.id), care.changed.end());
  }
  return is_done;
}

TEST(Peeling, takes_a_tip_with_three_boundary_faces_away) {
  TetMesh mesh = build(cube_with_tip(0.004));
  const std::size_t vertices = mesh.vertex_count(), tets = mesh.tet_count();
  const double volume = volume_of(mesh);
  ASSERT_TRUE(peel(mesh, worst_tet(mesh)));
  EXPECT_EQ(mesh.vertex_count(), vertices - 1);
  EXPECT_EQ(mesh.tet_count(), tets - 1);
  expect_valid(mesh, volume, 1e-14);
}

TEST(Peeling, takes_a_flat_tet_with_two_boundary_faces_away) {
  TetMesh mesh = build(cube_with_filled_valley(0.004));
  const std::size_t vertices = mesh.vertex_count(), tets = mesh.tet_count();
  const double volume = volume_of(mesh);
  ASSERT_TRUE(peel(mesh, worst_tet(mesh)));
  EXPECT_EQ(mesh.vertex_count(), vertices);
  EXPECT_EQ(mesh.tet_count(), tets - 1);
  expect_valid(mesh, volume, 1e-14);
}

TEST(Peeling, takes_the_end_of_a_thin_spike_between_walls_away) {
  TetMesh mesh = cube_with_spike(0.003, 5);
  const std::size_t vertices = mesh.vertex_count(), tets = mesh.tet_count();
  const double volume = volume_of(mesh);
  ASSERT_TRUE(peel(mesh, worst_tet(mesh)));
  EXPECT_EQ(mesh.vertex_count(), vertices - 1);
  EXPECT_EQ(mesh.tet_count(), tets - 1);
  expect_valid(mesh, volume, 1e-14);
}

TEST(Peeling, leaves_thick_spikes_and_those_of_the_body) {
  for (TetMesh mesh : {cube_with_spike(0.03, 5), cube_with_spike(0.003, 0)}) {
    const std::uint64_t hash = mesh.hash();
    EXPECT_FALSE(peel(mesh, TetId(static_cast<std::uint32_t>(mesh.tet_count() - 1))));
    EXPECT_EQ(mesh.hash(), hash);
    expect_valid(mesh, volume_of(mesh));
  }
}

TEST(Peeling, leaves_tets_that_stand_out) {
  for (TetMesh mesh : {build(cube_with_tip(0.1)), build(cube_with_filled_valley(0.1))}) {
    const std::uint64_t hash = mesh.hash();
    EXPECT_FALSE(peel(mesh, TetId(384)));
    EXPECT_EQ(mesh.hash(), hash);
    expect_valid(mesh, volume_of(mesh));
  }
}

TEST(Peeling, leaves_tets_that_hold_two_tags) {
  TetMesh mesh = build(cube_with_filled_valley(0.004));
  const TetId tet = worst_tet(mesh);
  Transaction transaction(mesh);
  for (unsigned s = 0; s < 4; ++s) {
    if (mesh.links(tet)[s].is_boundary()) {
      transaction.set_link({tet, s}, Link::boundary(5));
      break;
    }
  }
  transaction.commit();
  EXPECT_FALSE(peel(mesh, tet));
}

TEST(Peeling, leaves_borders_between_regions) {
  TetSoup soup = cube_with_tip(0.004);
  soup.regions.assign(soup.tets.size(), 1);
  soup.regions.back() = 2;
  TetMesh mesh = build(std::move(soup));
  EXPECT_FALSE(peel(mesh, worst_tet(mesh)));
  expect_valid(mesh, volume_of(mesh));
}

TEST(Peeling, beside_borders_keeps_the_volume_of_each_region) {
  const std::array<IsFirst, 5> kinds = {
      [](const Vec3& p) { return p.x() > 0.25; }, [](const Vec3& p) { return p.x() < 0.5; },
      [](const Vec3& p) { return p.x() < 0.418; }, [](const Vec3& p) { return p.x() > 0.416; },
      [](const Vec3& p) { return p.z() > 0.76; }};
  std::array<unsigned, 2> peeled{};
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    TetSoup tip = cube_with_tip(0.004);
    label(tip, [&](const Vec3& p) { return p.z() > 0.95 || kinds[kind](p); });
    for (TetMesh mesh : {build(tip), cube_with_spike(0.003, 5, kinds[kind])}) {
      const double volume = volume_of(mesh);
      const std::array<double, 2> before = region_volumes6(mesh);
      peeled[mesh.tet_count() > 386 ? 1 : 0] += peel(mesh, worst_tet(mesh)) ? 1U : 0U;
      const std::array<double, 2> after = region_volumes6(mesh);
      EXPECT_NEAR(after[0], before[0], 1e-14) << kind;
      EXPECT_NEAR(after[1], before[1], 1e-14) << kind;
      expect_valid(mesh, volume, 1e-14);
    }
  }
  EXPECT_GT(peeled[0], 0U);
  EXPECT_GT(peeled[1], 0U);
}

TEST(Peeling, leaves_tets_inside_and_those_with_one_boundary_face) {
  TetMesh mesh = build(kuhn_cube(4));
  const std::uint64_t hash = mesh.hash();
  for (const TetId tet : tets_of(mesh)) EXPECT_FALSE(peel(mesh, tet));
  EXPECT_EQ(mesh.hash(), hash);
  expect_valid(mesh, 1.0);
}

TEST(Peeling, of_cut_bodies_keeps_the_volume_of_every_piece) {
  unsigned peeled = 0;
  for (TetMesh mesh : {cut_mesh(ball(8), {{Vec3(0.3, 0.5, 0.9), 0.1}}),
                       cut_mesh(jittered_cube(6, 6), coring_stroke(Vec3(0.5, 0.5, 0), 0.3, 24, -0.2, 1.2))}) {
    const std::vector<double> volumes = piece_volumes(mesh);
    for (const TetId tet : tets_of(mesh)) {
      if (mesh.is_live(tet) && ratio_of(mesh, tet) < 0.25 && peel(mesh, tet)) ++peeled;
    }
    expect_pieces(mesh, volumes, 1e-12);
    expect_valid(mesh, volume_of(mesh));
  }
  EXPECT_GT(peeled, 0U);
}

}  // namespace
}  // namespace incise::test::peeling_test
