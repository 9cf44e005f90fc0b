// SPDX-License-Identifier: Apache-2.0
// What a person did since the last picture, in steps that panels can follow.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <variant>

#include "app/hands/hand_tool.h"
#include "app/viewer/key_bindings.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A key that goes down, repeats or goes up, in the numbers of the window's system: text fields need them.
struct KeyChange {
  int key = 0, scan_code = 0, action = 0, modifiers = 0;
  std::optional<KeyPress> press;  ///< where it goes down or repeats, and is a key of a name
};
/// Unicode.
struct TypedCharacter {
  unsigned code = 0;
};
/// The pointer is no longer over the window.
struct PointerLeft {};
struct DroppedFile {
  std::filesystem::path path;
};
using InputEvent = std::variant<PointerEvent, PointerLeft, KeyChange, TypedCharacter, DroppedFile>;

/// How many of the first events are one step: ways of the pointer up to and including the first event that is another
/// one. Panels look at where the pointer and what its buttons are once a step: a press and its release in one step
/// would be nothing to them, and a press after which the pointer went on would be one elsewhere. 0 without events.
[[nodiscard]] std::size_t step_length(std::span<const InputEvent> events);

}  // namespace app
}  // namespace v0
}  // namespace incise
