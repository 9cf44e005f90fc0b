// SPDX-License-Identifier: Apache-2.0
// Moves are planned on the mesh as it was, made one after the other where no tet turns over, and faces are then chosen
// by the sides on which tets' centres lie.
#include "lab/snapping.h"

#include <algorithm>
#include <vector>

#include "incise/geom/predicates.h"
#include "incise/mesh/verbs.h"
#include "lab/constants.h"
#include "lab/opening.h"
#include "paper/contact.h"
#include "paper/crossing.h"

namespace incise {
inline namespace v0 {
namespace lab {

namespace {

/// A vertex that moves, and how far.
struct Snap {
  double distance2;
  VertexId vertex;
  Vec3 place;

  bool operator<(const Snap& other) const {
    return distance2 != other.distance2 ? distance2 < other.distance2 : vertex < other.vertex;
  }
};

std::vector<Snap> plan_snaps(const TetMesh& mesh, const Sheet& sheet, const Neighbourhood& near, double reach) {
  std::vector<VertexId> vertices;
  for (std::uint32_t i = 0; i < near.edges.size(); ++i) {
    const CutEdge& edge = near.edges[i];
    if (!edge.is_flagged()) continue;
    const bool is_first = edge.crossings.t <= 0.5;
    if ((is_first ? edge.crossings.t : 1 - edge.crossings.t) <= reach) vertices.push_back(is_first ? edge.a : edge.b);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<Snap> snaps;
  for (const VertexId v : vertices) {
    const TriangleTree::Hit hit = sheet.tree().closest(mesh.rest(v));
    if (hit.is_valid()) snaps.push_back({hit.distance2, v, hit.point});
  }
  std::sort(snaps.begin(), snaps.end());
  return snaps;
}

SosPoint centre_of(const TetMesh& mesh, TetId tet) {
  Vec3 sum = Vec3::Zero();
  for (const VertexId v : mesh.vertices(tet)) sum += mesh.rest(v);
  return {0.25 * sum, tet.value};
}

/// Whether the sheet passes an odd number of times between the centres of two tets.
bool is_between(const TetMesh& mesh, const Sheet& sheet, TetId first, TetId second) {
  const SosPoint p = centre_of(mesh, first), q = centre_of(mesh, second);
  bool is_odd = false;
  const Box box{p.position.cwiseMin(q.position), p.position.cwiseMax(q.position)};
  sheet.tree().for_each_overlap(box, [&](std::uint32_t t) {
    is_odd ^= segment_crosses_triangle(p, q, sheet.point(t, 0), sheet.point(t, 1), sheet.point(t, 2));
  });
  return is_odd;
}

std::vector<IncisionFace> find_faces(const TetMesh& mesh, const Sheet& sheet, const std::vector<TetId>& near) {
  std::vector<IncisionFace> faces;
  for (const TetId tet : near) {
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.links(tet)[s];
      if (link.is_boundary()) continue;
      const Side side(tet, s), other = link.side();
      const bool is_twice = other < side && std::binary_search(near.begin(), near.end(), other.tet());
      if (!is_twice && is_between(mesh, sheet, tet, other.tet())) faces.push_back({side, other});
    }
  }
  return faces;
}

}  // namespace

void move_onto(Transaction& transaction, const Sheet& sheet, const Neighbourhood& near, double reach,
               CutStatistics& statistics) {
  for (const Snap& snap : plan_snaps(transaction.mesh(), sheet, near, reach)) {
    const MoveVertexPlan plan = plan_move_vertex(transaction.mesh(), snap.vertex, snap.place);
    if (plan) apply(transaction, plan);
    ++(plan ? statistics.snapped_vertices : statistics.bent_vertices);
  }
}

Status snap_nodes(const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads) {
  const TetMesh& mesh = context.mesh;
  Neighbourhood near;
  find_crossings(mesh, sheet, find_near_tets(mesh, sheet, threads), near, threads);
  context.statistics.cut_tets += static_cast<std::uint64_t>(
      std::count_if(near.tets.begin(), near.tets.end(), [](const NearTet& tet) { return tet.flagged != 0; }));
  Transaction transaction(context.mesh);
  move_onto(transaction, sheet, near, kReachOfSnapping, context.statistics);
  const std::vector<IncisionFace> faces = find_faces(mesh, sheet, find_near_tets(mesh, sheet, threads));
  open_faces(transaction, faces, tag, context.statistics);
  commit(context, transaction, sides_of(faces));
  return {};
}

}  // namespace lab
}  // namespace v0
}  // namespace incise
