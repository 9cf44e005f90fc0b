// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/defects.h"

#include <gtest/gtest.h>

namespace incise::defects_test {
namespace {

TetSoup one_tet() {
  TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  soup.tets = {{0, 1, 2, 3}};
  return soup;
}

// Two tets on either side of the face 1 2 3.
TetSoup two_tets() {
  TetSoup soup = one_tet();
  soup.points.emplace_back(1, 1, 1);
  soup.tets.push_back({1, 2, 3, 4});
  return soup;
}

std::vector<std::uint32_t> examples(const Defects& d, DefectKind kind) {
  return d.examples[static_cast<std::size_t>(kind)];
}

TEST(Defects, sound_meshes_have_none) {
  for (const TetSoup& soup : {one_tet(), two_tets()}) {
    const Defects d = find_defects(soup);
    EXPECT_TRUE(d.none());
    EXPECT_EQ(d.components, 1U);
    EXPECT_FALSE(d.negative);
  }
}

TEST(Defects, an_empty_soup_has_unreferenced_points_only) {
  TetSoup soup;
  EXPECT_TRUE(find_defects(soup).none());
  soup.points.resize(3, Vec3(0, 0, 0));
  EXPECT_EQ(find_defects(soup).unreferenced_vertices, 3U);
  EXPECT_EQ(find_defects(soup).duplicate_vertices, 0U);
}

TEST(Defects, the_minority_sign_is_inverted) {
  TetSoup soup = two_tets();
  soup.points.emplace_back(-1, -1, -1);
  soup.tets.push_back({0, 1, 5, 3});  // negative
  soup.tets[1] = {1, 2, 4, 3};        // negative
  const Defects d = find_defects(soup);
  EXPECT_TRUE(d.negative);
  EXPECT_EQ(d.inverted, 1U);
  EXPECT_EQ(examples(d, DefectKind::kInverted), std::vector<std::uint32_t>{0});
}

TEST(Defects, flat_tets_count_as_zero_volume_and_as_neither_sign) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    TetSoup soup = one_tet();
    soup.points.emplace_back(0.5, 0.5, 0);
    soup.tets.push_back({0, 2, 1, 4});
    for (Vec3& p : soup.points) p *= scale;
    const Defects d = find_defects(soup);
    EXPECT_EQ(d.zero_volume, 1U);
    EXPECT_EQ(d.inverted, 0U);
    EXPECT_EQ(examples(d, DefectKind::kZeroVolume), std::vector<std::uint32_t>{1});
  }
}

TEST(Defects, tets_that_share_an_edge_or_a_vertex_are_apart_and_pinched) {
  TetSoup edge = one_tet();
  edge.points.insert(edge.points.end(), {{0, -1, 0}, {0, 0, -1}});
  edge.tets.push_back({0, 1, 4, 5});
  const Defects at_edge = find_defects(edge);
  EXPECT_EQ(at_edge.components, 2U);
  EXPECT_EQ(at_edge.nonmanifold_edges, 1U);
  EXPECT_EQ(examples(at_edge, DefectKind::kNonmanifoldEdges), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(at_edge.singleton_vertices, 2U);

  TetSoup vertex = one_tet();
  vertex.points.insert(vertex.points.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  vertex.tets.push_back({0, 5, 4, 6});
  const Defects at_vertex = find_defects(vertex);
  EXPECT_EQ(at_vertex.components, 2U);
  EXPECT_EQ(at_vertex.nonmanifold_edges, 0U);
  EXPECT_EQ(at_vertex.singleton_vertices, 1U);
  EXPECT_EQ(examples(at_vertex, DefectKind::kSingletonVertices), std::vector<std::uint32_t>{0});
}

TEST(Defects, overshared_faces_link_nothing) {
  TetSoup soup = two_tets();
  soup.points.emplace_back(2, 2, 2);
  soup.tets.push_back({1, 2, 3, 5});
  const Defects d = find_defects(soup);
  EXPECT_EQ(d.overshared_faces, 1U);
  EXPECT_EQ(d.components, 3U);
}

TEST(Defects, duplicates_are_counted_beyond_the_first) {
  TetSoup soup = two_tets();
  soup.tets.push_back({3, 2, 1, 0});
  soup.points.push_back(soup.points[0]);  // not used, therefore no duplicate
  Defects d = find_defects(soup);
  EXPECT_EQ(d.duplicate_tets, 1U);
  EXPECT_EQ(examples(d, DefectKind::kDuplicateTets), std::vector<std::uint32_t>{2});
  EXPECT_EQ(d.duplicate_vertices, 0U);
  EXPECT_EQ(d.unreferenced_vertices, 1U);
  soup.points[4] = soup.points[0];
  d = find_defects(soup);
  EXPECT_EQ(d.duplicate_vertices, 1U);
  EXPECT_EQ(examples(d, DefectKind::kDuplicateVertices), std::vector<std::uint32_t>{4});
}

TEST(Defects, the_list_names_every_kind) {
  const auto list = list_defects(find_defects(one_tet()));
  ASSERT_EQ(list.size(), kDefectKinds);
  EXPECT_EQ(list[0].name, "inverted");
  EXPECT_EQ(list[7].name, "singleton_vertices");
}

TEST(Defects, a_tet_with_a_repeated_vertex_is_flat_and_harmless) {
  TetSoup soup = two_tets();
  soup.tets.push_back({4, 4, 4, 4});
  soup.tets.push_back({0, 0, 1, 2});
  EXPECT_EQ(find_defects(soup).zero_volume, 2U);
}

TEST(Normalise, turns_negative_tets_and_drops_duplicates) {
  TetSoup soup = two_tets();
  soup.tets = {{0, 1, 3, 2}, {1, 2, 3, 4}, {2, 3, 1, 0}};
  soup.regions = {5, 6, 7};
  const Normalised done = normalise(soup);
  EXPECT_EQ(done.flipped, 1U);
  EXPECT_EQ(done.dropped, 1U);
  EXPECT_EQ(done.zero_volume, 0U);
  EXPECT_EQ(done.dropped_tets, std::vector<std::uint32_t>{2});
  EXPECT_EQ(soup.regions, (std::vector<std::int32_t>{5, 6}));
  EXPECT_EQ(soup.tets[0], (std::array<std::uint32_t, 4>{0, 1, 2, 3}));
  EXPECT_TRUE(find_defects(soup).none());
  const Normalised again = normalise(soup);
  EXPECT_EQ(again.flipped + again.dropped, 0U);
}

}  // namespace
}  // namespace incise::defects_test
