// SPDX-License-Identifier: Apache-2.0
// Points on crossed edges and sides make their tets, and those around them, be filled; where a part would have no
// volume the tet's edges are blocked and all is planned anew.
#include "lab/refinement.h"

#include <algorithm>
#include <bit>

#include "incise/geom/predicates.h"
#include "incise/mesh/tet_tables.h"
#include "lab/constants.h"

namespace incise {
inline namespace v0 {
namespace lab {

namespace {

/// The side and the one behind it: the lower one.
Side lower_of(const TetMesh& mesh, Side side) {
  const Link link = mesh.link(side);
  return link.is_boundary() ? side : std::min(side, link.side());
}

double clamped(double t) {
  return std::clamp(t, kNearestToEnd, 1 - kNearestToEnd);
}

/// Where the sheet crosses an edge, from its first end.
double place_on(const CutEdge& edge) {
  return clamped(edge.crossings.count > 1 ? 0.5 * (edge.crossings.t + edge.crossings.t_last) : edge.crossings.t);
}

bool is_crossed(const NearTet& tet, unsigned edge) {
  return ((unsigned{tet.flagged} >> edge) & 1U) != 0;
}

/// The corners on the other side of the sheet than corner 0, of a tet that is crossed completely.
std::uint8_t corners_beyond(const NearTet& tet) {
  unsigned bits = 0;
  for (unsigned c = 1; c < 4; ++c) bits |= is_crossed(tet, kEdgeOfCorners[0][c]) ? 1U << c : 0U;
  return static_cast<std::uint8_t>(bits);
}

bool is_side_crossed(const NearTet& tet, unsigned side) {
  return std::any_of(kSideEdges[side].begin(), kSideEdges[side].end(), [&](unsigned e) { return is_crossed(tet, e); });
}

/// The side of the whole tet that a side of a part lies on.
unsigned whole_side(const Child& child, unsigned side) {
  unsigned support = 0;
  for (unsigned k = 0; k < 4; ++k) support |= k == side ? 0U : support_of(child.points[k]);
  return static_cast<unsigned>(std::countr_one(support));
}

std::array<VertexId, 3> sorted(std::array<VertexId, 3> face) {
  std::sort(face.begin(), face.end());
  return face;
}

}  // namespace

Refinement::Refinement(const TetMesh& mesh, const Neighbourhood& near, Scheme scheme)
    : mesh_(mesh), near_(near), scheme_(scheme) {
  do {
    find_divided();
    place_points();
    find_filled();
  } while (block_unsound());
}

// --- what is divided, and where --------------------------------------------------------------------------------------

bool Refinement::is_blocked(const NearTet& tet) const {
  for (unsigned e = 0; e < 6; ++e) {
    if (scheme_ == Scheme::kAdaptive && !is_crossed(tet, e)) continue;
    const CutEdge& edge = near_.edges[tet.edges[e]];
    if (std::binary_search(blocked_.begin(), blocked_.end(), Ends(edge.a, edge.b))) return true;
  }
  return false;
}

void Refinement::find_divided() {
  divided_.clear();
  for (std::uint32_t n = 0; n < near_.tets.size(); ++n) {
    const NearTet& tet = near_.tets[n];
    const bool is_cut = tet.flagged != 0 && tet.is_complete;
    if (is_cut && !mesh_.is_flat_at_load(tet.id) && !is_blocked(tet)) divided_.push_back({n, corners_beyond(tet)});
  }
}

void Refinement::place_points() {
  edges_.clear();
  sides_.clear();
  for (const Divided& divided : divided_) {
    const NearTet& tet = near_.tets[divided.near];
    for (unsigned e = 0; e < 6; ++e) {
      const CutEdge& edge = near_.edges[tet.edges[e]];
      if (is_crossed(tet, e)) {
        edges_.push_back({{edge.a, edge.b}, place_on(edge), tet.id, {}});
      } else if (scheme_ == Scheme::kSeventeen) {
        edges_.push_back({{edge.a, edge.b}, 0.5, tet.id, {}});
      }
    }
    place_side_points(divided);
  }
  const auto rising = [](const EdgePoint& a, const EdgePoint& b) { return a.ends < b.ends; };
  const auto same = [](const EdgePoint& a, const EdgePoint& b) { return a.ends == b.ends; };
  std::stable_sort(edges_.begin(), edges_.end(), rising);
  edges_.erase(std::unique(edges_.begin(), edges_.end(), same), edges_.end());
  std::stable_sort(sides_.begin(), sides_.end(), [](const auto& a, const auto& b) { return a.side < b.side; });
  const auto same_side = [](const SidePoint& a, const SidePoint& b) { return a.side == b.side; };
  sides_.erase(std::unique(sides_.begin(), sides_.end(), same_side), sides_.end());
  number_points();
}

void Refinement::place_side_points(const Divided& divided) {
  const NearTet& tet = near_.tets[divided.near];
  for (unsigned s = 0; s < 4; ++s) {
    if (scheme_ == Scheme::kAdaptive && !is_side_crossed(tet, s)) continue;
    const std::array<double, 3> weights = weights_of(tet, s);  // in the order of this side
    const Side side(tet.id, s), lower = lower_of(mesh_, side);
    const auto here = mesh_.vertices(side), there = mesh_.vertices(lower);
    SidePoint point{lower, {}, {}};
    for (unsigned k = 0; k < 3; ++k) {
      point.weights[k] =
          weights[static_cast<std::size_t>(std::find(here.begin(), here.end(), there[k]) - here.begin())];
    }
    sides_.push_back(point);
  }
}

/// Halfway between the crossings of two of its edges, or else the middle.
std::array<double, 3> Refinement::weights_of(const NearTet& tet, unsigned side) const {
  if (!is_side_crossed(tet, side)) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
  const auto& corners = kSideCorners[side];
  unsigned lone = 0;  // both of its edges are crossed
  while (!is_crossed(tet, kEdgeOfCorners[corners[lone]][corners[(lone + 1) % 3]]) ||
         !is_crossed(tet, kEdgeOfCorners[corners[lone]][corners[(lone + 2) % 3]])) {
    ++lone;
  }
  const VertexId from = mesh_.vertices(tet.id)[corners[lone]];
  std::array<double, 3> weights{};
  weights[lone] = 1;
  for (const unsigned k : {(lone + 1) % 3, (lone + 2) % 3}) {
    const CutEdge& edge = near_.edge(tet, corners[lone], corners[k]);
    const double share = 0.5 * (edge.a == from ? place_on(edge) : 1 - place_on(edge));
    weights[k] = share;
    weights[lone] -= share;
  }
  if (scheme_ == Scheme::kSeventeen) {
    for (unsigned k = 0; k < 3; ++k) {
      weights[k] = (1 - kOffTheSheet) * weights[k] + (k == lone ? 0.0 : 0.5 * kOffTheSheet);
    }
  }
  return weights;
}

/// Numbers that stand for their vertices until these are made.
void Refinement::number_points() {
  std::uint32_t number = 0;
  for (EdgePoint& point : edges_) point.vertex = VertexId(number++);
  for (SidePoint& point : sides_) point.vertex = VertexId(number++);
}

// --- how every tet at a point is filled ------------------------------------------------------------------------------

const Refinement::EdgePoint* Refinement::find_edge(VertexId a, VertexId b) const {
  const Ends ends(std::min(a, b), std::max(a, b));
  const auto found = std::lower_bound(edges_.begin(), edges_.end(), ends,
                                      [](const EdgePoint& point, const Ends& wanted) { return point.ends < wanted; });
  return found != edges_.end() && found->ends == ends ? &*found : nullptr;
}

const Refinement::SidePoint* Refinement::find_side(Side side) const {
  const auto found = std::lower_bound(sides_.begin(), sides_.end(), side,
                                      [](const SidePoint& point, Side wanted) { return point.side < wanted; });
  return found != sides_.end() && found->side == side ? &*found : nullptr;
}

PointVertices Refinement::points_of(TetId tet) const {
  PointVertices points{};
  const TetVertices& corners = mesh_.vertices(tet);
  for (unsigned c = 0; c < 4; ++c) points[c] = corners[c];
  for (unsigned e = 0; e < 6; ++e) {
    const auto [a, b] = kEdgeCorners[e];
    if (const EdgePoint* point = find_edge(corners[a], corners[b])) points[edge_code(e)] = point->vertex;
  }
  for (unsigned s = 0; s < 4; ++s) {
    if (const SidePoint* point = find_side(lower_of(mesh_, Side(tet, s)))) points[side_code(s)] = point->vertex;
  }
  return points;
}

void Refinement::find_filled() {
  filled_.clear();
  std::vector<TetId> tets, own;
  const auto is_open = [](Side) { return false; };
  for (const EdgePoint& point : edges_) {
    walk_edge_ring(mesh_, point.ends.first, point.ends.second, point.tet, is_open,
                   [&](TetId tet) { tets.push_back(tet); });
  }
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
  for (const TetId tet : tets) filled_.push_back({tet, fill_beside(points_of(tet)), {}, {}});
  for (const Divided& divided : divided_) {
    const TetId tet = near_.tets[divided.near].id;
    const auto at = std::lower_bound(tets.begin(), tets.end(), tet);
    Filled& filled = filled_[static_cast<std::size_t>(at - tets.begin())];
    filled.children =
        scheme_ == Scheme::kSeventeen ? fill_with_17(divided.beyond) : fill_adaptively(divided.beyond, points_of(tet));
  }
}

Vec3 Refinement::place_of(TetId tet, PointCode code) const {
  const TetVertices& corners = mesh_.vertices(tet);
  if (code < edge_code(0)) return mesh_.rest(corners[code]);
  Vec3 place = Vec3::Zero();
  if (code < side_code(0)) {
    const auto [a, b] = kEdgeCorners[code - edge_code(0)];
    const EdgePoint& point = *find_edge(corners[a], corners[b]);
    return mesh_.rest(point.ends.first) + point.t * (mesh_.rest(point.ends.second) - mesh_.rest(point.ends.first));
  }
  if (code == kInside) {
    for (const VertexId v : corners) place += 0.25 * mesh_.rest(v);
    return place;
  }
  const SidePoint& point = *find_side(lower_of(mesh_, Side(tet, code - side_code(0))));
  const auto face = mesh_.vertices(point.side);
  for (unsigned k = 0; k < 3; ++k) place += point.weights[k] * mesh_.rest(face[k]);
  return place;
}

bool Refinement::is_sound(const Filled& filled) const {
  return std::all_of(filled.children.begin(), filled.children.end(), [&](const Child& child) {
    std::array<Vec3, 4> p;
    for (unsigned k = 0; k < 4; ++k) p[k] = place_of(filled.tet, child.points[k]);
    return orient3d(p[0], p[1], p[2], p[3]) > 0;
  });
}

/// Blocks the points of tets that would get a part without volume. Returns whether there were any.
bool Refinement::block_unsound() {
  const std::size_t before = blocked_.size();
  for (const Filled& filled : filled_) {
    if (!mesh_.is_flat_at_load(filled.tet) && is_sound(filled)) continue;
    const TetVertices& corners = mesh_.vertices(filled.tet);
    for (const auto& [a, b] : kEdgeCorners) {
      if (const EdgePoint* point = find_edge(corners[a], corners[b])) blocked_.push_back(point->ends);
    }
  }
  std::sort(blocked_.begin(), blocked_.end());
  blocked_.erase(std::unique(blocked_.begin(), blocked_.end()), blocked_.end());
  return blocked_.size() != before;
}

// --- carrying it out -------------------------------------------------------------------------------------------------

std::vector<IncisionFace> Refinement::apply(Transaction& transaction) {
  make_points(transaction);
  for (Filled& filled : filled_) make_children(transaction, filled);
  std::vector<IncisionFace> incision;
  for (Filled& filled : filled_) link_inner(transaction, filled, incision);
  for (const Filled& filled : filled_) {
    for (const OuterSide& outer : filled.outer) link_outer(transaction, filled, outer);
  }
  for (const Filled& filled : filled_) transaction.remove_tet(filled.tet);
  return incision;
}

void Refinement::make_points(Transaction& transaction) {
  for (EdgePoint& point : edges_) {
    point.vertex = transaction.add_vertex_on_edge(point.ends.first, point.ends.second, point.t);
  }
  for (SidePoint& point : sides_) {
    const auto face = mesh_.vertices(point.side);
    Vec3 rest = Vec3::Zero(), current = Vec3::Zero();
    for (unsigned k = 0; k < 3; ++k) {
      rest += point.weights[k] * mesh_.rest(face[k]);
      current += point.weights[k] * mesh_.current(face[k]);
    }
    point.vertex = transaction.add_vertex(face, point.weights, rest, current);
  }
}

VertexId Refinement::make_inside(Transaction& transaction, TetId tet) {
  const TetVertices corners = mesh_.vertices(tet);
  Vec3 rest = Vec3::Zero(), current = Vec3::Zero();
  for (const VertexId v : corners) {
    rest += 0.25 * mesh_.rest(v);
    current += 0.25 * mesh_.current(v);
  }
  constexpr std::array<double, 4> kEqual = {0.25, 0.25, 0.25, 0.25};
  return transaction.add_vertex(corners, kEqual, rest, current);
}

void Refinement::make_children(Transaction& transaction, Filled& filled) {
  PointVertices points = points_of(filled.tet);
  for (const Child& child : filled.children) {
    TetVertices vertices;
    for (unsigned k = 0; k < 4; ++k) {
      const PointCode code = child.points[k];
      if (code == kInside && !points[code].is_valid()) points[code] = make_inside(transaction, filled.tet);
      vertices[k] = points[code];
    }
    filled.tets.push_back(transaction.add_tet(vertices, filled.tet));
    for (const VertexId v : vertices) transaction.set_tet_of(v, filled.tets.back());
  }
}

/// Joins the parts of one tet, and notes the faces between those on different sides of the sheet.
void Refinement::link_inner(Transaction& transaction, Filled& filled, std::vector<IncisionFace>& incision) const {
  struct ChildSide {
    std::array<VertexId, 3> face;
    std::size_t child;
    unsigned side;
  };
  std::vector<ChildSide> all;
  for (std::size_t k = 0; k < filled.tets.size(); ++k) {
    for (unsigned s = 0; s < 4; ++s) all.push_back({sorted(mesh_.vertices(Side(filled.tets[k], s))), k, s});
  }
  std::stable_sort(all.begin(), all.end(), [](const ChildSide& a, const ChildSide& b) { return a.face < b.face; });
  for (std::size_t k = 0; k < all.size(); ++k) {
    const ChildSide& one = all[k];
    const Side side(filled.tets[one.child], one.side);
    if (k + 1 == all.size() || one.face != all[k + 1].face) {
      filled.outer.push_back({one.face, side, whole_side(filled.children[one.child], one.side)});
      continue;
    }
    const ChildSide& other = all[++k];
    const Side behind(filled.tets[other.child], other.side);
    transaction.join(side, behind);
    if (filled.children[one.child].is_beyond != filled.children[other.child].is_beyond) {
      incision.push_back({side, behind});
    }
  }
}

/// The side of a part of a neighbour, if it is filled, that has the same vertices.
std::optional<Side> Refinement::side_behind(TetId neighbour, const OuterSide& outer) const {
  const auto at = std::lower_bound(filled_.begin(), filled_.end(), neighbour,
                                   [](const Filled& filled, TetId wanted) { return filled.tet < wanted; });
  if (at == filled_.end() || at->tet != neighbour) return std::nullopt;
  const auto found = std::lower_bound(at->outer.begin(), at->outer.end(), outer.face,
                                      [](const OuterSide& entry, const auto& wanted) { return entry.face < wanted; });
  if (found == at->outer.end() || found->face != outer.face) return std::nullopt;
  return found->side;
}

void Refinement::link_outer(Transaction& transaction, const Filled& filled, const OuterSide& outer) const {
  const Link link = mesh_.link({filled.tet, outer.whole});
  if (!link.is_boundary()) {
    transaction.join(outer.side, side_behind(link.side().tet(), outer).value_or(link.side()));
    return;
  }
  transaction.set_link(outer.side, link);
  const unsigned bit = link.tag() == 0 ? shape::kSkin : shape::kWall;
  for (const VertexId v : mesh_.vertices(outer.side)) {
    if ((mesh_.shape_of(v) & bit) == 0) {
      transaction.set_shape(v, static_cast<std::uint8_t>(mesh_.shape_of(v) | bit));
    }
  }
}

}  // namespace lab
}  // namespace v0
}  // namespace incise
