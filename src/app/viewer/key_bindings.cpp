// SPDX-License-Identifier: Apache-2.0
// One table, from which the keys, the hints of buttons and the list of `--help` come.
#include "app/viewer/key_bindings.h"

#include <array>
#include <iterator>

#include "app/text/formatted.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr bool kControl = true;
constexpr bool kShift = true;

constexpr KeyBinding kOthers[] = {
    {Action::kDeeper, {"]"}, "Tools", "Scalpel deeper (also Ctrl+wheel)"},
    {Action::kShallower, {"["}, "Tools", "Scalpel shallower"},
    {Action::kTiltLeft, {","}, "Tools", "Tilt the scalpel to the left (also Shift+wheel)"},
    {Action::kTiltRight, {";"}, "Tools", "Tilt the scalpel to the right"},
    {Action::kCancel, {"Escape"}, "Tools", "Give up what is under way; else close what is open"},
    {Action::kUndo, {"Z", kControl}, "Cutting", "Take the last stroke back"},
    {Action::kRedo, {"Z", kControl, kShift}, "Cutting", "Make it again"},
    {Action::kRedo, {"Y", kControl}, "Cutting", "Make it again"},
    {Action::kPause, {"Space"}, "Time", "Pause, or go on"},
    {Action::kStep, {"."}, "Time", "One frame"},
    {Action::kReset, {"R"}, "Time", "Back to the start"},
    {Action::kNextStep, {"N"}, "Time", "Replay: to the end of the next step"},
    {Action::kTakeOver, {"G"}, "Time", "Replay: go on by hand from here"},
    {Action::kRecord, {"V"}, "Files", "Record the session, or end the recording"},
    {Action::kScreenshot, {"S"}, "Files", "Save a picture"},
    {Action::kImageSequence, {"S", false, kShift}, "Files", "Save every picture from now on, or end that"},
    {Action::kExportMesh, {"E", kControl}, "Files", "Write the mesh"},
    {Action::kFrameAll, {"F"}, "View", "See the whole body"},
    {Action::kFrameAll, {"Home"}, "View", "See the whole body"},
    {Action::kTurnLeft, {"Left"}, "View", "Turn the view to the left"},
    {Action::kTurnRight, {"Right"}, "View", "Turn the view to the right"},
    {Action::kTurnUp, {"Up"}, "View", "Turn the view up"},
    {Action::kTurnDown, {"Down"}, "View", "Turn the view down"},
    {Action::kZoomIn, {"+"}, "View", "Nearer (also the wheel)"},
    {Action::kZoomIn, {"="}, "View", "Nearer"},
    {Action::kZoomOut, {"-"}, "View", "Further away"},
    {Action::kWireframe, {"W"}, "View", "Edges of the mesh"},
    {Action::kClipPlane, {"X"}, "View", "Look inside: a clip plane along the view"},
    {Action::kClipDeeper, {"PageDown"}, "View", "Clip plane further in"},
    {Action::kClipShallower, {"PageUp"}, "View", "Clip plane further out"},
    {Action::kColor, {"C"}, "View", "Colour by tissue, region, stroke or quality"},
    {Action::kWorstTets, {"Q"}, "View", "Mark the worst tets"},
    {Action::kTransparency, {"T"}, "View", "See through the skin"},
    {Action::kOcclusion, {"O"}, "View", "Shade hollows"},
    {Action::kTheme, {"B"}, "View", "Dark or light"},
    {Action::kPanels, {"P"}, "View", "Hide the panels, or show them"},
    {Action::kResearch, {"Tab"}, "View", "Research: every figure of mesh, time and force"},
    {Action::kLarger, {"+", kControl}, "View", "Larger text"},
    {Action::kLarger, {"=", kControl}, "View", "Larger text"},
    {Action::kSmaller, {"-", kControl}, "View", "Smaller text"},
    {Action::kIdeal, {"I"}, "Exercise", "The ideal blade; after the score, beside the attempt"},
    {Action::kScore, {"Enter"}, "Exercise", "Finish, and see the score"},
    {Action::kFullScreen, {"F11"}, "Window", "Full screen"},
    {Action::kHelp, {"H"}, "Window", "This list"},
    {Action::kHelp, {"F1"}, "Window", "This list"},
    {Action::kQuit, {"Q", kControl}, "Window", "Quit"},
};

constexpr auto kBindings = [] {
  std::array<KeyBinding, kToolCount + std::size(kOthers)> all{};
  for (std::size_t i = 0; i < kToolCount; ++i) {
    all[i] = {action_of(static_cast<ToolKind>(i)), {kTools[i].key}, "Tools", kTools[i].text};
  }
  for (std::size_t i = 0; i < std::size(kOthers); ++i) all[kToolCount + i] = kOthers[i];
  return all;
}();

}  // namespace

std::span<const KeyBinding> key_bindings() {
  return kBindings;
}

std::optional<Action> action_of(const KeyPress& press) {
  for (const KeyBinding& binding : kBindings) {
    const KeyPress& k = binding.press;
    if (k.key == press.key && k.control == press.control && k.shift == press.shift) return binding.action;
  }
  return std::nullopt;
}

std::string to_text(const KeyPress& press) {
  return formatted("{}{}{}", press.control ? "Ctrl+" : "", press.shift ? "Shift+" : "", press.key);
}

std::string key_of(Action action) {
  for (const KeyBinding& binding : kBindings) {
    if (binding.action == action) return to_text(binding.press);
  }
  return {};
}

std::vector<KeyRow> key_rows() {
  std::vector<KeyRow> rows;
  const KeyBinding* before = nullptr;
  for (const KeyBinding& binding : kBindings) {
    if (before != nullptr && before->action == binding.action) {
      rows.back().keys += ", " + to_text(binding.press);
    } else {
      rows.push_back({binding.group, to_text(binding.press), binding.text});
    }
    before = &binding;
  }
  return rows;
}

std::string list_of_keys() {
  std::string list;
  std::string_view group;
  for (const KeyRow& row : key_rows()) {
    if (row.group != group) list += formatted("{}:\n", row.group);
    group = row.group;
    list += formatted("  {:<20} {}\n", row.keys, row.text);
  }
  return list;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
