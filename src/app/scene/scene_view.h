// SPDX-License-Identifier: Apache-2.0
// How a scene is first seen.
#pragma once

#include <cstdint>
#include <optional>

#include "app/scene/half_space.h"

namespace incise {
inline namespace v0 {
namespace app {

enum class Theme : std::uint8_t { kDark, kLight };

/// What the colour of a triangle tells.
enum class ColorBy : std::uint8_t {
  kTissue,   ///< skin and cut walls in their own colours
  kRegion,   ///< the region of its tet; walls a shade darker
  kStroke,   ///< walls by their stroke's number, skin grey
  kQuality,  ///< L/r of its tet, on a map that the colour-blind can read
  kDefects,  ///< yellow: its tet is too small; else red: bad-shaped; as in the paper's Figure 7. Others grey
};

/// What the outside and the inside of a body look like where colours show tissue. Its materials are another matter.
enum class TissueLook : std::uint8_t { kSkin, kLiver, kVessel, kBone };

/// What a scene says about how it is first seen; everything may be left out. Lengths in the model's unit.
struct SceneView {
  std::optional<Vec3> from;        ///< from the target to the eye, of any length but zero; unset: as `Camera` has it
  std::optional<Vec3> up;          ///< of any length but zero; unset: against gravity, z where there is none
  std::optional<Vec3> target;      ///< what is looked at; unset: the middle of the body
  std::optional<double> distance;  ///< from the target to the eye, above 0; unset: the whole body is seen
  double zoom = 1;                 ///< how much nearer the eye is than `distance`, above 0
  ColorBy color = ColorBy::kTissue;
  bool shows_wireframe = false;
  double skin_opacity = 1;  ///< in (0, 1]
  Theme theme = Theme::kDark;
  std::optional<HalfSpace> clip;  ///< what lies in it is not shown; see `SurfaceOptions`
  TissueLook look = TissueLook::kSkin;
  bool has_drapes = false;  ///< cloths lie around the body
  /// Strokes and hooks of the scene show a person what can be done: the first press or key ends them.
  bool is_demonstration = false;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
