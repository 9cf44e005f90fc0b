// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/jobs/replay_job.h"
#include "app/recording/simulation_recording.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The model of a recording's scene, checked to be the one. Errors: as `load_model`; kBadFile where it is another one.
[[nodiscard]] Result<io::LoadedMesh> load_recorded_model(const SimulationHeader& header);

/// `run_replay` of a simulation's recording. The mesh is given as it stands, deformed.
[[nodiscard]] Result<ReplayResult> run_simulation_replay(const ReplayJob& job);

}  // namespace app
}  // namespace v0
}  // namespace incise
