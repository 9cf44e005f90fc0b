// SPDX-License-Identifier: Apache-2.0
#include "incise/sim/tissue_point.h"

#include "incise/geom/box.h"
#include "sim/element.h"

namespace incise::inline v0 {

namespace {

std::array<Vec3, 4> corners(const TetMesh& mesh, std::span<const Vec3> positions, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  return {positions[v[0].value], positions[v[1].value], positions[v[2].value], positions[v[3].value]};
}

/// Six volumes of the tets that a place makes with each side: all at least 0 where it is inside.
std::array<double, 4> shares(const std::array<Vec3, 4>& p, const Vec3& place) {
  std::array<double, 4> share{};
  for (unsigned i = 0; i < 4; ++i) {
    const Vec3& foot = p[kSideCorners[i][0]];
    share[i] = detail::volume_slope(p, i).dot(place - foot);
  }
  return share;
}

std::optional<TissuePoint> point_in(TetId tet, const std::array<double, 4>& share) {
  const double whole = share[0] + share[1] + share[2] + share[3];
  if (!(whole > 0)) return std::nullopt;
  TissuePoint point{tet, {}};
  for (unsigned i = 0; i < 4; ++i) point.weights[i] = share[i] / whole;
  return point;
}

bool is_inside(const std::array<double, 4>& share) {
  return share[0] >= 0 && share[1] >= 0 && share[2] >= 0 && share[3] >= 0;
}

}  // namespace

Vec3 TissuePoint::place(const TetMesh& mesh, std::span<const Vec3> positions) const {
  Vec3 sum = Vec3::Zero();
  for (unsigned i = 0; i < 4; ++i) sum += weights[i] * positions[mesh.vertices(tet)[i].value];
  return sum;
}

std::optional<TissuePoint> walk_to(const TetMesh& mesh, std::span<const Vec3> positions, const Vec3& place,
                                   TetId near) {
  constexpr unsigned kMostSteps = 500;
  TetId tet = near;
  for (unsigned step = 0; step < kMostSteps && mesh.is_live(tet); ++step) {
    const auto share = shares(corners(mesh, positions, tet), place);
    if (is_inside(share)) return point_in(tet, share);
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

std::vector<std::optional<TissuePoint>> find_tissue(const TetMesh& mesh, std::span<const Vec3> positions,
                                                    std::span<const Vec3> places) {
  std::vector<std::optional<TissuePoint>> found(places.size());
  Box all;
  for (const Vec3& place : places) all.extend(place);
  mesh.for_each_tet([&](TetId tet) {
    const auto p = corners(mesh, positions, tet);
    Box box;
    for (const Vec3& corner : p) box.extend(corner);
    if (!box.overlaps(all)) return;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (found[i] || box.distance2(places[i]) > 0) continue;
      const auto share = shares(p, places[i]);
      if (is_inside(share)) found[i] = point_in(tet, share);
    }
  });
  return found;
}

}  // namespace incise::inline v0
