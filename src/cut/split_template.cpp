// SPDX-License-Identifier: Apache-2.0
#include "cut/split_template.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

namespace {

using Child = SplitTemplate::Child;

constexpr std::uint8_t kFirstSplitCode = SplitTemplate::kFirstSplit;

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
  return static_cast<std::uint16_t>(bits | 1U << (SplitTemplate::kFirstPoint + side));
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

void index_vertices(SplitTemplate& result) {
  for (unsigned k = 0; k < result.children.size(); ++k) {
    unsigned bits = 0;
    for (unsigned c = 0; c < 4; ++c) {
      const std::uint8_t code = result.children[k][c];
      result.around[code].push_back(static_cast<std::uint8_t>(k * 4 + c));
      bits |= 1U << code;
    }
    result.codes.push_back(static_cast<std::uint16_t>(bits));
  }
}

using Facet = std::array<std::uint8_t, 3>;

/// Bisects a side; the facets turn as the side does.
void bisect_side(const Facet& facet, std::span<const std::uint8_t> order, std::vector<Facet>& facets) {
  for (const std::uint8_t edge : order) {
    const auto a = std::find(facet.begin(), facet.end(), kEdgeCorners[edge][0]);
    const auto b = std::find(facet.begin(), facet.end(), kEdgeCorners[edge][1]);
    if (a != facet.end() && b != facet.end()) {
      Facet keeps_a = facet, keeps_b = facet;
      keeps_a[static_cast<std::size_t>(b - facet.begin())] = static_cast<std::uint8_t>(kFirstSplitCode + edge);
      keeps_b[static_cast<std::size_t>(a - facet.begin())] = static_cast<std::uint8_t>(kFirstSplitCode + edge);
      bisect_side(keeps_a, order, facets);
      bisect_side(keeps_b, order, facets);
      return;
    }
  }
  facets.push_back(facet);
}

/// Joins the front point in a side to all that lies on the side's border.
void fan_side(unsigned side, std::span<const std::uint8_t> order, std::vector<Facet>& facets) {
  const auto point = static_cast<std::uint8_t>(SplitTemplate::kFirstPoint + side);
  for (unsigned k = 0; k < 3; ++k) {
    const std::uint8_t a = kSideCorners[side][k], b = kSideCorners[side][(k + 1) % 3];
    const std::uint8_t edge = kEdgeOfCorners[a][b];
    if (std::find(order.begin(), order.end(), edge) == order.end()) {
      facets.push_back({a, b, point});
      continue;
    }
    const auto split = static_cast<std::uint8_t>(kFirstSplitCode + edge);
    facets.push_back({a, split, point});
    facets.push_back({split, b, point});
  }
}

SplitTemplate make_cone(std::span<const std::uint8_t> order, unsigned pierced) {
  SplitTemplate result;
  std::vector<Facet> facets;
  for (unsigned side = 0; side < 4; ++side) {
    if (((pierced >> side) & 1U) != 0) {
      fan_side(side, order, facets);
    } else {
      bisect_side(kSideCorners[side], order, facets);
    }
  }
  for (const Facet& f : facets) {  // a side turns as seen from outside: from inside, the other way round
    result.children.push_back({f[0], f[2], f[1], SplitTemplate::kMiddle});
  }
  find_sides(result);
  index_vertices(result);
  return result;
}

SplitTemplate make(std::span<const std::uint8_t> order) {
  SplitTemplate result;
  bisect({0, 1, 2, 3}, order, result.children);
  find_sides(result);
  index_vertices(result);
  return result;
}

}  // namespace

namespace {

std::uint32_t key_of(std::span<const std::uint8_t> order) {
  std::uint32_t key = 1;
  for (const std::uint8_t edge : order) {
    key = key * 8 + edge;
  }
  return key;
}

}  // namespace

const SplitTemplate& SplitTemplates::find(std::span<const std::uint8_t> order) {
  const std::uint32_t key = key_of(order);
  const auto found = templates_.find(key);
  return found != templates_.end() ? found->second : templates_.emplace(key, make(order)).first->second;
}

const SplitTemplate& SplitTemplates::find_cone(std::span<const std::uint8_t> order, unsigned pierced) {
  const std::uint32_t key = (key_of(order) * 16 + pierced) | 0x80000000U;
  const auto found = templates_.find(key);
  return found != templates_.end() ? found->second : templates_.emplace(key, make_cone(order, pierced)).first->second;
}

}  // namespace v0
}  // namespace incise
