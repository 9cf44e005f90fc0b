// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/text/json_tree.h"
#include "incise/cut/stroke.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Reads the strokes of a blade file (see `parse_blade`), at least one, and appends them. Returns false, with the error
/// in `reader`, where they are not as asked.
bool read_strokes(JsonReader& reader, const JsonValue& list, const std::string& path, std::vector<Stroke>& strokes);

}  // namespace app
}  // namespace v0
}  // namespace incise
