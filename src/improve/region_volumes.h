// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Whether all tets belong to one region.
template <class Tets>
bool has_one_region(const TetMesh& mesh, const Tets& tets) {
  return !mesh.has_regions() || std::all_of(tets.begin(), tets.end(),
                                            [&](TetId tet) { return mesh.region(tet) == mesh.region(*tets.begin()); });
}

/// How the volumes of regions depend on one of their vertices: each is linear in it. Six times volumes, and twice
/// areas, in the mesh's units.
class RegionVolumes {
 public:
  /// The directions in which the vertex changes a volume.
  struct Held {
    std::array<Vec3, 3> directions = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< orthonormal, as many as `count`
    std::array<double, 3> steps{};  ///< along them, which give all back that was lost
    unsigned count = 0;
  };

  /// Adds what one tet at the vertex has to do with its region: the gradient of six times its volume.
  void add(std::int32_t region, const Vec3& gradient) { add_to(at(region), gradient); }
  /// Notes that a region has lost six times this volume, or gained it where it is negative.
  void lose(std::int32_t region, double lost6) { at(region).lost6 += lost6; }
  /// Adds the volume under a surface, by twice its vector area: it is to be kept as that of a region is.
  void add_surface(const Vec3& area2, double lost6);

  /// What holds the vertex. Directions in which volumes change by rounding alone are left out. Cost: O(regions).
  [[nodiscard]] Held held() const;
  /// The shortest step that gives every region back what it lost; false where none gives all of it back but for
  /// rounding. Cost: O(regions).
  [[nodiscard]] bool find_step(Vec3& step) const;

 private:
  struct Row {
    std::int32_t region;
    bool is_surface;
    Vec3 gradient = Vec3::Zero();
    double lost6 = 0;
  };

  Row& at(std::int32_t region);
  void add_to(Row& row, const Vec3& gradient);

  std::vector<Row> rows_;
  double scale_ = 0;  // sum of the gradients' lengths: what rounding is measured by
};

}  // namespace v0
}  // namespace incise
