// SPDX-License-Identifier: Apache-2.0
// Where the load of a cutting edge sits in the tissue: on the vertices around its front, not on one tet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "incise/geom/vec.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/sim/tissue_point.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// A point of the front of a cut, and how far around it the tissue bears the edge.
struct FrontPoint {
  TissuePoint grip;          ///< the material just ahead of it
  Vec3 rest = Vec3::Zero();  ///< its place at rest
  double radius = 0;         ///< at rest, length unit
};

/// The vertices that bear an edge, each by a share of what its points bear.
///
/// A vertex at distance d from a point at rest has the weight (1 − d²/r²)² times the volume that it stands for. Tissue
/// is reached from the points through faces: what an older cut has parted bears nothing.
class ProcessZone {
 public:
  /// A vertex of it.
  struct Bearer {
    VertexId vertex;
    Vec3 rest = Vec3::Zero();    ///< tells a vertex from one that had its slot before
    double volume = 0;           ///< of its tets that were reached
    double limit = 0;            ///< N, that its spring bears
    double stiffness = 0;        ///< of its spring, N/m
    double lag = 0;              ///< by how much its spring is pressed, length unit
    Vec3 target = Vec3::Zero();  ///< of its spring, in this frame
    double slipped = 0;          ///< by how much its spring slipped in this frame, length unit
    double force = 0;            ///< of its spring, N
  };
  /// What a vertex bears of a point: of its load, weights add up to 1 for each point.
  struct Share {
    std::uint32_t point = 0, bearer = 0;
    double weight = 0;
  };

  /// Finds the zone of these points anew. Vertices that were in it keep the lags of their springs. Cost: O(tets within
  /// the radius), times the points.
  void find(const TetMesh& mesh, std::span<const FrontPoint> points);

  [[nodiscard]] std::vector<Bearer>& bearers() { return bearers_; }
  [[nodiscard]] const std::vector<Bearer>& bearers() const { return bearers_; }
  /// By points, in their order.
  [[nodiscard]] const std::vector<Share>& shares() const { return shares_; }
  /// Whether a bearer was not in the zone before.
  [[nodiscard]] bool is_fresh(std::size_t bearer) const { return is_fresh_[bearer]; }

 private:
  void reach(const TetMesh& mesh, std::span<const FrontPoint> points);
  void take(const TetMesh& mesh, TetId tet);
  void share_out(const FrontPoint& point, std::uint32_t index);
  void keep_lags(const std::vector<Bearer>& before);

  std::vector<Bearer> bearers_;
  std::vector<Share> shares_;
  std::vector<bool> is_fresh_;
  std::vector<TetId> reached_;
  std::vector<std::uint8_t> is_reached_;  // by tet, zero between calls
  std::vector<std::uint32_t> bearer_of_;  // by vertex, from 1, zero between calls
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
