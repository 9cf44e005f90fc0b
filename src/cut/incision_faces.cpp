// SPDX-License-Identifier: Apache-2.0
// Until it is opened, an incision face is a pair of sides whose links say "wall", and nothing else: to close it is to
// link the two sides again, and to take it out of the list.
#include "cut/incision_faces.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

IncisionFaces::IncisionFaces(RebuildState& state, Memory& memory) : state_(state), memory_(memory) {
  memory_.faces.clear();
  memory_.standing.clear();
  memory_.apart.clear();
  ++memory_.run;
}

void IncisionFaces::note_relinked(std::uint32_t master) {
  memory_.relinked.ensure(std::size_t{master} + 1);
  memory_.relinked[master] = memory_.run;
}

bool IncisionFaces::is_as_before(std::uint32_t master) const {
  const Master& m = state_.complex[master];
  const bool is_relinked = master < memory_.relinked.capacity() && memory_.relinked[master] == memory_.run;
  return (!m.is_dirty || m.is_kept) && !is_relinked;
}

void IncisionFaces::sort_standing() {
  std::sort(memory_.standing.begin(), memory_.standing.end());
}

bool IncisionFaces::stands_open(const IncisionFace& face) const {
  return std::binary_search(memory_.standing.begin(), memory_.standing.end(), face.a);
}

void IncisionFaces::note_apart(Side side) {
  const std::uint32_t master = state_.complex.find(side.tet());
  for (const VertexId v : state_.mesh.vertices(side)) memory_.apart.push_back({state_.complex.closed(v), master});
}

void IncisionFaces::note_closed(const IncisionFace& face) {
  for (const Side side : {face.a, face.b}) {
    const std::uint32_t master = state_.complex.find(side.tet());
    if (master != Master::kNone) state_.complex[master].has_latent_faces = true;
  }
}

bool IncisionFaces::is_latent(const IncisionFace& face) const {
  const auto u = state_.mesh.vertices(face.a), v = state_.mesh.vertices(face.b);
  return std::all_of(u.begin(), u.end(), [&](VertexId x) { return x == v[0] || x == v[1] || x == v[2]; });
}

}  // namespace v0
}  // namespace incise
