// SPDX-License-Identifier: Apache-2.0
// Before a slot changes for the first time its image is kept; marks tell which slots are touched or new. Rollback puts
// the images back, commit makes a step of them (docs/internals.md, 2).
#include "incise/mesh/transaction.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <memory>
#include <type_traits>

namespace incise {
inline namespace v0 {

namespace {

constexpr std::uint32_t kTouched = 1;
constexpr std::uint32_t kFirstNew = 2;
constexpr std::size_t kMostKept = std::size_t{1} << 16U;  // records of a list that keeps its memory

template <class Records, class Holds>
std::size_t count_of(const Records& records, const Holds& holds) {
  return static_cast<std::size_t>(std::count_if(records.begin(), records.end(), holds));
}

/// Notes what a free list lacks, given highest first: as a rule that is what was taken first, and told by its count.
template <class Id>
std::size_t record_free(const std::vector<std::uint32_t>& lacking, const std::vector<Id>& taken,
                        std::vector<std::uint32_t>& above) {
  const bool is_taken_first =
      lacking.size() <= taken.size() && std::equal(lacking.begin(), lacking.end(), taken.begin(),
                                                   [](std::uint32_t slot, Id id) { return slot == id.value; });
  if (is_taken_first) return lacking.size();
  above.assign(lacking.rbegin(), lacking.rend());
  return 0;
}

/// Bit for bit: zeros differ by their sign.
bool is_same(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

}  // namespace

namespace detail {

void TransactionLists::clear() noexcept {
  const auto clear = [](auto& list) {
    if (list.capacity() > kMostKept) std::remove_reference_t<decltype(list)>().swap(list);
    list.clear();
  };
  const auto empty = [&](auto&... lists) { (clear(lists), ...); };
  empty(parents, removed_tets, removed_vertices, opened);
  empty(step.born, step.moved, step.copied, step.edits, step.edit_consumed, step.edit_produced);
  empty(step.before.tets, step.before.vertices, step.before.free_tets, step.before.free_vertices);
  empty(step.new_tets, step.new_vertices);
}

TransactionLists& OwnLists::get() {
  if (!lists_) lists_ = std::make_shared<TransactionLists>();
  return *lists_;
}

}  // namespace detail

Transaction::Transaction(TetMesh& mesh, bool keeps_edits)
    : mesh_(mesh),
      lists_(mesh.edit_lists_.get()),
      step_(lists_.step),
      tet_mark_(mesh.edit_tet_marks_),
      vertex_mark_(mesh.edit_vertex_marks_),
      keeps_edits_(keeps_edits) {
  tet_mark_.ensure(mesh.tet_slots());
  vertex_mark_.ensure(mesh.vertex_slots());
  step_.before.tet_slots = mesh.tet_slots();
  step_.before.vertex_slots = mesh.vertex_slots();
  step_.free_tets_common = mesh.free_tets_.size();
  step_.free_vertices_common = mesh.free_vertices_.size();
}

Transaction::~Transaction() {
  if (is_open_) {
    rollback();
  }
}

void Transaction::touch(TetId tet) {
  if (tet_mark_[tet.value] == 0) {
    step_.before.tets.push_back({tet, mesh_.tet_vertices_[tet], mesh_.tet_links_[tet], mesh_.tet_region_[tet]});
    tet_mark_[tet.value] = kTouched;
  }
}

void Transaction::touch(VertexId vertex) {
  if (vertex_mark_[vertex.value] == 0) {
    step_.before.vertices.push_back({vertex, mesh_.rest_[vertex], mesh_.current_[vertex], mesh_.vertex_tet_[vertex],
                                     mesh_.vertex_origin_[vertex], mesh_.vertex_shape_[vertex]});
    vertex_mark_[vertex.value] = kTouched;
  }
}

std::uint32_t Transaction::take_tet_slot() {
  std::uint32_t slot = 0;
  if (mesh_.free_tets_.empty()) {
    slot = append_tet_slot();
  } else {
    slot = pop_free_slot(mesh_.free_tets_, step_.free_tets_common, step_.before.free_tets);
  }
  note_taken(TetId(slot));
  return slot;
}

/// Takes the last slot of a free list; what is part of the list as it was goes to `before`.
std::uint32_t Transaction::pop_free_slot(GrowArray<std::uint32_t>& free, std::size_t& common,
                                         std::vector<std::uint32_t>& before) {
  const std::uint32_t slot = free.back();
  if (free.size() == common) {
    before.push_back(slot);
    --common;
  }
  free.pop_back();
  return slot;
}

std::uint32_t Transaction::append_tet_slot() {
  const std::uint32_t slot = mesh_.tet_slots();
  mesh_.tet_vertices_.push_back(kNoVertices);
  mesh_.tet_links_.push_back({});
  mesh_.tet_region_.push_back(0);
  if (mesh_.tet_generation_.size() <= slot) {
    mesh_.tet_generation_.push_back(0);
  }
  return slot;
}

void Transaction::note_taken(TetId tet) {
  tet_mark_.ensure(std::size_t{tet.value} + 1);
  step_.new_tets.push_back(tet);
  tet_mark_[tet.value] = kFirstNew - 1 + static_cast<std::uint32_t>(step_.new_tets.size());
}

std::uint32_t Transaction::take_vertex_slot() {
  std::uint32_t slot = 0;
  if (mesh_.free_vertices_.empty()) {
    slot = mesh_.vertex_slots();
    mesh_.rest_.push_back(Vec3::Zero());
    mesh_.current_.push_back(Vec3::Zero());
    mesh_.vertex_tet_.push_back({});
    mesh_.vertex_origin_.push_back({});
    mesh_.vertex_shape_.push_back(0);
    if (mesh_.vertex_generation_.size() <= slot) {
      mesh_.vertex_generation_.push_back(0);
    }
  } else {
    slot = pop_free_slot(mesh_.free_vertices_, step_.free_vertices_common, step_.before.free_vertices);
  }
  note_taken(VertexId(slot));
  ++mesh_.live_vertices_;
  return slot;
}

void Transaction::note_taken(VertexId vertex) {
  vertex_mark_.ensure(std::size_t{vertex.value} + 1);
  step_.new_vertices.push_back(vertex);
  vertex_mark_[vertex.value] = kFirstNew - 1 + static_cast<std::uint32_t>(step_.new_vertices.size());
}

/// Takes a slot out of the middle of a free list; what stood above it, as it was, goes to `before`, the highest first.
void Transaction::take_free_slot(std::uint32_t slot, GrowArray<std::uint32_t>& free, std::size_t& common,
                                 std::vector<std::uint32_t>& before) {
  std::size_t at = free.size();
  while (free[--at] != slot) assert(at > 0);
  for (; common > at; --common) before.push_back(free[common - 1]);
  std::copy(free.begin() + at + 1, free.end(), free.begin() + at);
  free.pop_back();
}

void Transaction::revive_tet(const TetImage& image, TetId parent) {
  take_free_slot(image.id.value, mesh_.free_tets_, step_.free_tets_common, step_.before.free_tets);
  note_taken(image.id);
  lists_.parents.push_back(parent);
  mesh_.tet_vertices_[image.id] = image.vertices;
  mesh_.tet_links_[image.id] = {};
  mesh_.tet_region_[image.id] = image.region;
  ++mesh_.live_tets_;
}

void Transaction::revive_vertex(const VertexImage& image, std::span<const VertexId> parents,
                                std::span<const double> weights, const Vec3& current) {
  take_free_slot(image.id.value, mesh_.free_vertices_, step_.free_vertices_common, step_.before.free_vertices);
  note_taken(image.id);
  ++mesh_.live_vertices_;
  mesh_.rest_[image.id] = image.rest;
  mesh_.current_[image.id] = current;
  mesh_.vertex_tet_[image.id] = image.tet;
  mesh_.vertex_origin_[image.id] = image.origin;
  mesh_.vertex_shape_[image.id] = image.shape;
  record_born(image.id, parents, weights);
}

void Transaction::record_born(VertexId id, std::span<const VertexId> parents, std::span<const double> weights) {
  assert(parents.size() == weights.size() && !parents.empty() && parents.size() <= 4);
  BornVertex record{id, {}, {}, mesh_.rest_[id], mesh_.current_[id]};
  std::copy(parents.begin(), parents.end(), record.parents.begin());
  std::copy(weights.begin(), weights.end(), record.weights.begin());
  step_.born.push_back(record);
}

VertexId Transaction::add_vertex(std::span<const VertexId> parents, std::span<const double> weights, const Vec3& rest,
                                 const Vec3& current) {
  const VertexId id(take_vertex_slot());
  mesh_.rest_[id] = rest;
  mesh_.current_[id] = current;
  mesh_.vertex_tet_[id] = TetId();
  mesh_.vertex_origin_[id] = VertexId();
  mesh_.vertex_shape_[id] = 0;
  record_born(id, parents, weights);
  return id;
}

VertexId Transaction::add_vertex_on_edge(VertexId a, VertexId b, double t) {
  const std::array<VertexId, 2> parents = {a, b};
  const std::array<double, 2> weights = {1.0 - t, t};
  const Vec3 rest = mesh_.rest_[a] + t * (mesh_.rest_[b] - mesh_.rest_[a]);
  const Vec3 current = mesh_.current_[a] + t * (mesh_.current_[b] - mesh_.current_[a]);
  return add_vertex(parents, weights, rest, current);
}

VertexId Transaction::copy_vertex(VertexId source) {
  const VertexId id(take_vertex_slot());
  mesh_.rest_[id] = mesh_.rest_[source];
  mesh_.current_[id] = mesh_.current_[source];
  mesh_.vertex_tet_[id] = TetId();
  mesh_.vertex_origin_[id] = mesh_.vertex_origin_[source];
  mesh_.vertex_shape_[id] = mesh_.vertex_shape_[source];
  step_.copied.push_back({id, source});
  return id;
}

TetId Transaction::add_tet(const TetVertices& vertices, TetId parent) {
  const TetId id(take_tet_slot());
  fill_tet(id, vertices, parent);
  return id;
}

TetId Transaction::add_tet_beside(const TetVertices& vertices, TetId parent, std::span<const TetId> reserved) {
  const GrowArray<std::uint32_t>& free = mesh_.free_tets_;
  std::size_t at = free.size();
  while (at > 0 && std::binary_search(reserved.begin(), reserved.end(), TetId(free[at - 1]))) --at;
  const TetId id(at > 0 ? free[at - 1] : append_tet_slot());
  if (at > 0) take_free_slot(id.value, mesh_.free_tets_, step_.free_tets_common, step_.before.free_tets);
  note_taken(id);
  fill_tet(id, vertices, parent);
  return id;
}

void Transaction::fill_tet(TetId id, const TetVertices& vertices, TetId parent) {
  lists_.parents.push_back(parent);
  mesh_.tet_vertices_[id] = vertices;
  mesh_.tet_links_[id] = {};
  mesh_.tet_region_[id] = mesh_.tet_region_[parent];
  ++mesh_.live_tets_;
}

void Transaction::remove_tet(TetId tet) {
  touch(tet);
  lists_.removed_tets.push_back(tet);
  mesh_.tet_vertices_[tet] = kNoVertices;
  ++mesh_.tet_generation_[tet];
  --mesh_.live_tets_;
}

void Transaction::remove_vertex(VertexId vertex) {
  touch(vertex);
  lists_.removed_vertices.push_back(vertex);
  mesh_.vertex_shape_[vertex] = shape::kDead;
  mesh_.vertex_tet_[vertex] = TetId();
  ++mesh_.vertex_generation_[vertex];
  --mesh_.live_vertices_;
}

void Transaction::set_link(Side side, Link link) {
  touch(side.tet());
  mesh_.tet_links_[side.tet()][side.side()] = link;
}

void Transaction::join(Side a, Side b) {
  set_link(a, Link(b));
  set_link(b, Link(a));
}

void Transaction::open(Side a, Side b, std::uint32_t tag) {
  set_link(a, Link::boundary(tag));
  set_link(b, Link::boundary(tag));
  lists_.opened.push_back({a, b, tag});
}

void Transaction::set_corner(TetId tet, unsigned corner, VertexId vertex) {
  touch(tet);
  mesh_.tet_vertices_[tet][corner] = vertex;
}

void Transaction::set_tet_of(VertexId vertex, TetId tet) {
  touch(vertex);
  mesh_.vertex_tet_[vertex] = tet;
}

void Transaction::set_shape(VertexId vertex, std::uint8_t bits) {
  touch(vertex);
  mesh_.vertex_shape_[vertex] = bits;
}

void Transaction::set_origin(VertexId vertex, VertexId origin) {
  assert(vertex_mark_[vertex.value] >= kFirstNew);
  mesh_.vertex_origin_[vertex] = origin;
}

Vec3 current_after_move(const TetMesh& mesh, VertexId vertex, const Vec3& rest, const TetVertices& basis,
                        const std::array<double, 4>& weights) {
  bool is_at_rest = mesh.current(vertex) == mesh.rest(vertex);
  Vec3 current = Vec3::Zero();
  for (unsigned c = 0; c < 4; ++c) {
    is_at_rest = is_at_rest && mesh.current(basis[c]) == mesh.rest(basis[c]);
    current += weights[c] * mesh.current(basis[c]);
  }
  return is_at_rest ? rest : current;
}

void Transaction::move(VertexId vertex, const Vec3& rest, const TetVertices& basis,
                       const std::array<double, 4>& weights) {
  touch(vertex);
  const Vec3 current = current_after_move(mesh_, vertex, rest, basis, weights);
  if (keeps_edits_) {
    note_edit(Edit::Kind::kMove, static_cast<std::uint32_t>(step_.moved.size()));
  }
  step_.moved.push_back({vertex, basis, weights, mesh_.rest_[vertex], rest, mesh_.current_[vertex], current});
  mesh_.rest_[vertex] = rest;
  mesh_.current_[vertex] = current;
}

void Transaction::note_edit(Edit::Kind kind, std::uint32_t vertex) {
  step_.edits.push_back({kind, vertex, static_cast<std::uint32_t>(step_.edit_consumed.size()),
                         static_cast<std::uint32_t>(step_.edit_produced.size())});
}

void Transaction::note_consumed(std::span<const TetId> tets) {
  for (std::size_t i = 0; keeps_edits_ && i < tets.size(); ++i) {
    step_.edit_consumed.push_back({tets[i], mesh_.tet_vertices_[tets[i]]});
  }
}

void Transaction::note_produced(std::span<const TetId> tets, std::span<const TetId> parents, VertexId born) {
  if (!keeps_edits_) {
    return;
  }
  for (std::size_t i = 0; i < tets.size(); ++i) {
    step_.edit_produced.push_back({tets[i], parents[i], mesh_.tet_vertices_[tets[i]], mesh_.tet_region_[tets[i]]});
  }
  note_edit(Edit::Kind::kRemesh,
            born.is_valid() ? static_cast<std::uint32_t>(step_.born.size() - 1) : std::uint32_t{kInvalidIndex});
}

TetId Transaction::root_parent(TetId tet) const {
  while (tet_mark_[tet.value] >= kFirstNew) {
    tet = lists_.parents[tet_mark_[tet.value] - kFirstNew];
  }
  return tet;
}

/// Calls `visit(side)` for each side of a tet that lives on which has another neighbour now.
template <class Visit>
void Transaction::for_each_new_link(const TetImage& old, Visit&& visit) const {
  const TetLinks& now = mesh_.tet_links_[old.id];
  for (unsigned s = 0; s < 4; ++s) {
    if (now[s] != old.links[s]) visit(Side(old.id, s));
  }
}

void Transaction::record_kept(Step& made) const {
  const auto lives_on = [this](const TetImage& old) { return mesh_.is_live(old.id); };
  std::size_t sides = 0;
  for (const TetImage& old : step_.before.tets) {
    if (lives_on(old)) for_each_new_link(old, [&](Side) { ++sides; });
  }
  made.kept.reserve(count_of(step_.before.tets, lives_on));
  made.before.sides.reserve(sides);
  made.rewired.reserve(count_of(step_.before.tets, [&](const TetImage& old) {
    return lives_on(old) && mesh_.tet_vertices_[old.id] != old.vertices;
  }));
  for (const TetImage& old : step_.before.tets) {
    if (!lives_on(old)) continue;
    made.kept.push_back(old.id);
    for_each_new_link(old, [&](Side side) { made.before.sides.push_back({side, old.links[side.side()]}); });
    const TetVertices& now = mesh_.tet_vertices_[old.id];
    if (now != old.vertices) made.rewired.push_back({old.id, old.vertices, now});
  }
}

void Transaction::record_consumed(Step& made) const {
  const auto is_gone = [this](const TetImage& old) { return !mesh_.is_live(old.id); };
  const std::size_t count = count_of(step_.before.tets, is_gone);
  made.consumed.reserve(count);
  made.gone.reserve(count);
  for (const TetImage& old : step_.before.tets) {
    if (!is_gone(old)) continue;
    made.consumed.push_back({old.id, old.vertices});
    made.gone.push_back({old.links, old.region});
  }
}

void Transaction::record_produced(Step& made) const {
  const auto is_made = [this](TetId id) { return mesh_.is_live(id); };
  made.produced.reserve(count_of(step_.new_tets, is_made));
  for (const TetId id : step_.new_tets) {
    if (is_made(id)) made.produced.push_back({id, root_parent(id), mesh_.tet_vertices_[id], mesh_.tet_region_[id]});
  }
}

void Transaction::record_vertices(Step& made) const {
  const auto is_tied = [this](const VertexImage& old) {
    return mesh_.is_live(old.id) && is_same(old.rest, mesh_.rest_[old.id]) &&
           is_same(old.current, mesh_.current_[old.id]);
  };
  const std::size_t ties = count_of(step_.before.vertices, is_tied);
  made.before.ties.reserve(ties);
  made.before.vertices.reserve(step_.before.vertices.size() - ties);
  for (const VertexImage& old : step_.before.vertices) {
    if (is_tied(old)) {
      made.before.ties.push_back({old.id, old.tet, old.origin, old.shape});
    } else {
      made.before.vertices.push_back(old);
    }
  }
  made.died = lists_.removed_vertices;  // those born in the step too: other births may name them as parents
}

void Transaction::record_opened(Step& made) const {
  const auto is_wall = [this](const OpenedFace& face) {
    const auto has_tag = [&](Side side) {
      return mesh_.is_live(side.tet()) && mesh_.link(side) == Link::boundary(face.tag);
    };
    return has_tag(face.a) && has_tag(face.b);
  };
  made.opened.reserve(count_of(lists_.opened, is_wall));
  for (const OpenedFace& face : lists_.opened) {
    if (is_wall(face)) made.opened.push_back(face);
  }
}

/// Walls of tets that live on which have a neighbour now.
void Transaction::record_closed(Step& made) const {
  for (const TetImage& old : step_.before.tets) {
    if (!mesh_.is_live(old.id)) continue;
    for (unsigned s = 0; s < 4; ++s) {
      const Link before = old.links[s], now = mesh_.links(old.id)[s];
      if (before.is_boundary() && before.tag() != 0 && !now.is_boundary()) {
        made.closed.push_back({Side(old.id, s), now.side(), before.tag()});
      }
    }
  }
}

/// What is kept as it was noted.
void Transaction::record_notes(Step& made) const {
  made.born = step_.born;
  made.moved = step_.moved;
  made.copied = step_.copied;
  made.edits = step_.edits;
  made.edit_consumed = step_.edit_consumed;
  made.edit_produced = step_.edit_produced;
  made.new_tets = step_.new_tets;
  made.new_vertices = step_.new_vertices;
  made.free_tets_common = step_.free_tets_common;
  made.free_vertices_common = step_.free_vertices_common;
  made.before.tet_slots = step_.before.tet_slots;
  made.before.vertex_slots = step_.before.vertex_slots;
  made.free_tets_taken = record_free(step_.before.free_tets, step_.new_tets, made.before.free_tets);
  made.free_vertices_taken = record_free(step_.before.free_vertices, step_.new_vertices, made.before.free_vertices);
}

void Transaction::release_slots() {
  for (const TetId tet : lists_.removed_tets) {
    mesh_.free_tets_.push_back(tet.value);
  }
  for (const VertexId vertex : lists_.removed_vertices) {
    mesh_.free_vertices_.push_back(vertex.value);
  }
}

void Transaction::clear_marks() {
  for (const TetImage& old : step_.before.tets) tet_mark_[old.id.value] = 0;
  for (const TetId id : step_.new_tets) tet_mark_[id.value] = 0;
  for (const VertexImage& old : step_.before.vertices) vertex_mark_[old.id.value] = 0;
  for (const VertexId id : step_.new_vertices) vertex_mark_[id.value] = 0;
}

Step Transaction::commit() {
  assert(is_open_);
  Step made;
  record_consumed(made);
  record_kept(made);
  record_produced(made);
  record_vertices(made);
  record_opened(made);
  record_closed(made);
  record_notes(made);
  release_slots();
  close();
  return made;
}

void Transaction::rollback() noexcept {
  if (!is_open_) {
    return;
  }
  std::reverse(step_.before.free_tets.begin(), step_.before.free_tets.end());
  std::reverse(step_.before.free_vertices.begin(), step_.before.free_vertices.end());
  Journal::revert(mesh_, step_);
  close();
}

/// From here on nothing can fail.
void Transaction::close() noexcept {
  is_open_ = false;
  clear_marks();
  lists_.clear();
}

}  // namespace v0
}  // namespace incise
