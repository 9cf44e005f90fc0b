// SPDX-License-Identifier: Apache-2.0
// The volume lost is shared among the vertices beside it by the areas that they move; each moves in turn, along its
// own vector area (docs/internals.md, 3.13).
#include "improve/volume_return.h"

#include <algorithm>
#include <cmath>

#include "improve/constants.h"
#include "improve/smooth.h"

namespace incise {
inline namespace v0 {

namespace {

/// A vertex that gives volume back, and twice the area that it moves.
struct Giver {
  VertexId vertex;
  double area2;
};

/// The mean length of the edges at a vertex, counted by tets, and its neighbours, ascending.
double look_around(const TetMesh& mesh, VertexId centre, const std::vector<TetId>& star,
                   std::vector<VertexId>& neighbours) {
  double sum = 0;
  for (const TetId tet : star) {
    for (const VertexId v : mesh.vertices(tet)) {
      if (v == centre) continue;
      sum += (mesh.rest(v) - mesh.rest(centre)).norm();
      neighbours.push_back(v);
    }
  }
  const double mean = sum / static_cast<double>(neighbours.size());
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  return mean;
}

/// Whether a vertex is part of one wall, or of curved skin, and nothing else.
bool may_give(const VertexSurfaces& surfaces) {
  const SurfaceAt& only = surfaces.surfaces[0];
  return surfaces.mobility == Mobility::kSurface && !surfaces.is_front() && surfaces.count == 1 &&
         only.tag != kBorderTag && (only.tag != 0 || !only.is_flat);
}

std::vector<Giver> find_givers(const Care& care, const std::vector<VertexId>& neighbours) {
  std::vector<Giver> givers;
  for (const VertexId v : neighbours) {
    const std::vector<TetId>& star = care.walker.star(care.mesh, v);
    if ((care.mesh.shape_of(v) & shape::kPinched) != 0 || !care.may_change(star)) continue;
    const VertexSurfaces surfaces = surfaces_at(care.mesh, v, star);
    if (may_give(surfaces)) givers.push_back({v, surfaces.surfaces[0].vector_area.norm()});
  }
  return givers;
}

/// Moves a vertex across its surface until the body has six times the volume `share6` more.
bool give(Care& care, VertexId vertex, double share6, double edge) {
  const std::vector<TetId> star = care.walker.star(care.mesh, vertex);
  const VertexSurfaces surfaces = surfaces_at(care.mesh, vertex, star);
  if (surfaces.count > 2) return false;
  const SurfaceAt& surface = surfaces.surfaces[0];
  Vec3 area2 = surface.vector_area;
  if (surfaces.count == 2) area2 += surfaces.surfaces[1].vector_area;  // those before it have made a crease here
  const Vec3 start = care.mesh.rest(vertex);
  const Vec3 step = (share6 / area2.squaredNorm()) * area2;
  const double size = care.references.sizes().at(start);
  const bool may =
      step.norm() <= kReturn * size &&
      care.references.allows_apex(surface.tag, start, start + step, kBentWall * size, edge, skin_share(care));
  if (!may || !move_vertex(care, vertex, start + step, star)) return false;
  care.changed.insert(care.changed.end(), star.begin(), star.end());
  return true;
}

}  // namespace

bool return_volume(Care& care, VertexId centre, double lost6) {
  std::vector<VertexId> neighbours;
  const double edge = look_around(care.mesh, centre, care.walker.star(care.mesh, centre), neighbours);
  if (std::abs(lost6) <= kNoVolume * edge * edge * edge) return true;
  const std::vector<Giver> givers = find_givers(care, neighbours);
  double area2 = 0;
  for (const Giver& giver : givers) area2 += giver.area2;
  for (const Giver& giver : givers) {
    const bool is_last = &giver == &givers.back();
    const double share6 = is_last ? lost6 : lost6 * giver.area2 / area2;
    if (!give(care, giver.vertex, share6, edge)) return false;
    lost6 -= share6;
    area2 -= giver.area2;
  }
  return !givers.empty();
}

}  // namespace v0
}  // namespace incise
