// SPDX-License-Identifier: Apache-2.0
// Faces of the cavity's hull and of the new tets are sorted by their vertices, and two of a kind meet: links need no
// case for each pattern.
#include "incise/mesh/remesh.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "incise/geom/predicates.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

namespace {

bool is_exactly_positive(const TetMesh& mesh, const TetVertices& v) {
  return orient3d(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])) > 0;
}

void require_positive(const TetMesh& mesh, RemeshPlan& plan) {
  for (const NewTet& tet : plan.produced) {
    if (!is_exactly_positive(mesh, tet.vertices)) {
      plan.refusal = Refusal::kWouldInvert;
    }
  }
}

bool has_one_region(const TetMesh& mesh, const std::vector<TetId>& tets) {
  return std::all_of(tets.begin(), tets.end(),
                     [&](TetId tet) { return mesh.region(tet) == mesh.region(tets.front()); });
}

/// A face of a cavity or of its filling: what must meet at it.
struct HalfFace {
  std::array<std::uint32_t, 3> key;  // vertex slots, ascending
  Side side;                         // a produced side, or that of the tet outside; invalid for a boundary
  Link link;                         // the tag, for a boundary

  bool operator<(const HalfFace& o) const { return key != o.key ? key < o.key : side < o.side; }
};

HalfFace half_face(const TetMesh& mesh, Side at, Side side, Link link) {
  const auto v = mesh.vertices(at);
  HalfFace face{{v[0].value, v[1].value, v[2].value}, side, link};
  std::sort(face.key.begin(), face.key.end());
  return face;
}

class Remesher {
 public:
  Remesher(Transaction& transaction, const RemeshPlan& plan, std::vector<TetId>& produced)
      : transaction_(transaction), mesh_(transaction.mesh()), plan_(plan), produced_(produced) {}

  void run() {
    transaction_.note_consumed(plan_.consumed);
    collect_hull();
    add_tets();
    join_faces();
    for (const TetId tet : plan_.consumed) {
      transaction_.remove_tet(tet);
    }
    anchor_vertices();
    transaction_.note_produced(produced_, parents_, plan_.born);
  }

 private:
  [[nodiscard]] bool is_consumed(TetId tet) const {
    return std::find(plan_.consumed.begin(), plan_.consumed.end(), tet) != plan_.consumed.end();
  }
  void collect_hull() {
    for (const TetId tet : plan_.consumed) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(tet)[s];
        if (link.is_boundary()) {
          faces_.push_back(half_face(mesh_, {tet, s}, {}, link));
        } else if (!is_consumed(link.side().tet())) {
          faces_.push_back(half_face(mesh_, {tet, s}, link.side(), {}));
        }
      }
    }
  }
  void add_tets() {
    produced_.clear();
    for (const NewTet& tet : plan_.produced) {
      parents_.push_back(plan_.consumed[tet.parent]);
      produced_.push_back(transaction_.add_tet(tet.vertices, parents_.back()));
      for (unsigned s = 0; s < 4; ++s) {
        faces_.push_back(half_face(mesh_, {produced_.back(), s}, {produced_.back(), s}, {}));
      }
    }
  }
  /// Two of a kind meet; a boundary face without a match has given way, and a produced one without a match is new.
  void join_faces() {
    std::sort(faces_.begin(), faces_.end());
    for (std::size_t i = 0; i < faces_.size();) {
      const bool has_match = i + 1 < faces_.size() && faces_[i].key == faces_[i + 1].key;
      if (has_match) {
        join(faces_[i], faces_[i + 1]);
      } else if (faces_[i].side.value != kInvalidIndex) {
        transaction_.set_link(faces_[i].side, Link::boundary(plan_.tag));
      }
      i += has_match ? 2 : 1;
    }
  }
  void join(const HalfFace& a, const HalfFace& b) {
    if (b.side.value == kInvalidIndex) {
      transaction_.set_link(a.side, b.link);  // a boundary's invalid side comes last
    } else {
      transaction_.join(a.side, b.side);
    }
  }
  void anchor_vertices() {
    for (const TetId tet : produced_) {
      for (const VertexId v : mesh_.vertices(tet)) {
        if (!mesh_.is_live(mesh_.tet_of(v))) {
          transaction_.set_tet_of(v, tet);
        }
      }
    }
  }

  Transaction& transaction_;
  const TetMesh& mesh_;
  const RemeshPlan& plan_;
  std::vector<TetId>& produced_;
  std::vector<TetId> parents_;
  std::vector<HalfFace> faces_;
};

/// The two corners of a tet that are not a or b, in the order that makes (a, b, first, second) positive.
std::array<VertexId, 2> across(const TetMesh& mesh, TetId tet, VertexId a, VertexId b) {
  const TetVertices& v = mesh.vertices(tet);
  const unsigned i = mesh.corner_of(tet, a), j = mesh.corner_of(tet, b);
  for (unsigned k = 0; k < 3; ++k) {
    // Seen from a, the other three turn as side i tells: clockwise, since that view is from inside.
    if (kSideCorners[i][k] == j) {
      return {v[kSideCorners[i][(k + 1) % 3]], v[kSideCorners[i][(k + 2) % 3]]};
    }
  }
  return {};
}

}  // namespace

RemeshPlan plan_swap_23(const TetMesh& mesh, Side face) {
  RemeshPlan plan;
  if (!mesh.is_live(face.tet())) {
    plan.refusal = Refusal::kDead;
    return plan;
  }
  const Link behind = mesh.link(face);
  if (behind.is_boundary() || mesh.region(face.tet()) != mesh.region(behind.side().tet())) {
    plan.refusal = Refusal::kOnSurface;
    return plan;
  }
  plan.consumed = {face.tet(), behind.side().tet()};
  const VertexId p = mesh.vertices(face.tet())[face.side()];
  const VertexId q = mesh.vertices(behind.side().tet())[behind.side().side()];
  const auto [x, y, z] = mesh.vertices(face);
  plan.produced = {{{x, y, p, q}, 0}, {{y, z, p, q}, 0}, {{z, x, p, q}, 1}};
  require_positive(mesh, plan);
  return plan;
}

RemeshPlan plan_swap_32(const TetMesh& mesh, VertexId a, VertexId b, TetId seed) {
  RemeshPlan plan;
  if (!mesh.is_live(seed) || mesh.corner_of(seed, a) == 4 || mesh.corner_of(seed, b) == 4 || a == b) {
    plan.refusal = Refusal::kNotAnEdge;
    return plan;
  }
  EdgeRing ring;
  find_edge_ring(mesh, a, b, seed, ring);
  if (!ring.is_closed || !has_one_region(mesh, ring.tets)) {
    plan.refusal = Refusal::kOnSurface;
  } else if (ring.tets.size() != 3) {
    plan.refusal = Refusal::kOutOfRange;
  } else {
    fill_edge_removal(mesh, a, b, ring, {{0, 1, 2}}, plan);
    require_positive(mesh, plan);
  }
  return plan;
}

void find_edge_ring(const TetMesh& mesh, VertexId a, VertexId b, TetId seed, EdgeRing& ring) {
  ring.tets.clear();
  ring.vertices.clear();
  ring.is_closed = false;
  // Back to the first tet of an open fan; a closed ring comes round to the seed.
  auto [in, out] = across(mesh, seed, a, b);
  TetId first = seed;
  for (Link link = mesh.links(first)[mesh.corner_of(first, out)]; !link.is_boundary();
       link = mesh.links(first)[mesh.corner_of(first, out)]) {
    first = link.side().tet();
    if (first == seed) break;
    out = std::exchange(in, mesh.vertices(first)[link.side().side()]);
  }
  std::tie(in, out) = std::tuple_cat(across(mesh, first, a, b));
  for (TetId tet = first;;) {
    if (across(mesh, tet, a, b) != std::array<VertexId, 2>{in, out}) {
      ring.tets.clear();  // the input overlaps itself here: the fan does not turn one way
      ring.vertices.clear();
      return;
    }
    ring.tets.push_back(tet);
    ring.vertices.push_back(in);
    const Link link = mesh.links(tet)[mesh.corner_of(tet, in)];
    if (link.is_boundary()) {
      ring.vertices.push_back(out);
      return;
    }
    tet = link.side().tet();
    if (tet == first) {
      ring.is_closed = true;
      return;
    }
    in = std::exchange(out, mesh.vertices(tet)[link.side().side()]);
  }
}

void fill_edge_removal(const TetMesh& mesh, VertexId a, VertexId b, const EdgeRing& ring,
                       const std::vector<RingTriangle>& triangles, RemeshPlan& plan) {
  plan.refusal = Refusal::kNone;
  plan.consumed = ring.tets;
  plan.produced.clear();
  for (const auto& [i, j, k] : triangles) {
    const VertexId p = ring.vertices[i], q = ring.vertices[j], r = ring.vertices[k];
    plan.produced.push_back({{a, p, q, r}, i});
    plan.produced.push_back({{p, q, r, b}, i});
  }
  if (!ring.is_closed) {
    plan.tag = mesh.links(ring.tets.front())[mesh.corner_of(ring.tets.front(), ring.vertices[1])].tag();
  }
}

void apply(Transaction& transaction, const RemeshPlan& plan, std::vector<TetId>& produced) {
  Remesher(transaction, plan, produced).run();
}

}  // namespace v0
}  // namespace incise
