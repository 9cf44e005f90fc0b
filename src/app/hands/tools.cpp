// SPDX-License-Identifier: Apache-2.0
#include "app/hands/tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/hands/grip.h"
#include "app/hands/scalpel.h"
#include "app/view/plane_cut.h"

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
constexpr double kPinPixels = 12;    // from a pin, to let it go
constexpr double kCirclePixels = 7;  // where the pointer is
constexpr double kLeastLength = 1e-12, kMostLength = 1e12;
constexpr double kShallowest = 1e-3, kDeepest = 1;  // of the body's size, for the wheel

/// What a drag does.
enum class Drag : std::uint8_t { kNone, kOrbit, kPan, kScalpel, kPlaneCut, kGrasp, kPin, kProbe };

Drag drag_of(ToolKind tool) {
  constexpr std::array<Drag, static_cast<std::size_t>(ToolKind::kCount)> kDrags = {
      Drag::kOrbit, Drag::kScalpel, Drag::kPlaneCut, Drag::kGrasp, Drag::kPin, Drag::kProbe};
  return kDrags[static_cast<std::size_t>(tool)];
}

Drag drag_of(const PointerEvent& event, ToolKind tool) {
  const bool turns_view = event.button != Button::kLeft || event.alt;
  if (turns_view) return event.shift ? Drag::kPan : Drag::kOrbit;
  return event.shift ? Drag::kGrasp : drag_of(tool);
}

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
  return s;
}

bool is_sound(const PointerEvent& event, const ToolContext& context) {
  return event.pixel.allFinite() && std::isfinite(event.wheel) && context.viewport.width > 0 &&
         context.viewport.height > 0;
}

double size_of(const Box& body) {
  const double size = body.is_empty() ? 0 : (body.hi - body.lo).norm();
  return size > 0 && std::isfinite(size) ? size : 1;
}

/// The part of the surface that is drawn may be the inside of the body.
bool is_wall(const ToolContext& context, const SurfaceHit& hit) {
  const std::uint8_t flags = context.surface->topology->looks[hit.triangle].flags;
  return (flags & (TriangleLook::kWall | TriangleLook::kInside)) != 0;
}

PointerPlace place_of(const PointerEvent& event, const ToolContext& context, const Camera& camera) {
  PointerPlace place;
  place.pixel = event.pixel;
  place.ray = ray_through(camera, context.viewport, event.pixel);
  if (context.surface != nullptr) place.hit = pick(*context.surface, place.ray);
  place.is_wall = place.hit && is_wall(context, *place.hit);
  place.pressure = std::isfinite(event.pressure) ? std::clamp(event.pressure, 0.0, 1.0) : 1.0;
  return place;
}

void add_line(Marks& marks, const Vec3& from, const Vec3& to, Ink ink) {
  marks.lines.push_back({from.cast<float>(), to.cast<float>(), ink, 1.5F, true, false});
}

/// A circle that lies on the surface.
void draw_circle(const SurfaceHit& hit, double radius, Ink ink, Marks& marks) {
  constexpr int kCorners = 16;
  const Vec3 x = hit.normal.unitOrthogonal(), y = hit.normal.cross(x);
  Vec3 last = hit.point + radius * x;
  for (int i = 1; i <= kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    const Vec3 next = hit.point + radius * (std::cos(angle) * x + std::sin(angle) * y);
    add_line(marks, last, next, ink);
    last = next;
  }
}

}  // namespace

const char* name_of(ToolKind tool) {
  constexpr std::array<const char*, static_cast<std::size_t>(ToolKind::kCount)> kNames = {
      "Orbit", "Scalpel", "Plane cut", "Grasp", "Pin", "Probe"};
  return tool < ToolKind::kCount ? kNames[static_cast<std::size_t>(tool)] : "";
}

ToolSettings settings_for(const Box& body, double young, double length_unit) {
  const bool is_sound = !body.is_empty() && (body.hi - body.lo).allFinite() && (body.hi - body.lo).maxCoeff() > 0;
  const Vec3 sides = is_sound ? Vec3(body.hi - body.lo) : Vec3(Vec3::Ones());
  const double longest = sides.maxCoeff(), shortest = std::max(sides.minCoeff(), 0.01 * longest);
  ToolSettings s;
  s.depth = shortest / 8;
  s.grasp_radius = longest / 10;
  s.pin_radius = longest / 20;
  // What it takes to press a stiff disc into the tissue is about 2.7 · Young · radius: even where a grasp has a single
  // vertex, the tissue follows half of the way.
  s.grasp_stiffness = 3 * positive(young, 1e4) * s.grasp_radius * positive(length_unit, 1);
  s.pin_stiffness = 10 * s.grasp_stiffness;  // a pin stays where it is
  return in_range(s, s);
}

struct ToolMachine::State {
  ToolKind tool = ToolKind::kScalpel;
  ToolSettings settings{0.1, 0, 0.1, 100, 0.1, 1000};
  HandState hands;
  Drag drag = Drag::kNone;
  Button button = Button::kLeft;  // of the drag
  Vec2 pressed = Vec2::Zero();    // where it began
  Vec2 pixel = Vec2::Zero();      // where it is
  Scalpel scalpel;
  std::optional<PlaneCut> plane;
  std::optional<Grasp> grasp;
  std::vector<Hook> pins;
  std::optional<SurfaceHit> clicked;       // where the drag began
  std::optional<std::size_t> clicked_pin;  // on which pin
  std::optional<SurfaceHit> hover;
  std::optional<Stroke> plane_cut;
  std::optional<SurfaceHit> probed;
  std::uint32_t next_hook = 1;  // never used again, whatever is let go: a simulation may still know the old one

  void press(const PointerEvent& event, const ToolContext& context, Camera& camera);
  void move(const PointerEvent& event, const ToolContext& context, Camera& camera);
  void wheel(const PointerEvent& event, const ToolContext& context, Camera& camera);
  void release();
  bool stop();
  void take_hold(const SurfaceHit& hit, const Camera& camera);
  void toggle_pin();
  void refresh_hands();
  void draw_hover(const ToolContext& context, const Camera& camera, Marks& marks) const;
};

void ToolMachine::State::press(const PointerEvent& event, const ToolContext& context, Camera& camera) {
  if (drag != Drag::kNone) return;
  drag = drag_of(event, tool);
  button = event.button;
  pressed = pixel = event.pixel;
  hover.reset();
  if (drag == Drag::kOrbit || drag == Drag::kPan) return;
  const PointerPlace place = place_of(event, context, camera);
  clicked = place.hit;
  clicked_pin = find_pin(pins, camera, context.viewport, event.pixel, kPinPixels);
  if (drag == Drag::kScalpel) scalpel.press(place, settings);
  if (drag == Drag::kGrasp && place.hit) take_hold(*place.hit, camera);
}

void ToolMachine::State::take_hold(const SurfaceHit& hit, const Camera& camera) {
  grasp.emplace(Hook{next_hook++, hit.point, settings.grasp_radius, settings.grasp_stiffness}, camera);
}

void ToolMachine::State::move(const PointerEvent& event, const ToolContext& context, Camera& camera) {
  const Vec2 by = event.pixel - pixel;
  pixel = event.pixel;
  switch (drag) {
    case Drag::kNone:
      hover = tool == ToolKind::kOrbit ? std::nullopt : place_of(event, context, camera).hit;
      break;
    case Drag::kOrbit:
      orbit(camera, context.viewport, by);
      break;
    case Drag::kPan:
      pan(camera, context.viewport, by);
      break;
    case Drag::kScalpel:
      scalpel.move(place_of(event, context, camera), settings, size_of(context.body));
      break;
    case Drag::kPlaneCut:
      plane = plane_cut_between(camera, context.viewport, pressed, pixel, context.body);
      break;
    case Drag::kGrasp:
      if (grasp) grasp->move(ray_through(camera, context.viewport, pixel), camera);
      break;
    case Drag::kPin:
    case Drag::kProbe:
      break;
  }
}

void ToolMachine::State::wheel(const PointerEvent& event, const ToolContext& context, Camera& camera) {
  const double notches = std::clamp(event.wheel, -kMostNotches, kMostNotches);
  if (event.control) {
    const double size = size_of(context.body);
    const double depth = settings.depth * std::pow(kDepthPerNotch, notches);
    settings.depth = positive(std::clamp(depth, kShallowest * size, kDeepest * size), settings.depth);
  } else if (event.shift) {
    settings.angle = std::clamp(settings.angle + kAnglePerNotch * notches, -kMostAngle, kMostAngle);
  } else if (grasp) {
    grasp->push(notches, camera);
  } else if (drag == Drag::kNone || drag == Drag::kOrbit || drag == Drag::kPan) {
    zoom(camera, std::pow(kZoomPerNotch, notches), context.body);
  }
}

/// Ends what is under way: what it was for is done.
void ToolMachine::State::release() {
  const bool is_click = (pixel - pressed).norm() <= kClickPixels;
  if (drag == Drag::kPlaneCut && plane) plane_cut = to_stroke(*plane);
  if (drag == Drag::kPin && is_click) toggle_pin();
  if (drag == Drag::kProbe && is_click && clicked) probed = clicked;
  stop();
}

void ToolMachine::State::toggle_pin() {
  if (clicked_pin) {
    pins.erase(pins.begin() + static_cast<std::ptrdiff_t>(*clicked_pin));
  } else if (clicked) {
    pins.push_back({next_hook++, clicked->point, settings.pin_radius, settings.pin_stiffness});
  }
}

/// Ends what is under way, and nothing comes of it.
bool ToolMachine::State::stop() {
  const bool was_busy = drag != Drag::kNone;
  drag = Drag::kNone;
  scalpel.end();
  plane.reset();
  grasp.reset();
  clicked.reset();
  clicked_pin.reset();
  return was_busy;
}

void ToolMachine::State::refresh_hands() {
  hands.blade = scalpel.pose();
  hands.hooks = pins;
  if (grasp) hands.hooks.push_back(grasp->hook());
}

void ToolMachine::State::draw_hover(const ToolContext& context, const Camera& camera, Marks& marks) const {
  if (!hover) return;
  const double radius = kCirclePixels * camera.pixel_size(context.viewport, hover->point);
  draw_circle(*hover, radius, Ink::kPreview, marks);
  if (tool != ToolKind::kScalpel) return;
  const std::vector<Vec3> edge = upright_pose(hover->point, hover->normal, settings.depth).edge;
  add_line(marks, edge.front(), edge.back(), Ink::kPreview);
  marks.balls.push_back({edge.back().cast<float>(), Ink::kPreview, 3, true});
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
  const bool is_of_drag = s.drag != Drag::kNone && event.button == s.button;
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
  return state_->drag != Drag::kNone;
}

const HandState& ToolMachine::hands() const {
  return state_->hands;
}

std::optional<Stroke> ToolMachine::take_plane_cut() {
  return std::exchange(state_->plane_cut, std::nullopt);
}

std::optional<SurfaceHit> ToolMachine::take_probe() {
  return std::exchange(state_->probed, std::nullopt);
}

void ToolMachine::draw(const ToolContext& context, const Camera& camera, Marks& marks) const {
  const State& s = *state_;
  s.scalpel.draw(marks);
  if (s.plane) app::draw(*s.plane, camera, marks);
  if (s.grasp) s.grasp->draw(marks);
  draw_pins(s.pins, marks);
  s.draw_hover(context, camera, marks);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
