// SPDX-License-Identifier: Apache-2.0
// Files on the disk: whole reads, and writes that are never seen half done.
#pragma once

#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incise/core/result.h"
#include "incise/io/load_file.h"
#include "incise/io/mesh_file.h"

namespace incise {
inline namespace v0 {
namespace io {

/// The checks of `read_mesh` and of `read_surface`; `name` is for the message.
[[nodiscard]] std::optional<Error> check_mesh_beginning(std::string_view beginning, const std::string& name);
[[nodiscard]] std::optional<Error> check_surface_beginning(std::string_view beginning, const std::string& name);

/// The bytes of `path`, or of `path` with ".gz"; gunzipped.
[[nodiscard]] Result<std::string> load_either(const std::filesystem::path& path, const ReadLimits& limits);

/// Whether a file may have this name. Errors: kBadArgument where it is empty, kIo where a folder has it.
[[nodiscard]] Status check_place(const std::filesystem::path& path);

/// Write all files beside their places, then rename them all. On failure nothing is left behind.
[[nodiscard]] Status store_files(const std::vector<std::pair<std::filesystem::path, std::string_view>>& files);

/// As `store_files`, with all contents gzipped first where asked.
[[nodiscard]] Status store_packed(const std::vector<std::filesystem::path>& paths, std::vector<std::string> contents,
                                  bool gzipped);

/// Split "a.mesh.gz" into the lower-case extension ".mesh" and whether ".gz" follows.
struct Extension {
  std::string name;
  bool gzipped = false;
};
[[nodiscard]] Extension extension_of(const std::filesystem::path& path);

/// Run `body`; running out of memory becomes an error.
template <class T, class Body>
Result<T> guarded(const std::string& name, const Body& body) {
#if defined(__cpp_exceptions)
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, name + ": there is not enough memory for this file; use a larger machine"};
  } catch (const std::length_error&) {
    return Error{ErrorCode::kOutOfMemory, name + ": there is not enough memory for this file; use a larger machine"};
  }
#else
  (void)name;
  return body();
#endif
}

}  // namespace io
}  // namespace v0
}  // namespace incise
