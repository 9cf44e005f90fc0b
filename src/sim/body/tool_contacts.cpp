// SPDX-License-Identifier: Apache-2.0
// Vertices of the surface that are in a tool, with an anchor for friction that goes with the tool and slips behind it;
// the depth that a vertex had before the tool moved counts as none, and fades (docs/internals.md, 4).
#include <algorithm>

#include "incise/sim/contact.h"
#include "sim/body/constants.h"
#include "sim/body/tool_touch.h"

namespace incise {
inline namespace v0 {

using detail::Touch;

namespace {

/// The middle of one of the vertex' tets: on the tissue's side of its surface.
Vec3 tissue_behind(const TetMesh& mesh, std::span<const Vec3> positions, VertexId v) {
  Vec3 sum = Vec3::Zero();
  for (const VertexId corner : mesh.vertices(mesh.tet_of(v))) sum += positions[corner.value];
  return sum / 4;
}

bool is_surface(std::uint8_t bits) {
  return (bits & (shape::kSkin | shape::kWall)) != 0 && (bits & (shape::kFront | shape::kDead)) == 0;
}

/// The tool that a point is deepest in, or nearest to.
struct Deepest {
  Touch touch;
  std::uint32_t tool = 0;
};
Deepest deepest_of(std::span<const Tool> tools, const Vec3& point, const Vec3& inner) {
  Deepest deepest;
  for (std::uint32_t i = 0; i < tools.size(); ++i) {
    const Touch found = detail::touch_of(tools[i], point, inner);
    if (found.distance < deepest.touch.distance) deepest = {found, i};
  }
  return deepest;
}

}  // namespace

/// How deep a point that stands still was in a tool before this one moved: 0 where it was outside.
double ToolContacts::depth_before(const Tool& tool, std::size_t index, const Vec3& point, const Vec3& inner) const {
  const bool is_known = index < tools_.size() && tools_[index].index() == tool.index();
  return std::min(0.0, detail::touch_of(is_known ? tools_[index] : tool, point, inner).distance);
}

/// What is known of a touched vertex, or begins to be. `next`: how far `held_` has been gone through.
ToolContacts::Held ToolContacts::take_up(const Held& found, const Tool& tool, const Vec3& point, const Vec3& inner,
                                         double distance, std::size_t& next) const {
  while (next < held_.size() && held_[next].vertex < found.vertex) ++next;
  Held held = found;
  if (next < held_.size() && held_[next].vertex == found.vertex && held_[next].tool == found.tool) {
    held = held_[next];
    ++held.age;
  } else if (distance < 0) {
    held.depth = std::max(distance, depth_before(tool, found.tool, point, inner));
  }
  return held;
}

/// Friction's part: the anchor goes with the tool, and comes along where the tissue has slipped.
void ToolContacts::rub(const ToolContactOptions& options, const Vec3& point, const Vec3& tool_way, const Vec3& force,
                       Held& held, Pull& pull) {
  pull.drag = options.friction * std::max(0.0, force.dot(pull.axis));
  Vec3 slip = point - held.anchor - tool_way;
  slip -= pull.axis.dot(slip) * pull.axis;
  const double stiffness = options.stiffness * options.length_unit;  // N per length unit
  const double farthest = stiffness > 0 ? pull.drag / stiffness : 0.0, length = slip.norm();
  if (length > farthest) slip *= farthest / length;
  held.anchor = point - slip;
  pull.anchor = held.anchor;
}

namespace {

/// How far a tool of the same kind has moved as a whole.
Vec3 way_of(const Tool& before, const Tool& now) {
  return std::visit(
      [&before](const auto& tool) -> Vec3 { return tool.way(std::get<std::decay_t<decltype(tool)>>(before), tool); },
      now);
}

}  // namespace

std::size_t ToolContacts::find(const TetMesh& mesh, std::span<const Vec3> positions, std::span<const Tool> tools,
                               const ToolContactOptions& options, const std::function<Vec3(std::size_t)>& force_of,
                               std::vector<Pull>& pulls) {
  const auto has_sides = [](const Tool& tool) { return std::visit([](const auto& t) { return t.kHasSides; }, tool); };
  const bool asks_what_is_behind = std::any_of(tools.begin(), tools.end(), has_sides);
  std::size_t next = 0, touched = 0;
  fresh_.clear();
  for (std::uint32_t slot = 0; slot < mesh.vertex_slots() && !tools.empty(); ++slot) {
    const VertexId v(slot);
    if (!is_surface(mesh.shape_of(v)) || !mesh.tet_of(v).is_valid()) continue;
    const Vec3& x = positions[slot];
    const Vec3 inner = asks_what_is_behind ? tissue_behind(mesh, positions, v) : x;
    const auto [touch, tool] = deepest_of(tools, x, inner);
    if (!(touch.distance < std::numeric_limits<double>::infinity())) continue;
    const Vec3 way = slot < positions_.size() ? Vec3(x - positions_[slot] + options.speed_up) : options.speed_up;
    if (touch.distance >= options.margin + std::max(0.0, -way.dot(touch.normal))) continue;
    touched += touch.distance < options.margin ? 1U : 0U;
    Held held = take_up({slot, tool, 0, 0, x}, tools[tool], x, inner, touch.distance, next);
    const bool fades = held.age < detail::kFadingFrames;
    const double left = fades ? held.depth * (detail::kFadingFrames - held.age) / detail::kFadingFrames : 0.0;
    Pull pull;
    pull.vertices[0] = v;
    pull.target = touch.surface + left * touch.normal;
    pull.axis = touch.normal;
    pull.stiffness = options.stiffness;
    pull.pushes_only = true;
    if (options.friction > 0 && held.age > 0) {
      rub(options, x, way_of(tools_[tool], tools[tool]), force_of(next), held, pull);
    }
    fresh_.push_back(held);
    pulls.push_back(pull);
  }
  held_.swap(fresh_);
  tools_.assign(tools.begin(), tools.end());
  positions_.assign(positions.begin(), positions.end());
  has_friction_ = options.friction > 0;
  return touched;
}

void ToolContacts::add_to(StateHash& hash) const {
  for (const Held& held : held_) {
    if (held.depth != 0 && held.age < detail::kFadingFrames) {
      hash.add(std::uint64_t{held.vertex} << 32U | held.tool);
      hash.add(std::uint64_t{held.age});
      hash.add(held.depth);
    }
    if (!has_friction_) continue;
    for (const double x : {held.anchor.x(), held.anchor.y(), held.anchor.z()}) hash.add(x);
  }
}

}  // namespace v0
}  // namespace incise
