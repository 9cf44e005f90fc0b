// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "incise/geom/box.h"
#include "support/random.h"
#include "support/strokes.h"

namespace incise::test {

/// A random direction, not quite uniform.
inline Vec3 random_direction(Random& random) {
  while (true) {
    const Vec3 p = random.point(-1, 1);
    const double length = p.norm();
    if (length > 0.1 && length < 1) return p / length;
  }
}

/// A random frame and place in a box: strokes are made in the unit cube and set into the body by it.
struct Placement {
  Vec3 centre, u, v, w;
  double scale;

  Placement(Random& random, const Box& box) {
    const Vec3 size = box.hi - box.lo;
    centre = box.lo + size.cwiseProduct(random.point(0.25, 0.75));
    scale = size.norm();
    w = random_direction(random);
    u = w.cross(random_direction(random)).normalized();
    v = w.cross(u);
  }
  /// (x, y, z) are shares of the body's diagonal.
  [[nodiscard]] Stroke place(Stroke stroke) const {
    const bool is_closed = stroke.edges[0].front() == stroke.edges[0].back();
    for (auto& edge : stroke.edges) {
      for (Vec3& p : edge) p = centre + scale * (p.x() * u + p.y() * v + p.z() * w);
      if (is_closed) edge.back() = edge.front();
    }
    return stroke;
  }
};

/// A random blade for a body in `box`: planes, arcs, coring cylinders, double passes, cuts that end inside, bends.
inline Stroke random_stroke(Random& random, const Box& box) {
  const Placement placement(random, box);
  const auto kind = random.integer(0, 6);
  const double bend = random.real(-1, 1), turn = random.real(-0.3, 0.3);
  std::vector<Vec3> path;
  for (unsigned i = 0; i <= 12; ++i) {
    const double s = -0.7 + 1.4 * i / 12;
    path.emplace_back(s, bend * s * s + turn * s, 0);
  }
  Stroke stroke;
  switch (kind) {
    case 0:
      stroke = quad_stroke(Vec3(-1, 0, -1), Vec3(-1, 0, 1), Vec3(1, 0, -1), Vec3(1, 0, 1));
      break;
    case 1:
      stroke = profile_stroke(path, -0.7, 0.7);
      break;
    case 2:
      stroke = coring_stroke(Vec3(0, 0, 0), random.real(0.06, 0.3), 24, -0.7, 0.7);
      break;
    case 3:
      stroke = path_stroke(path, -0.7, 0.7);
      stroke = followed_by(stroke, reversed(stroke));
      break;
    case 4:
      stroke = path_stroke(path, random.real(-0.3, 0.1), 0.7);
      break;
    case 5:
      stroke = coring_stroke(Vec3(0, 0, 0), random.real(0.06, 0.3), 24, random.real(-0.2, 0.2), 0.7);
      break;
    default:
      stroke = path_stroke(
          {Vec3(-0.7, 0, 0), Vec3(0.1, 0, 0), Vec3(0.1, random.real(0.02, 0.2), 0), Vec3(-0.2, -0.3, 0)}, -0.7, 0.7);
  }
  stroke = placement.place(std::move(stroke));
  stroke.name = "random " + std::to_string(kind);
  return stroke;
}

/// A straight blade through a body, or into it, as random strokes go.
inline Stroke random_incision(Random& random, const Box& box) {
  const Placement placement(random, box);
  const double depth = random.real(-0.3, 0.3);
  return placement.place(quad_stroke(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(-1, random.real(-0.2, 0.2), depth),
                                     Vec3(random.real(0, 1), random.real(-0.2, 0.2), depth), 4));
}

}  // namespace incise::test
