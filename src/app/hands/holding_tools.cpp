// SPDX-License-Identifier: Apache-2.0
// The tools that hold tissue: what each does with a drag.
#include <cmath>

#include "app/hands/grip.h"
#include "app/scene/tool_table.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kPinPixels = 12;        // from a pin or a hook that stays, to take it
constexpr double kJawsClosed = 0.5;      // share by which forceps gather what they hold
constexpr double kFirmness = 3;          // of what stays, per stiffness of a grasp
constexpr double kTied = 0.9;            // of the way between its ends at rest that a thread is left
constexpr double kHookShare = 0.5;       // of the radius of a grasp
constexpr double kRetractorShare = 1.5;  // likewise: it holds a length of the lip
constexpr const char* kNoTissue = "There is no tissue under the pointer";

/// Takes hold of the side of a wound that it is put on, and not of the one across.
Hook new_hook(const DragMoment& moment, const SurfaceHit& hit, double radius, double stiffness) {
  return {moment.next_hook++, hit.point, radius, stiffness, HookReach::kSurface, 0};
}

Ray ray_of(const DragMoment& moment) {
  return ray_through(moment.camera, moment.context.viewport, moment.event.pixel);
}

/// A pair of forceps: its jaws close on what it takes hold of, and open with the release.
class GraspTool final : public HandTool {
 public:
  void press(const DragMoment& moment) override {
    const PointerPlace place = moment.place();
    if (!place.hit) {
      moment.results.refusal = kNoTissue;
      return;
    }
    Hook hook = new_hook(moment, *place.hit, moment.settings.grasp_radius, moment.settings.grasp_stiffness);
    hook.closed = kJawsClosed;
    // Tissue is lifted, and pulled along the skin, but not pushed into the body.
    grasp_.emplace(hook, moment.camera, place.is_wall ? GraspWay::kAcross : GraspWay::kLifting, place.hit->normal);
    by_ = {InstrumentKind::kForceps, place.hit->normal, millimetre_of(moment.settings)};
  }
  void move(const DragMoment& moment) override {
    if (grasp_) grasp_->move(ray_of(moment), moment.camera);
  }
  bool push(double notches, const Camera& camera) override {
    if (grasp_) grasp_->push(notches, camera);
    return grasp_.has_value();
  }
  void stop() override { grasp_.reset(); }
  void add_to(HandState& hands) const override {
    if (grasp_) hands.hooks.push_back(grasp_->hook());
  }
  void draw(const Camera& camera, Marks& marks) const override {
    if (grasp_) grasp_->draw(marks);
    if (grasp_) marks.instruments.push_back(instrument_at(grasp_->hook(), grasp_->grasped(), by_, camera));
  }
  void draw_hover(const SurfaceHit& hit, const ToolSettings& settings, const Camera& camera,
                  Marks& marks) const override {
    draw_circle(hit.point, hit.normal, settings.grasp_radius, marks);
    Hook open;
    open.position = hit.point;
    open.radius = settings.grasp_radius;
    marks.instruments.push_back(
        instrument_at(open, hit.point, {InstrumentKind::kForceps, hit.normal, millimetre_of(settings)}, camera));
  }

 private:
  std::optional<Grasp> grasp_;
  HeldBy by_;
};

/// Hooks and retractors: a drag pulls the tissue, and what holds it stays where it is let go.
class StayingTool final : public HandTool {
 public:
  /// @param share  of the radius of a grasp that it takes hold of.
  StayingTool(InstrumentKind kind, double share) : kind_(kind), share_(share) {}

  void press(const DragMoment& moment) override {
    moving_ = find_held(moment);
    is_new_ = !moving_;
    if (moving_) return held_[*moving_].take(moment.camera);
    const PointerPlace place = moment.place();
    if (!place.hit) {
      moment.results.refusal = kNoTissue;
      return;
    }
    const ToolSettings& s = moment.settings;
    const Hook hook = new_hook(moment, *place.hit, share_ * s.grasp_radius, kFirmness * s.grasp_stiffness);
    const GraspWay way = place.is_wall ? GraspWay::kAcross : GraspWay::kAlongSurface;
    held_.emplace_back(hook, moment.camera, way, place.hit->normal);
    by_.push_back({kind_, place.hit->normal, millimetre_of(s)});
    moving_ = held_.size() - 1;
  }
  void move(const DragMoment& moment) override {
    if (moving_) held_[*moving_].move(ray_of(moment), moment.camera);
  }
  bool push(double notches, const Camera& camera) override {
    if (moving_) held_[*moving_].push(notches, camera);
    return moving_.has_value();
  }
  /// A click lets go of what it is on; on tissue it would hold without pulling, which is what pins are for.
  void release(bool is_click, const ToolSettings& /*settings*/, std::uint32_t& /*next_hook*/,
               DragResults& results) override {
    if (is_click && moving_ && is_new_) results.refusal = "Drag: it pulls the tissue, and stays where you let go";
    if (is_click && moving_) let_go();
    moving_.reset();
  }
  void stop() override {
    if (moving_ && is_new_) let_go();
    moving_.reset();
  }
  void add_to(HandState& hands) const override {
    for (const Grasp& grasp : held_) hands.hooks.push_back(grasp.hook());
  }
  void draw(const Camera& camera, Marks& marks) const override {
    for (std::size_t i = 0; i < held_.size(); ++i) {
      held_[i].draw(marks);
      marks.instruments.push_back(instrument_at(held_[i].hook(), held_[i].grasped(), by_[i], camera));
    }
  }
  void draw_hover(const SurfaceHit& hit, const ToolSettings& settings, const Camera& camera,
                  Marks& marks) const override {
    draw_circle(hit.point, hit.normal, share_ * settings.grasp_radius, marks);
    Hook hook;
    hook.position = hit.point;
    marks.instruments.push_back(instrument_at(hook, hit.point, {kind_, hit.normal, millimetre_of(settings)}, camera));
  }

 private:
  [[nodiscard]] std::optional<std::size_t> find_held(const DragMoment& moment) const {
    std::vector<Vec3> places;
    for (const Grasp& grasp : held_) places.push_back(grasp.hook().position);
    return find_place(places, moment.camera, moment.context.viewport, moment.event.pixel, kPinPixels);
  }
  void let_go() {
    held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(*moving_));
    by_.erase(by_.begin() + static_cast<std::ptrdiff_t>(*moving_));
  }

  InstrumentKind kind_;
  double share_;
  std::vector<Grasp> held_;
  std::vector<HeldBy> by_;             // of each
  std::optional<std::size_t> moving_;  // of them
  bool is_new_ = false;                // what moves
};

class PinTool final : public HandTool {
 public:
  void press(const DragMoment& moment) override {
    clicked_ = moment.place().hit;
    clicked_pin_ = find_pin(pins_, moment.camera, moment.context.viewport, moment.event.pixel, kPinPixels);
  }
  void release(bool is_click, const ToolSettings& settings, std::uint32_t& next_hook, DragResults& results) override {
    if (!is_click) {
      results.refusal = "A pin is set by a click, without a drag";
    } else if (clicked_pin_) {
      pins_.erase(pins_.begin() + static_cast<std::ptrdiff_t>(*clicked_pin_));
    } else if (clicked_) {
      const Hook hook{
          next_hook++, clicked_->point, settings.pin_radius, settings.pin_stiffness, HookReach::kSurface, 0};
      pins_.push_back({hook, clicked_->normal, millimetre_of(settings)});
    } else {
      results.refusal = kNoTissue;
    }
  }
  void stop() override {
    clicked_.reset();
    clicked_pin_.reset();
  }
  void add_to(HandState& hands) const override {
    for (const Pin& pin : pins_) hands.hooks.push_back(pin.hook);
  }
  void draw(const Camera& camera, Marks& marks) const override { draw_pins(pins_, camera, marks); }

 private:
  std::vector<Pin> pins_;
  std::optional<SurfaceHit> clicked_;       // where the drag began
  std::optional<std::size_t> clicked_pin_;  // on which pin
};

/// A stitch goes in where the drag begins, and comes out where it ends. Lips touch in the rest shape: the distance
/// there is that of its ends in the closed wound.
class StitchTool final : public HandTool {
 public:
  explicit StitchTool(bool pushes) : pushes_(pushes) {}

  void press(const DragMoment& moment) override { from_ = to_ = moment.place().hit; }
  void move(const DragMoment& moment) override { to_ = moment.place().hit; }
  void release(bool is_click, const ToolSettings& settings, std::uint32_t& /*next_hook*/,
               DragResults& results) override {
    if (!from_ || !to_) {
      results.refusal = "A stitch needs tissue at both ends of the drag";
    } else if (is_click || !((to_->rest - from_->rest).norm() > 0)) {
      results.refusal = "Drag from one lip of the wound to the other";
    } else {
      results.stitch = {{from_->rest, to_->rest}, suture(settings)};
    }
  }
  void stop() override {
    from_.reset();
    to_.reset();
  }
  void draw(const Camera& /*camera*/, Marks& marks) const override {
    if (!from_) return;
    const Eigen::Vector3f from = from_->point.cast<float>();
    marks.balls.push_back({from, Ink::kPreview, 4, true});
    if (!to_) return;
    marks.lines.push_back({from, to_->point.cast<float>(), Ink::kPreview, 3, true, true});
    marks.balls.push_back({to_->point.cast<float>(), Ink::kPreview, 4, true});
  }

 private:
  [[nodiscard]] Suture suture(const ToolSettings& settings) const {
    Suture suture;
    suture.stiffness = kFirmness * settings.grasp_stiffness;
    suture.rest_length = (pushes_ ? 1 : kTied) * settings.metres * (to_->rest - from_->rest).norm();
    suture.pushes = pushes_;
    return suture;
  }

  bool pushes_;
  std::optional<SurfaceHit> from_, to_;
};

}  // namespace

std::unique_ptr<HandTool> make_suture_tool() {
  return std::make_unique<StitchTool>(false);
}
std::unique_ptr<HandTool> make_staple_tool() {
  return std::make_unique<StitchTool>(true);
}
std::unique_ptr<HandTool> make_grasp_tool() {
  return std::make_unique<GraspTool>();
}
std::unique_ptr<HandTool> make_pin_tool() {
  return std::make_unique<PinTool>();
}
std::unique_ptr<HandTool> make_hook_tool() {
  return std::make_unique<StayingTool>(InstrumentKind::kHook, kHookShare);
}
std::unique_ptr<HandTool> make_retractor_tool() {
  return std::make_unique<StayingTool>(InstrumentKind::kRetractor, kRetractorShare);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
