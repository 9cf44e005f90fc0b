// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/scene/scene_stroke.h"
#include "incise/engine/engine.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The blade at the end of a frame; see `scene_input`.
[[nodiscard]] std::optional<BladePose> blade_at(const std::vector<SceneStroke>& strokes, double frame_seconds,
                                                std::uint64_t frame);

}  // namespace app
}  // namespace v0
}  // namespace incise
