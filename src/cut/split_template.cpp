// SPDX-License-Identifier: Apache-2.0
#include "cut/split_template.h"

#include <algorithm>

namespace incise::inline v0 {

namespace {

using Child = SplitTemplate::Child;

constexpr std::uint8_t kFirstSplitCode = 4;

void bisect(const Child& tet, std::span<const std::uint8_t> order, std::vector<Child>& children) {
  for (const std::uint8_t edge : order) {
    const auto a = std::find(tet.begin(), tet.end(), kEdgeCorners[edge][0]);
    const auto b = std::find(tet.begin(), tet.end(), kEdgeCorners[edge][1]);
    if (a != tet.end() && b != tet.end()) {
      Child keeps_a = tet, keeps_b = tet;
      keeps_a[static_cast<std::size_t>(b - tet.begin())] = static_cast<std::uint8_t>(kFirstSplitCode + edge);
      keeps_b[static_cast<std::size_t>(a - tet.begin())] = static_cast<std::uint8_t>(kFirstSplitCode + edge);
      bisect(keeps_a, order, children);
      bisect(keeps_b, order, children);
      return;
    }
  }
  children.push_back(tet);
}

/// The codes that lie on a side of the parent, as bits.
constexpr std::uint16_t codes_on_side(unsigned side) {
  std::uint16_t bits = 0;
  for (const unsigned corner : kSideCorners[side]) bits = static_cast<std::uint16_t>(bits | 1U << corner);
  for (const unsigned edge : kSideEdges[side]) bits = static_cast<std::uint16_t>(bits | 1U << (kFirstSplitCode + edge));
  return bits;
}

std::uint16_t codes_of(const Child& child, unsigned side) {
  std::uint16_t bits = 0;
  for (const unsigned corner : kSideCorners[side]) bits = static_cast<std::uint16_t>(bits | 1U << child[corner]);
  return bits;
}

/// The side of the parent that holds a face with these codes, or 4 inside.
unsigned side_of_parent(std::uint16_t codes) {
  unsigned side = 0;
  while (side < 4 && (codes & ~codes_on_side(side)) != 0) {
    ++side;
  }
  return side;
}

void find_sides(SplitTemplate& result) {
  struct Open {
    std::uint16_t codes;
    std::uint8_t side;
  };
  std::vector<Open> open;
  for (unsigned c = 0; c < result.children.size(); ++c) {
    for (unsigned s = 0; s < 4; ++s) {
      const std::uint16_t codes = codes_of(result.children[c], s);
      const auto here = static_cast<std::uint8_t>(c * 4 + s);
      if (const unsigned parent_side = side_of_parent(codes); parent_side < 4) {
        result.outer[parent_side].push_back(here);
        continue;
      }
      const auto twin = std::find_if(open.begin(), open.end(), [&](const Open& o) { return o.codes == codes; });
      if (twin == open.end()) {
        open.push_back({codes, here});
      } else {
        result.inner.push_back({twin->side, here});
        open.erase(twin);
      }
    }
  }
}

SplitTemplate make(std::span<const std::uint8_t> order) {
  SplitTemplate result;
  bisect({0, 1, 2, 3}, order, result.children);
  find_sides(result);
  return result;
}

}  // namespace

const SplitTemplate& SplitTemplates::find(std::span<const std::uint8_t> order) {
  std::uint32_t key = 1;
  for (const std::uint8_t edge : order) {
    key = key * 8 + edge;
  }
  const auto found = templates_.find(key);
  return found != templates_.end() ? found->second : templates_.emplace(key, make(order)).first->second;
}

}  // namespace incise::inline v0
