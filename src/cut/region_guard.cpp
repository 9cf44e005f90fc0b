// SPDX-License-Identifier: Apache-2.0
// The regions' surface near the blade tells outside from inside; along the edge it is asked in small steps, and where
// the edge would enter is found by halving. Sweeps between poses are laid in rows, so that no region is jumped over.
#include "incise/cut/region_guard.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "cut/blade_constants.h"
#include "incise/geom/box.h"
#include "incise/geom/triangle_tree.h"

namespace incise {
inline namespace v0 {
namespace {

bool is_among(const std::vector<std::int32_t>& regions, std::int32_t region) {
  return std::find(regions.begin(), regions.end(), region) != regions.end();
}

/// Calls back for each side of a tet of the regions that no other tet of theirs has.
template <class Visit>
void for_each_side(const TetMesh& mesh, const std::vector<std::int32_t>& regions, const Visit& visit) {
  mesh.for_each_tet([&](TetId tet) {
    if (!is_among(regions, mesh.region(tet))) return;
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (link.is_boundary() || !is_among(regions, mesh.region(link.side().tet()))) visit(Side(tet, s));
    }
  });
}

/// The mean edge of the regions' surface; 0 where there is none.
double mean_edge(const TetMesh& mesh, const std::vector<std::int32_t>& regions) {
  double sum = 0, n = 0;
  for_each_side(mesh, regions, [&](Side side) {
    const auto v = mesh.vertices(side);
    for (std::size_t i = 0; i < 3; ++i) sum += (mesh.rest(v[i]) - mesh.rest(v[(i + 1) % 3])).norm();
    n += 3;
  });
  return n > 0 ? sum / n : 0;
}

}  // namespace

/// The surface of the regions near the blade, which tells inside from outside.
class RegionGuard::Surface {
 public:
  Surface(const TetMesh& mesh, const std::vector<std::int32_t>& regions, Shape shape, const Box& near) {
    std::vector<std::uint32_t> number(mesh.vertex_slots(), kInvalidIndex);
    for_each_side(mesh, regions, [&](Side side) {
      const auto v = mesh.vertices(side);
      std::array<Vec3, 3> p;
      Box box;
      for (std::size_t i = 0; i < 3; ++i) {
        p[i] = shape == Shape::kRest ? mesh.rest(v[i]) : mesh.current(v[i]);
        box.extend(p[i]);
      }
      if (!box.overlaps(near)) return;
      const Vec3 area = (p[1] - p[0]).cross(p[2] - p[0]);
      auto& triangle = triangles_.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        std::uint32_t& n = number[v[i].value];
        if (n == kInvalidIndex) {
          n = static_cast<std::uint32_t>(points_.size());
          points_.push_back(p[i]);
          normals_.push_back(Vec3::Zero());
        }
        triangle[i] = n;
        normals_[n] += area;
      }
    });
    tree_ = TriangleTree(points_, triangles_);
  }

  /// Where a point goes that must keep a margin: the point itself where it does. Looks no further than `reach`.
  [[nodiscard]] Vec3 put_out(const Vec3& point, double margin, double reach) const {
    const TriangleTree::Hit hit = tree_.closest(point, reach);
    if (!hit.is_valid()) return point;
    const Vec3 out = normal_at(hit);
    const double distance = std::sqrt(hit.distance2), side = out.dot(point - hit.point);
    return side >= 0 && distance >= margin ? point : Vec3(hit.point + margin * out);
  }

 private:
  /// Outwards, of length 1: that of the corners, by how near they are.
  [[nodiscard]] Vec3 normal_at(const TriangleTree::Hit& hit) const {
    const auto& t = triangles_[hit.triangle];
    const Vec3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    const Vec3 face = (b - a).cross(c - a);
    Vec3 sum = Vec3::Zero();
    const std::array<Vec3, 3> from = {b, c, a}, to = {c, a, b};
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = std::max(0.0, (from[i] - hit.point).cross(to[i] - hit.point).dot(face));
      const double length = normals_[t[i]].norm();
      if (length > 0) sum += share / length * normals_[t[i]];
    }
    if (!(sum.norm() > 0)) sum = face;
    return sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3(Vec3::UnitZ());
  }

  std::vector<Vec3> points_, normals_;
  std::vector<TriangleTree::Triangle> triangles_;
  TriangleTree tree_;
};

std::vector<Vec3> RegionGuard::divided(std::span<const Vec3> edge) const {
  std::vector<Vec3> points;
  for (const Place& place : places_) {
    const Vec3 &a = edge[place.segment], &b = edge[place.segment + std::size_t{1}];
    points.push_back(place.share == 0 ? a : (place.share == 1 ? b : Vec3(a + place.share * (b - a))));
  }
  return points;
}

Result<std::vector<Vec3>> RegionGuard::begin(const TetMesh& mesh, std::span<const Vec3> edge) {
  if (edge.size() < 2) return Error{ErrorCode::kBadArgument, "the blade's edge must have at least 2 points"};
  spacing_ = mean_edge(mesh, regions_);
  places_.clear();
  points_.clear();
  for (std::uint32_t s = 0; s + 1 < edge.size(); ++s) {
    const double parts = spacing_ > 0 ? (edge[s + 1] - edge[s]).norm() / (kGuardPoints * spacing_) : 1;
    const double most = static_cast<double>(std::max<std::size_t>(1, kMostGuardPoints / edge.size()));
    const double count = std::clamp(std::ceil(parts), 1.0, most);
    for (double k = 0; k < count; k += 1) places_.push_back({s, k / count});
  }
  places_.push_back({static_cast<std::uint32_t>(edge.size() - 2), 1});
  std::vector<Vec3> points = divided(edge);
  Box near;
  for (const Vec3& p : points) near.extend(p);
  near.lo -= Vec3::Constant(kGuardAround * spacing_);
  near.hi += Vec3::Constant(kGuardAround * spacing_);
  const Surface surface(mesh, regions_, shape_, near);
  for (std::size_t i = 0; i < points.size() && spacing_ > 0; ++i) {
    if (i == 0 ? is_out(surface, points[0]) : is_clear(surface, points[i - 1], points[i])) continue;
    return Error{ErrorCode::kBadArgument,
                 "the blade begins in, or close to, a region that it shall not enter; begin it outside"};
  }
  points_ = goals_ = points;
  end_ = End::kEither;
  stands_ = false;
  return points;
}

RegionGuard::Surface RegionGuard::surface_near(const TetMesh& mesh, const std::vector<Vec3>& goals) const {
  Box near;
  for (const std::vector<Vec3>* points : {&goals, &goals_, &points_}) {
    for (const Vec3& p : *points) near.extend(p);
  }
  near.lo -= Vec3::Constant(kGuardAround * spacing_);
  near.hi += Vec3::Constant(kGuardAround * spacing_);
  return {mesh, regions_, shape_, near};
}

bool RegionGuard::is_out(const Surface& surface, const Vec3& point) const {
  return surface.put_out(point, kGuardMargin * spacing_, kGuardAround * spacing_) == point;
}

/// Whether all of the edge between two points is outside; the first is.
bool RegionGuard::is_clear(const Surface& surface, const Vec3& a, const Vec3& b) const {
  const double parts = std::ceil((b - a).norm() / (kGuardSample * spacing_));
  for (double k = 1; k < parts; k += 1) {
    if (!is_out(surface, a + k / parts * (b - a))) return false;
  }
  return is_out(surface, b);
}

/// How far towards `b` the edge from `a`, which is outside, may reach.
Vec3 RegionGuard::reach(const Surface& surface, const Vec3& a, const Vec3& b) const {
  double clear = 0, blocked = 1;
  for (int i = 0; i < kGuardHalvings; ++i) {
    const double half = 0.5 * (clear + blocked);
    (is_clear(surface, a, a + half * (b - a)) ? clear : blocked) = half;
  }
  return a + clear * (b - a);
}

/// The edge up to where it would enter, seen from one of its ends; what lies beyond is put there. Nothing where that
/// end itself may not be where it is.
std::vector<Vec3> RegionGuard::shortened(const Surface& surface, std::vector<Vec3> edge, bool from_back) const {
  if (from_back) std::reverse(edge.begin(), edge.end());
  if (!is_out(surface, edge.front())) return {};
  std::size_t i = 1;
  while (i < edge.size() && is_clear(surface, edge[i - 1], edge[i])) ++i;
  if (i < edge.size()) {
    const Vec3 end = reach(surface, edge[i - 1], edge[i]);
    std::fill(edge.begin() + static_cast<std::ptrdiff_t>(i), edge.end(), end);
  }
  if (from_back) std::reverse(edge.begin(), edge.end());
  return edge;
}

double RegionGuard::length(const std::vector<Vec3>& edge) {
  double sum = 0;
  for (std::size_t i = 1; i < edge.size(); ++i) sum += (edge[i] - edge[i - 1]).norm();
  return sum;
}

/// Where the edge goes that is wanted at `goals`: there, shortened, or nowhere. `goals` are near those before.
void RegionGuard::step(const Surface& surface, const std::vector<Vec3>& goals) {
  goals_ = goals;
  std::vector<Vec3> front = end_ == End::kBack ? std::vector<Vec3>() : shortened(surface, goals, false);
  const std::vector<Vec3> back = end_ == End::kFront ? std::vector<Vec3>() : shortened(surface, goals, true);
  const bool is_back = length(back) > length(front);
  const std::vector<Vec3>& next = is_back ? back : front;
  const bool is_pressed_flat = next.empty() || length(next) < kLeastLeft * length(points_);
  if (is_pressed_flat || (stands_ && !is_way_clear(surface, next))) {
    stands_ = true;
    return;
  }
  stands_ = false;
  // Once shortened, an edge is held by the same end until all of it is free.
  end_ = next == goals ? End::kEither : (is_back ? End::kBack : End::kFront);
  points_ = next;
}

/// Whether the edge can go on from where it has stood still: the blade may have gone round a region, or through.
bool RegionGuard::is_way_clear(const Surface& surface, const std::vector<Vec3>& next) const {
  double way = 0;
  for (std::size_t i = 0; i < next.size(); ++i) way = std::max(way, (next[i] - points_[i]).norm());
  const double parts = std::ceil(way / (kGuardRow * spacing_));
  for (double k = 1; k < parts; k += 1) {
    Vec3 before = points_[0] + k / parts * (next[0] - points_[0]);
    if (!is_out(surface, before)) return false;
    for (std::size_t i = 1; i < next.size(); ++i) {
      const Vec3 p = points_[i] + k / parts * (next[i] - points_[i]);
      if (!is_clear(surface, before, p)) return false;
      before = p;
    }
  }
  return true;
}

std::vector<Vec3> RegionGuard::move(const TetMesh& mesh, std::span<const Vec3> edge) {
  const std::vector<Vec3> goals = divided(edge);
  if (!(spacing_ > 0)) return points_ = goals_ = goals;
  const Surface surface = surface_near(mesh, goals);
  const std::vector<Vec3> from = goals_;
  double way = 0;
  for (std::size_t i = 0; i < goals.size(); ++i) way = std::max(way, (goals[i] - from[i]).norm());
  const double parts = std::clamp(std::ceil(way / (kGuardRow * spacing_)), 1.0, kMostGuardRows);
  for (double k = 1; k <= parts; k += 1) {
    std::vector<Vec3> between = goals;
    for (std::size_t i = 0; i < goals.size() && k < parts; ++i) between[i] = from[i] + k / parts * (goals[i] - from[i]);
    step(surface, between);
  }
  return points_;
}

Result<Stroke> hold_outside(const TetMesh& mesh, const Stroke& stroke, const std::vector<std::int32_t>& regions) {
  if (Status status = check(stroke); !status.ok()) return status.error();
  RegionGuard guard(regions, RegionGuard::Shape::kRest);
  Result<std::vector<Vec3>> first = guard.begin(mesh, stroke.edges.front());
  if (!first.ok()) {
    const std::string name = stroke.name.empty() ? "" : "stroke \"" + stroke.name + "\": ";
    return Error{first.error().code, name + first.error().message};
  }
  const double row = kGuardRow * mean_edge(mesh, regions);
  if (!(row > 0)) return stroke;
  Stroke held;
  held.name = stroke.name;
  held.times.push_back(stroke.times.front());
  held.edges.push_back(std::move(first).value());
  for (std::size_t k = 1; k < stroke.times.size(); ++k) {
    const std::vector<Vec3>&from = stroke.edges[k - 1], &to = stroke.edges[k];
    double way = 0;
    for (std::size_t i = 0; i < from.size(); ++i) way = std::max(way, (to[i] - from[i]).norm());
    const double rows = std::clamp(std::ceil(way / row), 1.0, kMostGuardRows);
    const std::size_t before = held.times.size();
    bool is_held = guard.holds();
    for (double r = 1; r <= rows; r += 1) {
      std::vector<Vec3> edge = to;
      for (std::size_t i = 0; i < from.size() && r < rows; ++i) edge[i] = from[i] + r / rows * (to[i] - from[i]);
      held.edges.push_back(guard.move(mesh, edge));
      held.times.push_back(r < rows ? stroke.times[k - 1] + r / rows * (stroke.times[k] - stroke.times[k - 1])
                                    : stroke.times[k]);
      is_held = is_held || guard.holds();
    }
    if (is_held) continue;  // else one step does, as it was
    held.times.erase(held.times.begin() + static_cast<std::ptrdiff_t>(before), held.times.end() - 1);
    held.edges.erase(held.edges.begin() + static_cast<std::ptrdiff_t>(before), held.edges.end() - 1);
  }
  return held;
}

}  // namespace v0
}  // namespace incise
