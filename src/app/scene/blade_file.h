// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "incise/core/result.h"
#include "incise/cut/stroke.h"
#include "incise/io/mesh_data.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Bounds on what a blade file may hold.
inline constexpr std::size_t kMaxBladePoints = 1U << 20U;  ///< points over all times of one stroke

/// A stroke of a blade file, and the regions that its edge is held outside of (`RegionGuard`).
struct BladeStroke {
  Stroke stroke;
  std::vector<std::int32_t> stop_at = {};    ///< by number
  std::vector<std::string> stop_names = {};  ///< and by name
};

/// Parses a blade: JSON `{"format":"incise-blade","version":1,"strokes":[S,…]}`.
///
/// A stroke S is `{"name","edges":[{"t","points":[[x,y,z],…]},…]}`, the cutting edge at increasing times, or
/// `{"name","edge":[[x,y,z],…],"poses":[{"t","position":[x,y,z],"orientation":[w,x,y,z]},…]}`, a rigid edge moved by
/// unit quaternions (within 1e-6; they are normalised). `name` may be left out. Coordinates are the mesh's. `"stop_at"`
/// lists regions by number or name that the edge is held outside of.
/// @param json       the file's content, at most 64 MiB.
/// @param file_name  stands for FILE in messages.
/// @return at least one stroke; each keeps the promises of `Stroke`.
/// Errors: kBadFile "FILE:LINE: PATH what", for instance for an unknown key, one point, times that do not increase, or
/// numbers that are not finite. Cost: O(size). Thread-safe.
[[nodiscard]] Result<std::vector<BladeStroke>> parse_blade_file(std::string_view json, std::string_view file_name);
/// Reads a blade file; see `parse_blade_file`. Errors: also kBadFile where it cannot be opened or is a directory.
[[nodiscard]] Result<std::vector<BladeStroke>> read_blade_file(const std::filesystem::path& path);

/// The strokes alone, for those who know of no regions. Errors: besides kBadFile for one that has `stop_at`.
[[nodiscard]] Result<std::vector<Stroke>> parse_blade(std::string_view json, std::string_view file_name);
[[nodiscard]] Result<std::vector<Stroke>> read_blade(const std::filesystem::path& path);

/// The strokes as the blade may go through a mesh at rest: those that stop at regions are held outside of them.
/// Errors: kBadFile, naming the stroke, for a name or number that no region has, and as `hold_outside`.
[[nodiscard]] Result<std::vector<Stroke>> held_strokes(const std::vector<BladeStroke>& blade, const TetMesh& mesh,
                                                       const io::RegionNames& names);

}  // namespace app
}  // namespace v0
}  // namespace incise
