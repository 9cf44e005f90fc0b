// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cut/division.h"
#include "cut/old_material.h"

namespace incise {
inline namespace v0 {

/// Third stage of a rebuild: the dirty masters are divided anew, each by its template; those that would come out as
/// they are keep their children.
///
/// Reads the vertices of the dirty masters and their old material. Changes the children of masters, and adds tets to
/// the mesh, which are not linked yet; hands the old material down to them. Paper §2.2, Figure 2.
class MasterChildren {
 public:
  /// What is kept from run to run, for its storage.
  struct Memory {
    std::vector<TetId> children;                           // of the master at hand
    std::array<VertexId, SplitTemplate::kCodes> vertices;  // by code, of its template
  };

  MasterChildren(RebuildState& state, SplitTemplates& templates, OldMaterial& material, Memory& memory)
      : state_(state), material_(material), divider_(state.mesh, templates, state.complex), memory_(memory) {}

  /// Makes the children of all dirty masters. Cost: O(dirty masters).
  void make();
  /// Removes the old children of the masters that have new ones. Cost: O(old children).
  void remove_old();
  /// Lets a dirty master keep the children that it has. Cost: O(its children).
  void keep(std::uint32_t index);

 private:
  void make(std::uint32_t index);
  [[nodiscard]] bool is_divided_so(const Master& master, const SplitTemplate& split) const;
  void find_vertices(const Master& master, const SplitTemplate& split);
  [[nodiscard]] VertexId vertex_of(const Master& master, std::uint8_t code) const;

  RebuildState& state_;
  OldMaterial& material_;
  Divider divider_;
  Memory& memory_;
};

}  // namespace v0
}  // namespace incise
