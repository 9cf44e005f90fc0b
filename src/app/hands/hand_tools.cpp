// SPDX-License-Identifier: Apache-2.0
// The tools: what each does with a drag.
#include <algorithm>
#include <cmath>

#include "app/hands/grip.h"
#include "app/hands/scalpel.h"
#include "app/hands/tool_table.h"
#include "app/view/plane_cut.h"

namespace incise {
inline namespace v0 {
namespace app {

namespace {

constexpr double kPinPixels = 12;  // from a pin, to let it go

double size_of(const Box& body) {
  const double size = body.is_empty() ? 0 : (body.hi - body.lo).norm();
  return size > 0 && std::isfinite(size) ? size : 1;
}

/// The part of the surface that is drawn may be the inside of the body.
bool is_wall(const ToolContext& context, const SurfaceHit& hit) {
  const std::uint8_t flags = context.surface->topology->looks[hit.triangle].flags;
  return (flags & (TriangleLook::kWall | TriangleLook::kInside)) != 0;
}

class ScalpelTool final : public HandTool {
 public:
  void press(const DragMoment& moment) override { scalpel_.press(moment.place(), moment.settings); }
  void move(const DragMoment& moment) override {
    scalpel_.move(moment.place(), moment.settings, size_of(moment.context.body));
  }
  void stop() override { scalpel_.end(); }
  void add_to(HandState& hands) const override { hands.blade = scalpel_.pose(); }
  void draw(const Camera& /*camera*/, Marks& marks) const override { scalpel_.draw(marks); }
  void draw_hover(const SurfaceHit& hit, const ToolSettings& settings, Marks& marks) const override {
    const std::vector<Vec3> edge = upright_pose(hit.point, hit.normal, settings.depth).edge;
    marks.lines.push_back({edge.front().cast<float>(), edge.back().cast<float>(), Ink::kPreview, 1.5F, true, false});
    marks.balls.push_back({edge.back().cast<float>(), Ink::kPreview, 3, true});
  }

 private:
  Scalpel scalpel_;
};

class PlaneCutTool final : public HandTool {
 public:
  void move(const DragMoment& moment) override {
    plane_ = plane_cut_between(moment.camera, moment.context.viewport, moment.pressed, moment.event.pixel,
                               moment.context.body);
  }
  void release(bool /*is_click*/, const ToolSettings& /*settings*/, std::uint32_t& /*next_hook*/,
               DragResults& results) override {
    if (plane_) results.plane_cut = to_stroke(*plane_);
  }
  void stop() override { plane_.reset(); }
  void draw(const Camera& camera, Marks& marks) const override {
    if (plane_) app::draw(*plane_, camera, marks);
  }

 private:
  std::optional<PlaneCut> plane_;
};

class GraspTool final : public HandTool {
 public:
  void press(const DragMoment& moment) override {
    const PointerPlace place = moment.place();
    if (!place.hit) return;
    const ToolSettings& settings = moment.settings;
    grasp_.emplace(Hook{moment.next_hook++, place.hit->point, settings.grasp_radius, settings.grasp_stiffness},
                   moment.camera);
  }
  void move(const DragMoment& moment) override {
    if (grasp_) {
      grasp_->move(ray_through(moment.camera, moment.context.viewport, moment.event.pixel), moment.camera);
    }
  }
  bool push(double notches, const Camera& camera) override {
    if (grasp_) grasp_->push(notches, camera);
    return grasp_.has_value();
  }
  void stop() override { grasp_.reset(); }
  void add_to(HandState& hands) const override {
    if (grasp_) hands.hooks.push_back(grasp_->hook());
  }
  void draw(const Camera& /*camera*/, Marks& marks) const override {
    if (grasp_) grasp_->draw(marks);
  }

 private:
  std::optional<Grasp> grasp_;
};

class PinTool final : public HandTool {
 public:
  void press(const DragMoment& moment) override {
    clicked_ = moment.place().hit;
    clicked_pin_ = find_pin(pins_, moment.camera, moment.context.viewport, moment.event.pixel, kPinPixels);
  }
  void release(bool is_click, const ToolSettings& settings, std::uint32_t& next_hook,
               DragResults& /*results*/) override {
    if (!is_click) return;
    if (clicked_pin_) {
      pins_.erase(pins_.begin() + static_cast<std::ptrdiff_t>(*clicked_pin_));
    } else if (clicked_) {
      pins_.push_back({next_hook++, clicked_->point, settings.pin_radius, settings.pin_stiffness});
    }
  }
  void stop() override {
    clicked_.reset();
    clicked_pin_.reset();
  }
  void add_to(HandState& hands) const override { hands.hooks.insert(hands.hooks.end(), pins_.begin(), pins_.end()); }
  void draw(const Camera& /*camera*/, Marks& marks) const override { draw_pins(pins_, marks); }

 private:
  std::vector<Hook> pins_;
  std::optional<SurfaceHit> clicked_;       // where the drag began
  std::optional<std::size_t> clicked_pin_;  // on which pin
};

class ProbeTool final : public HandTool {
 public:
  void press(const DragMoment& moment) override { clicked_ = moment.place().hit; }
  void release(bool is_click, const ToolSettings& /*settings*/, std::uint32_t& /*next_hook*/,
               DragResults& results) override {
    if (is_click && clicked_) results.probed = clicked_;
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

std::unique_ptr<HandTool> make_scalpel_tool() {
  return std::make_unique<ScalpelTool>();
}
std::unique_ptr<HandTool> make_plane_cut_tool() {
  return std::make_unique<PlaneCutTool>();
}
std::unique_ptr<HandTool> make_grasp_tool() {
  return std::make_unique<GraspTool>();
}
std::unique_ptr<HandTool> make_pin_tool() {
  return std::make_unique<PinTool>();
}
std::unique_ptr<HandTool> make_probe_tool() {
  return std::make_unique<ProbeTool>();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
