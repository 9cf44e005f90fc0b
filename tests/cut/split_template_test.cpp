// SPDX-License-Identifier: Apache-2.0
// How single tets fall apart: all patterns, all orders, all pierced sides.
#include "cut/split_template.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::split_template_test {
namespace {

using Order = std::vector<std::uint8_t>;

/// Calls `visit` for every order of every set of edges of a tet: 1957 in all.
template <class Visit>
void for_each_order(Visit&& visit) {
  for (unsigned flags = 0; flags < 64; ++flags) {
    Order order;
    for (std::uint8_t e = 0; e < 6; ++e) {
      if (((flags >> e) & 1U) != 0) order.push_back(e);
    }
    do {
      visit(order);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

using Points = std::array<Vec3, 15>;  // by code

/// A point inside a simplex.
template <std::size_t N>
Vec3 point_amid(Random& random, const std::array<Vec3, N>& corners) {
  Vec3 point = Vec3::Zero();
  double sum = 0;
  for (const Vec3& corner : corners) {
    const double weight = random.real(0.02, 1);
    point += weight * corner;
    sum += weight;
  }
  return point / sum;
}

Points points_of_a_tet(Random& random) {
  Points p;
  p[0] = Vec3(0, 0, 0), p[1] = Vec3(1, 0.1, 0), p[2] = Vec3(0.2, 1, -0.1), p[3] = Vec3(0.1, 0.3, 1);
  for (unsigned e = 0; e < 6; ++e) {
    const auto [a, b] = kEdgeCorners[e];
    p[4 + e] = p[a] + random.real(0.02, 0.98) * (p[b] - p[a]);
  }
  for (unsigned s = 0; s < 4; ++s) {
    const auto& k = kSideCorners[s];
    p[10 + s] = point_amid<3>(random, {p[k[0]], p[k[1]], p[k[2]]});
  }
  p[14] = point_amid<4>(random, {p[0], p[1], p[2], p[3]});
  return p;
}

double volume6(const Points& p, const SplitTemplate::Child& c) {
  return (p[c[1]] - p[c[0]]).cross(p[c[2]] - p[c[0]]).dot(p[c[3]] - p[c[0]]);
}

std::set<unsigned> codes(const SplitTemplate& split, SplitTemplate::ChildSide side) {
  std::set<unsigned> result;
  for (const unsigned corner : kSideCorners[side & 3U]) result.insert(split.children[side / 4U][corner]);
  return result;
}

void expect_filled(const SplitTemplate& split, const Points& p) {
  double sum = 0;
  for (const auto& child : split.children) {
    EXPECT_GT(volume6(p, child), 0.0);
    sum += volume6(p, child);
  }
  EXPECT_NEAR(sum, volume6(p, {0, 1, 2, 3}), 1e-15);
}

/// Every side of a child meets another of the same vertices, or lies on the tet.
void expect_linked(const SplitTemplate& split) {
  std::vector<unsigned> seen(4 * split.children.size(), 0);
  for (const auto& [a, b] : split.inner) {
    EXPECT_EQ(codes(split, a), codes(split, b));
    EXPECT_NE(a / 4U, b / 4U);
    ++seen[a];
    ++seen[b];
  }
  for (unsigned s = 0; s < 4; ++s) {
    for (const auto side : split.outer[s]) ++seen[side];
  }
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](unsigned n) { return n == 1; }));
}

Vec3 twice_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}

/// The triangles on a side fill it and turn as it does.
void expect_filled_side(const SplitTemplate& split, const Points& p, unsigned s) {
  const auto& k = kSideCorners[s];
  const Vec3 whole = twice_area(p[k[0]], p[k[1]], p[k[2]]);
  Vec3 area = Vec3::Zero();
  for (const auto side : split.outer[s]) {
    const auto& child = split.children[side / 4U];
    const auto& c = kSideCorners[side & 3U];
    const Vec3 part = twice_area(p[child[c[0]]], p[child[c[1]]], p[child[c[2]]]);
    EXPECT_GT(part.dot(whole), 0.0);
    area += part;
  }
  EXPECT_LT((area - whole).norm(), 1e-14);
}

void expect_sound(const SplitTemplate& split, Random& random) {
  const Points p = points_of_a_tet(random);
  expect_filled(split, p);
  expect_linked(split);
  for (unsigned s = 0; s < 4; ++s) expect_filled_side(split, p, s);
}

TEST(SplitTemplate, children_are_positive_meet_and_fill_the_tet_for_every_order_of_every_pattern) {
  Random random(1);
  SplitTemplates templates;
  unsigned count = 0;
  for_each_order([&](const Order& order) {
    for (unsigned run = 0; run < 3; ++run) expect_sound(templates.find(order), random);
    ++count;
  });
  EXPECT_EQ(count, 1957U);
}

TEST(SplitTemplate, cones_are_positive_meet_and_fill_the_tet_for_every_order_and_any_pierced_sides) {
  Random random(2);
  SplitTemplates templates;
  for_each_order([&](const Order& order) {
    for (unsigned pierced = 0; pierced < 16; ++pierced) {
      const SplitTemplate& split = templates.find_cone(order, pierced);
      expect_sound(split, random);
      EXPECT_EQ(&split, &templates.find_cone(order, pierced));
    }
  });
}

TEST(SplitTemplate, cones_divide_their_sides_as_bisection_does_where_nothing_is_pierced) {
  SplitTemplates templates;
  const auto triangles = [](const SplitTemplate& split, unsigned s) {
    std::set<std::set<unsigned>> result;
    for (const auto side : split.outer[s]) result.insert(codes(split, side));
    return result;
  };
  for_each_order([&](const Order& order) {
    const SplitTemplate &whole = templates.find(order), &cone = templates.find_cone(order, 0);
    for (unsigned s = 0; s < 4; ++s) EXPECT_EQ(triangles(whole, s), triangles(cone, s));
  });
}

TEST(SplitTemplate, a_cone_over_one_crossed_edge_has_ten_children) {
  SplitTemplates templates;
  for (std::uint8_t e = 0; e < 6; ++e) {
    unsigned pierced = 0;
    for (unsigned s = 0; s < 4; ++s) {
      const bool has_edge = std::find(kSideEdges[s].begin(), kSideEdges[s].end(), e) != kSideEdges[s].end();
      pierced |= (has_edge ? 1U : 0U) << s;
    }
    EXPECT_EQ(templates.find_cone(Order{e}, pierced).children.size(), 10U);
  }
}

TEST(SplitTemplate, cones_from_a_front_point_are_sound_and_have_as_many_children_fewer_as_its_side_has_facets) {
  Random random(3);
  SplitTemplates templates;
  for_each_order([&](const Order& order) {
    for (unsigned pierced = 0; pierced < 16; ++pierced) {
      const SplitTemplate& whole = templates.find_cone(order, pierced);
      for (unsigned s = 0; s < 4; ++s) {
        if (((pierced >> s) & 1U) == 0) continue;
        const auto apex = static_cast<std::uint8_t>(SplitTemplate::kFirstPoint + s);
        const SplitTemplate& split = templates.find_cone(order, pierced, apex);
        expect_sound(split, random);
        EXPECT_EQ(split.children.size() + whole.outer[s].size(), whole.children.size());
        EXPECT_EQ(split.around(apex).size(), split.children.size());
        EXPECT_TRUE(split.around(SplitTemplate::kMiddle).empty());
      }
    }
  });
}

TEST(SplitTemplate, neighbours_triangulate_their_common_face_alike) {
  // Two tets on the face (0, 1, 2); the second numbers its corners differently. One random order of all nine edges.
  Random random(3);
  SplitTemplates templates;
  for (unsigned run = 0; run < 20000; ++run) {
    const std::array<std::array<unsigned, 4>, 2> tets = {{{0, 1, 2, 3}, {2, 4, 0, 1}}};
    std::vector<std::array<unsigned, 2>> edges = {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3},
                                                  {2, 3}, {0, 4}, {1, 4}, {2, 4}};
    for (std::size_t i = edges.size(); i > 1; --i) {
      std::swap(edges[i - 1], edges[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(i) - 1))]);
    }
    edges.resize(static_cast<std::size_t>(random.integer(0, 9)));
    std::array<std::set<std::set<unsigned>>, 2> faces;
    for (unsigned t = 0; t < 2; ++t) {
      const auto corner_of = [&](unsigned v) { return std::find(tets[t].begin(), tets[t].end(), v) - tets[t].begin(); };
      Order order;
      for (const auto& [a, b] : edges) {
        const auto i = static_cast<std::size_t>(corner_of(a)), j = static_cast<std::size_t>(corner_of(b));
        if (i < 4 && j < 4) order.push_back(kEdgeOfCorners[i][j]);
      }
      const SplitTemplate& split = templates.find(order);
      const unsigned apex = static_cast<unsigned>(corner_of(t == 0 ? 3U : 4U));
      for (const auto side : split.outer[apex]) {
        std::set<unsigned> face;
        for (const unsigned code : codes(split, side)) {
          const auto name = [&](unsigned corner) { return tets[t][corner]; };
          if (code < 4) {
            face.insert(name(code));
          } else {
            const auto [a, b] = kEdgeCorners[code - 4];
            face.insert(10 + 5 * std::min(name(a), name(b)) + std::max(name(a), name(b)));
          }
        }
        faces[t].insert(face);
      }
    }
    ASSERT_EQ(faces[0], faces[1]);
  }
}

TEST(SplitTemplate, one_corner_cut_off_gives_four_children_and_two_from_two_gives_six) {
  SplitTemplates templates;
  Order one_from_three = {0, 1, 2}, two_from_two = {1, 2, 3, 4};
  do {
    EXPECT_EQ(templates.find(one_from_three).children.size(), 4U);
  } while (std::next_permutation(one_from_three.begin(), one_from_three.end()));
  do {
    EXPECT_EQ(templates.find(two_from_two).children.size(), 6U);
  } while (std::next_permutation(two_from_two.begin(), two_from_two.end()));
}

TEST(OneTet, cut_by_a_plane_opens_one_face_or_two) {
  TetSoup soup;
  soup.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  soup.tets = {{0, 1, 2, 3}};
  for (const Profile profile : {Profile::kPaper, Profile::kIncise}) {
    Engine corner = make_engine(soup, 0.0, profile);
    const CutStatistics one = cut(corner, plane(corner, Vec3(0, 0, 1), 0.5));
    EXPECT_EQ(corner.mesh().tet_count(), 4U);
    EXPECT_EQ(one.incision_faces, 1U);
    expect_pieces(corner.mesh(), {1 / 48.0, 7 / 48.0}, 1e-16);
    Engine middle = make_engine(soup, 0.0, profile);
    const CutStatistics two = cut(middle, plane(middle, Vec3(1, 1, 0), 0.5));
    EXPECT_EQ(middle.mesh().tet_count(), 6U);
    EXPECT_EQ(two.incision_faces, 2U);
    expect_pieces(middle.mesh(), {1 / 12.0, 1 / 12.0}, 1e-16);
  }
}

}  // namespace
}  // namespace incise::test::split_template_test
