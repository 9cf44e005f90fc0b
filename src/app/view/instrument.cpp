// SPDX-License-Identifier: Apache-2.0
// Measures in millimetres: those of a handle No. 3 with a blade No. 10, of tissue forceps of 13 cm, a skin hook, a
// Langenbeck retractor, straight scissors and a disposable punch, rounded.
#include "app/view/instrument.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kLeastBlade = 12;   // mm: a cut's depth is at most so much of a blade
constexpr double kDrawnShare = 0.6;  // of the size of real ones, which would hide much of a small picture
constexpr double kScalpelLean = 52 * std::numbers::pi / 180;  // of the handle above the skin
constexpr std::uint8_t kGhost = 120;                          // opacity

constexpr Finish kSteel{{196, 202, 209, 255}, 0.9F};
constexpr Finish kBlade{{224, 229, 234, 255}, 1.0F};
constexpr Finish kGrip{{64, 74, 84, 255}, 0.25F};

/// The instrument's own axes, and what it is made of.
struct Frame {
  Vec3 origin, ahead, side, up;
  double mm;
  bool is_ghost;

  [[nodiscard]] Vec3 at(double x, double y, double z) const { return origin + mm * (x * ahead + y * side + z * up); }
  [[nodiscard]] Finish made_of(Finish finish) const {
    if (is_ghost) finish.color[3] = kGhost;
    return finish;
  }
};

Frame frame_of(const Instrument& i) {
  Frame frame{i.tip, Vec3::Zero(), Vec3::Zero(), i.up, i.millimetre, i.is_ghost};
  const Vec3 flat = i.ahead - i.ahead.dot(i.up) * i.up;
  frame.ahead = flat.norm() > 1e-9 * i.ahead.norm() ? flat.normalized() : i.up.unitOrthogonal();
  frame.side = i.up.cross(frame.ahead);
  return frame;
}

/// x along the blade towards its point, y towards the back: the belly of a No. 10 is round.
constexpr std::array<std::array<double, 2>, 13> kNumber10 = {{{0, 1.2},
                                                              {0, -1.8},
                                                              {4, -2.4},
                                                              {10, -3.4},
                                                              {15, -3.5},
                                                              {19, -3.1},
                                                              {22, -2.3},
                                                              {24.5, -1},
                                                              {26, 0.7},
                                                              {26.6, 2.6},
                                                              {22, 3.2},
                                                              {12, 3.3},
                                                              {3, 2.6}}};

void add_scalpel(const Frame& f, std::vector<SolidCorner>& out) {
  // The blade's point goes ahead and down, so that the belly is what is deepest.
  const Vec3 axis = std::cos(kScalpelLean) * f.ahead - std::sin(kScalpelLean) * f.up;
  const Vec3 back = std::sin(kScalpelLean) * f.ahead + std::cos(kScalpelLean) * f.up;
  std::vector<Vec2> outline;
  double lowest = 1e9, lowest_ahead = 0;
  for (const auto& [x, y] : kNumber10) {
    outline.emplace_back(f.mm * x, f.mm * y);
    const Vec3 place = x * axis + y * back;
    if (place.dot(f.up) < lowest) {
      lowest = place.dot(f.up);
      lowest_ahead = place.dot(f.ahead);
    }
  }
  const Vec3 neck = f.origin - f.mm * (lowest_ahead * f.ahead + lowest * f.up);
  add_plate(outline, neck, axis, back, 0.5 * f.mm, f.made_of(kBlade), out);
  const auto on_handle = [&](double behind, double wide, double thick) {
    return BarSection{neck - f.mm * behind * axis, f.mm * wide, f.mm * thick};
  };
  const std::array<BarSection, 6> handle = {on_handle(-6, 1.6, 0.5), on_handle(2, 2.4, 0.9),  on_handle(14, 3.0, 1.3),
                                            on_handle(40, 4.6, 1.9), on_handle(95, 4.2, 1.9), on_handle(118, 2.6, 1.2)};
  add_bar(handle, back, 4, f.made_of(kSteel), out);
}

void add_forceps(const Frame& f, double opening, std::vector<SolidCorner>& out) {
  for (const double s : {-1.0, 1.0}) {
    const double half = 0.5 * opening / f.mm;
    const std::array<BarSection, 5> arm = {BarSection{f.at(0, s * half, 0), 0.8 * f.mm, 0.5 * f.mm},
                                           {f.at(0, s * (half + 0.6), 14), 1.5 * f.mm, 0.7 * f.mm},
                                           {f.at(0, s * (half + 4.5), 45), 3.4 * f.mm, 0.9 * f.mm},
                                           {f.at(0, s * (0.6 * half + 4.5), 80), 4.4 * f.mm, 0.9 * f.mm},
                                           {f.at(0, s * 0.8, 125), 3.6 * f.mm, 0.9 * f.mm}};
    add_bar(arm, f.ahead, 4, f.made_of(kSteel), out);
  }
}

/// A shaft that ends in half a ring, whose point is the tip: it comes over the lip that it pulls, and lies above the
/// skin where it leans.
void add_hook(const Frame& f, std::vector<SolidCorner>& out) {
  constexpr double kRadius = 3.2;
  std::vector<BarSection> way;
  for (int i = 0; i <= 8; ++i) {
    const double turn = std::numbers::pi * i / 8;
    const double thick = f.mm * (0.15 + 0.75 * std::min(1.0, i / 5.0));
    way.push_back({f.at(-kRadius * (1 - std::cos(turn)), 0, -kRadius * std::sin(turn)), thick, thick});
  }
  for (const auto& [z, thick] : {std::pair{20.0, 1.0}, {60.0, 1.3}, {64.0, 2.6}, {120.0, 2.8}, {124.0, 1.6}}) {
    way.push_back({f.at(-2 * kRadius, 0, z), f.mm * thick, f.mm * thick});
  }
  add_bar(way, f.side, 8, f.made_of(kSteel), out);
}

/// A blade that is bent towards where it pulls, on a flat handle.
void add_retractor(const Frame& f, std::vector<SolidCorner>& out) {
  const std::array<BarSection, 7> way = {BarSection{f.at(-1.5, 0, -5), 5.5 * f.mm, 0.4 * f.mm},
                                         {f.at(0, 0, -3), 6 * f.mm, 0.7 * f.mm},
                                         {f.at(1, 0, 10), 6 * f.mm, 0.8 * f.mm},
                                         {f.at(4, 0, 17), 5 * f.mm, 1.1 * f.mm},
                                         {f.at(16, 0, 24), 3.6 * f.mm, 1.3 * f.mm},
                                         {f.at(70, 0, 52), 3.6 * f.mm, 1.4 * f.mm},
                                         {f.at(120, 0, 77), 6 * f.mm, 1.4 * f.mm}};
  add_bar(way, f.side, 4, f.made_of(kSteel), out);
}

void add_ring(const Vec3& centre, const Vec3& x, const Vec3& y, double radius, double thick, const Finish& finish,
              std::vector<SolidCorner>& out) {
  constexpr int kSteps = 20;
  std::vector<BarSection> way;
  for (int i = 0; i <= kSteps; ++i) {
    const double turn = 2 * std::numbers::pi * i / kSteps;
    way.push_back({centre + radius * (std::cos(turn) * x + std::sin(turn) * y), thick, thick});
  }
  add_bar(way, x.cross(y), 6, finish, out);
}

/// Two blades through the hinge; behind it each ends in a ring for a finger.
void add_scissors(const Instrument& i, std::vector<SolidCorner>& out) {
  const double mm = i.millimetre;
  const Vec3 a = i.tip - i.hinge, b = i.other_tip - i.hinge;
  Vec3 axis = a.cross(b);
  axis = axis.norm() > 0 ? axis.normalized() : Vec3(i.up.unitOrthogonal());
  Frame f = frame_of(i);
  for (const Vec3& blade : {a, b}) {
    const double length = std::max(blade.norm(), 1e-9);
    const Vec3 ahead = blade / length, across = axis.cross(ahead);
    const double wide = std::min(3.0 * mm, 0.2 * length);
    const Vec3 ring = i.hinge - 62 * mm * ahead;
    const std::array<BarSection, 4> bar = {BarSection{i.hinge + blade, 0.15 * wide, 0.2 * mm},
                                           {i.hinge + 0.6 * blade, 0.7 * wide, 0.5 * mm},
                                           {i.hinge, wide, 0.9 * mm},
                                           {i.hinge - 54 * mm * ahead, 1.7 * mm, 1.3 * mm}};
    add_bar(bar, across, 4, f.made_of(kSteel), out);
    add_ring(ring, ahead, across, 9 * mm, 1.5 * mm, f.made_of(kSteel), out);
  }
  const std::array<BarSection, 2> screw = {BarSection{i.hinge - 1.6 * mm * axis, 1.8 * mm, 1.8 * mm},
                                           {i.hinge + 1.6 * mm * axis, 1.8 * mm, 1.8 * mm}};
  add_bar(screw, axis.unitOrthogonal(), 8, f.made_of(kGrip), out);
}

void add_punch(const Frame& f, double radius, std::vector<SolidCorner>& out) {
  const auto section = [&](double z, double r) { return BarSection{f.at(0, 0, z), r, r}; };
  const double r = std::max(radius, 0.5 * f.mm), grip = std::max(1.15 * r, 4.5 * f.mm);
  const std::array<BarSection, 3> tube = {section(0, r), section(0.4, 1.03 * r), section(16, 1.03 * r)};
  add_bar(tube, f.side, 20, f.made_of(kBlade), out);
  const std::array<BarSection, 5> handle = {section(16, 1.05 * r), section(22, grip), section(70, 0.85 * grip),
                                            section(96, grip), section(100, 0.8 * grip)};
  add_bar(handle, f.side, 12, f.made_of(kGrip), out);
}

}  // namespace

double instrument_millimetre(double metres_per_unit, double depth) {
  const double real = metres_per_unit > 0 ? kDrawnShare * 1e-3 / metres_per_unit : 0;
  return std::max(real, depth / kLeastBlade);
}

void add_solid(const Instrument& instrument, std::vector<SolidCorner>& out) {
  const Frame frame = frame_of(instrument);
  switch (instrument.kind) {
    case InstrumentKind::kScalpel:
      return add_scalpel(frame, out);
    case InstrumentKind::kForceps:
      return add_forceps(frame, instrument.opening, out);
    case InstrumentKind::kHook:
      return add_hook(frame, out);
    case InstrumentKind::kRetractor:
      return add_retractor(frame, out);
    case InstrumentKind::kScissors:
      return add_scissors(instrument, out);
    case InstrumentKind::kPunch:
      return add_punch(frame, instrument.opening, out);
  }
}

}  // namespace app
}  // namespace v0
}  // namespace incise
