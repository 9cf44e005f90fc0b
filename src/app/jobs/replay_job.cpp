// SPDX-License-Identifier: Apache-2.0
// Each call is made again and compared with how it ended; where `maintain` was stopped by a clock, the recording has
// how often it had asked.
#include "app/jobs/replay_job.h"

#include <system_error>
#include <utility>

#include "app/jobs/job_internal.h"
#include "app/jobs/simulation_replay.h"
#include "app/recording/engine_recording.h"
#include "app/recording/recorded_mesh.h"
#include "app/recording/simulation_recording.h"
#include "app/text/counted.h"
#include "app/text/formatted.h"
#include "app/text/json_write.h"
#include "app/text/line_reader.h"
#include "app/text/named_file.h"
#include "incise/io/mesh_export.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

Error bad_line(std::string_view file_name, std::uint32_t line, const std::string& what) {
  return {ErrorCode::kBadFile, std::string(file_name) + ":" + std::to_string(line) + ": " + what, {}};
}

/// How a call went: its error, and the work units it spent where it tells.
struct Outcome {
  std::optional<Error> error;
  std::optional<std::uint64_t> work_units;
};

template <class T>
Outcome outcome_of(const T& result) {
  if (result.ok()) return {};
  return {result.error(), {}};
}

Outcome outcome_of(bool is_done) {
  if (is_done) return {};
  return {Error{ErrorCode::kBadArgument, "there is nothing to undo or redo", {}}, {}};
}

Outcome outcome_of(const Result<MaintainReport>& report) {
  if (!report.ok()) return {report.error(), {}};
  return {{}, report->maintain.work_units};
}

Outcome maintain(Engine& engine, const RecordedCall& call) {
  std::uint64_t asked = 0;
  ShouldStop should_stop;
  if (call.stop_ask) should_stop = [&] { return ++asked >= *call.stop_ask; };
  return outcome_of(engine.maintain(call.limit, should_stop));
}

Outcome make_call(Engine& engine, const RecordedCall& call) {
  switch (call.kind) {
    case CallKind::kBegin:
      return outcome_of(engine.begin_stroke(call.pose));
    case CallKind::kStep:
      return outcome_of(engine.step(call.pose));
    case CallKind::kEnd:
      return outcome_of(engine.end_stroke());
    case CallKind::kCut:
      return outcome_of(engine.cut(call.stroke));
    case CallKind::kUndo:
      return outcome_of(engine.undo());
    case CallKind::kRedo:
      return outcome_of(engine.redo());
    case CallKind::kMaintain:
      return maintain(engine, call);
    case CallKind::kImprove:
      return outcome_of(engine.improve());
    case CallKind::kPositions:
      return outcome_of(engine.set_positions(call.positions));
  }
  return {};
}

std::string shown(const std::optional<ErrorCode>& error) {
  return error ? std::string("error ") + name_of(*error) : "success";
}

std::optional<ReplayDifference> differ(const RecordedCall& call, std::string expected, std::string found) {
  if (expected == found) return std::nullopt;
  return ReplayDifference{call.line, name_of(call.kind), std::move(expected), std::move(found)};
}

std::optional<ReplayDifference> compare_ends(const RecordedCall& call, const Outcome& outcome) {
  std::optional<ErrorCode> found;
  if (outcome.error) found = outcome.error->code;
  return differ(call, shown(call.error), shown(found));
}

std::optional<ReplayDifference> compare_hashes(const RecordedCall& call, const TetMesh& mesh) {
  return differ(call, "hash " + hash_text(call.hash), "hash " + hash_text(mesh.hash()));
}

std::optional<ReplayDifference> compare_work(const RecordedCall& call, const Outcome& outcome) {
  if (!outcome.work_units) return std::nullopt;
  return differ(call, formatted("{} work units", call.work_units), formatted("{} work units", *outcome.work_units));
}

Result<Engine> make_engine(TetMesh mesh, const RecordingHeader& header, const ReplayJob& job) {
  EngineOptions options;
  options.cut = header.cut;
  options.maintain = header.maintain;
  options.log = job.log;
  options.threads = job.threads;
  Result<Engine> engine = Engine::create(std::move(mesh), std::move(options));
  if (engine.ok()) return engine;
  return bad_line(job.recording.string(), 1, engine.error().message);
}

/// Makes all calls up to the first difference.
Status replay_all(Engine& engine, RecordingReader& reader, const ReplayJob& job, ReplayResult& result) {
  const std::size_t kilobytes = detail::kilobytes_of(job.recording);
  if (job.progress) job.progress(0, kilobytes);
  std::optional<RecordedCall> last;
  while (!result.difference) {
    Result<std::optional<RecordedCall>> call = reader.next();
    if (!call.ok()) return call.error();
    if (!call->has_value()) break;
    last = std::move(**call);
    auto difference = replay_call(engine, *last, job.verify, reader.file_name());
    if (!difference.ok()) return difference.error();
    result.difference = std::move(*difference);
    ++result.calls;
    if (job.progress) job.progress(static_cast<std::size_t>(reader.bytes() >> 10U), kilobytes);
  }
  if (last && !result.difference) result.difference = compare_hashes(*last, engine.mesh());
  return {};
}

/// From where a recording names its files: where it lies itself, or, as it comes by stdin, where the program runs.
fs::path folder_of(const fs::path& recording) {
  std::error_code code;
  const fs::path folder = recording.parent_path();
  return folder == "/dev" || folder == "/dev/fd" ? fs::current_path(code) : folder;
}

void finish(const Engine& engine, const io::LoadedMesh& loaded, bool wants_mesh, ReplayResult& result) {
  const Components pieces = find_components(engine.mesh());
  result.after = detail::counts_of(engine.mesh(), pieces);
  result.strokes = engine.stroke_count();
  result.is_in_stroke = engine.is_in_stroke();
  result.hash = engine.mesh().hash();
  if (!wants_mesh || result.difference) return;
  result.mesh = io::to_mesh_data(engine.mesh(), pieces, loaded.file_vertex);
  result.mesh.region_names = loaded.region_names;
}

}  // namespace

Result<io::LoadedMesh> load_recorded_mesh(const RecordingHeader& header, const fs::path& recording) {
  const std::string where = recording.string() + ":1: ";
  if (header.mesh_file.empty()) {
    return Error{ErrorCode::kBadFile, where + "it was recorded on a mesh of no file; replay it in the program", {}};
  }
  const std::optional<fs::path> path = find_named(recording.parent_path(), header.mesh_file);
  if (!path) {
    return Error{ErrorCode::kBadFile,
                 where + "the mesh \"" + header.mesh_file + "\" is not there; put it where it was beside the recording",
                 {}};
  }
  Result<io::LoadedMesh> loaded = io::load_mesh(*path);
  if (!loaded.ok() || loaded->mesh.hash() == header.mesh_hash) return loaded;
  return Error{ErrorCode::kBadFile,
               path->string() + ": is not the mesh of the recording: its hash is " + hash_text(loaded->mesh.hash()) +
                   ", recorded was " + hash_text(header.mesh_hash) + "; put the mesh of that time in its place",
               {}};
}

Result<std::optional<ReplayDifference>> replay_call(Engine& engine, const RecordedCall& call, bool verify,
                                                    std::string_view file_name) {
  const Outcome outcome = make_call(engine, call);
  if (outcome.error && outcome.error->code == ErrorCode::kBadArgument) {
    return bad_line(file_name, call.line,
                    std::string("the call \"") + name_of(call.kind) + "\" cannot be made: " + outcome.error->message);
  }
  std::optional<ReplayDifference> difference = compare_ends(call, outcome);
  if (verify && !difference) difference = compare_hashes(call, engine.mesh());
  if (verify && !difference) difference = compare_work(call, outcome);
  return difference;
}

Result<ReplayResult> run_replay(const ReplayJob& job) {
  Result<LineSource> lines = LineSource::open(job.recording);
  if (!lines.ok()) return lines.error();
  const Result<std::string> header = lines->header();
  if (!header.ok()) return header.error();
  const fs::path folder = folder_of(job.recording);
  if (is_simulation_header(*header)) return run_simulation_replay(job, std::move(lines).value(), folder);
  Result<RecordingReader> reader = RecordingReader::open(std::move(lines).value(), folder);
  if (!reader.ok()) return reader.error();
  Result<io::LoadedMesh> loaded = load_recorded_mesh(reader->header(), job.recording);
  if (!loaded.ok()) return loaded.error();
  ReplayResult result;
  result.source = loaded->source;
  result.before = detail::counts_of(loaded->mesh, find_components(loaded->mesh));
  Result<Engine> engine = make_engine(std::move(loaded->mesh), reader->header(), job);
  if (!engine.ok()) return engine.error();
  if (const Status status = replay_all(*engine, *reader, job, result); !status.ok()) return status.error();
  result.is_cut_off = reader->is_cut_off();
  finish(*engine, *loaded, job.wants_mesh, result);
  return result;
}

std::string to_text(const ReplayResult& result) {
  return formatted("{}, {}: {} -> {} tets, {} -> {} vertices, {} -> {} pieces\n", counted(result.calls, "call"),
                   counted(result.strokes, "stroke"), result.before.tets, result.after.tets, result.before.vertices,
                   result.after.vertices, result.before.components, result.after.components) +
         formatted("hash {}\n", hash_text(result.hash));
}

namespace {

Json counts_json(const MeshCounts& counts) {
  return {{"vertices", counts.vertices}, {"tets", counts.tets}, {"components", counts.components}};
}

Json difference_json(const ReplayDifference& d) {
  return {{"line", d.line}, {"call", d.call}, {"expected", d.expected}, {"found", d.found}};
}

}  // namespace

std::string to_json(const ReplayResult& result) {
  Json root;
  root["format"] = "incise-replay";
  root["version"] = 1;
  root["input"] = {{"file", result.source.file}, {"format", result.source.format}};
  root["calls"] = result.calls;
  root["strokes"] = result.strokes;
  root["mesh"] = {{"before", counts_json(result.before)}, {"after", counts_json(result.after)}};
  root["hash"] = hash_text(result.hash);
  root["is_cut_off"] = result.is_cut_off;
  root["is_in_stroke"] = result.is_in_stroke;
  root["difference"] = result.difference ? difference_json(*result.difference) : Json();
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace app
}  // namespace v0
}  // namespace incise
