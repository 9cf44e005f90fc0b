// SPDX-License-Identifier: Apache-2.0
// A step has images of the slots and of the parts of free lists that it changed, from before it and, once undone, from
// after it: undo and redo copy them back, so that the mesh is the same bit for bit.
#include "incise/mesh/journal.h"

#include <algorithm>
#include <utility>

namespace incise {
inline namespace v0 {

void Journal::append(Step step) {
  steps_.resize(position_ - first_);
  step.serial = ++newest_serial_;
  steps_.push_back(std::move(step));
  ++position_;
}

bool Journal::append_if_changed(Step step) {
  if (step.is_empty()) return false;
  append(std::move(step));
  return true;
}

void Journal::take_back(TetMesh& mesh, std::size_t position) noexcept {
  while (position_ > std::max(position, first_)) revert(mesh, steps_[--position_ - first_]);
  while (steps_.size() > position_ - first_) steps_.pop_back();
}

void Journal::trim(std::size_t position) {
  const std::size_t end = std::min(position, position_);
  for (; first_ < end; ++first_) {
    trimmed_serial_ = steps_.front().serial;
    steps_.pop_front();
  }
}

namespace {

template <class... Lists>
std::size_t bytes_of(const Lists&... lists) {
  return (... + (lists.capacity() * sizeof(typename Lists::value_type)));
}

std::size_t bytes_of_image(const StepImage& image) {
  return bytes_of(image.tets, image.sides, image.vertices, image.ties, image.free_tets, image.free_vertices);
}

}  // namespace

std::size_t Journal::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Step& s : steps_) {
    bytes += sizeof(Step) + bytes_of_image(s.before) + bytes_of_image(s.after);
    bytes += bytes_of(s.born, s.moved, s.copied, s.consumed, s.produced, s.rewired, s.opened, s.closed, s.died);
    bytes += bytes_of(s.edits, s.edit_consumed, s.edit_produced, s.new_tets, s.new_vertices, s.gone, s.kept);
  }
  return bytes;
}

namespace {

/// What stands above the first `common` entries of a free list.
std::vector<std::uint32_t> tail(const GrowArray<std::uint32_t>& list, std::size_t common) {
  return {list.begin() + common, list.end()};
}

StepImage image_of(const TetMesh& mesh, const Step& step, const GrowArray<std::uint32_t>& free_tets,
                   const GrowArray<std::uint32_t>& free_vertices) {
  StepImage image;
  const auto keep_tet = [&](TetId id) {
    image.tets.push_back({id, mesh.vertices(id), mesh.links(id), mesh.region(id)});
  };
  const auto keep_vertex = [&](VertexId id) {
    image.vertices.push_back(
        {id, mesh.rest(id), mesh.current(id), mesh.tet_of(id), mesh.origin(id), mesh.shape_of(id)});
  };
  for (const ConsumedTet& old : step.consumed) keep_tet(old.id);
  for (const RewiredTet& tet : step.rewired) keep_tet(tet.id);
  for (const SideImage& old : step.before.sides) image.sides.push_back({old.side, mesh.link(old.side)});
  for (const TetId id : step.new_tets) keep_tet(id);
  for (const VertexImage& old : step.before.vertices) keep_vertex(old.id);
  for (const VertexId id : step.new_vertices) keep_vertex(id);
  for (const TiedVertex& old : step.before.ties) {
    image.ties.push_back({old.id, mesh.tet_of(old.id), mesh.origin(old.id), mesh.shape_of(old.id)});
  }
  image.free_tets = tail(free_tets, step.free_tets_common);
  image.free_vertices = tail(free_vertices, step.free_vertices_common);
  image.tet_slots = mesh.tet_slots();
  image.vertex_slots = mesh.vertex_slots();
  return image;
}

void restore_free_list(GrowArray<std::uint32_t>& list, std::size_t common, const std::vector<std::uint32_t>& above) {
  list.resize(common);
  for (const std::uint32_t slot : above) {
    list.push_back(slot);
  }
}

}  // namespace

bool Journal::undo(TetMesh& mesh) {
  if (position_ == first_) {
    return false;
  }
  Step& step = steps_[position_ - 1 - first_];
  step.after = image_of(mesh, step, mesh.free_tets_, mesh.free_vertices_);
  revert(mesh, step);
  --position_;
  return true;
}

/// Puts all slots back to how they were before a step. Lists only shrink, or grow to where they have been: nothing is
/// allocated.
void Journal::revert(TetMesh& mesh, const Step& step) noexcept {
  for (const TetId id : step.new_tets) {
    if (mesh.is_live(id)) {
      mesh.tet_vertices_[id] = kNoVertices;
      ++mesh.tet_generation_[id];
      --mesh.live_tets_;
    }
  }
  for (const VertexId id : step.new_vertices) {
    if (mesh.is_live(id)) {
      mesh.vertex_shape_[id] = shape::kDead;
      ++mesh.vertex_generation_[id];
      --mesh.live_vertices_;
    }
  }
  restore(mesh, step, step.before);
  give_back_taken(mesh, step);
  for (const RewiredTet& tet : step.rewired) mesh.tet_vertices_[tet.id] = tet.old_vertices;
  for (std::size_t i = 0; i < step.gone.size(); ++i) put(mesh, step.consumed_image(i));
}

/// To the free lists, the last taken first.
void Journal::give_back_taken(TetMesh& mesh, const Step& step) {
  for (std::size_t i = step.free_tets_taken; i-- > 0;) mesh.free_tets_.push_back(step.new_tets[i].value);
  for (std::size_t i = step.free_vertices_taken; i-- > 0;) mesh.free_vertices_.push_back(step.new_vertices[i].value);
}

void Journal::put(TetMesh& mesh, const TetImage& image) {
  const bool was_live = mesh.is_live(image.id);
  mesh.tet_vertices_[image.id] = image.vertices;
  mesh.tet_links_[image.id] = image.links;
  mesh.tet_region_[image.id] = image.region;
  count_change(was_live, mesh.is_live(image.id), mesh.live_tets_, mesh.tet_generation_[image.id]);
}

bool Journal::redo(TetMesh& mesh) {
  if (position_ == size()) {
    return false;
  }
  Step& step = steps_[position_++ - first_];
  restore(mesh, step, step.after);
  return true;
}

void Journal::restore(TetMesh& mesh, const Step& step, const StepImage& image) {
  mesh.tet_vertices_.resize(image.tet_slots);
  mesh.tet_links_.resize(image.tet_slots);
  mesh.tet_region_.resize(image.tet_slots);
  mesh.rest_.resize(image.vertex_slots, Vec3::Zero());
  mesh.current_.resize(image.vertex_slots, Vec3::Zero());
  mesh.vertex_tet_.resize(image.vertex_slots);
  mesh.vertex_origin_.resize(image.vertex_slots);
  mesh.vertex_shape_.resize(image.vertex_slots, shape::kDead);
  for (const TetImage& old : image.tets) put(mesh, old);
  for (const SideImage& old : image.sides) mesh.tet_links_[old.side.tet()][old.side.side()] = old.link;
  for (const VertexImage& old : image.vertices) {
    const bool was_live = mesh.is_live(old.id);
    mesh.rest_[old.id] = old.rest;
    mesh.current_[old.id] = old.current;
    mesh.vertex_tet_[old.id] = old.tet;
    mesh.vertex_origin_[old.id] = old.origin;
    mesh.vertex_shape_[old.id] = old.shape;
    count_change(was_live, mesh.is_live(old.id), mesh.live_vertices_, mesh.vertex_generation_[old.id]);
  }
  for (const TiedVertex& old : image.ties) {
    mesh.vertex_tet_[old.id] = old.tet;
    mesh.vertex_origin_[old.id] = old.origin;
    mesh.vertex_shape_[old.id] = old.shape;
  }
  restore_free_list(mesh.free_tets_, step.free_tets_common, image.free_tets);
  restore_free_list(mesh.free_vertices_, step.free_vertices_common, image.free_vertices);
}

void Journal::count_change(bool was_live, bool is_live, std::size_t& live, std::uint32_t& generation) {
  if (was_live && !is_live) {
    --live;
    ++generation;
  } else if (!was_live && is_live) {
    ++live;
  }
}

}  // namespace v0
}  // namespace incise
