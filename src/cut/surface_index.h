// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "cut/constants.h"
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
  /// Follows the mesh, to steps that are undone as well: builds the grid at first, and after changes that the journal
  /// does not tell any more. Cost: O(tets) to build, about 3 ns each; then O(edits).
  void follow(const TetMesh& mesh, const Journal& journal) { follow(mesh, journal, kNothing); }
  /// The same, but new walls for which `is_own(Side)` holds stay out of the grid for now: a sheet makes its own walls
  /// anew in each step, and does not ask for them. They wait for `take_in`. Cost: O(edits).
  template <class IsOwn>
  void follow(const TetMesh& mesh, const Journal& journal, IsOwn&& is_own);
  /// Puts the waiting walls into the grid for which `is_own` does not hold any more. Cost: O(waiting walls).
  template <class IsOwn>
  void take_in(const TetMesh& mesh, IsOwn&& is_own);
  /// Calls `visit(Side)` for the walls that wait. Cost: O(waiting walls).
  template <class Visit>
  void for_each_waiting(const TetMesh& mesh, Visit&& visit) const;
  /// Has the next `follow` build the grid anew.
  void forget() { is_built_ = false; }
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  /// Whether walls of cuts were seen since the grid was built, but for steps that are undone.
  [[nodiscard]] bool has_walls() const { return walls_since_ <= cursor_.position(); }
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
  /// A boundary side, and its point that lies nearest to a place at rest.
  struct Nearest {
    Side side;  ///< without a tet where there is none
    Vec3 point = Vec3::Zero();
  };
  /// The boundary side that lies nearest to a rest place, the lowest of several; none where all are further away than
  /// `most`. Does not depend on the cells. Cost: the sides in cells that reach nearer than that, and the cells around.
  [[nodiscard]] Nearest nearest(const TetMesh& mesh, const Vec3& place, double most) const;

 private:
  using Cell = std::array<std::uint16_t, 3>;  // from 1 on
  /// The cells from `lo` to `hi` along each axis; none where all is zero.
  struct CellRange {
    Cell lo{}, hi{};

    /// Whether they are the same: a defaulted comparison calls the library, which would take longer than all else.
    [[nodiscard]] bool is(const CellRange& other) const {
      bool is = true;
      for (unsigned k = 0; k < 3; ++k) is &= lo[k] == other.lo[k] && hi[k] == other.hi[k];
      return is;
    }
    [[nodiscard]] bool has(const Cell& cell) const {
      bool has = true;
      for (unsigned k = 0; k < 3; ++k) has = has && lo[k] <= cell[k] && cell[k] <= hi[k];
      return has;
    }
  };
  static constexpr auto kNothing = [](Side /*side*/) { return false; };
  [[nodiscard]] static bool is_boundary(const TetMesh& mesh, Side side) {
    return mesh.is_live(side.tet()) && mesh.link(side).is_boundary();
  }
  void build(const TetMesh& mesh);
  [[nodiscard]] bool must_build(const Journal& journal) const;
  void add_changed(const TetMesh& mesh, const Step& step);
  void go_back(const TetMesh& mesh, const Journal& journal);
  void add_restored(const TetMesh& mesh, const Step& step);
  void add_around(const TetMesh& mesh, std::span<const MovedVertex> moved);
  void add(const TetMesh& mesh, TetId tet);
  void list_new(const TetMesh& mesh, Side side);
  void note_wall(Link link) {
    if (link.tag() != 0) walls_since_ = std::min(walls_since_, looks_at_);
  }
  [[nodiscard]] static std::size_t slot_of(Side side) { return std::size_t{4} * side.tet().value + side.side(); }
  void list(Side side, const Box& box);
  /// Whether a side that was listed in a cell still lies there: its slot may be another tet's now.
  [[nodiscard]] bool is_in(Side side, const Cell& cell) const {
    const std::size_t slot = slot_of(side);
    return slot >= listed_.capacity() || listed_[slot].lo[0] == 0 || listed_[slot].has(cell);  // 0: not listed
  }
  void forget_cells(Side side) const {
    if (slot_of(side) < listed_.capacity()) listed_[slot_of(side)] = {};
  }
  void insert(std::uint32_t& head, Side side);
  /// Calls `visit(head, cell)` for the list of each cell of a range.
  template <class Visit>
  void for_each_cell(const CellRange& cells, Visit&& visit) const;
  /// Calls `visit(Side)` for each boundary side in a cell.
  template <class Visit>
  void for_each_in(const TetMesh& mesh, std::uint32_t& head, const Cell& cell, Visit&& visit) const;
  /// Calls `visit(cell)` for the cells that are `away` cells from one, along the axis where they are furthest from it.
  template <class Visit>
  void for_each_in_shell(const Cell& middle, std::uint16_t away, Visit&& visit) const;
  [[nodiscard]] Box room_of(const Cell& cell) const;
  [[nodiscard]] Cell cell_of(const Vec3& point) const;
  [[nodiscard]] CellRange cells_of(const Box& box) const { return {cell_of(box.lo), cell_of(box.hi)}; }
  [[nodiscard]] std::size_t index_of(const Cell& cell) const {
    return ((cell[2] - std::size_t{1}) * counts_[1] + (cell[1] - std::size_t{1})) * counts_[0] +
           (cell[0] - std::size_t{1});
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
  mutable ZeroedArray<CellRange> listed_;  // by side: cells that have it; none where one has dropped it
  mutable std::uint32_t free_ = 0;         // entries to be used again: 1 + index of the first
  StarWalker walker_;
  std::vector<Side> found_, waiting_;     // sides of the steps being followed; own walls
  ZeroedArray<std::uint8_t> waits_;       // by side
  ZeroedArray<std::uint32_t> looked_at_;  // by tet: the call of `follow` that has found its sides
  std::uint32_t call_ = 0;
  JournalCursor cursor_;
  static constexpr std::size_t kNever = ~std::size_t{0};
  std::size_t built_entries_ = 0, built_at_ = 0;  // the journal's position then
  std::size_t walls_since_ = kNever;              // the journal's position when there were walls first
  std::size_t looks_at_ = 0;                      // the position whose sides are being added
  bool is_built_ = false;
};

template <class IsOwn>
void SurfaceIndex::follow(const TetMesh& mesh, const Journal& journal, IsOwn&& is_own) {
  ++call_;
  if (must_build(journal)) {
    built_at_ = journal.position();
    build(mesh);
  } else if (journal.position() < cursor_.position()) {
    go_back(mesh, journal);
  } else {
    for (std::size_t i = cursor_.position(); i < journal.position(); ++i) {
      looks_at_ = i + 1;
      add_changed(mesh, journal.step(i));
    }
  }
  cursor_.move_to(journal);
  for (const Side side : found_) {
    if (mesh.link(side).tag() == 0 || !is_own(side)) {
      list_new(mesh, side);
      continue;
    }
    waits_.ensure(slot_of(side) + 1);
    if (std::exchange(waits_[slot_of(side)], std::uint8_t{1}) == 0) waiting_.push_back(side);
  }
  found_.clear();
}

template <class IsOwn>
void SurfaceIndex::take_in(const TetMesh& mesh, IsOwn&& is_own) {
  std::erase_if(waiting_, [&](Side side) {
    const bool is_there = is_boundary(mesh, side);
    if (is_there && mesh.link(side).tag() != 0 && is_own(side)) return false;
    if (is_there) list_new(mesh, side);
    waits_[slot_of(side)] = 0;
    return true;
  });
}

template <class Visit>
void SurfaceIndex::for_each_waiting(const TetMesh& mesh, Visit&& visit) const {
  for (const Side side : waiting_) {
    if (is_boundary(mesh, side)) visit(side);
  }
}

template <class Visit>
void SurfaceIndex::for_each_cell(const CellRange& cells, Visit&& visit) const {
  Cell at = cells.lo;
  for (at[2] = cells.lo[2]; at[2] <= cells.hi[2]; ++at[2]) {
    for (at[1] = cells.lo[1]; at[1] <= cells.hi[1]; ++at[1]) {
      for (at[0] = cells.lo[0]; at[0] <= cells.hi[0]; ++at[0]) visit(heads_[index_of(at)], at);
    }
  }
}

template <class Visit>
void SurfaceIndex::for_each_in(const TetMesh& mesh, std::uint32_t& head, const Cell& cell, Visit&& visit) const {
  std::uint32_t* at = &head;
  while (*at != 0) {
    Entry& entry = entries_[*at - 1];
    const bool is_there = is_boundary(mesh, entry.side);
    if (!is_there) forget_cells(entry.side);
    if (is_there && is_in(entry.side, cell)) {
      visit(entry.side);
      at = &entry.next;
    } else {
      drop(*at);
    }
  }
}

template <class Visit>
void SurfaceIndex::for_each_near(const TetMesh& mesh, const Box& box, Visit&& visit) const {
  if (heads_.empty()) return;
  for_each_cell(cells_of(box), [&](std::uint32_t& head, const Cell& cell) { for_each_in(mesh, head, cell, visit); });
}

template <class Visit>
void SurfaceIndex::for_each_in_shell(const Cell& middle, std::uint16_t away, Visit&& visit) const {
  CellRange range;
  for (unsigned k = 0; k < 3; ++k) {
    range.lo[k] = static_cast<std::uint16_t>(std::max(int{middle[k]} - int{away}, 1));
    range.hi[k] = static_cast<std::uint16_t>(std::min(int{middle[k]} + int{away}, int{counts_[k]}));
  }
  const auto is_at = [&](unsigned k, unsigned cell) {
    return std::max(cell, unsigned{middle[k]}) - std::min(cell, unsigned{middle[k]}) == away;
  };
  Cell at = range.lo;
  for (at[2] = range.lo[2]; at[2] <= range.hi[2]; ++at[2]) {
    for (at[1] = range.lo[1]; at[1] <= range.hi[1]; ++at[1]) {
      if (is_at(2, at[2]) || is_at(1, at[1])) {
        for (at[0] = range.lo[0]; at[0] <= range.hi[0]; ++at[0]) visit(at);
        continue;
      }
      for (const int x : {int{middle[0]} - int{away}, int{middle[0]} + int{away}}) {
        if (x < int{range.lo[0]} || x > int{range.hi[0]}) continue;
        at[0] = static_cast<std::uint16_t>(x);
        visit(at);
      }
    }
  }
}

/// Calls `visit(Side)` for the boundary sides in the cells along a triangle, piece by piece, so that a long oblique one
/// does not ask for its whole box; a side may come several times.
template <class Visit>
void for_each_side_near(const TetMesh& mesh, const SurfaceIndex& index, const std::array<Vec3, 3>& p, Visit&& visit,
                        unsigned depth = 0) {
  const Box box{p[0].cwiseMin(p[1]).cwiseMin(p[2]), p[0].cwiseMax(p[1]).cwiseMax(p[2])};
  if (!index.is_near(box)) return;
  if (depth == kMostCellHalvings || index.is_small(box)) {
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
