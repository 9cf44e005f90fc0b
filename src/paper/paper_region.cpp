// SPDX-License-Identifier: Apache-2.0
// Sets of vertices and tets as sorted lists without repeats: the order of everything that maintenance does.
#include "paper/paper_region.h"

#include <algorithm>

#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {
namespace paper {

namespace {

template <class Id>
void make_set(std::vector<Id>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

std::vector<VertexId> find_divided_vertices(const TetMesh& mesh, const Journal& journal, std::size_t first_step) {
  std::vector<VertexId> vertices;
  for (std::size_t i = first_step; i < journal.position(); ++i) {
    const Step& step = journal.step(i);
    for (const BornVertex& born : step.born) vertices.push_back(born.id);
    for (const MovedVertex& moved : step.moved) vertices.push_back(moved.id);
    for (const CopiedVertex& copied : step.copied) vertices.insert(vertices.end(), {copied.id, copied.source});
  }
  std::erase_if(vertices, [&](VertexId v) { return !mesh.is_live(v); });
  make_set(vertices);
  return vertices;
}

std::vector<VertexId> find_live(const TetMesh& mesh, const std::vector<std::pair<VertexId, std::uint32_t>>& vertices) {
  std::vector<VertexId> live;
  for (const auto& [vertex, generation] : vertices) {
    if (mesh.is_live(vertex) && mesh.generation(vertex) == generation) live.push_back(vertex);
  }
  return live;
}

std::vector<VertexId> find_all_vertices(const TetMesh& mesh) {
  std::vector<VertexId> vertices;
  mesh.for_each_vertex([&](VertexId v) { vertices.push_back(v); });
  return vertices;
}

std::vector<TetId> find_tets_at(const TetMesh& mesh, const std::vector<VertexId>& vertices) {
  std::vector<TetId> tets;
  StarWalker walker;
  for (const VertexId v : vertices) {
    if (mesh.is_live(v)) {
      const std::vector<TetId>& star = walker.star(mesh, v);
      tets.insert(tets.end(), star.begin(), star.end());
    }
  }
  make_set(tets);
  return tets;
}

std::vector<VertexId> find_corners_of(const TetMesh& mesh, const std::vector<TetId>& tets) {
  std::vector<VertexId> vertices;
  for (const TetId tet : tets) {
    const TetVertices& corners = mesh.vertices(tet);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  make_set(vertices);
  return vertices;
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
