// SPDX-License-Identifier: Apache-2.0
// Names are read when a folder is entered, not in every frame.
#include "file_list.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "panel_parts.h"

namespace incise_view {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "Open a file";

/// Files that may be opened, and folders; what else there is would only be in the way.
bool is_shown(const fs::directory_entry& entry) {
  std::error_code code;
  const std::string name = entry.path().filename().string();
  if (name.starts_with(".")) return false;
  if (entry.is_directory(code)) return true;
  constexpr std::array<std::string_view, 11> kEndings = {".json", ".jsonl", ".mesh", ".msh", ".vtk", ".vtu",
                                                         ".node", ".veg",   ".inp",  ".ply", ".gz"};
  return std::any_of(kEndings.begin(), kEndings.end(), [&](std::string_view end) { return name.ends_with(end); });
}

}  // namespace

void FileList::open() {
  std::error_code code;
  if (folder_.empty()) folder_ = fs::current_path(code);
  read();
  ImGui::OpenPopup(kName);
}

std::optional<fs::path> FileList::draw() {
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowPos({0.5F * screen.x, 0.5F * screen.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(38 * em(), 0.9F * screen.x), std::min(30 * em(), 0.9F * screen.y)});
  if (!ImGui::BeginPopup(kName)) return std::nullopt;
  text("A mesh, a scene or a recording");
  faint(folder_.string());
  ImGui::Separator();
  fs::path chosen;
  if (ImGui::BeginChild("files", {0, -2.2F * em()})) chosen = draw_names();
  ImGui::EndChild();
  if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
  ImGui::SameLine();
  faint("A file may be dropped on the window, too");
  std::error_code code;
  const bool is_folder = !chosen.empty() && fs::is_directory(chosen, code);
  if (is_folder) {
    folder_ = chosen;
    read();
  }
  const bool is_done = !chosen.empty() && !is_folder;
  if (is_done) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return is_done ? std::optional(chosen) : std::nullopt;
}

void FileList::read() {
  names_.clear();
  std::error_code code;
  for (fs::directory_iterator i(folder_, code), end; !code && i != end; i.increment(code)) {
    std::error_code ignored;
    if (is_shown(*i)) names_.push_back({i->path().filename().string(), i->is_directory(ignored)});
  }
  std::sort(names_.begin(), names_.end(),
            [](const Entry& a, const Entry& b) { return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name; });
}

fs::path FileList::draw_names() {
  constexpr ImGuiSelectableFlags kStays = ImGuiSelectableFlags_DontClosePopups;
  if (folder_ != folder_.root_path() && ImGui::Selectable("..  (the folder above)", false, kStays)) {
    return folder_.parent_path();
  }
  for (const Entry& entry : names_) {
    const std::string shown = entry.is_folder ? entry.name + "/" : entry.name;
    if (ImGui::Selectable(shown.c_str(), false, kStays)) return folder_ / entry.name;
  }
  return {};
}

}  // namespace incise_view
