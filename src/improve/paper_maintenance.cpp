// SPDX-License-Identifier: Apache-2.0
#include "incise/improve/paper_maintenance.h"

namespace incise::inline v0 {

MaintainStatistics maintain_as_paper(TetMesh&, Journal&, std::size_t, const MaintainOptions&, StageTimes&) {
  return {};
}

MaintainStatistics maintain_all_as_paper(TetMesh&, Journal&, const MaintainOptions&, StageTimes&) {
  return {};
}

}  // namespace incise::inline v0
