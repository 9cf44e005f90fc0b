// SPDX-License-Identifier: Apache-2.0
// What older cuts have opened, asked for by geometry alone: so it is the same wound after a file was written and read.
#include "cut/older_walls.h"

#include <algorithm>
#include <cmath>

#include "cut/constants.h"
#include "incise/geom/closest.h"

namespace incise {
inline namespace v0 {

bool is_inside_master(const ClosedComplex& complex, Side wall) {
  const std::uint32_t index = complex.find(wall.tet());
  if (index == Master::kNone) return false;
  const Master& master = complex[index];
  for (unsigned s = 0; s < 4; ++s) {
    if (master.behind[s] != Master::kNone) continue;
    const auto& outer = master.split->outer[s];
    if (std::any_of(outer.begin(), outer.end(), [&](auto child) { return complex.facet(master, child) == wall; })) {
      return false;
    }
  }
  return true;
}

bool OlderWalls::exist() const {
  return surface_.has_walls();
}

bool OlderWalls::pass(const Vec3& place, const Vec3& normal, double beside, double beyond) const {
  if (!exist()) return false;
  const Vec3 n = normal.normalized();
  const double reach = std::max(beside, beyond);
  const Vec3 margin = Vec3::Constant(reach);
  bool does_pass = false;
  surface_.for_each_near(mesh_, {place - margin, place + margin}, [&](Side side) {
    if (does_pass || mesh_.link(side).tag() == 0) return;
    const auto v = mesh_.vertices(side);
    const Vec3 &a = mesh_.rest(v[0]), &b = mesh_.rest(v[1]), &c = mesh_.rest(v[2]);
    const Vec3 area = (b - a).cross(c - a);
    const double length = area.norm(), cosine = area.dot(n);
    if (!(std::abs(cosine) > kRunsAlongOlder * length)) return;
    if (std::abs(area.dot(place - a)) > 1.001 * reach * length) return;  // off its plane: a cheap bound of `across`
    const Vec3 way = place - closest_on_triangle(place, a, b, c).point;
    const double across = way.dot(area) / length;
    const double along2 = way.squaredNorm() - across * across;
    does_pass = std::abs(across) <= beside && along2 <= beyond * beyond && !is_inside_master(complex_, side);
  });
  return does_pass;
}

double OlderWalls::first_met(const Vec3& from, const Vec3& to, double least_sine) const {
  double first = 2.0;
  if (!exist()) return first;
  surface_.for_each_near(mesh_, {from.cwiseMin(to), from.cwiseMax(to)}, [&](Side side) {
    if (mesh_.link(side).tag() == 0) return;
    const auto v = mesh_.vertices(side);
    const Vec3 &a = mesh_.rest(v[0]), &b = mesh_.rest(v[1]), &c = mesh_.rest(v[2]);
    const Vec3 area = (b - a).cross(c - a);
    const double before = area.dot(from - a), after = area.dot(to - a);
    if ((before > 0) == (after > 0) || !(std::abs(after - before) > least_sine * area.norm() * (to - from).norm()))
      return;
    const double share = before / (before - after);
    const Vec3 x = from + share * (to - from);
    const bool is_in = area.dot((b - a).cross(x - a)) >= 0 && area.dot((c - b).cross(x - b)) >= 0 &&
                       area.dot((a - c).cross(x - c)) >= 0;
    if (is_in && share < first && !is_inside_master(complex_, side)) first = share;
  });
  return first;
}

}  // namespace v0
}  // namespace incise
