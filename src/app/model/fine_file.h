// SPDX-License-Identifier: Apache-2.0
// Fine surfaces as files: read to be bound, and written as they are drawn.
#pragma once

#include <filesystem>
#include <string>

#include "app/model/gltf_file.h"
#include "incise/core/result.h"
#include "incise/mesh/embedded_surface.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Reads a triangle surface to be bound to a mesh. Errors: as `io::read_surface`.
[[nodiscard]] Result<FineSurface> read_fine_surface(const std::filesystem::path& path);

/// What is wrong with the name of a file for a drawn surface; empty where it can be written.
[[nodiscard]] std::string drawn_file_problem(const std::filesystem::path& path);

/// Writes a surface as it is drawn: `.glb` as `write_glb` does, other extensions as triangles as the body stands, with
/// texture coordinates in an `.obj`. Errors: as `write_glb` and `io::write_surface`.
[[nodiscard]] Status write_drawn(const std::filesystem::path& path, const GltfBody& body);

}  // namespace app
}  // namespace v0
}  // namespace incise
