// SPDX-License-Identifier: Apache-2.0
// A walk around a vertex on the boundary, face by face; the edges at which tag or normal changes are contours, and
// their number tells the class (docs/paper_map.md, section 2.5).
#include "paper/paper_classes.h"

#include <algorithm>

namespace incise {
inline namespace v0 {
namespace paper {

namespace {

bool has_one_region(const TetMesh& mesh, const std::vector<TetId>& star) {
  return std::all_of(star.begin(), star.end(), [&](TetId t) { return mesh.region(t) == mesh.region(star.front()); });
}

/// The corners of a face behind `vertex`, in its order.
std::array<VertexId, 2> others(const TetMesh& mesh, Side face, VertexId vertex) {
  const auto v = mesh.vertices(face);
  const unsigned at = v[0] == vertex ? 0 : (v[1] == vertex ? 1 : 2);
  return {v[(at + 1) % 3], v[(at + 2) % 3]};
}

/// The boundary face that follows `face` around the edge between `a` and `b`.
Side next_boundary(const TetMesh& mesh, Side face, VertexId a, VertexId b) {
  while (true) {
    const TetVertices& v = mesh.vertices(face.tet());
    unsigned corner = 0;
    while (corner == face.side() || v[corner] == a || v[corner] == b) {
      ++corner;
    }
    face = Side(face.tet(), corner);
    if (mesh.link(face).is_boundary()) {
      return face;
    }
    face = mesh.link(face).side();
  }
}

}  // namespace

BoundaryFaces find_boundary_faces(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star) {
  BoundaryFaces faces;
  for (const TetId tet : star) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.links(tet)[s].is_boundary() && mesh.vertices(tet)[s] != vertex) {
        faces.first = faces.count++ == 0 ? Side(tet, s) : faces.first;
      }
    }
  }
  return faces;
}

Vec3 area_vector(const TetMesh& mesh, Side face) {
  const auto v = mesh.vertices(face);
  return (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0]));
}

VertexClass ClassFinder::classify(const TetMesh& mesh, VertexId vertex) {
  rim_.clear();
  contour_.clear();
  const std::vector<TetId>& star = walker_.star(mesh, vertex);
  const bool is_held = held_ != nullptr && held_->holds(vertex);
  const bool is_clear =
      !is_held && (mesh.shape_of(vertex) & shape::kPinched) == 0 && !star.empty() && has_one_region(mesh, star);
  if (!is_clear) {
    return VertexClass::kCorner;
  }
  const BoundaryFaces faces = find_boundary_faces(mesh, vertex, star);
  if (faces.count == 0) {
    return VertexClass::kInside;
  }
  if (!walk_fan(mesh, vertex, faces.first) || fan_.size() != faces.count) {
    return VertexClass::kCorner;
  }
  find_contour(mesh);
  if (contour_.empty()) {
    return VertexClass::kSurface;
  }
  return contour_.size() != 2 || turns_sharply(mesh, vertex) ? VertexClass::kCorner : VertexClass::kContour;
}

/// Goes once around the vertex on the boundary. False where the way does not come back.
bool ClassFinder::walk_fan(const TetMesh& mesh, VertexId vertex, Side first) {
  fan_.clear();
  Side face = first;
  do {
    const auto [from, to] = others(mesh, face, vertex);
    fan_.push_back(face);
    rim_.push_back(from);
    face = next_boundary(mesh, face, vertex, to);
  } while (face != first && fan_.size() < kLongestFan);
  return face == first;
}

void ClassFinder::find_contour(const TetMesh& mesh) {
  for (std::size_t i = 0; i < fan_.size(); ++i) {
    const Side face = fan_[i], before = fan_[i == 0 ? fan_.size() - 1 : i - 1];
    const bool is_one_surface = mesh.link(face).tag() == mesh.link(before).tag() &&
                                is_smooth(area_vector(mesh, face), area_vector(mesh, before));
    if (!is_one_surface) {
      contour_.push_back(rim_[i]);
    }
  }
}

bool ClassFinder::turns_sharply(const TetMesh& mesh, VertexId vertex) const {
  const Vec3 in = mesh.rest(vertex) - mesh.rest(contour_[0]), out = mesh.rest(contour_[1]) - mesh.rest(vertex);
  return !is_smooth(in, out);
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
