// SPDX-License-Identifier: Apache-2.0
// Template, flags, ON vertices and front points make a key of 64 bits; a direct-mapped table keeps the answer of each
// key, and masters that ranks decide are worked out every time (docs/internals.md, 3.7).
#include "cut/incision_table.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "cut/division.h"
#include "cut/incision_lines.h"
#include "cut/parity.h"

namespace incise {
inline namespace v0 {

namespace {

/// Which side of the sheet a child of a complete master lies on: the colour of any corner that is not on the sheet.
unsigned colour_of_child(const SplitTemplate::Child& child, const Master& master) {
  for (const std::uint8_t code : child) {
    if (code < SplitTemplate::kFirstSplit && ((unsigned{master.on} >> code) & 1U) == 0) {
      return colour_of(master.flagged, code);
    }
  }
  return colour_of(master.flagged, child[0] < SplitTemplate::kFirstSplit ? child[0] : 0);
}

/// Whether a face of a cone stands on a line of the incision.
bool lies_on_line(const IncisionLines& lines, const SplitTemplate::Child& child, unsigned side, std::uint8_t apex) {
  std::array<std::uint8_t, 2> foot{};
  unsigned count = 0;
  for (const unsigned c : kSideCorners[side]) {
    if (child[c] != apex) foot[count++] = child[c];
  }
  return lines.contains(foot[0], foot[1]);
}

/// Whether a flagged edge has two ends that take part in the cut: which of them stands for its crossing is told by
/// their ranks, which no key holds.
bool depends_on_ranks(const Master& master) {
  bool depends = false;
  for (unsigned e = 0; e < 6; ++e) {
    const auto [a, b] = kEdgeCorners[e];
    depends |= ((master.flagged >> e) & (master.on >> a) & (master.on >> b) & 1U) != 0;
  }
  return depends;
}

/// All that decides the case of a master, but for ranks; never 0.
std::uint64_t key_of(const Master& master) {
  std::uint64_t key = 1U;
  key = key << 16U | master.split->number;
  key = key << 6U | master.flagged;
  key = key << 4U | master.on;
  for (const std::uint32_t point : master.points) key = key << 1U | (point != Master::kNone ? 1U : 0U);
  return key;
}

std::uint64_t passed_in_cone(const Master& master, const ClosedComplex& complex) {
  const IncisionLines lines(master, complex);
  std::uint64_t passed = 0, bit = 1;
  for (const auto& [a, b] : master.split->inner) {
    if (lies_on_line(lines, master.split->children[a / 4U], a & 3U, master.split->apex)) passed |= bit;
    bit <<= 1U;
  }
  return passed;
}

std::uint64_t passed_in_complete(const Master& master) {
  std::uint64_t passed = 0, bit = 1;
  for (const auto& [a, b] : master.split->inner) {
    const auto &first = master.split->children[a / 4U], &second = master.split->children[b / 4U];
    if (colour_of_child(first, master) != colour_of_child(second, master)) passed |= bit;
    bit <<= 1U;
  }
  return passed;
}

/// Whether all children hang together by the faces that are not passed.
bool are_one(const SplitTemplate& split, std::uint64_t passed) {
  std::array<std::uint8_t, SplitTemplate::kMostChildren> part;
  std::iota(part.begin(), part.end(), std::uint8_t{0});
  for (const auto& [a, b] : split.inner) {
    const std::uint8_t from = part[b / 4U], to = part[a / 4U];
    if ((passed & 1U) == 0) std::replace(part.begin(), part.end(), from, to);
    passed >>= 1U;
  }
  return std::all_of(part.begin(), part.begin() + split.children.size(), [&](std::uint8_t p) { return p == part[0]; });
}

PassedFaces work_out(const Master& master, const ClosedComplex& complex) {
  const bool is_cone = Divider::is_cone(master);
  const std::uint64_t passed = is_cone ? passed_in_cone(master, complex) : passed_in_complete(master);
  return {passed, is_cone && are_one(*master.split, passed)};
}

}  // namespace

const PassedFaces& IncisionTable::find(const Master& master, const ClosedComplex& complex) {
  if (depends_on_ranks(master)) return last_ = work_out(master, complex);
  const std::uint64_t key = key_of(master);
  Case& at = cases_[(key * 0x9E3779B97F4A7C15ULL) >> 53U];
  if (at.key != key) at = {key, work_out(master, complex)};
  return at.faces;
}

}  // namespace v0
}  // namespace incise
