// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise::inline v0 {

/// A mesh edge near the blade, with what the blade did to it. `a` has the lower slot.
struct CutEdge {
  VertexId a, b;
  std::uint32_t crossings = 0;        ///< by the sheet
  double t = 0.5;                     ///< of the first crossing, from a to b, in [0, 1]
  double t_second = 0.5;              ///< of the last crossing; the same where there is one
  std::uint32_t triangle = 0;         ///< of the sheet, crossed first
  std::uint32_t triangle_second = 0;  ///< crossed last
  VertexId split;                     ///< the vertex that splits it, once made
  Vec3 position = Vec3::Zero();       ///< of that vertex at rest
  bool is_planned = false;            ///< to be split
  bool is_blocked = false;            ///< splitting it would make a tet that is not sound

  [[nodiscard]] bool is_flagged() const { return (crossings & 1U) != 0; }
};

/// The edges of the tets near a blade, each once. Reusable: `clear` keeps the memory.
class EdgeTable {
 public:
  void clear();
  /// The index of the edge, added where it is new.
  std::uint32_t find_or_add(VertexId a, VertexId b);
  CutEdge& operator[](std::uint32_t index) { return edges_[index]; }
  const CutEdge& operator[](std::uint32_t index) const { return edges_[index]; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(edges_.size()); }
  [[nodiscard]] std::vector<CutEdge>& edges() { return edges_; }
  [[nodiscard]] const std::vector<CutEdge>& edges() const { return edges_; }

 private:
  void rehash(std::size_t capacity);

  std::vector<CutEdge> edges_;
  std::vector<std::uint32_t> slots_;  // 0 empty, 1 + index
};

}  // namespace incise::inline v0
