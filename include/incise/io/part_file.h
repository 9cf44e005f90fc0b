// SPDX-License-Identifier: Apache-2.0
// What a file is called while it is being written.
#pragma once

#include <filesystem>
#include <system_error>

namespace incise {
inline namespace v0 {
namespace io {

/// Where a file is written until it is whole: NAME.PROCESS.NUMBER.incise-part, beside its place; beside what links lead
/// to. Of a long name the beginning: file systems take 255 bytes.
///
/// @param path    its place.
/// @param number  tells apart what one process writes at the same time; any.
/// Errors: none. Cost: O(1). Thread-safe.
[[nodiscard]] std::filesystem::path part_file(const std::filesystem::path& path, unsigned number);

/// Put what is whole into its place: behind links, which stay, and with the permissions of what stood there.
///
/// @param part   from `part_file`, on failure still there.
/// @param place  the path that `part_file` was given.
/// Errors: those of renaming. Cost: O(1). Thread-safe.
[[nodiscard]] std::error_code put_in_place(const std::filesystem::path& part, const std::filesystem::path& place);

/// Whether a file stands at a place that may not be written to: putting another one there would not ask.
///
/// Errors: none; of pipes, devices and what is not there: no. Cost: O(1). Thread-safe.
[[nodiscard]] bool is_protected(const std::filesystem::path& place);

/// Take away what killed processes left of earlier attempts to write a file.
///
/// @param path  its place. Of its folder the first 1000 names are looked at: a series of many files would look at all
///              of them each time.
/// Errors: none; what cannot be removed stays. Cost: O(names looked at). Thread-safe.
void remove_stale_parts(const std::filesystem::path& path);

}  // namespace io
}  // namespace v0
}  // namespace incise
