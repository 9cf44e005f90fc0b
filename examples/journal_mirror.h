// SPDX-License-Identifier: Apache-2.0
// A copy of a mesh that is kept by the journal alone, with a velocity of its own: where authors of solvers may start.
// docs/journal.md explains every record; `JournalVisitor` tells them in the order in which they take effect.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "incise/mesh/journal_visitor.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::examples {

/// Vertices and tets as a solver sees them, by slot, one journal step behind at most.
///
/// Call `follow` whenever you need the mesh as it stands, between two calls of the engine. Memory: what the steps that
/// the journal keeps touched, for undo. Not thread-safe.
class JournalMirror : private JournalVisitor {
 public:
  struct Vertex {
    Vec3 rest = Vec3::Zero(), current = Vec3::Zero(), velocity = Vec3::Zero();
    bool is_live = false;
  };
  struct Tet {
    TetVertices vertices{};  ///< the first one is invalid where the slot is free
    std::int32_t region = 0;
    std::array<std::uint32_t, 4> opened{};  ///< by side: the stroke that a step told to have opened it; 0: none told
    [[nodiscard]] bool is_live() const { return vertices[0].is_valid(); }
  };

  /// Copies a mesh as it stands; velocities are zero. Cost: O(slots).
  explicit JournalMirror(const TetMesh& mesh, const Journal& journal = {}, StepReading reading = StepReading::kEdits)
      : reading_(reading),
        base_(journal.position()),
        base_serial_(journal.serial_before(journal.position())),
        vertices_(mesh.vertex_slots()),
        tets_(mesh.tet_slots()) {
    mesh.for_each_vertex([&](VertexId v) { vertices_[v.value] = {mesh.rest(v), mesh.current(v), Vec3::Zero(), true}; });
    mesh.for_each_tet([&](TetId t) { tets_[t.value] = {mesh.vertices(t), mesh.region(t), {}}; });
  }

  /// Catches up with the journal, forwards or backwards. A record that does not fit what is held goes into `fault`.
  /// Cost: O(size of the steps).
  void follow(const Journal& journal) {
    fresh_.clear();
    expect(journal.first() <= position(), "the journal has trimmed steps that the mirror has not seen");
    if (!fault_.empty()) return;
    while (applied_ > 0 && !is_applied(journal)) go_back();
    expect(is_applied(journal), "the journal goes back behind the place where the mirror began");
    if (!fault_.empty()) return;
    while (position() < journal.position()) go_forward(journal.step(position()));
    forget_trimmed(journal);
    std::sort(fresh_.begin(), fresh_.end());
    fresh_.erase(std::unique(fresh_.begin(), fresh_.end()), fresh_.end());
    std::erase_if(fresh_, [&](VertexId v) { return v.value >= vertices_.size() || !vertices_[v.value].is_live; });
  }

  [[nodiscard]] std::size_t position() const { return base_ + applied_; }
  /// Whether `follow` would change nothing.
  [[nodiscard]] bool has_caught_up(const Journal& journal) const {
    return position() == journal.position() && is_applied(journal);
  }
  [[nodiscard]] const std::vector<Tet>& tets() const { return tets_; }
  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }
  /// A solver writes `current` and `velocity`, and hands the places on by `Engine::set_positions`.
  [[nodiscard]] Vertex& vertex(VertexId id) { return vertices_[id.value]; }
  [[nodiscard]] const Vertex& vertex(VertexId id) const { return vertices_[id.value]; }
  /// The live vertices that the last `follow` put where they are, ascending: not yet in balance with their neighbours.
  [[nodiscard]] const std::vector<VertexId>& fresh() const { return fresh_; }
  /// The places of all slots, for `Engine::set_positions`.
  [[nodiscard]] std::vector<Vec3> positions() const {
    std::vector<Vec3> places;
    for (const Vertex& vertex : vertices_) places.push_back(vertex.current);
    return places;
  }

  /// The first record that did not fit; empty as long as all is well.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// The first place where the mirror is not the mesh bit for bit; empty where it is. Cost: O(slots).
  [[nodiscard]] std::string difference(const TetMesh& mesh) const {
    if (!fault_.empty()) return fault_;
    if (vertices_.size() != mesh.vertex_slots() || tets_.size() != mesh.tet_slots()) return "number of slots";
    for (std::uint32_t slot = 0; slot < vertices_.size(); ++slot) {
      if (differs(mesh, VertexId(slot))) return "vertex " + std::to_string(slot);
    }
    for (std::uint32_t slot = 0; slot < tets_.size(); ++slot) {
      if (differs(mesh, TetId(slot))) return "tet " + std::to_string(slot);
    }
    return {};
  }

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

  /// Whether the last step that the mirror applied, or began after, is applied in the journal too.
  [[nodiscard]] bool is_applied(const Journal& journal) const {
    return position() <= journal.position() && position() >= journal.first() &&
           journal.serial_before(position()) == (applied_ == 0 ? base_serial_ : past_[applied_ - 1].serial);
  }
  /// No undo leads behind what the journal keeps.
  void forget_trimmed(const Journal& journal) {
    for (; base_ < journal.first(); ++base_, --applied_) {
      base_serial_ = past_.front().serial;
      past_.pop_front();
    }
  }
  /// An undone step, known by its serial, comes back as it was left. A new one drops those that were undone.
  void go_forward(const Step& step) {
    if (applied_ < past_.size() && past_[applied_].serial == step.serial) {
      restore(past_[applied_++].after);
      return;
    }
    past_.resize(applied_++);
    past_.push_back({step.serial, image_before(step), {}});
    visit(step, *this, reading_);
  }
  void go_back() {
    Past& past = past_[--applied_];
    past.after = image_of(past.before);
    restore(past.before);
  }

  // --- what a step does, in its order

  void born(const BornVertex& born) override {
    Vec3 velocity = Vec3::Zero();
    for (unsigned i = 0; i < 4; ++i) {
      if (!born.parents[i].is_valid()) continue;
      expect(vertices_[born.parents[i].value].is_live, "a parent is not live");
      velocity += born.weights[i] * vertices_[born.parents[i].value].velocity;
    }
    vertices_[born.id.value] = {born.rest, born.current, velocity, true};
    fresh_.push_back(born.id);
  }
  void moved(const MovedVertex& moved) override {
    Vertex& vertex = vertices_[moved.id.value];
    expect(same(vertex.rest, moved.old_rest), "a moved vertex was elsewhere");
    Vec3 velocity = Vec3::Zero();
    for (unsigned i = 0; i < 4; ++i) velocity += moved.weights[i] * vertices_[moved.basis[i].value].velocity;
    vertex = {moved.rest, moved.current, velocity, true};
    fresh_.push_back(moved.id);
  }
  void copied(const CopiedVertex& copied) override {
    expect(vertices_[copied.source.value].is_live, "the source of a copy is not live");
    vertices_[copied.id.value] = vertices_[copied.source.value];
    fresh_.push_back(copied.id);
  }
  /// A tet that lives on stands in both lists: all the old ones go before the new ones come.
  void replaced(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) override {
    for (const ConsumedTet& old : consumed) {
      expect(tets_[old.id.value].vertices == old.vertices, "a consumed tet had other vertices");
      tets_[old.id.value].vertices = {};
    }
    for (const ProducedTet& tet : produced) {
      expect(!tets_[tet.parent.value].is_live() || tet.parent == tet.id || is_among(produced, tet.parent),
             "a parent was not consumed");
      expect(tets_[tet.parent.value].region == tet.region, "a tet's region is not its parent's");
      expect(!tets_[tet.id.value].is_live(), "a produced tet's slot was taken");
      tets_[tet.id.value] = {tet.vertices, tet.region, {}};
    }
  }
  void rewired(const RewiredTet& rewired) override {
    expect(tets_[rewired.id.value].vertices == rewired.old_vertices, "a rewired tet had other vertices");
    tets_[rewired.id.value].vertices = rewired.vertices;
  }
  void opened(const OpenedFace& face) override {
    for (const Side side : {face.a, face.b}) tets_[side.tet().value].opened[side.side()] = face.tag;
  }
  void closed(const OpenedFace& face) override { tets_[face.a.tet().value].opened[face.a.side()] = 0; }
  void died(VertexId vertex) override { vertices_[vertex.value].is_live = false; }

  /// A parent that lives on is live again once it has been produced.
  static bool is_among(std::span<const ProducedTet> produced, TetId id) {
    return std::any_of(produced.begin(), produced.end(), [&](const ProducedTet& tet) { return tet.id == id; });
  }

  template <class Array, class Ids>
  static void grow(Array& slots, const Ids& taken) {
    for (const auto id : taken) {
      if (id.value >= slots.size()) slots.resize(id.value + 1);
    }
  }
  /// Makes room for what the step took, and keeps what it touches.
  Image image_before(const Step& step) {
    Image image{{}, {}, vertices_.size(), tets_.size()};
    grow(vertices_, step.new_vertices);
    grow(tets_, step.new_tets);
    const auto keep_vertex = [&](VertexId id) { image.vertices.emplace_back(id, vertices_[id.value]); };
    const auto keep_tet = [&](TetId id) { image.tets.emplace_back(id, tets_[id.value]); };
    for (const VertexImage& touched : step.before.vertices) keep_vertex(touched.id);
    for (const TetImage& touched : step.before.tets) keep_tet(touched.id);
    for (const VertexId id : step.new_vertices) keep_vertex(id);
    for (const TetId id : step.new_tets) keep_tet(id);
    return image;
  }
  /// What stands now in the slots of another image.
  [[nodiscard]] Image image_of(Image slots) const {
    for (auto& [id, vertex] : slots.vertices) vertex = vertices_[id.value];
    for (auto& [id, tet] : slots.tets) tet = tets_[id.value];
    slots.vertex_slots = vertices_.size();
    slots.tet_slots = tets_.size();
    return slots;
  }
  /// Undo and redo alike: what the step touched is as it was, places and velocities included; the rest stays.
  void restore(const Image& image) {
    vertices_.resize(std::max(vertices_.size(), image.vertex_slots));
    tets_.resize(std::max(tets_.size(), image.tet_slots));
    for (const auto& [id, vertex] : image.vertices) {
      vertices_[id.value] = vertex;
      fresh_.push_back(id);
    }
    for (const auto& [id, tet] : image.tets) tets_[id.value] = tet;
    vertices_.resize(image.vertex_slots);
    tets_.resize(image.tet_slots);
  }

  static bool same(const Vec3& a, const Vec3& b) { return std::memcmp(a.data(), b.data(), sizeof(Vec3)) == 0; }
  [[nodiscard]] bool differs(const TetMesh& mesh, VertexId id) const {
    const Vertex& vertex = vertices_[id.value];
    if (vertex.is_live != mesh.is_live(id)) return true;
    return vertex.is_live && !(same(vertex.rest, mesh.rest(id)) && same(vertex.current, mesh.current(id)));
  }
  [[nodiscard]] bool differs(const TetMesh& mesh, TetId id) const {
    const Tet& tet = tets_[id.value];
    if (tet.is_live() != mesh.is_live(id)) return true;
    if (!tet.is_live()) return false;
    for (unsigned side = 0; side < 4; ++side) {
      const Link link = mesh.links(id)[side];
      if (tet.opened[side] != 0 && !(link.is_boundary() && link.tag() == tet.opened[side])) return true;
    }
    return tet.vertices != mesh.vertices(id) || tet.region != mesh.region(id);
  }
  void expect(bool holds, const char* what) {
    if (!holds && fault_.empty()) fault_ = what;
  }

  StepReading reading_;
  std::size_t base_, applied_ = 0;
  std::uint64_t base_serial_;  // of the step before base_
  std::vector<Vertex> vertices_;
  std::vector<Tet> tets_;
  std::deque<Past> past_;  // those from applied_ on are undone
  std::vector<VertexId> fresh_;
  std::string fault_;
};

}  // namespace incise::examples
