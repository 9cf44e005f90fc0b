// SPDX-License-Identifier: Apache-2.0
#include "improve/surfaces.h"

#include <algorithm>
#include <cmath>

namespace incise::inline v0 {

namespace {

/// Faces whose normals have at least this cosine with the first of a surface are part of it: 60 degrees.
constexpr double kSmoothCosine = 0.5;
/// Two surfaces that meet at less than this sine have no line to slide along.
constexpr double kLeastSine = 0.17;

bool is_same_plane(const Vec3& a, const Vec3& b) {
  return a.cross(b).squaredNorm() <= kFlat * kFlat;
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
    if (surfaces[i].tag == tag && surfaces[i].first_normal.dot(normal) >= kSmoothCosine) {
      return i;
    }
  }
  return count;
}

Vec3 vector_area2(const TetMesh& mesh, Side side) {
  const auto v = mesh.vertices(side);
  return (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0]));
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
  if ((bits & (shape::kFront | shape::kPinched)) != 0) {
    found.mobility = Mobility::kFixed;
  }
  return found;
}

}  // namespace incise::inline v0
