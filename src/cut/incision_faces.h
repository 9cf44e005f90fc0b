// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cut/incision_face.h"
#include "cut/rebuild_state.h"

namespace incise {
inline namespace v0 {

/// The faces along which a rebuild will separate material. `MasterLinks` finds them; crumbs and pinched faces are taken
/// out again; `FaceOpening` opens what is left.
class IncisionFaces {
 public:
  /// A vertex of a face that is left open since two pieces meet there, with a master that has it.
  struct ApartVertex {
    VertexId vertex;  ///< closed
    std::uint32_t master;
  };
  /// What is kept from run to run, for its storage; `faces` are those that the last run opened.
  struct Memory {
    std::vector<IncisionFace> faces;
    std::vector<Side> standing;  // of faces that were open before: their first sides; ascending
    std::vector<ApartVertex> apart;
    ZeroedArray<std::uint32_t> relinked;  // by master: the last run that has changed a link of its children
    std::uint32_t run = 0;
  };

  IncisionFaces(RebuildState& state, Memory& memory);

  [[nodiscard]] std::vector<IncisionFace>& all() { return memory_.faces; }
  [[nodiscard]] const std::vector<IncisionFace>& all() const { return memory_.faces; }

  /// Notes that a face was open before, by its first side. Counts once `sort_standing` was called.
  void note_standing(Side first) { memory_.standing.push_back(first); }
  void sort_standing();
  /// Whether a face was open before, between tets that stay: it is never joined again but where nothing separates it.
  /// Cost: O(log faces).
  [[nodiscard]] bool stands_open(const IncisionFace& face) const;

  /// Notes a face that the sheet does not pass, between two pieces: its vertices need copies, wherever they are.
  void note_apart(Side side);
  [[nodiscard]] std::vector<ApartVertex>& apart() { return memory_.apart; }

  /// Notes that a child of a master has another neighbour, or a wall, where it stayed.
  void note_relinked(std::uint32_t master);
  /// Whether the children of a master and all that is linked to them are as they were before this run.
  [[nodiscard]] bool is_as_before(std::uint32_t master) const;

  /// Leaves the material joined at a face.
  void close(const IncisionFace& face) { state_.transaction.join(face.a, face.b); }
  /// Marks the masters of a face of the cut that was left joined: once the blade has passed, they are looked at again.
  /// What is one piece around a crumb now may be two by then.
  void note_closed(const IncisionFace& face);
  /// Whether nothing separates the two sides of a face: they have their vertices in common.
  [[nodiscard]] bool is_latent(const IncisionFace& face) const;

 private:
  RebuildState& state_;
  Memory& memory_;
};

}  // namespace v0
}  // namespace incise
