// SPDX-License-Identifier: Apache-2.0
// Plan first: place points, mark splits, block what would become unsound, until nothing changes. Then points,
// children, links, and the parents go (docs/internals.md, 3.12).
#include "paper/subdivide.h"

#include <algorithm>

#include "cut/bisection_order.h"
#include "incise/geom/predicates.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

namespace {

constexpr unsigned kFirstSplitCode = 4;
using Corners = std::array<Vec3, 4>;

int orientation(const Corners& p) {
  return orient3d(p[0], p[1], p[2], p[3]);
}

/// Whether a flagged edge needs a split point: neither end takes part in the cut itself.
bool needs_split(const NearTet& tet, unsigned edge) {
  const auto [a, b] = kEdgeCorners[edge];
  return ((unsigned{tet.flagged} >> edge) & 1U) != 0 && ((unsigned{tet.on} >> a) & 1U) == 0 &&
         ((unsigned{tet.on} >> b) & 1U) == 0;
}

void place_split_points(const TetMesh& mesh, EdgeTable& edges) {
  for (CutEdge& edge : edges.edges()) {
    if (edge.is_flagged()) {
      edge.is_blocked = mesh.touched_itself_at_load() && mesh.is_overshared_at_load(edge.a, edge.b);
      edge.t = edge.crossings.count > 1 ? 0.5 * (edge.crossings.t + edge.crossings.t_last) : edge.crossings.t;
      edge.position = mesh.rest(edge.a) + edge.t * (mesh.rest(edge.b) - mesh.rest(edge.a));
    }
  }
}

/// The planned edges of tets, first bisected first.
class PlannedOrder {
 public:
  explicit PlannedOrder(const TetMesh& mesh, const Neighbourhood& near) : mesh_(mesh), near_(near) {}
  [[nodiscard]] std::span<const std::uint8_t> of(const NearTet& tet) {
    order_.clear();
    for (std::uint8_t e = 0; e < 6; ++e) {
      const CutEdge& edge = near_.edges[tet.edges[e]];
      if (edge.is_planned) {
        order_.add((mesh_.rest(edge.b) - mesh_.rest(edge.a)).squaredNorm(), edge.a.value, edge.b.value, e);
      }
    }
    return order_.numbers();
  }

 private:
  const TetMesh& mesh_;
  const Neighbourhood& near_;
  BisectionOrder order_;
};

/// Marks the tets that the sheet cuts through and plans the splits that they need.
void plan_splits(Neighbourhood& near) {
  for (CutEdge& edge : near.edges.edges()) {
    edge.is_planned = false;
  }
  for (NearTet& tet : near.tets) {
    bool is_possible = true;
    for (unsigned e = 0; e < 6; ++e) {
      is_possible &= !(needs_split(tet, e) && near.edges[tet.edges[e]].is_blocked);
    }
    tet.is_cuttable = tet.is_complete && tet.flagged != 0 && is_possible;
    for (unsigned e = 0; e < 6; ++e) {
      CutEdge& edge = near.edges[tet.edges[e]];
      if (needs_split(tet, e) && !edge.is_blocked) {
        edge.is_planned = true;
      }
    }
  }
}

Vec3 position_of(std::uint8_t code, const TetMesh& mesh, const NearTet& tet, const Neighbourhood& near) {
  return code < kFirstSplitCode ? mesh.rest(mesh.vertices(tet.id)[code])
                                : near.edges[tet.edges[code - kFirstSplitCode]].position;
}

Corners corners_of(const SplitTemplate::Child& child, const TetMesh& mesh, const NearTet& tet,
                   const Neighbourhood& near) {
  Corners p;
  for (unsigned c = 0; c < 4; ++c) {
    p[c] = position_of(child[c], mesh, tet, near);
  }
  return p;
}

/// Whether a tet and all its children are sound.
bool children_are_sound(const SplitTemplate& split, const TetMesh& mesh, const NearTet& tet,
                        const Neighbourhood& near) {
  if (mesh.is_flat_at_load(tet.id)) {
    return false;  // it would become several
  }
  return std::all_of(split.children.begin(), split.children.end(), [&](const SplitTemplate::Child& child) {
    return orientation(corners_of(child, mesh, tet, near)) > 0;
  });
}

/// Blocks the planned edges of every tet that would get an unsound child. Returns how many.
std::uint64_t block_unsound(const TetMesh& mesh, SplitTemplates& templates, Neighbourhood& near) {
  std::uint64_t blocked = 0;
  PlannedOrder order(mesh, near);
  for (const NearTet& tet : near.tets) {
    const auto planned = order.of(tet);
    if (planned.empty() || children_are_sound(templates.find(planned), mesh, tet, near)) {
      continue;
    }
    for (const std::uint8_t e : planned) {
      CutEdge& edge = near.edges[tet.edges[e]];
      blocked += edge.is_blocked ? 0U : 1U;
      edge.is_blocked = true;
    }
  }
  return blocked;
}

// --- carrying out ----------------------------------------------------------------------------------------------------

class Subdivider {
 public:
  Subdivider(Transaction& transaction, SplitTemplates& templates, Neighbourhood& near)
      : transaction_(transaction), mesh_(transaction.mesh()), near_(near), templates_(templates) {}

  Subdivision run() {
    make_split_points();
    make_children();
    for (std::uint32_t i = 0; i < result_.parents.size(); ++i) {
      link_inner(i);
      for (unsigned s = 0; s < 4; ++s) {
        link_outer(i, s);
      }
    }
    remove_parents();
    return std::move(result_);
  }

 private:
  void make_split_points() {
    for (CutEdge& edge : near_.edges.edges()) {
      if (edge.is_planned) {
        edge.split = transaction_.add_vertex_on_edge(edge.a, edge.b, edge.t);
        near_.mark_on(edge.split);
        ++result_.new_vertices;
      }
    }
  }
  void make_children() {
    PlannedOrder order(mesh_, near_);
    subdivided_.assign(near_.tets.size(), kInvalidIndex);
    for (std::uint32_t n = 0; n < near_.tets.size(); ++n) {
      const auto planned = order.of(near_.tets[n]);
      if (planned.empty()) {
        continue;
      }
      const SplitTemplate& split = templates_.find(planned);
      subdivided_[n] = static_cast<std::uint32_t>(result_.parents.size());
      result_.parents.push_back(near_.tets[n].id);
      result_.first_child.push_back(static_cast<std::uint32_t>(result_.children.size()));
      splits_.push_back(&split);
      for (const SplitTemplate::Child& child : split.children) {
        result_.children.push_back(transaction_.add_tet(vertices_of(child, near_.tets[n]), near_.tets[n].id));
        for (const VertexId v : mesh_.vertices(result_.children.back())) {
          transaction_.set_tet_of(v, result_.children.back());
        }
      }
    }
    result_.first_child.push_back(static_cast<std::uint32_t>(result_.children.size()));
  }
  [[nodiscard]] TetVertices vertices_of(const SplitTemplate::Child& child, const NearTet& tet) const {
    TetVertices v;
    for (unsigned c = 0; c < 4; ++c) {
      v[c] = child[c] < kFirstSplitCode ? mesh_.vertices(tet.id)[child[c]]
                                        : near_.edges[tet.edges[child[c] - kFirstSplitCode]].split;
    }
    return v;
  }
  [[nodiscard]] Side side_of(std::uint32_t parent, SplitTemplate::ChildSide side) const {
    return {result_.children[result_.first_child[parent] + side / 4U], side & 3U};
  }
  void link_inner(std::uint32_t parent) {
    for (const auto& [a, b] : splits_[parent]->inner) {
      transaction_.join(side_of(parent, a), side_of(parent, b));
    }
  }
  void link_outer(std::uint32_t parent, unsigned side) {
    const auto& outer = splits_[parent]->outer[side];
    const Link link = mesh_.link({result_.parents[parent], side});
    if (link.is_boundary()) {
      for (const auto child_side : outer) {
        transaction_.set_link(side_of(parent, child_side), link);
        note_surface(side_of(parent, child_side), link.tag() == 0 ? shape::kSkin : shape::kWall);
      }
      return;
    }
    const std::uint32_t near_neighbour = near_.index_of_tet[link.side().tet().value];
    const std::uint32_t neighbour = near_neighbour == 0 ? kInvalidIndex : subdivided_[near_neighbour - 1];
    if (neighbour == kInvalidIndex) {
      transaction_.join(side_of(parent, outer[0]), link.side());
    } else if (parent < neighbour) {
      link_faces(parent, outer, neighbour, splits_[neighbour]->outer[link.side().side()]);
    }
  }
  /// The vertices of a boundary side lie on its surface; of these the split points do not know it yet.
  void note_surface(Side side, std::uint8_t bit) {
    for (const VertexId v : mesh_.vertices(side)) {
      if ((mesh_.shape_of(v) & bit) == 0) {
        transaction_.set_shape(v, static_cast<std::uint8_t>(mesh_.shape_of(v) | bit));
      }
    }
  }
  /// Pairs the parts of a face that two subdivided tets share.
  void link_faces(std::uint32_t parent, std::span<const SplitTemplate::ChildSide> outer, std::uint32_t neighbour,
                  std::span<const SplitTemplate::ChildSide> facing) {
    for (const auto child_side : outer) {
      const Side here = side_of(parent, child_side);
      for (const auto other_side : facing) {
        const Side there = side_of(neighbour, other_side);
        if (is_same_face(here, there)) {
          transaction_.join(here, there);
        }
      }
    }
  }
  [[nodiscard]] bool is_same_face(Side a, Side b) const {
    const auto u = mesh_.vertices(a), v = mesh_.vertices(b);
    return std::all_of(u.begin(), u.end(), [&](VertexId x) { return x == v[0] || x == v[1] || x == v[2]; });
  }
  void remove_parents() {
    for (const TetId parent : result_.parents) {
      transaction_.remove_tet(parent);
    }
  }

  Transaction& transaction_;
  const TetMesh& mesh_;
  Neighbourhood& near_;
  SplitTemplates& templates_;
  Subdivision result_;
  std::vector<std::uint32_t> subdivided_;     // by near tet: index into parents
  std::vector<const SplitTemplate*> splits_;  // by parent
};

}  // namespace

std::uint64_t plan_subdivision(const TetMesh& mesh, SplitTemplates& templates, Neighbourhood& neighbourhood) {
  place_split_points(mesh, neighbourhood.edges);
  std::uint64_t blocked = 0;
  plan_splits(neighbourhood);
  while (const std::uint64_t more = block_unsound(mesh, templates, neighbourhood)) {
    blocked += more;
    plan_splits(neighbourhood);
  }
  return blocked;
}

Subdivision subdivide(Transaction& transaction, SplitTemplates& templates, Neighbourhood& neighbourhood) {
  return Subdivider(transaction, templates, neighbourhood).run();
}

namespace {

bool is_incision(const TetMesh& mesh, const Neighbourhood& near, Side side) {
  const auto face = mesh.vertices(side);
  return !mesh.link(side).is_boundary() &&
         std::all_of(face.begin(), face.end(), [&](VertexId v) { return near.is_on[v.value] != 0; });
}

/// The faces around some vertices, those in `found` left out.
std::vector<IncisionFace> find_front_faces(const TetMesh& mesh, const Neighbourhood& near,
                                           std::span<const VertexId> front, const std::vector<IncisionFace>& found) {
  const auto lower = [](const IncisionFace& face) { return std::min(face.a, face.b); };
  std::vector<Side> known, sides;
  for (const IncisionFace& face : found) known.push_back(lower(face));
  std::sort(known.begin(), known.end());
  StarWalker walker;
  for (const VertexId v : front) {
    for (const TetId tet : walker.star(mesh, v)) {
      for (unsigned s = 0; s < 4; ++s) {
        const Side side(tet, s);
        if (is_incision(mesh, near, side)) sides.push_back(std::min(side, mesh.link(side).side()));
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  std::vector<IncisionFace> faces;
  for (const Side side : sides) {
    if (!std::binary_search(known.begin(), known.end(), side)) faces.push_back({side, mesh.link(side).side()});
  }
  return faces;
}

}  // namespace

std::vector<IncisionFace> find_paper_incision(const TetMesh& mesh, const Neighbourhood& neighbourhood,
                                              const Subdivision& subdivision, std::span<const VertexId> front) {
  std::vector<IncisionFace> found;
  const auto visit = [&](TetId tet, bool sees_far) {
    for (unsigned s = 0; s < 4; ++s) {
      const Side side(tet, s);
      if (!is_incision(mesh, neighbourhood, side)) continue;
      const Side other = mesh.link(side).side();
      if (side < other || (sees_far && neighbourhood.find(other.tet()) == nullptr)) found.push_back({side, other});
    }
  };
  for (const TetId child : subdivision.children) visit(child, false);
  for (const NearTet& tet : neighbourhood.tets) {
    if (mesh.is_live(tet.id)) visit(tet.id, true);
  }
  const std::vector<IncisionFace> more = find_front_faces(mesh, neighbourhood, front, found);
  found.insert(found.end(), more.begin(), more.end());
  return found;
}

}  // namespace v0
}  // namespace incise
