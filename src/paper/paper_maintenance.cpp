// SPDX-License-Identifier: Apache-2.0
#include "paper/paper_maintenance.h"

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

/// The paper's pipeline behind the incision (Figure 1), around the vertices that count as divided.
MaintainStatistics maintain(TetMesh& mesh, Journal& journal, const std::vector<VertexId>& divided,
                            const MaintainOptions& options, StageTimes& times) {
  using namespace paper;
  const auto tets_before = static_cast<std::int64_t>(mesh.tet_count());
  MaintainStatistics done;
  if (mesh.touched_itself_at_load()) {
    return done;  // stars there are not whole: neither the paper's conditions nor the link condition see all of them
  }
  if (options.merge) {
    const StageZone zone(times, Stage::kMerge);
    const std::vector<TetId> tets = find_tets_at(mesh, divided);
    done += as_step(mesh, journal, [&](Transaction& t) { return merge_edges(t, tets); });
  }
  if (options.improve) {
    const StageZone zone(times, Stage::kImprove);
    const std::vector<VertexId> near = find_corners_of(mesh, find_tets_at(mesh, divided));
    if (options.smooth_boundary) {
      done += as_step(mesh, journal, [&](Transaction& t) { return smooth_boundary(t, divided); });
    }
    done += as_step(mesh, journal, [&](Transaction& t) { return smooth_inside(t, near); });
    const std::vector<TetId> tets = find_tets_at(mesh, divided);
    done += as_step(mesh, journal, [&](Transaction& t) { return swap_faces(t, tets); });
  }
  done.created_tets = static_cast<std::int64_t>(mesh.tet_count()) - tets_before;
  return done;
}

}  // namespace

MaintainStatistics maintain_as_paper(TetMesh& mesh, Journal& journal, std::size_t first_step,
                                     const MaintainOptions& options, StageTimes& times) {
  return maintain(mesh, journal, paper::find_divided_vertices(mesh, journal, first_step), options, times);
}

MaintainStatistics maintain_all_as_paper(TetMesh& mesh, Journal& journal, const MaintainOptions& options,
                                         StageTimes& times) {
  return maintain(mesh, journal, paper::find_all_vertices(mesh), options, times);
}

}  // namespace v0
}  // namespace incise
