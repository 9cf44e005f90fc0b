// SPDX-License-Identifier: Apache-2.0
// How a session begins.

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>
#include <utility>

#include "app/jobs/simulation_replay.h"
#include "app/recording/recorded_mesh.h"
#include "app/scene/scene_simulation.h"
#include "app/session/session_state.h"
#include "app/text/formatted.h"
#include "app/text/text_file.h"
#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr double kLongestSide = 0.1;  // m, of a mesh without a scene
constexpr double kHeldShare = 0.1;    // of its height
constexpr double kYoung = 20e3;       // Pa
constexpr std::size_t kHead = 4096;   // bytes that tell what a file is

enum class FileKind : std::uint8_t { kMesh, kScene, kSimulation, kEngine };

Result<FileKind> kind_of(const fs::path& path) {
  if (Status status = check_readable(path); !status.ok()) return status.error();
  std::ifstream file(path, std::ios::binary);
  std::string head(kHead, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  const auto first = std::find_if(head.begin(), head.end(), [](unsigned char c) { return std::isspace(c) == 0; });
  if (first == head.end() || *first != '{') return FileKind::kMesh;
  if (head.find("\"incise-recording\"") != std::string::npos) return FileKind::kEngine;
  return head.find("\"incise-simulation\"") != std::string::npos ? FileKind::kSimulation : FileKind::kScene;
}

template <class Reader, class Call>
Status read_calls(Reader& reader, std::vector<Call>& calls) {
  while (true) {
    Result<std::optional<Call>> call = reader.next();
    if (!call.ok()) return call.error();
    if (!call->has_value()) return {};
    calls.push_back(std::move(**call));
  }
}

void take(io::LoadedMesh loaded, std::vector<std::uint32_t>& file_vertex, io::RegionNames& names, TetMesh& mesh) {
  file_vertex = std::move(loaded.file_vertex);
  names = std::move(loaded.region_names);
  mesh = std::move(loaded.mesh);
}

}  // namespace

Scene scene_of_mesh(const fs::path& mesh, const Box& body, const Vec3& up) {
  Scene scene;
  scene.name = mesh.filename().string();
  scene.model.file = fs::absolute(mesh).string();
  const Vec3 size = body.is_empty() ? Vec3(Vec3::Ones()) : Vec3(body.hi - body.lo);
  scene.options.body.length_unit = kLongestSide / std::max(size.maxCoeff(), 1e-300);
  scene.options.body.gravity = -9.81 * up;
  scene.options.body.damping = 2;
  scene.options.body.self.on = true;
  scene.options.materials.fallback.young = kYoung;
  scene.has_materials_by_name = true;
  const double low = std::min(body.lo.dot(up), body.hi.dot(up)), height = std::abs(size.dot(up));
  scene.attachments.push_back({HalfSpace{up, low + kHeldShare * height}});
  scene.tools.push_back({"table", {}, {PlaneTool{up, low}}});
  scene.settle.frames = 120;
  scene.frames = kMaxSceneFrames;
  return scene;
}

Result<Session> Session::open(const fs::path& path, const SessionOptions& options) {
  const Result<FileKind> kind = kind_of(path);
  if (!kind.ok()) return kind.error();
  if (*kind == FileKind::kSimulation) return open_simulation_recording(path, options);
  if (*kind == FileKind::kEngine) return open_engine_recording(path, options);
  if (*kind == FileKind::kScene) {
    const Result<Scene> scene = read_scene(path);
    if (!scene.ok()) return scene.error();
    Result<Session> session = open(*scene, options);
    if (session.ok() && scene->name.empty()) session->state_->title = path.filename().string();
    return session;
  }
  Result<io::LoadedMesh> loaded = io::load_mesh(path);
  if (!loaded.ok()) return loaded.error();
  return open(scene_of_mesh(path, rest_bounds(loaded->mesh), options.up), options);
}

Result<Session> Session::open(const Scene& scene, const SessionOptions& options) {
  auto state = std::make_unique<State>();
  state->options = options;
  state->scene = scene;
  Result<io::LoadedMesh> loaded = take_model(state->scene);
  if (!loaded.ok()) return loaded.error();
  state->title = scene.name;
  take(std::move(loaded).value(), state->file_vertex, state->region_names, state->initial);
  return begin(std::move(state));
}

Result<Session> Session::open_simulation_recording(const fs::path& path, const SessionOptions& options) {
  Result<SimulationReader> reader = SimulationReader::open(path);
  if (!reader.ok()) return reader.error();
  Result<io::LoadedMesh> loaded = load_recorded_model(reader->header());
  if (!loaded.ok()) return loaded.error();
  auto state = std::make_unique<State>();
  if (const Status status = read_calls(*reader, state->calls); !status.ok()) return status.error();
  state->options = options;
  state->scene = reader->header().scene;
  state->title = state->scene.name.empty() ? path.filename().string() : state->scene.name;
  state->recording_name = path.string();
  state->is_replay = true;
  take(std::move(loaded).value(), state->file_vertex, state->region_names, state->initial);
  return begin(std::move(state));
}

Result<Session> Session::open_engine_recording(const fs::path& path, const SessionOptions& options) {
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader.ok()) return reader.error();
  Result<io::LoadedMesh> loaded = load_recorded_mesh(reader->header(), path);
  if (!loaded.ok()) return loaded.error();
  auto state = std::make_unique<State>();
  if (const Status status = read_calls(*reader, state->engine_calls); !status.ok()) return status.error();
  state->options = options;
  state->engine_options.cut = reader->header().cut;
  state->engine_options.maintain = reader->header().maintain;
  state->title = path.filename().string();
  state->recording_name = path.string();
  state->is_replay = state->is_engine_replay = true;
  take(std::move(loaded).value(), state->file_vertex, state->region_names, state->initial);
  return begin(std::move(state));
}

Result<Session> Session::begin(std::unique_ptr<State> state) {
  if (!state->options.surface.empty()) state->scene.model.surface = state->options.surface;
  if (const Status status = state->start(); !status.ok()) return status.error();
  const fs::path record = state->options.record;
  Session session(std::move(state));
  if (record.empty()) return session;
  if (const Status status = session.start_recording(record); !status.ok()) return status.error();
  return session;
}

Status Session::State::start() {
  // Whatever may fail comes first, so that a session that cannot start anew stays as it is.
  if (is_engine_replay) {
    Result<Engine> made = make_engine();
    if (!made.ok()) return made.error();
    engine.emplace(std::move(made).value());
  } else {
    Result<RecordedSimulation> made = make_simulation();
    if (!made.ok()) return made.error();
    simulation.emplace(std::move(made).value());
  }
  figures = {};
  figures.tets_at_start = initial.tet_count();
  last_input = {};
  followed.reset();
  blade_source = BladeSource::kNone;
  stroke_under_way = 0;
  sewn.clear();
  unpicked.clear();
  forgets_undone = false;
  next_call = 0;
  attempt_began.reset();
  scorer.reset();
  if (scene.exercise) scorer.emplace(scene, initial);
  plays_script = options.plays_script;
  plays_hooks = true;
  count();
  return {};
}

Result<RecordedSimulation> Session::State::make_simulation() const {
  SceneRun run;
  run.threads = options.threads;
  run.log = options.log;
  run.keeps_calls = true;
  if (!is_replay) run.keep_undo = options.keep_undo;
  Result<RecordedSimulation> made = RecordedSimulation::create(scene, initial, run);
  if (!made.ok() || is_replay || scene.settle.frames == 0) return made;
  const Result<unsigned> settled = made->settle(scene.settle);
  if (!settled.ok()) return settled.error();
  return made;
}

Result<Engine> Session::State::make_engine() const {
  EngineOptions chosen = engine_options;
  chosen.log = options.log;
  chosen.threads = options.threads;
  return Engine::create(initial, std::move(chosen));
}

fs::path Session::State::next_recording_name() const {
  const std::string stem = first_recording.stem().string(), extension = first_recording.extension().string();
  fs::path name = first_recording;
  std::error_code code;
  for (unsigned i = 2; i == 2 || name == recording || fs::exists(name, code); ++i) {
    name.replace_filename(formatted("{}-{}{}", stem, i, extension));
  }
  return name;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
