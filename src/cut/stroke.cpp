// SPDX-License-Identifier: Apache-2.0
// What a stroke must be is checked here and nowhere else, so that everything behind it may rely on that. A plane
// becomes one triangle around the body, with no diagonal to fold along.
#include "incise/cut/stroke.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace incise {
inline namespace v0 {

namespace {

Error bad_stroke(const Stroke& stroke, const std::string& what, std::vector<std::uint64_t> ids = {}) {
  const std::string place = stroke.name.empty() ? "" : "stroke \"" + stroke.name + "\": ";
  return {ErrorCode::kBadArgument, place + what, std::move(ids)};
}

Error incomplete(const Stroke& stroke, const std::string& needs) {
  const std::string name = stroke.name.empty() ? "" : " \"" + stroke.name + "\"";
  return {ErrorCode::kBadArgument, "the stroke" + name + " needs " + needs, {}};
}

bool is_finite(const Vec3& p) {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

/// How many of the greatest sides of a box a point lies away from it, along the axis where that is most. Of a box
/// without sides: 0.
double reach_of(const Vec3& p, const Box& body) {
  const double size = body.is_empty() ? 0.0 : (body.hi - body.lo).maxCoeff();
  return size > 0 ? (body.lo - p).cwiseMax(p - body.hi).cwiseMax(0.0).maxCoeff() / size : 0.0;
}

std::string in_short(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

/// The point of the plane n·x = d that is nearest to `p`; exactly on the plane along the axes that n lies in.
Vec3 project(const Vec3& p, const Vec3& n, double d) {
  for (int axis = 0; axis < 3; ++axis) {
    if (n[(axis + 1) % 3] == 0 && n[(axis + 2) % 3] == 0) {
      Vec3 q = p;
      q[axis] = d / n[axis];
      return q;
    }
  }
  return p - n * ((n.dot(p) - d) / n.dot(n));
}

/// A unit vector orthogonal to `n`, in a coordinate plane where `n` allows.
Vec3 tangent_of(const Vec3& n) {
  int least = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(n[axis]) < std::abs(n[least])) {
      least = axis;
    }
  }
  const int i = (least + 1) % 3, j = (least + 2) % 3;
  Vec3 t = Vec3::Zero();
  t[i] = -n[j];
  t[j] = n[i];
  return t / t.norm();
}

}  // namespace

Status check(const Stroke& stroke) {
  const std::size_t times = stroke.times.size();
  if (stroke.edges.size() != times) {
    return incomplete(stroke, "one polyline per time; it has " + std::to_string(stroke.edges.size()) + " for " +
                                  std::to_string(times) + " times");
  }
  if (times < 2) {
    return incomplete(stroke, "at least two times: a blade sweeps, and cuts, what lies between two places");
  }
  for (std::size_t i = 0; i < times; ++i) {
    if (!std::isfinite(stroke.times[i]) || (i > 0 && !(stroke.times[i] > stroke.times[i - 1]))) {
      return bad_stroke(stroke, "times must be finite and increase; time " + std::to_string(i) + " does not", {i});
    }
    if (stroke.edges[i].size() < 2 || stroke.edges[i].size() != stroke.edges[0].size()) {
      return bad_stroke(stroke,
                        "every polyline needs the same number of points, at least 2; the one at time " +
                            std::to_string(i) + " has " + std::to_string(stroke.edges[i].size()),
                        {i});
    }
    for (std::size_t k = 0; k < stroke.edges[i].size(); ++k) {
      if (!is_finite(stroke.edges[i][k])) {
        return bad_stroke(stroke, "point " + std::to_string(k) + " at time " + std::to_string(i) + " is not finite",
                          {k, i});
      }
    }
  }
  return {};
}

namespace {

Error out_of_reach(const std::string& place, double reach) {
  return {ErrorCode::kBadArgument,
          place + " lies " + in_short(reach) + " times the body's size away from it; " + in_short(kGreatestReach) +
              " is the most: bring the blade nearer, or to the unit of the mesh",
          {}};
}

/// The first point of an edge that is too far away; one past the last where none is.
std::size_t first_out_of_reach(std::span<const Vec3> edge, const Box& body) {
  std::size_t k = 0;
  while (k < edge.size() && reach_of(edge[k], body) <= kGreatestReach) ++k;
  return k;
}

}  // namespace

Status check_reach(std::span<const Vec3> edge, const Box& body, const std::string& name) {
  const std::size_t k = first_out_of_reach(edge, body);
  if (k == edge.size()) return {};
  return out_of_reach(name + ": point " + std::to_string(k), reach_of(edge[k], body));
}

Status check_reach(const Stroke& stroke, const Box& body) {
  for (std::size_t i = 0; i < stroke.edges.size(); ++i) {
    const std::size_t k = first_out_of_reach(stroke.edges[i], body);
    if (k == stroke.edges[i].size()) continue;
    const std::string name = stroke.name.empty() ? "" : "stroke \"" + stroke.name + "\": ";
    return out_of_reach(name + "point " + std::to_string(k) + " at time " + std::to_string(i),
                        reach_of(stroke.edges[i][k], body));
  }
  return {};
}

Result<Stroke> plane_stroke(const Box& bounds, const Vec3& normal, double offset) {
  const double length = normal.norm();
  if (!is_finite(normal) || !std::isfinite(offset) || !(length > 0) || !std::isfinite(length)) {
    return Error{ErrorCode::kBadArgument, "a plane needs a finite, non-zero normal and a finite offset", {}};
  }
  if (!(bounds.hi - bounds.lo).allFinite()) {
    return Error{ErrorCode::kBadArgument, "a plane needs a body to cut: the mesh has no vertices", {}};
  }
  const Vec3 centre = project(0.5 * (bounds.lo + bounds.hi), normal, offset);
  const Vec3 u = tangent_of(normal);
  const Vec3 v = (normal / length).cross(u);
  // An equilateral triangle whose inscribed circle holds every point of the body near the plane.
  const double diagonal = (bounds.hi - bounds.lo).norm();
  const double r = 1.25 * diagonal + 1e-9 * std::min(length, diagonal);
  const double half = 1.75 * r;
  Stroke stroke;
  stroke.name = "plane";
  stroke.times = {0.0, 1.0};
  const Vec3 a = centre - r * v - half * u, b = centre - r * v + half * u, c = centre + 2.0 * r * v;
  stroke.edges = {{a, b}, {a, c}};
  return stroke;
}

SweptTriangles swept_triangles(const Stroke& stroke) {
  SweptTriangles out;
  const auto width = static_cast<std::uint32_t>(stroke.edges.front().size());
  for (const std::vector<Vec3>& edge : stroke.edges) {
    out.points.insert(out.points.end(), edge.begin(), edge.end());
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if ((out.points[b] - out.points[a]).cross(out.points[c] - out.points[a]).norm() > 0) {
      out.triangles.push_back({a, b, c});
    }
  };
  for (std::uint32_t j = 0; j + 1 < stroke.edges.size(); ++j) {
    for (std::uint32_t i = 0; i + 1 < width; ++i) {
      const std::uint32_t p = j * width + i, later = p + width;
      add(p, later + 1, p + 1);
      add(p, later, later + 1);
    }
  }
  return out;
}

}  // namespace v0
}  // namespace incise
