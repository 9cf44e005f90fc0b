// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "improve/constants.h"
#include "improve/original_sizes.h"
#include "improve/piece.h"
#include "incise/core/grow_array.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

/// The skin of a mesh as it was when its journal began, as far as the places go that have changed since.
///
/// A tet that nothing has touched shows the skin as it was; so it is enough to note the sides of skin of each tet when
/// it changes first: `follow` reads them from the journal's images, `note` before maintenance changes them. What has
/// been noted stays true, undo or not. Memory and time: O(tets that change), whatever the size of the mesh.
class OriginalSkin {
 public:
  /// Notes what the journal's steps since the last call changed. Cost: O(their edits).
  void follow(const TetMesh& mesh, const Journal& journal);
  /// What the journal's steps since the last call changed was noted before. Cost: O(vertices that they made).
  void skip(const Journal& journal);
  /// After an undo: steps from `position` on will be others.
  void rewind(std::size_t position);
  /// Notes tets that are about to change, before they do. Cost: O(tets).
  void note(const TetMesh& mesh, std::span<const TetId> tets);

  /// How long edges were where the vertices come from.
  [[nodiscard]] const OriginalSizes& sizes() const { return sizes_; }
  [[nodiscard]] bool is_empty() const { return facets_.empty(); }
  /// The squared distance to the skin as it was, as far as it is noted; infinite beyond `greatest`. Cost: some ten
  /// triangles.
  [[nodiscard]] double distance2(const Vec3& place, double greatest) const {
    return closest(place, greatest).distance2;
  }
  /// Whether a piece of skin may give way to another: the new one lies within `share` of the local edge from where the
  /// skin was, or at least no further off than the old piece did; and so do the vertices that the skin had there from
  /// the new piece. The local edge: of the new piece or of the skin as it was, whichever is shorter; of the skin as it
  /// was for `kBadSkinTolerance`.
  [[nodiscard]] bool keeps(const Piece& before, const Piece& after, double share = kSkinTolerance) const;
  /// The same for a vertex that moves, at a piece of skin with this mean edge.
  [[nodiscard]] bool keeps_vertex(const Vec3& old_place, const Vec3& place, double edge,
                                  double share = kSkinTolerance) const;

 private:
  /// A facet is listed in the few cells of about its size that it meets, and as one of the finer things in those of
  /// coarser levels: whoever looks into a box needs no cells that are smaller than the box.
  struct Cell {
    int level = 0;  ///< cells are 2^level wide
    std::array<std::int64_t, 3> at{};
    friend bool operator==(const Cell& a, const Cell& b) { return a.level == b.level && a.at == b.at; }
  };
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  struct Listed {
    std::vector<std::uint32_t> facets, points;
  };
  struct Content {
    Listed own, finer;
  };

  void begin(const TetMesh& mesh, const Journal& journal);
  [[nodiscard]] bool is_fresh(TetId tet) const;
  template <class PlaceOf>
  void note_tet(TetId tet, const TetVertices& vertices, const TetLinks& links, PlaceOf&& place_of);
  void add_facet(const Facet& facet, int level);
  void add_point(VertexId vertex, const Vec3& place, int level);
  /// Calls `list(listed)` where something of a level in a box must stand.
  template <class List>
  void for_each_place(const Box& box, int level, List&& list);
  /// Calls `visit(listed)` with what a box may meet.
  template <class Visit>
  void for_each_cell(const Box& box, Visit&& visit) const;
  /// The nearest noted facet within a distance.
  struct Closest {
    double distance2 = std::numeric_limits<double>::infinity();
    std::uint32_t facet = 0;
  };
  [[nodiscard]] Closest closest(const Vec3& place, double greatest) const;
  [[nodiscard]] double tolerance_at(const Vec3& place, double edge, double share) const;
  [[nodiscard]] bool is_near(const Piece& after, const Piece& before, double tolerance) const;
  [[nodiscard]] bool is_covered(const Vec3& point, const Piece& before, const Piece& after, double tolerance) const;

  OriginalSizes sizes_;
  std::vector<Facet> facets_;
  std::vector<Vec3> points_;
  std::unordered_map<Cell, Content, CellHash> cells_;  // looked up, never iterated
  std::vector<int> levels_;                            // in use
  ZeroedArray<std::uint8_t> is_noted_;                 // by tet slot
  ZeroedArray<std::uint8_t> is_point_;                 // by vertex slot
  std::uint32_t tet_slots_ = 0;                        // when the journal began
  std::size_t position_ = 0;                           // of the journal
  bool has_begun_ = false;
  StarWalker walker_;
};

}  // namespace v0
}  // namespace incise
