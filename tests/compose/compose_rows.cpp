// SPDX-License-Identifier: Apache-2.0
#include "compose/compose_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "support/random.h"

namespace incise::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kWhole = 1.1;  // as far from the middle as a plane reaches, and a little beyond
constexpr double kStep = 0.11;  // of the blade, at most
constexpr double kMeet = 0.03;  // where two strokes meet

std::string named(const std::string& what, double value) {
  std::string digits = std::to_string(value);
  while (digits.back() == '0') digits.pop_back();
  if (digits.back() == '.') digits.pop_back();
  return what + " " + digits;
}

/// A plane through the cube: an edge along `a` that is swept along `b`.
struct Plane {
  std::string name;
  Vec3 centre, a, n, b;

  [[nodiscard]] Row at(double s, double from = -2.0, double to = 2.0, double lift = 0.0) const {
    return {centre + s * b + from * a + lift * n, centre + s * b + to * a + lift * n};
  }
  [[nodiscard]] BladePath sweep(double from, double to, double low = -2.0, double high = 2.0, double lift = 0.0) const {
    const auto steps = static_cast<unsigned>(std::max(1.0, std::ceil(std::abs(to - from) / kStep)));
    BladePath rows;
    for (unsigned i = 0; i <= steps; ++i) rows.push_back(at(from + (to - from) * i / steps, low, high, lift));
    return rows;
  }
  [[nodiscard]] BladePath whole() const { return sweep(-kWhole, kWhole); }
  /// The same, turned about its direction of motion.
  [[nodiscard]] Plane turned(double angle) const {
    Plane other = *this;
    other.a = std::cos(angle) * a + std::sin(angle) * n;
    other.n = std::cos(angle) * n - std::sin(angle) * a;
    return other;
  }
};

Plane oblique_plane() {
  const Vec3 a = Vec3(0.9, 0.3, 0.2).normalized(), n = a.cross(Vec3(0.1, 0.8, 0.5)).normalized();
  return {"oblique", Vec3(0.52, 0.47, 0.55), a, n, n.cross(a)};
}

/// Along the mesh's axes, but between its planes.
Plane straight_plane() {
  return {"straight", Vec3(0.43, 0.5, 0.5), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0)};
}

class Table {
 public:
  std::vector<ComposeRow> make() {
    for (const Plane& plane : {oblique_plane(), straight_plane()}) {
      abutting(plane);
      overlapping(plane);
      deeper(plane);
    }
    on_mesh_planes(straight_plane());
    arcs();
    again(oblique_plane());
    parallel(oblique_plane());
    tees(oblique_plane());
    crosses(oblique_plane());
    short_steps(straight_plane(), 0.55);
    short_steps(oblique_plane(), 0.9);
    return std::move(rows_);
  }

 private:
  ComposeRow& add(const std::string& name, BladePaths strokes, BladePaths single, std::size_t pieces = 2) {
    rows_.push_back({name, std::move(strokes), std::move(single), pieces});
    return rows_.back();
  }

  void abutting(const Plane& plane) {
    for (const unsigned count : {2U, 3U, 4U, 7U, 14U, 28U}) {
      BladePaths strokes;
      for (unsigned i = 0; i < count; ++i) {
        strokes.push_back(plane.sweep(-kWhole + 2 * kWhole * i / count, -kWhole + 2 * kWhole * (i + 1) / count));
      }
      add(named("abutting " + plane.name, count), strokes, {plane.whole()});
    }
  }

  /// One stroke from either end, or both from the same; how they meet is told in elements.
  void overlapping(const Plane& plane) {
    for (const double lap : {0.05, 0.25, 0.5, 1.0, 2.0}) {
      add(named("overlap " + plane.name, lap),
          {plane.sweep(-kWhole, kMeet), plane.sweep(kMeet - lap * kElement, kWhole)}, {plane.whole()});
    }
    for (const double gap : {0.02, 0.1, 0.25}) {
      ComposeRow& row =
          add(named("gap " + plane.name, gap),
              {plane.sweep(-kWhole, kMeet), plane.sweep(kMeet + gap * kElement, kWhole)}, {plane.whole()});
      row.is_short = gap > 0.05;
      row.pieces = row.is_short ? 1 : 2;
    }
    for (const double over : {0.0, 0.05, 0.25, -0.05, -0.25}) {
      ComposeRow& row =
          add(named("both sides " + plane.name, over),
              {plane.sweep(-kWhole, kMeet), plane.sweep(kWhole, kMeet - over * kElement)}, {plane.whole()});
      row.is_short = over < -0.1;
      row.pieces = row.is_short ? 1 : 2;
    }
    add("both sides skew 5 degrees " + plane.name, {plane.sweep(-kWhole, kMeet), skew(plane)}, {plane.whole()});
  }
  /// From the other side to where the first stroke ended, at an angle of 5 degrees to it.
  static BladePath skew(const Plane& plane) {
    Plane other = plane;
    const double angle = kPi / 36;
    other.centre = plane.centre + kMeet * plane.b;
    other.b = std::cos(angle) * plane.b + std::sin(angle) * plane.n;
    other.n = std::cos(angle) * plane.n - std::sin(angle) * plane.b;
    return other.sweep(kWhole, 0.0);
  }

  void deeper(const Plane& plane) {
    for (const unsigned count : {2U, 4U, 8U}) {
      BladePaths strokes;
      for (unsigned i = 0; i + 1 < count; ++i) {
        strokes.push_back(plane.sweep(-kWhole, kWhole, -2.0, -0.5 + (i + 1.0) / count));
      }
      strokes.push_back(plane.whole());
      add(named("deeper " + plane.name, count), strokes, {plane.whole()});
    }
    add("other side " + plane.name, {plane.sweep(-kWhole, kWhole, -2.0, 0.04), plane.sweep(-kWhole, kWhole, 2.0, 0.04)},
        {plane.whole()});
  }

  /// Each stroke ends exactly on a plane of the mesh; the first and the last but one on the skin.
  void on_mesh_planes(const Plane& plane) {
    BladePaths strokes = {plane.sweep(-kWhole, -0.5)};
    for (unsigned i = 0; i < 5; ++i) strokes.push_back(plane.sweep(-0.5 + 0.2 * i, i == 4 ? 0.5 : -0.3 + 0.2 * i));
    strokes.push_back(plane.sweep(0.5, kWhole));
    add("ends on mesh planes", strokes, {plane.whole()});
    add("ends on the skin", {plane.sweep(-kWhole, 0.5), plane.sweep(0.5, kWhole)}, {plane.whole()});
    add("ends just below the skin", {plane.sweep(-kWhole, 0.498), plane.sweep(0.498, kWhole)}, {plane.whole()});
  }

  /// A blade along z on a circle around (x, y), from one angle to another; the last point may be off by `shift`.
  static BladePath arc(const Vec3& middle, double radius, double from, double to, double shift = 0.0) {
    const auto steps = static_cast<unsigned>(std::ceil(std::abs(to - from) * radius / kStep));
    BladePath rows;
    for (unsigned i = 0; i <= steps; ++i) {
      const double angle = from + (to - from) * i / steps, r = i == steps ? radius + shift : radius;
      const Vec3 p = middle + r * Vec3(std::cos(angle), std::sin(angle), 0);
      rows.push_back({p - Vec3(0, 0, 1.5), p + Vec3(0, 0, 1.5)});
    }
    return rows;
  }
  static BladePaths arcs_of(const Vec3& middle, double radius, double from, double to, unsigned count) {
    BladePaths strokes;
    for (unsigned i = 0; i < count; ++i) {
      strokes.push_back(arc(middle, radius, from + (to - from) * i / count, from + (to - from) * (i + 1) / count));
    }
    return strokes;
  }
  void arcs() {
    const Vec3 outside(1.05, 1.1, 0.5), middle(0.52, 0.49, 0.5);
    for (const unsigned count : {3U, 7U}) {
      add(named("abutting cylinder", count), arcs_of(outside, 0.77, 0.8 * kPi, 1.7 * kPi, count),
          arcs_of(outside, 0.77, 0.8 * kPi, 1.7 * kPi, 1));
    }
    add("abutting cylinder 109", arcs_of(outside, 0.77, 0.8 * kPi, 1.7 * kPi, 109),
        arcs_of(outside, 0.77, 0.8 * kPi, 1.7 * kPi, 1));
    for (const unsigned count : {1U, 2U, 5U}) {
      add(named("ring", count), arcs_of(middle, 0.31, 0, 2 * kPi, count), arcs_of(middle, 0.31, 0, 2 * kPi, 1));
    }
    add("ring that ends 0.02 beside its start", {arc(middle, 0.31, 0, 2 * kPi, 0.02 * kElement)},
        arcs_of(middle, 0.31, 0, 2 * kPi, 1));
  }

  void again(const Plane& plane) {
    for (const double beside : {0.0, 0.01, 0.05, 0.1}) {
      Random random(7);
      BladePaths strokes = {plane.whole()};
      while (strokes.size() < 50) {
        strokes.push_back(plane.sweep(-kWhole, kWhole, -2.0, 2.0, random.real(-beside, beside) * kElement));
      }
      add(named("again 50 times, beside", beside), strokes, {plane.whole()}).growth = beside == 0 ? 1.02 : 1.1;
    }
    const BladePath part = plane.sweep(-kWhole, kWhole, -2.0, 0.1), early = plane.sweep(-kWhole, 0.1);
    for (const auto& [name, stroke] : {std::pair("same depth 20 times", part), std::pair("part 20 times", early)}) {
      BladePaths strokes(20, stroke);
      ComposeRow& row = add(name, strokes, {stroke}, 1);
      row.growth = 1.02;
      strokes.push_back(plane.whole());
      add(std::string(name) + ", then through", strokes, {plane.whole()});
    }
  }

  void parallel(const Plane& plane) {
    for (const double beside : {0.05, 0.1, 0.25, 0.5, 1.0, 2.0}) {
      const BladePath other = plane.sweep(-kWhole, kWhole, -2.0, 2.0, beside * kElement);
      const bool is_one = beside < 0.2;
      add(named("parallel", beside), {plane.whole(), other},
          is_one ? BladePaths{plane.whole()} : BladePaths{plane.whole(), other}, is_one ? 2 : 3);
    }
  }

  /// A sheet that stands on another at an angle: the blade's end at its wall, or moved towards it.
  void tees(const Plane& plane) {
    for (const double degrees : {90.0, 30.0}) {
      const Plane upright = plane.turned(degrees * kPi / 180);
      Plane down = upright;
      down.a = upright.b;
      down.b = upright.a;
      down.n = -upright.n;
      const BladePaths single = {plane.whole(), upright.sweep(-kWhole, kWhole, 0.0, 2.0)};
      for (const double off : {0.0, 0.05, -0.05, 0.1}) {
        const double from = off * kElement;
        add(named(named("T along its wall, degrees", degrees) + ", off", off),
            {plane.whole(), upright.sweep(-kWhole, kWhole, from, 2.0)}, single, 3);
        add(named(named("T to its wall, degrees", degrees) + ", off", off), {plane.whole(), down.sweep(kWhole, from)},
            single, 3);
        add(named(named("T from its wall, degrees", degrees) + ", off", off), {plane.whole(), down.sweep(from, kWhole)},
            single, 3);
      }
    }
  }

  void crosses(const Plane& plane) {
    for (const double degrees : {90.0, 30.0}) {
      const BladePath other = plane.turned(degrees * kPi / 180).whole();
      add(named("cross, degrees", degrees), {plane.whole(), other}, {plane.whole(), other}, 4);
    }
    BladePaths planes, halves;
    for (const unsigned i : {0U, 1U, 2U, 3U}) planes.push_back(plane.turned(i * kPi / 4).whole());
    for (const unsigned i : {0U, 3U, 6U, 1U, 4U, 7U, 2U, 5U}) {
      halves.push_back(plane.turned(i * kPi / 4).sweep(-kWhole, kWhole, 0.0, 2.0));
    }
    add("star of 4 planes", planes, planes, 8);
    add("star of 8 half planes", halves, planes, 8);
  }

  /// From outside the body through it.
  void short_steps(const Plane& plane, double reach) {
    for (const double step : {0.02, 0.1, 0.2, 0.5}) {
      const auto count = static_cast<unsigned>(std::ceil(2 * reach / (step * kElement)));
      BladePaths strokes;
      for (unsigned i = 0; i < count; ++i) {
        strokes.push_back(plane.sweep(-reach + step * kElement * i, -reach + step * kElement * (i + 1)));
      }
      add(named("short steps " + plane.name, step), strokes, {plane.whole()});
    }
  }

  std::vector<ComposeRow> rows_;
};

}  // namespace

std::vector<ComposeRow> compose_rows() {
  return Table().make();
}

}  // namespace incise::test
