// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/scene/scene.h"
#include "app/text/json_tree.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Reads a scene from a parsed document, or from a part of one; see `parse_scene`. `place`: which part, in front of
/// the paths in messages ("items[0].scene").
Result<Scene> read_scene_tree(const JsonValue& root, std::string_view file_name, const std::filesystem::path& folder,
                              const std::string& place = {});

}  // namespace app
}  // namespace v0
}  // namespace incise
