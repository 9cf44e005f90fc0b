// SPDX-License-Identifier: Apache-2.0
// Line drawings for buttons, made in code: no font and no picture is needed.
#pragma once

#include <imgui.h>

#include <cstdint>

namespace incise_view {

/// The first ones are the tools, in the order of `ToolKind`. From kSkin on come the bodies in the order of
/// `StartingBody`, from kStraightCut on the exercises in that of `StartingExercise`.
enum class Icon : std::uint8_t {
  kTurn,
  kScalpel,
  kPlane,
  kForceps,
  kPin,
  kProbe,
  kHook,
  kRetractor,
  kScissors,
  kPunch,
  kSuture,
  kStaple,
  kUndo,
  kRedo,
  kPause,
  kGo,
  kRestart,
  kPicture,
  kResearch,
  kHelp,
  kBodies,
  kSkin,
  kLiver,
  kVein,
  kVertebra,
  kStraightCut,
  kUpToLayer,
  kSlit,
  kCore,
  kEllipse,
  kFolder,
  kHand,
};

/// Draws an icon in a square. `color` as Dear ImGui packs it.
void draw_icon(ImDrawList& list, Icon icon, const ImVec2& corner, float side, ImU32 color);

}  // namespace incise_view
