// SPDX-License-Identifier: Apache-2.0
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

std::size_t ToolContacts::find(const TetMesh& mesh, std::span<const Vec3> positions, std::span<const Tool> tools,
                               const ToolContactOptions& options, std::vector<Pull>& pulls) {
  const bool has_flat =
      std::any_of(tools.begin(), tools.end(), [](const Tool& tool) { return std::holds_alternative<FlatTool>(tool); });
  std::size_t next = 0, touched = 0;
  fresh_.clear();
  for (std::uint32_t slot = 0; slot < mesh.vertex_slots() && !tools.empty(); ++slot) {
    const VertexId v(slot);
    if (!is_surface(mesh.shape_of(v)) || !mesh.tet_of(v).is_valid()) continue;
    const Vec3& x = positions[slot];
    const Vec3 inner = has_flat ? tissue_behind(mesh, positions, v) : x;  // flats alone ask for it
    const auto [touch, tool] = deepest_of(tools, x, inner);
    if (!(touch.distance < std::numeric_limits<double>::infinity())) continue;
    const Vec3 way = slot < positions_.size() ? Vec3(x - positions_[slot] + options.speed_up) : options.speed_up;
    const double comes_near = std::max(0.0, -way.dot(touch.normal));
    if (touch.distance >= options.margin + comes_near) continue;
    touched += touch.distance < options.margin ? 1U : 0U;
    const Held held = take_up({slot, tool, 0, 0}, tools[tool], x, inner, touch.distance, next);
    fresh_.push_back(held);
    const double left = held.age < detail::kFadingFrames
                            ? held.depth * (detail::kFadingFrames - held.age) / detail::kFadingFrames
                            : 0.0;
    Pull pull;
    pull.vertices[0] = v;
    pull.target = touch.surface + left * touch.normal;
    pull.axis = touch.normal;
    pull.stiffness = options.stiffness;
    pull.pushes_only = true;
    pulls.push_back(pull);
  }
  held_.swap(fresh_);
  tools_.assign(tools.begin(), tools.end());
  positions_.assign(positions.begin(), positions.end());
  return touched;
}

void ToolContacts::add_to(StateHash& hash) const {
  for (const Held& held : held_) {
    if (held.depth == 0 || held.age >= detail::kFadingFrames) continue;
    hash.add(std::uint64_t{held.vertex} << 32U | held.tool);
    hash.add(std::uint64_t{held.age});
    hash.add(held.depth);
  }
}

}  // namespace v0
}  // namespace incise
