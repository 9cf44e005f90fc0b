// SPDX-License-Identifier: Apache-2.0
#include "sim/body/packed_stars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "sim/body/kernel_rows.h"
#include "support/random.h"

namespace incise::packed_stars_test {
namespace {

using detail::kLanes;
using detail::NearLanes;
using detail::PackedStar;
using detail::StarBlock;
using detail::TetLanes;
using test::Random;

/// Stars to which tets come and from which they go, packed after each change.
class Body {
 public:
  Body(std::uint32_t vertices, std::uint32_t tets) : vertices_(vertices) {
    stars_.ensure(vertices, tets);
    rows_.ensure(vertices);
    std::vector<std::uint32_t> order(vertices);
    for (std::uint32_t v = 0; v < vertices; ++v) order[v] = (7 * v + 3) % vertices;
    rows_.arrange(order);
    packed_.ensure(vertices);
  }
  void toggle(TetId tet, const TetVertices& vertices, Random& random) {
    if (const auto found = tets_.find(tet.value); found != tets_.end()) {
      stars_.remove(tet, found->second);
      pack(found->second);
      tets_.erase(found);
      return;
    }
    detail::Element element;
    for (double& entry : element.laplacian) entry = random.real(-1, 1);
    element.bulk = random.real(0.1, 1);
    element.pressure = random.real(0, 1);
    stars_.add(tet, vertices, element);
    pack(vertices);
    tets_[tet.value] = vertices;
  }
  /// What is packed says what the stars say.
  void check() const {
    for (std::uint32_t v = 0; v < vertices_; ++v) check(VertexId(v));
  }
  [[nodiscard]] unsigned parts_of(VertexId vertex) const {
    unsigned count = 1;
    for (std::uint32_t next = star(vertex).next; next != 0; next = packed_.parts()[next].next) ++count;
    return count;
  }
  [[nodiscard]] const PackedStar& star(VertexId vertex) const { return packed_.all()[rows_.of(vertex)]; }

 private:
  void pack(const TetVertices& vertices) {
    for (const VertexId v : vertices) {
      stars_.close(v);
      packed_.update(v, stars_, rows_);
    }
  }
  void check(VertexId vertex) const {
    const detail::Star& whole = stars_.of(vertex);
    std::map<std::uint32_t, double> expected, found;
    std::uint32_t number = 0;
    for (const PackedStar* part = &star(vertex);; part = packed_.parts() + part->next) {
      for (std::uint32_t i = 0; i < part->tets; ++i) check_block(vertex, *part, i, number++, expected);
      sum_weights(vertex, *part, found);
      if (part->next == 0) break;
    }
    ASSERT_EQ(number, whole.used_blocks());
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [slot, weight] : expected) ASSERT_NEAR(found[slot], weight, 1e-5) << slot;
  }
  /// Lane by lane the same; adds up the Laplacian by neighbour.
  void check_block(VertexId vertex, const PackedStar& part, std::uint32_t i, std::uint32_t number,
                   std::map<std::uint32_t, double>& sums) const {
    const TetLanes& lanes = packed_.tets()[part.first_tets + i];
    const StarBlock& block = stars_.blocks()[stars_.of(vertex).first + number];
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      ASSERT_EQ(lanes.bulk[k], block.bulk[k]);
      ASSERT_EQ(lanes.pressure[k], block.pressure[k]);
      if (number * kLanes + k >= stars_.of(vertex).lanes) {
        ASSERT_EQ(lanes.bulk[k], 0);
        ASSERT_EQ(lanes.a[k] + lanes.b[k] + lanes.c[k], 0) << "an unused lane turns a normal";
        continue;
      }
      ASSERT_EQ(slot_of(part, lanes.a[k]), block.a[k]);
      ASSERT_EQ(slot_of(part, lanes.b[k]), block.b[k]);
      ASSERT_EQ(slot_of(part, lanes.c[k]), block.c[k]);
      sums[block.a[k]] += static_cast<double>(block.to_a[k]);
      sums[block.b[k]] += static_cast<double>(block.to_b[k]);
      sums[block.c[k]] += static_cast<double>(block.to_c[k]);
    }
  }
  void sum_weights(VertexId vertex, const PackedStar& part, std::map<std::uint32_t, double>& sums) const {
    std::set<std::uint32_t> here;
    for (std::uint32_t k = 0; k < part.near * kLanes; ++k) {
      const NearLanes& near = packed_.near()[part.first_near + k / kLanes];
      const std::uint32_t slot = rows_.slots()[near.place[k % kLanes] / 4];
      if (slot == vertex.value) {
        ASSERT_EQ(near.weight[k % kLanes], 0) << "an unused lane weighs something";
        continue;
      }
      ASSERT_TRUE(here.insert(slot).second) << "a neighbour is listed twice";
      sums[slot] += static_cast<double>(near.weight[k % kLanes]);
    }
  }
  /// The slot that a code stands for.
  [[nodiscard]] std::uint32_t slot_of(const PackedStar& part, std::uint8_t code) const {
    for (std::uint32_t block = 0; block < part.near; ++block) {
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        if (detail::near_code(block, lane) != code) continue;
        return rows_.slots()[packed_.near()[part.first_near + block].place[lane] / 4];
      }
    }
    return kInvalidIndex;
  }

  std::uint32_t vertices_;
  detail::Stars stars_;
  detail::KernelRows rows_;
  detail::PackedStars packed_;
  std::map<std::uint32_t, TetVertices> tets_;
};

TetVertices any_corners(Random& random, std::uint32_t vertices) {
  TetVertices corners;
  for (unsigned c = 0; c < 4; ++c) {
    do {  // low numbers meet more often: their stars fill several blocks
      const auto limit = random.integer(4, vertices);
      corners[c] = VertexId(static_cast<std::uint32_t>(random.integer(0, limit - 1)));
    } while (std::find(corners.begin(), corners.begin() + c, corners[c]) != corners.begin() + c);
  }
  return corners;
}

TEST(PackedStars, SayWhatTheStarsSayWhileTetsComeAndGo) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Body body(60, 300);
    for (unsigned i = 0; i < 2500 && !testing::Test::HasFatalFailure(); ++i) {
      body.toggle(TetId(static_cast<std::uint32_t>(random.integer(0, 299))), any_corners(random, 60), random);
      if (i % 50 == 0) body.check();
    }
    body.check();
  }
}

TEST(PackedStars, OfMoreNeighboursThanCodesHaveParts) {
  constexpr std::uint32_t kTets = 300;
  Random random(1);
  Body body(1 + 3 * kTets, kTets);
  const auto corners = [](std::uint32_t t) {
    return TetVertices{VertexId(0), VertexId(3 * t + 1), VertexId(3 * t + 2), VertexId(3 * t + 3)};
  };
  for (std::uint32_t t = 0; t < kTets; ++t) body.toggle(TetId(t), corners(t), random);
  EXPECT_EQ(body.parts_of(VertexId(0)), 4U);  // of 240 neighbours and what is left
  body.check();
  for (std::uint32_t t = 0; t < kTets - 10; ++t) body.toggle(TetId(t), corners(t), random);
  EXPECT_EQ(body.parts_of(VertexId(0)), 1U);
  body.check();
  for (std::uint32_t t = 0; t < kTets - 10; ++t) body.toggle(TetId(t), corners(t), random);
  EXPECT_EQ(body.parts_of(VertexId(0)), 4U);
  body.check();
}

TEST(KernelRows, ArePermutedOnceAndThenKept) {
  detail::KernelRows rows;
  rows.ensure(6);
  rows.arrange(std::array<std::uint32_t, 3>{4, 0, 2});
  EXPECT_EQ(rows.of(VertexId(4)), 0U);
  EXPECT_EQ(rows.of(VertexId(0)), 1U);
  EXPECT_EQ(rows.of(VertexId(2)), 2U);
  rows.ensure(9);
  std::vector<std::uint32_t> all(9), found;
  std::iota(all.begin(), all.end(), 0U);
  rows.find(all, found);
  for (std::uint32_t slot = 0; slot < 9; ++slot) EXPECT_EQ(rows.slots()[found[slot]], slot);
  EXPECT_EQ(found[7], 7U);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, all);
}

}  // namespace
}  // namespace incise::packed_stars_test
