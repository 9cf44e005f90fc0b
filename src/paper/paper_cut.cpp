// SPDX-License-Identifier: Apache-2.0
// The profile paper: what a stroke swept is cut part by part, each as a whole, by bisection and Algorithms 1 and 2
// (docs/internals.md, 3.12).
#include "paper/paper_cut.h"

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

#include "cut/constants.h"
#include "cut/cut_context.h"
#include "cut/pinched_edges.h"
#include "cut/spacing.h"
#include "cut/sweep.h"
#include "incise/mesh/verbs.h"
#include "paper/coincidence.h"
#include "paper/constants.h"
#include "paper/contact.h"
#include "paper/crossing.h"
#include "paper/dividable.h"
#include "paper/neighbourhood.h"
#include "paper/subdivide.h"

namespace incise {
inline namespace v0 {

namespace {

/// Cuts along a sheet as the paper does, after the fact: one part of a sweep.
class SheetCut {
 public:
  explicit SheetCut(unsigned threads) : threads_(threads) {}

  /// Appends up to two journal steps: the cut, and the repair of edges that two fans of tets share. Errors:
  /// kOutOfMemory where ids would run out. Cost: one pass over the mesh, then O(cut tets · rounds).
  Status cut(const CutContext& context, const Sheet& sheet, std::uint32_t tag);

 private:
  void find_contact(Transaction& transaction, const Sheet& sheet, StageTimes& times);
  void collide(Transaction& transaction, const Sheet& sheet);
  void bisect(Transaction& transaction, const CutEdge& edge, double t);
  Subdivision divide(Transaction& transaction, CutStatistics& statistics, StageTimes& times);
  void separate(Transaction& transaction, const Subdivision& subdivision, std::uint32_t tag, CutStatistics& statistics,
                StageTimes& times);
  void part_edges(const CutContext& context, const Subdivision& subdivision);

  unsigned threads_;
  Neighbourhood near_;
  SplitTemplates templates_;
  StarWalker walker_;
};

Status SheetCut::cut(const CutContext& context, const Sheet& sheet, std::uint32_t tag) {
  CutStatistics& statistics = context.statistics;
  const std::size_t tets_before = context.mesh.tet_count();
  Transaction transaction(context.mesh);
  find_contact(transaction, sheet, context.times);
  if (std::size_t{context.mesh.tet_slots()} + kMostChildren * near_.tets.size() >= TetMesh::kMaxTets) {
    return Error{ErrorCode::kOutOfMemory, "the cut would need more than 2^28 tets; use a coarser mesh", {}};
  }
  const std::size_t coincident = near_.on.size();
  const Subdivision subdivision = divide(transaction, statistics, context.times);
  separate(transaction, subdivision, tag, statistics, context.times);
  statistics.snapped_vertices += coincident;
  statistics.new_vertices += transaction.new_vertices().size();
  context.journal.append_if_changed(transaction.commit());
  part_edges(context, subdivision);
  statistics.created_tets += context.mesh.tet_count() - tets_before;
  return {};
}

void SheetCut::find_contact(Transaction& transaction, const Sheet& sheet, StageTimes& times) {
  const StageZone zone(times, Stage::kCollision);
  collide(transaction, sheet);
  mark_coincident(transaction.mesh(), sheet, near_, walker_);
}

Subdivision SheetCut::divide(Transaction& transaction, CutStatistics& statistics, StageTimes& times) {
  const StageZone zone(times, Stage::kSubdivide);
  statistics.blocked_edges += plan_subdivision(transaction.mesh(), templates_, near_);
  statistics.cut_tets += static_cast<std::uint64_t>(
      std::count_if(near_.tets.begin(), near_.tets.end(), [](const NearTet& tet) { return tet.is_cuttable; }));
  Subdivision subdivision = subdivide(transaction, templates_, near_);
  subdivision.incision = find_paper_incision(transaction.mesh(), near_, subdivision);
  return subdivision;
}

void SheetCut::separate(Transaction& transaction, const Subdivision& subdivision, std::uint32_t tag,
                        CutStatistics& statistics, StageTimes& times) {
  const StageZone zone(times, Stage::kSeparate);
  const Separation separation = separate_as_paper(transaction, subdivision.incision, tag, walker_);
  statistics.incision_faces += separation.opened_faces;
  statistics.latent_faces += separation.latent_faces;
  statistics.copied_vertices += separation.copied_vertices;
  statistics.pinched_edges += separation.pinched_edges;
}

void SheetCut::part_edges(const CutContext& context, const Subdivision& subdivision) {
  const StageZone zone(context.times, Stage::kSeparate);
  Transaction transaction(context.mesh);
  context.statistics.pinched_edges += part_pinched_edges(transaction, subdivision.incision, walker_);
  context.statistics.new_vertices += transaction.new_vertices().size();
  context.journal.append_if_changed(transaction.commit());
}

/// Finds the crossings of the mesh's edges with the sheet; edges crossed twice are bisected in between and retried.
void SheetCut::collide(Transaction& transaction, const Sheet& sheet) {
  const TetMesh& mesh = transaction.mesh();
  for (unsigned round = 0;; ++round) {
    find_crossings(mesh, sheet, find_near_tets(mesh, sheet, threads_), near_, threads_);
    const std::vector<DoublyCrossed> twice = find_doubly_crossed(mesh, sheet, near_, kGrazeShare);
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

/// The parts of a sweep that meet each other are cut one after the other, in the order of time.
Status cut_parts(const CutContext& context, const Stroke& stroke, std::uint32_t tag, unsigned threads) {
  SheetCut cut(threads);
  const double spacing = typical_spacing(context.mesh);
  const SweptSurface surface = sweep(stroke, kOwnSlit * spacing);
  for (const auto& part : split_at_self_crossings(surface, kPartOverlap * spacing, kCoincident * spacing)) {
    if (Status status = cut.cut(context, Sheet(surface, part), tag); !status) return status;
    ++context.statistics.sheets;
  }
  return {};
}

}  // namespace

Result<CutStatistics> cut_as_paper(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                                   unsigned threads, StageTimes& times) {
  if (Status status = check(stroke); !status) return status.error();
  const std::size_t start = journal.position();
  CutStatistics statistics;
  statistics.steps = stroke.times.size() - 1;
  Status status;
  try {
    status = cut_parts({mesh, journal, times, statistics}, stroke, tag, threads);
  } catch (const std::bad_alloc&) {
    status = Error{ErrorCode::kOutOfMemory, "not enough memory to cut; use a coarser mesh", {}};
  }
  if (status) return statistics;
  journal.take_back(mesh, start);
  return status.error();
}

}  // namespace v0
}  // namespace incise
