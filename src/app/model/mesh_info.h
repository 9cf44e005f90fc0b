// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "incise/geom/vec.h"
#include "incise/io/mesh_loader.h"
#include "incise/mesh/defects.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/validate.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What is in a mesh file, and what is wrong with it: `incise info`.
struct MeshInfo {
  io::MeshSource source;
  std::vector<std::pair<std::int32_t, std::uint64_t>> regions;  ///< label and tets, rising
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();                 ///< of the points that tets use, length units
  double volume = 0;                                            ///< sum of |V|, cubed length units
  Defects defects;                                              ///< of the file as it stands
};

/// Whether a mesh can be relied on, and how good its tets are: `incise check`.
struct MeshCheck {
  MeshInfo info;
  QualityStats quality;     ///< of the mesh with negative tets turned and duplicates dropped
  ValidityReport validity;  ///< likewise
  /// No defect of the file breaks the validity contract. Equal positions alone do not: cut walls have them.
  bool ok = false;
};

/// Looks at a file's content. Cost: as `find_defects`.
[[nodiscard]] MeshInfo inspect(const io::MeshFile& file, const std::filesystem::path& path);

/// Looks at a file's content and measures it. Errors: as `build_mesh`. Cost: as `find_defects` and `validate`.
/// @param progress  called before each stage and at the end: how much of the work is done, of `total`, by what the
///                  stages take of a large mesh. May be empty.
[[nodiscard]] Result<MeshCheck> check_mesh(
    io::MeshFile file, const std::filesystem::path& path,
    const std::function<void(std::size_t done, std::size_t total)>& progress = {});

/// JSON with a newline at the end.
[[nodiscard]] std::string to_json(const MeshInfo& info);
[[nodiscard]] std::string to_json(const MeshCheck& check);
/// Lines for people.
[[nodiscard]] std::string to_text(const MeshInfo& info);
[[nodiscard]] std::string to_text(const MeshCheck& check);

}  // namespace app
}  // namespace v0
}  // namespace incise
