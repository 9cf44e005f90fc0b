// SPDX-License-Identifier: Apache-2.0
#include "floor_kernel.h"

#include <cstring>

namespace incise::bench {

namespace {

/// The most tets and vertices that a step through a body adds: the arrays have room for a stroke of them.
constexpr std::size_t kRoom = 200'000;

template <class List>
std::size_t bytes_of(const List& list) {
  return list.size() * sizeof(typename List::value_type);
}

}  // namespace

FloorKernel::FloorKernel(const TetMesh& mesh)
    : vertices_(mesh.tet_slots() + kRoom),
      links_(mesh.tet_slots() + kRoom),
      regions_(mesh.tet_slots() + kRoom),
      generations_(mesh.tet_slots() + kRoom),
      rest_(mesh.vertex_slots() + kRoom, Vec3::Zero()),
      current_(mesh.vertex_slots() + kRoom, Vec3::Zero()),
      tet_of_(mesh.vertex_slots() + kRoom),
      origins_(mesh.vertex_slots() + kRoom),
      shapes_(mesh.vertex_slots() + kRoom) {}

template <class... Lists>
void FloorKernel::keep(const Lists&... lists) {
  const std::size_t bytes = (... + bytes_of(lists));
  auto record = std::unique_ptr<std::byte[]>(new std::byte[bytes]);  // not set to zero: that would write it twice
  std::byte* at = record.get();
  const auto write = [&](const auto& list) {
    if (!list.empty()) std::memcpy(at, list.data(), bytes_of(list));
    at += bytes_of(list);
  };
  (write(lists), ...);
  records_.push_back(std::move(record));
  journal_bytes_ += bytes;
}

void FloorKernel::set_tet(const TetMesh& mesh, TetId tet) {
  if (tet.value >= vertices_.size() || tet.value >= mesh.tet_slots()) return;
  vertices_[tet.value] = mesh.vertices(tet);
  links_[tet.value] = mesh.links(tet);
  regions_[tet.value] = mesh.region(tet);
  ++generations_[tet.value];
}

void FloorKernel::set_vertex(const TetMesh& mesh, VertexId vertex) {
  if (vertex.value >= rest_.size() || vertex.value >= mesh.vertex_slots()) return;
  rest_[vertex.value] = mesh.rest(vertex);
  current_[vertex.value] = mesh.current(vertex);
  tet_of_[vertex.value] = mesh.tet_of(vertex);
  origins_[vertex.value] = mesh.origin(vertex);
  shapes_[vertex.value] = mesh.shape_of(vertex);
}

void FloorKernel::write(const Journal& journal, std::size_t from, std::size_t to, const TetMesh& mesh) {
  for (std::size_t i = from; i < to; ++i) {
    const Step& s = journal.step(i);
    keep(s.born, s.moved, s.copied, s.consumed, s.produced, s.rewired, s.opened, s.closed, s.died, s.edits,
         s.edit_consumed, s.edit_produced, s.new_tets, s.new_vertices, s.gone, s.kept, s.before.sides,
         s.before.vertices, s.before.ties, s.before.free_tets, s.before.free_vertices);
    s.for_each_tet_before([&](TetId tet) { set_tet(mesh, tet); });
    for (const TetId tet : s.new_tets) set_tet(mesh, tet);
    s.for_each_vertex_before([&](VertexId vertex) { set_vertex(mesh, vertex); });
    for (const VertexId vertex : s.new_vertices) set_vertex(mesh, vertex);
  }
}

}  // namespace incise::bench
