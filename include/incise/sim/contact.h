// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "incise/core/hash.h"
#include "incise/geom/vec.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/sim/body.h"

namespace incise {
inline namespace v0 {

// A tool is a struct with a name and a list of its fields: recordings, scenes, the window and the C interface go by
// these alone. Its shape is in contact.cpp, and `Tool` registers it.

/// A ball that presses on the body. Lengths in the mesh's unit, radius above 0.
struct BallTool {
  Vec3 centre = Vec3::Zero();  ///< length unit
  double radius = 1;           ///< length unit, above 0

  static constexpr const char* kName = "ball";  ///< in recordings and scenes
  static constexpr bool kMoves = true;          ///< a scene may move it along a path, its points from key to key
  static constexpr bool kHasSides = false;  ///< tissue stays on the side where it is: its shape asks what lies behind
  /// How far it has moved as a whole, length unit.
  static Vec3 way(const BallTool& before, const BallTool& now) { return now.centre - before.centre; }
  /// Calls `visit(name, field)` for each field: points, lists of points, and numbers.
  template <class Self, class Visit>
  static void for_each_field(Self& tool, Visit&& visit) {
    visit("centre", tool.centre);
    visit("radius", tool.radius);
  }
};

/// A rod with round ends: all within `radius` of the segment between its ends.
struct RodTool {
  Vec3 from = Vec3::Zero(), to = Vec3::UnitX();  ///< its ends, length unit
  double radius = 1;                             ///< length unit, above 0

  static constexpr const char* kName = "rod";  ///< in recordings and scenes
  static constexpr bool kMoves = true;         ///< a scene may move it along a path, its points from key to key
  static constexpr bool kHasSides = false;  ///< tissue stays on the side where it is: its shape asks what lies behind
  /// How far it has moved as a whole, length unit.
  static Vec3 way(const RodTool& before, const RodTool& now) {
    return 0.5 * (now.from + now.to - before.from - before.to);
  }
  /// Calls `visit(name, field)` for each field: points, lists of points, and numbers.
  template <class Self, class Visit>
  static void for_each_field(Self& tool, Visit&& visit) {
    visit("from", tool.from);
    visit("to", tool.to);
    visit("radius", tool.radius);
  }
};

/// Everything behind a plane: a table, a wall. The body stays where normal · x >= offset.
struct PlaneTool {
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double offset = 0;            ///< length unit

  static constexpr const char* kName = "plane";  ///< in recordings and scenes
  static constexpr bool kMoves = false;          ///< a scene may move it along a path, its points from key to key
  static constexpr bool kHasSides = false;  ///< tissue stays on the side where it is: its shape asks what lies behind
  /// How far it has moved as a whole, length unit.
  static Vec3 way(const PlaneTool& /*before*/, const PlaneTool& /*now*/) { return Vec3::Zero(); }
  /// Calls `visit(name, field)` for each field: points, lists of points, and numbers.
  template <class Self, class Visit>
  static void for_each_field(Self& tool, Visit&& visit) {
    visit("normal", tool.normal);
    visit("offset", tool.offset);
  }
};

/// The flat of a blade: the strip from its edge to `back` behind it. Tissue stays on the side where it is.
struct FlatTool {
  std::vector<Vec3> edge;     ///< at least 2 points
  Vec3 back = Vec3::UnitZ();  ///< from the edge to the back of the blade, not zero
  double thickness = 0;       ///< at least 0: walls are kept half of it away

  static constexpr const char* kName = "flat";  ///< in recordings and scenes
  static constexpr bool kMoves = false;         ///< a scene may move it along a path, its points from key to key
  static constexpr bool kHasSides = true;  ///< tissue stays on the side where it is: its shape asks what lies behind
  /// How far it has moved as a whole, length unit.
  static Vec3 way(const FlatTool& before, const FlatTool& now) { return now.edge.front() - before.edge.front(); }
  /// Calls `visit(name, field)` for each field: points, lists of points, and numbers.
  template <class Self, class Visit>
  static void for_each_field(Self& tool, Visit&& visit) {
    visit("edge", tool.edge);
    visit("back", tool.back);
    visit("thickness", tool.thickness);
  }
};

/// Anything that presses on a body, in the order of `incise_tool_kind` of the C interface.
using Tool = std::variant<BallTool, RodTool, PlaneTool, FlatTool>;

/// Calls `visit(tool)` with one tool of each kind, as it is at first, in the order of `Tool`.
template <class Visit>
void for_each_tool_kind(Visit&& visit) {
  const auto visit_at = [&]<std::size_t... kIndices>(std::index_sequence<kIndices...>) {
    (visit(std::variant_alternative_t<kIndices, Tool>()), ...);
  };
  visit_at(std::make_index_sequence<std::variant_size_v<Tool>>());
}

/// What a tool looks like. Lengths in the mesh's unit.
struct ToolOutline {
  /// Drawn solid.
  struct Ball {
    Vec3 centre;    ///< length unit
    double radius;  ///< length unit
  };
  std::vector<Ball> balls;                     ///< of what is solid
  std::vector<std::array<Vec3, 3>> triangles;  ///< of what is flat
};
/// Nothing of a plane, which is where the body stops. Cost: O(points).
[[nodiscard]] ToolOutline outline_of(const Tool& tool);

/// Errors: kBadArgument names what is out of range.
[[nodiscard]] Status check(const Tool& tool);

/// How tools press.
struct ToolContactOptions {
  double stiffness = 0;          ///< N/m per vertex, at least 0
  double margin = 0;             ///< length unit, at least 0: as near as this a vertex is touched, however slow it is
  Vec3 speed_up = Vec3::Zero();  ///< by which a frame's motion grows in the next one: gravity, length unit
  double length_unit = 1;        ///< metres
  double friction = 0;           ///< of tissue on tools, at least 0: against anchors that tools take along
};

/// What tools touch, from frame to frame.
///
/// A vertex of the surface is about to be touched where `margin`, together with the way that it went in the last frame,
/// `speed_up` and the way of the tool, brings it into the tool: so it is stopped at the tool's surface and not found
/// within, where a spring would throw it out with energy that nobody put in. What is found within all the same (a tool
/// that appears in the tissue, a cut under it) starts without a force: the depth at which it is found counts as none
/// and fades over five frames. What the tool's own motion brings into it is pushed at once: the hand does that work.
/// The same calls give the same bits everywhere.
class ToolContacts {
 public:
  /// Appends a pull that only pushes, along the tool's normal, for each vertex that is touched or about to be. Each
  /// vertex is pushed by the tool that it is deepest in alone. Tools are the same from call to call by their place in
  /// the list and their kind. To be called once per frame. Returns how many vertices lie within `margin`.
  /// `force_of(index)`: what the pull with that number, among those of the last call, did to the tissue, N.
  /// Cost: about 3 ns per vertex slot and tool, plus the touched vertices.
  std::size_t find(const TetMesh& mesh, std::span<const Vec3> positions, std::span<const Tool> tools,
                   const ToolContactOptions& options, const std::function<Vec3(std::size_t)>& force_of,
                   std::vector<Pull>& pulls);
  /// Adds the depths that still fade and the anchors of friction to a hash; nothing where there are none. Cost:
  /// O(touched).
  void add_to(StateHash& hash) const;

 private:
  /// A vertex that a tool touches, or is about to.
  struct Held {
    std::uint32_t vertex = 0, tool = 0;
    unsigned age = 0;            ///< frames
    double depth = 0;            ///< that counted as none at first, at most 0; length unit
    Vec3 anchor = Vec3::Zero();  ///< where friction holds it
  };

  static void rub(const ToolContactOptions& options, const Vec3& point, const Vec3& tool_way, const Vec3& force,
                  Held& held, Pull& pull);
  [[nodiscard]] double depth_before(const Tool& tool, std::size_t index, const Vec3& point, const Vec3& inner) const;
  [[nodiscard]] Held take_up(const Held& found, const Tool& tool, const Vec3& point, const Vec3& inner, double distance,
                             std::size_t& next) const;

  std::vector<Held> held_, fresh_;  // by vertex; `fresh_`: scratch
  std::vector<Tool> tools_;         // of the last call
  std::vector<Vec3> positions_;     // likewise
  bool has_friction_ = false;       // likewise
};

}  // namespace v0
}  // namespace incise
