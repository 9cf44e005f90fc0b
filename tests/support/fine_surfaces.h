// SPDX-License-Identifier: Apache-2.0
// Fine surfaces of the bodies that tests cut.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <tuple>

#include "incise/mesh/embedded_surface.h"

namespace incise::test {

/// The surface of the cube [-1, 1]³, `n`² squares of two triangles on each face, which share their points.
inline FineSurface fine_cube(std::uint32_t n) {
  FineSurface surface;
  std::map<std::tuple<double, double, double>, std::uint32_t> numbers;
  const auto number_of = [&](const Vec3& p) {
    const auto [at, is_new] = numbers.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(numbers.size()));
    if (is_new) surface.points.push_back(p);
    return at->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      const auto at = [&](std::uint32_t i, std::uint32_t j) {
        Vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = -1 + 2.0 * i / n;
        p[(axis + 2) % 3] = -1 + 2.0 * j / n;
        return number_of(p);
      };
      for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
          std::array<std::uint32_t, 3> low = {at(i, j), at(i + 1, j), at(i + 1, j + 1)};
          std::array<std::uint32_t, 3> high = {at(i, j), at(i + 1, j + 1), at(i, j + 1)};
          if (side < 0) std::swap(low[1], low[2]);
          if (side < 0) std::swap(high[1], high[2]);
          surface.triangles.push_back(low);
          surface.triangles.push_back(high);
        }
      }
    }
  }
  return surface;
}

/// The same around a box.
inline FineSurface fine_box(const Vec3& low, const Vec3& high, std::uint32_t n) {
  FineSurface surface = fine_cube(n);
  for (Vec3& p : surface.points) p = low + (high - low).cwiseProduct((p + Vec3::Ones()) / 2);
  return surface;
}

/// A sphere around the origin.
inline FineSurface fine_sphere(double radius, std::uint32_t n) {
  FineSurface surface = fine_cube(n);
  for (Vec3& p : surface.points) p = radius * p.normalized();
  return surface;
}

/// Texture coordinates that are a linear function of the place at rest, so that they are known everywhere.
inline std::array<double, 2> linear_texture(const Vec3& p) {
  return {0.25 + 0.5 * p.x() - 0.125 * p.z(), p.y() + 0.25 * p.z()};
}
inline void add_linear_texture(FineSurface& surface) {
  for (const Vec3& p : surface.points) surface.texture.push_back(linear_texture(p));
}

}  // namespace incise::test
