// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/mesh/tet_mesh.h"
#include "paper/cut_edge.h"

namespace incise {
inline namespace v0 {

/// A tet near the blade.
struct NearTet {
  TetId id;
  std::array<std::uint32_t, 6> edges;  ///< into `Neighbourhood::edges`, by edge number
  std::uint8_t flagged = 0;            ///< bit e: the sheet crosses edge e an odd number of times
  std::uint8_t on = 0;                 ///< bit c: corner c takes part in the cut
  bool is_complete = true;             ///< every face has an even number of flagged edges
  bool is_cuttable = false;            ///< complete, crossed, and all that must be split can be
};

/// What a sheet does to the part of the mesh that it passes through. Filled anew for each sheet; keeps its memory.
struct Neighbourhood {
  EdgeTable edges;
  std::vector<NearTet> tets;
  ZeroedArray<std::uint32_t> index_of_tet;     ///< 0 far, 1 + index into `tets`
  ZeroedArray<std::uint8_t> is_on;             ///< by vertex slot: takes part in the cut; set by `mark_on`
  std::vector<VertexId> on;                    ///< the vertices so marked
  ZeroedArray<std::uint32_t> index_of_vertex;  ///< scratch of one stage at a time; all zero between stages
  double coincidence = 0.0;                    ///< within so much of the sheet, in length units, vertices were marked

  void mark_on(VertexId vertex) {
    is_on.ensure(std::size_t{vertex.value} + 1);
    is_on[vertex.value] = 1;
    on.push_back(vertex);
  }
  void clear(const TetMesh& mesh) {
    for (const NearTet& tet : tets) index_of_tet[tet.id.value] = 0;
    for (const VertexId vertex : on) is_on[vertex.value] = 0;
    edges.clear();
    tets.clear();
    on.clear();
    index_of_tet.ensure(mesh.tet_slots());
    is_on.ensure(mesh.vertex_slots());
    index_of_vertex.ensure(mesh.vertex_slots());
  }

  [[nodiscard]] const NearTet* find(TetId tet) const {
    const std::uint32_t index = tet.value < index_of_tet.capacity() ? index_of_tet[tet.value] : 0;
    return index == 0 ? nullptr : &tets[index - 1];
  }
  /// The edge of a near tet between two of its corners.
  [[nodiscard]] const CutEdge& edge(const NearTet& tet, unsigned a, unsigned b) const {
    return edges[tet.edges[kEdgeOfCorners[a][b]]];
  }
};

}  // namespace v0
}  // namespace incise
