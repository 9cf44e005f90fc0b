// SPDX-License-Identifier: Apache-2.0
// A point stays at the front while tissue around it lies on both sides of the sheet, told by the heights of its star's
// corners over the sheet's plane there; copies of points are points, too (docs/internals.md, 3.12).
#include "paper/incision_front.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "cut/constants.h"
#include "incise/geom/closest.h"
#include "incise/mesh/edge_length.h"
#include "paper/beside_sheet.h"
#include "paper/constants.h"
#include "paper/paper_classes.h"

namespace incise {
inline namespace v0 {

namespace {

using Points = std::vector<CollisionPoint>;

bool is_before(const CollisionPoint& a, const CollisionPoint& b) {
  return a.vertex < b.vertex;
}

bool lives(const TetMesh& mesh, const CollisionPoint& point) {
  return mesh.is_live(point.vertex) && mesh.generation(point.vertex) == point.generation;
}

/// Sorted, each vertex once: the first one given.
void make_set(Points& points) {
  std::stable_sort(points.begin(), points.end(), is_before);
  points.erase(std::unique(points.begin(), points.end(),
                           [](const CollisionPoint& a, const CollisionPoint& b) { return a.vertex == b.vertex; }),
               points.end());
}

double longest_edge_at(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star) {
  double longest2 = 0;
  for (const TetId tet : star) {
    for (const VertexId other : mesh.vertices(tet)) {
      longest2 = std::max(longest2, (mesh.rest(other) - mesh.rest(vertex)).squaredNorm());
    }
  }
  return std::sqrt(longest2);
}

/// The unit normal of a sheet within whose plane a vertex lies, but for `offset` of its mean edge, and near which it
/// is.
std::optional<Vec3> plane_at(const TetMesh& mesh, const Sheet& sheet, VertexId vertex, double offset,
                             StarWalker& walker) {
  const Vec3& place = mesh.rest(vertex);
  const std::vector<TetId>& star = walker.star(mesh, vertex);
  const auto hit = sheet.tree().closest(place, kJoinReach * longest_edge_at(mesh, vertex, star));
  if (!hit.is_valid()) return std::nullopt;
  const Vec3 normal = sheet.normal(hit.triangle).normalized();
  const bool is_in_plane = std::abs(normal.dot(place - hit.point)) < offset * mean_edge_length_at(mesh, vertex, star);
  return is_in_plane ? std::optional(normal) : std::nullopt;
}

double distance_to(std::span<const Strip::Segment> border, const Vec3& place) {
  double least2 = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : border) {
    least2 = std::min(least2, closest_on_triangle(place, from.position, to.position, to.position).distance2);
  }
  return std::sqrt(least2);
}

bool encloses_less(const std::optional<Vec3>& normal, const CollisionPoint& point, double cosine) {
  return normal && std::abs(normal->dot(point.normal)) > cosine;
}

/// Whether a strip passes an earlier sheet's point in its plane.
bool lies_along(const TetMesh& mesh, const SheetSoFar& sheet, const CollisionPoint& point, StarWalker& walker) {
  return encloses_less(plane_at(mesh, sheet.strip(), point.vertex, kJoinOffset, walker), point, kAlongCosine);
}

/// Whether an earlier sheet's point lies on a sheet, as if the two were one: on its strip, or behind a rim from which
/// that goes on.
bool lies_on(const TetMesh& mesh, const SheetSoFar& sheet, const CollisionPoint& point, StarWalker& walker) {
  if (lies_along(mesh, sheet, point, walker)) return true;
  const std::vector<TetId>& star = walker.star(mesh, point.vertex);
  if ((point.rim - mesh.rest(point.vertex)).norm() > kJoinReach * longest_edge_at(mesh, point.vertex, star) ||
      distance_to(sheet.border(), point.rim) > kJoinOffset * mean_edge_length_at(mesh, point.vertex, star)) {
    return false;
  }
  return encloses_less(passing_normal(mesh, sheet.strip(), point.rim, point.vertex, walker), point, kJoinCosine);
}

/// The walls of cuts at a vertex that go along a plane.
struct WallsAlong {
  std::vector<VertexId> corners;            ///< ascending
  std::vector<Vec3> normals;                ///< unit, away from their tets
  bool is_above = false, is_below = false;  ///< some of their tets are, of the plane
};

/// Those that `counts` accepts by their tags.
template <class Counts>
WallsAlong find_walls_along(const TetMesh& mesh, VertexId vertex, const Vec3& normal, StarWalker& walker,
                            Counts&& counts) {
  WallsAlong walls;
  for (const TetId tet : walker.star(mesh, vertex)) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (mesh.vertices(tet)[s] == vertex || !link.is_boundary() || link.tag() == 0 || !counts(link.tag())) continue;
      const auto face = mesh.vertices(Side(tet, s));
      const Vec3 &a = mesh.rest(face[0]), &b = mesh.rest(face[1]), &c = mesh.rest(face[2]);
      const Vec3 outward = (b - a).cross(c - a).normalized();
      const double cosine = outward.dot(normal);
      if (std::abs(cosine) <= kJoinCosine) continue;
      (cosine < 0 ? walls.is_above : walls.is_below) = true;
      walls.corners.insert(walls.corners.end(), face.begin(), face.end());
      walls.normals.push_back(outward);
    }
  }
  std::sort(walls.corners.begin(), walls.corners.end());
  return walls;
}

bool has_wall_along(const TetMesh& mesh, VertexId vertex, const Vec3& normal, StarWalker& walker) {
  const WallsAlong walls = find_walls_along(mesh, vertex, normal, walker, [](std::uint32_t) { return true; });
  return walls.is_above || walls.is_below;
}

/// Whether a wall of an older stroke passes a vertex along a sheet: one of its faces there lies on the sheet, as far as
/// is known, and the stroke itself has opened none there.
bool has_older_wall_on(const TetMesh& mesh, const Sheet& sheet, VertexId vertex, std::uint32_t tag,
                       StarWalker& walker) {
  const auto normal = passing_normal(mesh, sheet, mesh.rest(vertex), vertex, walker);
  if (!normal) return false;
  std::vector<Side> along;
  for (const TetId tet : walker.star(mesh, vertex)) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (mesh.vertices(tet)[s] == vertex || !link.is_boundary() || link.tag() == 0) continue;
      if (link.tag() == tag) return false;
      if (std::abs(paper::area_vector(mesh, {tet, s}).normalized().dot(*normal)) > kAlongCosine)
        along.emplace_back(tet, s);
    }
  }
  return !along.empty() && std::all_of(along.begin(), along.end(), [&](Side side) {
    const auto v = mesh.vertices(side);
    return std::all_of(v.begin(), v.end(), [&](VertexId w) { return may_lie_on(mesh, sheet, w, kWallBend, walker); });
  });
}

/// Whether some tissue of a vertex's star lies above a plane, and some below.
bool has_both_sides(const TetMesh& mesh, VertexId vertex, const Vec3& place, const Vec3& normal, StarWalker& walker) {
  const std::vector<TetId>& star = walker.star(mesh, vertex);
  const double least = kCoincident * mean_edge_length_at(mesh, vertex, star);
  bool is_above = false, is_below = false;
  for (const TetId tet : star) {
    for (const VertexId other : mesh.vertices(tet)) {
      const double height = normal.dot(mesh.rest(other) - place);
      is_above = is_above || height > least;
      is_below = is_below || height < -least;
    }
  }
  return is_above && is_below;
}

/// Whether tissue around a vertex lies on both sides of the sheet there: on the wall of a cut it does not, and nothing
/// is left to be taken apart.
bool has_both_sides(const TetMesh& mesh, VertexId vertex, const Vec3& normal, StarWalker& walker) {
  return has_both_sides(mesh, vertex, mesh.rest(vertex), normal, walker);
}

/// Whether it lies on both sides of a part of the sheet that turns sharply from the one that the vertex is on: beyond a
/// corner of the blade's edge.
bool has_both_sides_beyond_corner(const TetMesh& mesh, const Sheet& sheet, const CollisionPoint& point,
                                  StarWalker& walker) {
  Box reach;
  for (const TetId tet : walker.star(mesh, point.vertex)) {
    for (const VertexId v : mesh.vertices(tet)) reach.extend(mesh.rest(v));
  }
  bool has_both = false;
  sheet.tree().for_each_overlap(reach, [&](std::uint32_t triangle) {
    const Vec3 normal = sheet.normal(triangle).normalized();
    has_both = has_both || (std::abs(normal.dot(point.normal)) < kJoinCosine &&
                            has_both_sides(mesh, point.vertex, sheet.point(triangle, 0).position, normal, walker));
  });
  return has_both;
}

/// Whether tissue around a point lies on both sides of the sheet somewhere.
bool has_both_sides(const TetMesh& mesh, const Sheet& sheet, const CollisionPoint& point, StarWalker& walker) {
  return has_both_sides(mesh, point.vertex, point.normal, walker) ||
         has_both_sides_beyond_corner(mesh, sheet, point, walker);
}

/// Adds the copies of points, which lie on the sheet as well. Returns the vertices that were copied and the copies,
/// ascending.
std::vector<VertexId> add_copies(const TetMesh& mesh, const std::vector<CopiedVertex>& copied, Points& points) {
  std::vector<VertexId> divided;
  Points copies;
  for (const CopiedVertex& copy : copied) {
    const CollisionPoint source{copy.source};
    const auto is_source = [&](const CollisionPoint& point) { return point.vertex == copy.source; };
    auto from = std::lower_bound(points.begin(), points.end(), source, is_before);
    if (from == points.end() || !is_source(*from)) {  // of a copy, perhaps
      from = std::find_if(copies.begin(), copies.end(), is_source);
      if (from == copies.end()) continue;
    }
    copies.push_back({copy.id, mesh.generation(copy.id), from->normal, from->rim, from->is_split, from->sheet});
    divided.insert(divided.end(), {copy.source, copy.id});
  }
  std::sort(divided.begin(), divided.end());
  points.insert(points.end(), copies.begin(), copies.end());
  make_set(points);
  return divided;
}

}  // namespace

void IncisionFront::begin_sheet() {
  older_.insert(older_.end(), own_.begin(), own_.end());
  own_.clear();
  make_set(older_);
  ++sheet_;
}

void IncisionFront::end_sheet(const TetMesh& mesh, std::span<const Strip::Segment> border) {
  for (CollisionPoint& point : own_) {
    point.is_split = false;
    if (!lives(mesh, point)) continue;
    const Vec3& place = mesh.rest(point.vertex);
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : border) {
      const ClosestPoint closest = closest_on_triangle(place, from.position, to.position, to.position);
      if (closest.distance2 < nearest2) {
        nearest2 = closest.distance2;
        point.rim = closest.point;
      }
    }
  }
}

void IncisionFront::mark(const TetMesh& mesh, const SheetSoFar& sheet, std::uint32_t tag, Neighbourhood& near,
                         StarWalker& walker) {
  const auto met = std::stable_partition(older_.begin(), older_.end(), [&](const CollisionPoint& point) {
    return !lives(mesh, point) || !lies_on(mesh, sheet, point, walker);
  });
  note_stroke(tag);
  own_.insert(own_.end(), met, older_.end());
  older_.erase(met, older_.end());
  for (const CollisionPoint& point : own_) {
    if (point.sheet != sheet_ && lies_along(mesh, sheet, point, walker)) unite(point.sheet);
  }
  for (CollisionPoint& point : own_) point.sheet = sheet_;
  adopt_walls(mesh, sheet.strip(), tag, near, walker);
  make_set(own_);
  for (const CollisionPoint& point : own_) {
    if (lives(mesh, point)) near.mark_on(point.vertex);
  }
}

void IncisionFront::adopt_walls(const TetMesh& mesh, const Sheet& sheet, std::uint32_t tag, Neighbourhood& near,
                                StarWalker& walker) {
  std::vector<VertexId> asked;
  for (const NearTet& tet : near.tets) {
    for (const VertexId v : mesh.vertices(tet.id)) {
      if ((mesh.shape_of(v) & shape::kWall) == 0 || near.index_of_vertex[v.value] != 0) continue;
      near.index_of_vertex[v.value] = 1;
      asked.push_back(v);
      if (has_older_wall_on(mesh, sheet, v, tag, walker)) near.mark_on(v);
      const auto normal = plane_at(mesh, sheet, v, kCoincident, walker);
      if (normal && has_wall_along(mesh, v, *normal, walker) && has_both_sides(mesh, v, *normal, walker)) {
        own_.push_back({v, mesh.generation(v), *normal, mesh.rest(v), false, sheet_});
      }
    }
  }
  for (const VertexId v : asked) near.index_of_vertex[v.value] = 0;
}

void IncisionFront::take(const TetMesh& mesh, const Sheet& sheet, const Neighbourhood& near, StarWalker& walker) {
  const auto add = [&](VertexId vertex, std::uint32_t triangle, bool is_split) {
    own_.push_back(
        {vertex, mesh.generation(vertex), sheet.normal(triangle).normalized(), mesh.rest(vertex), is_split, sheet_});
  };
  for (const CutEdge& edge : near.edges.edges()) {
    if (edge.split.is_valid()) add(edge.split, edge.crossings.triangle, true);
  }
  make_set(own_);
  add_splits_of_older(mesh, near);
  const std::size_t known = own_.size();
  for (const VertexId v : near.on) {
    if (std::binary_search(own_.begin(), own_.begin() + static_cast<std::ptrdiff_t>(known), CollisionPoint{v},
                           is_before)) {
      continue;
    }
    const auto hit = sheet.tree().closest(mesh.rest(v), near.coincidence);
    if (hit.is_valid() && has_both_sides(mesh, v, sheet.normal(hit.triangle).normalized(), walker)) {
      add(v, hit.triangle, false);
    }
  }
  make_set(own_);
}

void IncisionFront::add_splits_of_older(const TetMesh& mesh, const Neighbourhood& near) {
  const auto find = [&](VertexId v) -> const CollisionPoint* {
    const auto at = std::lower_bound(older_.begin(), older_.end(), CollisionPoint{v}, is_before);
    return at != older_.end() && at->vertex == v ? &*at : nullptr;
  };
  Points splits;
  for (const CutEdge& edge : near.edges.edges()) {
    if (!edge.split.is_valid()) continue;
    const CollisionPoint *a = find(edge.a), *b = find(edge.b);
    if (a == nullptr || b == nullptr) continue;
    const CollisionPoint& nearer = edge.t < 0.5 ? *a : *b;
    splits.push_back({edge.split, mesh.generation(edge.split), nearer.normal, a->rim + edge.t * (b->rim - a->rim),
                      false, nearer.sheet});
  }
  older_.insert(older_.end(), splits.begin(), splits.end());
  make_set(older_);
}

void IncisionFront::follow(const TetMesh& mesh, const Sheet& sheet, const Step& step, StarWalker& walker) {
  for (Points* points : {&own_, &older_}) {
    const std::vector<VertexId> divided = add_copies(mesh, step.copied, *points);
    std::erase_if(*points, [&](const CollisionPoint& point) {
      const bool is_divided = std::binary_search(divided.begin(), divided.end(), point.vertex);
      return !lives(mesh, point) || (is_divided && !has_both_sides(mesh, sheet, point, walker));
    });
  }
}

void IncisionFront::add(const TetMesh& mesh, const Sheet& sheet, const std::vector<VertexId>& vertices,
                        StarWalker& walker) {
  for (const VertexId v : vertices) {
    const auto hit = sheet.tree().closest(mesh.rest(v), longest_edge_at(mesh, v, walker.star(mesh, v)));
    if (!hit.is_valid()) continue;
    const CollisionPoint point{v,     mesh.generation(v), sheet.normal(hit.triangle).normalized(), mesh.rest(v), false,
                               sheet_};
    if (has_both_sides(mesh, sheet, point, walker)) own_.push_back(point);
  }
  make_set(own_);
}

void IncisionFront::renew(const TetMesh& mesh) {
  for (Points* points : {&own_, &older_}) {
    std::erase_if(*points, [&](const CollisionPoint& point) { return !mesh.is_live(point.vertex); });
    for (CollisionPoint& point : *points) point.generation = mesh.generation(point.vertex);
  }
}

void IncisionFront::clear() {
  own_.clear();
  older_.clear();
  sheet_of_.clear();
}

void IncisionFront::unite(std::uint32_t sheet) {
  for (auto& [tag, of] : sheet_of_) {
    if (of == sheet) of = sheet_;
  }
  for (Points* points : {&own_, &older_}) {
    for (CollisionPoint& point : *points) {
      if (point.sheet == sheet) point.sheet = sheet_;
    }
  }
}

void IncisionFront::note_stroke(std::uint32_t tag) {
  const auto at = std::lower_bound(sheet_of_.begin(), sheet_of_.end(), std::pair(tag, 0U));
  if (at != sheet_of_.end() && at->first == tag) {
    at->second = sheet_;
  } else {
    sheet_of_.insert(at, {tag, sheet_});
  }
}

std::optional<std::uint32_t> IncisionFront::sheet_of(std::uint32_t tag) const {
  const auto at = std::lower_bound(sheet_of_.begin(), sheet_of_.end(), std::pair(tag, 0U));
  return at != sheet_of_.end() && at->first == tag ? std::optional(at->second) : std::nullopt;
}

bool IncisionFront::is_of_sheet(std::uint32_t tag) const {
  return sheet_of(tag) == sheet_;
}

bool IncisionFront::is_foreign(std::uint32_t tag, const CollisionPoint& point) const {
  const std::optional<std::uint32_t> sheet = sheet_of(tag);
  return sheet && *sheet != point.sheet;
}

/// Whether tissue joins both sides of the sheet at a point: no lip of the incision is there, or both are, as at its
/// border, or tissue besides the one that is lies well behind all of it. The lips of a curved sheet leave its planes,
/// and so does what lies close behind them.
bool IncisionFront::is_joined(const TetMesh& mesh, const CollisionPoint& point, StarWalker& walker) const {
  const WallsAlong walls = find_walls_along(mesh, point.vertex, point.normal, walker,
                                            [&](std::uint32_t tag) { return !is_foreign(tag, point); });
  if (walls.is_above == walls.is_below) return true;
  const Vec3& place = mesh.rest(point.vertex);
  const std::vector<TetId>& star = walker.star(mesh, point.vertex);
  const double least = kJoinOffset * mean_edge_length_at(mesh, point.vertex, star);
  const auto is_behind = [&](VertexId corner) {
    const Vec3 way = mesh.rest(corner) - place;
    return !std::binary_search(walls.corners.begin(), walls.corners.end(), corner) &&
           std::all_of(walls.normals.begin(), walls.normals.end(), [&](const Vec3& n) { return n.dot(way) > least; });
  };
  return std::any_of(star.begin(), star.end(), [&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    return std::any_of(v.begin(), v.end(), is_behind);
  });
}

void IncisionFront::leave_lips(const TetMesh& mesh, StarWalker& walker) {
  for (Points* points : {&own_, &older_}) {
    std::erase_if(*points,
                  [&](const CollisionPoint& point) { return !lives(mesh, point) || !is_joined(mesh, point, walker); });
  }
}

std::vector<VertexId> IncisionFront::vertices(const TetMesh& mesh) const {
  std::vector<VertexId> vertices;
  for (const Points* points : {&own_, &older_}) {
    for (const CollisionPoint& point : *points) {
      if (lives(mesh, point)) vertices.push_back(point.vertex);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace v0
}  // namespace incise
