// SPDX-License-Identifier: Apache-2.0
// One pass over slots numbers what is live, and all lists follow from these numbers.
#include "incise/io/mesh_export.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

template <class Visit>
void for_each_boundary_side(const TetMesh& mesh, Visit&& visit) {
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.links(tet)[s].is_boundary()) visit(Side(tet, s));
    }
  });
}

Triangle triangle_of(const TetMesh& mesh, Side side, const std::vector<std::uint32_t>& number) {
  const auto v = mesh.vertices(side);
  return {number[v[0].value], number[v[1].value], number[v[2].value]};
}

std::int32_t origin_of(const TetMesh& mesh, VertexId vertex, const std::vector<std::uint32_t>& file_vertex) {
  const VertexId origin = mesh.origin(vertex);
  if (!origin.is_valid()) return -1;
  return static_cast<std::int32_t>(file_vertex.empty() ? origin.value : file_vertex[origin.value]);
}

}  // namespace

MeshData to_mesh_data(const TetMesh& mesh, const Components& pieces, const std::vector<std::uint32_t>& file_vertex,
                      MeshPose pose) {
  MeshData data;
  std::vector<std::uint32_t> number(mesh.vertex_slots(), kInvalidIndex);
  mesh.for_each_vertex([&](VertexId v) {
    number[v.value] = static_cast<std::uint32_t>(data.soup.points.size());
    data.soup.points.push_back(pose == MeshPose::kAtRest ? mesh.rest(v) : mesh.current(v));
    data.origin_vertex.push_back(origin_of(mesh, v, file_vertex));
  });
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    data.soup.tets.push_back({number[v[0].value], number[v[1].value], number[v[2].value], number[v[3].value]});
    data.soup.regions.push_back(mesh.region(tet));
    data.piece.push_back(static_cast<std::int32_t>(pieces.label[tet.value]));
  });
  for_each_boundary_side(mesh, [&](Side side) {
    const std::uint32_t stroke = mesh.link(side).tag();
    if (stroke == 0) return;
    data.triangles.push_back(triangle_of(mesh, side, number));
    data.triangle_stroke.push_back(static_cast<std::int32_t>(stroke));
  });
  if (data.triangles.empty()) return data;
  mesh.for_each_vertex([&](VertexId v) { data.cut_front.push_back((mesh.shape_of(v) & shape::kFront) != 0 ? 1 : 0); });
  return data;
}

SurfaceSoup to_surface(const TetMesh& mesh) {
  SurfaceSoup surface;
  std::vector<std::uint32_t> number(mesh.vertex_slots(), kInvalidIndex);
  for_each_boundary_side(mesh, [&](Side side) {
    for (const VertexId v : mesh.vertices(side)) {
      if (number[v.value] != kInvalidIndex) continue;
      number[v.value] = static_cast<std::uint32_t>(surface.points.size());
      surface.points.push_back(mesh.rest(v));
    }
    surface.triangles.push_back(triangle_of(mesh, side, number));
  });
  return surface;
}

}  // namespace io
}  // namespace v0
}  // namespace incise
