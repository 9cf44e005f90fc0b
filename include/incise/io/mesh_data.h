// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "incise/mesh/tet_soup.h"

namespace incise {
inline namespace v0 {
namespace io {

/// Names of regions, for people and for scenes. A region may have none, and there may be none of a name.
using RegionNames = std::map<std::int32_t, std::string>;

/// What a mesh file can carry: tets, faces, and labels. Optional arrays are empty where absent.
struct MeshData {
  TetSoup soup;                                         ///< points, tets, region per tet
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< `n_triangles × 3`, indices into `soup.points`
  std::vector<std::int32_t> triangle_stroke;            ///< `n_triangles` or empty; 0 = skin, else the stroke's
                                                        ///< number; a foreign file's own face label
  bool has_foreign_labels = false;                      ///< `triangle_stroke` are such labels, and no strokes
  std::vector<std::int32_t> piece;                      ///< `n_tets` or empty: face-connected piece
  std::vector<std::int32_t> origin_vertex;              ///< `n_points` or empty: vertex of the mesh before the cut
  std::vector<std::int32_t> cut_front;                  ///< `n_points` or empty: 1 where a cut ends at the vertex
  RegionNames region_names;                             ///< of the regions in `soup.regions`
};

/// Triangles without connectivity, as a surface file holds them; equal points are not merged.
struct SurfaceSoup {
  std::vector<Vec3> points;                             ///< `n_points`, in the file's length unit
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< `n_triangles × 3`, indices into `points`
  std::vector<std::array<double, 2>> texture;           ///< texture coordinates of an `.obj`
  /// `n_triangles × 3` or empty: indices into `texture`; `kInvalidIndex` for corners without.
  std::vector<std::array<std::uint32_t, 3>> texture_triangles;
  std::vector<Vec3> normals;                                   ///< normals of an `.obj`, of any length
  std::vector<std::array<std::uint32_t, 3>> normal_triangles;  ///< likewise, indices into `normals`
};

}  // namespace io
}  // namespace v0
}  // namespace incise
