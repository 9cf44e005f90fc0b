// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/drawn_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "incise/mesh/edge_length.h"
#include "mesh/near_tets.h"
#include "mesh/tet_grid.h"
#include "mesh/turned_normals.h"

namespace incise {
inline namespace v0 {
namespace {

/// How far the rim of a wall is drawn to the fine surface, in distances of the surface from the mesh, plus in mean
/// edges.
constexpr double kDistances = 2, kEdges = 0.25;
/// Twice the area of a triangle below which it fills no gap, by its longest edge squared.
constexpr double kLeastGap = 1e-6;

/// Share of the way to the middles of its triangles at which it is asked what a point hung on.
constexpr double kInwards = 1e-2;

constexpr std::uint8_t kContour = shape::kSkin | shape::kWall;

bool is_contour(const TetMesh& mesh, VertexId v) {
  return (mesh.shape_of(v) & kContour) == kContour;
}

/// The axis that a triangle at rest faces along most.
std::size_t facing(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a).cwiseAbs();
  Eigen::Index axis = 0;
  normal.maxCoeff(&axis);
  return static_cast<std::size_t>(axis);
}

class Drawing {
 public:
  Drawing(const EmbeddedSurface& surface, const TetMesh& mesh)
      : surface_(surface),
        mesh_(mesh),
        reach_(kDistances * surface.greatest_distance() + kEdges * mean_edge_length(mesh)) {}

  DrawnSurface run() && {
    add_skin();
    add_walls();
    add_rims();
    drawn_.version = surface_.version();
    return std::move(drawn_);
  }

 private:
  void add_skin() {
    std::vector<std::uint32_t> numbers(surface_.points().size(), kInvalidIndex);
    for (const FineTriangle& triangle : surface_.triangles()) {
      if (!triangle.is_live()) continue;
      const auto& [a, b, c] = triangle.points;
      if (a == b) continue;
      auto& drawn = drawn_.skin.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        std::uint32_t& number = numbers[triangle.points[i]];
        if (number == kInvalidIndex) {
          number = static_cast<std::uint32_t>(drawn_.points.size());
          const FinePoint& point = surface_.points()[triangle.points[i]];
          drawn_.points.push_back({point.rest, point.binding, point.texture, point.normal});
        }
        drawn[i] = number;
      }
    }
    drawn_.skin_points = drawn_.points.size();
  }

  void add_walls() {
    mesh_.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.link(Side(tet, s));
        if (!link.is_boundary() || link.tag() == 0) continue;
        const auto v = mesh_.vertices(Side(tet, s));
        const std::size_t axis = facing(mesh_.rest(v[0]), mesh_.rest(v[1]), mesh_.rest(v[2]));
        for (const VertexId vertex : v) strokes_[vertex.value] = link.tag();
        drawn_.walls.push_back({wall_point(v[0], axis), wall_point(v[1], axis), wall_point(v[2], axis)});
        drawn_.wall_strokes.push_back(link.tag());
      }
    });
  }

  /// Between the rim of the fine surface and that of the walls.
  void add_rims() {
    for (const FineTriangle& triangle : surface_.triangles()) {
      if (!triangle.is_live() || triangle.lips == 0) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        if ((triangle.lips >> i & 1U) != 0) add_rim(triangle.points[(i + 1) % 3], triangle.points[i]);
      }
    }
  }

  /// `from` to `to` is the rim as the wall has it.
  void add_rim(std::uint32_t from, std::uint32_t to) {
    const FinePoint &p = surface_.points()[from], &q = surface_.points()[to];
    const VertexId at_p = rim_vertex(p.binding), at_q = rim_vertex(q.binding);
    if (at_p.is_valid()) add_rim_triangle(from, to, at_p, p.rest, q.rest);
    if (!at_p.is_valid() || !at_q.is_valid() || at_p == at_q) return;
    if (mesh_.corner_of(p.binding.tet, at_q) == 4 && mesh_.corner_of(q.binding.tet, at_p) == 4) return;
    const Vec3 &a = place_of(at_q).rest, &b = place_of(at_p).rest;
    if (is_flat(q.rest, a, b)) return;
    const std::size_t axis = facing(q.rest, a, b);
    drawn_.walls.push_back({rim_point(to, axis), wall_point(at_q, axis), wall_point(at_p, axis)});
    drawn_.wall_strokes.push_back(strokes_[at_q.value]);
    ++drawn_.rim_triangles;
  }

  void add_rim_triangle(std::uint32_t from, std::uint32_t to, VertexId vertex, const Vec3& p, const Vec3& q) {
    const Vec3& corner = place_of(vertex).rest;
    if (is_flat(p, q, corner)) return;
    const std::size_t axis = facing(p, q, corner);
    drawn_.walls.push_back({rim_point(from, axis), rim_point(to, axis), wall_point(vertex, axis)});
    drawn_.wall_strokes.push_back(strokes_[vertex.value]);
    ++drawn_.rim_triangles;
  }

  static bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return !((b - a).cross(c - a).norm() > kLeastGap * longest);
  }

  /// The vertex of the wall's rim that a point of the fine rim is nearest to, by its tet.
  [[nodiscard]] VertexId rim_vertex(const Binding& binding) const {
    VertexId best;
    double most = 0;
    for (unsigned c = 0; c < 4; ++c) {
      const VertexId v = mesh_.vertices(binding.tet)[c];
      if (!is_contour(mesh_, v) || !(binding.weights[c] > most)) continue;
      most = binding.weights[c];
      best = v;
    }
    return best;
  }

  /// Where a vertex of a wall is drawn.
  const DrawnPoint& place_of(VertexId v) {
    const auto [found, is_new] = places_.try_emplace(v.value);
    DrawnPoint& point = found->second;
    if (!is_new) return point;
    point.rest = mesh_.rest(v);
    if (is_contour(mesh_, v)) point.rest = surface_.find_nearest(point.rest, reach_).value_or(point.rest);
    point.binding = bind_to(mesh_, mesh_.tet_of(v), point.rest);
    return point;
  }

  std::uint32_t wall_point(VertexId v, std::size_t axis) { return point_with(0, v.value, axis, place_of(v)); }
  std::uint32_t rim_point(std::uint32_t slot, std::size_t axis) {
    const FinePoint& point = surface_.points()[slot];
    return point_with(1, slot, axis, {point.rest, point.binding, {}, Vec3::Zero()});
  }
  std::uint32_t point_with(unsigned kind, std::uint32_t slot, std::size_t axis, const DrawnPoint& point) {
    const auto [found, is_new] =
        numbers_.try_emplace({kind, slot, axis}, static_cast<std::uint32_t>(drawn_.points.size()));
    if (is_new) {
      drawn_.points.push_back(point);
      const auto at = [&](std::size_t k) { return point.rest[static_cast<Eigen::Index>(k % 3)]; };
      drawn_.points.back().texture = {at(axis + 1), at(axis + 2)};
    }
    return found->second;
  }

  const EmbeddedSurface& surface_;
  const TetMesh& mesh_;
  double reach_;
  DrawnSurface drawn_;
  std::map<std::uint32_t, DrawnPoint> places_;      // of vertices of walls
  std::map<std::uint32_t, std::uint32_t> strokes_;  // likewise: of one of their walls
  std::map<std::tuple<unsigned, std::uint32_t, std::size_t>, std::uint32_t> numbers_;
};

}  // namespace

DrawnSurface draw(const EmbeddedSurface& surface, const TetMesh& mesh) {
  return Drawing(surface, mesh).run();
}

void fill(const DrawnSurface& drawn, const TetMesh& mesh, std::vector<Vec3>& positions, std::vector<Vec3>& normals) {
  const std::size_t count = drawn.points.size();
  positions.resize(count);
  for (std::size_t i = 0; i < count; ++i) positions[i] = current_place(mesh, drawn.points[i].binding);
  std::vector<Vec3> at_rest(count, Vec3::Zero()), now(count, Vec3::Zero());
  for (const auto* triangles : {&drawn.skin, &drawn.walls}) {
    for (const auto& [a, b, c] : *triangles) {
      const Vec3 &p = drawn.points[a].rest, &q = drawn.points[b].rest, &r = drawn.points[c].rest;
      const Vec3 rest = (q - p).cross(r - p);
      const Vec3 current = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
      for (const std::uint32_t i : {a, b, c}) {
        at_rest[i] += rest;
        now[i] += current;
      }
    }
  }
  normals.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_wall = i >= drawn.skin_points;
    const double length = now[i].norm();
    if (is_wall) normals[i] = length > 0 ? Vec3(now[i] / length) : Vec3(Vec3::UnitZ());
    if (!is_wall) normals[i] = turned_with(drawn.points[i].normal, at_rest[i], now[i]);
  }
}

std::vector<Vec3> earlier_places(const DrawnSurface& drawn, const TetMesh& mesh) {
  std::vector<Vec3> middles(drawn.points.size(), Vec3::Zero());  // sums over the triangles at each point
  std::vector<double> counts(drawn.points.size(), 0);
  Box box;
  double reach = 0;
  for (const auto* triangles : {&drawn.skin, &drawn.walls}) {
    for (const auto& triangle : *triangles) {
      Vec3 middle = Vec3::Zero();
      for (const std::uint32_t i : triangle) middle += drawn.points[i].rest / 3;
      for (const std::uint32_t i : triangle) {
        middles[i] += middle;
        counts[i] += 1;
      }
    }
  }
  for (const DrawnPoint& point : drawn.points) {
    box.extend(point.rest);
    reach = std::max(reach, point.binding.offset.norm());
  }
  reach += kEdges * mean_edge_length(mesh);
  const TetGrid grid(mesh);
  NearTets near((box.hi - box.lo).norm());
  std::vector<Vec3> places(drawn.points.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3& rest = drawn.points[i].rest;
    const Vec3 inwards = counts[i] > 0 ? Vec3(rest + kInwards * (middles[i] / counts[i] - rest)) : rest;
    Box around;
    around.extend(inwards);
    near.gather(mesh, grid, around, reach);
    places[i] = current_place(mesh, bind_to(mesh, near.locate(inwards), rest));
  }
  return places;
}

}  // namespace v0
}  // namespace incise
