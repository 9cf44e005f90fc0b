// SPDX-License-Identifier: Apache-2.0
// Regions by their names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incise/core/result.h"
#include "incise/io/mesh_data.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The numbers of all regions of a name, in upper or lower case, lowest first. Errors: kBadFile, with the names that
/// there are.
[[nodiscard]] Result<std::vector<std::int32_t>> find_regions(const std::string& name, const io::RegionNames& names);

}  // namespace app
}  // namespace v0
}  // namespace incise
