// SPDX-License-Identifier: Apache-2.0
// What a tool is to the tissue comes down to one function for each shape: distance, normal and nearest place; all else
// goes by `std::visit` (docs/internals.md, 4).
#include "incise/sim/contact.h"

#include <algorithm>
#include <cmath>

#include "incise/mesh/tet_mesh.h"
#include "sim/body/bounds.h"
#include "sim/body/constants.h"
#include "sim/body/tool_touch.h"

namespace incise {
inline namespace v0 {

namespace {

using detail::Touch;

Error bad(const char* message) {
  return {ErrorCode::kBadArgument, message, {}};
}

using detail::is_place;
using detail::is_real_size;

Status check_tool(const BallTool& ball) {
  if (!is_place(ball.centre)) return bad("the centre of a ball must be finite, within 1e+30");
  return is_real_size(ball.radius) ? Status{} : Status{bad("the radius of a ball must be above 0, at most 1e+30")};
}

Status check_tool(const RodTool& rod) {
  if (!is_place(rod.from) || !is_place(rod.to)) return bad("the ends of a rod must be finite, within 1e+30");
  return is_real_size(rod.radius) ? Status{} : Status{bad("the radius of a rod must be above 0, at most 1e+30")};
}

Status check_tool(const PlaneTool& plane) {
  if (!(std::abs(plane.offset) <= kGreatestExtent)) return bad("the offset of a plane must lie within 1e+30");
  return std::abs(plane.normal.squaredNorm() - 1) < 1e-6 ? Status{}
                                                         : Status{bad("the normal of a plane must be of length 1")};
}

Status check_tool(const FlatTool& flat) {
  if (flat.edge.size() < 2) return bad("the edge of a flat must have at least 2 points");
  if (!std::all_of(flat.edge.begin(), flat.edge.end(), is_place)) {
    return bad("the edge of a flat must be finite, within 1e+30");
  }
  if (!is_place(flat.back) || flat.back.isZero(0)) {
    return bad("the back of a flat must be finite, within 1e+30, and not zero");
  }
  return detail::is_size(flat.thickness) ? Status{}
                                         : Status{bad("the thickness of a flat must be at least 0, at most 1e+30")};
}

Touch touch_around(const Vec3& x, const Vec3& axis_point, double radius) {
  const Vec3 out = x - axis_point;
  const double length = out.norm();
  if (!(length > 0)) return {};
  const Vec3 normal = out / length;
  return {length - radius, normal, axis_point + radius * normal};
}

Touch touch(const BallTool& ball, const Vec3& x, const Vec3& /*inner*/) {
  return touch_around(x, ball.centre, ball.radius);
}

Touch touch(const RodTool& rod, const Vec3& x, const Vec3& /*inner*/) {
  const Vec3 along = rod.to - rod.from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::min(1.0, std::max(0.0, along.dot(x - rod.from) / length2)) : 0.0;
  return touch_around(x, rod.from + t * along, rod.radius);
}

Touch touch(const PlaneTool& plane, const Vec3& x, const Vec3& /*inner*/) {
  const double distance = plane.normal.dot(x) - plane.offset;
  return {distance, plane.normal, x - distance * plane.normal};
}

/// One part of a flat, between two points of the edge. The tissue behind the vertex tells on which side it belongs.
Touch touch_strip(const FlatTool& flat, std::size_t i, const Vec3& x, const Vec3& inner) {
  const Vec3& from = flat.edge[i];
  const Vec3 along = flat.edge[i + 1] - from, normal = along.cross(flat.back);
  const double area2 = normal.squaredNorm();
  if (!(area2 > 0)) return {};
  const double s = (x - from).cross(flat.back).dot(normal) / area2;
  const double t = along.cross(x - from).dot(normal) / area2;
  if (!(s >= 0 && s <= 1 && t > 0 && t <= 1)) return {};
  const Vec3 unit = normal / std::sqrt(area2);
  const Vec3 out = unit.dot(inner - x) >= 0 ? unit : Vec3(-unit);
  const double height = out.dot(x - from);
  return {height - flat.thickness / 2, out, x - (height - flat.thickness / 2) * out};
}

/// Only tissue near the flat is kept on its side: what is deep behind it was never beside it.
Touch touch(const FlatTool& flat, const Vec3& x, const Vec3& inner) {
  const double deepest = -0.5 * flat.back.norm();
  Touch nearest;
  for (std::size_t i = 0; i + 1 < flat.edge.size(); ++i) {
    const Touch strip = touch_strip(flat, i, x, inner);
    if (strip.distance < nearest.distance && strip.distance > deepest) nearest = strip;
  }
  return nearest;
}

void add_outline(const BallTool& ball, ToolOutline& outline) {
  outline.balls.push_back({ball.centre, ball.radius});
}
void add_outline(const RodTool& rod, ToolOutline& outline) {
  for (int i = 0; i <= detail::kRodBalls; ++i) {
    outline.balls.push_back(
        {rod.from + (rod.to - rod.from) * (static_cast<double>(i) / detail::kRodBalls), rod.radius});
  }
}
void add_outline(const PlaneTool& /*plane*/, ToolOutline& /*outline*/) {}  // drawing it would hide the body
void add_outline(const FlatTool& flat, ToolOutline& outline) {
  for (std::size_t i = 1; i < flat.edge.size(); ++i) {
    const Vec3 &a = flat.edge[i - 1], &b = flat.edge[i];
    outline.triangles.push_back({a, b, b + flat.back});
    outline.triangles.push_back({a, b + flat.back, a + flat.back});
  }
}

}  // namespace

ToolOutline outline_of(const Tool& tool) {
  ToolOutline outline;
  std::visit([&](const auto& t) { add_outline(t, outline); }, tool);
  return outline;
}

Status check(const Tool& tool) {
  return std::visit([](const auto& t) { return check_tool(t); }, tool);
}

Touch detail::touch_of(const Tool& tool, const Vec3& point, const Vec3& inner) {
  return std::visit([&](const auto& t) { return touch(t, point, inner); }, tool);
}

}  // namespace v0
}  // namespace incise
