// SPDX-License-Identifier: Apache-2.0
// Bars are rings of corners joined along a way, plates are outlines closed by fans; flat faces get normals of their
// own and round ones share them.
#include "app/view/solid.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr int kFlatCorners = 4;

void add_triangle(const std::array<Vec3, 3>& at, const std::array<Vec3, 3>& normals, const Finish& finish,
                  std::vector<SolidCorner>& out) {
  for (std::size_t i = 0; i < 3; ++i) out.push_back({at[i].cast<float>(), normals[i].cast<float>(), finish});
}

void add_flat(const Vec3& a, const Vec3& b, const Vec3& c, const Finish& finish, std::vector<SolidCorner>& out) {
  const Vec3 normal = (b - a).cross(c - a).stableNormalized();
  add_triangle({a, b, c}, {normal, normal, normal}, finish, out);
}

/// A ring of corners around a place of the way, with the directions outwards.
struct Ring {
  std::vector<Vec3> at, outwards;
};

Ring ring_at(std::span<const BarSection> way, std::size_t i, const Vec3& side, int corners) {
  const Vec3& before = way[i == 0 ? 0 : i - 1].at;
  const Vec3& after = way[i + 1 < way.size() ? i + 1 : i].at;
  const Vec3 ahead = (after - before).stableNormalized();
  const Vec3 x = (side - side.dot(ahead) * ahead).stableNormalized(), y = ahead.cross(x);
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    // A flat bar has its corners where the sides meet.
    const double turn = 2 * std::numbers::pi * (k + (corners == kFlatCorners ? 0.5 : 0.0)) / corners;
    const double stretch = corners == kFlatCorners ? std::numbers::sqrt2 : 1;
    const double c = std::cos(turn), s = std::sin(turn);
    ring.at.push_back(way[i].at + stretch * (way[i].wide * c * x + way[i].thick * s * y));
    ring.outwards.push_back((way[i].thick * c * x + way[i].wide * s * y).stableNormalized());
  }
  return ring;
}

void add_side(const Ring& a, const Ring& b, bool is_flat, const Finish& finish, std::vector<SolidCorner>& out) {
  const std::size_t n = a.at.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    if (is_flat) {
      add_flat(a.at[k], a.at[next], b.at[next], finish, out);
      add_flat(a.at[k], b.at[next], b.at[k], finish, out);
    } else {
      add_triangle({a.at[k], a.at[next], b.at[next]}, {a.outwards[k], a.outwards[next], b.outwards[next]}, finish, out);
      add_triangle({a.at[k], b.at[next], b.at[k]}, {a.outwards[k], b.outwards[next], b.outwards[k]}, finish, out);
    }
  }
}

void add_end(const Ring& ring, bool is_first, const Finish& finish, std::vector<SolidCorner>& out) {
  for (std::size_t k = 1; k + 1 < ring.at.size(); ++k) {
    if (is_first) {
      add_flat(ring.at[0], ring.at[k + 1], ring.at[k], finish, out);
    } else {
      add_flat(ring.at[0], ring.at[k], ring.at[k + 1], finish, out);
    }
  }
}

}  // namespace

void add_bar(std::span<const BarSection> way, const Vec3& side, int corners, const Finish& finish,
             std::vector<SolidCorner>& out) {
  Ring last = ring_at(way, 0, side, corners);
  add_end(last, true, finish, out);
  for (std::size_t i = 1; i < way.size(); ++i) {
    Ring ring = ring_at(way, i, side, corners);
    add_side(last, ring, corners == kFlatCorners, finish, out);
    last = std::move(ring);
  }
  add_end(last, false, finish, out);
}

void add_plate(std::span<const Eigen::Vector2d> outline, const Vec3& origin, const Vec3& along, const Vec3& across,
               double thickness, const Finish& finish, std::vector<SolidCorner>& out) {
  const Vec3 half = 0.5 * thickness * along.cross(across);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : outline) middle += point / static_cast<double>(outline.size());
  const auto place = [&](const Eigen::Vector2d& p) { return Vec3(origin + p.x() * along + p.y() * across); };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    Vec3 a = place(outline[i]), b = place(outline[(i + 1) % outline.size()]);
    const Eigen::Vector2d from = outline[i] - middle, to = outline[(i + 1) % outline.size()] - middle;
    if (from.x() * to.y() - from.y() * to.x() < 0) std::swap(a, b);
    const Vec3 m = place(middle);
    add_flat(m + half, a + half, b + half, finish, out);
    add_flat(m - half, b - half, a - half, finish, out);
    add_flat(a - half, b - half, b + half, finish, out);
    add_flat(a - half, b + half, a + half, finish, out);
  }
}

}  // namespace app
}  // namespace v0
}  // namespace incise
