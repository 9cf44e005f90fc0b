// SPDX-License-Identifier: Apache-2.0
// What the table says of a master, against the lines and colours that it stands for.
#include "cut/incision_table.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <set>
#include <vector>

#include "cut/incision_lines.h"
#include "cut/parity.h"
#include "support/random.h"

namespace incise::test::incision_table_test {
namespace {

/// A master of one tet, divided as its flags and pierced sides ask for.
struct Divided {
  SplitTemplates templates;
  ClosedComplex complex{templates};
  Master master;

  void divide(unsigned flagged, unsigned on, unsigned pierced) {
    for (unsigned c = 0; c < 4; ++c) master.vertices[c] = VertexId(10 + c);
    master.flagged = static_cast<std::uint8_t>(flagged);
    master.on = static_cast<std::uint8_t>(on);
    std::vector<std::uint8_t> order;
    for (std::uint8_t e = 0; e < 6; ++e) {
      const auto [a, b] = kEdgeCorners[e];
      const bool is_split = ((flagged >> e) & 1U) != 0 && ((on >> a | on >> b) & 1U) == 0;
      if (is_split) order.push_back(e);
    }
    for (unsigned s = 0; s < 4; ++s) master.points[s] = ((pierced >> s) & 1U) != 0 ? s : Master::kNone;
    const bool is_cone = has_odd_face(master.flagged) && (!order.empty() || pierced != 0);
    master.split = is_cone ? &templates.find_cone(order, pierced) : &templates.find(order);
  }
};

unsigned odd_sides(unsigned flagged) {
  unsigned odd = 0;
  for (unsigned s = 0; s < 4; ++s) {
    unsigned count = 0;
    for (const unsigned e : kSideEdges[s]) count += (flagged >> e) & 1U;
    odd |= (count & 1U) << s;
  }
  return odd;
}

/// The parts of the children that hang together by the pairs whose bit is not set.
std::size_t parts(const SplitTemplate& split, std::uint64_t passed) {
  std::vector<std::size_t> part(split.children.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  for (std::size_t k = 0; k < split.inner.size(); ++k) {
    if (((passed >> k) & 1U) != 0) continue;
    const std::size_t from = part[split.inner[k][0] / 4U], to = part[split.inner[k][1] / 4U];
    for (std::size_t& p : part) p = p == from ? to : p;
  }
  return std::set<std::size_t>(part.begin(), part.end()).size();
}

TEST(IncisionTable, parts_a_complete_master_in_two_whichever_its_flags) {
  for (unsigned flagged = 1; flagged < 64; ++flagged) {
    if (odd_sides(flagged) != 0) continue;
    Divided tet;
    tet.divide(flagged, 0, 0);
    IncisionTable table;
    EXPECT_EQ(parts(*tet.master.split, table.find(tet.master, tet.complex).passed), 2U) << flagged;
  }
}

TEST(IncisionTable, passes_the_faces_of_a_cone_that_stand_on_its_lines) {
  for (unsigned flagged = 1; flagged < 64; ++flagged) {
    const unsigned odd = odd_sides(flagged);
    if (odd == 0) continue;
    Divided tet;
    tet.divide(flagged, 0, odd);
    IncisionTable table;
    const PassedFaces faces = table.find(tet.master, tet.complex);
    const IncisionLines lines(tet.master, tet.complex);
    const SplitTemplate& split = *tet.master.split;
    for (std::size_t k = 0; k < split.inner.size(); ++k) {
      const auto& child = split.children[split.inner[k][0] / 4U];
      std::vector<std::uint8_t> foot;
      for (const unsigned c : kSideCorners[split.inner[k][0] & 3U]) {
        if (child[c] != SplitTemplate::kMiddle) foot.push_back(child[c]);
      }
      ASSERT_EQ(foot.size(), 2U);
      EXPECT_EQ((faces.passed >> k) & 1U, lines.contains(foot[0], foot[1]) ? 1U : 0U);
    }
    EXPECT_EQ(faces.is_middle_whole, parts(split, faces.passed) == 1) << flagged;
  }
}

TEST(IncisionTable, leaves_the_middle_of_a_cone_over_one_crossed_edge_in_one_part) {
  for (unsigned e = 0; e < 6; ++e) {
    Divided tet;
    tet.divide(1U << e, 0, odd_sides(1U << e));
    IncisionTable table;
    const PassedFaces faces = table.find(tet.master, tet.complex);
    EXPECT_NE(faces.passed, 0U);
    EXPECT_TRUE(faces.is_middle_whole);
  }
}

TEST(IncisionTable, says_the_same_whatever_was_asked_before) {
  Random random(5);
  Divided tet;
  IncisionTable table;
  for (unsigned run = 0; run < 5000; ++run) {
    const auto flagged = 1 + static_cast<unsigned>(random.real(0, 62.99));
    const auto on = static_cast<unsigned>(random.real(0, 15.99));
    tet.divide(flagged, on, odd_sides(flagged) & static_cast<unsigned>(random.real(0, 15.99)));
    IncisionTable fresh;
    const PassedFaces known = table.find(tet.master, tet.complex), now = fresh.find(tet.master, tet.complex);
    ASSERT_EQ(known.passed, now.passed);
    ASSERT_EQ(known.is_middle_whole, now.is_middle_whole);
  }
}

}  // namespace
}  // namespace incise::test::incision_table_test
