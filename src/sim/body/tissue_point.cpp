// SPDX-License-Identifier: Apache-2.0
// Four signed volumes tell whether a place is in a tet, and through which side to walk on where it is not.
#include "incise/sim/tissue_point.h"

#include <algorithm>

#include "incise/geom/box.h"
#include "incise/geom/closest.h"
#include "sim/body/constants.h"
#include "sim/body/element.h"

namespace incise {
inline namespace v0 {

namespace {

using Corners = std::array<Vec3, 4>;

Corners corners(const TetMesh& mesh, BodyShape shape, TetId tet) {
  Corners p;
  for (unsigned i = 0; i < 4; ++i) {
    const VertexId v = mesh.vertices(tet)[i];
    p[i] = shape == BodyShape::kRest ? mesh.rest(v) : mesh.current(v);
  }
  return p;
}

/// Six volumes of the tets that a place makes with each side: all at least 0 where it is inside.
std::array<double, 4> shares(const Corners& p, const Vec3& place) {
  std::array<double, 4> share{};
  for (unsigned i = 0; i < 4; ++i) {
    const Vec3& foot = p[kSideCorners[i][0]];
    share[i] = detail::volume_slope(p, i).dot(place - foot);
  }
  return share;
}

bool is_inside(const std::array<double, 4>& share) {
  return share[0] >= 0 && share[1] >= 0 && share[2] >= 0 && share[3] >= 0;
}

std::optional<TissuePoint> point_in(const TetMesh& mesh, TetId tet, const std::array<double, 4>& share) {
  const double whole = share[0] + share[1] + share[2] + share[3];
  if (!is_inside(share) || !(whole > 0)) return std::nullopt;
  TissuePoint point{tet, mesh.vertices(tet), {}};
  for (unsigned i = 0; i < 4; ++i) point.weights[i] = share[i] / whole;
  return point;
}

}  // namespace

Vec3 TissuePoint::place(const TetMesh& mesh, BodyShape shape) const {
  const Corners p = corners(mesh, shape, tet);
  return weights[0] * p[0] + weights[1] * p[1] + weights[2] * p[2] + weights[3] * p[3];
}

bool TissuePoint::holds(const TetMesh& mesh) const {
  return mesh.is_live(tet) && mesh.vertices(tet) == vertices;
}

std::optional<TissuePoint> walk_to(const TetMesh& mesh, BodyShape shape, const Vec3& place, TetId near) {
  TetId tet = near;
  for (unsigned step = 0; step < detail::kMostWalkSteps && mesh.is_live(tet); ++step) {
    const auto share = shares(corners(mesh, shape, tet), place);
    if (is_inside(share)) return point_in(mesh, tet, share);
    Link best = Link::boundary(0);
    double worst = 0;
    for (unsigned i = 0; i < 4; ++i) {  // through the side that it is furthest beyond, of those that lead on
      const Link link = mesh.links(tet)[i];
      if (share[i] < worst && !link.is_boundary()) {
        worst = share[i];
        best = link;
      }
    }
    if (best.is_boundary()) return std::nullopt;
    tet = best.side().tet();
  }
  return std::nullopt;
}

std::optional<TissuePoint> find_among(const TetMesh& mesh, BodyShape shape, const Vec3& place,
                                      std::span<const TetId> tets) {
  for (const TetId tet : tets) {
    if (!mesh.is_live(tet)) continue;
    if (auto found = point_in(mesh, tet, shares(corners(mesh, shape, tet), place))) return found;
  }
  return std::nullopt;
}

std::optional<TissuePoint> find_around(const TetMesh& mesh, BodyShape shape, const Vec3& place,
                                       std::span<const VertexId> vertices, std::size_t most) {
  std::vector<TetId> seen;
  const auto see = [&](TetId tet) {
    if (seen.size() < most && std::find(seen.begin(), seen.end(), tet) == seen.end()) seen.push_back(tet);
  };
  for (const VertexId v : vertices) {
    if (mesh.is_live(v) && mesh.tet_of(v).is_valid()) see(mesh.tet_of(v));
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const TetId tet = seen[i];
    if (auto found = find_among(mesh, shape, place, {&tet, 1})) return found;
    for (const Link link : mesh.links(tet)) {
      if (!link.is_boundary()) see(link.side().tet());
    }
  }
  return std::nullopt;
}

std::vector<std::optional<TissuePoint>> find_tissue(const TetMesh& mesh, BodyShape shape,
                                                    std::span<const Vec3> places) {
  std::vector<std::optional<TissuePoint>> found(places.size());
  Box all;
  for (const Vec3& place : places) all.extend(place);
  mesh.for_each_tet([&](TetId tet) {
    const Corners p = corners(mesh, shape, tet);
    Box box;
    for (const Vec3& corner : p) box.extend(corner);
    if (!box.overlaps(all)) return;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!found[i] && !(box.distance2(places[i]) > 0)) found[i] = point_in(mesh, tet, shares(p, places[i]));
    }
  });
  return found;
}

std::optional<TissuePoint> find_nearest(const TetMesh& mesh, BodyShape shape, const Vec3& place, double farthest) {
  std::optional<TissuePoint> nearest;
  bool is_in = false;
  double least = farthest * farthest;
  mesh.for_each_tet([&](TetId tet) {
    if (is_in) return;
    const Corners p = corners(mesh, shape, tet);
    Box box;
    for (const Vec3& corner : p) box.extend(corner);
    if (box.distance2(place) > least) return;
    if (const auto inside = point_in(mesh, tet, shares(p, place))) {
      nearest = inside;
      is_in = true;
      return;
    }
    for (unsigned side = 0; side < 4; ++side) {
      const auto& [a, b, c] = kSideCorners[side];
      const ClosestPoint close = closest_on_triangle(place, p[a], p[b], p[c]);
      if (close.distance2 > least || (nearest && close.distance2 == least)) continue;
      least = close.distance2;
      nearest = TissuePoint{tet, mesh.vertices(tet), {}};
      nearest->weights[a] = close.weights[0];
      nearest->weights[b] = close.weights[1];
      nearest->weights[c] = close.weights[2];
    }
  });
  return nearest;
}

}  // namespace v0
}  // namespace incise
