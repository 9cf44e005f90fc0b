// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/scene/scene.h"
#include "incise/core/log.h"
#include "incise/io/mesh_loader.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Where the file of a scene's model is: seen from the scene's folder, else as its path stands.
/// Errors: kBadFile where it is in neither place.
[[nodiscard]] Result<std::filesystem::path> find_model(const Scene& scene);
/// The same for the file of one of its bodies.
[[nodiscard]] Result<std::filesystem::path> find_model(const Scene& scene, const std::string& file);

/// Reads or makes a scene's model and paints its regions.
///
/// Errors: as `find_model` and `io::load_mesh`.
[[nodiscard]] Result<io::LoadedMesh> load_model(const Scene& scene);

/// The same, and gives what the scene has by names of regions to these regions: materials are then in
/// `options.materials`, and regions that strokes stop at in `SceneStroke::stop_at`.
///
/// Errors: besides kBadFile for a region that no name stands for.
[[nodiscard]] Result<io::LoadedMesh> take_model(Scene& scene);

/// The vertices that an attachment holds, by their rest positions, in the order of their slots. Cost: O(tets).
[[nodiscard]] std::vector<VertexId> find_attached(const TetMesh& mesh, const Attachment& attachment);

/// Makes the simulation of a scene, with its attachments and sutures, before it settles.
///
/// @param scene    as `take_model` left it, or without materials by name.
/// @param mesh     as `load_model` or `take_model` gave it.
/// @param threads  in [1, 256]; the result does not depend on them.
/// Errors: as `Simulation::create`; kBadArgument where materials by name are left; kBadFile for an attachment that
/// holds nothing, for a suture with an end where there is no tissue, or for a blade out of reach (`check_reach`). Cost:
/// O(tets).
[[nodiscard]] Result<Simulation> make_simulation(const Scene& scene, TetMesh mesh, unsigned threads = 1,
                                                 LogSink log = {});

}  // namespace app
}  // namespace v0
}  // namespace incise
