// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/jobs/cut_job.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace detail {

/// Cuts a loaded mesh by `*job.method`, each stroke as a whole; what `run_cut` does for the profiles. `report` has what
/// was asked for. Blades are sound and within reach. Nothing is maintained or recorded, and a mesh that is not valid at
/// the end is not taken back. Errors: as `cut_by`, naming the stroke. Cost: the cuts, plus about 3 µs per tet.
[[nodiscard]] Result<JobResult> run_lab_cut(io::LoadedMesh loaded, const CutJob& job, bool wants_mesh,
                                            JobReport report);

}  // namespace detail
}  // namespace app
}  // namespace v0
}  // namespace incise
