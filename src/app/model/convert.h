// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "incise/core/result.h"
#include "incise/io/mesh_file.h"
#include "incise/io/surface_file.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Whether `io::write_mesh` knows the extension, `.gz` aside. Cost: O(1).
[[nodiscard]] bool is_mesh_extension(const std::filesystem::path& path);
/// Whether `io::write_surface` knows the extension, `.gz` aside. Cost: O(1).
[[nodiscard]] bool is_surface_extension(const std::filesystem::path& path);
/// The extensions of both, for messages.
[[nodiscard]] std::string mesh_extensions();
inline constexpr const char* kSurfaceExtensions = ".obj .stl .ply .off";

/// What a conversion has to tell.
struct Conversion {
  std::vector<std::string> notes;            ///< what was left out, in words
  std::vector<std::filesystem::path> files;  ///< that were written
  std::uint64_t vertices = 0;                ///< that were written, like the following
  std::uint64_t tets = 0;                    ///< 0 for a surface
  std::uint64_t triangles = 0;               ///< of a surface, or with labels in a mesh
};

/// A surface that is to be written, from a surface or as the boundary of a mesh.
struct BoundaryOf {
  io::SurfaceSoup surface;
  std::vector<std::string> notes;  ///< what was left out, in words
};

/// Reads a mesh, of which the boundary is taken, or a surface. Of /dev/stdin the content says which it is.
/// Errors: as the readers. Cost: O(n).
[[nodiscard]] Result<BoundaryOf> read_boundary(const std::filesystem::path& in);

/// Converts mesh to mesh as it stands, mesh to surface (its boundary), or surface to surface.
///
/// Ten-node tets keep their corners.
/// @param before_writing  called once all has been read; may be empty
/// @param options  how a mesh is written; an extension there makes `out` a mesh, whatever its own.
/// Errors: as the readers and writers; kBadArgument for an extension that cannot be written, or a surface where a mesh
/// is asked for. Cost: O(n).
[[nodiscard]] Result<Conversion> convert(const std::filesystem::path& in, const std::filesystem::path& out,
                                         const io::WriteOptions& options = {},
                                         const std::function<void()>& before_writing = {});

}  // namespace app
}  // namespace v0
}  // namespace incise
