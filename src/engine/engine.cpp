// SPDX-License-Identifier: Apache-2.0
#include "incise/engine/engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "incise/improve/paper_maintenance.h"

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
  if (options.log && mesh.folds_over_at_load() && (options.maintain.merge || options.maintain.improve)) {
    options.log(LogLevel::kWarning,
                "the mesh folds over itself: it is cut, but not maintained; mend its inverted tets");
  }
  return Engine(std::move(mesh), std::move(options));
}

Engine::Engine(TetMesh mesh, EngineOptions options)
    : mesh_(std::move(mesh)),
      options_(std::move(options)),
      cutter_(options_.cut, options_.threads),
      maintainer_(options_.maintain) {}

Result<StrokeReport> Engine::cut(const Stroke& stroke) {
  StrokeReport report;
  report.stroke = stroke_count() + 1;
  const auto start = std::chrono::steady_clock::now();
  const std::size_t first_step = journal_.position();
  Result<CutStatistics> cut = cutter_.cut(mesh_, journal_, stroke, report.stroke, report.times);
  if (!cut) {
    return cut.error();
  }
  report.cut = *cut;
  tell(options_.log, *cut);
  take_up(stroke, report.stroke, first_step);
  report.maintain = maintain(options_.maintain.work_units, report.times, {});
  report.step_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  push_operation(true);
  return report;
}

Result<std::uint32_t> Engine::begin_stroke(const BladePose& pose) {
  if (is_in_stroke_) {
    return Error{ErrorCode::kBadArgument, "a stroke is under way; end it first", {}};
  }
  Stroke stroke;
  stroke.times = {0.0};
  stroke.edges = {pose.edge};
  if (Status status = check(stroke); !status) {
    return status.error();
  }
  open_stroke_ = std::move(stroke);
  is_in_stroke_ = true;
  return stroke_count() + 1;
}

Result<StepReport> Engine::step(const BladePose& pose) {
  if (!is_in_stroke_) {
    return Error{ErrorCode::kBadArgument, "no stroke is under way; begin one first", {}};
  }
  Stroke stroke = open_stroke_;
  stroke.times.push_back(stroke.times.back() + 1.0);
  stroke.edges.push_back(pose.edge);
  if (Status status = check(stroke); !status) {
    return status.error();
  }
  open_stroke_ = std::move(stroke);
  return StepReport{};
}

Result<StrokeReport> Engine::end_stroke() {
  if (!is_in_stroke_) {
    return Error{ErrorCode::kBadArgument, "no stroke is under way; begin one first", {}};
  }
  is_in_stroke_ = false;
  return cut(open_stroke_);
}

Status Engine::set_positions(std::span<const Vec3> positions) {
  if (positions.size() != mesh_.vertex_slots()) {
    return Error{ErrorCode::kBadArgument,
                 "positions must be given for all " + std::to_string(mesh_.vertex_slots()) + " vertex slots",
                 {}};
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (mesh_.is_live(VertexId(static_cast<std::uint32_t>(i))) && !positions[i].allFinite()) {
      return Error{ErrorCode::kBadArgument, "the position of vertex " + std::to_string(i) + " is not finite", {}};
    }
  }
  mesh_.set_current(positions);
  return {};
}

/// Hands the surroundings of a fresh cut to whoever maintains the mesh.
void Engine::take_up(const Stroke& stroke, std::uint32_t tag, std::size_t first_step) {
  if (!maintains()) {
    return;
  }
  if (is_paper()) {
    paper_first_step_ = std::min(paper_first_step_, first_step);
    return;
  }
  const SweptTriangles sweep = swept_triangles(stroke);
  maintainer_.set_reference(tag, TriangleTree(sweep.points, sweep.triangles));
  maintainer_.take_up(mesh_, journal_, first_step);
}

bool Engine::maintains() const {
  return (options_.maintain.merge || options_.maintain.improve) && !mesh_.folds_over_at_load();
}

MaintainStatistics Engine::maintain(std::uint64_t work_units, StageTimes& times, const ShouldStop& should_stop) {
  if (!is_paper()) {
    return maintainer_.run(mesh_, journal_, work_units, times, should_stop);
  }
  if (paper_first_step_ == kNothingWaits || work_units == 0) {
    return {};
  }
  const std::size_t first_step = std::exchange(paper_first_step_, kNothingWaits);
  return maintain_as_paper(mesh_, journal_, first_step, options_.maintain, times);
}

MaintainReport Engine::maintain(std::uint64_t work_units, const ShouldStop& should_stop) {
  MaintainReport report;
  report.maintain = maintain(work_units, report.times, should_stop);
  if (!operations_.empty()) {
    operations_.back().end = journal_.position();
  }
  return report;
}

bool Engine::has_maintenance() const {
  return is_paper() ? paper_first_step_ != kNothingWaits : maintainer_.has_work();
}

MaintainReport Engine::improve(const ShouldStop& should_stop) {
  MaintainReport report;
  if (maintains() && is_paper()) {
    report.maintain = maintain_all_as_paper(mesh_, journal_, options_.maintain, report.times);
  } else if (maintains()) {
    maintainer_.take_up_all(mesh_);
    report.maintain = maintainer_.run(mesh_, journal_, options_.maintain.work_units, report.times, should_stop);
  }
  push_operation(false);
  return report;
}

void Engine::push_operation(bool is_stroke) {
  operations_.push_back({journal_.position(), is_stroke});
  undone_.clear();
  stroke_count_ += is_stroke ? 1U : 0U;
}

bool Engine::undo() {
  if (operations_.empty()) {
    return false;
  }
  undone_.push_back(operations_.back());
  operations_.pop_back();
  stroke_count_ -= undone_.back().is_stroke ? 1U : 0U;
  const std::size_t target = operations_.empty() ? 0 : operations_.back().end;
  while (journal_.position() > target) {
    journal_.undo(mesh_);
  }
  maintainer_.forget();
  paper_first_step_ = kNothingWaits;
  return true;
}

bool Engine::redo() {
  if (undone_.empty()) {
    return false;
  }
  operations_.push_back(undone_.back());
  undone_.pop_back();
  stroke_count_ += operations_.back().is_stroke ? 1U : 0U;
  while (journal_.position() < operations_.back().end) {
    journal_.redo(mesh_);
  }
  return true;
}

}  // namespace incise::inline v0
