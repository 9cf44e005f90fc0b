// SPDX-License-Identifier: Apache-2.0
#include "blades.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

namespace incise::bench {

namespace {

/// Maps the unit cube to the body's box.
class UnitBox {
 public:
  explicit UnitBox(const Box& bounds) : low_(bounds.lo), size_(bounds.hi - bounds.lo) {}
  [[nodiscard]] Vec3 at(const Vec3& u) const { return low_ + u.cwiseProduct(size_); }

 private:
  Vec3 low_, size_;
};

/// A sheet over [-0.1, 1.1]²: the edge lies along the first parameter and moves along the second.
Stroke sheet(const UnitBox& box, unsigned segments, unsigned steps, const std::function<Vec3(double, double)>& point) {
  Stroke stroke;
  for (unsigned j = 0; j <= steps; ++j) {
    stroke.times.push_back(j);
    std::vector<Vec3>& edge = stroke.edges.emplace_back();
    for (unsigned i = 0; i <= segments; ++i) {
      edge.push_back(box.at(point(-0.1 + 1.2 * i / segments, -0.1 + 1.2 * j / steps)));
    }
  }
  return stroke;
}

/// The plane n·u = n·through in the unit box.
Stroke plane(const Box& bounds, const Vec3& normal, const Vec3& through) {
  const Vec3 size = bounds.hi - bounds.lo;
  const Vec3 n = normal.cwiseQuotient(size);
  const Vec3 p = bounds.lo + through.cwiseProduct(size);
  const Result<Stroke> stroke = plane_stroke(bounds, n, n.dot(p));
  return stroke.ok() ? *stroke : Stroke();
}

/// A closed edge that moves along a tilted axis.
Stroke cylinder(const UnitBox& box, double radius, const Vec3& centre, const Vec3& tilt) {
  constexpr unsigned kSegments = 48;
  constexpr double kTurn = 6.283185307179586;
  Stroke stroke;
  for (unsigned j = 0; j <= 4; ++j) {
    const double z = -0.15 + 1.3 * j / 4.0;
    stroke.times.push_back(j);
    std::vector<Vec3>& edge = stroke.edges.emplace_back();
    for (unsigned i = 0; i < kSegments; ++i) {
      const double angle = kTurn * i / kSegments;
      edge.push_back(box.at(centre + Vec3(radius * std::cos(angle), radius * std::sin(angle), 0) + (z - 0.5) * tilt +
                            Vec3(0, 0, z - centre.z())));
    }
    edge.push_back(edge.front());
  }
  return stroke;
}

const std::array<Vec3, kVariants> kCentres = {Vec3(0.513, 0.492, 0.507), Vec3(0.431, 0.544, 0.482),
                                              Vec3(0.562, 0.453, 0.539), Vec3(0.478, 0.583, 0.441)};
const std::array<Vec3, kVariants> kNormals = {Vec3(0.37, 0.53, 0.76), Vec3(-0.61, 0.28, 0.74), Vec3(0.82, 0.19, -0.53),
                                              Vec3(0.23, -0.89, 0.39)};

CutCase axis_plane(const Box& bounds, unsigned variant) {
  Vec3 normal = Vec3::Zero();
  normal[variant % 3] = 1;
  return {"axis plane", {plane(bounds, normal, kCentres[variant])}, 2, 0.0, false};
}

CutCase oblique_plane(const Box& bounds, unsigned variant) {
  return {"oblique plane", {plane(bounds, kNormals[variant], kCentres[variant])}, 2, 0.0, true};
}

/// A saddle of curvature below 0.9 per box, tilted.
CutCase curved_sheet(const Box& bounds, unsigned variant) {
  const Vec3 c = kCentres[variant], n = kNormals[variant];
  const auto height = [=](double x, double y) {
    const double u = x - c.x(), v = y - c.y();
    return Vec3(x, y, c.z() + 0.4 * u * u - 0.3 * v * v + 0.15 * n.x() * u + 0.15 * n.y() * v);
  };
  return {"curved sheet", {sheet(UnitBox(bounds), 24, 12, height)}, 2, 0.8, true};
}

CutCase coring_cylinder(const Box& bounds, unsigned variant) {
  const Vec3 tilt(0.1 * kNormals[variant].x(), 0.1 * kNormals[variant].y(), 0);
  return {"coring cylinder", {cylinder(UnitBox(bounds), 0.3, kCentres[variant], tilt)}, 2, 1 / 0.3, true};
}

CutCase cross(const Box& bounds, unsigned variant) {
  const Vec3 first = kNormals[variant];
  const Vec3 second = first.cross(kNormals[(variant + 1) % kVariants]).normalized();
  return {
      "cross",
      {plane(bounds, first, kCentres[variant]), plane(bounds, second, kCentres[variant] + Vec3(0.01, -0.02, 0.015))},
      4,
      0.0,
      true};
}

/// Three gently curved sheets across x, two across y.
CutCase lattice(const Box& bounds, unsigned variant) {
  const UnitBox box(bounds);
  const Vec3 shift = 0.2 * (kCentres[variant] - Vec3::Constant(0.5));
  CutCase cut = {"3×2 sheets", {}, 12, 0.2, false};
  for (const double x : {0.25, 0.5, 0.75}) {
    cut.strokes.push_back(sheet(box, 16, 8, [=](double y, double z) {
      return Vec3(x + shift.x() + 0.1 * (y - 0.5) * (y - 0.5) + 0.05 * (z - 0.5), y, z);
    }));
  }
  for (const double y : {0.34, 0.67}) {
    cut.strokes.push_back(sheet(box, 16, 8, [=](double x, double z) {
      return Vec3(x, y + shift.y() + 0.08 * (x - 0.5) * (z - 0.5) - 0.04 * (z - 0.5), z);
    }));
  }
  return cut;
}

}  // namespace

std::vector<CutCase> make_cuts(const Box& bounds) {
  std::vector<CutCase> cuts;
  for (const auto& make : {axis_plane, oblique_plane, curved_sheet, coring_cylinder, cross, lattice}) {
    for (unsigned variant = 0; variant < kVariants; ++variant) {
      cuts.push_back(make(bounds, variant));
    }
  }
  return cuts;
}

}  // namespace incise::bench
