// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "incise/geom/vec.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/sim/body.h"

namespace incise {
inline namespace v0 {

/// A ball that presses on the body. Lengths in the mesh's unit, radius above 0.
struct BallTool {
  Vec3 centre = Vec3::Zero();  ///< length unit
  double radius = 1;           ///< length unit, above 0
};

/// A rod with round ends: all within `radius` of the segment between its ends.
struct RodTool {
  Vec3 from = Vec3::Zero(), to = Vec3::UnitX();  ///< its ends, length unit
  double radius = 1;                             ///< length unit, above 0
};

/// Everything behind a plane: a table, a wall. The body stays where normal · x >= offset.
struct PlaneTool {
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double offset = 0;            ///< length unit
};

/// The flat of a blade: the strip from its edge to `back` behind it. Tissue stays on the side where it is.
struct FlatTool {
  std::vector<Vec3> edge;     ///< at least 2 points
  Vec3 back = Vec3::UnitZ();  ///< from the edge to the back of the blade, not zero
  double thickness = 0;       ///< at least 0: walls are kept half of it away
};

/// Anything that presses on a body.
using Tool = std::variant<BallTool, RodTool, PlaneTool, FlatTool>;

/// Errors: kBadArgument names what is out of range.
[[nodiscard]] Status check(const Tool& tool);

/// Finds the vertices of the surface that a tool touches, or is about to, and what it does to each: a pull that only
/// pushes, along the tool's normal.
///
/// A vertex counts as about to be touched within `margin` of the tool. Each vertex is pushed by the tool that it is
/// deepest in alone. `stiffness` in N/m per vertex.
/// Appends to `pulls`. Cost: about 2 ns per vertex slot and tool, plus the touched vertices.
void find_contacts(const TetMesh& mesh, std::span<const Vec3> positions, std::span<const Tool> tools, double stiffness,
                   double margin, std::vector<Pull>& pulls);

}  // namespace v0
}  // namespace incise
