// SPDX-License-Identifier: Apache-2.0
// Ways to fill one tet: nothing missing, nothing twice, and each side as its neighbour divides it.
#include "lab/filling.h"

#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <set>

#include "incise/geom/quality.h"
#include "incise/mesh/tet_tables.h"

namespace incise::test::filling_test {
namespace {

using lab::Child;
using lab::PointCode;
using lab::PointVertices;
using Face = std::set<PointCode>;

/// Some place in the interior of the support of a point, not the middle.
Vec3 place_of(PointCode code) {
  const unsigned support = lab::support_of(code);
  Vec3 place = Vec3::Zero();
  double sum = 0;
  for (unsigned c = 0; c < 4; ++c) {
    if (((support >> c) & 1U) == 0) continue;
    const double weight = 1.0 + 0.07 * c;
    sum += weight;
    if (c > 0) place[static_cast<int>(c) - 1] = weight;
  }
  return place / sum;
}

double volume6_of(const Child& child) {
  const auto& p = child.points;
  return signed_volume6(place_of(p[0]), place_of(p[1]), place_of(p[2]), place_of(p[3]));
}

std::map<Face, unsigned> count_faces(const std::vector<Child>& children) {
  std::map<Face, unsigned> count;
  for (const Child& child : children) {
    for (const auto& c : kSideCorners) ++count[{child.points[c[0]], child.points[c[1]], child.points[c[2]]}];
  }
  return count;
}

/// Volumes are positive and sum to the tet's; faces are inside, between two parts, or on a side of the tet.
void expect_filled(const std::vector<Child>& children, const std::string& what) {
  double sum = 0;
  for (const Child& child : children) {
    EXPECT_GT(volume6_of(child), 0) << what;
    sum += volume6_of(child);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12) << what;
  for (const auto& [face, count] : count_faces(children)) {
    unsigned support = 0;
    for (const PointCode code : face) support |= lab::support_of(code);
    EXPECT_EQ(count, std::popcount(support) == 3 ? 1U : 2U) << what;
  }
}

/// The triangles on a side, with the vertices of its points.
std::set<std::set<std::uint32_t>> triangles_on(unsigned side, const std::vector<Child>& children,
                                               const PointVertices& vertices) {
  std::set<std::set<std::uint32_t>> triangles;
  for (const auto& [face, count] : count_faces(children)) {
    std::set<std::uint32_t> triangle;
    bool is_on = true;
    for (const PointCode code : face) {
      is_on = is_on && ((lab::support_of(code) >> side) & 1U) == 0;
      triangle.insert(vertices[code].value);
    }
    if (is_on) triangles.insert(triangle);
  }
  return triangles;
}

PointVertices all_vertices() {
  PointVertices vertices;
  for (unsigned code = 0; code < lab::kPointCodes; ++code) vertices[code] = VertexId((code * 7U) % 29U);
  return vertices;
}

TEST(Filling, with_17_parts_fills_a_tet_whatever_lies_beyond) {
  for (unsigned beyond = 1; beyond < 15; ++beyond) {
    EXPECT_EQ(lab::fill_with_17(beyond).size(), 17U);
    expect_filled(lab::fill_with_17(beyond), std::to_string(beyond));
  }
}

TEST(Filling, adaptively_fills_a_tet_whatever_lies_beyond) {
  for (unsigned beyond = 1; beyond < 15; ++beyond) {
    const std::vector<Child> children = lab::fill_adaptively(beyond, all_vertices());
    EXPECT_EQ(children.size(), std::popcount(beyond) == 2 ? 15U : 11U);
    expect_filled(children, std::to_string(beyond));
  }
}

TEST(Filling, beside_divided_tets_fills_a_tet_with_any_points) {
  for (unsigned bits = 0; bits < 1024; ++bits) {
    PointVertices vertices = all_vertices();
    for (unsigned k = 0; k < 10; ++k) {
      if (((bits >> k) & 1U) == 0) vertices[4 + k] = VertexId();
    }
    expect_filled(lab::fill_beside(vertices), std::to_string(bits));
  }
}

TEST(Filling, agrees_on_a_side_that_two_tets_share) {
  for (unsigned beyond = 1; beyond < 15; ++beyond) {
    PointVertices vertices = all_vertices();
    for (unsigned s = 0; s < 4; ++s) {
      EXPECT_EQ(triangles_on(s, lab::fill_with_17(beyond), vertices),
                triangles_on(s, lab::fill_beside(vertices), vertices));
    }
    for (unsigned e = 0; e < 6; ++e) {
      const auto [a, b] = kEdgeCorners[e];
      if (((beyond >> a) & 1U) == ((beyond >> b) & 1U)) vertices[lab::edge_code(e)] = VertexId();
    }
    for (unsigned s = 0; s < 4; ++s) {
      const unsigned on_side = beyond & ~(1U << s), whole = 15U & ~(1U << s);
      if (on_side == 0 || on_side == whole) vertices[lab::side_code(s)] = VertexId();
    }
    for (unsigned s = 0; s < 4; ++s) {
      EXPECT_EQ(triangles_on(s, lab::fill_adaptively(beyond, vertices), vertices),
                triangles_on(s, lab::fill_beside(vertices), vertices));
    }
  }
}

}  // namespace
}  // namespace incise::test::filling_test
