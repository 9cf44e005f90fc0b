// SPDX-License-Identifier: Apache-2.0
// Each piece goes away from the body's middle by a share of the body's width in that direction, and points follow the
// piece of their vertex.
#include "app/view/spread_pieces.h"

#include "incise/geom/box.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kCoincides = 1e-9;  // of the body's size: nearer middles are the same

std::vector<Box> boxes_of(const TetMesh& mesh, const Components& pieces) {
  std::vector<Box> boxes(pieces.count());
  mesh.for_each_tet([&](TetId tet) {
    for (const VertexId v : mesh.vertices(tet)) boxes[pieces.label[tet.value]].extend(mesh.current(v));
  });
  return boxes;
}

Vec3 middle_of(const Box& box) {
  return 0.5 * (box.lo + box.hi);
}

Vec3 shift_of(const Box& piece, const Box& body, double share) {
  const Vec3 size = body.hi - body.lo;
  const Vec3 away = middle_of(piece) - middle_of(body);
  if (!(away.norm() > kCoincides * size.norm())) return Vec3::Zero();
  const Vec3 direction = away.normalized();
  return share * direction.cwiseAbs().dot(size) * direction;
}

std::vector<Vec3> shifts_of(const std::vector<Box>& pieces, double share) {
  Box body;
  for (const Box& piece : pieces) body.extend(piece);
  std::vector<Vec3> shifts;
  shifts.reserve(pieces.size());
  for (const Box& piece : pieces) shifts.push_back(shift_of(piece, body, share));
  return shifts;
}

}  // namespace

void spread_pieces(const TetMesh& mesh, const Components& pieces, double share, SurfaceFrame& frame) {
  if (!frame.topology || !(share > 0)) return;
  const std::vector<Vec3> shifts = shifts_of(boxes_of(mesh, pieces), share);
  const std::vector<VertexId>& vertices = frame.topology->vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].is_valid()) continue;
    const Vec3& shift = shifts[pieces.label[mesh.tet_of(vertices[i]).value]];
    frame.positions[i] = (frame.positions[i].cast<double>() + shift).cast<float>();
  }
}

}  // namespace app
}  // namespace v0
}  // namespace incise
