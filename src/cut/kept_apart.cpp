// SPDX-License-Identifier: Apache-2.0
// Tets beside what the steps touch are the same before and after: each piece of them must come from one alone
// (docs/internals.md, 3).
#include "cut/kept_apart.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

bool KeptApart::is_touched(TetId tet) const {
  return std::binary_search(touched_.begin(), touched_.end(), tet);
}

void KeptApart::look_after(const TetMesh& mesh, const Journal& journal, std::size_t first) {
  touched_.clear();
  beside_.clear();
  for (std::size_t i = first; i < journal.position(); ++i) {
    journal.step(i).for_each_tet_before([&](TetId tet) { touched_.push_back(tet); });
    for (const TetId tet : journal.step(i).new_tets) touched_.push_back(tet);
  }
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (const TetId tet : touched_) {
    if (!mesh.is_live(tet)) continue;
    for (const Link link : mesh.links(tet)) {
      if (!link.is_boundary() && !is_touched(link.side().tet())) beside_.push_back(link.side().tet());
    }
  }
  finder_.find(mesh, beside_);
  pieces_after_.clear();
  for (std::size_t i = 0; i < beside_.size(); ++i) pieces_after_.push_back(finder_.piece_of(i));
}

bool KeptApart::would_stay(const TetMesh& mesh) {
  std::vector<TetId> all = beside_;
  for (const TetId tet : touched_) {
    if (mesh.is_live(tet)) all.push_back(tet);
  }
  const std::uint32_t count = finder_.find(mesh, all);
  pieces_before_.assign(beside_.size(), kInvalidIndex);
  std::vector<bool> is_told_of(count, false);
  bool stay = true;
  for (std::size_t i = 0; i < beside_.size(); ++i) {
    std::uint32_t& before = pieces_before_[pieces_after_[i]];
    if (before == kInvalidIndex) before = finder_.piece_of(i);
    stay = stay && before == finder_.piece_of(i);
    is_told_of[finder_.piece_of(i)] = true;
  }
  return stay && std::all_of(is_told_of.begin(), is_told_of.end(), [](bool is_told) { return is_told; });
}

}  // namespace v0
}  // namespace incise
