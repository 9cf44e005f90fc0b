// SPDX-License-Identifier: Apache-2.0
// Names of regions in files: one form of them, and what all formats make of it.
#pragma once

#include <string>
#include <string_view>

#include "incise/io/mesh_data.h"

namespace incise {
inline namespace v0 {
namespace io {

/// A name without what would break a line or a pair of quotes; at most 200 bytes.
[[nodiscard]] std::string to_file_name_of_region(std::string_view name);

/// The name that a region is written under: its own, or "region_12".
[[nodiscard]] std::string written_name(const RegionNames& names, std::int32_t region);

/// Takes a name as a file has it. Empty ones, and those that only repeat the number, say nothing; of two the first
/// stays.
void take_region_name(std::int32_t region, std::string_view name, RegionNames& names);

/// The array of field data that holds such names in VTU files.
inline constexpr std::string_view kVtuNames = "region_names";

/// "12 left kidney": as files without a place for names have them in comments and in data of their own.
[[nodiscard]] std::string to_entry(std::int32_t region, std::string_view name);
void take_entry(std::string_view entry, RegionNames& names);

}  // namespace io
}  // namespace v0
}  // namespace incise
