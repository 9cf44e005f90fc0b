// SPDX-License-Identifier: Apache-2.0
// Each cell heads a linked list of sides, and sides that are gone stay in it and are passed over; the grid is built
// anew once it lists several times as many as at first (docs/internals.md, 3.2).
#include "cut/surface_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cut/constants.h"
#include "incise/geom/closest.h"
#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {

namespace {

Box box_of(const TetMesh& mesh, Side side) {
  const auto v = mesh.vertices(side);
  return {mesh.rest(v[0]).cwiseMin(mesh.rest(v[1])).cwiseMin(mesh.rest(v[2])),
          mesh.rest(v[0]).cwiseMax(mesh.rest(v[1])).cwiseMax(mesh.rest(v[2]))};
}

}  // namespace

bool SurfaceIndex::must_build(const Journal& journal) const {
  const bool has_grown_much = entries_.size() > kGrown * built_entries_ + kGrownBy;
  const bool can_walk = cursor_.can_walk_to(journal) && journal.position() >= built_at_;
  return !is_built_ || !can_walk || has_grown_much;
}

/// Over steps that were undone: what they took away is back.
void SurfaceIndex::go_back(const TetMesh& mesh, const Journal& journal) {
  looks_at_ = journal.position();
  if (looks_at_ < walls_since_) walls_since_ = kNever;
  for (std::size_t i = cursor_.position(); i-- > looks_at_;) add_restored(mesh, journal.step(i));
}

void SurfaceIndex::add_restored(const TetMesh& mesh, const Step& step) {
  step.for_each_tet_before([&](TetId tet) { add(mesh, tet); });
  add_around(mesh, step.moved);
}

void SurfaceIndex::add_around(const TetMesh& mesh, std::span<const MovedVertex> moved) {
  for (const MovedVertex& vertex : moved) {
    if (!mesh.is_live(vertex.id)) continue;
    for (const TetId tet : walker_.star(mesh, vertex.id)) add(mesh, tet);
  }
}

/// The sides that a step may have made boundary, or moved.
void SurfaceIndex::add_changed(const TetMesh& mesh, const Step& step) {
  for (const ProducedTet& tet : step.produced) add(mesh, tet.id);
  for (const OpenedFace& face : step.opened) {
    add(mesh, face.a.tet());
    add(mesh, face.b.tet());
  }
  add_around(mesh, step.moved);
  if (step.edits.empty()) return;  // maintenance lays sides bare, and gives tets other vertices
  step.for_each_tet_before([&](TetId tet) { add(mesh, tet); });
}

void SurfaceIndex::build(const TetMesh& mesh) {
  std::vector<Side> sides;
  double length = 0;
  looks_at_ = built_at_;
  walls_since_ = kNever;
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
  for (const Side side : waiting_) waits_[slot_of(side)] = 0;
  waiting_.clear();
  listed_ = {};
  heads_.clear();
  free_ = 0;
  built_entries_ = sides.size();
  if (sides.empty()) return;
  bounds_ = rest_bounds(mesh);
  const Vec3 extent = (bounds_.hi - bounds_.lo).cwiseMax(1e-12 * (bounds_.hi - bounds_.lo).norm());
  double size = kCellEdges * length / static_cast<double>(sides.size());
  size = std::max(size, 1e-6 * extent.maxCoeff());
  const auto cells_at = [&](double s) { return (extent.x() / s + 1) * (extent.y() / s + 1) * (extent.z() / s + 1); };
  while (cells_at(size) > kMostIndexCells || extent.maxCoeff() / size > kMostIndexAlong) size *= 1.25;
  inverse_size_ = size > 0 ? 1.0 / size : 0.0;  // where all points coincide there is one cell
  for (int k = 0; k < 3; ++k) {
    counts_[static_cast<std::size_t>(k)] = static_cast<std::uint16_t>(extent[k] * inverse_size_ + 1);
  }
  heads_.assign(std::size_t{counts_[0]} * counts_[1] * counts_[2], 0U);
  for (const Side side : sides) {
    for_each_cell(cells_of(box_of(mesh, side)), [&](std::uint32_t& head, const Cell& /*cell*/) { insert(head, side); });
  }
}

void SurfaceIndex::add(const TetMesh& mesh, TetId tet) {
  if (!tet.is_valid() || !mesh.is_live(tet)) return;
  looked_at_.ensure(std::size_t{tet.value} + 1);
  if (std::exchange(looked_at_[tet.value], call_) == call_) return;
  for (unsigned s = 0; s < 4; ++s) {
    const Link link = mesh.links(tet)[s];
    if (!link.is_boundary()) continue;
    note_wall(link);
    found_.emplace_back(tet, s);
  }
}

void SurfaceIndex::list_new(const TetMesh& mesh, Side side) {
  listed_.ensure(slot_of(side) + 1);
  list(side, box_of(mesh, side));
}

/// Steps name a side again and again: cells that have it already are passed over, or lists would grow with the strokes.
void SurfaceIndex::list(Side side, const Box& box) {
  const CellRange cells = cells_of(box);
  CellRange& listed = listed_[slot_of(side)];
  if (listed.is(cells)) return;
  for_each_cell(cells, [&](std::uint32_t& head, const Cell& cell) {
    if (!listed.has(cell)) insert(head, side);
  });
  listed = cells;
}

SurfaceIndex::Cell SurfaceIndex::cell_of(const Vec3& point) const {
  Cell cell{};
  for (int k = 0; k < 3; ++k) {
    const double at = (point[k] - bounds_.lo[k]) * inverse_size_;
    const std::uint16_t last = counts_[static_cast<std::size_t>(k)];
    cell[static_cast<std::size_t>(k)] = at > 0 ? (at < last ? static_cast<std::uint16_t>(at + 1) : last) : 1;
  }
  return cell;
}

/// Where what is listed in a cell may lie: what is beyond the grid is listed in its outermost cells.
Box SurfaceIndex::room_of(const Cell& cell) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box room;
  for (int k = 0; k < 3; ++k) {
    const std::uint16_t at = cell[static_cast<std::size_t>(k)], last = counts_[static_cast<std::size_t>(k)];
    room.lo[k] = at == 1 ? -kFar : bounds_.lo[k] + (at - 1) / inverse_size_;
    room.hi[k] = at == last ? kFar : bounds_.lo[k] + at / inverse_size_;
  }
  return room;
}

/// Cell by cell outwards. A side lies in all cells that it is listed in, so that cells which lie further away than the
/// nearest so far need no look; next to their bounds rounding decides, which a margin makes up for.
SurfaceIndex::Nearest SurfaceIndex::nearest(const TetMesh& mesh, const Vec3& place, double most) const {
  Nearest best;
  if (heads_.empty()) return best;
  const double size = 1.0 / inverse_size_, margin = kCellRounding * (size + place.cwiseAbs().maxCoeff());
  double least = most * most;
  const auto visit = [&](Side side) {
    if (side == best.side) return;
    const auto v = mesh.vertices(side);
    const Vec3 &a = mesh.rest(v[0]), &b = mesh.rest(v[1]), &c = mesh.rest(v[2]);
    const Box box{a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
    if (box.distance2(place) > (1 + kCellRounding) * least) return;  // most need no closer look
    const ClosestPoint near = closest_on_triangle(place, a, b, c);
    if (near.distance2 > least || (near.distance2 == least && best.side < side)) return;
    least = near.distance2;
    best = {side, near.point};
  };
  const Cell middle = cell_of(place);
  const auto shells = *std::max_element(counts_.begin(), counts_.end());
  for (std::uint16_t away = 0; away <= shells; ++away) {
    const double nearest = (away - 1.0) * size - margin;  // of what is listed there
    if (nearest > 0 && nearest * nearest > least) break;
    for_each_in_shell(middle, away, [&](const Cell& cell) {
      const double reach = std::sqrt(room_of(cell).distance2(place)) - margin;
      if (reach > 0 && reach * reach > least) return;
      for_each_in(mesh, heads_[index_of(cell)], cell, visit);
    });
  }
  return best;
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
