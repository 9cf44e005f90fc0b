// SPDX-License-Identifier: Apache-2.0
#include "incise/engine/engine.h"

#include <chrono>
#include <cmath>
#include <string>
#include <utility>

namespace incise::inline v0 {

namespace {

void tell(const LogSink& log, const CutStatistics& cut) {
  if (log && cut.sheets > 1) {
    log(LogLevel::kInfo,
        "the sweep meets itself: it was cut in " + std::to_string(cut.sheets) + " parts, in time order");
  }
  if (log && cut.blocked_edges > 0) {
    log(LogLevel::kWarning, std::to_string(cut.blocked_edges) +
                                " edges were left whole beside flat tets: the parts may hang together there");
  }
}

}  // namespace

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
    : mesh_(std::move(mesh)), options_(std::move(options)), cutter_(options_.cut, options_.threads) {}

Result<StrokeReport> Engine::cut(const Stroke& stroke) {
  StrokeReport report;
  report.stroke = stroke_count() + 1;
  const auto start = std::chrono::steady_clock::now();
  Result<CutStatistics> cut = cutter_.cut(mesh_, journal_, stroke, report.stroke, report.times);
  if (!cut) {
    return cut.error();
  }
  report.cut = *cut;
  tell(options_.log, *cut);
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
