// SPDX-License-Identifier: Apache-2.0
// What the judges of an attack know of a mesh's topology: found by sorting, so that nothing of the library is in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "incise/mesh/tet_soup.h"

namespace incise::test {

/// One face of one tet, its corners ascending.
struct TetFace {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t tet;
};

/// All faces of all tets, ascending: those of the same three corners stand beside each other.
[[nodiscard]] std::vector<TetFace> sorted_faces(const std::vector<std::array<std::uint32_t, 4>>& tets);

/// Calls `visit(first, end)` for every run of items that are `alike`.
template <class Item, class Alike, class Visit>
void for_each_run(const std::vector<Item>& items, const Alike& alike, const Visit& visit) {
  for (std::size_t first = 0, end = 0; first < items.size(); first = end) {
    end = first + 1;
    while (end < items.size() && alike(items[first], items[end])) ++end;
    visit(first, end);
  }
}

/// Calls `visit(first, end)` for every face: its tets are `faces[first]` to `faces[end - 1]`.
template <class Visit>
void for_each_face(const std::vector<TetFace>& faces, const Visit& visit) {
  for_each_run(
      faces, [](const TetFace& a, const TetFace& b) { return a.corners == b.corners; }, visit);
}

/// Things that are joined two by two.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  void join(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }
  /// One member of the group, the same for all.
  std::size_t of(std::size_t item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace incise::test
