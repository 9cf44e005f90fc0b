// SPDX-License-Identifier: Apache-2.0
#include "sim/body/stars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "support/random.h"

namespace incise::stars_test {
namespace {

using detail::kLanes;
using detail::Star;
using detail::StarBlock;
using test::Random;

/// One tet as a corner sees it.
using View = std::array<float, 9>;

/// Adds and removes tets as it is told, and knows by plain lists what must come out.
class Program {
 public:
  static constexpr std::uint32_t kVertices = 40, kTets = 300;

  explicit Program(std::uint64_t seed) : random_(seed) { stars_.ensure(kVertices, kTets); }

  void lay_out() {
    for (std::uint32_t v = 0; v < kVertices; v += 2) {
      stars_.lay_out(VertexId(v), static_cast<std::uint32_t>(random_.integer(0, 20)));
    }
  }
  void toggle_any() {
    const TetId tet(static_cast<std::uint32_t>(random_.integer(0, kTets - 1)));
    const auto found = tets_.find(tet.value);
    if (found == tets_.end()) {
      add(tet);
    } else {
      stars_.remove(tet, found->second.first);
      tets_.erase(found);
    }
  }
  void close() {
    for (std::uint32_t v = 0; v < kVertices; ++v) stars_.close(VertexId(v));
  }
  void remove_all() {
    for (const auto& [slot, tet] : tets_) stars_.remove(TetId(slot), tet.first);
    tets_.clear();
    close();
  }

  void check() const {
    for (std::uint32_t v = 0; v < kVertices; ++v) {
      const VertexId vertex(v);
      ASSERT_EQ(views(vertex), expected_views(vertex)) << v;
      ASSERT_EQ(owners(vertex), expected_owners(vertex)) << v;
      check_padding(vertex);
      double diagonal = 0;
      for (const View& view : expected_views(vertex)) {
        for (unsigned i = 6; i < 9; ++i) diagonal -= static_cast<double>(view[i]);
      }
      ASSERT_NEAR(stars_.diagonal(vertex), diagonal, 1e-9);
    }
  }

 private:
  void add(TetId tet) {
    TetVertices vertices;
    for (unsigned c = 0; c < 4; ++c) {
      do {  // low numbers meet more often: their stars fill several blocks
        const auto limit = random_.integer(4, kVertices);
        vertices[c] = VertexId(static_cast<std::uint32_t>(random_.integer(0, limit - 1)));
      } while (std::find(vertices.begin(), vertices.begin() + c, vertices[c]) != vertices.begin() + c);
    }
    detail::Element element;
    for (double& entry : element.laplacian) entry = random_.real(-1, 1);
    element.bulk = random_.real(0, 1);
    element.pressure = random_.real(0, 1);
    element.give = static_cast<double>(random_.integer(0, 1));
    stars_.add(tet, vertices, element);
    tets_[tet.value] = {vertices, element};
  }

  [[nodiscard]] std::multiset<View> views(VertexId vertex) const {
    std::multiset<View> result;
    const Star& star = stars_.of(vertex);
    for (std::uint32_t lane = 0; lane < star.lanes; ++lane) {
      const StarBlock& b = stars_.blocks()[star.first + lane / kLanes];
      const std::uint32_t i = lane % kLanes;
      result.insert({static_cast<float>(b.a[i]), static_cast<float>(b.b[i]), static_cast<float>(b.c[i]), b.bulk[i],
                     b.pressure[i], 0, b.to_a[i], b.to_b[i], b.to_c[i]});
    }
    return result;
  }
  template <class Visit>
  void for_each_corner(VertexId vertex, const Visit& visit) const {
    for (const auto& [slot, tet] : tets_) {
      for (unsigned c = 0; c < 4; ++c) {
        if (tet.first[c] == vertex) visit(slot, tet.first, tet.second, c);
      }
    }
  }
  [[nodiscard]] std::multiset<View> expected_views(VertexId vertex) const {
    std::multiset<View> result;
    for_each_corner(vertex, [&](std::uint32_t, const TetVertices& v, const detail::Element& e, unsigned c) {
      const auto& [a, b, d] = kSideCorners[c];
      const auto to = [&](unsigned j) { return static_cast<float>(e.laplacian[kEdgeOfCorners[c][j]]); };
      result.insert({static_cast<float>(v[a].value), static_cast<float>(v[b].value), static_cast<float>(v[d].value),
                     static_cast<float>(e.bulk), static_cast<float>(e.give > 0 ? e.pressure : -e.pressure), 0, to(a),
                     to(b), to(d)});
    });
    return result;
  }
  [[nodiscard]] std::multiset<std::uint32_t> owners(VertexId vertex) const {
    std::multiset<std::uint32_t> result;
    stars_.for_each_tet(vertex, [&](TetId tet) { result.insert(tet.value); });
    return result;
  }
  [[nodiscard]] std::multiset<std::uint32_t> expected_owners(VertexId vertex) const {
    std::multiset<std::uint32_t> result;
    for_each_corner(
        vertex, [&](std::uint32_t slot, const TetVertices&, const detail::Element&, unsigned) { result.insert(slot); });
    return result;
  }
  /// Unused lanes name the vertex itself, so that a sweep reads no strangers, and weigh nothing.
  void check_padding(VertexId vertex) const {
    const Star& star = stars_.of(vertex);
    ASSERT_LE(star.lanes, star.blocks * kLanes);
    for (std::uint32_t lane = star.lanes; lane < star.blocks * kLanes; ++lane) {
      const StarBlock& b = stars_.blocks()[star.first + lane / kLanes];
      const std::uint32_t i = lane % kLanes;
      for (const auto* corner : {&b.a, &b.b, &b.c}) ASSERT_EQ((*corner)[i], vertex.value);
      for (const auto* weight : {&b.bulk, &b.pressure, &b.to_a, &b.to_b, &b.to_c}) ASSERT_EQ((*weight)[i], 0.0F);
    }
  }

  Random random_;
  detail::Stars stars_;
  std::map<std::uint32_t, std::pair<TetVertices, detail::Element>> tets_;
};

TEST(Stars, KeepInStepWithAListWhileTetsComeAndGo) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    Program program(seed);
    if (seed % 2 == 0) program.lay_out();
    program.check();
    for (unsigned i = 0; i < 3000 && !testing::Test::HasFatalFailure(); ++i) {
      program.toggle_any();
      if (i % (seed < 3 ? 1 : 7) == 0) program.close();  // holes are filled by what comes next, or closed
      if (i % 70 == 0) program.check();
      if (i == 1500) program.remove_all();
    }
    program.close();
    program.check();
  }
}

TEST(Stars, UseThePlacesOfOutgrownStarsAgain) {
  detail::Stars stars;
  stars.ensure(2000, 4000);
  const auto reach = [&] {
    std::uint32_t end = 0;
    for (std::uint32_t v = 0; v < 2000; ++v) {
      const Star& star = stars.of(VertexId(v));
      end = std::max(end, star.first + star.blocks);
    }
    return end;
  };
  const auto fill = [&](std::uint32_t first) {  // nine tets around each vertex: the second block takes over
    for (std::uint32_t t = 0; t < 9; ++t) {
      const TetVertices v = {VertexId(first), VertexId(first + 1), VertexId(first + 2), VertexId(first + 3)};
      stars.add(TetId(first / 4 * 9 + t), v, {});
    }
  };
  fill(0);
  const std::uint32_t once = reach();
  for (std::uint32_t first = 4; first < 400; first += 4) fill(first);
  // Each four vertices take eight blocks, and first four of one that others left behind.
  EXPECT_LE(reach(), 100 * 8 + once);
}

}  // namespace
}  // namespace incise::stars_test
