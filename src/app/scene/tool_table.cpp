// SPDX-License-Identifier: Apache-2.0
// Scenes know the tools by the names that people see, in small letters.
#include "app/scene/tool_table.h"

namespace incise {
inline namespace v0 {
namespace app {

std::string scene_name_of(ToolKind tool) {
  std::string name = name_of(tool);
  for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return name;
}

std::optional<ToolKind> tool_named(std::string_view scene_name) {
  for (std::size_t i = 0; i < kToolCount; ++i) {
    const auto tool = static_cast<ToolKind>(i);
    if (scene_name_of(tool) == scene_name) return tool;
  }
  return std::nullopt;
}

std::string scene_tool_names(bool only_that_cut) {
  std::string all;
  for (std::size_t i = 0; i < kToolCount; ++i) {
    if (!only_that_cut || kTools[i].cuts) all += (all.empty() ? "" : ", ") + scene_name_of(static_cast<ToolKind>(i));
  }
  return all;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
