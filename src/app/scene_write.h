// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/json_write.h"
#include "incise/app/scene.h"

namespace incise {
inline namespace v0 {
namespace app {

/// See `to_json(const Scene&)`.
[[nodiscard]] Json scene_tree(const Scene& scene);

}  // namespace app
}  // namespace v0
}  // namespace incise
