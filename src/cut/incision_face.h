// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// A face along which material will be separated: its two sides.
struct IncisionFace {
  Side a, b;
};

/// Both sides of some faces, face by face.
inline std::vector<Side> sides_of(std::span<const IncisionFace> faces) {
  std::vector<Side> sides;
  for (const IncisionFace& face : faces) sides.insert(sides.end(), {face.a, face.b});
  return sides;
}

}  // namespace v0
}  // namespace incise
