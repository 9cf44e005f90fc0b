// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "incise/io/mesh_data.h"
#include "incise/mesh/components.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace io {

/// Which of its two positions a vertex has in a file.
enum class MeshPose : std::uint8_t { kAtRest, kAsItStands };

/// Packs a mesh for a file: live vertices and tets in the order of their slots; region and piece per tet; a
/// triangle with its stroke's number for every side of a cut wall; the input's number of each vertex, -1 where a cut
/// made it; where there are walls, the vertices at which a cut ends.
///
/// @param pieces       of this mesh.
/// @param file_vertex  as in `LoadedMesh`: the file's number of each input vertex, or empty.
/// Cost: O(slots).
[[nodiscard]] MeshData to_mesh_data(const TetMesh& mesh, const Components& pieces,
                                    const std::vector<std::uint32_t>& file_vertex = {},
                                    MeshPose pose = MeshPose::kAtRest);

/// The boundary of a mesh, skin and cut walls, as triangles that turn counter-clockwise seen from outside.
/// Cost: O(slots).
[[nodiscard]] SurfaceSoup to_surface(const TetMesh& mesh);

}  // namespace io
}  // namespace v0
}  // namespace incise
