// SPDX-License-Identifier: Apache-2.0
// What a picture shows, without how it is drawn: renderers take it, the window, headless runs and tests fill it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "app/scene/scene_view.h"
#include "app/view/camera.h"
#include "app/view/instrument.h"
#include "app/view/solid.h"
#include "app/view/surface_view.h"

namespace incise {
inline namespace v0 {
namespace app {

struct ViewOptions {
  Theme theme = Theme::kDark;
  ColorBy color = ColorBy::kTissue;
  bool shows_wireframe = false;
  bool shows_surface = true;    ///< false with a wireframe: lines alone
  double skin_opacity = 1;      ///< of skin, not of walls; in (0, 1]
  bool shows_occlusion = true;  ///< darkens hollows, to read depth
  bool shows_newest = true;     ///< tints the walls of the newest stroke: its incision faces
  bool shows_front = true;      ///< draws where cuts end inside the body
  bool shows_shadows = false;   ///< of the body, its instruments and what lies around it, on each other
  TissueLook look = TissueLook::kSkin;
};

/// What a mark stands for; the theme says in which colour. No two are told apart by colour alone.
enum class Ink : std::uint8_t {
  kBlade,       ///< the cutting edge and what is behind it
  kTrajectory,  ///< the surface that the blade swept: violet in the paper's Figure 3
  kIncision,    ///< incision faces: yellow there
  kVertex,      ///< vertices that a cut divides: green there
  kPreview,     ///< what a tool would do
  kTarget,      ///< of an exercise: where the cut shall go
  kIdeal,       ///< of an exercise: the ideal blade
  kHook,        ///< what is grasped
  kPin,         ///< what is pinned, or sewn
  kPicked,      ///< the element that is probed
  kWorst,       ///< a tet of bad shape
  kTool,        ///< balls, rods and tables
  kWithin,      ///< of a scored exercise: the cut is within one tolerance
  kNear,        ///< of a scored exercise: it is within three
  kFar,         ///< of a scored exercise: it is further off
  kSpot,        ///< of an exercise: tissue that is to come off
};

/// Things beside the surface. Lengths in the mesh's unit unless they say pixels.
struct Marks {
  struct Line {
    Eigen::Vector3f from, to;
    Ink ink = Ink::kPreview;
    float width = 2;         ///< pixels
    bool is_on_top = false;  ///< seen through what is in front of it
    bool is_dashed = false;
  };
  struct Ball {
    Eigen::Vector3f centre;
    Ink ink = Ink::kHook;
    float radius = 5;  ///< pixels, or length units
    bool is_in_pixels = true;
  };
  struct Triangle {
    std::array<Eigen::Vector3f, 3> corners;
    Ink ink = Ink::kPreview;
    float opacity = 0.35F;  ///< in (0, 1]; seen from both sides
  };
  std::vector<Line> lines;
  std::vector<Ball> balls;
  std::vector<Triangle> triangles;
  std::vector<Instrument> instruments;  ///< solid; where there are some, blade lines show inside alone
};

/// Everything that is drawn.
struct Picture {
  SurfaceFrame surface;  ///< its topology may be null: nothing to see yet
  Camera camera;
  ViewOptions options;
  Marks marks;
  std::shared_ptr<const std::vector<SolidCorner>> ground;  ///< what lies around the body; may be null
};

/// The box of all points of a frame; empty where there is none. Cost: O(points).
[[nodiscard]] Box bounds_of(const SurfaceFrame& frame);

}  // namespace app
}  // namespace v0
}  // namespace incise
