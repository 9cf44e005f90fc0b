// SPDX-License-Identifier: Apache-2.0
// Masters, edges and front points in arrays with free lists, and tables by vertex slot for copies and holds. Letting a
// master go removes it from all of them, and what nobody uses any more goes with it (docs/internals.md, 3.4).
#include "cut/closed_complex.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace incise {
inline namespace v0 {

void ClosedComplex::clear() {
  for (const Master& master : masters_) {
    if (master.split == nullptr) continue;
    for (const TetId child : children(master)) master_of_[child.value] = 0;
    for (const VertexId vertex : master.vertices) forget(vertex);
  }
  for (const VertexId vertex : copied_) {
    if (vertex.is_valid()) drop_copies(vertex);
  }
  masters_.clear();
  free_masters_.clear();
  children_.clear();
  for (auto& blocks : free_blocks_) blocks.clear();
  points_.clear();
  free_points_.clear();
  edges_.clear();
  dirty_.clear();
  retired_.clear();
  let_go_.clear();
  for (const VertexId vertex : ranked_) rank_[vertex.value] = 0;
  ranked_.clear();
  mark_ = 0;
  ++hold_;
}

/// What the tables by vertex slot say of a corner.
void ClosedComplex::forget(VertexId vertex) {
  master_at_[vertex.value] = count_at_[vertex.value] = 0;
  if (vertex.value < flagged_at_.capacity()) flagged_at_[vertex.value] = 0;
  if (is_on(vertex)) is_on_[vertex.value] = 0;
  if (is_settled(vertex)) is_settled_[vertex.value] = 0;
}

ClosedComplex::Image ClosedComplex::image() const {
  Image image;
  image.masters_.assign(masters_.begin(), masters_.end());
  image.free_masters_ = free_masters_;
  image.children_.assign(children_.begin(), children_.end());
  image.free_blocks_ = free_blocks_;
  image.points_.assign(points_.begin(), points_.end());
  image.free_points_ = free_points_;
  image.edges_.assign(edges_.edges().begin(), edges_.edges().end());
  image.copy_lists_ = copy_lists_;
  image.copied_ = copied_;
  image.free_lists_ = free_lists_;
  for (const VertexId vertex : ranked_) image.ranks_.emplace_back(vertex, rank_[vertex.value]);
  image.let_go_ = let_go_;
  image.mark_ = mark_;
  std::vector<VertexId> corners;
  for (const Master& master : masters_) {
    if (master.split != nullptr) corners.insert(corners.end(), master.vertices.begin(), master.vertices.end());
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (const VertexId v : corners) {
    const auto settled = static_cast<std::uint8_t>(is_settled(v) ? is_settled_[v.value] : 0U);
    image.corners_.push_back({v, flagged_at(v), master_at_[v.value], count_at_[v.value],
                              static_cast<std::uint8_t>(is_on(v) ? 1U : 0U), settled});
  }
  return image;
}

void ClosedComplex::restore(const Image& image, const TetMesh& mesh) {
  assert(masters_.empty());
  const auto fill = [](auto& array, const auto& values) {
    for (const auto& value : values) array.push_back(value);
  };
  const auto set = [](auto& table, VertexId vertex, auto value) {
    table.ensure(std::size_t{vertex.value} + 1);
    table[vertex.value] = value;
  };
  fill(masters_, image.masters_);
  fill(children_, image.children_);
  fill(points_, image.points_);
  free_masters_ = image.free_masters_;
  free_blocks_ = image.free_blocks_;
  free_points_ = image.free_points_;
  edges_.restore(image.edges_);
  copy_lists_ = image.copy_lists_;
  copied_ = image.copied_;
  free_lists_ = image.free_lists_;
  let_go_ = image.let_go_;
  mark_ = image.mark_;
  for (std::uint32_t i = 0; i < copied_.size(); ++i) {
    if (!copied_[i].is_valid()) continue;
    set(copies_, copied_[i], i + 1);
    for (const VertexId copy : copy_lists_[i]) set(closed_, copy, copied_[i].value + 1);
  }
  for (const auto& [vertex, rank] : image.ranks_) {
    set(rank_, vertex, rank);
    ranked_.push_back(vertex);
  }
  for (const Image::Corner& corner : image.corners_) {
    set(flagged_at_, corner.vertex, corner.flagged_at);
    set(master_at_, corner.vertex, corner.master_at);
    set(count_at_, corner.vertex, corner.count_at);
    set(is_on_, corner.vertex, corner.is_on);
    set(is_settled_, corner.vertex, corner.is_settled);
  }
  for (std::uint32_t i = 0; i < size(); ++i) {
    if (masters_[i].split == nullptr) continue;
    for (const TetId child : children(masters_[i])) {
      master_of_.ensure(std::size_t{child.value} + 1);
      master_of_[child.value] = i + 1;
    }
  }
  hold_vertices(mesh);
}

template <class Visit>
void ClosedComplex::for_each_copy(VertexId vertex, Visit&& visit) {
  if (!vertex.is_valid()) return;
  visit(vertex);
  if (!has_copies(vertex)) return;
  for (const VertexId copy : copies_of(vertex)) visit(copy);
}

void ClosedComplex::hold(VertexId vertex) {
  for_each_copy(vertex, [&](VertexId v) {
    held_.ensure(std::size_t{v.value} + 1);
    held_[v.value] = hold_;
  });
}

/// The same for one that was made by the cut: split points and front points.
void ClosedComplex::hold_made(VertexId vertex) {
  hold(vertex);
  for_each_copy(vertex, [&](VertexId v) {
    made_.ensure(std::size_t{v.value} + 1);
    made_[v.value] = hold_;
  });
}

void ClosedComplex::hold_vertices(const TetMesh& mesh) {
  ++hold_;
  for (const Master& master : masters_) {
    if (master.split == nullptr) continue;
    for (const VertexId v : master.vertices) {
      if (v.value >= held_.capacity() || held_[v.value] != hold_) hold(v);  // another master has held it
    }
    hold_made(master.middle);
  }
  for (const ClosedEdge& edge : edges_.edges()) hold_made(edge.split);
  for (const FrontPoint& point : points_) hold_made(point.vertex);
  mark_beside_made(mesh);
}

/// Nor is a vertex of a tet that was let go beside such a point a corner that could be divided: its star has that tet.
void ClosedComplex::mark_beside_made(const TetMesh& mesh) {
  std::erase_if(let_go_, [&](TetId tet) {
    if (!mesh.is_live(tet) || find(tet) != Master::kNone) return true;
    const TetVertices& v = mesh.vertices(tet);
    return std::none_of(v.begin(), v.end(), [&](VertexId vertex) { return is_made(vertex); });
  });
  std::vector<VertexId> beside;
  for (const TetId tet : let_go_) beside.insert(beside.end(), mesh.vertices(tet).begin(), mesh.vertices(tet).end());
  for (const VertexId v : beside) {
    made_.ensure(std::size_t{v.value} + 1);
    made_[v.value] = hold_;
  }
}

std::uint32_t ClosedComplex::adopt(const TetMesh& mesh, TetId tet) {
  if (const std::uint32_t known = find(tet); known != Master::kNone) {
    return known;
  }
  if (free_masters_.empty()) {
    free_masters_.push_back(size());
    masters_.push_back({});
  }
  const std::uint32_t index = free_masters_.back();
  free_masters_.pop_back();
  Master master;
  for (unsigned c = 0; c < 4; ++c) master.vertices[c] = closed(mesh.vertices(tet)[c]);
  master.behind.fill(Master::kNone);
  master.points.fill(Master::kNone);
  master.split = &whole_;
  for (unsigned e = 0; e < 6; ++e) {
    const auto [a, b] = kEdgeCorners[e];
    master.edges[e] = edges_.find_or_add(master.vertices[a], master.vertices[b]);
    ClosedEdge& edge = edges_[master.edges[e]];
    master.next_use[e] = edge.first_use;
    edge.first_use = index * 6 + e;
    master.flagged |= static_cast<std::uint8_t>(static_cast<unsigned>(edge.is_flagged()) << e);
  }
  for (unsigned c = 0; c < 4; ++c) {
    master.on |= static_cast<std::uint8_t>(static_cast<unsigned>(is_on(master.vertices[c])) << c);
  }
  master.first_child = take_block(1);
  children_[master.first_child] = tet;
  masters_[index] = master;
  for (const VertexId vertex : master.vertices) {
    master_at_.ensure(std::size_t{vertex.value} + 1);
    master_at_[vertex.value] = index + 1;
    count_at_.ensure(std::size_t{vertex.value} + 1);
    ++count_at_[vertex.value];
  }
  master_of_.ensure(std::size_t{tet.value} + 1);
  master_of_[tet.value] = index + 1;
  for (unsigned s = 0; s < 4; ++s) {
    link(index, s, mesh);
  }
  return index;
}

void ClosedComplex::link(std::uint32_t master, unsigned side, const TetMesh& mesh) {
  const Link behind = outside(mesh, masters_[master], side);
  if (behind.is_boundary()) return;
  const std::uint32_t other = find(behind.side().tet());
  if (other == Master::kNone) return;
  const unsigned other_side = side_with(masters_[other], mesh, behind.side());
  if (masters_[other].split->outer[other_side].size() != 1) return;  // a part of a side whose other master was let go
  masters_[master].behind[side] = other;
  masters_[other].behind[other_side] = master;
}

unsigned ClosedComplex::side_with(const Master& master, const TetMesh& mesh, Side facet) const {
  auto face = mesh.vertices(facet);
  for (VertexId& v : face) v = closed(v);
  unsigned side = 0;
  while (side < 3 && std::any_of(face.begin(), face.end(), [&](VertexId v) { return v == master.vertices[side]; })) {
    ++side;
  }
  return side;
}

void ClosedComplex::release(std::uint32_t index) {
  Master& master = masters_[index];
  for (const std::uint32_t other : master.behind) {
    if (other == Master::kNone) continue;
    std::replace(masters_[other].behind.begin(), masters_[other].behind.end(), index, Master::kNone);
  }
  for (const TetId child : children(master)) {
    master_of_[child.value] = 0;
    if (master.is_divided()) let_go_.push_back(child);
  }
  free_blocks_[master.split->children.size()].push_back(master.first_child);
  for (unsigned s = 0; s < 4; ++s) unlink_point(index, s);
  if (master.middle.is_valid()) drop_copies(master.middle);
  for (unsigned e = 0; e < 6; ++e) unlink_edge(index, e);
  for (unsigned c = 0; c < 4; ++c) unlink_vertex(index, c);
  master.split = nullptr;
  free_masters_.push_back(index);
}

/// A front point that no master has any more is a vertex like others.
void ClosedComplex::unlink_point(std::uint32_t index, unsigned side) {
  const std::uint32_t at = masters_[index].points[side];
  if (at == Master::kNone) return;
  FrontPoint& point = points_[at];
  std::replace(point.masters.begin(), point.masters.end(), index, Master::kNone);
  if (point.masters[0] != Master::kNone || point.masters[1] != Master::kNone) return;
  if (point.vertex.is_valid()) drop_copies(point.vertex);
  point = {};
  free_points_.push_back(at);
}

void ClosedComplex::unlink_edge(std::uint32_t index, unsigned e) {
  const std::uint32_t at = masters_[index].edges[e];
  ClosedEdge& edge = edges_[at];
  std::uint32_t* use = &edge.first_use;
  while (*use != index * 6 + e) use = &masters_[*use / 6].next_use[*use % 6];
  *use = masters_[index].next_use[e];
  if (edge.first_use != kInvalidIndex) return;
  if (edge.split.is_valid()) drop_copies(edge.split);
  if (edge.is_flagged()) count_flag(edge, false);
  edges_.erase(at);
}

void ClosedComplex::unlink_vertex(std::uint32_t index, unsigned corner) {
  const VertexId vertex = masters_[index].vertices[corner];
  if (master_at_[vertex.value] == index + 1) master_at_[vertex.value] = 0;
  if (--count_at_[vertex.value] > 0) {
    if (is_settled(vertex)) is_settled_[vertex.value] = kHalfBaked;
    return;
  }
  drop_copies(vertex);
  if (is_on(vertex)) is_on_[vertex.value] = 0;
  if (is_settled(vertex)) is_settled_[vertex.value] = 0;
  if (rank(vertex) != vertex.value) retire_rank(vertex);
}

/// Whoever has this slot next ranks as nobody does: another corner may have its slot as a rank.
void ClosedComplex::retire_rank(VertexId vertex) {
  rank_.ensure(std::size_t{vertex.value} + 1);
  ranked_.push_back(vertex);
  rank_[vertex.value] = 1 + ((std::uint64_t{ranked_.size()} << 32U) | vertex.value);
}

void ClosedComplex::rename(VertexId from, VertexId to, std::span<const std::uint32_t> star) {
  for (const std::uint32_t index : star) {
    Master& master = masters_[index];
    for (const std::uint32_t e : master.edges) {
      if (edges_[e].a == from || edges_[e].b == from) rename_edge(e, from, to);
    }
    for (const std::uint32_t at : master.points) {
      if (at != Master::kNone) rename_point(points_[at], from, to);
    }
    std::replace(master.vertices.begin(), master.vertices.end(), from, to);
  }
  const auto move = [&](auto& table) {
    table.ensure(std::size_t{std::max(from, to).value} + 1);
    table[to.value] = std::exchange(table[from.value], 0);
  };
  const std::uint64_t ranked = rank(from);
  for (auto* table : {&flagged_at_, &master_at_, &count_at_}) move(*table);
  for (auto* table : {&is_on_, &is_settled_}) move(*table);
  retire_rank(from);
  rank_.ensure(std::size_t{to.value} + 1);
  rank_[to.value] = 1 + ranked;
  ranked_.push_back(to);
}

/// Its ends are in rising order again.
void ClosedComplex::rename_edge(std::uint32_t index, VertexId from, VertexId to) {
  const VertexId other = edges_[index].a == from ? edges_[index].b : edges_[index].a;
  const bool turns = (from < other) != (to < other);
  edges_.rename(index, std::min(to, other), std::max(to, other));
  if (!turns) return;
  ClosedEdge& edge = edges_[index];
  edge.t = 1.0 - edge.t;
  std::swap(edge.halves[0], edge.halves[1]);
}

/// The vertices of its face are in rising order again, and what goes with them.
void ClosedComplex::rename_point(FrontPoint& point, VertexId from, VertexId to) {
  std::replace(point.face.begin(), point.face.end(), from, to);
  const auto order = [&](std::size_t i, std::size_t j) {
    if (point.face[i] < point.face[j]) return;
    std::swap(point.face[i], point.face[j]);
    std::swap(point.weights[i], point.weights[j]);
    std::swap(point.slide[i], point.slide[j]);
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
}

/// Room for so many children.
std::uint32_t ClosedComplex::take_block(std::size_t count) {
  auto& blocks = free_blocks_[count];
  if (blocks.empty()) {
    const auto first = static_cast<std::uint32_t>(children_.size());
    for (std::size_t i = 0; i < count; ++i) children_.push_back({});
    return first;
  }
  const std::uint32_t first = blocks.back();
  blocks.pop_back();
  return first;
}

void ClosedComplex::set_children(std::uint32_t index, const SplitTemplate& split, std::span<const TetId> tets) {
  Master& master = masters_[index];
  for (const TetId child : children(master)) master_of_[child.value] = 0;
  if (master.split->children.size() != tets.size()) {
    free_blocks_[master.split->children.size()].push_back(master.first_child);
    master.first_child = take_block(tets.size());
  }
  master.split = &split;
  for (std::size_t i = 0; i < tets.size(); ++i) {
    children_[master.first_child + i] = tets[i];
    master_of_.ensure(std::size_t{tets[i].value} + 1);
    master_of_[tets[i].value] = index + 1;
  }
}

void ClosedComplex::count_flag(const ClosedEdge& edge, bool is_flagged) {
  for (const VertexId v : {edge.a, edge.b}) {
    flagged_at_.ensure(std::size_t{v.value} + 1);
    flagged_at_[v.value] += is_flagged ? 1U : ~0U;
  }
}

void ClosedComplex::toggle(std::uint32_t index) {
  ClosedEdge& edge = edges_[index];
  edge.is_crossed = !edge.is_crossed;
  if (!edge.is_blocked) count_flag(edge, edge.is_crossed);
}

void ClosedComplex::block(std::uint32_t index) {
  ClosedEdge& edge = edges_[index];
  if (edge.is_flagged()) count_flag(edge, false);
  edge.is_blocked = true;
}

void ClosedComplex::refresh_flags(std::uint32_t master) {
  unsigned flags = 0;
  for (unsigned e = 0; e < 6; ++e) {
    flags |= static_cast<unsigned>(edges_[masters_[master].edges[e]].is_flagged()) << e;
  }
  masters_[master].flagged = static_cast<std::uint8_t>(flags);
}

std::uint32_t ClosedComplex::add_point(const FrontPoint& point) {
  if (free_points_.empty()) {
    points_.push_back(point);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }
  const std::uint32_t index = free_points_.back();
  free_points_.pop_back();
  points_[index] = point;
  return index;
}

void ClosedComplex::remove_point(std::uint32_t index) {
  for (const std::uint32_t master : points_[index].masters) {
    if (master == Master::kNone) continue;
    std::replace(masters_[master].points.begin(), masters_[master].points.end(), index, Master::kNone);
  }
  if (points_[index].vertex.is_valid()) retire(points_[index].vertex);
  points_[index] = {};
  free_points_.push_back(index);
}

std::vector<VertexId>& ClosedComplex::copies_of(VertexId vertex) {
  copies_.ensure(std::size_t{vertex.value} + 1);
  std::uint32_t& index = copies_[vertex.value];
  if (index == 0) {
    if (free_lists_.empty()) {
      free_lists_.push_back(static_cast<std::uint32_t>(copy_lists_.size()));
      copy_lists_.emplace_back();
      copied_.emplace_back();
    }
    index = free_lists_.back() + 1;
    free_lists_.pop_back();
    copied_[index - 1] = vertex;
  }
  return copy_lists_[index - 1];
}

void ClosedComplex::add_copy(VertexId vertex, VertexId copy) {
  copies_of(vertex).push_back(copy);
  closed_.ensure(std::size_t{copy.value} + 1);
  closed_[copy.value] = vertex.value + 1;
}

void ClosedComplex::drop_copies(VertexId vertex) {
  if (!has_copies(vertex)) return;
  const std::uint32_t index = copies_[vertex.value] - 1;
  for (const VertexId copy : copy_lists_[index]) closed_[copy.value] = 0;
  copy_lists_[index].clear();
  copied_[index] = {};
  copies_[vertex.value] = 0;
  free_lists_.push_back(index);
}

void ClosedComplex::set_on(VertexId vertex) {
  is_on_.ensure(std::size_t{vertex.value} + 1);
  is_on_[vertex.value] = 1;
}

void ClosedComplex::settle(VertexId vertex) {
  is_settled_.ensure(std::size_t{vertex.value} + 1);
  is_settled_[vertex.value] = std::max<std::uint8_t>(is_settled_[vertex.value], 1);
}

const std::vector<std::uint32_t>& ClosedComplex::star(const TetMesh& mesh, std::uint32_t master, VertexId vertex) {
  star_.assign(1, master);
  masters_[master].mark = ++mark_;
  flood_star(mesh, vertex, 0);
  // Where the input's tets touched without sharing faces, others may have it.
  for (std::uint32_t other = 0; star_.size() < count_at_[vertex.value] && other < size(); ++other) {
    const auto& corners = masters_[other].vertices;
    if (masters_[other].mark == mark_ || masters_[other].split == nullptr ||
        std::find(corners.begin(), corners.end(), vertex) == corners.end()) {
      continue;
    }
    masters_[other].mark = mark_;
    star_.push_back(other);
    flood_star(mesh, vertex, star_.size() - 1);
  }
  return star_;
}

void ClosedComplex::flood_star(const TetMesh& mesh, VertexId vertex, std::size_t from) {
  for (std::size_t i = from; i < star_.size(); ++i) {
    for (unsigned s = 0; s < 4; ++s) {
      const std::uint32_t at = star_[i];
      if (masters_[at].vertices[s] == vertex) continue;
      std::uint32_t next = masters_[at].behind[s];
      if (next == Master::kNone) {
        const Link behind = outside(mesh, masters_[at], s);
        if (behind.is_boundary()) continue;
        next = adopt(mesh, behind.side().tet());
      }
      if (masters_[next].mark != mark_) {
        masters_[next].mark = mark_;
        star_.push_back(next);
      }
    }
  }
}

}  // namespace v0
}  // namespace incise
