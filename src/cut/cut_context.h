// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/core/profile.h"
#include "incise/cut/options.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// What every stage of a cut works on: the mesh, the journal that its steps are appended to, and the counts and times
/// of the call, which it adds to.
struct CutContext {
  TetMesh& mesh;
  Journal& journal;
  StageTimes& times;
  CutStatistics& statistics;
};

}  // namespace v0
}  // namespace incise
