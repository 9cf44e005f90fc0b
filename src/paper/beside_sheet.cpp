// SPDX-License-Identifier: Apache-2.0
// The nearest place of the sheet decides, and a cone from its border says where a next strip may still pass
// (docs/internals.md, 3.12).
#include "paper/beside_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "incise/mesh/edge_length.h"
#include "paper/constants.h"

namespace incise {
inline namespace v0 {

namespace {

double offset_at(const TetMesh& mesh, VertexId vertex, StarWalker& walker) {
  return kJoinOffset * mean_edge_length_at(mesh, vertex, walker.star(mesh, vertex));
}

}  // namespace

std::optional<Vec3> passing_normal(const TetMesh& mesh, const Sheet& sheet, const Vec3& place, VertexId vertex,
                                   StarWalker& walker) {
  const auto hit = sheet.tree().closest(place, offset_at(mesh, vertex, walker));
  return hit.is_valid() ? std::optional<Vec3>(sheet.normal(hit.triangle).normalized()) : std::nullopt;
}

bool may_lie_on(const TetMesh& mesh, const Sheet& sheet, VertexId vertex, double slope, StarWalker& walker) {
  const auto hit = sheet.tree().closest(mesh.rest(vertex), std::numeric_limits<double>::max());
  const Vec3 way = mesh.rest(vertex) - hit.point;
  const double height2 = std::pow(sheet.normal(hit.triangle).normalized().dot(way), 2);
  const double beyond2 = std::max(0.0, way.squaredNorm() - height2);
  return height2 <= std::max(std::pow(offset_at(mesh, vertex, walker), 2), slope * slope * beyond2);
}

}  // namespace v0
}  // namespace incise
