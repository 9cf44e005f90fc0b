// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cut/sweep.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

/// The unit normal of a sheet at a place that it passes within `kJoinOffset` of the mean edge at a vertex; none
/// elsewhere. Cost: a search of the sheet, and the vertex's star.
[[nodiscard]] std::optional<Vec3> passing_normal(const TetMesh& mesh, const Sheet& sheet, const Vec3& place,
                                                 VertexId vertex, StarWalker& walker);

/// Whether a vertex lies within so much of a sheet, or may lie so on its next strip: beyond its border, within a cone
/// of a slope. Cost: the same.
[[nodiscard]] bool may_lie_on(const TetMesh& mesh, const Sheet& sheet, VertexId vertex, double slope,
                              StarWalker& walker);

}  // namespace v0
}  // namespace incise
