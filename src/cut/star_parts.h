// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/material_pieces.h"
#include "cut/old_children.h"
#include "cut/stroke_tags.h"

namespace incise {
inline namespace v0 {

/// One live tet around a closed vertex.
struct StarTet {
  TetId tet;
  std::uint32_t corner;
  bool is_new = false;                ///< made in this rebuild
  std::uint32_t old = kInvalidIndex;  ///< the old child that holds its middle, where its master is rebuilt
  std::uint32_t part = 0;             ///< 1 + its part of the star; set by `divide`
  /// Around a split point: bit 0 where it has the edge's end a, bit 1 for b. Around a corner: bit 0 where it has a
  /// neighbour on its side of the sheet, bit 1 for one across.
  std::uint8_t ends = 0;
};

/// The copies of the vertices of a cut: one per face-connected part of the star, as long as it stays cut.
///
/// Paper §2.3 and §2.4 (dividable and singleton vertices), in their common terminal state; docs/internals.md has the
/// proof. Differs: works on a wound that is open, where copies that stay keep their slots and positions.
class StarParts {
 public:
  /// Divides the star `tets` of `vertex`, gives every part its own copy, and writes the copies into the corners of the
  /// tets.
  ///
  /// A part that has tets from before keeps their copy. `home(tets of a part)` names the copy that a part made of new
  /// tets alone should have, if any. Copies beyond those start as the old child of one of their tets has it; with
  /// `keeps_places` where that child had a copy of it, if it had one.
  /// Copies that no part needs any more die. A closed vertex that no part needs takes the place of one of its copies;
  /// with `keeps_places` no vertex goes over to material that stands elsewhere: with `may_be_named`, too, the closed
  /// vertex goes by the name of that copy from then on. Cost: O(star).
  /// With `makes_twins` copies start as `vertex` stands instead. The shape bits of each part are set from its surfaces;
  /// a star that stays whole beside walls of `tags` is at the front.
  using Home = std::function<VertexId(std::span<const StarTet>)>;  // of what is captured, two pointers cost no memory
  struct Settings {
    StrokeTags tags = {};
    bool makes_twins = false;
    bool keeps_places = false, may_be_named = false;
    const MaterialPieces* pieces = nullptr;  ///< where not null, no copy goes over from one to another
    /// Of a corner that takes part in the cut for the first time: its closed neighbours across the sheet. The parts
    /// that have them and no others never had the corner, unless an old child of theirs had it with one of these.
    std::span<const VertexId> across = {};
  };
  struct Division {
    std::uint64_t made = 0;  ///< copies
    VertexId closed;         ///< the closed vertex, as it is called now
  };
  Division divide(Transaction& transaction, ClosedComplex& complex, const OldChildren& old, VertexId vertex,
                  std::vector<StarTet>& tets, const Home& home, const Settings& settings);

 private:
  struct Part {
    std::uint32_t first = 0, last = 0;  ///< into the star, sorted by part
    VertexId copy;
  };
  /// What `divide` is asked about.
  struct Star {
    const TetMesh& mesh;
    const ClosedComplex& complex;
    const OldChildren& old;
    VertexId vertex;
    std::span<const StarTet> tets;  ///< sorted by part
    const Settings& settings;

    [[nodiscard]] std::span<const StarTet> tets_of(const Part& part) const {
      return tets.subspan(part.first, part.last - part.first);
    }
  };
  void find_parts(const TetMesh& mesh, std::vector<StarTet>& star);
  void keep_copies(const TetMesh& mesh, std::span<const StarTet> star);
  [[nodiscard]] bool is_taken(VertexId copy) const;
  [[nodiscard]] static MaterialPlace place_of(const Star& star, std::span<const StarTet> part);
  static VertexId make_copy(Transaction& transaction, const Star& star, std::span<const StarTet> part);
  [[nodiscard]] static bool is_across(const Star& star, std::span<const StarTet> part);
  [[nodiscard]] static bool had_across(const Star& star, std::uint32_t old);
  [[nodiscard]] static bool has_other_copy(const TetMesh& mesh, std::span<const StarTet> part, VertexId copy);
  [[nodiscard]] static VertexId copy_before(const TetMesh& mesh, const ClosedComplex& complex, const OldChildren& old,
                                            VertexId vertex, std::span<const StarTet> part);
  [[nodiscard]] static bool were_apart(const Star& star, const Part& part, VertexId copy);
  [[nodiscard]] static bool may_take(const Star& star, const Part& part, VertexId copy);
  [[nodiscard]] static bool stands_in(const Star& star, const Part& part);
  void take_homes(const Star& star, const Home& home);
  void take_vertex(const Star& star);
  static void move_vertex(Transaction& transaction, const Star& star, Part& part);
  [[nodiscard]] static VertexId source_of(const Star& star, const Part& part);
  std::uint64_t make_copies(Transaction& transaction, const Star& star);
  VertexId name(Transaction& transaction, VertexId vertex, bool may_be_named);
  void write_corners(Transaction& transaction, std::span<const StarTet> star);
  void set_shapes(Transaction& transaction, VertexId vertex, std::span<const StarTet> star, const StrokeTags& tags);
  void bury(Transaction& transaction, ClosedComplex& complex, VertexId vertex, VertexId closed);

  std::vector<Part> parts_;
  std::vector<std::uint32_t> queue_;
  std::vector<StarTet> sorted_;
  ZeroedArray<std::uint32_t> index_of_tet_;  // 1 + index into the star; all zero between calls
};

}  // namespace v0
}  // namespace incise
