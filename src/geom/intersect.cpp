// SPDX-License-Identifier: Apache-2.0
// Two triangles cross if an edge of one passes through the other: first by the sides of a plane, which settle most
// pairs, then by how lines turn around edges.
#include "incise/geom/intersect.h"

namespace incise {
inline namespace v0 {

namespace {

using Triangle = std::array<SosPoint, 3>;

/// Sides of a triangle's plane on which the corners of another lie.
std::array<int, 3> sides_of(const Triangle& plane, const Triangle& corners) {
  std::array<int, 3> sides = {};
  for (std::size_t i = 0; i < 3; ++i) {
    sides[i] = orient3d_sos(plane[0], plane[1], plane[2], corners[i]);
  }
  return sides;
}

bool is_one_sided(const std::array<int, 3>& sides) {
  return sides[0] == sides[1] && sides[1] == sides[2];
}

bool line_meets(const SosPoint& p, const SosPoint& q, const Triangle& t) {
  const int turn = orient3d_sos(p, q, t[0], t[1]);
  return turn == orient3d_sos(p, q, t[1], t[2]) && turn == orient3d_sos(p, q, t[2], t[0]);
}

/// Whether an edge of `triangle`, whose corners lie on these sides of `other`, passes through `other`.
bool has_crossing_edge(const Triangle& triangle, const std::array<int, 3>& sides, const Triangle& other) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    if (sides[i] != sides[j] && line_meets(triangle[i], triangle[j], other)) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool triangles_cross(const Triangle& first, const Triangle& second) {
  const std::array<int, 3> sides_of_first = sides_of(second, first);
  if (is_one_sided(sides_of_first)) {
    return false;
  }
  const std::array<int, 3> sides_of_second = sides_of(first, second);
  if (is_one_sided(sides_of_second)) {
    return false;
  }
  return has_crossing_edge(first, sides_of_first, second) || has_crossing_edge(second, sides_of_second, first);
}

bool triangles_cross_besides(const Triangle& first, const Triangle& second) {
  return segment_crosses_triangle(first[1], first[2], second[0], second[1], second[2]) ||
         segment_crosses_triangle(second[1], second[2], first[0], first[1], first[2]);
}

}  // namespace v0
}  // namespace incise
