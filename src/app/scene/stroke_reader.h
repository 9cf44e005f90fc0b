// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/scene/blade_file.h"
#include "app/text/json_tree.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Reads the strokes of a blade file (see `parse_blade_file`), at least one, and appends them. Returns false, with the
/// error in `reader`, where they are not as asked.
bool read_strokes(JsonReader& reader, const JsonValue& list, const std::string& path,
                  std::vector<BladeStroke>& strokes);
/// Reads `stop_at` of an object, where it has one: regions by number or name, which are appended.
bool read_stops(JsonReader& reader, const JsonValue& value, const std::string& path, std::vector<std::int32_t>& numbers,
                std::vector<std::string>& names);
/// The same of another key.
bool read_regions(JsonReader& reader, const JsonValue& value, const std::string& path, const std::string& key,
                  std::vector<std::int32_t>& numbers, std::vector<std::string>& names);

}  // namespace app
}  // namespace v0
}  // namespace incise
