// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "incise/core/result.h"
#include "incise/io/mesh_file.h"
#include "incise/mesh/defects.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace io {

/// What a mesh file is, without its arrays.
struct MeshSource {
  std::string file;                ///< its path, as given
  std::string format;              ///< for people, for instance "Gmsh MSH 2.2 ASCII", with "gzipped" where it is
  std::uint64_t vertices = 0;      ///< of the file, mid-edge nodes included
  std::uint64_t tets = 0;          ///< of the file
  bool ten_node = false;           ///< tets had mid-edge nodes
  std::vector<std::string> notes;  ///< what was turned, dropped or left out, in words
};

/// A mesh made fit for cutting.
struct LoadedMesh {
  MeshSource source;                       ///< where it comes from, and what was mended
  TetMesh mesh;                            ///< valid except for the defects that the file has
  std::vector<std::uint32_t> file_vertex;  ///< the file's number of each mesh vertex; empty where they are equal, or
                                           ///< where the file itself names the vertices before its cuts
  RegionNames region_names;                ///< as the file has them; pass them on to `MeshData` when it is written
};

/// Takes the mid-edge nodes of ten-node tets out of a mesh; corners keep their order.
///
/// @return the old number of each point that stays; empty where all stay. Triangles that used a mid-edge node go.
/// Cost: O(n).
std::vector<std::uint32_t> drop_mid_nodes(MeshFile& file);

/// The defects of a file as it stands; mid-edge nodes are no unreferenced vertices. Cost: as `find_defects`.
[[nodiscard]] Defects find_file_defects(const MeshFile& file);

/// Describes a file, `notes` of its reader included. Cost: O(1).
[[nodiscard]] MeshSource describe(const MeshFile& file, const std::filesystem::path& path);

/// Makes a mesh of what a file holds: mid-edge nodes left out, negative tets turned, exact duplicates dropped, all said
/// in the notes. Walls, their strokes, where cuts end and origins of vertices are taken where the file is a cut mesh
/// that Incise wrote. Errors: as `TetMesh::build`, naming the file. Cost: O(n log n).
[[nodiscard]] Result<LoadedMesh> build_mesh(MeshFile file, const std::filesystem::path& path);

/// Reads and builds. `own`: formats of one's own. Errors: as `read_mesh` and `build_mesh`.
[[nodiscard]] Result<LoadedMesh> load_mesh(const std::filesystem::path& path, const std::vector<MeshFormat>& own = {});

}  // namespace io
}  // namespace v0
}  // namespace incise
