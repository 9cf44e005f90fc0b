// SPDX-License-Identifier: Apache-2.0
#include "cut/surface_index.h"

#include <algorithm>
#include <cmath>

#include "incise/geom/closest.h"
#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {

namespace {

constexpr double kMaxCells = 4e6;
/// A cell is so many mean edges of the surface wide.
constexpr double kCellEdges = 2.0;

Box box_of(const TetMesh& mesh, Side side) {
  const auto v = mesh.vertices(side);
  return {mesh.rest(v[0]).cwiseMin(mesh.rest(v[1])).cwiseMin(mesh.rest(v[2])),
          mesh.rest(v[0]).cwiseMax(mesh.rest(v[1])).cwiseMax(mesh.rest(v[2]))};
}

}  // namespace

void SurfaceIndex::follow(const TetMesh& mesh, const Journal& journal) {
  const bool has_grown_much = entries_.size() > 4 * built_entries_ + 100000;
  const bool is_elsewhere = cursor_.way_to(journal) == JournalCursor::Way::kElsewhere;
  if (!is_built_ || is_elsewhere || has_grown_much) {
    build(mesh);
  } else {
    for (std::size_t i = cursor_.position(); i < journal.position(); ++i) add_changed(mesh, journal.step(i));
  }
  cursor_.move_to(journal);
}

/// The sides that a step may have made boundary, or moved.
void SurfaceIndex::add_changed(const TetMesh& mesh, const Step& step) {
  for (const ProducedTet& tet : step.produced) add(mesh, tet.id);
  for (const OpenedFace& face : step.opened) {
    add(mesh, face.a.tet());
    add(mesh, face.b.tet());
  }
  for (const MovedVertex& vertex : step.moved) {
    if (!mesh.is_live(vertex.id)) continue;
    for (const TetId tet : walker_.star(mesh, vertex.id)) add(mesh, tet);
  }
  if (step.edits.empty()) return;  // maintenance lays sides bare, and gives tets other vertices
  for (const TetImage& tet : step.before.tets) add(mesh, tet.id);
}

void SurfaceIndex::build(const TetMesh& mesh) {
  std::vector<Side> sides;
  double length = 0;
  has_walls_ = false;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) continue;
      sides.emplace_back(tet, s);
      note_wall(mesh.links(tet)[s]);
      const auto v = mesh.vertices(sides.back());
      length += (mesh.rest(v[0]) - mesh.rest(v[1])).norm();
    }
  });
  is_built_ = true;
  entries_.clear();
  heads_.clear();
  free_ = 0;
  built_entries_ = sides.size();
  if (sides.empty()) return;
  bounds_ = rest_bounds(mesh);
  const Vec3 extent = (bounds_.hi - bounds_.lo).cwiseMax(1e-12 * (bounds_.hi - bounds_.lo).norm());
  double size = kCellEdges * length / static_cast<double>(sides.size());
  size = std::max(size, 1e-6 * extent.maxCoeff());
  const auto cells_at = [&](double s) { return (extent.x() / s + 1) * (extent.y() / s + 1) * (extent.z() / s + 1); };
  while (cells_at(size) > kMaxCells) size *= 1.25;
  inverse_size_ = 1.0 / size;
  for (int k = 0; k < 3; ++k) {
    counts_[static_cast<std::size_t>(k)] = std::max(1, static_cast<int>(extent[k] * inverse_size_) + 1);
  }
  heads_.assign(index_of(0, 0, counts_[2]), 0U);
  for (const Side side : sides) {
    for_each_cell(box_of(mesh, side), [&](std::uint32_t& head) { insert(head, side); });
  }
}

void SurfaceIndex::add(const TetMesh& mesh, TetId tet) {
  if (!tet.is_valid() || !mesh.is_live(tet)) return;
  for (unsigned s = 0; s < 4; ++s) {
    const Side side(tet, s);
    if (!mesh.link(side).is_boundary()) continue;
    note_wall(mesh.link(side));
    for_each_cell(box_of(mesh, side), [&](std::uint32_t& head) {
      if (!has(head, side)) insert(head, side);
    });
  }
}

SurfaceIndex::Cell SurfaceIndex::cell_of(const Vec3& point) const {
  Cell cell{};
  for (int k = 0; k < 3; ++k) {
    const double at = (point[k] - bounds_.lo[k]) * inverse_size_;
    const int last = counts_[static_cast<std::size_t>(k)] - 1;
    cell[static_cast<std::size_t>(k)] = at > 0 ? (at < last ? static_cast<int>(at) : last) : 0;
  }
  return cell;
}

TetId SurfaceIndex::nearest_as_it_stands(const TetMesh& mesh, const Vec3& place) const {
  TetId nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Entry& entry : entries_) {
    if (!mesh.is_live(entry.side.tet()) || !mesh.link(entry.side).is_boundary()) continue;
    const auto v = mesh.vertices(entry.side);
    const double distance2 =
        closest_on_triangle(place, mesh.current(v[0]), mesh.current(v[1]), mesh.current(v[2])).distance2;
    if (distance2 < least || (distance2 == least && entry.side.tet() < nearest)) {
      least = distance2;
      nearest = entry.side.tet();
    }
  }
  return nearest;
}

bool SurfaceIndex::meets_as_it_stands(const TetMesh& mesh, std::span<const std::array<SosPoint, 3>> triangles) const {
  Box box;
  for (const auto& triangle : triangles) {
    for (const SosPoint& point : triangle) box.extend(point.position);
  }
  for (const Entry& entry : entries_) {
    if (!mesh.is_live(entry.side.tet()) || !mesh.link(entry.side).is_boundary()) continue;
    std::array<SosPoint, 3> side;
    Box around;
    for (unsigned k = 0; k < 3; ++k) {
      const VertexId v = mesh.vertices(entry.side)[k];
      side[k] = {mesh.current(v), v.value};
      around.extend(side[k].position);
    }
    if (!around.overlaps(box)) continue;
    for (const auto& triangle : triangles) {
      if (triangles_cross(triangle, side)) return true;
    }
  }
  return false;
}

bool SurfaceIndex::is_small(const Box& box) const {
  if (heads_.empty()) return true;
  const Cell lo = cell_of(box.lo), hi = cell_of(box.hi);
  return (hi[0] - lo[0] + 1) * (hi[1] - lo[1] + 1) * (hi[2] - lo[2] + 1) <= 8;
}

/// Steps name a side again and again: without this, lists would grow with the strokes.
bool SurfaceIndex::has(std::uint32_t head, Side side) const {
  while (head != 0 && entries_[head - 1].side != side) head = entries_[head - 1].next;
  return head != 0;
}

void SurfaceIndex::insert(std::uint32_t& head, Side side) {
  if (free_ == 0) {
    entries_.push_back({side, head});
    head = static_cast<std::uint32_t>(entries_.size());
    return;
  }
  const std::uint32_t entry = free_;
  free_ = entries_[entry - 1].next;
  entries_[entry - 1] = {side, head};
  head = entry;
}

}  // namespace v0
}  // namespace incise
