// SPDX-License-Identifier: Apache-2.0
#include "deforming/swaying_field.h"

#include <cmath>

#include "support/random.h"

namespace incise::test {

SwayingField::SwayingField(const Box& rest, double amplitude, std::uint64_t seed)
    : middle_(0.5 * (rest.lo + rest.hi)), size_(rest.hi - rest.lo), amplitude_(amplitude) {
  Random random(seed * 6007 + 5);
  phase_ = random.point(0, 6.3);
}

/// All of it as a stiff body, and a bend and a twist along x: each by about the amplitude.
Vec3 SwayingField::sway(const Vec3& rest, double seconds) const {
  const Vec3 p = (rest - middle_).cwiseQuotient(size_);
  const double a = std::sin(5.1 * seconds + phase_.x()), b = std::sin(7.3 * seconds + phase_.y()),
               c = std::sin(3.7 * seconds + phase_.z());
  const Vec3 whole = amplitude_ * Vec3(a, b, 0.5 * c);
  const Vec3 bend = amplitude_ * b * 4 * p.x() * p.x() * Vec3(0, 0.3, 1);
  const Vec3 twist = amplitude_ * c * 2 * p.x() * Vec3(0, -p.z(), p.y());
  return rest + whole + bend + twist;
}

/// Against the sum of the outward areas of the walls at a vertex, by the share of them that does not cancel.
std::vector<Vec3> SwayingField::gaps(const TetMesh& mesh) const {
  std::vector<Vec3> outward(mesh.vertex_slots(), Vec3::Zero());
  std::vector<double> area(mesh.vertex_slots(), 0.0);
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned side = 0; side < 4; ++side) {
      const Link link = mesh.links(tet)[side];
      if (!link.is_boundary() || link.tag() == 0) continue;
      const auto corners = mesh.vertices(Side(tet, side));
      const Vec3 o = mesh.rest(corners[0]);
      const Vec3 normal = (mesh.rest(corners[1]) - o).cross(mesh.rest(corners[2]) - o);
      for (const VertexId v : corners) {
        outward[v.value] += normal;
        area[v.value] += normal.norm();
      }
    }
  });
  for (std::size_t v = 0; v < outward.size(); ++v) outward[v] *= area[v] > 0 ? -amplitude_ / area[v] : 0.0;
  return outward;
}

std::vector<Vec3> SwayingField::positions(const TetMesh& mesh, double seconds) const {
  std::vector<Vec3> places = gaps(mesh);
  for (std::uint32_t v = 0; v < places.size(); ++v) {
    if (mesh.is_live(VertexId(v))) places[v] += sway(mesh.rest(VertexId(v)), seconds);
  }
  return places;
}

}  // namespace incise::test
