// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut/crumbs.h"
#include "cut/incision_faces.h"
#include "cut/old_material.h"

namespace incise {
inline namespace v0 {

/// Fifth stage of a rebuild: crumbs and shavings among the new children stay attached to the piece beside them.
///
/// Reads the links of the children, the sizes of their masters, and the pieces of the old material. Changes the faces:
/// those that a crumb hangs on are closed. **Source:** docs/internals.md (crumbs), docs/decisions/0012.
class CrumbKeeper {
 public:
  /// What is kept from run to run, for its storage.
  struct Memory {
    std::vector<IncisionFace> dropped;
    CrumbScratch scratch;
  };

  CrumbKeeper(RebuildState& state, OldMaterial& material, IncisionFaces& faces, Memory& memory)
      : state_(state), material_(material), faces_(faces), memory_(memory) {}

  /// Keeps all, where the settings say so. Cost: that of `keep_crumbs`.
  void keep();

 private:
  [[nodiscard]] CrumbRules rules();
  [[nodiscard]] double limit_at(TetId tet) const;

  RebuildState& state_;
  OldMaterial& material_;
  IncisionFaces& faces_;
  Memory& memory_;
};

}  // namespace v0
}  // namespace incise
