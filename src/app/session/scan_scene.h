// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/model/organ.h"
#include "app/scene/scene.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A scan as a body that can be cut.
struct ScanScene {
  Scene scene;                     ///< in millimetres, with gravity, a table, and materials by the regions' names
  std::filesystem::path mesh;      ///< the file that the scene names
  std::vector<std::string> notes;  ///< of reading and meshing, and which regions are made of what
};

/// Meshes a scan or a surface and writes the mesh, from which the scene, its recordings and its replays begin.
///
/// Regions whose names speak of a tissue (`tissue_of_region_name`) are made of it, the others of soft tissue.
/// @param mesh  where the mesh goes; empty: a file in the system's folder for temporary files, named after the scan and
///              how it is meshed.
/// @param up    unit: against gravity. Errors: as `read_organ`, `mesh_organ` and `io::write_mesh`.
[[nodiscard]] Result<ScanScene> make_scan_scene(const OrganJob& job, std::filesystem::path mesh, const Vec3& up);

}  // namespace app
}  // namespace v0
}  // namespace incise
