// SPDX-License-Identifier: Apache-2.0
// Bisection and coning of a tet of codes, worked out once for each order of edges and kept in a hash table whose
// blocks never move (docs/internals.md, 3.6).
#include "cut/split_template.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

namespace {

using Child = SplitTemplate::Child;

constexpr std::uint8_t kFirstSplitCode = SplitTemplate::kFirstSplit;

void bisect(const Child& tet, std::span<const std::uint8_t> order, SplitTemplate& result) {
  for (const std::uint8_t edge : order) {
    const auto a = std::find(tet.begin(), tet.end(), kEdgeCorners[edge][0]);
    const auto b = std::find(tet.begin(), tet.end(), kEdgeCorners[edge][1]);
    if (a != tet.end() && b != tet.end()) {
      Child keeps_a = tet, keeps_b = tet;
      keeps_a[static_cast<std::size_t>(b - tet.begin())] = static_cast<std::uint8_t>(kFirstSplitCode + edge);
      keeps_b[static_cast<std::size_t>(a - tet.begin())] = static_cast<std::uint8_t>(kFirstSplitCode + edge);
      bisect(keeps_a, order, result);
      bisect(keeps_b, order, result);
      return;
    }
  }
  result.children.push_back(tet);
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
        result.on_side[parent_side].push_back(codes);
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
  for (const Child& child : result.children) {
    unsigned bits = 0;
    for (const std::uint8_t code : child) bits |= 1U << code;
    result.codes.push_back(static_cast<std::uint16_t>(bits));
  }
  std::uint8_t count = 0;
  for (std::uint8_t code = 0; code < SplitTemplate::kCodes; ++code) {
    result.first_around[code] = count;
    for (unsigned k = 0; k < 4 * result.children.size(); ++k) {
      if (result.children[k / 4U][k & 3U] == code) result.all_around[count++] = static_cast<std::uint8_t>(k);
    }
  }
  result.first_around[SplitTemplate::kCodes] = count;
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

SplitTemplate make_cone(std::span<const std::uint8_t> order, unsigned pierced, std::uint8_t apex) {
  SplitTemplate result;
  result.apex = apex;
  std::vector<Facet> facets;
  for (unsigned side = 0; side < 4; ++side) {
    if (apex == SplitTemplate::kFirstPoint + side) continue;
    if (((pierced >> side) & 1U) != 0) {
      fan_side(side, order, facets);
    } else {
      bisect_side(kSideCorners[side], order, facets);
    }
  }
  for (const Facet& f : facets) {  // a side turns as seen from outside: from inside, the other way round
    result.children.push_back({f[0], f[2], f[1], apex});
  }
  find_sides(result);
  index_vertices(result);
  return result;
}

SplitTemplate make(std::span<const std::uint8_t> order) {
  SplitTemplate result;
  bisect({0, 1, 2, 3}, order, result);
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

SplitTemplates::SplitTemplates() : slots_(2 * std::size_t{kBlock}) {
  blocks_.push_back(std::make_unique<SplitTemplate[]>(kBlock));
}

SplitTemplates::Slot& SplitTemplates::slot_of(std::uint32_t key) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = ((key * std::uint64_t{0x9E3779B97F4A7C15}) >> 32U) & mask;
  while (slots_[i].key != 0 && slots_[i].key != key) i = (i + 1) & mask;
  return slots_[i];
}

template <class Make>
const SplitTemplate& SplitTemplates::find_or_make(std::uint32_t key, Make&& make) {
  Slot* slot = &slot_of(key);
  if (slot->key == 0) {
    if (2 * (count_ + 1) > slots_.size()) {
      rehash();
      slot = &slot_of(key);
    }
    if (count_ == kBlock * blocks_.size()) blocks_.push_back(std::make_unique<SplitTemplate[]>(kBlock));
    SplitTemplate& made = blocks_.back()[count_ % kBlock];
    made = make();
    made.number = static_cast<std::uint16_t>(count_);
    *slot = {key, count_++};
  }
  return blocks_[slot->number / kBlock][slot->number % kBlock];
}

void SplitTemplates::rehash() {
  std::vector<Slot> old(2 * slots_.size());
  std::swap(old, slots_);
  for (const Slot& slot : old) {
    if (slot.key != 0) slot_of(slot.key) = slot;
  }
}

const SplitTemplate& SplitTemplates::find(std::span<const std::uint8_t> order) {
  return find_or_make(key_of(order), [&] { return make(order); });
}

const SplitTemplate& SplitTemplates::find_cone(std::span<const std::uint8_t> order, unsigned pierced,
                                               std::uint8_t apex) {
  const std::uint32_t key = (key_of(order) * 16 + pierced) * 8 + (apex - SplitTemplate::kFirstPoint);
  return find_or_make(key | 0x80000000U, [&] { return make_cone(order, pierced, apex); });
}

}  // namespace v0
}  // namespace incise
