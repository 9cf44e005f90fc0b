// SPDX-License-Identifier: Apache-2.0
// Four bits for each tet say which of its sides are open; faces are listed anew only where some bits changed, eight
// tets at a time where there are none (docs/internals.md, 4).
#include "sim/body/contact_surface.h"

#include <algorithm>
#include <cstring>

namespace incise {
inline namespace v0 {
namespace detail {

void ContactSurface::set(const TetMesh& mesh, TetId tet, bool is_part) {
  if (tet.value >= sides_.size()) sides_.resize(tet.value + 1, 0);
  std::uint8_t bits = 0;
  for (unsigned side = 0; is_part && side < 4; ++side) {
    if (mesh.links(tet)[side].is_boundary()) bits |= static_cast<std::uint8_t>(1U << side);
  }
  // A tet on the surface may have other corners than before, or other places at rest.
  is_stale_ = is_stale_ || bits != 0 || sides_[tet] != 0;
  sides_[tet] = bits;
}

void ContactSurface::keep(std::uint32_t tet_slots) {
  if (tet_slots >= sides_.size()) return;
  sides_.resize(tet_slots);
  is_stale_ = true;
}

bool ContactSurface::refresh(const TetMesh& mesh) {
  if (!is_stale_) return false;
  is_stale_ = false;
  list_faces(mesh);
  for (const std::uint32_t v : vertices_) of_vertex_[VertexId(v)] = {};
  vertices_.clear();
  of_vertex_.resize(mesh.vertex_slots());
  double edges = 0;
  for (const ContactFace& face : faces_) {
    const auto& [a, b, c] = face.corners;
    const Vec3 &p = mesh.rest(VertexId(a)), &q = mesh.rest(VertexId(b)), &r = mesh.rest(VertexId(c));
    const double area = 0.5 * (q - p).cross(r - p).norm();
    edges += (q - p).norm() + (r - q).norm() + (p - r).norm();
    for (const std::uint32_t v : face.corners) {
      Vertex& vertex = of_vertex_[VertexId(v)];
      if (vertex.area == 0) vertices_.push_back(v);
      vertex.area += std::max(area / 3, 1e-300);
      vertex.is_at_front = (mesh.shape_of(VertexId(v)) & shape::kFront) != 0;
      vertex.is_beside_front = vertex.is_beside_front || face.is_at_front;
    }
  }
  spacing_ = faces_.empty() ? 0.0 : edges / (3 * static_cast<double>(faces_.size()));
  std::sort(vertices_.begin(), vertices_.end());
  return true;
}

void ContactSurface::list_faces(const TetMesh& mesh) {
  faces_.clear();
  const std::uint32_t slots = std::min<std::uint32_t>(mesh.tet_slots(), static_cast<std::uint32_t>(sides_.size()));
  for (std::uint32_t t = 0; t < slots;) {
    std::uint64_t eight = 1;
    if (t + 8 <= slots) std::memcpy(&eight, sides_.data() + t, sizeof eight);
    if (eight == 0) {
      t += 8;
      continue;
    }
    const TetId tet(t++);
    for (unsigned side = 0; side < 4; ++side) {
      if ((unsigned{sides_[tet]} >> side & 1U) == 0) continue;
      ContactFace face{Side(tet, side), {}, false};
      const auto corners = mesh.vertices(face.side);
      for (unsigned i = 0; i < 3; ++i) {
        face.corners[i] = corners[i].value;
        face.is_at_front = face.is_at_front || (mesh.shape_of(corners[i]) & shape::kFront) != 0;
      }
      faces_.push_back(face);
    }
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
