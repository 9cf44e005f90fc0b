// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "incise/core/grow_array.h"
#include "incise/geom/box.h"
#include "incise/geom/intersect.h"
#include "incise/mesh/journal_cursor.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

/// Finds boundary sides near a place in the rest shape: a grid of cells, about as large as a few elements.
///
/// Built once for a mesh, then kept up with the journal by adding the new boundary sides; sides that are no longer
/// there are passed over when met. Only the first touch of a blade needs it: what the blade is already in is found by
/// walking. Memory: about 8 bytes per cell and per entry; at most 4 million cells.
class SurfaceIndex {
 public:
  /// Follows the mesh: builds the grid at first, and after changes that the journal does not tell. Cost: O(tets) to
  /// build, about 3 ns each; then O(edits).
  void follow(const TetMesh& mesh, const Journal& journal);
  /// Has the next `follow` build the grid anew.
  void forget() { is_built_ = false; }
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  /// Whether walls of cuts were ever seen.
  [[nodiscard]] bool has_walls() const { return has_walls_; }
  /// Whether a box meets the body's box.
  [[nodiscard]] bool is_near(const Box& box) const { return !heads_.empty() && bounds_.overlaps(box); }
  /// Whether a box takes up a few cells only, or lies outside all of them.
  [[nodiscard]] bool is_small(const Box& box) const;
  /// The tet of the boundary side that lies nearest to a place as the body stands; none where there is no surface.
  /// Cost: O(surface).
  [[nodiscard]] TetId nearest_as_it_stands(const TetMesh& mesh, const Vec3& place) const;
  /// Whether triangles meet the surface as the body stands. Exact. Cost: O(surface · triangles), 3 ns each for sides
  /// outside the box of all triangles.
  [[nodiscard]] bool meets_as_it_stands(const TetMesh& mesh, std::span<const std::array<SosPoint, 3>> triangles) const;
  /// Calls `visit(Side)` for each boundary side in the cells that meet a box; a side may come several times.
  template <class Visit>
  void for_each_near(const TetMesh& mesh, const Box& box, Visit&& visit) const;

 private:
  using Cell = std::array<int, 3>;
  void build(const TetMesh& mesh);
  void add_changed(const TetMesh& mesh, const Step& step);
  void add(const TetMesh& mesh, TetId tet);
  void note_wall(Link link) { has_walls_ = has_walls_ || link.tag() != 0; }
  [[nodiscard]] bool has(std::uint32_t head, Side side) const;
  void insert(std::uint32_t& head, Side side);
  /// Calls `visit(head)` for the list of each cell that meets a box.
  template <class Visit>
  void for_each_cell(const Box& box, Visit&& visit) const;
  [[nodiscard]] Cell cell_of(const Vec3& point) const;
  [[nodiscard]] std::size_t index_of(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(counts_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(counts_[0]) +
           static_cast<std::size_t>(x);
  }

  struct Entry {
    Side side;
    std::uint32_t next;  // 1 + index
  };
  Box bounds_;
  double inverse_size_ = 1.0;
  Cell counts_{};
  /// Takes an entry whose side is no longer there out of a list: where it comes back, the journal tells.
  void drop(std::uint32_t& link) const {
    Entry& entry = entries_[link - 1];
    const std::uint32_t next = entry.next;
    entry.next = free_;
    free_ = link;
    link = next;
  }

  // A search tidies up what it passes over, which changes no answer.
  mutable std::vector<std::uint32_t> heads_;  // by cell: 1 + index of the latest entry
  mutable GrowArray<Entry> entries_;
  mutable std::uint32_t free_ = 0;  // entries to be used again: 1 + index of the first
  StarWalker walker_;
  JournalCursor cursor_;
  std::size_t built_entries_ = 0;
  bool has_walls_ = false;
  bool is_built_ = false;
};

template <class Visit>
void SurfaceIndex::for_each_cell(const Box& box, Visit&& visit) const {
  const Cell lo = cell_of(box.lo), hi = cell_of(box.hi);
  for (int z = lo[2]; z <= hi[2]; ++z) {
    for (int y = lo[1]; y <= hi[1]; ++y) {
      for (int x = lo[0]; x <= hi[0]; ++x) visit(heads_[index_of(x, y, z)]);
    }
  }
}

template <class Visit>
void SurfaceIndex::for_each_near(const TetMesh& mesh, const Box& box, Visit&& visit) const {
  if (heads_.empty()) return;
  for_each_cell(box, [&](std::uint32_t& head) {
    std::uint32_t* at = &head;
    while (*at != 0) {
      Entry& entry = entries_[*at - 1];
      if (mesh.is_live(entry.side.tet()) && mesh.link(entry.side).is_boundary()) {
        visit(entry.side);
        at = &entry.next;
      } else {
        drop(*at);
      }
    }
  });
}

/// Calls `visit(Side)` for the boundary sides in the cells along a triangle, piece by piece, so that a long oblique one
/// does not ask for its whole box; a side may come several times.
template <class Visit>
void for_each_side_near(const TetMesh& mesh, const SurfaceIndex& index, const std::array<Vec3, 3>& p, Visit&& visit,
                        unsigned depth = 0) {
  constexpr unsigned kMaxHalvings = 100;  // from a million bodies down to a cell takes 60
  const Box box{p[0].cwiseMin(p[1]).cwiseMin(p[2]), p[0].cwiseMax(p[1]).cwiseMax(p[2])};
  if (!index.is_near(box)) return;
  if (depth == kMaxHalvings || index.is_small(box)) {
    index.for_each_near(mesh, box, visit);
    return;
  }
  unsigned longest = 0;
  for (unsigned k = 1; k < 3; ++k) {
    if ((p[(k + 1) % 3] - p[k]).squaredNorm() > (p[(longest + 1) % 3] - p[longest]).squaredNorm()) longest = k;
  }
  const Vec3 a = p[longest], b = p[(longest + 1) % 3], c = p[(longest + 2) % 3], middle = 0.5 * (a + b);
  for_each_side_near(mesh, index, {a, middle, c}, visit, depth + 1);
  for_each_side_near(mesh, index, {middle, b, c}, visit, depth + 1);
}

}  // namespace v0
}  // namespace incise
