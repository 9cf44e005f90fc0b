// SPDX-License-Identifier: Apache-2.0
// Each record is checked against what is held before it is applied; before a step what it will touch is kept, and
// comes back by the step's serial.
#include "incise/mesh/journal_mirror.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "mesh/constants.h"

namespace incise {
inline namespace v0 {
namespace {

bool same(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), sizeof(Vec3)) == 0;
}

/// A parent that lives on is live again once it has been produced.
bool is_among(std::span<const ProducedTet> produced, TetId id) {
  return std::any_of(produced.begin(), produced.end(), [&](const ProducedTet& tet) { return tet.id == id; });
}

template <class Ids>
std::size_t slots_for(std::size_t slots, const Ids& taken) {
  for (const auto id : taken) slots = std::max<std::size_t>(slots, std::size_t{id.value} + 1);
  return slots;
}

template <class Id, class IsLive>
void keep_live_once(std::vector<Id>& ids, const IsLive& is_live) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::erase_if(ids, [&](Id id) { return !is_live(id); });
}

}  // namespace

JournalMirror::JournalMirror(const TetMesh& mesh, const Journal& journal, StepReading reading)
    : reading_(reading),
      base_(journal.position()),
      base_serial_(journal.serial_before(journal.position())),
      vertices_(mesh.vertex_slots()),
      tets_(mesh.tet_slots()),
      star_(mesh.vertex_slots()) {
  mesh.for_each_vertex([&](VertexId v) {
    vertices_[v.value] = {mesh.rest(v), mesh.current(v), Vec3::Zero(), 0, true};
  });
  mesh.for_each_tet([&](TetId t) { put(t, {mesh.vertices(t), mesh.region(t), {}}); });
  changed_.clear();
}

void JournalMirror::follow(const Journal& journal) {
  fresh_.clear();
  changed_.clear();
  expect(journal.first() <= position(), "the journal has trimmed steps that the mirror has not seen");
  if (!fault_.empty()) return;
  while (applied_ > 0 && !is_applied(journal)) go_back();
  expect(is_applied(journal), "the journal goes back behind the place where the mirror began");
  if (!fault_.empty()) return;
  while (position() < journal.position()) go_forward(journal.step(position()));
  forget_trimmed(journal);
  list_changes();
}

/// What was touched, as far as it is still there.
void JournalMirror::list_changes() {
  keep_live_once(fresh_, [&](VertexId v) { return v.value < vertices_.size() && vertices_[v.value].is_live; });
  keep_live_once(changed_, [&](TetId t) { return t.value < tets_.size() && tets_[t.value].is_live(); });
}

std::vector<Vec3> JournalMirror::positions() const {
  std::vector<Vec3> places;
  places.reserve(vertices_.size());
  for (const Vertex& vertex : vertices_) places.push_back(vertex.current);
  return places;
}

std::string JournalMirror::difference(const TetMesh& mesh) const {
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

// --- steps

/// Whether the last step that the mirror applied, or began after, is applied in the journal too.
bool JournalMirror::is_applied(const Journal& journal) const {
  return position() <= journal.position() && position() >= journal.first() &&
         journal.serial_before(position()) == (applied_ == 0 ? base_serial_ : past_[applied_ - 1].serial);
}

/// No undo leads behind what the journal keeps.
void JournalMirror::forget_trimmed(const Journal& journal) {
  for (; base_ < journal.first(); ++base_, --applied_) {
    base_serial_ = past_.front().serial;
    past_.pop_front();
  }
}

/// An undone step, known by its serial, comes back as it was left. A new one drops those that were undone.
void JournalMirror::go_forward(const Step& step) {
  if (applied_ < past_.size() && past_[applied_].serial == step.serial) {
    restore(past_[applied_++].after);
    return;
  }
  past_.resize(applied_++);
  past_.push_back({step.serial, image_before(step), {}});
  visit(step, *this, reading_);
}

void JournalMirror::go_back() {
  Past& past = past_[--applied_];
  past.after = image_of(past.before);
  restore(past.before);
}

// --- what a step does, in its order

void JournalMirror::born(const BornVertex& born) {
  Vec3 velocity = Vec3::Zero();
  std::uint32_t marks = ~std::uint32_t{0};
  for (unsigned i = 0; i < 4; ++i) {
    if (!born.parents[i].is_valid()) continue;
    const Vertex& parent = vertices_[born.parents[i].value];
    expect(parent.is_live, "a parent is not live");
    velocity += born.weights[i] * parent.velocity;
    if (std::abs(born.weights[i]) > kLeastPart) marks &= parent.marks;
  }
  vertices_[born.id.value] = {born.rest, born.current, velocity, marks, true};
  touch(born.id);
}

void JournalMirror::moved(const MovedVertex& moved) {
  Vertex& vertex = vertices_[moved.id.value];
  expect(same(vertex.rest, moved.old_rest), "a moved vertex was elsewhere");
  Vec3 velocity = Vec3::Zero();
  for (unsigned i = 0; i < 4; ++i) velocity += moved.weights[i] * vertices_[moved.basis[i].value].velocity;
  vertex = {moved.rest, moved.current, velocity, vertex.marks, true};
  touch(moved.id);
}

void JournalMirror::copied(const CopiedVertex& copied) {
  expect(vertices_[copied.source.value].is_live, "the source of a copy is not live");
  vertices_[copied.id.value] = vertices_[copied.source.value];
  touch(copied.id);
}

/// A tet that lives on stands in both lists: all the old ones go before the new ones come.
void JournalMirror::replaced(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) {
  for (const ConsumedTet& old : consumed) {
    Tet tet = tets_[old.id.value];
    expect(tet.vertices == old.vertices, "a consumed tet had other vertices");
    tet.vertices = {};
    put(old.id, tet);
  }
  for (const ProducedTet& tet : produced) {
    expect(!tets_[tet.parent.value].is_live() || tet.parent == tet.id || is_among(produced, tet.parent),
           "a parent was not consumed");
    expect(tets_[tet.parent.value].region == tet.region, "a tet's region is not its parent's");
    expect(!tets_[tet.id.value].is_live(), "a produced tet's slot was taken");
    put(tet.id, {tet.vertices, tet.region, {}});
  }
}

void JournalMirror::rewired(const RewiredTet& rewired) {
  Tet tet = tets_[rewired.id.value];
  expect(tet.vertices == rewired.old_vertices, "a rewired tet had other vertices");
  tet.vertices = rewired.vertices;
  put(rewired.id, tet);
}

void JournalMirror::opened(const OpenedFace& face) {
  for (const Side side : {face.a, face.b}) tets_[side.tet().value].opened[side.side()] = face.tag;
}

void JournalMirror::closed(const OpenedFace& face) {
  tets_[face.a.tet().value].opened[face.a.side()] = 0;
}

void JournalMirror::died(VertexId vertex) {
  vertices_[vertex.value].is_live = false;
}

// --- slots

/// A vertex is another point: it is fresh, and its tets have another shape.
void JournalMirror::touch(VertexId id) {
  fresh_.push_back(id);
  changed_.insert(changed_.end(), star_[id.value].begin(), star_[id.value].end());
}

/// Writes a tet slot, and keeps the tets of its vertices.
void JournalMirror::put(TetId id, const Tet& tet) {
  Tet& slot = tets_[id.value];
  if (slot.is_live()) {
    for (const VertexId v : slot.vertices) std::erase(star_[v.value], id);
  }
  slot = tet;
  changed_.push_back(id);
  if (!tet.is_live()) return;
  for (const VertexId v : tet.vertices) {
    std::vector<TetId>& star = star_[v.value];
    star.insert(std::lower_bound(star.begin(), star.end(), id), id);
  }
}

void JournalMirror::resize(std::size_t vertex_slots, std::size_t tet_slots) {
  vertices_.resize(vertex_slots);
  star_.resize(vertex_slots);
  tets_.resize(tet_slots);
}

/// Makes room for what the step took, and keeps what it touches.
JournalMirror::Image JournalMirror::image_before(const Step& step) {
  Image image{{}, {}, vertices_.size(), tets_.size()};
  resize(slots_for(vertices_.size(), step.new_vertices), slots_for(tets_.size(), step.new_tets));
  const auto keep_vertex = [&](VertexId id) { image.vertices.emplace_back(id, vertices_[id.value]); };
  const auto keep_tet = [&](TetId id) { image.tets.emplace_back(id, tets_[id.value]); };
  for (const VertexImage& touched : step.before.vertices) keep_vertex(touched.id);
  step.for_each_tet_before([&](TetId tet) { keep_tet(tet); });
  for (const VertexId id : step.new_vertices) keep_vertex(id);
  for (const TetId id : step.new_tets) keep_tet(id);
  return image;
}

/// What stands now in the slots of another image.
JournalMirror::Image JournalMirror::image_of(Image slots) const {
  for (auto& [id, vertex] : slots.vertices) vertex = vertices_[id.value];
  for (auto& [id, tet] : slots.tets) tet = tets_[id.value];
  slots.vertex_slots = vertices_.size();
  slots.tet_slots = tets_.size();
  return slots;
}

/// Undo and redo alike: what the step touched is as it was, places and velocities included; the rest stays.
void JournalMirror::restore(const Image& image) {
  resize(std::max(vertices_.size(), image.vertex_slots), std::max(tets_.size(), image.tet_slots));
  for (const auto& [id, vertex] : image.vertices) {
    vertices_[id.value] = vertex;
    touch(id);
  }
  for (const auto& [id, tet] : image.tets) put(id, tet);
  resize(image.vertex_slots, image.tet_slots);
}

bool JournalMirror::differs(const TetMesh& mesh, VertexId id) const {
  const Vertex& vertex = vertices_[id.value];
  if (vertex.is_live != mesh.is_live(id)) return true;
  return vertex.is_live && !(same(vertex.rest, mesh.rest(id)) && same(vertex.current, mesh.current(id)));
}

bool JournalMirror::differs(const TetMesh& mesh, TetId id) const {
  const Tet& tet = tets_[id.value];
  if (tet.is_live() != mesh.is_live(id)) return true;
  if (!tet.is_live()) return false;
  for (unsigned side = 0; side < 4; ++side) {
    const Link link = mesh.links(id)[side];
    if (tet.opened[side] != 0 && !(link.is_boundary() && link.tag() == tet.opened[side])) return true;
  }
  return tet.vertices != mesh.vertices(id) || tet.region != mesh.region(id);
}

void JournalMirror::expect(bool holds, const char* what) {
  if (!holds && fault_.empty()) fault_ = what;
}

}  // namespace v0
}  // namespace incise
