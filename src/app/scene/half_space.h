// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace app {

/// All points with normal · x <= offset.
struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();  ///< of any length but zero
  double offset = 0;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
