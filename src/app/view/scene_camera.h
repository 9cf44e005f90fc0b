// SPDX-License-Identifier: Apache-2.0
// How a scene is first seen.
#pragma once

#include "app/scene/scene.h"
#include "app/view/camera.h"
#include "app/view/picture.h"

namespace incise {
inline namespace v0 {
namespace app {

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
