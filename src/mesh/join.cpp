// SPDX-License-Identifier: Apache-2.0
// Points and tets behind each other, corners renumbered; labels are made up only where one of the two has some.
#include "incise/mesh/join.h"

namespace incise {
inline namespace v0 {

void append(const TetSoup& more, const Vec3& move, TetSoup& all) {
  const auto first = static_cast<std::uint32_t>(all.points.size());
  if (!all.regions.empty() || !more.regions.empty()) {
    all.regions.resize(all.tets.size(), 0);
    all.regions.insert(all.regions.end(), more.regions.begin(), more.regions.end());
  }
  for (const Vec3& point : more.points) all.points.push_back(point + move);
  for (std::array<std::uint32_t, 4> tet : more.tets) {
    for (std::uint32_t& corner : tet) corner += first;
    all.tets.push_back(tet);
  }
  if (!all.regions.empty()) all.regions.resize(all.tets.size(), 0);
}

}  // namespace v0
}  // namespace incise
