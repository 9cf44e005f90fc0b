// SPDX-License-Identifier: Apache-2.0
// Faces at a vertex fall into surfaces by tag and normal; their number and their vector areas decide whether it is
// free, slides or stays, and regions take away what they must keep (docs/internals.md, 3.13).
#include "improve/surfaces.h"

#include <algorithm>
#include <cmath>

#include "geom/constants.h"
#include "improve/constants.h"

namespace incise {
inline namespace v0 {

namespace {

bool is_same_plane(const Vec3& a, const Vec3& b) {
  return a.cross(b).squaredNorm() <= kOnePlane * kOnePlane;
}

/// The other ends of the edges at which the lips of a cut meet, and how often they were seen from either lip.
struct FrontEdge {
  VertexId end;
  std::array<unsigned, 2> faces{};
};

void note_front_edges(const TetMesh& mesh, Side side, VertexId vertex, unsigned lip, std::vector<FrontEdge>& edges) {
  for (const VertexId v : mesh.vertices(side)) {
    if (v == vertex) {
      continue;
    }
    auto edge = std::find_if(edges.begin(), edges.end(), [&](const FrontEdge& e) { return e.end == v; });
    if (edge == edges.end()) {
      edge = edges.insert(edges.end(), FrontEdge{v, {}});
    }
    ++edge->faces[lip];
  }
}

/// A vertex inside the body where the lips of one cut meet slides along the front, if that goes on at both sides.
void find_front(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star, VertexSurfaces& found) {
  const SurfaceAt &one = found.surfaces[0], &other = found.surfaces[1];
  found.mobility = Mobility::kFixed;
  if (found.count != 2 || !are_alike(one.tag, other.tag) || one.first_normal.dot(other.first_normal) > -kSmoothCosine) {
    return;
  }
  std::vector<FrontEdge> edges;
  for (const TetId tet : star) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.vertices(tet)[s] != vertex && mesh.links(tet)[s].is_boundary()) {
        const unsigned lip = found.find(mesh.links(tet)[s].tag(), vector_area2(mesh, {tet, s}).normalized());
        if (lip < 2) note_front_edges(mesh, {tet, s}, vertex, lip, edges);
      }
    }
  }
  std::erase_if(edges, [](const FrontEdge& e) { return e.faces[0] != 1 || e.faces[1] != 1; });
  if (edges.size() != 2) {
    return;
  }
  // Along the front, but orthogonal to what the lips' areas leave of each other: that keeps the volume.
  Vec3 along = (mesh.rest(edges[1].end) - mesh.rest(edges[0].end)).normalized();
  const Vec3 area = one.vector_area + other.vector_area;
  if (area.squaredNorm() > kOnePlane * kOnePlane * one.vector_area.squaredNorm()) {
    along -= (along.dot(area) / area.squaredNorm()) * area;
  }
  const double length = along.norm();
  if (length > kAlongFront) {
    found.front_ends = {edges[0].end, edges[1].end};
    found.along = along / length;
    found.mobility = Mobility::kLine;
  }
}

/// Whether a vertex that moves as found changes no volume already.
bool keeps_volumes(const VertexSurfaces& found, const RegionVolumes::Held& held) {
  const auto keeps = [&](const Vec3& direction) {
    return found.mobility == Mobility::kLine ? std::abs(direction.dot(found.along)) <= kOnePlane
                                             : is_same_plane(direction, found.along);
  };
  return std::all_of(held.directions.begin(), held.directions.begin() + held.count, keeps);
}

/// Where regions meet each keeps its volume: the line of a border and curved skin would hold the sum alone. What is not
/// free already has one direction left, or none.
void hold_regions(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star, VertexSurfaces& found) {
  if (found.mobility == Mobility::kFixed || has_one_region(mesh, star)) {
    return;
  }
  RegionVolumes volumes;
  for (const TetId tet : star) add_tet(volumes, mesh, tet, vertex);
  const RegionVolumes::Held held = volumes.held();
  if (keeps_volumes(found, held)) {
    return;
  }
  found.mobility = held.count == 2 ? Mobility::kLine : Mobility::kFixed;
  found.along = held.directions[0].cross(held.directions[1]).normalized();
  for (SurfaceAt& surface : found.surfaces) {
    surface.is_flat = surface.is_flat && std::abs(found.along.dot(surface.first_normal)) <= kOnePlane;
  }
}

}  // namespace

void add_face(VertexSurfaces& found, std::uint32_t tag, const Vec3& area2) {
  const double length = area2.norm();
  if (!(length > 0)) {
    return;
  }
  const Vec3 normal = area2 / length;
  const unsigned at = found.find(tag, normal);
  if (at >= 2) {
    found.count = 3;
    return;
  }
  SurfaceAt& surface = found.surfaces[at];
  if (at == found.count) {
    surface = {tag, Vec3::Zero(), normal, true};
    ++found.count;
  }
  surface.vector_area += area2;
  surface.is_flat = surface.is_flat && is_same_plane(surface.first_normal, normal);
}

void decide_mobility(VertexSurfaces& found) {
  if (found.count == 1) {
    // In a plane its normal is exact; the sum's rounding would add up.
    const SurfaceAt& surface = found.surfaces[0];
    const double length = surface.vector_area.norm();
    found.along = surface.is_flat ? surface.first_normal : Vec3(surface.vector_area / length);
    found.mobility = length > 0 ? Mobility::kSurface : Mobility::kFixed;
  } else if (found.count == 2) {
    const auto direction = [](const SurfaceAt& s) { return s.is_flat ? s.first_normal : s.vector_area.normalized(); };
    const Vec3 line = direction(found.surfaces[0]).cross(direction(found.surfaces[1]));
    const double sine = line.norm();
    found.mobility = sine > kLeastSine ? Mobility::kLine : Mobility::kFixed;
    found.along = sine > 0 ? Vec3(line / sine) : line;
  } else if (found.count > 2) {
    found.mobility = Mobility::kFixed;
  }
}

unsigned VertexSurfaces::find(std::uint32_t tag, const Vec3& normal) const {
  for (unsigned i = 0; i < std::min(count, 2U); ++i) {
    if (surfaces[i].first_normal.dot(normal) >= least_cosine(surfaces[i].tag, tag)) {
      return i;
    }
  }
  return count;
}

Vec3 vector_area2(const TetMesh& mesh, Side side) {
  const auto v = mesh.vertices(side);
  return (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0]));
}

void add_tet(RegionVolumes& volumes, const TetMesh& mesh, TetId tet, VertexId vertex) {
  volumes.add(mesh.region(tet), -vector_area2(mesh, {tet, mesh.corner_of(tet, vertex)}));
}

std::int64_t surface_tag(const TetMesh& mesh, Side side) {
  const Link link = mesh.link(side);
  if (link.is_boundary()) {
    return link.tag();
  }
  // A border is seen from the lower region, so that its two sides do not cancel.
  const bool is_border = mesh.has_regions() && mesh.region(side.tet()) < mesh.region(link.side().tet());
  return is_border ? std::int64_t{kBorderTag} : -1;
}

VertexSurfaces surfaces_at(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star) {
  VertexSurfaces found;
  const std::uint8_t bits = mesh.shape_of(vertex);
  if (bits == 0 && !mesh.has_regions()) {
    return found;
  }
  for (const TetId tet : star) {
    for (unsigned s = 0; s < 4; ++s) {
      const std::int64_t tag = mesh.vertices(tet)[s] == vertex ? -1 : surface_tag(mesh, {tet, s});
      if (tag >= 0) {
        add_face(found, static_cast<std::uint32_t>(tag), vector_area2(mesh, {tet, s}));
      }
    }
  }
  decide_mobility(found);
  hold_regions(mesh, vertex, star, found);
  if ((bits & shape::kFront) != 0) {
    find_front(mesh, vertex, star, found);
  }
  if ((bits & shape::kPinched) != 0) {
    found.mobility = Mobility::kFixed;
  }
  return found;
}

bool find_volume_step(const VertexSurfaces& surfaces, const std::array<double, 2>& lost6, Vec3& step) {
  const Vec3& p = surfaces.surfaces[0].vector_area;
  const Vec3& q = surfaces.surfaces[1].vector_area;
  if (surfaces.count == 1) {
    step = (lost6[0] / p.squaredNorm()) * p;
    return true;
  }
  const double pp = p.dot(p), pq = p.dot(q), qq = q.dot(q), determinant = pp * qq - pq * pq;
  if (surfaces.count != 2 || !(determinant > kLeastSine * kLeastSine * pp * qq)) {
    return false;
  }
  step = ((lost6[0] * qq - lost6[1] * pq) * p + (lost6[1] * pp - lost6[0] * pq) * q) / determinant;
  return true;
}

bool keeps_front(const TetMesh& mesh, const Vec3& place, const VertexSurfaces& surfaces, double tolerance) {
  const Vec3& start = mesh.rest(surfaces.front_ends[0]);
  const Vec3 chord = mesh.rest(surfaces.front_ends[1]) - start, arm = place - start;
  return chord.cross(arm).squaredNorm() <= tolerance * tolerance * chord.squaredNorm();
}

}  // namespace v0
}  // namespace incise
