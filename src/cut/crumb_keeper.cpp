// SPDX-License-Identifier: Apache-2.0
// What a crumb is, asked of masters: `crumbs.cpp` knows tets and faces only. The size of a piece is compared to that of
// the masters around it, which are as the input's tets were, not to that of children, which are small beside any cut.
#include "cut/crumb_keeper.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

void CrumbKeeper::keep() {
  if (state_.settings.crumb_share == 0) return;
  memory_.dropped.clear();
  state_.done.crumbs_kept += keep_crumbs(state_.mesh, rules(), faces_.all(), memory_.dropped, memory_.scratch);
  for (const IncisionFace& face : memory_.dropped) {
    faces_.close(face);
    if (state_.settings.keeps_pieces) faces_.note_closed(face);
  }
}

CrumbRules CrumbKeeper::rules() {
  CrumbRules rules;
  rules.limit = [this](TetId tet) { return limit_at(tet); };
  rules.thin = state_.settings.thin;
  rules.stands_open = [this](const IncisionFace& face) { return faces_.stands_open(face); };
  const MaterialPieces& pieces = material_.pieces();
  if (pieces.has_several()) rules.are_apart = [&pieces](TetId a, TetId b) { return pieces.are_apart(a, b); };
  return rules;
}

/// The volume below which a piece around a tet is a crumb; 0 where the tet belongs to no master.
double CrumbKeeper::limit_at(TetId tet) const {
  const ClosedComplex& complex = state_.complex;
  const std::uint32_t index = complex.find(tet);
  if (index == Master::kNone) return 0.0;
  double sum = 0;
  for (const std::uint32_t e : complex[index].edges) {
    sum += (state_.mesh.rest(complex.edges()[e].b) - state_.mesh.rest(complex.edges()[e].a)).norm();
  }
  const double spacing = std::max(sum / 6.0, 0.5 * state_.settings.spacing);
  return state_.settings.crumb_share * spacing * spacing * spacing;
}

}  // namespace v0
}  // namespace incise
