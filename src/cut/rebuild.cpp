// SPDX-License-Identifier: Apache-2.0
// The pipeline of a rebuild. Each stage is a class of its own, which says what it reads and what it changes; stages
// share the state of the run, the old material and the incision faces. A stage calls no other: where closing pinched
// faces takes another master in, the pipeline leads that one through the stages behind it.
#include "cut/rebuild.h"

#include "cut/constants.h"
#include "cut/master_links.h"
#include "cut/master_vertices.h"

namespace incise {
inline namespace v0 {

class Rebuild::Run {
 public:
  Run(SplitTemplates& templates, Memory& memory, Transaction& transaction, ClosedComplex& complex,
      const OwnSheet& sheet, const Settings& settings)
      : state_(transaction, complex, settings),
        material_(state_, memory.material),
        faces_(state_, memory.faces),
        vertices_(state_, templates, material_),
        children_(state_, templates, material_, memory.children),
        links_(state_, sheet, material_, faces_, memory.table),
        crumbs_(state_, material_, faces_, memory.crumbs),
        separation_(state_, material_, faces_, memory.table, memory.stars),
        pinched_(state_, material_, faces_, separation_, memory.pinched),
        opening_(state_, faces_, separation_, memory.opening) {}

  RebuildStatistics run() {
    material_.keep_all();
    vertices_.make();
    children_.make();
    children_.remove_old();
    links_.link();
    crumbs_.keep();
    separation_.separate();
    for (unsigned round = 0; round < kMaxPinchRounds && close_pinched(); ++round) separation_.separate();
    opening_.open();
    for (const std::uint32_t index : state_.dirty) {
      state_.done.own_sides_after += state_.own_sides(state_.complex[index]);
    }
    vertices_.bury_retired();
    material_.forget_pieces();
    return state_.done;
  }

 private:
  /// Closes pinched faces, and looks at the masters beside them anew. Returns whether anything has changed.
  bool close_pinched() {
    bool has_changed = pinched_.close();
    for (const Side side : pinched_.sides()) has_changed |= take_in(side);
    return has_changed;
  }
  /// Makes the incision of the master that a wall belongs to part of the rebuild, where it was not: its children stay.
  bool take_in(Side side) {
    ClosedComplex& complex = state_.complex;
    const std::uint32_t index = complex.find(side.tet());
    if (!state_.settings.tags.own(state_.mesh.link(side)) || index == Master::kNone || complex[index].is_dirty ||
        complex.is_half_baked(index)) {
      return false;
    }
    complex.mark_dirty(index);
    material_.keep(index);
    children_.keep(index);
    links_.link_last();
    return true;
  }

  RebuildState state_;
  OldMaterial material_;
  IncisionFaces faces_;
  MasterVertices vertices_;
  MasterChildren children_;
  MasterLinks links_;
  CrumbKeeper crumbs_;
  VertexSeparation separation_;
  PinchedFaces pinched_;
  FaceOpening opening_;
};

RebuildStatistics Rebuild::run(Transaction& transaction, ClosedComplex& complex, const OwnSheet& sheet,
                               const Settings& settings) {
  std::vector<std::uint32_t>& dirty = complex.dirty();
  const RebuildStatistics done = Run(templates_, memory_, transaction, complex, sheet, settings).run();
  for (const std::uint32_t index : dirty) complex[index].is_dirty = false;
  dirty.clear();
  return done;
}

}  // namespace v0
}  // namespace incise
