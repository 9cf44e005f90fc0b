// SPDX-License-Identifier: Apache-2.0
#include "incise/mesh/verbs.h"

#include <algorithm>

#include "incise/mesh/star.h"

namespace incise::inline v0 {

namespace {

/// Positions of a tet with one corner replaced have positive volume.
bool is_positive_with(const TetMesh& mesh, TetId tet, unsigned corner, const Vec3& moved) {
  std::array<Vec3, 4> p;
  for (unsigned c = 0; c < 4; ++c) {
    p[c] = c == corner ? moved : mesh.rest(mesh.vertices(tet)[c]);
  }
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) > 0;
}

/// The boundary bits that a point of an edge inherits: those of the surfaces that both ends of the fan lie on.
std::uint8_t bits_of_ring(const TetMesh& mesh, const SplitEdgePlan& plan) {
  unsigned bits = 0;
  for (const TetId tet : plan.ring) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      const VertexId apex = mesh.vertices(tet)[s];
      if (apex != plan.a && apex != plan.b && link.is_boundary()) {
        bits |= link.tag() == 0 ? shape::kSkin : shape::kWall;
      }
    }
  }
  return static_cast<std::uint8_t>(bits);
}

class EdgeSplitter {
 public:
  EdgeSplitter(Transaction& transaction, const SplitEdgePlan& plan)
      : transaction_(transaction), mesh_(transaction.mesh()), plan_(plan) {}

  SplitEdgeResult run() {
    const std::uint8_t bits = bits_of_ring(mesh_, plan_);
    result_.vertex = transaction_.add_vertex_on_edge(plan_.a, plan_.b, plan_.t);
    transaction_.set_shape(result_.vertex, bits);
    for (const TetId tet : plan_.ring) {
      make_halves(tet);
    }
    for (const SplitHalves& halves : result_.halves) {
      link(halves);
    }
    for (const TetId tet : plan_.ring) {
      transaction_.remove_tet(tet);
    }
    return std::move(result_);
  }

 private:
  void make_halves(TetId tet) {
    TetVertices keeps_a = mesh_.vertices(tet), keeps_b = keeps_a;
    std::replace(keeps_a.begin(), keeps_a.end(), plan_.b, result_.vertex);
    std::replace(keeps_b.begin(), keeps_b.end(), plan_.a, result_.vertex);
    SplitHalves halves{tet, transaction_.add_tet(keeps_a, tet), transaction_.add_tet(keeps_b, tet)};
    for (const TetId half : {halves.keeps_a, halves.keeps_b}) {
      const TetVertices vertices = mesh_.vertices(half);
      for (const VertexId v : vertices) {
        transaction_.set_tet_of(v, half);
      }
    }
    result_.halves.push_back(halves);
  }
  void link(const SplitHalves& halves) {
    const unsigned a = mesh_.corner_of(halves.tet, plan_.a), b = mesh_.corner_of(halves.tet, plan_.b);
    transaction_.join({halves.keeps_a, a}, {halves.keeps_b, b});
    take_link({halves.keeps_a, b}, mesh_.links(halves.tet)[b]);
    take_link({halves.keeps_b, a}, mesh_.links(halves.tet)[a]);
    for (unsigned s = 0; s < 4; ++s) {
      if (s != a && s != b) {
        link_halved_side(halves, s);
      }
    }
  }
  void take_link(Side side, Link link) {
    if (link.is_boundary()) {
      transaction_.set_link(side, link);
    } else {
      transaction_.join(side, link.side());
    }
  }
  /// A side that contains the edge: its two parts face those of the ring neighbour, or the boundary.
  void link_halved_side(const SplitHalves& halves, unsigned side) {
    const Link link = mesh_.links(halves.tet)[side];
    if (link.is_boundary()) {
      transaction_.set_link({halves.keeps_a, side}, link);
      transaction_.set_link({halves.keeps_b, side}, link);
      return;
    }
    const TetId neighbour = link.side().tet();
    const auto other = std::find_if(result_.halves.begin(), result_.halves.end(),
                                    [&](const SplitHalves& h) { return h.tet == neighbour; });
    transaction_.set_link({halves.keeps_a, side}, Link(Side(other->keeps_a, link.side().side())));
    transaction_.set_link({halves.keeps_b, side}, Link(Side(other->keeps_b, link.side().side())));
  }

  Transaction& transaction_;
  const TetMesh& mesh_;
  const SplitEdgePlan& plan_;
  SplitEdgeResult result_;
};

}  // namespace

SplitEdgePlan plan_split_edge(const TetMesh& mesh, VertexId a, VertexId b, TetId seed, double t) {
  SplitEdgePlan plan{Refusal::kNone, a, b, t, {}};
  if (!mesh.is_live(seed) || !mesh.is_live(a) || !mesh.is_live(b)) {
    plan.refusal = Refusal::kDead;
  } else if (mesh.corner_of(seed, a) == 4 || mesh.corner_of(seed, b) == 4 || a == b) {
    plan.refusal = Refusal::kNotAnEdge;
  } else if (!(t > 0 && t < 1)) {
    plan.refusal = Refusal::kOutOfRange;
  }
  if (!plan) {
    return plan;
  }
  const Vec3 point = mesh.rest(a) + t * (mesh.rest(b) - mesh.rest(a));
  walk_edge_ring(mesh, a, b, seed, [](Side) { return false; }, [&](TetId tet) {
    plan.ring.push_back(tet);
    if (!is_positive_with(mesh, tet, mesh.corner_of(tet, a), point) ||
        !is_positive_with(mesh, tet, mesh.corner_of(tet, b), point)) {
      plan.refusal = Refusal::kWouldInvert;
    }
  });
  return plan;
}

SplitEdgeResult apply(Transaction& transaction, const SplitEdgePlan& plan) {
  return EdgeSplitter(transaction, plan).run();
}

DuplicateVertexPlan plan_duplicate_vertex(const TetMesh& mesh, VertexId vertex, std::vector<TetId> group) {
  DuplicateVertexPlan plan{Refusal::kNone, vertex, std::move(group)};
  for (const TetId tet : plan.group) {
    if (!mesh.is_live(tet)) {
      plan.refusal = Refusal::kDead;
      return plan;
    }
    if (mesh.corner_of(tet, vertex) == 4) {
      plan.refusal = Refusal::kOutOfRange;
      return plan;
    }
  }
  StarWalker walker;
  const std::vector<TetId>& star = walker.star(mesh, vertex);
  const bool has_rest = std::any_of(star.begin(), star.end(), [&](TetId tet) {
    return std::find(plan.group.begin(), plan.group.end(), tet) == plan.group.end();
  });
  if (plan.group.empty() || !has_rest) {
    plan.refusal = Refusal::kStarIsWhole;
  }
  return plan;
}

VertexId apply(Transaction& transaction, const DuplicateVertexPlan& plan, std::uint32_t tag) {
  const TetMesh& mesh = transaction.mesh();
  StarWalker walker;
  const std::vector<TetId> star = walker.star(mesh, plan.vertex);
  const auto is_in_group = [&](TetId tet) {
    return std::find(plan.group.begin(), plan.group.end(), tet) != plan.group.end();
  };
  for (const TetId tet : plan.group) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (mesh.vertices(tet)[s] != plan.vertex && !link.is_boundary() && !is_in_group(link.side().tet())) {
        transaction.open({tet, s}, link.side(), tag);
      }
    }
  }
  const VertexId twin = transaction.copy_vertex(plan.vertex);
  for (const TetId tet : plan.group) {
    transaction.set_corner(tet, mesh.corner_of(tet, plan.vertex), twin);
  }
  transaction.set_tet_of(twin, plan.group.front());
  const auto rest = std::find_if(star.begin(), star.end(), [&](TetId tet) { return !is_in_group(tet); });
  if (rest != star.end()) {
    transaction.set_tet_of(plan.vertex, *rest);
  }
  return twin;
}

}  // namespace incise::inline v0
