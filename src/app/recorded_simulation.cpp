// SPDX-License-Identifier: Apache-2.0
#include "incise/app/recorded_simulation.h"

#include <utility>

#include "app/job_internal.h"
#include "app/recording_path.h"
#include "incise/app/scene_simulation.h"

namespace incise::inline v0 {
namespace app {
namespace {

/// The scene as a recording has it: its model's path leads from the recording's folder.
SimulationHeader header_of(const Scene& scene, const TetMesh& mesh, const std::filesystem::path& record) {
  SimulationHeader header;
  header.scene = scene;
  if (!scene.model.file.empty()) {
    const Result<std::filesystem::path> model = find_model(scene);
    header.scene.model.file = seen_from(record, model.ok() ? *model : std::filesystem::path(scene.model.file));
  }
  header.mesh_hash = mesh.hash();
  return header;
}

}  // namespace

RecordedSimulation::RecordedSimulation(Simulation simulation, std::optional<SimulationWriter> writer)
    : simulation_(std::move(simulation)), writer_(std::move(writer)) {}

Result<RecordedSimulation> RecordedSimulation::create(const Scene& scene, TetMesh mesh, const SceneRun& run) {
  std::optional<SimulationWriter> writer;
  if (!run.record.empty()) writer.emplace(run.record, header_of(scene, mesh, run.record));
  Result<Simulation> simulation = make_simulation(scene, std::move(mesh), run.threads, run.log);
  if (!simulation.ok()) return simulation.error();
  return RecordedSimulation(std::move(simulation).value(), std::move(writer));
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
  if (!writer_ || (!outcome.ok() && outcome.error().code == ErrorCode::kBadArgument)) return outcome;
  if (!outcome.ok()) call.error = outcome.error().code;
  call.hash = simulation_.hash();
  if (const Status status = writer_->write(call); !status.ok()) return status.error();
  return outcome;
}

Result<FrameReport> RecordedSimulation::frame(const FrameInput& input) {
  Result<FrameReport> report = timed([&] { return simulation_.frame(input); });
  if (!writer_) return report;
  SimulationCall call;
  call.kind = SimulationCallKind::kFrame;
  call.input = input;
  return recorded(std::move(call), std::move(report));
}

Result<unsigned> RecordedSimulation::settle(const SceneSettle& settle) {
  SimulationCall call;
  call.kind = SimulationCallKind::kSettle;
  call.settle = settle;
  return recorded(std::move(call), timed([&] { return simulation_.settle(settle.frames, settle.speed); }));
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

}  // namespace app
}  // namespace incise::inline v0
