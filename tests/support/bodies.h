// SPDX-License-Identifier: Apache-2.0
// Bodies to cut, the same bits on every target.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "incise/mesh/shapes.h"
#include "incise/mesh/tet_mesh.h"
#include "support/random.h"

namespace incise::test {

inline TetSoup jittered_cube(std::uint32_t n, std::uint64_t seed) {
  TetSoup soup = kuhn_cube(n);
  jitter(soup, 0.15, seed);
  return soup;
}

/// A box of unit cells with a corner in the origin.
inline TetSoup jittered_box(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint64_t seed) {
  TetSoup soup = kuhn_box(Vec3(0, 0, 0), Vec3(x, y, z), {x, y, z});
  jitter(soup, 0.15, seed);
  return soup;
}

/// A ball of radius 1 around the origin: a body with a curved skin. `n` cells along each axis, even.
inline TetSoup ball(std::uint32_t n) {
  TetSoup soup = kuhn_box(Vec3(-1, -1, -1), Vec3(1, 1, 1), {n, n, n});
  for (Vec3& p : soup.points) {
    const double reach = std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
    const double length = std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z());
    if (length > 0) p *= reach / length;
  }
  return soup;
}

/// A row of tets, each on a face of the one before (a Boerdijk–Coxeter helix).
inline TetSoup needle(std::uint32_t count) {
  TetSoup soup;
  soup.points = {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
  soup.tets.push_back({0, 1, 2, 3});
  for (std::uint32_t i = 1; i < count; ++i) {
    const Vec3 foot = (soup.points[i] + soup.points[i + 1] + soup.points[i + 2]) / 3.0;
    soup.points.emplace_back(2.0 * foot - soup.points[i - 1]);
    soup.tets.push_back({i, i + 1, i + 2, i + 3});
  }
  for (auto& tet : soup.tets) {
    const Vec3 &a = soup.points[tet[0]], &b = soup.points[tet[1]], &c = soup.points[tet[2]], &d = soup.points[tet[3]];
    if ((b - a).cross(c - a).dot(d - a) < 0) std::swap(tet[2], tet[3]);
  }
  return soup;
}

/// A Kuhn cube and its mirror image on the same points: every place is filled twice, and faces have up to four tets.
inline TetSoup doubled_cube(std::uint32_t n) {
  TetSoup soup = kuhn_cube(n);
  const std::size_t count = soup.tets.size();
  const auto mirrored = [n](std::uint32_t v) { return v - v % (n + 1) + (n - v % (n + 1)); };
  for (std::size_t t = 0; t < count; ++t) {
    const auto [a, b, c, d] = soup.tets[t];
    soup.tets.push_back({mirrored(a), mirrored(b), mirrored(d), mirrored(c)});
  }
  return soup;
}

/// The same body with its points in another order.
inline TetSoup renumbered(const TetSoup& soup, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint32_t> place(soup.points.size());
  std::iota(place.begin(), place.end(), 0U);
  for (std::size_t i = place.size(); i > 1; --i) {
    std::swap(place[i - 1], place[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(i) - 1))]);
  }
  TetSoup result = soup;
  for (std::size_t i = 0; i < place.size(); ++i) result.points[place[i]] = soup.points[i];
  for (auto& tet : result.tets) {
    for (std::uint32_t& v : tet) v = place[v];
  }
  return result;
}

}  // namespace incise::test
