// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "cut/incision_faces.h"
#include "cut/incision_table.h"
#include "cut/old_material.h"
#include "cut/strip.h"

namespace incise {
inline namespace v0 {

/// Fourth stage of a rebuild: links the children of the dirty masters to each other and to what is around them, and
/// finds the faces that the sheet passes.
///
/// Reads the children, the colours of their corners, the sheet, and the pieces of the old material. Changes the links
/// of children and of the tets beside them, where incision faces become walls; adds these to the faces, and skin and
/// wall to the shape of vertices. Paper §2.2, Figure 3; docs/internals.md (rebuild).
class MasterLinks {
 public:
  MasterLinks(RebuildState& state, const OwnSheet& sheet, OldMaterial& material, IncisionFaces& faces,
              IncisionTable& table)
      : state_(state), sheet_(sheet), material_(material), faces_(faces), table_(table) {}

  /// Links all dirty masters. Cost: O(dirty masters).
  void link();
  /// Links a master that became dirty last, with the children that it had: where they were left joined, crumbs that
  /// hang on the body, they stay so. Cost: O(its children).
  void link_last();

 private:
  void link(std::uint32_t index);
  void link_inner(const Master& master);
  void link_facets(const Master& master, unsigned side, const Master& other, unsigned other_side);
  void link_outside(std::uint32_t index, unsigned side, Link outside);
  void link_masters(std::uint32_t index, unsigned side, std::uint32_t behind);
  void meet(Side a, Side b, bool is_crossed);
  [[nodiscard]] bool stand_apart(Side a, Side b);
  void set_link(Side side, Link link);
  void note_surface(Side side, std::uint8_t bit);
  [[nodiscard]] bool lies_across(const Master& master, unsigned side, const Master& other, unsigned other_side) const;
  [[nodiscard]] bool is_beyond(VertexId from, const Master& master, unsigned side) const;

  RebuildState& state_;
  const OwnSheet& sheet_;
  OldMaterial& material_;
  IncisionFaces& faces_;
  IncisionTable& table_;
  bool keeps_joined_ = false;  // sides that are linked to each other
};

}  // namespace v0
}  // namespace incise
