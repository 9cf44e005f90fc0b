// SPDX-License-Identifier: Apache-2.0
// A segment is in the body where it starts in a tet, or passes through the surface (docs/internals.md, 3.1).
#include "cut/open_border.h"

#include <algorithm>

#include "cut/contact_walk.h"
#include "incise/geom/predicates.h"

namespace incise {
inline namespace v0 {

namespace {

bool passes_surface(const TetMesh& mesh, const SurfaceIndex& surface, const Strip::Segment& segment) {
  bool does_pass = false;
  const auto look_at = [&](Side side) {
    const auto v = mesh.vertices(side);
    does_pass = does_pass || segment_crosses_triangle(segment[0], segment[1], {mesh.rest(v[0]), v[0].value},
                                                      {mesh.rest(v[1]), v[1].value}, {mesh.rest(v[2]), v[2].value});
  };
  const Vec3 &a = segment[0].position, &b = segment[1].position;
  for_each_side_near(mesh, surface, {a, b, b}, look_at);
  surface.for_each_waiting(mesh, look_at);
  return does_pass;
}

}  // namespace

bool lies_in_body(const TetMesh& mesh, const SurfaceIndex& surface, std::span<const Strip::Segment> border) {
  return std::any_of(border.begin(), border.end(), [&](const Strip::Segment& segment) {
    return locate(mesh, surface, segment[0]).is_valid() || passes_surface(mesh, surface, segment);
  });
}

}  // namespace v0
}  // namespace incise
