// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/scene/tool_table.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Everything that a person can ask for by a key.
enum class Action : std::uint8_t {
  kFirstTool,  ///< the tools, in the order of `ToolKind`
  kLastTool = kFirstTool + kToolCount - 1,
  kDeeper,
  kShallower,
  kTiltLeft,
  kTiltRight,
  kCancel,
  kUndo,
  kRedo,
  kPause,
  kStep,
  kReset,
  kNextStep,
  kTakeOver,
  kRecord,
  kScreenshot,
  kImageSequence,
  kExportMesh,
  kFrameAll,
  kTurnLeft,
  kTurnRight,
  kTurnUp,
  kTurnDown,
  kZoomIn,
  kZoomOut,
  kWireframe,
  kClipPlane,
  kClipDeeper,
  kClipShallower,
  kColor,
  kWorstTets,
  kTransparency,
  kOcclusion,
  kTheme,
  kPanels,
  kResearch,
  kLarger,
  kSmaller,
  kIdeal,
  kScore,
  kFullScreen,
  kHelp,
  kQuit,
  kCount
};

/// Chooses a tool.
[[nodiscard]] constexpr Action action_of(ToolKind tool) {
  return static_cast<Action>(tool);
}

/// A key with what is held beside it.
struct KeyPress {
  std::string_view key;  ///< "A" to "Z", "0" to "9", "Space", "Escape", "Left", "F1", ".", "+", "-", …
  bool control = false, shift = false;
};

struct KeyBinding {
  Action action;
  KeyPress press;
  std::string_view group;  ///< of the list of keys: "Tools", "Cutting", …
  std::string_view text;   ///< what it does, in a few words
};

/// All bindings, in the order of the list of keys; every action has one, some have two.
[[nodiscard]] std::span<const KeyBinding> key_bindings();
/// What a key asks for, where it asks for anything.
[[nodiscard]] std::optional<Action> action_of(const KeyPress& press);
/// "Ctrl+Shift+Z"
[[nodiscard]] std::string to_text(const KeyPress& press);
/// The first binding's key of an action, as text: for buttons and their hints.
[[nodiscard]] std::string key_of(Action action);
/// A row of the list of keys: "Ctrl+Shift+Z, Ctrl+Y".
struct KeyRow {
  std::string_view group;
  std::string keys;
  std::string_view text;
};
/// One row per action.
[[nodiscard]] std::vector<KeyRow> key_rows();
/// The whole list as text, one key a line, for `--help`.
[[nodiscard]] std::string list_of_keys();

}  // namespace app
}  // namespace v0
}  // namespace incise
