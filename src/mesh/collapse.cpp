// SPDX-License-Identifier: Apache-2.0
// The link condition by marks on the vertices of one link, asked from the other, with the boundary closed by a vertex
// at infinity; then links are joined across the tets that vanish.
#include "incise/mesh/collapse.h"

#include <algorithm>

#include "incise/geom/predicates.h"

namespace incise {
inline namespace v0 {

namespace {

/// What is known of a vertex near the edge that shall vanish.
constexpr std::uint8_t kInLink = 1;   // a neighbour of `into`
constexpr std::uint8_t kInRing = 2;   // a neighbour of both ends in a tet around the edge
constexpr std::uint8_t kOnRim = 4;    // joined to `into` by a boundary edge
constexpr std::uint8_t kRingEnd = 8;  // the third vertex of a boundary face at the edge

bool is_positive_with(const TetMesh& mesh, TetId tet, unsigned corner, const Vec3& place) {
  std::array<Vec3, 4> p;
  for (unsigned c = 0; c < 4; ++c) {
    p[c] = c == corner ? place : mesh.rest(mesh.vertices(tet)[c]);
  }
  return orient3d(p[0], p[1], p[2], p[3]) > 0;
}

bool stands_out(const TetMesh& mesh, TetId tet, VertexId from, VertexId into) {
  const TetLinks& links = mesh.links(tet);
  return links[mesh.corner_of(tet, from)].is_boundary() && links[mesh.corner_of(tet, into)].is_boundary();
}

bool is_flap(const CollapsePlan& plan, TetId tet) {
  return std::find(plan.flaps.begin(), plan.flaps.end(), tet) != plan.flaps.end();
}

/// Whether nothing lies behind a side once the flaps are gone.
bool is_open(const TetMesh& mesh, const CollapsePlan& plan, TetId tet, unsigned side) {
  const Link link = mesh.links(tet)[side];
  return link.is_boundary() || (!plan.flaps.empty() && is_flap(plan, link.side().tet()));
}

/// Whether the tets have one region, or the vertex may vanish because the border does not pass through it.
bool has_one_region(const TetMesh& mesh, const CollapsePlan& plan) {
  const std::int32_t region = mesh.region(plan.ring.front());
  const auto is_same = [&](TetId tet) { return mesh.region(tet) == region; };
  return std::all_of(plan.ring.begin(), plan.ring.end(), is_same) &&
         std::all_of(plan.fan.begin(), plan.fan.end(), is_same);
}

}  // namespace

void CollapsePlanner::plan(const TetMesh& mesh, VertexId from, VertexId into, CollapsePlan& plan, Flaps flaps) {
  plan.from = from;
  plan.into = into;
  plan.ring.clear();
  plan.flaps.clear();
  plan.fan.clear();
  plan.around.clear();
  if (!mesh.is_live(from) || !mesh.is_live(into) || from == into) {
    plan.refusal = Refusal::kDead;
    return;
  }
  if (((mesh.shape_of(from) | mesh.shape_of(into)) & shape::kPinched) != 0) {
    plan.refusal = Refusal::kNoStar;
    return;
  }
  for (const TetId tet : walker_.star(mesh, from)) {
    (mesh.corner_of(tet, into) < 4 ? plan.ring : plan.fan).push_back(tet);
  }
  if (plan.ring.empty()) {
    plan.refusal = Refusal::kNotAnEdge;
    return;
  }
  if (mesh.has_regions() && !has_one_region(mesh, plan)) {
    plan.refusal = Refusal::kOnSurface;
    return;
  }
  plan.around = walker_.star(mesh, into);
  if (flaps == Flaps::kTakenAway) {
    for (const TetId tet : plan.ring) {
      if (stands_out(mesh, tet, from, into)) plan.flaps.push_back(tet);
    }
    if (!may_take_flaps(mesh, plan)) {
      plan.refusal = Refusal::kLinkCondition;
      return;
    }
  }
  mark_link(mesh, plan);
  plan.refusal = keeps_topology(mesh, plan) ? Refusal::kNone : Refusal::kLinkCondition;
  clear_marks(mesh, plan);
}

/// Whether no corner of a flap is pinched, and what remains around the edge is one fan.
bool CollapsePlanner::may_take_flaps(const TetMesh& mesh, const CollapsePlan& plan) const {
  if (plan.flaps.empty()) return true;
  unsigned ends = 0;
  for (const TetId tet : plan.ring) {
    const TetVertices& v = mesh.vertices(tet);
    const bool is_gone = is_flap(plan, tet);
    for (unsigned s = 0; s < 4; ++s) {
      if (is_gone && (mesh.shape_of(v[s]) & shape::kPinched) != 0) return false;
      const bool is_at_edge = v[s] != plan.from && v[s] != plan.into;
      if (!is_gone && is_at_edge && is_open(mesh, plan, tet, s)) ++ends;
    }
  }
  return ends == 2;
}

void CollapsePlanner::mark_link(const TetMesh& mesh, const CollapsePlan& plan) {
  marks_.ensure(mesh.vertex_slots());
  for (const TetId tet : plan.around) {
    if (is_flap(plan, tet)) continue;
    mark(mesh.vertices(tet), kInLink);
    for (unsigned s = 0; s < 4; ++s) {
      if (is_open(mesh, plan, tet, s) && mesh.vertices(tet)[s] != plan.into) {
        mark(mesh.vertices(Side(tet, s)), kOnRim);
      }
    }
  }
  for (const TetId tet : plan.ring) {
    if (is_flap(plan, tet)) continue;
    mark(mesh.vertices(tet), kInRing);
    for (unsigned s = 0; s < 4; ++s) {
      const VertexId apex = mesh.vertices(tet)[s];
      if (is_open(mesh, plan, tet, s) && apex != plan.from && apex != plan.into) {
        mark(mesh.vertices(Side(tet, s)), kRingEnd);
      }
    }
  }
  marks_[plan.from.value] = marks_[plan.into.value] = 0;
}

void CollapsePlanner::clear_marks(const TetMesh& mesh, const CollapsePlan& plan) {
  for (const TetId tet : plan.around) {
    for (const VertexId v : mesh.vertices(tet)) marks_[v.value] = 0;
  }
}

bool CollapsePlanner::keeps_topology(const TetMesh& mesh, const CollapsePlan& plan) const {
  constexpr unsigned kBoundary = shape::kSkin | shape::kWall;
  bool is_boundary_edge = false;
  for (const TetId tet : plan.ring) {
    if (is_flap(plan, tet)) continue;
    for (unsigned s = 0; s < 4; ++s) {
      const VertexId apex = mesh.vertices(tet)[s];
      is_boundary_edge |= is_open(mesh, plan, tet, s) && apex != plan.from && apex != plan.into;
    }
    if (stands_out(mesh, tet, plan.from, plan.into) || touches_rim(mesh, plan, tet)) {
      return false;  // two faces would become one with nothing between them, or two fans meet
    }
  }
  if ((mesh.shape_of(plan.from) & kBoundary) != 0 && (mesh.shape_of(plan.into) & kBoundary) != 0 && !is_boundary_edge) {
    return false;
  }
  return !plan.fan.empty() &&
         std::all_of(plan.fan.begin(), plan.fan.end(), [&](TetId tet) { return shares_only_ring(mesh, plan, tet); });
}

/// Whether a boundary side at `from` has a vertex that boundary edges join to both ends, but no boundary face to the
/// edge.
bool CollapsePlanner::touches_rim(const TetMesh& mesh, const CollapsePlan& plan, TetId tet) const {
  for (unsigned s = 0; s < 4; ++s) {
    if (!is_open(mesh, plan, tet, s) || mesh.vertices(tet)[s] == plan.from) {
      continue;
    }
    for (const VertexId v : mesh.vertices(Side(tet, s))) {
      if ((marks_[v.value] & (kInRing | kOnRim | kRingEnd)) == (kInRing | kOnRim)) {
        return true;
      }
    }
  }
  return false;
}

bool CollapsePlanner::ring_has(const TetMesh& mesh, const CollapsePlan& plan, VertexId x, VertexId y) const {
  return std::any_of(plan.ring.begin(), plan.ring.end(), [&](TetId tet) {
    return mesh.corner_of(tet, x) < 4 && mesh.corner_of(tet, y) < 4 && !is_flap(plan, tet);
  });
}

/// One tet of the fan: its vertices, and the edges of its face opposite `from`, may be in both links only where they
/// are in the ring's; likewise the edges of its boundary sides with the vertex at infinity.
bool CollapsePlanner::shares_only_ring(const TetMesh& mesh, const CollapsePlan& plan, TetId tet) const {
  const TetVertices& v = mesh.vertices(tet);
  const unsigned apex = mesh.corner_of(tet, plan.from);
  const auto is_edge_of_into = [&](VertexId x, VertexId y) {
    return std::any_of(plan.around.begin(), plan.around.end(), [&](TetId other) {
      return mesh.corner_of(other, x) < 4 && mesh.corner_of(other, y) < 4 && !is_flap(plan, other);
    });
  };
  for (unsigned c = 0; c < 4; ++c) {
    if (c != apex && (marks_[v[c].value] & (kInLink | kInRing)) == kInLink) {
      return false;
    }
  }
  for (const auto& [i, j] : kEdgeCorners) {
    const bool is_in_both = i != apex && j != apex && (marks_[v[i].value] & marks_[v[j].value] & kInRing) != 0;
    if (is_in_both && !ring_has(mesh, plan, v[i], v[j]) && is_edge_of_into(v[i], v[j])) {
      return false;
    }
  }
  return !touches_rim(mesh, plan, tet);
}

bool stays_positive(const TetMesh& mesh, const CollapsePlan& plan, const Vec3& place) {
  const auto keeps = [&](TetId tet, VertexId vertex) {
    return is_positive_with(mesh, tet, mesh.corner_of(tet, vertex), place);
  };
  const bool moves = place != mesh.rest(plan.into);
  return std::all_of(plan.fan.begin(), plan.fan.end(), [&](TetId tet) { return keeps(tet, plan.from); }) &&
         (!moves || std::all_of(plan.around.begin(), plan.around.end(), [&](TetId tet) {
           return mesh.corner_of(tet, plan.from) < 4 || keeps(tet, plan.into);
         }));
}

namespace {

class Collapser {
 public:
  Collapser(Transaction& transaction, const CollapsePlan& plan)
      : transaction_(transaction), mesh_(transaction.mesh()), plan_(plan) {}

  void run() {
    note_consumed();
    for (const TetId tet : plan_.flaps) let_go(tet);
    for (const TetId tet : plan_.ring) {
      if (!is_flap(plan_, tet)) close(tet);
    }
    for (const TetId tet : plan_.fan) {
      transaction_.set_corner(tet, mesh_.corner_of(tet, plan_.from), plan_.into);
    }
    transaction_.set_shape(plan_.into,
                           static_cast<std::uint8_t>(mesh_.shape_of(plan_.into) | mesh_.shape_of(plan_.from)));
    for (const TetId tet : plan_.ring) {
      transaction_.remove_tet(tet);
    }
    anchor(plan_.into, plan_.fan.front());
    transaction_.remove_vertex(plan_.from);
    for (const VertexId v : lost_) transaction_.remove_vertex(v);
    for (const VertexId v : bared_) set_bits(v);
    if (!plan_.flaps.empty()) set_bits(plan_.into);
    transaction_.note_produced(plan_.fan, plan_.fan);
  }

 private:
  void note_consumed() {
    transaction_.note_consumed(plan_.ring);
    transaction_.note_consumed(plan_.fan);
  }
  /// The other corners of a flap live on in the tets around the edge that are none, or not at all.
  void let_go(TetId flap) {
    for (const VertexId v : mesh_.vertices(flap)) {
      if (v == plan_.from || v == plan_.into) continue;
      const auto heir = std::find_if(plan_.ring.begin(), plan_.ring.end(),
                                     [&](TetId tet) { return mesh_.corner_of(tet, v) < 4 && !is_flap(plan_, tet); });
      std::vector<VertexId>& kind = heir == plan_.ring.end() ? lost_ : bared_;
      if (std::find(kind.begin(), kind.end(), v) == kind.end()) kind.push_back(v);
      if (heir != plan_.ring.end()) anchor(v, flap, *heir);
    }
  }
  void set_bits(VertexId vertex) {
    const std::uint8_t bits = shape_by_faces(mesh_, vertex, walker_.star(mesh_, vertex));
    if (bits != mesh_.shape_of(vertex)) transaction_.set_shape(vertex, bits);
  }
  /// The two faces of a ring tet that the edge joins become one.
  void close(TetId tet) {
    const TetVertices vertices = mesh_.vertices(tet);
    const Link a = mesh_.links(tet)[mesh_.corner_of(tet, plan_.from)];
    const Link b = mesh_.links(tet)[mesh_.corner_of(tet, plan_.into)];
    if (a.is_boundary()) {
      transaction_.set_link(b.side(), a);
    } else if (b.is_boundary()) {
      transaction_.set_link(a.side(), b);
    } else {
      transaction_.join(a.side(), b.side());
    }
    for (const VertexId v : vertices) {
      anchor(v, tet, a.is_boundary() ? b.side().tet() : a.side().tet());
    }
  }
  void anchor(VertexId v, TetId dying, TetId heir) {
    if (mesh_.tet_of(v) == dying && v != plan_.from && v != plan_.into) {
      transaction_.set_tet_of(v, heir);
    }
  }
  void anchor(VertexId v, TetId heir) {
    if (!mesh_.is_live(mesh_.tet_of(v))) {
      transaction_.set_tet_of(v, heir);
    }
  }

  Transaction& transaction_;
  const TetMesh& mesh_;
  const CollapsePlan& plan_;
  StarWalker walker_;
  std::vector<VertexId> lost_, bared_;  // corners of flaps
};

}  // namespace

void apply(Transaction& transaction, const CollapsePlan& plan) {
  Collapser(transaction, plan).run();
}

}  // namespace v0
}  // namespace incise
