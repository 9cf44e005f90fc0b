// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cut/material_pieces.h"
#include "cut/old_children.h"
#include "cut/rebuild_state.h"

namespace incise {
inline namespace v0 {

/// First stage of a rebuild: keeps what the dirty masters are made of, before anything changes. Later stages ask it
/// where the material of a new child or vertex was.
///
/// Reads the mesh and the dirty masters. Changes only marks of these masters: they get their `entry`, and what earlier
/// rebuilds noted about their faces is forgotten. **Source:** docs/internals.md (rebuild), docs/decisions/0023.
class OldMaterial {
 public:
  /// What one master was made of.
  struct Range {
    std::uint32_t first, last;    ///< into `children()`
    std::array<Link, 4> outside;  ///< behind its sides, where there is no master
  };
  /// What is kept from run to run, for its storage.
  struct Memory {
    OldChildren children;
    std::vector<Range> ranges;
    MaterialPieces pieces;
    std::vector<TetId> seeds;
    ZeroedArray<std::uint32_t> old_of;  // by tet slot: the old child that holds the middle of a child
  };

  OldMaterial(RebuildState& state, Memory& memory);

  /// Keeps all dirty masters; in a body that moves it finds, too, of which pieces they and the tets beside them are.
  /// Cost: O(dirty masters), and that of `PieceFinder` in a body that moves.
  void keep_all();
  /// Keeps one more master, the last that became dirty. Cost: O(its children).
  void keep(std::uint32_t index);
  /// Forgets the pieces, by the end of a run. Cost: O(labels).
  void forget_pieces() { memory_.pieces.forget(); }

  [[nodiscard]] const OldChildren& children() const { return memory_.children; }
  /// What a dirty master was made of.
  [[nodiscard]] const Range& range(const Master& master) const { return memory_.ranges[master.entry]; }
  /// Of which piece tets are, and were.
  [[nodiscard]] MaterialPieces& pieces() { return memory_.pieces; }

  /// Notes that a child of a dirty master has its material from an old child.
  void hand_down(std::uint32_t old, TetId tet);
  /// The old child that a child of a dirty master has its material from.
  [[nodiscard]] std::uint32_t old_of(TetId tet) const { return memory_.old_of[tet.value]; }

 private:
  void find_pieces();
  void note_beside(const Master& master, unsigned side);

  RebuildState& state_;
  Memory& memory_;
};

}  // namespace v0
}  // namespace incise
