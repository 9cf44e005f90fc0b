// SPDX-License-Identifier: Apache-2.0
// Regions by their names and numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incise/core/result.h"
#include "incise/io/mesh_data.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The numbers of all regions of a name, in upper or lower case, lowest first. Errors: kBadFile, with the names that
/// there are.
[[nodiscard]] Result<std::vector<std::int32_t>> find_regions(const std::string& name, const io::RegionNames& names);

/// Errors: kBadFile, for a number that no tet of the mesh has; it names the first such and those that there are. Cost:
/// all tets once.
[[nodiscard]] Status check_regions(const std::vector<std::int32_t>& regions, const TetMesh& mesh);

}  // namespace app
}  // namespace v0
}  // namespace incise
