// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/geom/box.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// Finds the tets near a box in the rest shape. Tets may be put in, changed and taken out: O(1) each where they are
/// about as large as the mesh's edges were at first.
class TetGrid {
 public:
  /// All live tets of a mesh. Cost: O(tets).
  explicit TetGrid(const TetMesh& mesh);

  /// Sets a slot right that may have come, gone or changed its shape at rest.
  void update(const TetMesh& mesh, TetId tet);
  /// The box of a tet as it was last seen; empty where there is none.
  [[nodiscard]] Box box_of(TetId tet) const { return tet.value < boxes_.size() ? boxes_[tet.value] : Box(); }
  /// The tets whose boxes meet a box, ascending. Cost: O(cells + tets in them).
  void collect(const Box& box, std::vector<TetId>& tets) const;

 private:
  using Cell = std::array<std::int32_t, 3>;
  [[nodiscard]] Cell cell_at(const Vec3& point) const;
  template <class Visit>
  void for_each_cell(const Box& box, const Visit& visit) const;

  Vec3 low_;
  double cell_;
  Cell counts_{};
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<Box> boxes_;                    // by tet slot
  mutable std::vector<std::uint64_t> marks_;  // scratch: the query that last met a tet
  mutable std::uint64_t query_ = 0;
};

}  // namespace v0
}  // namespace incise
