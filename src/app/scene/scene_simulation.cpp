// SPDX-License-Identifier: Apache-2.0
#include "app/scene/scene_simulation.h"

#include <cmath>
#include <system_error>
#include <utility>

#include "incise/mesh/bounds.h"
#include "incise/mesh/shapes.h"

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
      if (lies_in(centroid, region.below)) soup.regions[i] = region.region;
    }
  }
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
      if (Status status = simulation.body().hold(v, attachment.stiffness); !status.ok()) return status;
    }
  }
  return {};
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
  std::error_code code;
  for (const fs::path& path : {scene.folder / scene.model.file, fs::path(scene.model.file)}) {
    if (fs::exists(path, code)) return path;
  }
  return Error{ErrorCode::kBadFile,
               "model \"" + scene.model.file + "\": no such file, neither from the scene's folder \"" +
                   scene.folder.string() + "\" nor from here; make it with script/models, or mend the path",
               {}};
}

Result<io::LoadedMesh> load_model(const Scene& scene) {
  if (scene.model.file.empty()) {
    io::MeshFile file = make_box(scene.model.box, scene.seed);
    paint(scene.model.regions, file.data.soup);
    return io::build_mesh(std::move(file), "box");
  }
  const Result<fs::path> path = find_model(scene);
  if (!path.ok()) return path.error();
  Result<io::MeshFile> file = io::read_mesh(*path);
  if (!file.ok()) return file.error();
  paint(scene.model.regions, file->data.soup);
  return io::build_mesh(std::move(file).value(), *path);
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
  SimulationOptions options = scene.options;
  options.engine.threads = options.body.threads = threads;
  options.engine.log = std::move(log);
  if (const Status status = check_blades(scene, mesh); !status.ok()) return status.error();
  Result<Simulation> simulation = Simulation::create(std::move(mesh), std::move(options));
  if (!simulation.ok()) return simulation;
  if (const Status status = attach(scene, *simulation); !status.ok()) return status.error();
  if (const Status status = put_sutures(scene, *simulation); !status.ok()) return status.error();
  return simulation;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
