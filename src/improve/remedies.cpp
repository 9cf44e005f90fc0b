// SPDX-License-Identifier: Apache-2.0
// The table of what maintenance tries on a tet.
#include "improve/remedies.h"

#include <algorithm>

#include "improve/close_merge.h"
#include "improve/edge_collapse.h"
#include "improve/edge_removal.h"
#include "improve/insertion.h"
#include "improve/peeling.h"
#include "improve/smooth.h"

namespace incise {
inline namespace v0 {

namespace {

/// Smooths the corners of a tet: the first that helps.
class CornerSmoother {
 public:
  bool improve(Care& care, TetId tet) {
    const TetVertices corners = care.mesh.vertices(tet);
    return std::any_of(corners.begin(), corners.end(), [&](VertexId v) { return smoother_.improve(care, v); });
  }

 private:
  Smoother smoother_;
};

}  // namespace

std::vector<Remedy> usual_remedies() {
  return {
      remedy_by<EdgeCollapser>(Stage::kMerge),
      remedy_by<EdgeRemover>(Stage::kImprove),
      remedy_by<FaceRemover>(Stage::kImprove),
      remedy_by<CornerSmoother>(Stage::kImprove),
      remedy_by<Peeler>(Stage::kImprove, Remedy::For::kBad),
      remedy_by<VertexInserter>(Stage::kImprove, Remedy::For::kBad),
      remedy_by<CloseMerger>(Stage::kMerge, Remedy::For::kBad),  // where nothing else helps
  };
}

bool Remedies::improve(Care& care, TetId tet, const MaintainOptions& options, StageTimes& times) const {
  for (auto next = remedies_.begin(); next != remedies_.end();) {
    const Stage stage = next->stage;
    const bool is_on = stage == Stage::kMerge ? options.merge : options.improve;
    const StageZone zone(times, stage);  // one for all that follow each other: clocks take time
    for (; next != remedies_.end() && next->stage == stage; ++next) {
      const bool is_for_it = next->which == Remedy::For::kAll || care.is_bad;
      if (is_on && is_for_it && next->improve(care, tet)) return true;
    }
  }
  return false;
}

}  // namespace v0
}  // namespace incise
