// SPDX-License-Identifier: Apache-2.0
// Each call is timed, made, and then written with what it left; a refused call has changed nothing, and is not
// written.
#include "app/recording/recorded_engine.h"

#include <utility>

#include "app/recording/recording_path.h"
#include "app/recording/stopwatch.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

RecordingHeader header_of(const Engine& engine, const RecordTo& to) {
  RecordingHeader header;
  header.mesh_file = seen_from(to.file, to.mesh_file);
  header.mesh_hash = engine.mesh().hash();
  header.cut = engine.options().cut;
  header.maintain = engine.options().maintain;
  header.seed = to.seed;
  return header;
}

constexpr auto kNoArguments = [](RecordedCall&) {};

/// A call that was refused and changed nothing.
template <class Outcome>
bool is_refused(const Outcome& outcome) {
  return !outcome.ok() && outcome.error().code == ErrorCode::kBadArgument;
}

}  // namespace

RecordedEngine::RecordedEngine(Engine engine, std::optional<RecordingWriter> writer)
    : engine_(std::move(engine)), writer_(std::move(writer)) {}

Result<RecordedEngine> RecordedEngine::create(TetMesh mesh, EngineOptions options, const RecordTo& to) {
  Result<Engine> engine = Engine::create(std::move(mesh), std::move(options));
  if (!engine.ok()) return engine.error();
  std::optional<RecordingWriter> writer;
  if (!to.file.empty()) writer.emplace(to.file, header_of(*engine, to));
  return RecordedEngine(std::move(engine).value(), std::move(writer));
}

template <class Call>
auto RecordedEngine::timed(const Call& call) {
  const detail::Stopwatch watch;
  auto outcome = call();
  last_ms_ = watch.ms();
  return outcome;
}

/// Writes the line of a call whose arguments `fill` puts in.
template <class Fill, class Outcome>
Outcome RecordedEngine::recorded(CallKind kind, Outcome outcome, const Fill& fill) {
  if (!writer_ || is_refused(outcome)) return outcome;
  RecordedCall call;
  call.kind = kind;
  fill(call);
  if (!outcome.ok()) call.error = outcome.error().code;
  call.hash = mesh().hash();
  if (const Status status = writer_->write(call); !status.ok()) return status.error();
  return outcome;
}

Result<StrokeReport> RecordedEngine::cut(const Stroke& stroke) {
  return recorded(CallKind::kCut, timed([&] { return engine_.cut(stroke); }),
                  [&](RecordedCall& call) { call.stroke = stroke; });
}

Result<std::uint32_t> RecordedEngine::begin_stroke(const BladePose& pose) {
  return recorded(CallKind::kBegin, timed([&] { return engine_.begin_stroke(pose); }),
                  [&](RecordedCall& call) { call.pose = pose; });
}

Result<StepReport> RecordedEngine::step(const BladePose& pose) {
  return recorded(CallKind::kStep, timed([&] { return engine_.step(pose); }),
                  [&](RecordedCall& call) { call.pose = pose; });
}

Result<StrokeReport> RecordedEngine::end_stroke() {
  return recorded(CallKind::kEnd, timed([&] { return engine_.end_stroke(); }), kNoArguments);
}

Status RecordedEngine::set_positions(std::span<const Vec3> positions) {
  return recorded(CallKind::kPositions, timed([&] { return engine_.set_positions(positions); }),
                  [&](RecordedCall& call) { call.positions.assign(positions.begin(), positions.end()); });
}

Result<MaintainReport> RecordedEngine::maintain(std::uint64_t work_units, const ShouldStop& should_stop) {
  std::uint64_t asked = 0;
  bool is_told = false;
  ShouldStop counted;
  if (should_stop) counted = [&] { return is_told || (++asked, is_told = should_stop()); };
  Result<MaintainReport> report = timed([&] { return engine_.maintain(work_units, counted); });
  const std::uint64_t spent = report.ok() ? report->maintain.work_units : 0;
  return recorded(CallKind::kMaintain, std::move(report), [&](RecordedCall& call) {
    call.limit = work_units;
    if (is_told) call.stop_ask = asked;
    call.work_units = spent;
  });
}

Result<MaintainReport> RecordedEngine::improve() {
  Result<MaintainReport> report = timed([&] { return engine_.improve(); });
  const std::uint64_t spent = report.ok() ? report->maintain.work_units : 0;
  return recorded(CallKind::kImprove, std::move(report), [&](RecordedCall& call) { call.work_units = spent; });
}

Result<bool> RecordedEngine::undo() {
  if (!timed([&] { return engine_.undo(); })) return false;
  return recorded(CallKind::kUndo, Result<bool>(true), kNoArguments);
}

Result<bool> RecordedEngine::redo() {
  if (!timed([&] { return engine_.redo(); })) return false;
  return recorded(CallKind::kRedo, Result<bool>(true), kNoArguments);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
