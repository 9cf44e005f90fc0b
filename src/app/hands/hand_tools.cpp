// SPDX-License-Identifier: Apache-2.0
// What tools go by, and the tool that only asks.
#include <algorithm>
#include <cmath>

#include "app/hands/hand_tool.h"
#include "app/scene/tool_table.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// The part of the surface that is drawn may be the inside of the body.
bool is_wall(const ToolContext& context, const SurfaceHit& hit) {
  const std::uint8_t flags = context.surface->topology->looks[hit.triangle].flags;
  return (flags & (TriangleLook::kWall | TriangleLook::kInside)) != 0;
}

class ProbeTool final : public HandTool {
 public:
  void press(const DragMoment& moment) override { clicked_ = moment.place().hit; }
  void release(bool is_click, const ToolSettings& /*settings*/, std::uint32_t& /*next_hook*/,
               DragResults& results) override {
    if (is_click && clicked_) {
      results.probed = clicked_;
    } else {
      results.refusal = is_click ? "There is no tissue under the pointer" : "The probe asks by a click, without a drag";
    }
  }
  void stop() override { clicked_.reset(); }

 private:
  std::optional<SurfaceHit> clicked_;
};

}  // namespace

PointerPlace place_of(const PointerEvent& event, const ToolContext& context, const Camera& camera) {
  PointerPlace place;
  place.pixel = event.pixel;
  place.ray = ray_through(camera, context.viewport, event.pixel);
  if (context.surface != nullptr) place.hit = pick(*context.surface, place.ray);
  place.is_wall = place.hit && is_wall(context, *place.hit);
  place.pressure = std::isfinite(event.pressure) ? std::clamp(event.pressure, 0.0, 1.0) : 1.0;
  return place;
}

std::unique_ptr<HandTool> make_probe_tool() {
  return std::make_unique<ProbeTool>();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
