// SPDX-License-Identifier: Apache-2.0
// How far the skin of a cut and maintained mesh lies from where it was.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "incise/geom/triangle_tree.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::test {

/// The faces of skin of a mesh, by the slots of its vertices.
struct Skin {
  std::vector<Vec3> points;  ///< of all vertex slots
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<double> edge;  ///< by slot: the mean length of its edges in the skin; 0 where it is not on it

  explicit Skin(const TetMesh& mesh) : points(mesh.vertex_slots()), edge(mesh.vertex_slots(), 0.0) {
    std::vector<double> count(mesh.vertex_slots(), 0.0);
    mesh.for_each_vertex([&](VertexId v) { points[v.value] = mesh.rest(v); });
    mesh.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        if (mesh.links(tet)[s] != Link::boundary(0)) continue;
        const auto v = mesh.vertices(Side(tet, s));
        faces.push_back({v[0].value, v[1].value, v[2].value});
        for (unsigned k = 0; k < 3; ++k) {
          const double length = (mesh.rest(v[k]) - mesh.rest(v[(k + 1) % 3])).norm();
          for (const VertexId end : {v[k], v[(k + 1) % 3]}) {
            edge[end.value] += length;
            count[end.value] += 1;
          }
        }
      }
    });
    for (std::size_t i = 0; i < edge.size(); ++i) edge[i] = count[i] > 0 ? edge[i] / count[i] : 0.0;
  }
  [[nodiscard]] TriangleTree tree() const { return TriangleTree(points, faces); }
};

/// How far the vertices of one skin lie from another, as shares of their edges, ascending.
inline std::vector<double> shares_off(const Skin& skin, const TriangleTree& other) {
  std::vector<double> shares;
  for (std::size_t i = 0; i < skin.points.size(); ++i) {
    if (skin.edge[i] > 0) shares.push_back(std::sqrt(other.closest(skin.points[i]).distance2) / skin.edge[i]);
  }
  std::sort(shares.begin(), shares.end());
  return shares;
}

}  // namespace incise::test
