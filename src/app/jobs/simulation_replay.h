// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/jobs/replay_job.h"
#include "app/recording/simulation_recording.h"
#include "app/text/line_source.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The model of a recording's scene, checked to be the one. Errors: as `load_model`; kBadFile where it is another one.
[[nodiscard]] Result<io::LoadedMesh> load_recorded_model(const SimulationHeader& header);

/// `run_replay` of a simulation's recording, of which the header may have been read; its files are named from `folder`
/// on. The mesh is given as it stands, deformed.
[[nodiscard]] Result<ReplayResult> run_simulation_replay(const ReplayJob& job, LineSource lines,
                                                         const std::filesystem::path& folder);

}  // namespace app
}  // namespace v0
}  // namespace incise
