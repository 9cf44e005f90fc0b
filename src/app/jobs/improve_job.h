// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "app/jobs/cut_job.h"

namespace incise {
inline namespace v0 {
namespace app {

/// How a mesh is maintained, and by what it is bounded.
struct ImproveJob {
  EngineOptions engine;  ///< what it says about cutting plays no part, but for the profile
  /// Microseconds for the work, at most `kMaxBudgetUs`; finding the tets that need it is not counted. 0: no clock,
  /// `engine.maintain.work_units` are the budget. The paper's maintenance is never bounded.
  std::uint64_t budget_us = 0;
  StageSink stage = {};  ///< called as each stage begins, and between two operations of one; may be empty
};

/// Maintains a whole loaded mesh, cut or not, and measures it before and after: `quality_cut` is as `quality_before`.
///
/// @param loaded      as `io::load_mesh` gave it.
/// @param wants_mesh  whether `JobResult::mesh` is filled.
/// @return the report, and the mesh at rest as it is after its maintenance.
/// Errors: as `Engine::create`. Cost: the maintenance, plus about 3 µs per tet.
[[nodiscard]] Result<JobResult> run_improve(io::LoadedMesh loaded, const ImproveJob& job, bool wants_mesh);

}  // namespace app
}  // namespace v0
}  // namespace incise
