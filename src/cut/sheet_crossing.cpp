// SPDX-License-Identifier: Apache-2.0
// An edge crosses a triangle if its ends lie on different sides and its line turns alike around all three edges: five
// signs, none of them zero. Signs of vertices are kept in a table (docs/internals.md, 3.3).
#include "cut/sheet_crossing.h"

#include <cmath>

namespace incise {
inline namespace v0 {

namespace {

constexpr std::size_t kMaxSignTable = std::size_t{1} << 25U;
constexpr std::int8_t kUnknown = 2;

bool passes_through(const SosPoint& p, const SosPoint& q, const Sheet& sheet, std::uint32_t triangle) {
  const SosPoint& a = sheet.point(triangle, 0);
  const SosPoint& b = sheet.point(triangle, 1);
  const SosPoint& c = sheet.point(triangle, 2);
  const int first = orient3d_sos(p, q, a, b);
  return first == orient3d_sos(p, q, b, c) && first == orient3d_sos(p, q, c, a);
}

/// Where the plane of a triangle divides the segment, from p (0) to q (1).
double crossing_parameter(const Vec3& p, const Vec3& q, const Sheet& sheet, std::uint32_t triangle) {
  const Vec3 normal = sheet.normal(triangle);
  const Vec3& origin = sheet.point(triangle, 0).position;
  const double from = normal.dot(p - origin), to = normal.dot(q - origin);
  const double t = from / (from - to);
  return t >= 0.0 && t <= 1.0 ? t : (std::abs(from) <= std::abs(to) ? 0.0 : 1.0);
}

}  // namespace

void SideSigns::begin(const TetMesh& mesh, const Sheet& sheet) {
  for (const VertexId vertex : known_) index_[vertex.value] = 0;
  known_.clear();
  signs_.clear();
  index_.ensure(mesh.vertex_slots());
  mesh_ = &mesh;
  sheet_ = &sheet;
}

int SideSigns::compute(VertexId vertex, std::uint32_t triangle) const {
  return orient3d_sos(sheet_->point(triangle, 0), sheet_->point(triangle, 1), sheet_->point(triangle, 2),
                      {mesh_->rest(vertex), vertex.value});
}

int SideSigns::side(VertexId vertex, std::uint32_t triangle) {
  const std::size_t width = sheet_->triangle_count();
  std::uint32_t& row = index_[vertex.value];
  if (row == 0) {
    if ((known_.size() + 1) * width > kMaxSignTable) return compute(vertex, triangle);
    known_.push_back(vertex);
    row = static_cast<std::uint32_t>(known_.size());
    signs_.resize(known_.size() * width, kUnknown);
  }
  std::int8_t& sign = signs_[(row - std::size_t{1}) * width + triangle];
  if (sign == kUnknown) {
    sign = static_cast<std::int8_t>(compute(vertex, triangle));
  }
  return sign;
}

SheetCrossings find_crossings(const TetMesh& mesh, const Sheet& sheet, SideSigns& sides, VertexId a, VertexId b) {
  SheetCrossings found;
  const SosPoint p{mesh.rest(a), a.value}, q{mesh.rest(b), b.value};
  const auto test = [&](std::uint32_t triangle) {
    if (sides.side(a, triangle) == sides.side(b, triangle) || !passes_through(p, q, sheet, triangle)) {
      return;
    }
    const double t = crossing_parameter(p.position, q.position, sheet, triangle);
    if (found.count == 0 || t < found.t || (t == found.t && triangle < found.triangle)) {
      found.t = t;
      found.triangle = triangle;
    }
    if (found.count == 0 || t > found.t_last || (t == found.t_last && triangle > found.triangle_last)) {
      found.t_last = t;
      found.triangle_last = triangle;
    }
    ++found.count;
  };
  if (sheet.triangle_count() <= 2) {
    for (std::uint32_t triangle = 0; triangle < sheet.triangle_count(); ++triangle) test(triangle);
  } else {
    sheet.tree().for_each_overlap({p.position.cwiseMin(q.position), p.position.cwiseMax(q.position)}, test);
  }
  return found;
}

std::uint32_t count_crossings(const Sheet& sheet, const SosPoint& from, const SosPoint& to) {
  std::uint32_t count = 0;
  const Box way{from.position.cwiseMin(to.position), from.position.cwiseMax(to.position)};
  sheet.tree().for_each_overlap(way, [&](std::uint32_t triangle) {
    const SosPoint &a = sheet.point(triangle, 0), &b = sheet.point(triangle, 1), &c = sheet.point(triangle, 2);
    if (orient3d_sos(a, b, c, from) == orient3d_sos(a, b, c, to)) return;
    count += passes_through(from, to, sheet, triangle) ? 1U : 0U;
  });
  return count;
}

namespace detail {

bool is_graze(const Sheet& sheet, const Vec3& from, std::uint32_t first, const Vec3& to, std::uint32_t second) {
  return incise::is_graze(from, sheet.normal(first), to, sheet.normal(second), [&](const Vec3& place, double reach) {
    return sheet.tree().closest(place, reach).is_valid();
  });
}

}  // namespace detail

}  // namespace v0
}  // namespace incise
