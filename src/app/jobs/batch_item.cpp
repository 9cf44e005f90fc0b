// SPDX-License-Identifier: Apache-2.0
// One item from the reading of its mesh to its line. Files that the line names are written before the line is given
// back; figures from libm are rounded, so that lines of two machines agree.
#include "app/jobs/batch_item.h"

#include <cmath>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "app/jobs/cut_job.h"
#include "app/jobs/simulate_job.h"
#include "app/scene/scene_simulation.h"
#include "app/text/json_write.h"
#include "app/text/line_reader.h"
#include "app/text/text_file.h"
#include "app/text/write_all.h"
#include "incise/core/hash.h"
#include "incise/io/mesh_export.h"
#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr double kAngleDigits = 1e6;      // of a degree: angles come from libm, whose last digit differs by machine
constexpr std::size_t kMaxListed = 16;    // pieces and strokes, in a line
constexpr double kAfterLastStroke = 0.5;  // s, that a scene goes on after its last random stroke

Json quality_of(const QualityStats& quality) {
  QualityStats rounded = quality;
  for (double* angle : {&rounded.dihedral_min_deg, &rounded.dihedral_max_deg}) {
    *angle = std::round(*angle * kAngleDigits) / kAngleDigits;
  }
  return encode(rounded);
}

Json forces_of(const ForceFigures& forces) {
  return {{"peak_force", encode(forces.peak_force)},       {"engaged_length", encode(forces.engaged_length)},
          {"fracture_work", encode(forces.fracture_work)}, {"friction_work", encode(forces.friction_work)},
          {"tool_work", encode(forces.tool_work)},         {"touching_frames", forces.touching_frames},
          {"yielding_frames", forces.yielding_frames},     {"peak_hook_force", encode(forces.peak_hook_force)}};
}

/// What the blade did to the mesh, whichever way.
void add_figures(const JobReport& report, Json& line) {
  line["hash"] = hash_text(report.broken ? report.broken->kept_hash : report.hash);
  line["valid"] = report.change.ok;
  if (report.broken) line["kept_strokes"] = report.broken->index;
  line["strokes"] = report.strokes;
  line["missed"] = report.missed.size();
  line["vertices"] = report.after.vertices;
  line["tets"] = report.after.tets;
  line["pieces"] = report.after.components;
  line["volumes"] = Json::array();
  for (std::size_t i = 0; i < report.pieces.size() && i < kMaxListed; ++i) {
    line["volumes"].push_back(encode(report.pieces[i].volume));
  }
  line["cut_tets"] = report.cut.cut_tets;
  line["incision_faces"] = report.cut.incision_faces;
  line["quality"] = {{"before", quality_of(report.quality_before)},
                     {"after", quality_of(report.quality_after)},
                     {"incision", quality_of(report.quality_incision)}};
}

EngineOptions engine_of(const BatchOptions& options, EngineOptions engine) {
  if (options.profile) engine.cut.profile = *options.profile;
  if (options.snap) engine.cut.snap = *options.snap;
  if (options.merge) engine.maintain.merge = *options.merge;
  if (options.improve) engine.maintain.improve = *options.improve;
  if (options.work_units) engine.maintain.work_units = *options.work_units;
  return engine;
}

/// What of a mesh's file a result may depend on.
std::uint64_t input_key_of(const io::LoadedMesh& loaded) {
  StateHash hash;
  hash.add(loaded.mesh.hash());
  for (const auto& [region, name] : loaded.region_names) {
    hash.add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(region)));
    hash.add(hash_of_text(name));
  }
  for (const std::uint32_t vertex : loaded.file_vertex) hash.add(std::uint64_t{vertex});
  return hash.value();
}

/// The blade file that makes the same cut again.
std::string blade_text(const std::vector<Stroke>& strokes) {
  Json list = Json::array();
  for (const Stroke& stroke : strokes) {
    Json edges = Json::array();
    for (std::size_t i = 0; i < stroke.times.size(); ++i) {
      edges.push_back({{"t", stroke.times[i]}, {"points", encode(stroke.edges[i])}});
    }
    list.push_back({{"name", stroke.name}, {"edges", std::move(edges)}});
  }
  const Json root = {{"format", "incise-blade"}, {"version", 1}, {"strokes", std::move(list)}};
  return root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

class ItemRunner {
 public:
  ItemRunner(const BatchPlan& plan, std::size_t index, const BatchItemJob& job)
      : plan_(plan), item_(plan.items[index]), job_(job) {
    line_ = {{"item", index}, {"name", item_.name}};
    if (!item_.label.empty()) line_["label"] = item_.label;
    line_["key"] = hash_text(item_.key);
    line_["program"] = kBatchProgram;
  }

  Result<BatchItemResult> run() {
    const Status status = item_.scene ? simulate() : cut();
    if (!status.ok()) {
      const ErrorCode code = status.error().code;
      if (code == ErrorCode::kIo || code == ErrorCode::kOutOfMemory) return status.error();
      line_ = without_figures();
      line_["error"] = {{"code", name_of(code)}, {"message", status.error().message}};
      result_.has_failed = true;
    }
    if (!result_.was_stopped && !result_.was_refused) result_.line = line_of(line_);
    return std::move(result_);
  }

 private:
  [[nodiscard]] Json without_figures() const {
    Json line;
    for (const char* key : {"item", "name", "label", "key", "program"}) {
      if (line_.contains(key)) line[key] = line_[key];
    }
    return line;
  }

  Status cut() {
    Result<io::LoadedMesh> loaded = io::load_mesh(find_in_plan(plan_.folder, item_.mesh));
    if (!loaded.ok()) return loaded.error();
    CutJob job;
    const auto* blade = std::get_if<std::vector<BladeStroke>>(&item_.blade);
    Result<std::vector<Stroke>> strokes = blade != nullptr ? held_strokes(*blade, loaded->mesh, loaded->region_names)
                                                           : strokes_for(rest_bounds(loaded->mesh));
    if (!strokes.ok()) return strokes.error();
    job.strokes = std::move(strokes).value();
    job.by_steps = !std::holds_alternative<HalfSpace>(item_.blade);
    job.method = item_.options.method;
    job.engine = engine_of(item_.options, {});
    if (job.method) job.engine.maintain.merge = job.engine.maintain.improve = false;
    job.engine.threads = job_.threads;
    job.engine.log = job_.log;
    if (Status status = add_input(*loaded); !status.ok() || result_.was_refused) return status;
    const Result<JobResult> result = run_cut(std::move(loaded).value(), job, !plan_.output.format.empty());
    if (!result.ok()) return result.error();
    add_figures(result->report, line_);
    result_.hash = result->report.broken ? result->report.broken->kept_hash : result->report.hash;
    return write(result->mesh, job.strokes);
  }

  Status simulate() {
    Scene scene = scene_of_item();
    Result<io::LoadedMesh> loaded = take_model(scene);
    if (!loaded.ok()) return loaded.error();
    if (Status status = place_random(rest_bounds(loaded->mesh), scene); !status.ok()) return status;
    if (Status status = add_input(*loaded); !status.ok() || result_.was_refused) return status;
    SimulateJob job;
    job.run.threads = job_.threads;
    job.run.log = job_.log;
    job.should_stop = job_.should_stop;
    io::MeshData mesh;
    const std::vector<std::uint32_t> file_vertex = loaded->file_vertex;
    if (!plan_.output.format.empty()) {
      job.look = [&](const Simulation& end) {
        mesh = io::to_mesh_data(end.mesh(), find_components(end.mesh()), file_vertex,
                                plan_.output.as_it_stands ? io::MeshPose::kAsItStands : io::MeshPose::kAtRest);
      };
    }
    const Result<SimulateResult> result = run_simulate(scene, std::move(loaded).value(), job);
    if (!result.ok()) return result.error();
    result_.was_stopped = result->was_stopped;
    if (result_.was_stopped) return {};
    add_figures(result->report.job, line_);
    result_.hash = result->report.job.hash;
    result_.state_hash = result->report.state_hash;
    line_["state_hash"] = hash_text(result->report.state_hash);
    line_["forces"] = forces_of(result->report.forces);
    std::vector<Stroke> strokes;
    for (const SceneStroke& s : scene.strokes) strokes.push_back(s.stroke);
    return write(mesh, strokes);
  }

  /// The scene with what the item says instead.
  [[nodiscard]] Scene scene_of_item() const {
    Scene scene = *item_.scene;
    scene.options.engine = engine_of(item_.options, scene.options.engine);
    if (!item_.mesh.empty()) {
      scene.model.file = find_in_plan(plan_.folder, item_.mesh).string();
      scene.folder.clear();
    }
    return scene;
  }
  Status place_random(const Box& body, Scene& scene) const {
    if (!std::holds_alternative<RandomStrokes>(item_.blade)) return {};
    Result<std::vector<Stroke>> strokes = strokes_for(body);
    if (!strokes.ok()) return strokes.error();
    scene.strokes.clear();
    for (Stroke& stroke : *strokes) scene.strokes.push_back({std::move(stroke), Vec3::Zero()});
    const double end = scene.strokes.back().stroke.times.back() + kAfterLastStroke;
    const auto frames = static_cast<std::uint64_t>(std::ceil(end / scene.options.frame_seconds));
    scene.frames = std::max(scene.frames, frames);
    scene.exercise.reset();  // these are nobody's attempt
    return {};
  }
  /// Of a plane, or made.
  [[nodiscard]] Result<std::vector<Stroke>> strokes_for(const Box& body) const {
    if (const auto* random = std::get_if<RandomStrokes>(&item_.blade)) return random_strokes(*random, body);
    const auto& plane = std::get<HalfSpace>(item_.blade);
    Result<Stroke> stroke = plane_stroke(body, plane.normal, plane.offset);
    if (!stroke.ok()) return stroke.error();
    return std::vector<Stroke>{std::move(stroke).value()};
  }

  [[nodiscard]] bool writes() const { return !job_.folder.empty(); }

  /// The mesh before its cuts: its hash in the line, and a file named by it, which all items of this mesh share.
  Status add_input(const io::LoadedMesh& loaded) {
    const std::string hash = hash_text(loaded.mesh.hash());
    result_.input_key = input_key_of(loaded);
    result_.was_refused = job_.takes_input && !job_.takes_input(result_.input_key);
    if (result_.was_refused) return {};
    line_["input"] = {{"hash", hash},
                      {"key", hash_text(result_.input_key)},
                      {"vertices", loaded.mesh.vertex_count()},
                      {"tets", loaded.mesh.tet_count()}};
    if (plan_.output.format.empty() || !plan_.output.before) return {};
    const std::string name = before_file(plan_, loaded.mesh.hash());
    line_["input"]["file"] = name;
    std::error_code code;
    if (!writes() || fs::exists(job_.folder / name, code)) return {};
    const auto bytes = bytes_of(io::to_mesh_data(loaded.mesh, find_components(loaded.mesh), loaded.file_vertex));
    return bytes.ok() ? write_file(name, *bytes) : Status(bytes.error());
  }
  Status write(const io::MeshData& mesh, const std::vector<Stroke>& strokes) {
    line_["stroke_names"] = Json::array();
    for (std::size_t i = 0; i < strokes.size() && i < kMaxListed; ++i) line_["stroke_names"].push_back(strokes[i].name);
    if (plan_.output.strokes) {
      const std::string name = strokes_file(item_);
      line_["strokes_file"] = name;
      if (Status status = write_file(name, blade_text(strokes)); !status.ok()) return status;
    }
    if (plan_.output.format.empty()) return {};
    const Result<std::string> bytes = bytes_of(mesh);
    if (!bytes.ok()) return bytes.error();
    const std::string name = after_file(plan_, item_);
    line_["file"] = name;
    line_["file_bytes"] = bytes->size();
    line_["file_hash"] = hash_text(hash_of_text(*bytes));
    return write_file(name, *bytes);
  }
  [[nodiscard]] Result<std::string> bytes_of(const io::MeshData& mesh) const {
    return io::write_mesh_bytes(plan_.output.mesh.extension, mesh, plan_.output.mesh.msh);
  }
  Status write_file(const std::string& name, const std::string& bytes) const {
    if (!writes()) return {};
    const fs::path path = job_.folder / name;
    fs::path beside = path;  // workers may write the same mesh before its cuts at the same time
    beside += "." + job_.worker;
    std::error_code code;
    fs::create_directories(path.parent_path(), code);
    if (Status status = write_text_file(beside, bytes); !status.ok()) return status;
    fs::rename(beside, path, code);
    return code ? Status(write_error(path, code)) : Status();
  }

  const BatchPlan& plan_;
  const BatchItem& item_;
  const BatchItemJob& job_;
  Json line_;
  BatchItemResult result_;
};

}  // namespace

std::string before_file(const BatchPlan& plan, std::uint64_t hash) {
  return "before/" + hash_text(hash) + plan.output.mesh.extension;
}

std::string strokes_file(const BatchItem& item) {
  return "strokes/" + item.name + ".json";
}

std::string after_file(const BatchPlan& plan, const BatchItem& item) {
  return "after/" + item.name + plan.output.mesh.extension;
}

Result<BatchItemResult> run_item(const BatchPlan& plan, std::size_t index, const BatchItemJob& job) {
  try {
    return ItemRunner(plan, index, job).run();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 plan.items[index].name + ": out of memory; use fewer workers on a machine, or a larger one",
                 {}};
  }
}

}  // namespace app
}  // namespace v0
}  // namespace incise
