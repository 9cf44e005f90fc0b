// SPDX-License-Identifier: Apache-2.0
// From a scene as it was read to a simulation before its first frame: model, names of regions, what holds the body,
// sutures, reach of the blades. What a scene asks for in vain is an error here, not a silent nothing.
#include "app/scene/scene_simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/model/find_regions.h"
#include "app/text/named_file.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/join.h"
#include "incise/mesh/shapes.h"
#include "incise/sim/tissue.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

bool lies_in(const Vec3& point, const Box& box) {
  return box.distance2(point) == 0;
}
bool lies_in(const Vec3& point, const BallTool& ball) {
  return (point - ball.centre).squaredNorm() <= ball.radius * ball.radius;
}
bool lies_in(const Vec3& point, const HalfSpace& half) {
  return half.normal.dot(point) <= half.offset;
}

void paint(const std::vector<RegionPaint>& regions, TetSoup& soup) {
  if (regions.empty()) return;
  soup.regions.resize(soup.tets.size(), 0);
  for (std::size_t i = 0; i < soup.tets.size(); ++i) {
    Vec3 centroid = Vec3::Zero();
    for (const std::uint32_t v : soup.tets[i]) centroid += 0.25 * soup.points[v];
    for (const RegionPaint& region : regions) {
      const auto has = [&](const auto& where) { return lies_in(centroid, where); };
      if (std::visit(has, region.where)) soup.regions[i] = region.region;
    }
  }
}

/// Names of painted regions stand above those of the file.
void name_regions(const std::vector<RegionPaint>& regions, io::RegionNames& names) {
  for (const RegionPaint& region : regions) {
    if (!region.name.empty()) names[region.region] = region.name;
  }
}

bool has_material(const Materials& materials, std::int32_t region) {
  return std::any_of(materials.by_region.begin(), materials.by_region.end(),
                     [&](const Materials::Entry& e) { return e.region == region; });
}

Status resolve_materials(const io::RegionNames& names, Scene& scene) {
  Materials& materials = scene.options.materials;
  for (const NamedMaterial& named : scene.named_materials) {
    const Result<std::vector<std::int32_t>> regions = find_regions(named.region, names);
    if (!regions.ok()) return Error{ErrorCode::kBadFile, "materials: " + regions.error().message};
    for (const std::int32_t region : *regions) {
      if (has_material(materials, region)) {
        return Error{ErrorCode::kBadFile, "materials: the region \"" + names.at(region) + "\", " +
                                              std::to_string(region) + ", is named twice; name it once"};
      }
      materials.by_region.push_back({region, named.material});
    }
  }
  for (const auto& [region, name] : names) {
    const Tissue* tissue = scene.has_materials_by_name ? tissue_of_region_name(name) : nullptr;
    if (tissue != nullptr && !has_material(materials, region))
      materials.by_region.push_back({region, tissue->material});
  }
  scene.named_materials.clear();
  scene.has_materials_by_name = false;
  return {};
}

/// Of what has `stop_at` and `stop_names`; `key` is what they are called in a scene.
template <class Item>
Status resolve_regions(const io::RegionNames& names, const char* key, Item& item) {
  for (const std::string& name : item.stop_names) {
    const Result<std::vector<std::int32_t>> regions = find_regions(name, names);
    if (!regions.ok()) return Error{ErrorCode::kBadFile, std::string(key) + ": " + regions.error().message};
    item.stop_at.insert(item.stop_at.end(), regions->begin(), regions->end());
  }
  item.stop_names.clear();
  return {};
}

template <class Item>
Status resolve_stops(const io::LoadedMesh& model, std::vector<Item>& items) {
  for (Item& item : items) {
    if (Status status = resolve_regions(model.region_names, "stop_at", item); !status.ok()) return status;
    const Status there = check_regions(item.stop_at, model.mesh);
    if (!there.ok()) return Error{ErrorCode::kBadFile, "stop_at: " + there.error().message};
  }
  return {};
}

/// What people call regions where the scene does not say.
std::string called(const io::RegionNames& names, const std::vector<std::int32_t>& regions) {
  std::string all;
  for (const std::int32_t region : regions) {
    const auto found = names.find(region);
    all +=
        (all.empty() ? "" : ", ") +
        (found != names.end() && !found->second.empty() ? "the " + found->second : "region " + std::to_string(region));
  }
  return all;
}

Status resolve_goal(const io::RegionNames& names, const char* key, ExerciseRegions& goal) {
  Status status = resolve_regions(names, key, goal);
  if (goal.name.empty()) goal.name = called(names, goal.stop_at);
  return status;
}

Status resolve_exercise(const io::LoadedMesh& model, Exercise& exercise) {
  Status status;
  if (exercise.divide) status = resolve_goal(model.region_names, "exercise.divide", *exercise.divide);
  for (ExerciseSpare& spare : exercise.spare) {
    if (status.ok()) status = resolve_goal(model.region_names, "exercise.spare", spare);
  }
  if (exercise.remove && status.ok()) status = resolve_goal(model.region_names, "exercise.remove", *exercise.remove);
  return status.ok() ? resolve_stops(model, exercise.ideal) : status;
}

/// A generated box, as if it came from a file.
io::MeshFile make_box(const SceneBox& box, std::uint64_t seed) {
  io::MeshFile file;
  file.format_name = "generated box";
  file.data.soup = kuhn_box(box.origin, box.origin + box.size, box.cells);
  if (box.jitter > 0) jitter(file.data.soup, box.jitter, seed);
  file.file_vertices = file.data.soup.points.size();
  file.file_tets = file.data.soup.tets.size();
  return file;
}

/// A mesh file, or a box as if it came from one.
Result<io::MeshFile> read_shape(const Scene& scene, const std::string& file, const SceneBox& box) {
  if (file.empty()) return make_box(box, scene.seed);
  const Result<fs::path> path = find_model(scene, file);
  return path.ok() ? io::read_mesh(*path) : path.error();
}

/// Puts a further body beside what is there. What a file has besides points, tets and labels belongs to one body.
Status join(const SceneBody& body, io::MeshFile more, io::MeshFile& all) {
  if (!all.mid_nodes.empty() || !more.mid_nodes.empty() || !all.data.soup.walls.empty() ||
      !more.data.soup.walls.empty()) {
    return Error{
        ErrorCode::kBadFile,
        "model.bodies: several bodies must be of meshes without mid-edge nodes and without cuts; convert them"};
  }
  TetSoup& soup = more.data.soup;
  if (body.region) soup.regions.assign(soup.tets.size(), *body.region);
  all.file_vertices += more.file_vertices;
  all.file_tets += more.file_tets;
  append(soup, body.move, all.data.soup);
  if (!body.region) all.data.region_names.insert(more.data.region_names.begin(), more.data.region_names.end());
  return {};
}

/// Whether each vertex slot is on the surface.
std::vector<bool> find_surface(const TetMesh& mesh) {
  std::vector<bool> is_on(mesh.vertex_slots(), false);
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      if (!mesh.links(tet)[s].is_boundary()) continue;
      for (const VertexId v : mesh.vertices(Side(tet, s))) is_on[v.value] = true;
    }
  });
  return is_on;
}

Status attach(const Scene& scene, Simulation& simulation) {
  for (std::size_t i = 0; i < scene.attachments.size(); ++i) {
    const Attachment& attachment = scene.attachments[i];
    const std::vector<VertexId> held = find_attached(simulation.mesh(), attachment);
    if (held.empty()) {
      return Error{ErrorCode::kBadFile,
                   "attachments[" + std::to_string(i) + "] holds no vertex of the model; make it larger or move it",
                   {}};
    }
    for (const VertexId v : held) {
      DeformableBody& body = simulation.body();
      const Status status = std::isfinite(attachment.strength)
                                ? body.hold(v, attachment.stiffness, {attachment.strength, attachment.tears})
                                : body.hold(v, attachment.stiffness);
      if (!status.ok()) return status;
    }
  }
  return {};
}

/// Draws the body out about the middle of its rest shape: what holds it holds it there.
void draw_out(const Vec3& stretch, TetMesh& mesh) {
  if (stretch == Vec3::Ones()) return;
  const Box body = rest_bounds(mesh);
  const Vec3 middle = 0.5 * (body.lo + body.hi);
  std::vector<Vec3> places(mesh.vertex_slots(), Vec3::Zero());
  mesh.for_each_vertex([&](VertexId v) { places[v.value] = middle + stretch.cwiseProduct(mesh.rest(v) - middle); });
  mesh.set_current(places);
}

/// The first frame whose end is later than a time.
std::uint64_t first_frame_after(double seconds, double frame_seconds) {
  auto frame = static_cast<std::uint64_t>(seconds / frame_seconds);
  while (frame > 0 && static_cast<double>(frame) * frame_seconds > seconds) --frame;
  while (!(static_cast<double>(frame + 1) * frame_seconds > seconds)) ++frame;
  return frame;
}

Status put_sutures(const Scene& scene, Simulation& simulation) {
  const SimulationOptions& options = scene.options;
  for (std::size_t i = 0; i < scene.sutures.size(); ++i) {
    const SceneSuture& suture = scene.sutures[i];
    const std::uint64_t first_frame = first_frame_after(suture.start, options.frame_seconds);
    const Result<std::uint32_t> id = simulation.add_suture(
        {suture.from, suture.to},
        {suture.stiffness, options.body.length_unit * suture.rest_length, suture.pushes, suture.strength, first_frame});
    if (id.ok()) continue;
    return Error{ErrorCode::kBadFile, "sutures[" + std::to_string(i) + "]: " + id.error().message + "; move it", {}};
  }
  return {};
}

/// Whether every blade of the scene keeps within reach of the body.
Status check_blades(const Scene& scene, const TetMesh& mesh) {
  const Box body = rest_bounds(mesh);
  for (std::size_t i = 0; i < scene.strokes.size(); ++i) {
    Stroke stroke = scene.strokes[i].stroke;
    if (stroke.name.empty()) stroke.name = std::to_string(i);
    if (const Status status = check_reach(stroke, body); !status.ok()) {
      return Error{ErrorCode::kBadFile, status.error().message, {}};
    }
  }
  return {};
}

}  // namespace

Result<fs::path> find_model(const Scene& scene) {
  return find_model(scene, scene.model.file);
}

Result<fs::path> find_model(const Scene& scene, const std::string& file) {
  if (std::optional<fs::path> path = find_named(scene.folder, file)) return std::move(*path);
  return Error{ErrorCode::kBadFile,
               "model \"" + file + "\": no such file, neither from the scene's folder \"" + scene.folder.string() +
                   "\" nor from here; make it with script/models, or mend the path",
               {}};
}

Result<io::LoadedMesh> load_model(const Scene& scene) {
  const SceneModel& model = scene.model;
  Result<io::MeshFile> file = read_shape(scene, model.file, model.box);
  if (!file.ok()) return file.error();
  for (const SceneBody& body : model.bodies) {
    Result<io::MeshFile> more = read_shape(scene, body.file, body.box);
    if (!more.ok()) return more.error();
    if (Status status = join(body, std::move(more).value(), *file); !status.ok()) return status.error();
  }
  paint(model.regions, file->data.soup);
  name_regions(model.regions, file->data.region_names);
  return io::build_mesh(std::move(file).value(), model.file.empty() ? "box" : find_model(scene).value());
}

Result<io::LoadedMesh> take_model(Scene& scene) {
  Result<io::LoadedMesh> loaded = load_model(scene);
  if (!loaded.ok()) return loaded;
  if (const Status status = resolve_materials(loaded->region_names, scene); !status.ok()) return status.error();
  if (const Status status = resolve_stops(*loaded, scene.strokes); !status.ok()) return status.error();
  if (const Status status = resolve_stops(*loaded, scene.spare); !status.ok()) return status.error();
  if (!scene.exercise) return loaded;
  if (const Status status = resolve_exercise(*loaded, *scene.exercise); !status.ok()) {
    return status.error();
  }
  return loaded;
}

std::vector<VertexId> find_attached(const TetMesh& mesh, const Attachment& attachment) {
  std::vector<bool> is_on;
  if (attachment.surface_only) is_on = find_surface(mesh);
  std::vector<VertexId> found;
  mesh.for_each_vertex([&](VertexId v) {
    if (attachment.surface_only && !is_on[v.value]) return;
    const auto has = [&](const auto& where) { return lies_in(mesh.rest(v), where); };
    if (mesh.tet_of(v).is_valid() && std::visit(has, attachment.where)) found.push_back(v);
  });
  return found;
}

Result<Simulation> make_simulation(const Scene& scene, TetMesh mesh, unsigned threads, LogSink log) {
  if (!scene.named_materials.empty() || scene.has_materials_by_name) {
    return Error{ErrorCode::kBadArgument, "the scene has materials by name; take its model by `take_model`"};
  }
  SimulationOptions options = scene.options;
  options.engine.threads = options.body.threads = threads;
  options.engine.log = std::move(log);
  if (const Status status = check_blades(scene, mesh); !status.ok()) return status.error();
  draw_out(scene.stretch, mesh);
  Result<Simulation> simulation = Simulation::create(std::move(mesh), std::move(options));
  if (!simulation.ok()) return simulation;
  if (const Status status = attach(scene, *simulation); !status.ok()) return status.error();
  if (const Status status = put_sutures(scene, *simulation); !status.ok()) return status.error();
  return simulation;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
