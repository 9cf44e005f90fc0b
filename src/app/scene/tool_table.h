// SPDX-License-Identifier: Apache-2.0
// The table of the tools of a hand: here a tool is registered, by its kind, its maker and its row. Scenes, keys, panels
// and the machine of tools go by the rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace app {

class HandTool;  // see `app/hands/hand_tool.h`

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

/// What a tool is set to, of `ToolSettings`, as bits.
namespace tool_setting {
inline constexpr unsigned kDepth = 1, kAngle = 2, kRing = 4, kGrip = 8;
}  // namespace tool_setting

struct ToolRow {
  const char* name;                               ///< for people; scenes write it in small letters
  const char* key;                                ///< that chooses it, as in `KeyPress`
  const char* text;                               ///< what it does, in a few words that begin with its name
  std::unique_ptr<HandTool> (*make)() = nullptr;  ///< null: a drag turns the view
  unsigned settings = 0;                          ///< that people may turn; see `tool_setting`
  bool only_looks = false;                        ///< changes nothing: for recordings that are played, too
  bool cuts = false;                              ///< a scene's `spare` holds it
  bool pulls = false;                             ///< at tissue: a wound is held open with it
  /// Of the strokes that it makes by itself: how much faster the edge moves along itself than forwards. A ring that is
  /// twisted while it is pressed goes in where soft tissue would else give way below it.
  double slicing = 0;
};

/// In the order of `ToolKind`.
inline constexpr std::array<ToolRow, kToolCount> kTools = {{
    {.name = "Orbit", .key = "1", .text = "Orbit: a drag turns the view", .only_looks = true},
    {.name = "Scalpel",
     .key = "2",
     .text = "Scalpel: a drag cuts along the surface",
     .make = make_scalpel_tool,
     .settings = tool_setting::kDepth | tool_setting::kAngle,
     .cuts = true},
    {.name = "Plane cut",
     .key = "3",
     .text = "Plane cut: a drag draws the plane's line",
     .make = make_plane_cut_tool,
     .cuts = true},
    {.name = "Forceps",
     .key = "4",
     .text = "Forceps: a drag pulls the tissue",
     .make = make_grasp_tool,
     .settings = tool_setting::kGrip,
     .pulls = true},
    {.name = "Pin", .key = "5", .text = "Pin: a click holds the tissue, or lets it go", .make = make_pin_tool},
    {.name = "Probe",
     .key = "6",
     .text = "Probe: a click tells what is there",
     .make = make_probe_tool,
     .only_looks = true},
    {.name = "Hook",
     .key = "7",
     .text = "Hook: a drag pulls, and the hook stays",
     .make = make_hook_tool,
     .settings = tool_setting::kGrip,
     .pulls = true},
    {.name = "Retractor",
     .key = "8",
     .text = "Retractor: a drag holds a lip open, and stays",
     .make = make_retractor_tool,
     .settings = tool_setting::kGrip,
     .pulls = true},
    {.name = "Scissors",
     .key = "9",
     .text = "Scissors: a drag puts them on, its end closes them",
     .make = make_scissors_tool,
     .settings = tool_setting::kDepth,
     .cuts = true},
    {.name = "Punch",
     .key = "0",
     .text = "Punch: a click takes a core out",
     .make = make_punch_tool,
     .settings = tool_setting::kDepth | tool_setting::kRing,
     .cuts = true,
     .slicing = 6},
    {.name = "Suture", .key = "U", .text = "Suture: a drag from lip to lip sews them", .make = make_suture_tool},
    {.name = "Staple", .key = "J", .text = "Staple: a drag from lip to lip clips them", .make = make_staple_tool},
}};

/// For kinds below `kCount`.
[[nodiscard]] constexpr const ToolRow& row_of(ToolKind tool) {
  return kTools[static_cast<std::size_t>(tool)];
}

/// For people: "Orbit", "Scalpel", …; empty for what is none.
[[nodiscard]] constexpr const char* name_of(ToolKind tool) {
  return tool < ToolKind::kCount ? row_of(tool).name : "";
}

/// As scenes write it: "orbit", "scalpel", "plane cut", …
[[nodiscard]] std::string scene_name_of(ToolKind tool);
/// The tool that scenes call so; nothing where none has this name.
[[nodiscard]] std::optional<ToolKind> tool_named(std::string_view scene_name);
/// For messages: "orbit, scalpel, …", of those tools alone that cut, or of all.
[[nodiscard]] std::string scene_tool_names(bool only_that_cut);

}  // namespace app
}  // namespace v0
}  // namespace incise
