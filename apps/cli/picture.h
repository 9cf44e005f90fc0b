// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/view/fine_view.h"
#include "incise/core/result.h"
#include "incise/engine/engine.h"

namespace incise_cli {

/// Whether this program can draw. Errors: kUnsupported, with the remedy. Cost: tens of ms.
incise::Status check_drawing();

/// Draws what cuts did to a mesh, and writes it as a PNG. Errors: kUnsupported; kIo, naming the file.
/// With `fine`, a surface that is seen in the place of the mesh's skin; may be null.
incise::Status draw_cut(const incise::Engine& engine, incise::app::FineView* fine, const std::filesystem::path& file);
/// Draws a mesh by its regions, cut open where there are several. Errors: as `draw_cut`.
incise::Status draw_labels(const incise::Engine& engine, const std::filesystem::path& file);

}  // namespace incise_cli
