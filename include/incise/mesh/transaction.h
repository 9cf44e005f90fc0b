// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

namespace detail {

/// The lists of an open transaction, empty between transactions; they keep their memory, so that a step asks for that
/// which it will hold and no more.
struct TransactionLists {
  Step step;
  std::vector<TetId> parents;  ///< of `step.new_tets`
  std::vector<TetId> removed_tets;
  std::vector<VertexId> removed_vertices;
  std::vector<OpenedFace> opened;

  void clear() noexcept;
};

}  // namespace detail

/// Where a vertex stands once it is moved to the rest place with the coordinates `weights` in `basis`: there where all
/// of them are at rest, else at the sampled current place. Cost: O(1).
[[nodiscard]] Vec3 current_after_move(const TetMesh& mesh, VertexId vertex, const Vec3& rest, const TetVertices& basis,
                                      const std::array<double, 4>& weights);

/// One batch of edits of one mesh: everything or nothing.
///
/// The members are the primitive edits that the verbs of `mesh/verbs.h` and the cutting kernel are made of. They keep
/// no invariant by themselves; whoever uses them promises a valid mesh at `commit`. Before the first change of a slot
/// its image is kept, so that `rollback` (or destruction without commit) restores the mesh bit for bit. An edit, or
/// `commit`, that throws std::bad_alloc leaves a transaction that can only be rolled back.
/// Slots freed here are not reused before the commit. One transaction at a time per mesh.
class Transaction {
 public:
  /// `keeps_edits`: the step lists every change by itself (`Step::edits`); for edits that meet in one place. Then only
  /// `move` and verbs that call `note_remesh` may be used.
  explicit Transaction(TetMesh& mesh, bool keeps_edits = false);
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();

  /// The mesh as it stands, with the edits so far.
  [[nodiscard]] const TetMesh& mesh() const { return mesh_; }

  /// A new vertex at the given rest and current position; `parents` (1 to 4) and `weights` say where it came from.
  VertexId add_vertex(std::span<const VertexId> parents, std::span<const double> weights, const Vec3& rest,
                      const Vec3& current);
  /// A new vertex on the edge (a, b) at (1-t)·a + t·b, at rest and currently. `t` in (0, 1).
  VertexId add_vertex_on_edge(VertexId a, VertexId b, double t);
  /// A twin of `source` at the same place.
  VertexId copy_vertex(VertexId source);
  /// A new tet; its links are boundary with tag 0 until set. `parent` is the tet that it takes material from.
  TetId add_tet(const TetVertices& vertices, TetId parent);
  /// The same in a slot other than those of `reserved`, ascending. Cost: O(free slots) at most.
  TetId add_tet_beside(const TetVertices& vertices, TetId parent, std::span<const TetId> reserved);
  /// Frees the slot of a tet; its neighbours' links are up to the caller.
  void remove_tet(TetId tet);
  /// Frees the slot of a vertex, which no tet may name at `commit`.
  void remove_vertex(VertexId vertex);
  /// Puts a tet back into its slot, which must be free: all of the image but its links, which are boundary with tag 0
  /// until set. `parent` as for `add_tet`. Cost: O(slots that were freed since it was).
  void revive_tet(const TetImage& image, TetId parent);
  /// Puts a vertex back into its slot, which must be free: all of the image but its current position. `parents` and
  /// `weights` as for `add_vertex`. Cost: as for `revive_tet`.
  void revive_vertex(const VertexImage& image, std::span<const VertexId> parents, std::span<const double> weights,
                     const Vec3& current);

  /// One direction only; see `join`.
  void set_link(Side side, Link link);
  /// Makes two sides neighbours.
  void join(Side a, Side b);
  /// Turns a face into two boundary sides with the tag of a stroke.
  void open(Side a, Side b, std::uint32_t tag);
  /// Puts a vertex in place of the one at a corner, in [0, 3].
  void set_corner(TetId tet, unsigned corner, VertexId vertex);
  /// Names the tet that `TetMesh::tet_of` gives.
  void set_tet_of(VertexId vertex, TetId tet);
  /// Sets the bits of `shape`.
  void set_shape(VertexId vertex, std::uint8_t bits);
  /// Of a vertex made in this transaction.
  void set_origin(VertexId vertex, VertexId origin);
  /// Moves a vertex to the place with the barycentric coordinates `weights` in `basis`, a tet around it: the current
  /// position and followers' values are sampled there. `rest` is that place, given exactly.
  void move(VertexId vertex, const Vec3& rest, const TetVertices& basis, const std::array<double, 4>& weights);

  /// Records that a cavity is filled anew, where edits are kept: call it before with the tets that are consumed, and
  /// `note_produced` after with those that were produced, their parents and the vertex that was put in, if any.
  void note_consumed(std::span<const TetId> tets);
  /// The second half: `parents`, one per produced tet, are among the consumed ones.
  void note_produced(std::span<const TetId> tets, std::span<const TetId> parents, VertexId born = {});

  /// Slots taken so far.
  [[nodiscard]] const std::vector<TetId>& new_tets() const { return step_.new_tets; }
  /// The same of vertices.
  [[nodiscard]] const std::vector<VertexId>& new_vertices() const { return step_.new_vertices; }
  /// The tet, dead or alive, that a new tet takes its material from, down to a tet that lived before the transaction.
  [[nodiscard]] TetId root_parent(TetId tet) const;

  /// Makes the edits permanent and returns them. Cost: O(edits).
  Step commit();
  /// Restores the mesh as it was at construction, also after an edit that ran out of memory. Asks for none itself.
  /// Cost: O(edits).
  void rollback() noexcept;

 private:
  void touch(TetId tet);
  void touch(VertexId vertex);
  void note_edit(Edit::Kind kind, std::uint32_t vertex);
  template <class Visit>
  void for_each_new_link(const TetImage& old, Visit&& visit) const;
  void record_consumed(Step& made) const;
  void record_kept(Step& made) const;
  void record_produced(Step& made) const;
  void record_vertices(Step& made) const;
  void record_opened(Step& made) const;
  void record_closed(Step& made) const;
  void record_notes(Step& made) const;
  void release_slots();
  void clear_marks();
  void close() noexcept;
  std::uint32_t take_tet_slot();
  std::uint32_t take_vertex_slot();
  static std::uint32_t pop_free_slot(GrowArray<std::uint32_t>& free, std::size_t& common,
                                     std::vector<std::uint32_t>& before);
  static void take_free_slot(std::uint32_t slot, GrowArray<std::uint32_t>& free, std::size_t& common,
                             std::vector<std::uint32_t>& before);
  void fill_tet(TetId id, const TetVertices& vertices, TetId parent);
  std::uint32_t append_tet_slot();
  void note_taken(TetId tet);
  void note_taken(VertexId vertex);
  void record_born(VertexId id, std::span<const VertexId> parents, std::span<const double> weights);

  TetMesh& mesh_;
  detail::TransactionLists& lists_;
  Step& step_;  // of the lists: images of all slots touched, in the order of their first change
  ZeroedArray<std::uint32_t>& tet_mark_;     // 0 untouched, 1 touched, 2 + index where the transaction took the slot
  ZeroedArray<std::uint32_t>& vertex_mark_;  // likewise
  bool keeps_edits_ = false;
  bool is_open_ = true;
};

}  // namespace v0
}  // namespace incise
