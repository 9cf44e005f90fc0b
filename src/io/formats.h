// SPDX-License-Identifier: Apache-2.0
// The table of the mesh formats that Incise knows.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "incise/io/mesh_file.h"
#include "io/reader.h"

namespace incise {
inline namespace v0 {
namespace io {

/// The first bytes of a file, and the first line that is neither empty nor a comment with '#', trimmed; empty where
/// there is none.
struct Beginning {
  std::string_view bytes, line;
};

/// One format. A row may be for reading or for writing alone.
struct FormatRow {
  std::string_view title;  ///< in messages that say what can be read; empty: another row of the same format has it

  bool (*recognises)(const Beginning&) = nullptr;  ///< null: not read
  bool (*read)(Job& job) = nullptr;                ///< returns false with `job.error` set
  bool is_vague = false;  ///< other programs' files look like it: those that are known are ruled out first

  std::string_view extension = {};                              ///< with its dot; empty: not written
  std::string (*write)(const MeshData&, MshVariant) = nullptr;  ///< null: this build does not write it
  std::string_view option = {};                                 ///< its name for `write_options_named`; empty: none
  MshVariant variant = MshVariant::k41;
  std::string_view twin = {};  ///< the extension of a second file that belongs to it
};

/// In the order in which they are asked.
[[nodiscard]] std::span<const FormatRow> formats();

/// "Incise reads A, B and C".
[[nodiscard]] std::string readable_formats();
/// ".a, .b or .c": what can be written.
[[nodiscard]] std::string writable_extensions();

}  // namespace io
}  // namespace v0
}  // namespace incise
