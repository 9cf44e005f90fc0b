// SPDX-License-Identifier: Apache-2.0
// The signs of the barycentric weights say whether the nearest point is inside; else it is the nearest of those on the
// three edges, with each corner the same bits from both of its edges.
#include "incise/geom/closest.h"

#include <algorithm>

#include "geom/constants.h"

namespace incise {
inline namespace v0 {

namespace {

/// Where on the segment a b, from 0 to 1, the point nearest to p lies.
double segment_parameter(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double along = ab.dot(p - a), length2 = ab.squaredNorm();
  return along > 0.0 ? (along < length2 ? along / length2 : 1.0) : 0.0;
}

constexpr TriangleFeature feature_of(std::size_t i, std::size_t j, double t) {
  constexpr std::array<TriangleFeature, 3> kEdges = {TriangleFeature::kEdgeAb, TriangleFeature::kEdgeBc,
                                                     TriangleFeature::kEdgeCa};
  constexpr std::array<TriangleFeature, 3> kVertices = {TriangleFeature::kVertexA, TriangleFeature::kVertexB,
                                                        TriangleFeature::kVertexC};
  return t <= 0.0 ? kVertices[i] : (t >= 1.0 ? kVertices[j] : kEdges[i]);
}

ClosestPoint closest_on_border(const Vec3& p, const std::array<const Vec3*, 3>& corners) {
  ClosestPoint best{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    const Vec3 &from = *corners[i], &to = *corners[j];
    const double t = segment_parameter(p, from, to);
    // The end itself at t = 1, so that a vertex gives the same bits from both of its edges.
    const Vec3 point = t < 1.0 ? Vec3(from + t * (to - from)) : to;
    const double distance2 = (p - point).squaredNorm();
    if (i == 0 || distance2 < best.distance2) {
      best = {point, {}, distance2, feature_of(i, j, t)};
      best.weights[i] = 1.0 - t;
      best.weights[j] = t;
    }
  }
  return best;
}

}  // namespace

ClosestPoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const Vec3 normal = ab.cross(ac);
  const double normal2 = normal.squaredNorm();
  const double wb = ap.cross(ac).dot(normal), wc = ab.cross(ap).dot(normal);
  const double wa = normal2 - wb - wc;
  if (!(wa > 0.0 && wb > 0.0 && wc > 0.0)) {
    return closest_on_border(p, {&a, &b, &c});
  }
  const double sum = wa + wb + wc;
  const Vec3 point = a + (wb / sum) * ab + (wc / sum) * ac;
  const ClosestPoint face{point, {wa / sum, wb / sum, wc / sum}, (p - point).squaredNorm(), TriangleFeature::kFace};
  if (normal2 > kThinCorner * ab.squaredNorm() * ac.squaredNorm()) {
    return face;
  }
  const ClosestPoint border = closest_on_border(p, {&a, &b, &c});
  return border.distance2 <= face.distance2 ? border : face;
}

}  // namespace v0
}  // namespace incise
