// SPDX-License-Identifier: Apache-2.0
// The table of the tools: here a tool is registered, with the function that makes it. The list of keys, the panels and
// the machine of tools go by the rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "app/hands/hand_tool.h"

namespace incise {
inline namespace v0 {
namespace app {

enum class ToolKind : std::uint8_t {
  kOrbit,      ///< a drag turns the view
  kScalpel,    ///< a drag draws a cut of some depth along the surface
  kPlaneCut,   ///< a drag is a line across the picture: the plane through it and the eye cuts the whole body
  kGrasp,      ///< a drag pulls at the tissue
  kPin,        ///< a click holds tissue where it is, or lets it go
  kProbe,      ///< a click asks what is there
  kHook,       ///< a drag pulls the tissue at a place, and the hook stays
  kRetractor,  ///< the same along a length of a wound's lip
  kScissors,   ///< a drag puts them on, its end closes them
  kPunch,      ///< a click drives a ring in: a core comes out
  kSuture,     ///< a drag from lip to lip sews them together
  kStaple,     ///< the same with a staple, which also keeps them apart
  kCount
};
inline constexpr std::size_t kToolCount = static_cast<std::size_t>(ToolKind::kCount);

std::unique_ptr<HandTool> make_scalpel_tool();
std::unique_ptr<HandTool> make_plane_cut_tool();
std::unique_ptr<HandTool> make_grasp_tool();
std::unique_ptr<HandTool> make_pin_tool();
std::unique_ptr<HandTool> make_probe_tool();
std::unique_ptr<HandTool> make_hook_tool();
std::unique_ptr<HandTool> make_retractor_tool();
std::unique_ptr<HandTool> make_scissors_tool();
std::unique_ptr<HandTool> make_punch_tool();
std::unique_ptr<HandTool> make_suture_tool();
std::unique_ptr<HandTool> make_staple_tool();

struct ToolRow {
  const char* name;                     ///< for people
  const char* key;                      ///< that chooses it, as in `KeyPress`
  const char* text;                     ///< what it does, in a few words that begin with its name
  bool only_looks;                      ///< changes nothing: for recordings that are played, too
  std::unique_ptr<HandTool> (*make)();  ///< null: a drag turns the view
};

/// In the order of `ToolKind`.
inline constexpr std::array<ToolRow, kToolCount> kTools = {{
    {"Orbit", "1", "Orbit: a drag turns the view", true, nullptr},
    {"Scalpel", "2", "Scalpel: a drag cuts along the surface", false, make_scalpel_tool},
    {"Plane cut", "3", "Plane cut: a drag draws the plane's line", false, make_plane_cut_tool},
    {"Forceps", "4", "Forceps: a drag pulls the tissue", false, make_grasp_tool},
    {"Pin", "5", "Pin: a click holds the tissue, or lets it go", false, make_pin_tool},
    {"Probe", "6", "Probe: a click tells what is there", true, make_probe_tool},
    {"Hook", "7", "Hook: a drag pulls, and the hook stays", false, make_hook_tool},
    {"Retractor", "8", "Retractor: a drag holds a lip open, and stays", false, make_retractor_tool},
    {"Scissors", "9", "Scissors: a drag puts them on, its end closes them", false, make_scissors_tool},
    {"Punch", "0", "Punch: a click takes a core out", false, make_punch_tool},
    {"Suture", "U", "Suture: a drag from lip to lip sews them", false, make_suture_tool},
    {"Staple", "J", "Staple: a drag from lip to lip clips them", false, make_staple_tool},
}};

/// For people: "Orbit", "Scalpel", …; empty for what is none.
[[nodiscard]] constexpr const char* name_of(ToolKind tool) {
  return tool < ToolKind::kCount ? kTools[static_cast<std::size_t>(tool)].name : "";
}

}  // namespace app
}  // namespace v0
}  // namespace incise
