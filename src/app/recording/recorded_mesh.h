// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/recording/engine_recording.h"
#include "incise/io/mesh_loader.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The mesh that a session's recording names, checked to be the one. Errors: as `io::load_mesh`; kBadFile where it is
/// not there, or another one.
[[nodiscard]] Result<io::LoadedMesh> load_recorded_mesh(const RecordingHeader& header,
                                                        const std::filesystem::path& recording);

}  // namespace app
}  // namespace v0
}  // namespace incise
