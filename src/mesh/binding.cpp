// SPDX-License-Identifier: Apache-2.0
// How a place hangs on a tet. Outside a tet barycentric weights would grow without bound where tets are thin, so that a
// place there is carried by the nearest point of the tet, and the way from there as if it were stiff.
#include <limits>

#include "incise/geom/closest.h"
#include "incise/mesh/embedded_surface.h"
#include "mesh/constants.h"

namespace incise {
inline namespace v0 {
namespace {

/// Axes along an edge of a triangle, across it within, and along the normal; zero axes where the triangle is flat.
Mat3 frame_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto unit = [](const Vec3& v) {
    const double length = v.norm();
    return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
  };
  Mat3 frame;
  frame.col(0) = unit(b - a);
  frame.col(2) = unit((b - a).cross(c - a));
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

}  // namespace

Binding bind_to(const TetMesh& mesh, TetId tet, const Vec3& rest) {
  std::array<Vec3, 4> corners;
  for (unsigned c = 0; c < 4; ++c) corners[c] = mesh.rest(mesh.vertices(tet)[c]);
  Binding binding;
  binding.tet = tet;
  const Vec3 x = rest - corners[0], e1 = corners[1] - corners[0], e2 = corners[2] - corners[0],
             e3 = corners[3] - corners[0];
  const double volume = e1.cross(e2).dot(e3);
  if (volume > 0) {
    binding.weights[1] = x.cross(e2).dot(e3) / volume;
    binding.weights[2] = e1.cross(x).dot(e3) / volume;
    binding.weights[3] = e1.cross(e2).dot(x) / volume;
    binding.weights[0] = 1 - binding.weights[1] - binding.weights[2] - binding.weights[3];
  }
  bool is_inside = volume > 0;
  for (const double weight : binding.weights) is_inside = is_inside && weight >= 0;
  if (is_inside) return binding;
  ClosestPoint best{Vec3::Zero(), {}, std::numeric_limits<double>::infinity(), TriangleFeature::kFace};
  for (unsigned s = 0; s < 4; ++s) {
    if (volume > 0 && binding.weights[s] >= 0) continue;  // the place is on the inner side of this face
    const auto& [a, b, c] = kSideCorners[s];
    const ClosestPoint hit = closest_on_triangle(rest, corners[a], corners[b], corners[c]);
    if (hit.distance2 < best.distance2) {
      best = hit;
      binding.side = static_cast<std::uint8_t>(s);
    }
  }
  const auto& order = kSideCorners[binding.side];
  binding.weights = {};
  for (unsigned i = 0; i < 3; ++i) binding.weights[order[i]] = best.weights[i];
  if (best.distance2 > kCountsAsInside * kCountsAsInside * e1.squaredNorm()) {
    const Mat3 frame = frame_of(corners[order[0]], corners[order[1]], corners[order[2]]);
    binding.offset = frame.transpose() * (rest - best.point);
  }
  return binding;
}

Vec3 current_place(const TetMesh& mesh, const Binding& binding) {
  const TetVertices& vertices = mesh.vertices(binding.tet);
  Vec3 place = Vec3::Zero();
  for (unsigned c = 0; c < 4; ++c) place += binding.weights[c] * mesh.current(vertices[c]);
  if (binding.side == 4 || binding.offset.isZero(0)) return place;
  const auto& order = kSideCorners[binding.side];
  return place + frame_of(mesh.current(vertices[order[0]]), mesh.current(vertices[order[1]]),
                          mesh.current(vertices[order[2]])) *
                     binding.offset;
}

}  // namespace v0
}  // namespace incise
