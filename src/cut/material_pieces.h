// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cut/piece_finder.h"

namespace incise {
inline namespace v0 {

/// Of which piece of a body the material of tets and vertices is while a rebuild changes them: what has come apart
/// stays apart, and goes by its own names. **Source:** docs/decisions/0023.
class MaterialPieces {
 public:
  /// Labels tets that hang together through faces, and their vertices. Cost: that of `PieceFinder`.
  void find(const TetMesh& mesh, std::span<const TetId> tets);
  /// Whether `find` found more than one.
  [[nodiscard]] bool has_several() const { return has_several_; }
  /// Forgets all labels. Cost: O(labels).
  void forget();

  /// Labels a tet as another, of whose material it is.
  void follow(TetId tet, TetId other);
  /// Whether two tets are of two pieces; false where one has no label.
  [[nodiscard]] bool are_apart(TetId a, TetId b) const { return differ(of_tet_[a.value], of_tet_[b.value]); }
  /// Whether a vertex was of another piece than a tet is of; false for vertices and tets without a label.
  [[nodiscard]] bool are_apart(TetId tet, VertexId vertex) const {
    return differ(of_tet_[tet.value], of_vertex_[vertex.value]);
  }
  [[nodiscard]] bool knows(TetId tet) const { return of_tet_[tet.value] != 0; }

  /// Whether two live tets hang together as the mesh stands, whatever their labels. Cost: as `find`.
  [[nodiscard]] bool hang_together(const TetMesh& mesh, TetId a, TetId b);

 private:
  [[nodiscard]] static bool differ(std::uint32_t p, std::uint32_t q) { return p != 0 && q != 0 && p != q; }
  void label(const TetMesh& mesh, TetId tet, std::uint32_t piece);

  /// Labels by slot, 0 where there is none.
  template <class Id>
  class Labels {
   public:
    std::uint32_t operator[](std::uint32_t slot) const { return slot < labels_.capacity() ? labels_[slot] : 0; }
    void set(Id id, std::uint32_t piece) {
      labels_.ensure(std::size_t{id.value} + 1);
      if (labels_[id.value] == 0) labelled_.push_back(id);
      labels_[id.value] = piece;
    }
    void forget() {
      for (const Id id : labelled_) labels_[id.value] = 0;
      labelled_.clear();
    }

   private:
    ZeroedArray<std::uint32_t> labels_;
    std::vector<Id> labelled_;
  };

  PieceFinder finder_;
  Labels<TetId> of_tet_;
  Labels<VertexId> of_vertex_;
  bool has_several_ = false, has_labels_ = false;
};

}  // namespace v0
}  // namespace incise
