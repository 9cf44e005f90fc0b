// SPDX-License-Identifier: Apache-2.0
// The whole way is tried first, then half of it, and so on.
#include "paper/paper_move.h"

#include <algorithm>

#include "improve/standing.h"
#include "incise/mesh/verbs.h"

namespace incise {
inline namespace v0 {
namespace paper {

namespace {

double worst_with(QualityMeter& meter, const std::vector<TetId>& star, VertexId vertex, const Vec3& place) {
  double worst = 0;
  for (const TetId tet : star) {
    worst = std::max(worst, meter.of_moved(tet, vertex, place));
  }
  return worst;
}

}  // namespace

bool move_towards(Transaction& transaction, VertexId vertex, const Vec3& target, QualityMeter& meter,
                  StarWalker& walker) {
  const TetMesh& mesh = transaction.mesh();
  const std::vector<TetId>& star = walker.star(mesh, vertex);
  const double limit = std::max(kBadShape, worst_with(meter, star, vertex, mesh.rest(vertex)));
  Vec3 way = target - mesh.rest(vertex);
  for (unsigned tries = 0; tries < kMoveTries; ++tries, way *= 0.5) {
    const Vec3 place = mesh.rest(vertex) + way;
    if (place == mesh.rest(vertex)) {
      return false;
    }
    if (!(worst_with(meter, star, vertex, place) <= limit)) {
      continue;
    }
    const MoveVertexPlan plan = plan_move_vertex(mesh, vertex, place);
    if (plan && may_move(mesh, vertex, place, star)) {
      apply(transaction, plan);
      return true;
    }
  }
  return false;
}

}  // namespace paper
}  // namespace v0
}  // namespace incise
