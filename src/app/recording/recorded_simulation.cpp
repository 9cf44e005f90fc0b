// SPDX-License-Identifier: Apache-2.0
// Calls that were made are kept besides, where asked for, so that a recording may begin with what has happened
// already.
#include "app/recording/recorded_simulation.h"

#include <utility>

#include "app/recording/recording_path.h"
#include "app/recording/stopwatch.h"
#include "app/scene/scene_simulation.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// The scene as a recording has it: its model's path leads from the recording's folder.
SimulationHeader header_of(const Scene& scene, std::uint64_t mesh_hash, const std::filesystem::path& record) {
  SimulationHeader header;
  header.scene = scene;
  for (SceneBody& body : header.scene.model.bodies) {
    if (body.file.empty()) continue;
    const Result<std::filesystem::path> there = find_model(scene, body.file);
    body.file = seen_from(record, there.ok() ? *there : std::filesystem::path(body.file));
  }
  if (!scene.model.file.empty()) {
    const Result<std::filesystem::path> model = find_model(scene);
    header.scene.model.file = seen_from(record, model.ok() ? *model : std::filesystem::path(scene.model.file));
  }
  header.mesh_hash = mesh_hash;
  return header;
}

}  // namespace

RecordedSimulation::RecordedSimulation(Simulation simulation, std::optional<SimulationWriter> writer,
                                       std::optional<Past> past)
    : simulation_(std::move(simulation)), writer_(std::move(writer)), past_(std::move(past)) {}

Result<RecordedSimulation> RecordedSimulation::create(const Scene& scene, TetMesh mesh, const SceneRun& run) {
  std::optional<SimulationWriter> writer;
  if (!run.record.empty()) writer.emplace(run.record, header_of(scene, mesh.hash(), run.record));
  std::optional<Past> past;
  if (run.keeps_calls) past = Past{scene, mesh.hash(), {}};
  Result<Simulation> simulation = make_simulation(scene, std::move(mesh), run.threads, run.log);
  if (!simulation.ok()) return simulation.error();
  if (run.keep_undo > 0) {
    if (const Status status = simulation->keep_undo(run.keep_undo); !status.ok()) return status.error();
  }
  return RecordedSimulation(std::move(simulation).value(), std::move(writer), std::move(past));
}

template <class Call>
auto RecordedSimulation::timed(const Call& call) {
  const detail::Stopwatch watch;
  auto outcome = call();
  last_ms_ = watch.ms();
  return outcome;
}

template <class Outcome>
Outcome RecordedSimulation::recorded(SimulationCall call, Outcome outcome) {
  if (!outcome.ok() && outcome.error().code == ErrorCode::kBadArgument) return outcome;
  if (!outcome.ok()) call.error = outcome.error().code;
  if (past_) past_->calls.push_back(call);
  if (!writer_) return outcome;
  call.hash = simulation_.hash();
  if (const Status status = writer_->write(call); !status.ok()) return status.error();
  return outcome;
}

/// Puts the blade where it may be. Without regions, or without a blade, there is nothing to hold.
Status RecordedSimulation::hold_blade(const std::vector<std::int32_t>& stop_at, FrameInput& input) {
  if (!input.blade || stop_at.empty()) {
    guard_.reset();
    return {};
  }
  std::vector<Vec3>& edge = input.blade->edge;
  if (guard_) {
    edge = guard_->move(simulation_.mesh(), edge);
    return {};
  }
  guard_.emplace(stop_at, RegionGuard::Shape::kCurrent);
  Result<std::vector<Vec3>> held = guard_->begin(simulation_.mesh(), edge);
  if (!held.ok()) {
    guard_.reset();
    return held.error();
  }
  edge = std::move(held).value();
  return {};
}

Result<FrameReport> RecordedSimulation::frame(const FrameInput& given, const std::vector<std::int32_t>& stop_at) {
  FrameInput input = given;
  if (const Status status = hold_blade(stop_at, input); !status.ok()) return status.error();
  Result<FrameReport> report = timed([&] { return simulation_.frame(input); });
  if (!writer_ && !past_) return report;
  SimulationCall call;
  call.kind = SimulationCallKind::kFrame;
  call.input = input;
  return recorded(std::move(call), std::move(report));
}

Result<unsigned> RecordedSimulation::settle(const SceneSettle& settle, const ShouldStop& should_stop) {
  SimulationCall call;
  call.kind = SimulationCallKind::kSettle;
  call.settle = settle;
  bool was_stopped = false;
  const ShouldStop asked = [&] { return was_stopped = should_stop && should_stop(); };
  Result<unsigned> done = timed([&] { return simulation_.settle(settle.frames, settle.speed, asked); });
  if (was_stopped && done.ok()) call.settle.frames = *done;
  return recorded(std::move(call), std::move(done));
}

Result<bool> RecordedSimulation::undo() {
  if (!timed([&] { return simulation_.undo(); })) return false;
  SimulationCall call;
  call.kind = SimulationCallKind::kUndo;
  return recorded(std::move(call), Result<bool>(true));
}

Result<bool> RecordedSimulation::redo() {
  if (!timed([&] { return simulation_.redo(); })) return false;
  SimulationCall call;
  call.kind = SimulationCallKind::kRedo;
  return recorded(std::move(call), Result<bool>(true));
}

Result<std::uint32_t> RecordedSimulation::add_suture(const std::array<Vec3, 2>& rest_places, const Suture& suture) {
  Result<std::uint32_t> id = timed([&] { return simulation_.add_suture(rest_places, suture); });
  SimulationCall call;
  call.kind = SimulationCallKind::kSuture;
  call.suture = {rest_places, suture, id.ok() ? *id : 0};
  return recorded(std::move(call), std::move(id));
}

Status RecordedSimulation::remove_suture(std::uint32_t id) {
  SimulationCall call;
  call.kind = SimulationCallKind::kUnpick;
  call.suture.id = id;
  return recorded(std::move(call), timed([&] { return simulation_.remove_suture(id); }));
}

Status RecordedSimulation::start_recording(const std::filesystem::path& path) {
  stop_recording();
  Result<SimulationWriter> writer = write_past(path);
  if (!writer.ok()) return writer.error();
  writer_ = std::move(writer).value();
  return {};
}

Status RecordedSimulation::save_recording(const std::filesystem::path& path) const {
  Result<SimulationWriter> written = write_past(path);
  return written.ok() ? written->write_header() : Status(written.error());
}

Result<SimulationWriter> RecordedSimulation::write_past(const std::filesystem::path& path) const {
  if (!past_) return Error{ErrorCode::kBadArgument, "this session keeps no calls that could be recorded", {}};
  SimulationWriter writer(path, header_of(past_->scene, past_->mesh_hash, path));
  for (std::size_t i = 0; i < past_->calls.size(); ++i) {
    SimulationCall call = past_->calls[i];
    if (i + 1 == past_->calls.size()) call.hash = simulation_.hash();
    if (Status status = writer.write(call); !status.ok()) return status.error();
  }
  return writer;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
