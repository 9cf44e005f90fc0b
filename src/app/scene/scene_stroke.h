// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/cut/stroke.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A stroke of the blade; its times are the scene's.
struct SceneStroke {
  Stroke stroke;
  Vec3 direction = Vec3::Zero();  ///< as in `BladePose`
};

}  // namespace app
}  // namespace v0
}  // namespace incise
