// SPDX-License-Identifier: Apache-2.0
// An edge of the surface has two boundary sides, the two ends of one fan of tets around it. Where it has more, or two
// ends of different fans, the fans touch along it while both ends of the edge stay whole: opened like that, the surface
// would be no manifold.
#include "cut/pinched_faces.h"

#include <algorithm>
#include <array>

#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

bool PinchedFaces::close() {
  memory_.sides.clear();
  if (!state_.settings.closes_pinched) return false;
  collect_edges();
  find_sides();
  if (memory_.sides.empty()) return false;
  std::vector<IncisionFace>& faces = faces_.all();
  std::size_t kept = 0;
  state_.done.left_pinched = 0;
  for (const IncisionFace& face : faces) {
    if (!is_pinched(face)) {
      faces[kept++] = face;
      continue;
    }
    for (const Side side : {face.a, face.b}) state_.complex[state_.complex.find(side.tet())].is_pinched = true;
    if (would_join_pieces(face)) {
      faces[kept++] = face;
      ++state_.done.left_pinched;
    } else {
      faces_.close(face);
    }
  }
  const bool has_closed = kept < faces.size();
  faces.resize(kept);
  return has_closed;
}

/// The edges of the noted boundary sides whose vertices were both looked at in this round, or one of them.
void PinchedFaces::collect_edges() {
  memory_.edges.clear();
  for (const Side side : separation_.surface()) {
    const auto v = state_.mesh.vertices(side);
    const std::array<bool, 3> is_near = {separation_.has_visited(v[0]), separation_.has_visited(v[1]),
                                         separation_.has_visited(v[2])};
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned next = (k + 1) % 3;
      if (is_near[k] || is_near[next]) memory_.edges.add(v[k], v[next], side);
    }
  }
}

/// The sides that have a pinched edge, ascending.
void PinchedFaces::find_sides() {
  const SurfaceEdges& edges = memory_.edges;
  for (const SurfaceEdges::Edge& edge : edges.all()) {
    if (edge.count < 2) continue;
    const SurfaceEdges::Use &last = edges.use(edge.last), &first = edges.use(last.before);
    if (edge.count == 2 && are_one_fan(edge, first.side, last.side)) continue;
    for (std::uint32_t use = edge.last; use != kInvalidIndex; use = edges.use(use).before) {
      memory_.sides.push_back(edges.use(use).side);
    }
  }
  std::sort(memory_.sides.begin(), memory_.sides.end());
}

/// Whether two boundary sides are the two ends of one fan of tets around an edge.
bool PinchedFaces::are_one_fan(const SurfaceEdges::Edge& edge, Side first, Side second) const {
  bool is_one = false;
  walk_edge_ring(
      state_.mesh, edge.a, edge.b, first.tet(), [](Side) { return false; },
      [&](TetId tet) { is_one |= tet == second.tet(); });
  return is_one;
}

/// Whether a face that something separates has a pinched edge.
bool PinchedFaces::is_pinched(const IncisionFace& face) const {
  const auto is_one = [&](Side side) { return std::binary_search(memory_.sides.begin(), memory_.sides.end(), side); };
  return !faces_.is_latent(face) && (is_one(face.a) || is_one(face.b));
}

/// Whether a face of the cut parts two pieces: no step joins them.
bool PinchedFaces::would_join_pieces(const IncisionFace& face) {
  MaterialPieces& pieces = material_.pieces();
  const TetId a = face.a.tet(), b = face.b.tet();
  if (pieces.knows(a) && pieces.knows(b)) return pieces.are_apart(a, b);
  return state_.settings.keeps_pieces && faces_.stands_open(face) && !pieces.hang_together(state_.mesh, a, b);
}

}  // namespace v0
}  // namespace incise
