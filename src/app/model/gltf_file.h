// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "incise/core/result.h"
#include "incise/mesh/drawn_surface.h"

namespace incise {
inline namespace v0 {
namespace app {

/// How a body stood at a moment, by the points of the surface that is written.
struct GltfMoment {
  double seconds = 0;           ///< increasing from one moment to the next
  std::vector<Vec3> positions;  ///< per point, length unit
};

/// What goes into a glTF file.
struct GltfBody {
  DrawnSurface surface;             ///< its triangles and texture coordinates
  std::vector<Vec3> positions;      ///< per point: as the body stands, length unit
  std::vector<Vec3> normals;        ///< per point: unit length
  double metres_per_unit = 1;       ///< glTF is in metres
  std::vector<GltfMoment> moments;  ///< of an animation; empty: none
  std::string name = "body";        ///< of its node
};

/// The bytes of a binary glTF 2.0 file: one mesh with a primitive and a material each for skin and walls (left out
/// where there are none), positions, normals and texture coordinates. Points of walls have their places at rest as
/// well, as the attribute `_REST`. Each moment is a morph target, and an animation goes from one to the next; the mesh
/// itself is the body at the first moment, or as it stands. Single precision. Cost: O(points · moments).
[[nodiscard]] std::string to_glb(const GltfBody& body);

/// Writes it beside its place, then renames. Errors: kIo.
[[nodiscard]] Status write_glb(const std::filesystem::path& path, const GltfBody& body);

}  // namespace app
}  // namespace v0
}  // namespace incise
