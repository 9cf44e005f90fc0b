// SPDX-License-Identifier: Apache-2.0
// How a scene is first seen.
#pragma once

#include <optional>

#include "incise/app/camera.h"
#include "incise/app/half_space.h"
#include "incise/app/picture.h"

namespace incise {
inline namespace v0 {
namespace app {

struct Scene;

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
};

/// Where a scene is first seen from.
///
/// @param body      the box of the body as it stands, in length units; where it is empty the distance is the view's,
///                  or `Camera`'s.
/// @param viewport  of the picture that the body shall fill.
/// A pure function; it uses libm, as all cameras do. Cost: O(1).
[[nodiscard]] Camera camera_of(const Scene& scene, const Box& body, const Viewport& viewport);

/// How a scene is first drawn: what its view says, and `ViewOptions`' defaults. A pure function. Cost: O(1).
[[nodiscard]] ViewOptions view_options_of(const Scene& scene);

}  // namespace app
}  // namespace v0
}  // namespace incise
