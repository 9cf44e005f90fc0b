// SPDX-License-Identifier: Apache-2.0
// Edges of near tets in one table, each counted once and block by block on several threads; a tet is complete if all
// of its faces are even (docs/internals.md, 3.12).
#include "paper/crossing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cut/constants.h"
#include "cut/parity.h"
#include "incise/core/parallel.h"

namespace incise {
inline namespace v0 {

namespace {

/// Which vertices coincide with the sheet, each asked once.
class CoincidenceMemo {
 public:
  CoincidenceMemo(const TetMesh& mesh, const Sheet& sheet) : mesh_(mesh), sheet_(sheet), known_(mesh.vertex_slots()) {}
  /// The triangle that the vertex lies on, within `kCoincident` of `length`.
  std::optional<std::uint32_t> find(VertexId vertex, double length) {
    std::uint32_t& known = known_[vertex.value];
    if (known == 0) {
      const auto hit = sheet_.tree().closest(mesh_.rest(vertex), kCoincident * length);
      known = hit.is_valid() ? hit.triangle + 2 : 1;
    }
    return known == 1 ? std::nullopt : std::optional(known - 2);
  }

 private:
  const TetMesh& mesh_;
  const Sheet& sheet_;
  ZeroedArray<std::uint32_t> known_;  // 1 apart, 2 + triangle on it
};

std::uint8_t flags_of(const NearTet& tet, const EdgeTable& edges) {
  unsigned flags = 0;
  for (unsigned e = 0; e < 6; ++e) {
    flags |= static_cast<unsigned>(edges[tet.edges[e]].is_flagged()) << e;
  }
  return static_cast<std::uint8_t>(flags);
}

void collect(const TetMesh& mesh, const std::vector<TetId>& near, Neighbourhood& out) {
  out.clear(mesh);
  out.tets.reserve(near.size());
  for (const TetId id : near) {
    NearTet tet;
    tet.id = id;
    const TetVertices& v = mesh.vertices(id);
    for (unsigned e = 0; e < 6; ++e) {
      tet.edges[e] = out.edges.find_or_add(v[kEdgeCorners[e][0]], v[kEdgeCorners[e][1]]);
    }
    out.tets.push_back(tet);
    out.index_of_tet[id.value] = static_cast<std::uint32_t>(out.tets.size());
  }
}

void mark_by_parity(Neighbourhood& near) {
  for (NearTet& tet : near.tets) {
    tet.flagged = flags_of(tet, near.edges);
    tet.is_complete = !has_odd_face(tet.flagged);
  }
}

}  // namespace

void find_crossings(const TetMesh& mesh, const Sheet& sheet, const std::vector<TetId>& near, Neighbourhood& out,
                    unsigned threads) {
  collect(mesh, near, out);
  GrowArray<CutEdge>& edges = out.edges.edges();
  parallel_blocks(edges.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    SideSigns sides;
    sides.begin(mesh, sheet);
    for (std::size_t i = begin; i < end; ++i) {
      edges[i].crossings = find_crossings(mesh, sheet, sides, edges[i].a, edges[i].b);
    }
  });
  mark_by_parity(out);
}

void find_crossings_at(const TetMesh& mesh, const Sheet& sheet, const std::vector<VertexId>& vertices,
                       Neighbourhood& near) {
  const auto is_asked = [&](VertexId v) { return std::binary_search(vertices.begin(), vertices.end(), v); };
  SideSigns sides;
  sides.begin(mesh, sheet);
  for (CutEdge& edge : near.edges.edges()) {
    if (is_asked(edge.a) || is_asked(edge.b)) edge.crossings = find_crossings(mesh, sheet, sides, edge.a, edge.b);
  }
  mark_by_parity(near);
}

std::vector<DoublyCrossed> find_doubly_crossed(const TetMesh& mesh, const Sheet& sheet,
                                               const Neighbourhood& neighbourhood, double gap) {
  std::vector<DoublyCrossed> found;
  CoincidenceMemo coincidence(mesh, sheet);
  for (std::uint32_t i = 0; i < neighbourhood.edges.size(); ++i) {
    const CutEdge& edge = neighbourhood.edges[i];
    const bool lies_on_sheet = neighbourhood.is_on[edge.a.value] != 0 && neighbourhood.is_on[edge.b.value] != 0;
    if (edge.crossings.count == 0 || lies_on_sheet) continue;
    const auto coincident = [&](VertexId vertex, double length) { return coincidence.find(vertex, length); };
    const auto t = find_between(mesh, sheet, edge.a, edge.b, edge.crossings, gap, coincident);
    if (t.has_value()) found.push_back({i, *t});
  }
  return found;
}

}  // namespace v0
}  // namespace incise
