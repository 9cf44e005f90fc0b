// SPDX-License-Identifier: Apache-2.0
// Merging, Boundary Laplacian, Smart Laplacian and Face Swapping, each a journal step of its own; vertices that a
// front holds wait for the next call (docs/paper_map.md, sections 2.5 and 3).
#include "paper/paper_maintenance.h"

#include <algorithm>

#include "paper/face_swap.h"
#include "paper/paper_boundary_laplacian.h"
#include "paper/paper_merge.h"
#include "paper/paper_region.h"
#include "paper/smart_laplacian.h"

namespace incise {
inline namespace v0 {

namespace {

/// One stage as a journal step of its own, unless it changed nothing.
template <class Stage>
MaintainStatistics as_step(TetMesh& mesh, Journal& journal, Stage&& stage) {
  Transaction transaction(mesh, /*keeps_edits=*/true);
  const MaintainStatistics done = stage(transaction);
  journal.append_if_changed(transaction.commit());
  return done;
}

/// The paper's pipeline behind the incision (Figure 1), around the vertices that count as divided; edges are merged
/// around those of them that are `unmerged`.
MaintainStatistics maintain(TetMesh& mesh, Journal& journal, const std::vector<VertexId>& divided,
                            const std::vector<VertexId>& unmerged, const paper::Held& held,
                            const MaintainOptions& options, StageTimes& times) {
  using namespace paper;
  const auto tets_before = static_cast<std::int64_t>(mesh.tet_count());
  MaintainStatistics done;
  if (mesh.overlaps_at_load()) return done;  // what lies around an edge cannot be told there
  if (options.merge) {
    const StageZone zone(times, Stage::kMerge);
    const std::vector<TetId> tets = find_tets_at(mesh, unmerged);
    done += as_step(mesh, journal, [&](Transaction& t) { return merge_edges(t, tets, {}, held); });
  }
  if (options.improve) {
    const StageZone zone(times, Stage::kImprove);
    const std::vector<VertexId> near = find_corners_of(mesh, find_tets_at(mesh, divided));
    if (options.smooth_boundary) {
      done += as_step(mesh, journal, [&](Transaction& t) { return smooth_boundary(t, divided, held); });
    }
    done += as_step(mesh, journal, [&](Transaction& t) { return smooth_inside(t, near, held); });
    const std::vector<TetId> tets = find_tets_at(mesh, divided);
    done += as_step(mesh, journal, [&](Transaction& t) { return swap_faces(t, tets, held); });
  }
  done.created_tets = static_cast<std::int64_t>(mesh.tet_count()) - tets_before;
  return done;
}

}  // namespace

MaintainStatistics maintain_as_paper(TetMesh& mesh, Journal& journal, std::size_t first_step,
                                     const MaintainOptions& options, StageTimes& times) {
  const std::vector<VertexId> divided = paper::find_divided_vertices(mesh, journal, first_step);
  return maintain(mesh, journal, divided, divided, {}, options, times);
}

MaintainStatistics maintain_all_as_paper(TetMesh& mesh, Journal& journal, const MaintainOptions& options,
                                         StageTimes& times) {
  const std::vector<VertexId> all = paper::find_all_vertices(mesh);
  return maintain(mesh, journal, all, all, {}, options, times);
}

void PaperMaintainer::take_up(std::size_t first_step) {
  first_step_ = std::min(first_step_, first_step);
}

MaintainStatistics PaperMaintainer::run(TetMesh& mesh, Journal& journal, const std::vector<VertexId>& front,
                                        const MaintainOptions& options, StageTimes& times) {
  std::vector<VertexId> divided = paper::find_live(mesh, waiting_), unmerged = paper::find_live(mesh, unmerged_);
  if (has_work()) {
    const std::vector<VertexId> more = paper::find_divided_vertices(mesh, journal, first_step_);
    divided.insert(divided.end(), more.begin(), more.end());
    unmerged.insert(unmerged.end(), more.begin(), more.end());
  }
  for (std::vector<VertexId>* list : {&divided, &unmerged}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  const paper::Held held(mesh, front);
  first_step_ = kNothing;
  const MaintainStatistics done = maintain(mesh, journal, divided, unmerged, held, options, times);
  waiting_.clear();
  unmerged_.clear();
  for (const VertexId v : divided) {
    if (!mesh.is_live(v) || !held.holds(v)) continue;
    waiting_.emplace_back(v, mesh.generation(v));
    if (held.is_front(v)) unmerged_.emplace_back(v, mesh.generation(v));
  }
  return done;
}

void PaperMaintainer::forget() {
  first_step_ = kNothing;
  waiting_.clear();
  unmerged_.clear();
}

}  // namespace v0
}  // namespace incise
