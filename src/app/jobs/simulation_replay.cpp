// SPDX-License-Identifier: Apache-2.0
// Makes the calls of a recording again, on the scene's own body, and compares ends and hashes.
#include "app/jobs/simulation_replay.h"

#include <utility>

#include "app/jobs/job_internal.h"
#include "app/recording/simulation_recording.h"
#include "app/scene/scene_simulation.h"
#include "app/text/json_write.h"
#include "app/text/line_reader.h"
#include "incise/io/mesh_export.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// How a call ended; nothing: in success.
using End = std::optional<Error>;

End make_call(Simulation& simulation, const SimulationCall& call) {
  const auto end_of = [](const auto& result) { return result.ok() ? End() : End(result.error()); };
  const auto end_if = [](bool is_done) {
    return is_done ? End() : End(Error{ErrorCode::kBadArgument, "there is nothing to undo or redo", {}});
  };
  switch (call.kind) {
    case SimulationCallKind::kSettle:
      return end_of(simulation.settle(call.settle.frames, call.settle.speed));
    case SimulationCallKind::kFrame:
      return end_of(simulation.frame(call.input));
    case SimulationCallKind::kUndo:
      return end_if(simulation.undo());
    case SimulationCallKind::kRedo:
      return end_if(simulation.redo());
    case SimulationCallKind::kSuture:
      return end_of(simulation.add_suture(call.suture.ends, call.suture.suture));
    case SimulationCallKind::kUnpick:
      return end_of(simulation.remove_suture(call.suture.id));
  }
  return {};
}

std::string ended(const std::optional<ErrorCode>& error) {
  return error ? std::string("error ") + name_of(*error) : "success";
}

std::optional<ReplayDifference> differ(const SimulationCall& call, std::string expected, std::string found) {
  if (expected == found) return std::nullopt;
  return ReplayDifference{call.line, name_of(call.kind), std::move(expected), std::move(found)};
}

std::optional<ReplayDifference> compare_hashes(const SimulationCall& call, const Simulation& simulation) {
  if (!call.hash) return std::nullopt;
  return differ(call, "hash " + hash_text(*call.hash), "hash " + hash_text(simulation.hash()));
}

Result<std::optional<ReplayDifference>> replay_call(Simulation& simulation, const SimulationCall& call, bool verify,
                                                    const std::string& file_name) {
  const End end = make_call(simulation, call);
  if (end && end->code == ErrorCode::kBadArgument) {
    return Error{ErrorCode::kBadFile,
                 file_name + ":" + std::to_string(call.line) + ": the call \"" + name_of(call.kind) +
                     "\" cannot be made: " + end->message,
                 {}};
  }
  const std::optional<ErrorCode> found = end ? std::optional(end->code) : std::nullopt;
  std::optional<ReplayDifference> difference = differ(call, ended(call.error), ended(found));
  if (verify && !difference) difference = compare_hashes(call, simulation);
  return difference;
}

/// Makes all calls up to the first difference.
Status replay_all(Simulation& simulation, SimulationReader& reader, const ReplayJob& job, ReplayResult& result) {
  const std::size_t kilobytes = detail::kilobytes_of(job.recording);
  if (job.progress) job.progress(0, kilobytes);
  std::optional<SimulationCall> last;
  while (!result.difference) {
    Result<std::optional<SimulationCall>> call = reader.next();
    if (!call.ok()) return call.error();
    if (!call->has_value()) break;
    last = std::move(**call);
    auto difference = replay_call(simulation, *last, job.verify, reader.file_name());
    if (!difference.ok()) return difference.error();
    result.difference = std::move(*difference);
    ++result.calls;
    if (job.progress) job.progress(static_cast<std::size_t>(reader.bytes() >> 10U), kilobytes);
  }
  if (last && !result.difference) result.difference = compare_hashes(*last, simulation);
  return {};
}

void finish(const Simulation& simulation, const io::LoadedMesh& loaded, bool wants_mesh, ReplayResult& result) {
  const TetMesh& mesh = simulation.mesh();
  const Components pieces = find_components(mesh);
  result.after = detail::counts_of(mesh, pieces);
  result.strokes = simulation.engine().stroke_count();
  result.is_in_stroke = simulation.engine().is_in_stroke();
  result.hash = simulation.hash();
  if (!wants_mesh || result.difference) return;
  result.mesh = io::to_mesh_data(mesh, pieces, loaded.file_vertex, io::MeshPose::kAsItStands);
  result.mesh.region_names = loaded.region_names;
}

}  // namespace

Result<io::LoadedMesh> load_recorded_model(const SimulationHeader& header) {
  Result<io::LoadedMesh> loaded = load_model(header.scene);
  if (!loaded.ok() || loaded->mesh.hash() == header.mesh_hash) return loaded;
  return Error{ErrorCode::kBadFile,
               loaded->source.file + ": is not the model of the recording: its hash is " +
                   hash_text(loaded->mesh.hash()) + ", recorded was " + hash_text(header.mesh_hash) +
                   "; put the model of that time in its place",
               {}};
}

Result<ReplayResult> run_simulation_replay(const ReplayJob& job, LineSource lines,
                                           const std::filesystem::path& folder) {
  Result<SimulationReader> reader = SimulationReader::open(std::move(lines), folder);
  if (!reader.ok()) return reader.error();
  Result<io::LoadedMesh> loaded = load_recorded_model(reader->header());
  if (!loaded.ok()) return loaded.error();
  ReplayResult result;
  result.source = loaded->source;
  result.before = detail::counts_of(loaded->mesh, find_components(loaded->mesh));
  Result<Simulation> simulation =
      make_simulation(reader->header().scene, std::move(loaded->mesh), job.threads, job.log);
  if (!simulation.ok()) return simulation.error();
  if (const Status status = replay_all(*simulation, *reader, job, result); !status.ok()) return status.error();
  result.is_cut_off = reader->is_cut_off();
  finish(*simulation, *loaded, job.wants_mesh, result);
  return result;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
