// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/improve/options.h"
#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"
#include "paper/held.h"
#include "paper/paper_quality.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// What a stage of the paper's maintenance works with: one mesh under one open transaction, what is held
/// of it, and what it has done.
class PaperStage {
 protected:
  PaperStage(Transaction& transaction, const Held& held)
      : transaction_(transaction), mesh_(transaction.mesh()), held_(held), meter_(transaction.mesh()) {}

  [[nodiscard]] MaintainStatistics done() {
    done_.work_units = meter_.evaluations();
    return done_;
  }

  Transaction& transaction_;
  const TetMesh& mesh_;
  const Held& held_;
  QualityMeter meter_;
  StarWalker walker_;
  MaintainStatistics done_;
};

}  // namespace paper
}  // namespace v0
}  // namespace incise
