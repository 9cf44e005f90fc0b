// SPDX-License-Identifier: Apache-2.0
// A wound may stand open while masters are made anew, so that what is new must find its place in what was there. The
// old children of each master are therefore kept as a range of images, with the links to what lies outside of all
// masters. The images outlive the tets, whose slots are used again within the same rebuild.
#include "cut/old_material.h"

namespace incise {
inline namespace v0 {

OldMaterial::OldMaterial(RebuildState& state, Memory& memory) : state_(state), memory_(memory) {
  memory_.ranges.clear();
  memory_.children.clear();
}

void OldMaterial::keep_all() {
  memory_.ranges.reserve(state_.dirty.size());
  for (const std::uint32_t index : state_.dirty) keep(index);
  if (state_.settings.keeps_pieces) find_pieces();
}

void OldMaterial::keep(std::uint32_t index) {
  Master& master = state_.complex[index];
  Range range{memory_.children.size(), 0, {}};
  state_.done.own_sides_before += state_.own_sides(master);
  for (const TetId child : state_.complex.children(master)) memory_.children.add(state_.mesh, child);
  range.last = memory_.children.size();
  for (unsigned s = 0; s < 4; ++s) {
    if (master.behind[s] == Master::kNone) range.outside[s] = state_.complex.outside(state_.mesh, master, s);
  }
  master.entry = static_cast<std::uint32_t>(memory_.ranges.size());
  memory_.ranges.push_back(range);
  master.is_pinched = master.has_latent_faces = false;
}

/// Finds of which pieces the material is, of the dirty masters and of the tets beside them, before anything changes.
void OldMaterial::find_pieces() {
  std::vector<TetId>& seeds = memory_.seeds;
  seeds.clear();
  for (std::uint32_t old = 0; old < memory_.children.size(); ++old) seeds.push_back(memory_.children.id(old));
  for (const std::uint32_t index : state_.dirty) {
    for (unsigned s = 0; s < 4; ++s) note_beside(state_.complex[index], s);
  }
  memory_.pieces.find(state_.mesh, seeds);
}

/// The tets behind a side of a dirty master, where these stay as they are.
void OldMaterial::note_beside(const Master& master, unsigned side) {
  const ClosedComplex& complex = state_.complex;
  const std::uint32_t behind = master.behind[side];
  if (behind == Master::kNone) {
    const Link link = complex.outside(state_.mesh, master, side);
    if (!link.is_boundary()) memory_.seeds.push_back(link.side().tet());
  } else if (!complex[behind].is_dirty) {
    for (const TetId child : complex.children(complex[behind])) memory_.seeds.push_back(child);
  }
}

void OldMaterial::hand_down(std::uint32_t old, TetId tet) {
  memory_.old_of.ensure(std::size_t{tet.value} + 1);
  memory_.old_of[tet.value] = old;
  memory_.pieces.follow(tet, memory_.children.id(old));
}

}  // namespace v0
}  // namespace incise
