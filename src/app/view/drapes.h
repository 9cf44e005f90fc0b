// SPDX-License-Identifier: Apache-2.0
// Cloths around a patch of tissue, with an opening as large as the patch.
#pragma once

#include <vector>

#include "app/view/solid.h"
#include "incise/geom/box.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The triangles of drapes that lie around a box, just below its top as seen along `up`.
/// @param up  unit, along an axis within rounding: the opening is the box's section across it. Empty for an empty box.
[[nodiscard]] std::vector<SolidCorner> drapes_around(const Box& body, const Vec3& up);

}  // namespace app
}  // namespace v0
}  // namespace incise
