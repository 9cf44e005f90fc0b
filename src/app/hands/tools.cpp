// SPDX-License-Identifier: Apache-2.0
// One drag at a time: its press decides whether the view, a grasp or the chosen tool has it, and all later events go
// there. What the hands do is made anew from the tools after each event.
#include "app/hands/tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/hands/grip.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

using Kind = PointerEvent::Kind;
using Button = PointerEvent::Button;

constexpr double kMostAngle = 1.2;
constexpr double kDepthPerNotch = 1.1;
constexpr double kAnglePerNotch = 5 * std::numbers::pi / 180;
constexpr double kZoomPerNotch = 0.9;
constexpr double kMostNotches = 20;  // of one event
constexpr double kClickPixels = 5;   // that the pointer may move in a click
constexpr double kCirclePixels = 7;  // where the pointer is
constexpr double kLeastLength = 1e-12, kMostLength = 1e12;
constexpr double kShallowest = 1e-3, kDeepest = 1;  // of the body's size, for the wheel

/// `value` within its range; `otherwise` where it is none.
double positive(double value, double otherwise) {
  return value > 0 && std::isfinite(value) ? std::clamp(value, kLeastLength, kMostLength) : otherwise;
}

ToolSettings in_range(const ToolSettings& asked, const ToolSettings& before) {
  ToolSettings s;
  s.depth = positive(asked.depth, before.depth);
  s.angle = std::isfinite(asked.angle) ? std::clamp(asked.angle, -kMostAngle, kMostAngle) : before.angle;
  s.grasp_radius = positive(asked.grasp_radius, before.grasp_radius);
  s.grasp_stiffness = positive(asked.grasp_stiffness, before.grasp_stiffness);
  s.pin_radius = positive(asked.pin_radius, before.pin_radius);
  s.pin_stiffness = positive(asked.pin_stiffness, before.pin_stiffness);
  s.metres = positive(asked.metres, before.metres);
  s.punch_radius = positive(asked.punch_radius, before.punch_radius);
  return s;
}

bool is_sound(const PointerEvent& event, const ToolContext& context) {
  return event.pixel.allFinite() && std::isfinite(event.wheel) && context.viewport.width > 0 &&
         context.viewport.height > 0;
}

double span_of(const Box& body) {
  const double size = body.is_empty() ? 0 : (body.hi - body.lo).norm();
  return size > 0 && std::isfinite(size) ? size : 1;
}

}  // namespace

ToolSettings settings_for(const Box& body, double young, double length_unit) {
  const bool is_sound = !body.is_empty() && (body.hi - body.lo).allFinite() && (body.hi - body.lo).maxCoeff() > 0;
  const Vec3 sides = is_sound ? Vec3(body.hi - body.lo) : Vec3(Vec3::Ones());
  const double longest = sides.maxCoeff(), shortest = std::max(sides.minCoeff(), 0.01 * longest);
  ToolSettings s;
  s.depth = shortest / 8;
  s.grasp_radius = longest / 10;
  s.pin_radius = longest / 20;
  s.punch_radius = shortest / 6;
  s.metres = positive(length_unit, 1);
  // What it takes to press a stiff disc into the tissue is about 2.7 · Young · radius: even where a grasp has a single
  // vertex, the tissue follows half of the way.
  s.grasp_stiffness = 3 * positive(young, 1e4) * s.grasp_radius * positive(length_unit, 1);
  s.pin_stiffness = 10 * s.grasp_stiffness;  // a pin stays where it is
  return in_range(s, s);
}

struct ToolMachine::State {
  /// What a drag does.
  enum class Drag : std::uint8_t { kNone, kOrbit, kPan, kTool };

  State() {
    for (std::size_t i = 0; i < kToolCount; ++i) tools[i] = kTools[i].make != nullptr ? kTools[i].make() : nullptr;
  }

  std::array<std::unique_ptr<HandTool>, kToolCount> tools;  // by kind; null: turns the view
  ToolKind tool = ToolKind::kScalpel;
  ToolSettings settings{0.1, 0, 0.1, 100, 0.1, 1000};
  HandState hands;
  Drag drag = Drag::kNone;
  HandTool* active = nullptr;     // of the drag
  Button button = Button::kLeft;  // likewise
  Vec2 pressed = Vec2::Zero();    // where it began
  Vec2 pixel = Vec2::Zero();      // where it is
  std::optional<SurfaceHit> hover;
  DragResults results;
  std::uint32_t next_hook = 1;  // never used again, whatever is let go: a simulation may still know the old one

  [[nodiscard]] HandTool* tool_of(ToolKind kind) const { return tools[static_cast<std::size_t>(kind)].get(); }
  void choose_drag(const PointerEvent& event);
  void press(const PointerEvent& event, const ToolContext& context, Camera& camera);
  void move(const PointerEvent& event, const ToolContext& context, Camera& camera);
  void wheel(const PointerEvent& event, const ToolContext& context, Camera& camera);
  void release();
  bool stop();
  void refresh_hands();
  void draw_hover(const ToolContext& context, const Camera& camera, Marks& marks) const;
};

void ToolMachine::State::choose_drag(const PointerEvent& event) {
  const bool turns_view = event.button != Button::kLeft || event.alt;
  active = turns_view ? nullptr : tool_of(event.shift ? ToolKind::kGrasp : tool);
  drag = active != nullptr ? Drag::kTool : (turns_view && event.shift ? Drag::kPan : Drag::kOrbit);
}

void ToolMachine::State::press(const PointerEvent& event, const ToolContext& context, Camera& camera) {
  if (drag != Drag::kNone) return;
  choose_drag(event);
  button = event.button;
  pressed = pixel = event.pixel;
  hover.reset();
  if (active != nullptr) active->press({event, context, camera, settings, pressed, next_hook, results});
}

void ToolMachine::State::move(const PointerEvent& event, const ToolContext& context, Camera& camera) {
  const Vec2 by = event.pixel - pixel;
  pixel = event.pixel;
  switch (drag) {
    case Drag::kNone:
      hover = tool_of(tool) == nullptr ? std::nullopt : place_of(event, context, camera).hit;
      break;
    case Drag::kOrbit:
      orbit(camera, context.viewport, by);
      break;
    case Drag::kPan:
      pan(camera, context.viewport, by);
      break;
    case Drag::kTool:
      active->move({event, context, camera, settings, pressed, next_hook, results});
      break;
  }
}

void ToolMachine::State::wheel(const PointerEvent& event, const ToolContext& context, Camera& camera) {
  const double notches = std::clamp(event.wheel, -kMostNotches, kMostNotches);
  if (event.control) {
    const double size = span_of(context.body);
    const double depth = settings.depth * std::pow(kDepthPerNotch, notches);
    settings.depth = positive(std::clamp(depth, kShallowest * size, kDeepest * size), settings.depth);
  } else if (event.shift) {
    settings.angle = std::clamp(settings.angle + kAnglePerNotch * notches, -kMostAngle, kMostAngle);
  } else if (active != nullptr) {
    active->push(notches, camera);
  } else {
    zoom(camera, std::pow(kZoomPerNotch, notches), context.body);
  }
}

/// Ends what is under way: what it was for is done.
void ToolMachine::State::release() {
  const bool is_click = (pixel - pressed).norm() <= kClickPixels;
  if (active != nullptr) active->release(is_click, settings, next_hook, results);
  stop();
}

/// Ends what is under way, and nothing comes of it.
bool ToolMachine::State::stop() {
  const bool was_busy = drag != Drag::kNone;
  drag = Drag::kNone;
  active = nullptr;
  for (const auto& each : tools) {
    if (each != nullptr) each->stop();
  }
  return was_busy;
}

/// Pins come before what is grasped: from the last tool to the first.
void ToolMachine::State::refresh_hands() {
  hands = {};
  for (std::size_t i = kToolCount; i-- > 0;) {
    if (tools[i] != nullptr) tools[i]->add_to(hands);
  }
}

void ToolMachine::State::draw_hover(const ToolContext& context, const Camera& camera, Marks& marks) const {
  if (!hover) return;
  const double radius = kCirclePixels * camera.pixel_size(context.viewport, hover->point);
  draw_circle(hover->point, hover->normal, radius, marks);
  if (const HandTool* chosen = tool_of(tool)) chosen->draw_hover(*hover, settings, camera, marks);
}

ToolMachine::ToolMachine(const ToolSettings& settings) : state_(std::make_unique<State>()) {
  set(settings);
}
ToolMachine::ToolMachine(ToolMachine&&) noexcept = default;
ToolMachine& ToolMachine::operator=(ToolMachine&&) noexcept = default;
ToolMachine::~ToolMachine() = default;

ToolKind ToolMachine::tool() const {
  return state_->tool;
}

void ToolMachine::choose(ToolKind tool) {
  if (tool >= ToolKind::kCount) return;
  if (is_busy()) state_->release();
  state_->tool = tool;
  state_->hover.reset();
  state_->refresh_hands();
}

const ToolSettings& ToolMachine::settings() const {
  return state_->settings;
}

void ToolMachine::set(const ToolSettings& settings) {
  state_->settings = in_range(settings, state_->settings);
}

void ToolMachine::handle(const PointerEvent& event, const ToolContext& context, Camera& camera) {
  if (!is_sound(event, context)) return;
  State& s = *state_;
  const bool is_of_drag = s.drag != State::Drag::kNone && event.button == s.button;
  if (event.kind == Kind::kPress) s.press(event, context, camera);
  if (event.kind == Kind::kMove) s.move(event, context, camera);
  if (event.kind == Kind::kRelease && is_of_drag) {
    s.move(event, context, camera);
    s.release();
  }
  if (event.kind == Kind::kWheel) s.wheel(event, context, camera);
  s.refresh_hands();
}

bool ToolMachine::cancel() {
  const bool was_busy = state_->stop();
  state_->refresh_hands();
  return was_busy;
}

void ToolMachine::reset(const ToolSettings& settings) {
  State fresh;
  fresh.tool = state_->tool;
  fresh.next_hook = state_->next_hook;
  *state_ = std::move(fresh);
  set(settings);
}

bool ToolMachine::is_busy() const {
  return state_->drag != State::Drag::kNone;
}

bool ToolMachine::is_on_tissue() const {
  return state_->hover.has_value();
}

const HandState& ToolMachine::hands() const {
  return state_->hands;
}

bool ToolMachine::is_pulling() const {
  HandState pulled;
  for (std::size_t i = 0; i < kToolCount; ++i) {
    if (kTools[i].pulls) state_->tools[i]->add_to(pulled);
  }
  return !pulled.hooks.empty();
}

std::optional<Stroke> ToolMachine::take_stroke() {
  return std::exchange(state_->results.stroke, std::nullopt);
}

std::optional<Stitch> ToolMachine::take_stitch() {
  return std::exchange(state_->results.stitch, std::nullopt);
}

std::optional<SurfaceHit> ToolMachine::take_probe() {
  return std::exchange(state_->results.probed, std::nullopt);
}

std::string ToolMachine::take_refusal() {
  return std::exchange(state_->results.refusal, {});
}

void ToolMachine::draw(const ToolContext& context, const Camera& camera, Marks& marks) const {
  const State& s = *state_;
  for (const auto& each : s.tools) {
    if (each != nullptr) each->draw(camera, marks);
  }
  s.draw_hover(context, camera, marks);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
