// SPDX-License-Identifier: Apache-2.0
// What a file is called while it is being written.
#pragma once

#include <filesystem>

namespace incise {
inline namespace v0 {
namespace io {

/// Where a file is written until it is whole: NAME.PROCESS.NUMBER.incise-part, beside its place.
///
/// @param path    its place.
/// @param number  tells apart what one process writes at the same time; any.
/// Errors: none. Cost: O(1). Thread-safe.
[[nodiscard]] std::filesystem::path part_file(const std::filesystem::path& path, unsigned number);

/// Take away what killed processes left of earlier attempts to write a file.
///
/// @param path  its place. Of its folder the first 1000 names are looked at: a series of many files would look at all
///              of them each time.
/// Errors: none; what cannot be removed stays. Cost: O(names looked at). Thread-safe.
void remove_stale_parts(const std::filesystem::path& path);

}  // namespace io
}  // namespace v0
}  // namespace incise
