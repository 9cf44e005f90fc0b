// SPDX-License-Identifier: Apache-2.0
// Every verb in two parts: `plan` looks, tests exact signs and may refuse; `apply` replaces tets, links the parts to
// each other and to what was behind them, and cannot fail.
#include "incise/mesh/verbs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "incise/geom/predicates.h"
#include "incise/geom/quality.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

namespace {

using Corners = std::array<Vec3, 4>;

Corners rest_corners(const TetMesh& mesh, const TetVertices& v) {
  return {mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])};
}

/// Whether a tet is positive, by exact sign, with one corner elsewhere.
bool is_exactly_positive_with(const TetMesh& mesh, TetId tet, unsigned corner, const Vec3& moved) {
  Corners p = rest_corners(mesh, mesh.vertices(tet));
  p[corner] = moved;
  return orient3d(p[0], p[1], p[2], p[3]) > 0;
}

/// Whether a tet is flat, or inverted, with one corner elsewhere.
bool is_flat_with(const TetMesh& mesh, TetId tet, unsigned corner, const Vec3& moved) {
  Corners p = rest_corners(mesh, mesh.vertices(tet));
  p[corner] = moved;
  return v0::is_flat(p[0], p[1], p[2], p[3]);
}

/// Whether a corner's move takes a tet's volume: its sign, or all of it but rounding.
bool loses_volume(const TetMesh& mesh, TetId tet, VertexId vertex, const Vec3& moved) {
  const unsigned corner = mesh.corner_of(tet, vertex);
  const Vec3& old = mesh.rest(vertex);
  if (!is_exactly_positive_with(mesh, tet, corner, moved)) return is_exactly_positive_with(mesh, tet, corner, old);
  return is_flat_with(mesh, tet, corner, moved) && !is_flat_with(mesh, tet, corner, old);
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
    transaction_.note_consumed(plan_.ring);
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
    note_produced();
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
  void note_produced() {
    std::vector<TetId> tets, parents;
    for (const SplitHalves& halves : result_.halves) {
      tets.insert(tets.end(), {halves.keeps_a, halves.keeps_b});
      parents.insert(parents.end(), 2, halves.tet);
    }
    transaction_.note_produced(tets, parents, result_.vertex);
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
  walk_edge_ring(
      mesh, a, b, seed, [](Side) { return false; },
      [&](TetId tet) {
        plan.ring.push_back(tet);
        if (mesh.is_flat_at_load(tet) || !is_exactly_positive_with(mesh, tet, mesh.corner_of(tet, a), point) ||
            !is_exactly_positive_with(mesh, tet, mesh.corner_of(tet, b), point)) {
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
  if (!mesh.is_live(vertex)) {
    plan.refusal = Refusal::kDead;
    return plan;
  }
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

namespace {

double volume6(const Corners& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
}

template <std::size_t kCount>
bool are_inner_weights(const std::array<double, kCount>& weights) {
  double sum = 0;
  for (const double weight : weights) {
    if (!(weight > 0 && weight < 1)) {
      return false;
    }
    sum += weight;
  }
  return std::abs(sum - 1.0) <= 1e-12;
}

void note_parts(Transaction& transaction, const SplitParts& parts, VertexId born) {
  std::array<TetId, 4> tets;
  const std::array<TetId, 4> parents = {parts.tet, parts.tet, parts.tet, parts.tet};
  std::size_t count = 0;
  for (const TetId child : parts.children) {
    if (child.is_valid()) tets[count++] = child;
  }
  transaction.note_produced({tets.data(), count}, {parents.data(), count}, born);
}

/// Replaces a tet by its parts around a new vertex: one per corner of `corners`, a bit mask. The parts know each other
/// and what was behind the tet's sides, except behind the side that the vertex lies in. `born`: the vertex, where it is
/// the first of its splits.
SplitParts split_around(Transaction& transaction, TetId tet, unsigned corners, VertexId vertex, VertexId born) {
  const TetMesh& mesh = transaction.mesh();
  transaction.note_consumed({&tet, 1});
  const TetVertices old_vertices = mesh.vertices(tet);
  const TetLinks links = mesh.links(tet);
  SplitParts parts{tet, {}};
  for (unsigned c = 0; c < 4; ++c) {
    if (((corners >> c) & 1U) == 0) {
      continue;
    }
    TetVertices vertices = old_vertices;
    vertices[c] = vertex;
    parts.children[c] = transaction.add_tet(vertices, tet);
    for (const VertexId v : vertices) {
      transaction.set_tet_of(v, parts.children[c]);
    }
    if (links[c].is_boundary()) {
      transaction.set_link({parts.children[c], c}, links[c]);
    } else {
      transaction.join({parts.children[c], c}, links[c].side());
    }
    for (unsigned d = 0; d < c; ++d) {
      if (parts.children[d].is_valid()) {
        transaction.join({parts.children[c], d}, {parts.children[d], c});
      }
    }
  }
  transaction.remove_tet(tet);
  note_parts(transaction, parts, born);
  return parts;
}

/// The tet of the star that holds a rest point best, with the point's coordinates there. Where all are flat: no motion.
void locate(const TetMesh& mesh, const std::vector<TetId>& star, MoveVertexPlan& plan) {
  plan.basis = mesh.vertices(star.front());
  plan.weights = {};
  plan.weights[mesh.corner_of(star.front(), plan.vertex)] = 1.0;
  double greatest = -std::numeric_limits<double>::infinity();
  for (const TetId tet : star) {
    Corners p = rest_corners(mesh, mesh.vertices(tet));
    const double whole = volume6(p);
    if (!(whole > 0)) {
      continue;
    }
    std::array<double, 4> weights{};
    for (unsigned c = 0; c < 4; ++c) {
      std::swap(p[c], plan.rest);
      weights[c] = volume6(p) / whole;
      std::swap(p[c], plan.rest);
    }
    const double least = *std::min_element(weights.begin(), weights.end());
    if (least > greatest) {
      greatest = least;
      plan.basis = mesh.vertices(tet);
      plan.weights = weights;
    }
  }
}

}  // namespace

SplitFacePlan plan_split_face(const TetMesh& mesh, Side face, const std::array<double, 3>& weights) {
  SplitFacePlan plan{Refusal::kNone, face, weights};
  if (!mesh.is_live(face.tet())) {
    plan.refusal = Refusal::kDead;
  } else if (!are_inner_weights(weights)) {
    plan.refusal = Refusal::kOutOfRange;
  }
  if (!plan) {
    return plan;
  }
  const std::array<VertexId, 3> vertices = mesh.vertices(face);
  for (unsigned k = 0; k < 3; ++k) {
    plan.rest += weights[k] * mesh.rest(vertices[k]);
    plan.current += weights[k] * mesh.current(vertices[k]);
  }
  const Link behind = mesh.link(face);
  for (const VertexId v : vertices) {
    const bool is_sound = is_exactly_positive_with(mesh, face.tet(), mesh.corner_of(face.tet(), v), plan.rest);
    if (!is_sound ||
        (!behind.is_boundary() &&
         !is_exactly_positive_with(mesh, behind.side().tet(), mesh.corner_of(behind.side().tet(), v), plan.rest))) {
      plan.refusal = Refusal::kWouldInvert;
    }
  }
  return plan;
}

SplitFaceResult apply(Transaction& transaction, const SplitFacePlan& plan) {
  const TetMesh& mesh = transaction.mesh();
  const std::array<VertexId, 3> vertices = mesh.vertices(plan.face);
  const Link behind = mesh.link(plan.face);
  SplitFaceResult result;
  result.vertex = transaction.add_vertex(vertices, plan.weights, plan.rest, plan.current);
  const unsigned front_side = plan.face.side();
  if (behind.is_boundary()) {
    transaction.set_shape(result.vertex, behind.tag() == 0 ? shape::kSkin : shape::kWall);
    result.parts[0] =
        split_around(transaction, plan.face.tet(), 15U & ~(1U << front_side), result.vertex, result.vertex);
    for (const TetId child : result.parts[0].children) {
      if (child.is_valid()) {
        transaction.set_link({child, front_side}, behind);
      }
    }
    return result;
  }
  const unsigned back_side = behind.side().side();
  std::array<std::array<unsigned, 2>, 3> corners{};  // of each vertex of the face, in front and behind
  for (unsigned k = 0; k < 3; ++k) {
    corners[k] = {mesh.corner_of(plan.face.tet(), vertices[k]), mesh.corner_of(behind.side().tet(), vertices[k])};
  }
  result.parts[0] = split_around(transaction, plan.face.tet(), 15U & ~(1U << front_side), result.vertex, result.vertex);
  result.parts[1] = split_around(transaction, behind.side().tet(), 15U & ~(1U << back_side), result.vertex, {});
  for (const auto& [front, back] : corners) {
    transaction.join({result.parts[0].children[front], front_side}, {result.parts[1].children[back], back_side});
  }
  return result;
}

SplitTetPlan plan_split_tet(const TetMesh& mesh, TetId tet, const std::array<double, 4>& weights) {
  SplitTetPlan plan{Refusal::kNone, tet, weights};
  if (!mesh.is_live(tet)) {
    plan.refusal = Refusal::kDead;
  } else if (!are_inner_weights(weights)) {
    plan.refusal = Refusal::kOutOfRange;
  }
  if (!plan) {
    return plan;
  }
  for (unsigned c = 0; c < 4; ++c) {
    plan.rest += weights[c] * mesh.rest(mesh.vertices(tet)[c]);
    plan.current += weights[c] * mesh.current(mesh.vertices(tet)[c]);
  }
  for (unsigned c = 0; c < 4; ++c) {
    if (!is_exactly_positive_with(mesh, tet, c, plan.rest)) {
      plan.refusal = Refusal::kWouldInvert;
    }
  }
  return plan;
}

SplitTetResult apply(Transaction& transaction, const SplitTetPlan& plan) {
  const TetVertices vertices = transaction.mesh().vertices(plan.tet);
  SplitTetResult result;
  result.vertex = transaction.add_vertex(vertices, plan.weights, plan.rest, plan.current);
  result.parts = split_around(transaction, plan.tet, 15U, result.vertex, result.vertex);
  return result;
}

MoveVertexPlan plan_move_vertex(const TetMesh& mesh, VertexId vertex, const Vec3& rest) {
  MoveVertexPlan plan{Refusal::kNone, vertex, rest, {}, {}};
  if (!mesh.is_live(vertex)) {
    plan.refusal = Refusal::kDead;
  } else if (!rest.allFinite()) {
    plan.refusal = Refusal::kOutOfRange;
  } else if (!mesh.tet_of(vertex).is_valid() || (mesh.shape_of(vertex) & shape::kPinched) != 0) {
    plan.refusal = Refusal::kNoStar;
  }
  if (!plan) {
    return plan;
  }
  StarWalker walker;
  const std::vector<TetId>& star = walker.star(mesh, vertex);
  if (std::any_of(star.begin(), star.end(), [&](TetId tet) { return loses_volume(mesh, tet, vertex, rest); })) {
    plan.refusal = Refusal::kWouldInvert;
    return plan;
  }
  locate(mesh, star, plan);
  return plan;
}

void apply(Transaction& transaction, const MoveVertexPlan& plan) {
  transaction.move(plan.vertex, plan.rest, plan.basis, plan.weights);
}

}  // namespace v0
}  // namespace incise
