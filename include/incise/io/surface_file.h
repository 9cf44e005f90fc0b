// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "incise/core/result.h"
#include "incise/io/mesh_data.h"
#include "incise/io/mesh_file.h"
#include "incise/mesh/embedded_surface.h"

namespace incise {
inline namespace v0 {
namespace io {

/// Read a triangle surface: .stl (ASCII and binary), .ply, .off by content; .obj otherwise. Also gzipped.
///
/// Polygons are cut into fans. Of an `.obj` texture coordinates and normals are kept. STL holds three points per
/// triangle: see `weld`. Errors: as `read_mesh`. Cost: O(n).
[[nodiscard]] Result<SurfaceSoup> read_surface(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Read a surface from memory, as `read_surface` does.
[[nodiscard]] Result<SurfaceSoup> read_surface_bytes(std::string_view bytes, const std::string& name = "surface",
                                                     const ReadLimits& limits = {});

/// Write a surface as `.obj`, `.stl` (binary, single precision), `.ply` (ASCII) or `.off`, also with `.gz`.
///
/// All but `.stl` read back bit for bit; texture coordinates and normals go into `.obj` alone. Errors and safety: as
/// `write_mesh`.
[[nodiscard]] Status write_surface(const std::filesystem::path& path, const SurfaceSoup& surface);

/// Make the bytes of a surface's file in memory.
///
/// @param extension  ".obj", ".stl", ".ply" or ".off"; nothing is gzipped.
/// Errors: `kBadArgument` for other extensions and vertex numbers out of range; `kOutOfMemory`. Cost: O(n).
/// Thread-safe.
[[nodiscard]] Result<std::string> write_surface_bytes(std::string_view extension, const SurfaceSoup& surface);

/// Merge points of exactly equal coordinates; the first of each stays, in order.
///
/// @return how many points went. Cost: O(n log n).
std::size_t weld(SurfaceSoup& surface);

/// What an `EmbeddedSurface` binds: corners of one place, texture coordinate and normal become one point. Normals are
/// taken where every corner has one that is not zero. Cost: O(n log n).
[[nodiscard]] FineSurface to_fine_surface(const SurfaceSoup& surface);

}  // namespace io
}  // namespace v0
}  // namespace incise
