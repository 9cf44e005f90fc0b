// SPDX-License-Identifier: Apache-2.0
// One sheet, or one frame of it: collision, bisection, Algorithms 1 and 2 (docs/internals.md, 3.12).
#include "paper/sheet_cut.h"

#include <algorithm>
#include <vector>

#include "cut/constants.h"
#include "cut/pinched_edges.h"
#include "incise/mesh/verbs.h"
#include "paper/coincidence.h"
#include "paper/constants.h"
#include "paper/contact.h"
#include "paper/crossing.h"
#include "paper/dividable.h"
#include "paper/flat_tets.h"
#include "paper/paper_crumbs.h"
#include "paper/sheet_sides.h"

namespace incise {
inline namespace v0 {

Status SheetCut::cut(const CutContext& context, const SheetSoFar& sheet, std::uint32_t tag, IncisionFront& front,
                     Crumbs crumbs) {
  CutStatistics& statistics = context.statistics;
  const std::size_t tets_before = context.mesh.tet_count();
  Transaction transaction(context.mesh);
  statistics.snapped_vertices += find_contact(transaction, sheet, tag, front, context.times);
  if (std::size_t{context.mesh.tet_slots()} + kMostDivided * near_.tets.size() >= TetMesh::kMaxTets) {
    return Error{ErrorCode::kOutOfMemory, "the cut would need more than 2^28 tets; use a coarser mesh", {}};
  }
  Subdivision subdivision = divide(transaction, front, statistics, context.times);
  front.take(context.mesh, sheet.whole(), near_, walker_);
  keep_between_sides(context.mesh, front.own(), near_.coincidence, sheet, subdivision.incision);
  keep_flat_tets_joined(context.mesh, near_, front.own(), sheet.whole(), tag, walker_, subdivision.incision);
  if (crumbs == Crumbs::kStay) {
    statistics.crumbs_kept += keep_paper_crumbs(context.mesh, subdivision.incision, crumbs_);
  }
  separate(transaction, subdivision, tag, statistics, context.times);
  statistics.new_vertices += growth(0, transaction.new_vertices().size());
  if (context.journal.append_if_changed(transaction.commit())) {
    front.follow(context.mesh, sheet.strip(), context.journal.step(context.journal.position() - 1), walker_);
  }
  part_edges(context, sheet, subdivision, front);
  statistics.created_tets += growth(tets_before, context.mesh.tet_count());
  return {};
}

/// Returns how many vertices of the mesh lie on the sheet, those of the front not counted.
std::size_t SheetCut::find_contact(Transaction& transaction, const SheetSoFar& sheet, std::uint32_t tag,
                                   IncisionFront& front, StageTimes& times) {
  const StageZone zone(times, Stage::kCollision);
  collide(transaction, sheet, tag, front);
  const std::size_t marked = near_.on.size();
  mark_coincident(transaction.mesh(), sheet, near_, walker_);
  return near_.on.size() - marked;
}

Subdivision SheetCut::divide(Transaction& transaction, const IncisionFront& front, CutStatistics& statistics,
                             StageTimes& times) {
  const StageZone zone(times, Stage::kSubdivide);
  statistics.blocked_edges += plan_subdivision(transaction.mesh(), templates_, near_);
  statistics.cut_tets += static_cast<std::uint64_t>(
      std::count_if(near_.tets.begin(), near_.tets.end(), [](const NearTet& tet) { return tet.is_cuttable; }));
  Subdivision subdivision = subdivide(transaction, templates_, near_);
  divided_tets_ = subdivision.parents.size();
  std::vector<VertexId> left_joined;
  for (const CollisionPoint& point : front.own()) left_joined.push_back(point.vertex);
  subdivision.incision = find_paper_incision(transaction.mesh(), near_, subdivision, left_joined);
  return subdivision;
}

void SheetCut::separate(Transaction& transaction, const Subdivision& subdivision, std::uint32_t tag,
                        CutStatistics& statistics, StageTimes& times) {
  const StageZone zone(times, Stage::kSeparate);
  const Separation separation = separate_as_paper(transaction, subdivision.incision, tag, walker_);
  statistics.incision_faces += growth(0, separation.opened_faces);
  latent_faces_ = separation.latent_faces;
  statistics.copied_vertices += separation.copied_vertices;
  statistics.pinched_edges += separation.pinched_edges;
}

void SheetCut::part_edges(const CutContext& context, const SheetSoFar& sheet, const Subdivision& subdivision,
                          IncisionFront& front) {
  const StageZone zone(context.times, Stage::kSeparate);
  Transaction transaction(context.mesh);
  context.statistics.pinched_edges += part_pinched_edges(transaction, sides_of(subdivision.incision), walker_);
  context.statistics.new_vertices += growth(0, transaction.new_vertices().size());
  front.add(context.mesh, sheet.whole(), transaction.new_vertices(), walker_);
  context.journal.append_if_changed(transaction.commit());
}

/// The tets near a sheet, and those around some vertices; ascending.
std::vector<TetId> SheetCut::tets_near(const TetMesh& mesh, const Sheet& sheet, const std::vector<VertexId>& vertices) {
  std::vector<TetId> tets = find_near_tets(mesh, sheet, threads_);
  for (const VertexId v : vertices) {
    const std::vector<TetId>& star = walker_.star(mesh, v);
    tets.insert(tets.end(), star.begin(), star.end());
  }
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
  return tets;
}

/// Finds the crossings of the mesh's edges with the sheet, and the points of the front that lie on it; edges crossed
/// twice are bisected in between and retried. Tets around a bend of a sheet of many frames are crossed by the strips on
/// both sides of it: edges that bisection makes there may cross a strip that was cut before they were.
void SheetCut::collide(Transaction& transaction, const SheetSoFar& sheet, std::uint32_t tag, IncisionFront& front) {
  const TetMesh& mesh = transaction.mesh();
  for (unsigned round = 0;; ++round) {
    std::vector<VertexId> made = transaction.new_vertices();
    std::sort(made.begin(), made.end());
    find_crossings(mesh, sheet.strip(), tets_near(mesh, sheet.strip(), made), near_, threads_);
    if (!made.empty()) find_crossings_at(mesh, sheet.whole(), made, near_);
    front.mark(mesh, sheet, tag, near_, walker_);
    const std::vector<DoublyCrossed> twice = find_doubly_crossed(mesh, sheet.whole(), near_, kGrazeShare);
    if (twice.empty() || round == kMaxBisectionRounds) {
      return;
    }
    for (const DoublyCrossed& crossed : twice) {
      bisect(transaction, near_.edges[crossed.edge], crossed.t);
    }
  }
}

void SheetCut::bisect(Transaction& transaction, const CutEdge& edge, double t) {
  const TetMesh& mesh = transaction.mesh();
  if (mesh.is_overshared_at_load(edge.a, edge.b)) {
    return;
  }
  for (const TetId tet : walker_.star(mesh, edge.a)) {
    if (mesh.corner_of(tet, edge.b) < 4) {
      const SplitEdgePlan plan = plan_split_edge(mesh, edge.a, edge.b, tet, t);
      if (plan) {
        apply(transaction, plan);
      }
      return;
    }
  }
}

}  // namespace v0
}  // namespace incise
