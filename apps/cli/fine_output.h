// SPDX-License-Identifier: Apache-2.0
// Fine surfaces that a mesh carries: where they come from, and where they go as they are drawn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/model/gltf_file.h"
#include "app/view/fine_view.h"
#include "command.h"
#include "incise/core/result.h"

namespace incise_cli {

/// The options --surface and --drawn.
struct FineArguments {
  std::string surface, drawn;
};
void add_fine(CLI::App& command, FineArguments& arguments);

/// What is wrong with them, or nothing. `has_surface`: one comes from elsewhere.
std::string fine_problem(const FineArguments& arguments, bool has_surface = false);

/// The surface that was asked for, bound to a mesh that nothing has followed yet; none where none was. Errors: as
/// `read_fine_surface` and `EmbeddedSurface::bind`, naming the file.
incise::Result<std::optional<incise::app::FineView>> bind_fine(const FineArguments& arguments,
                                                               const incise::TetMesh& mesh);

/// What `write_drawn` takes, of a surface as the body stands.
incise::Result<incise::app::GltfBody> body_of(incise::app::FineView& fine, const incise::TetMesh& mesh,
                                              const incise::Journal& journal, double metres_per_unit);

}  // namespace incise_cli
