// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// What maintenance leaves as it is: the tets around the front of an incision that may go on, and their vertices. A
/// collision point that moved off the blade's sheet, or a vertex beside it that went to its other side, would leave a
/// bridge when the incision goes on. And the tets at vertices where the input touched itself. By default those alone.
class Held {
 public:
  Held() = default;
  /// `front`: live vertices, ascending. Cost: O(n log n) in the tets around them.
  Held(const TetMesh& mesh, std::vector<VertexId> front);

  /// Whether a vertex is part of the front, whose tets must stay. Cost: O(log).
  [[nodiscard]] bool is_front(VertexId vertex) const;
  /// Whether a vertex must stay. Cost: O(log).
  [[nodiscard]] bool holds(VertexId vertex) const;
  /// Whether a tet must stay. Cost: O(log).
  [[nodiscard]] bool holds(const TetMesh& mesh, TetId tet) const;

 private:
  std::vector<VertexId> front_, vertices_;  // ascending
};

}  // namespace paper
}  // namespace v0
}  // namespace incise
