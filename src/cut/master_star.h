// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "cut/old_material.h"
#include "cut/star_parts.h"

namespace incise {
inline namespace v0 {

/// The number of a master's corner.
[[nodiscard]] inline unsigned corner_of(const Master& master, VertexId vertex) {
  const auto& corners = master.vertices;
  return static_cast<unsigned>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
}

/// Whether the cut ends in a side that has no front point, since an older cut is beside it: it ends at split points.
[[nodiscard]] bool ends_without_point(const Master& master);

/// The star of a closed vertex: the live tets around it, gathered from the masters that have it.
///
/// Reads the children of masters and their old material; changes nothing but itself. Each `gather` takes the place of
/// the one before, at the cost of O(star): a template knows which of its children have a vertex, so that no copies of
/// corners need be asked for.
class MasterStar {
 public:
  /// What is kept from run to run, for its storage.
  struct Memory {
    std::vector<StarTet> tets;
    std::vector<std::uint32_t> masters;
  };

  MasterStar(const RebuildState& state, const OldMaterial& material, Memory& memory)
      : state_(state), material_(material), memory_(memory) {}

  /// The star of a corner of `masters`, which are all that have it.
  void gather_corner(std::span<const std::uint32_t> masters, VertexId vertex);
  /// The star of the vertex that splits an edge.
  void gather_split_point(std::uint32_t edge);
  /// The star of a front point in a side.
  void gather_front_point(const FrontPoint& point);
  /// The star of the point inside a cone.
  void gather_middle(std::uint32_t master);

  [[nodiscard]] std::vector<StarTet>& tets() { return memory_.tets; }
  [[nodiscard]] const std::vector<StarTet>& tets() const { return memory_.tets; }
  /// Whether it is beside faces of the cut that were left joined.
  [[nodiscard]] bool is_beside_closed() const { return is_beside_closed_; }

 private:
  struct Codes;
  template <class CodesIn>
  void gather(std::span<const std::uint32_t> masters, CodesIn&& codes_in);
  void add(const Master& master, const Codes& codes);

  const RebuildState& state_;
  const OldMaterial& material_;
  Memory& memory_;
  bool is_beside_closed_ = false;
};

}  // namespace v0
}  // namespace incise
