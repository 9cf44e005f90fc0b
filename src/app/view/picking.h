// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "app/view/camera.h"
#include "app/view/surface_view.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A place on a surface that a ray meets.
struct SurfaceHit {
  std::size_t triangle = 0;     ///< its slot in the topology
  Side side;                    ///< which side of which tet
  Vec3 point = Vec3::Zero();    ///< length unit, as the body stands
  Vec3 rest = Vec3::Zero();     ///< the same place in the rest shape, to the precision of pictures
  Vec3 normal = Vec3::UnitZ();  ///< of the triangle, outwards, unit
  double distance = 0;          ///< from the ray's origin
};

/// The first triangle of a surface that a ray meets from outside; those seen from behind do not count.
/// Cost: O(triangles), about 5 ns each.
[[nodiscard]] std::optional<SurfaceHit> pick(const SurfaceFrame& surface, const Ray& ray);

}  // namespace app
}  // namespace v0
}  // namespace incise
