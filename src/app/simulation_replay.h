// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/app/replay_job.h"

namespace incise::inline v0 {
namespace app {

/// `run_replay` of a simulation's recording. The mesh is given as it stands, deformed.
[[nodiscard]] Result<ReplayResult> run_simulation_replay(const ReplayJob& job);

}  // namespace app
}  // namespace incise::inline v0
