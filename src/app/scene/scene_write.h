// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/scene/scene.h"
#include "app/text/json_write.h"

namespace incise {
inline namespace v0 {
namespace app {

/// See `to_json(const Scene&)`.
[[nodiscard]] Json scene_tree(const Scene& scene);

}  // namespace app
}  // namespace v0
}  // namespace incise
