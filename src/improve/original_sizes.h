// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "incise/geom/vec.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// How long the edges of a body were, place by place, before anything changed it.
///
/// Cuts make edges shorter. What a surface may give way to is measured by the elements that the body came with, not by
/// those that happen to stand there now. Sizes belong to places at rest, not to vertices, so that nothing that is cut
/// or undone later changes them.
class OriginalSizes {
 public:
  /// Measures a mesh as it stands at rest, instead of what was measured before. Cost: O(vertices), about 0.2 µs each;
  /// 2 bytes each are kept.
  void measure(const TetMesh& mesh);
  /// The mean length of edges around a place at rest, within some four elements, in the mesh's unit; 0 where nothing
  /// was measured. Cost: O(1).
  [[nodiscard]] double at(const Vec3& place) const;

 private:
  /// A cube of the lattice of width 2^level.
  struct Cell {
    int level = 0;
    std::array<std::int64_t, 3> at{};
    friend bool operator==(const Cell& a, const Cell& b) { return a.level == b.level && a.at == b.at; }
  };
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  struct Mean {
    double sum = 0, count = 0;
  };

  static Cell cell_of(const Vec3& place, int level);
  [[nodiscard]] double beside(const Cell& cell) const;

  std::unordered_map<Cell, Mean, CellHash> means_;  // looked up, never iterated
  std::vector<int> levels_;                         // in use, the finest first
};

}  // namespace v0
}  // namespace incise
