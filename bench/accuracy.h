// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "blades.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::bench {

/// How well the cut walls of one stroke follow the sweep; lengths in units of h, the mesh's mean edge before the cut.
///
/// S is the sweep clipped to the body at rest, S_h the walls, one side counted. Every triangle of both is sampled at
/// 28 points, its corners among them.
struct Accuracy {
  double hausdorff = 0;   ///< the greater of both one-sided distances
  double mean = 0;        ///< the greater of both one-sided mean distances, weighted by area
  double area_error = 0;  ///< |area(S_h) − area(S)| / area(S)
  double sweep_area = 0;  ///< of S; squared length units
};

/// A body as it was before the cut: what sweeps are clipped to.
class Body {
 public:
  explicit Body(const TetMesh& mesh);
  /// The mean length of the edges, each counted once per tet that has it.
  [[nodiscard]] double mean_edge() const { return mean_edge_; }
  [[nodiscard]] double volume() const { return volume_; }
  /// The parts of triangles that lie in the body: triangles, three points each.
  [[nodiscard]] std::vector<std::array<Vec3, 3>> clip(const SweptTriangles& sweep) const;

 private:
  std::vector<std::array<Vec3, 4>> tets_;
  double mean_edge_ = 0;
  double volume_ = 0;
};

/// Measures the walls with tag `stroke_number`.
Accuracy measure_accuracy(const TetMesh& mesh, const Body& body, const Stroke& stroke, std::uint32_t stroke_number);

/// The rest volume of all tets, summed with more digits than a double has.
double total_volume(const TetMesh& mesh);

/// The pieces into which a plane divides a body: counted by joining the tets' parts on either side across faces,
/// without cutting anything. No vertex may lie on the plane.
std::size_t count_pieces_of_plane(const TetMesh& mesh, const Vec3& normal, double offset);

}  // namespace incise::bench
