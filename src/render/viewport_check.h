// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/camera.h"
#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace render {

/// Errors: kBadArgument for a size below 1 or above what the current context can draw.
[[nodiscard]] Status check_viewport(const app::Viewport& viewport);

}  // namespace render
}  // namespace v0
}  // namespace incise
