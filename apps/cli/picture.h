// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "incise/core/result.h"
#include "incise/engine/engine.h"

namespace incise_cli {

/// Whether this program can draw. Errors: kUnsupported, with the remedy. Cost: tens of ms.
incise::Status check_drawing();

/// Draws what cuts did to a mesh, and writes it as a PNG. Errors: kUnsupported; kIo, naming the file.
incise::Status draw_cut(const incise::Engine& engine, const std::filesystem::path& file);

}  // namespace incise_cli
