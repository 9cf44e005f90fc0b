// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

// The journal is the mesh's second interface: solvers, renderers and recorders follow it instead of the mesh.
// Within one step a follower applies the records in the order of the members of `Step`:
//   born, moved, copied, consumed, produced, rewired, opened, closed, died.
// Each list is in the order in which things happened, and may refer to what stands before it.
// A step of maintenance changes the same place several times: it has `edits` besides, each with its own tets before and
// after. Followers that carry state from tet to tet apply the edits one by one, instead of born, moved, consumed,
// produced and rewired; those that rebuild what changed take the lists, which give the net effect.

/// A vertex that is new: where it came from, so that followers can interpolate.
struct BornVertex {
  VertexId id;                      ///< its slot
  std::array<VertexId, 4> parents;  ///< unused entries are invalid
  std::array<double, 4> weights;    ///< sum to 1 over the valid parents
  Vec3 rest, current;               ///< at birth, bit for bit
};

/// A vertex that now stands for another material point: values that live in the material must be sampled there.
struct MovedVertex {
  VertexId id;                    ///< its slot
  std::array<VertexId, 4> basis;  ///< the tet that holds (or is nearest to) the new place before the move
  std::array<double, 4> weights;  ///< barycentric coordinates of the new place in it; sum to 1, may be negative
  Vec3 old_rest, rest, old_current, current;  ///< its places before and after, in the mesh's length unit
};

/// A vertex that is the twin of another one.
struct CopiedVertex {
  VertexId id, source;  ///< the copy starts with the source's positions as they are after this step's moves
};

/// A tet that is gone.
struct ConsumedTet {
  TetId id;              ///< its slot, free after the step
  TetVertices vertices;  ///< as they were
};

/// A tet that is new.
struct ProducedTet {
  TetId id;              ///< its slot
  TetId parent;          ///< the consumed tet that it lies in; of several, as at a front, the one that holds its middle
  TetVertices vertices;  ///< positive in this order
  std::int32_t region;   ///< label, its parent's
};

/// A tet that lives on with other vertices: copies took the place of their sources.
struct RewiredTet {
  TetId id;                            ///< its slot
  TetVertices old_vertices, vertices;  ///< before and after
};

/// A face that the step turned into two boundary sides.
struct OpenedFace {
  Side a, b;          ///< of the two tets, each as its own tet sees it
  std::uint32_t tag;  ///< stroke number, as in `Link::tag`
};

/// One of the changes that a step of maintenance made, one after the other.
struct Edit {
  /// What an edit does.
  enum class Kind : std::uint8_t {
    kMove,    ///< a vertex moved: `moved[vertex]`; the tets around it keep their vertices
    kRemesh,  ///< the tets of a cavity gave way to others that fill the same space
  };
  Kind kind = Kind::kMove;               ///< which of the two
  std::uint32_t vertex = kInvalidIndex;  ///< kMove: index into `moved`; kRemesh: into `born` where one was put in
  /// kRemesh: one past its last tet in `edit_consumed` and `edit_produced`; the first one follows the edit before. A
  /// tet that lives on with another vertex stands in both.
  std::uint32_t consumed_end = 0, produced_end = 0;
};

/// A tet slot as it was.
struct TetImage {
  TetId id;              ///< the slot
  TetVertices vertices;  ///< the first is invalid where the slot was free
  TetLinks links;        ///< what lay behind its sides
  std::int32_t region;   ///< label
};

/// A side of a tet as it was, of a tet that lives on with the same vertices.
struct SideImage {
  Side side;  ///< the side
  Link link;  ///< what lay behind it
};

/// What else a tet was that is gone, besides what `ConsumedTet` says.
struct GoneTet {
  TetLinks links;       ///< what lay behind its sides
  std::int32_t region;  ///< label
};

/// A vertex slot as it was, of a vertex that stands where it stood and lives on.
struct TiedVertex {
  VertexId id;         ///< the slot
  TetId tet;           ///< one of its tets
  VertexId origin;     ///< as `TetMesh::origin`
  std::uint8_t shape;  ///< bits of `shape`
};

/// A vertex slot as it was.
struct VertexImage {
  VertexId id;         ///< the slot
  Vec3 rest, current;  ///< places, in the mesh's length unit
  TetId tet;           ///< one of its tets
  VertexId origin;     ///< as `TetMesh::origin`
  std::uint8_t shape;  ///< bits of `shape`
};

/// What a step changed besides its records, on one side of it, with the free lists above their common part.
struct StepImage {
  std::vector<TetImage> tets;                           ///< after the step: touched slots but of `sides` alone
  std::vector<SideImage> sides;                         ///< of `kept` tets: those with another neighbour
  std::vector<VertexImage> vertices;                    ///< touched slots but those of `ties`
  std::vector<TiedVertex> ties;                         ///< touched slots of vertices that the step left in their place
  std::vector<std::uint32_t> free_tets, free_vertices;  ///< the free lists above their common part
  std::uint32_t tet_slots = 0, vertex_slots = 0;        ///< one past the highest slot in use
};

/// One committed step: the net effect of a transaction, with what is needed to invert it.
struct Step {
  /// Given by `Journal::append`, from 1 on. A step keeps it through undo and redo, and no other step of the journal
  /// ever gets it: a follower knows steps by it.
  std::uint64_t serial = 0;

  std::vector<BornVertex> born;       ///< new vertices
  std::vector<MovedVertex> moved;     ///< vertices that are other material points now
  std::vector<CopiedVertex> copied;   ///< twins
  std::vector<ConsumedTet> consumed;  ///< tets that are gone
  std::vector<ProducedTet> produced;  ///< new tets
  std::vector<RewiredTet> rewired;    ///< tets that live on with other vertices
  std::vector<OpenedFace> opened;     ///< faces that are two boundary sides now
  std::vector<OpenedFace> closed;     ///< walls that are none any more, by the tet that lives on; `b` is what is behind
  std::vector<VertexId> died;         ///< vertices that are gone, those born in this step included

  std::vector<Edit> edits;                 ///< empty where the lists above tell the whole order
  std::vector<ConsumedTet> edit_consumed;  ///< of all edits, one after the other
  std::vector<ProducedTet> edit_produced;  ///< `parent` is a tet consumed by the same edit

  StepImage before, after;                                     ///< `after` is filled by the first undo
  std::vector<GoneTet> gone;                                   ///< one for each of `consumed`
  std::vector<TetId> kept;                                     ///< touched tets that live on; see `rewired` as well
  std::size_t free_tets_common = 0, free_vertices_common = 0;  ///< length of what the free lists share before and after
  std::size_t free_tets_taken = 0, free_vertices_taken = 0;    ///< so many of the new ones were the top of a free list
  std::vector<TetId> new_tets;                                 ///< slots taken by the step
  std::vector<VertexId> new_vertices;                          ///< slots taken by the step

  /// Whether the step changed nothing.
  [[nodiscard]] bool is_empty() const {
    return kept.empty() && consumed.empty() && before.vertices.empty() && before.ties.empty() && new_tets.empty();
  }
  /// The tet `consumed[index]` as it was.
  [[nodiscard]] TetImage consumed_image(std::size_t index) const {
    return {consumed[index].id, consumed[index].vertices, gone[index].links, gone[index].region};
  }
  /// Calls `visit(id)` for each tet slot that the step changed and that was taken before. Cost: O(slots).
  template <class Visit>
  void for_each_tet_before(Visit&& visit) const {
    for (const ConsumedTet& tet : consumed) visit(tet.id);
    for (const TetId tet : kept) visit(tet);
  }
  /// Calls `visit(id)` for each vertex slot that the step changed and that was taken before. Cost: O(slots).
  template <class Visit>
  void for_each_vertex_before(Visit&& visit) const {
    for (const VertexImage& image : before.vertices) visit(image.id);
    for (const TiedVertex& tie : before.ties) visit(tie.id);
  }
};

/// The committed steps of one mesh, in order, with a position that undo and redo move.
///
/// Followers pull: they remember how many steps they applied and catch up between commits. `JournalCursor` tells them
/// what has happened since. Positions count all steps ever applied, those that `trim` has forgotten included.
class Journal {
 public:
  /// Appends a step and gives it the next serial; steps that were undone are dropped.
  void append(Step step);
  /// The same for a step that changed something; others are dropped. Returns whether it did.
  bool append_if_changed(Step step);
  /// Steps applied so far.
  [[nodiscard]] std::size_t position() const { return position_; }
  /// One past the last step that is kept, undone ones included.
  [[nodiscard]] std::size_t size() const { return first_ + steps_.size(); }
  /// The lowest step that is kept, and the lowest position that undo leads back to; 0 as long as nothing was trimmed.
  [[nodiscard]] std::size_t first() const { return first_; }
  /// `index` in [`first`, `size`).
  [[nodiscard]] const Step& step(std::size_t index) const { return steps_[index - first_]; }
  /// The serial of the last step before a position in [`first`, `size`]; 0 before the first step of all.
  [[nodiscard]] std::uint64_t serial_before(std::size_t position) const {
    return position == first_ ? trimmed_serial_ : step(position - 1).serial;
  }
  /// The highest serial given so far; 0 where none was.
  [[nodiscard]] std::uint64_t newest_serial() const { return newest_serial_; }
  /// Takes the last applied step back: the mesh, its slots and its free lists are bit for bit as before it, but for the
  /// current positions of vertices that it left in their place.
  /// Returns false where none is kept. Cost: O(step).
  bool undo(TetMesh& mesh);
  /// Applies the next undone step again. Returns false where there is none. Cost: O(step).
  bool redo(TetMesh& mesh);
  /// Takes the steps from `position` on back and drops them, and those that were undone: for what has failed.
  /// `position` in [`first`, `position()`]. Asks for no memory, so that it works where there is none left. Cost:
  /// O(steps).
  void take_back(TetMesh& mesh, std::size_t position) noexcept;
  /// Forgets the applied steps before `position`, at most all; their memory is free again. They can be neither undone
  /// nor followed any more. Cost: O(steps forgotten).
  void trim(std::size_t position);
  /// Bytes held by the steps that are kept. Cost: O(steps).
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  friend class Transaction;

  static void put(TetMesh& mesh, const TetImage& image);
  static void give_back_taken(TetMesh& mesh, const Step& step);
  static void revert(TetMesh& mesh, const Step& step) noexcept;
  static void restore(TetMesh& mesh, const Step& step, const StepImage& image);
  static void count_change(bool was_live, bool is_live, std::size_t& live, std::uint32_t& generation);

  std::deque<Step> steps_;  // from first_ on
  std::size_t first_ = 0, position_ = 0;
  std::uint64_t newest_serial_ = 0;
  std::uint64_t trimmed_serial_ = 0;  // of the step before first_
};

}  // namespace v0
}  // namespace incise
