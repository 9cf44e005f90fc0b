// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "cut/division.h"
#include "cut/old_material.h"

namespace incise {
inline namespace v0 {

/// Second stage of a rebuild: every dirty master gets the vertices that it is divided by, which are split points of its
/// edges, front points in its sides, and the point inside a cone; those that it needs no more are retired.
///
/// Reads the flags of the dirty masters and their old material. Changes the vertices that edges, front points and
/// masters of the complex name, and adds vertices to the mesh. Paper §2.2.
class MasterVertices {
 public:
  MasterVertices(RebuildState& state, SplitTemplates& templates, const OldMaterial& material)
      : state_(state), material_(material), divider_(state.mesh, templates, state.complex) {}

  /// Makes them all. Cost: O(dirty masters).
  void make();
  /// Removes what was retired, copies included, once no tet has it any more. Cost: O(retired).
  void bury_retired();

 private:
  void update_split_point(std::uint32_t index, unsigned e);
  void update_front_point(FrontPoint& point);
  void update_middle(std::uint32_t index);
  [[nodiscard]] VertexId taken_to(const Vec3& place, VertexId vertex, const std::array<std::uint32_t, 2>& masters);
  [[nodiscard]] std::uint32_t holder_of(const Vec3& rest, const std::array<std::uint32_t, 2>& masters) const;
  [[nodiscard]] MaterialPlace place_of(const Vec3& rest, const std::array<std::uint32_t, 2>& masters) const;

  RebuildState& state_;
  const OldMaterial& material_;
  Divider divider_;
};

}  // namespace v0
}  // namespace incise
