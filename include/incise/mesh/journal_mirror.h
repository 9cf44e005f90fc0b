// SPDX-License-Identifier: Apache-2.0
// A copy of a mesh that is kept by the journal alone: where authors of solvers may start. docs/journal.md explains
// every record; `JournalVisitor` tells them in the order in which they take effect.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "incise/mesh/journal_visitor.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Vertices and tets as a solver sees them, by slot, with a velocity and marks of the solver's own, one journal step
/// behind at most.
///
/// Call `follow` whenever you need the mesh as it stands, between two calls of the engine. Memory: what the steps that
/// the journal keeps touched, for undo, and the tets of each vertex. Not thread-safe.
class JournalMirror : private JournalVisitor {
 public:
  /// A vertex slot.
  struct Vertex {
    Vec3 rest = Vec3::Zero();      ///< place at rest, in the mesh's length unit
    Vec3 current = Vec3::Zero();   ///< place as the body stands; the solver's to write
    Vec3 velocity = Vec3::Zero();  ///< the solver's; interpolated where vertices are born or move
    /// The solver's: which vertices are held, say. A copy has those of its source; a vertex that is born those that all
    /// of its parents have; one that moves keeps its own.
    std::uint32_t marks = 0;
    bool is_live = false;  ///< else the slot is free
  };
  /// A tet slot.
  struct Tet {
    TetVertices vertices{};                 ///< the first one is invalid where the slot is free
    std::int32_t region = 0;                ///< label
    std::array<std::uint32_t, 4> opened{};  ///< by side: the stroke that a step told to have opened it; 0: none told
    /// Whether the slot is in use.
    [[nodiscard]] bool is_live() const { return vertices[0].is_valid(); }
  };

  /// Copies a mesh as it stands; velocities and marks are zero. Cost: O(slots).
  explicit JournalMirror(const TetMesh& mesh, const Journal& journal = {}, StepReading reading = StepReading::kEdits);

  /// Catches up with the journal, forwards or backwards: what is undone or redone is as it was, velocities and marks
  /// included. A record that does not fit what is held goes into `fault`. Cost: O(size of the steps).
  void follow(const Journal& journal);

  /// Steps applied, as `Journal::position`.
  [[nodiscard]] std::size_t position() const { return base_ + applied_; }
  /// Whether `follow` would change nothing.
  [[nodiscard]] bool has_caught_up(const Journal& journal) const {
    return position() == journal.position() && is_applied(journal);
  }
  /// All slots.
  [[nodiscard]] const std::vector<Tet>& tets() const { return tets_; }
  /// The slot of an id.
  [[nodiscard]] const Tet& tet(TetId id) const { return tets_[id.value]; }
  /// All slots.
  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }
  /// A solver writes `current`, `velocity` and `marks`, and hands the places on by `Engine::set_positions`.
  [[nodiscard]] Vertex& vertex(VertexId id) { return vertices_[id.value]; }
  /// The slot of an id.
  [[nodiscard]] const Vertex& vertex(VertexId id) const { return vertices_[id.value]; }
  /// The live tets that have a vertex, ascending.
  [[nodiscard]] const std::vector<TetId>& tets_of(VertexId id) const { return star_[id.value]; }
  /// The live vertices that the last `follow` put where they are, ascending: not yet in balance with their neighbours.
  [[nodiscard]] const std::vector<VertexId>& fresh() const { return fresh_; }
  /// The live tets that the last `follow` made, gave other vertices or another shape at rest, ascending: what a solver
  /// has computed of others (volumes at rest, gradients) still holds.
  [[nodiscard]] const std::vector<TetId>& changed_tets() const { return changed_; }
  /// The places of all slots, for `Engine::set_positions`. Cost: O(slots).
  [[nodiscard]] std::vector<Vec3> positions() const;

  /// The first record that did not fit; empty as long as all is well.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// The first place where the mirror is not the mesh bit for bit; empty where it is. Cost: O(slots).
  [[nodiscard]] std::string difference(const TetMesh& mesh) const;

 private:
  /// What a step touched, as it stood on one side of the step.
  struct Image {
    std::vector<std::pair<VertexId, Vertex>> vertices;
    std::vector<std::pair<TetId, Tet>> tets;
    std::size_t vertex_slots = 0, tet_slots = 0;
  };
  /// Both sides of a step: as all was when the step came first, and when it was last undone.
  struct Past {
    std::uint64_t serial = 0;  // of the step
    Image before, after;
  };

  [[nodiscard]] bool is_applied(const Journal& journal) const;
  void forget_trimmed(const Journal& journal);
  void go_forward(const Step& step);
  void go_back();
  void list_changes();

  void born(const BornVertex& born) override;
  void moved(const MovedVertex& moved) override;
  void copied(const CopiedVertex& copied) override;
  void replaced(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) override;
  void rewired(const RewiredTet& rewired) override;
  void opened(const OpenedFace& face) override;
  void closed(const OpenedFace& face) override;
  void died(VertexId vertex) override;

  Image image_before(const Step& step);
  [[nodiscard]] Image image_of(Image slots) const;
  void restore(const Image& image);
  void resize(std::size_t vertex_slots, std::size_t tet_slots);
  void put(TetId id, const Tet& tet);
  void touch(VertexId id);
  [[nodiscard]] bool differs(const TetMesh& mesh, VertexId id) const;
  [[nodiscard]] bool differs(const TetMesh& mesh, TetId id) const;
  void expect(bool holds, const char* what);

  StepReading reading_;
  std::size_t base_, applied_ = 0;
  std::uint64_t base_serial_;  // of the step before base_
  std::vector<Vertex> vertices_;
  std::vector<Tet> tets_;
  std::vector<std::vector<TetId>> star_;  // of each vertex slot, ascending, so that it depends on the state alone
  std::deque<Past> past_;                 // those from applied_ on are undone
  std::vector<VertexId> fresh_;
  std::vector<TetId> changed_;
  std::string fault_;
};

}  // namespace v0
}  // namespace incise
