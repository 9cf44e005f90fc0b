// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What is at a place of the surface.
struct ProbeInfo {
  TetId tet;
  TetVertices vertices{};
  std::int32_t region = 0;
  std::uint32_t stroke = 0;                           ///< that made the side; 0: skin, or no boundary
  bool is_inside = false;                             ///< the side is between two tets, seen because of a clip plane
  double lr = 0;                                      ///< at rest
  double dihedral_min_deg = 0, dihedral_max_deg = 0;  ///< at rest
  double volume = 0;                                  ///< at rest, length unit³
  double stretch = 1;                                 ///< volume as the body stands over volume at rest
  std::array<Eigen::Vector3f, 4> corners{};           ///< as the body stands
};
/// Looks at the tet behind a side of the surface; nothing where it is not live any more. Cost: O(1).
[[nodiscard]] std::optional<ProbeInfo> probe(const TetMesh& mesh, Side side);
/// Lines for people.
[[nodiscard]] std::vector<std::string> to_lines(const ProbeInfo& probe);

}  // namespace app
}  // namespace v0
}  // namespace incise
