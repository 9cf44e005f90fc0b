// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "incise/app/mesh_loader.h"
#include "incise/app/report.h"
#include "incise/engine/engine.h"
#include "incise/io/mesh_data.h"

namespace incise::inline v0 {
namespace app {

struct CutJob {
  std::vector<Stroke> strokes;
  EngineOptions engine;
  ReportOptions options;  ///< repeated in the report; profile, snap and threads are taken from `engine`
  /// Called before each stroke and after the last: strokes done, strokes in all. May be empty.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

struct CutResult {
  CutReport report;
  io::MeshData mesh;  ///< what `incise cut -o` writes; empty where not asked for
};

/// Cuts a loaded mesh along all strokes, in order, and measures it before and after.
///
/// @param wants_mesh  whether `CutResult::mesh` is filled.
/// Errors: as `Engine::create` and `Engine::cut`, naming the stroke. Cost: the cuts, plus about 3 µs per tet.
[[nodiscard]] Result<CutResult> run_cut(LoadedMesh loaded, const CutJob& job, bool wants_mesh);

}  // namespace app
}  // namespace incise::inline v0
