// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incise/cut/stroke.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A stroke of the blade; its times are the scene's.
struct SceneStroke {
  Stroke stroke;
  Vec3 direction = Vec3::Zero();             ///< as in `BladePose`
  std::vector<std::int32_t> stop_at = {};    ///< regions that the edge is held outside of, see `RegionGuard`
  std::vector<std::string> stop_names = {};  ///< more of them, until `take_model` knows their numbers
  double slicing = 0;                        ///< as in `BladePose`
};

}  // namespace app
}  // namespace v0
}  // namespace incise
