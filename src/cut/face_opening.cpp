// SPDX-License-Identifier: Apache-2.0
// Two sides with the same three vertices are one face, however the sheet passes: to open it would part nothing. Such a
// face is found among the incision faces, and among walls that were opened before, by their vertices.
#include "cut/face_opening.h"

#include <algorithm>

namespace incise {
inline namespace v0 {

void FaceOpening::open() {
  std::vector<IncisionFace>& faces = faces_.all();
  std::size_t kept = 0;
  for (const IncisionFace& face : faces) {
    if (faces_.is_latent(face)) {
      close_latent(face);
    } else {
      state_.transaction.open(face.a, face.b, state_.settings.tags.last);
      faces[kept++] = face;
    }
  }
  faces.resize(kept);
  join_latent_walls();
}

void FaceOpening::close_latent(const IncisionFace& face) {
  faces_.close(face);
  faces_.note_closed(face);
  ++state_.done.latent_faces;
}

/// Joins faces of the cut that are not rebuilt and that nothing separates any more.
void FaceOpening::join_latent_walls() {
  collect_walls();
  const auto& walls = memory_.walls;
  for (std::size_t i = 0; i + 1 < walls.size(); ++i) {
    if (walls[i].first != walls[i + 1].first) continue;
    if (!is_opened_now(walls[i].second)) close_latent({walls[i].second, walls[i + 1].second});
  }
}

/// The walls of the incision on the noted surface, in the order of their vertices; most that have no match are left
/// out.
void FaceOpening::collect_walls() {
  auto& walls = memory_.walls;
  walls.clear();
  std::array<std::uint8_t, 1024> counts{};  // of walls by a hash of their vertices: most have no match
  const auto count_of = [&](Side side) -> std::uint8_t& {
    const auto v = state_.mesh.vertices(side);
    return counts[((v[0].value + v[1].value + v[2].value) * 0x9E3779B9U) >> 22U];
  };
  const auto is_wall = [&](Side side) { return state_.settings.tags.own(state_.mesh.link(side)); };
  for (const Side side : separation_.surface()) {
    if (!is_wall(side)) continue;
    std::uint8_t& count = count_of(side);
    count = static_cast<std::uint8_t>(std::min(2, count + 1));
  }
  for (const Side side : separation_.surface()) {
    if (!is_wall(side) || count_of(side) < 2) continue;
    auto v = state_.mesh.vertices(side);
    std::sort(v.begin(), v.end());
    walls.emplace_back(v, side);
  }
  std::sort(walls.begin(), walls.end());
}

bool FaceOpening::is_opened_now(Side side) const {
  const std::vector<IncisionFace>& faces = faces_.all();
  return std::any_of(faces.begin(), faces.end(),
                     [&](const IncisionFace& face) { return face.a == side || face.b == side; });
}

}  // namespace v0
}  // namespace incise
