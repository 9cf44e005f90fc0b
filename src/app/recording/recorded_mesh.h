// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/model/mesh_loader.h"
#include "app/recording/recording.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The mesh that a session's recording names, checked to be the one. Errors: as `load_mesh`; kBadFile where it is not
/// there, or another one.
[[nodiscard]] Result<LoadedMesh> load_recorded_mesh(const RecordingHeader& header,
                                                    const std::filesystem::path& recording);

}  // namespace app
}  // namespace v0
}  // namespace incise
