// SPDX-License-Identifier: Apache-2.0
#include "incise/engine/engine.h"

#include <chrono>
#include <cmath>
#include <utility>

namespace incise::inline v0 {

Result<Engine> Engine::create(TetMesh mesh, EngineOptions options) {
  if (!(options.cut.snap >= 0.0 && options.cut.snap <= 0.4)) {
    return Error{ErrorCode::kBadArgument, "the snapping distance must lie in [0, 0.4] of the mean edge length", {}};
  }
  if (options.threads < 1 || options.threads > 256) {
    return Error{ErrorCode::kBadArgument, "the number of threads must lie in [1, 256]", {}};
  }
  return Engine(std::move(mesh), std::move(options));
}

Engine::Engine(TetMesh mesh, EngineOptions options)
    : mesh_(std::move(mesh)), options_(std::move(options)), cutter_(options_.cut) {}

Result<StrokeReport> Engine::cut(const Stroke& stroke) {
  StrokeReport report;
  report.stroke = stroke_count() + 1;
  const auto start = std::chrono::steady_clock::now();
  Result<CutStatistics> cut = cutter_.cut(mesh_, journal_, stroke, report.stroke, report.times);
  if (!cut) {
    return cut.error();
  }
  report.cut = *cut;
  report.step_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  stroke_ends_.push_back(journal_.position());
  undone_ends_.clear();
  return report;
}

bool Engine::undo() {
  if (stroke_ends_.empty()) {
    return false;
  }
  undone_ends_.push_back(stroke_ends_.back());
  stroke_ends_.pop_back();
  const std::size_t target = stroke_ends_.empty() ? 0 : stroke_ends_.back();
  while (journal_.position() > target) {
    journal_.undo(mesh_);
  }
  return true;
}

bool Engine::redo() {
  if (undone_ends_.empty()) {
    return false;
  }
  const std::size_t target = undone_ends_.back();
  undone_ends_.pop_back();
  while (journal_.position() < target) {
    journal_.redo(mesh_);
  }
  stroke_ends_.push_back(target);
  return true;
}

}  // namespace incise::inline v0
