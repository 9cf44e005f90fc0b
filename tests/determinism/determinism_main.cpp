// SPDX-License-Identifier: Apache-2.0
// Prints one line "name hash" per scene: the state of the mesh after its strokes, and after some are taken back; then
// the same strokes step by step, in a body at rest and in one that sways; then the scenes maintained, at once and in
// portions, and a whole mesh maintained without a cut; then bodies that are cut while they deform; then a label image.
// The lines are equal for every compiler, optimisation level and target (tests/determinism/golden.txt).
// usage: incise_determinism [--threads N]     the result does not depend on N
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/image/mesh_labels.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/validate.h"
#include "simulated.h"
#include "support/bodies.h"
#include "support/strokes.h"

namespace incise::test {
namespace {

/// Prints a line; false where the mesh is not valid.
bool print(const char* scene, const char* profile, const char* state, const TetMesh& mesh) {
  std::printf("%s.%s.%s %016llx\n", scene, profile, state, static_cast<unsigned long long>(mesh.hash()));
  const ValidityReport report = validate(mesh, ValidateLevel::kGeometry);
  if (!report.ok) {
    std::fprintf(stderr, "%s.%s.%s is not valid\n", scene, profile, state);
  }
  return report.ok;
}

Stroke plane(double x, double y, double z, double offset) {
  return *plane_stroke({Vec3(0, 0, 0), Vec3(1, 1, 1)}, Vec3(x, y, z), offset);
}

struct Scene {
  const char* name;
  TetSoup body;
  std::vector<Stroke> strokes;
};

std::vector<Vec3> parabola(double c, double bend) {
  std::vector<Vec3> path;
  for (unsigned i = 0; i <= 16; ++i) {
    const double y = -0.2 + 1.4 * i / 16;
    path.emplace_back(c + bend * (y - 0.5) * (y - 0.5), y, 0.0);
  }
  return path;
}

std::vector<Scene> scenes() {
  const double low = -0.2, high = 1.2;
  const Stroke arc = path_stroke(parabola(0.4, 0.5), low, high);
  return {
      {"planar", kuhn_cube(5), {plane(0, 0, 1, 0.5)}},
      {"on_faces", kuhn_cube(5), {plane(1, 0, 0, 0.4), plane(1, -1, 0, 0)}},
      {"oblique", jittered_cube(6, 1), {plane(0.3, 0.5, 0.8, 0.77)}},
      {"curved", jittered_cube(6, 2), {arc}},
      {"coring", jittered_cube(6, 3), {coring_stroke(Vec3(0.5, 0.5, 0), 0.31, 24, low, high)}},
      {"crossing", kuhn_cube(5), {plane(1, 0.1, 0, 0.52), plane(0, 1, 0.1, 0.55), plane(0.1, 0, 1, 0.57)}},
      {"self_crossing",
       jittered_cube(5, 4),
       {path_stroke(
           {Vec3(0.47, low, 0), Vec3(0.47, high, 0), Vec3(1.4, high, 0), Vec3(1.4, 0.53, 0), Vec3(low, 0.53, 0)}, low,
           high)}},
      {"bent",
       kuhn_cube(5),
       {profile_stroke({Vec3(0.33, high, 0), Vec3(0.33, low, 0), Vec3(0.37, low, 0), Vec3(0.37, high, 0)}, low, high)}},
      {"partial",
       jittered_cube(6, 5),
       {quad_stroke(Vec3(0.47, low, high), Vec3(0.51, high, high), Vec3(0.47, low, 0.43), Vec3(0.51, high, 0.4), 5)}},
      {"twice", jittered_cube(5, 6), {followed_by(arc, reversed(arc)), arc}},
      {"ball", ball(6), {plane(0.3, 0.5, 0.8, 0.11), plane(-0.7, 0.4, 0.2, -0.05)}},
  };
}

bool run(const Scene& scene, Profile profile, unsigned threads) {
  const char* name = profile == Profile::kPaper ? "paper" : "incise";
  EngineOptions options;
  options.cut.profile = profile;
  options.maintain.merge = options.maintain.improve = false;  // the lines are of cutting alone
  options.threads = threads;
  Result<TetMesh> mesh = TetMesh::build(scene.body);
  Result<Engine> engine = Engine::create(std::move(mesh).value(), options);
  bool is_sound = true;
  for (const Stroke& stroke : scene.strokes) is_sound &= engine->cut(stroke).ok();
  is_sound &= print(scene.name, name, "cut", engine->mesh());
  engine->undo();
  is_sound &= print(scene.name, name, "undone", engine->mesh());
  engine->redo();
  is_sound &= print(scene.name, name, "redone", engine->mesh());
  return is_sound;
}

/// Where a body stands that sways: a polynomial of place and time, since no libm is called here. `time` in [0, 1].
Vec3 swayed(const Vec3& rest, double time) {
  const double there_and_back = 4 * time * (1 - time), reach = 0.15 * there_and_back;
  return rest + reach * Vec3(rest.y() * rest.z(), 0.5 * rest.x() * rest.x(), rest.y() - 0.3 * rest.x());
}

void sway(Engine& engine, double time) {
  const TetMesh& mesh = engine.mesh();
  std::vector<Vec3> positions(mesh.vertex_slots(), Vec3::Zero());
  mesh.for_each_vertex([&](VertexId v) { positions[v.value] = swayed(mesh.rest(v), time); });
  static_cast<void>(engine.set_positions(positions));
}

/// The strokes of a scene step by step; a line half-way through each as well as at its end.
bool run_steps(const Scene& scene, const char* name, double snap, bool sways, unsigned threads) {
  EngineOptions options;
  options.cut.snap = snap;
  options.maintain.merge = options.maintain.improve = false;
  options.threads = threads;
  Result<Engine> engine = Engine::create(TetMesh::build(scene.body).value(), options);
  bool is_sound = true;
  for (const Stroke& stroke : scene.strokes) {
    const std::size_t last = stroke.edges.size() - 1;
    is_sound &= engine->begin_stroke({stroke.edges[0], Vec3::Zero()}).ok();
    for (std::size_t i = 1; i <= last; ++i) {
      if (sways) sway(*engine, static_cast<double>(i) / static_cast<double>(last));
      is_sound &= engine->step({stroke.edges[i], Vec3::Zero()}).ok();
      if (i == (last + 1) / 2) is_sound &= print(scene.name, name, "half_way", engine->mesh());
    }
    is_sound &= engine->end_stroke().ok();
  }
  return is_sound & print(scene.name, name, "stepped", engine->mesh());
}

bool run_all_steps(unsigned threads) {
  bool is_sound = true;
  for (const Scene& scene : scenes()) {
    is_sound &= run_steps(scene, "steps_snap", 0.2, false, threads);
    is_sound &= run_steps(scene, "steps_no_snap", 0, false, threads);
    is_sound &= run_steps(scene, "steps_swaying", 0.2, true, threads);
  }
  return is_sound;
}

/// How a scene is maintained.
struct Upkeep {
  const char* name;
  Profile profile;
  double snap;
  std::uint64_t work_units;  ///< per stroke
};

Engine make_engine(TetSoup soup, const Upkeep& upkeep, unsigned threads) {
  EngineOptions options;
  options.cut = {upkeep.profile, upkeep.snap};
  options.maintain.work_units = upkeep.work_units;
  options.threads = threads;
  return Engine::create(TetMesh::build(std::move(soup)).value(), options).value();
}

bool run_maintained(const Scene& scene, const Upkeep& upkeep, unsigned threads) {
  Engine engine = make_engine(scene.body, upkeep, threads);
  bool is_sound = true;
  for (const Stroke& stroke : scene.strokes) is_sound &= engine.cut(stroke).ok();
  is_sound &= print(scene.name, upkeep.name, "maintained", engine.mesh());
  if (engine.has_maintenance()) {
    for (const std::uint64_t units : {1U, 700U, 3000U}) is_sound &= engine.maintain(units).ok();
    is_sound &= print(scene.name, upkeep.name, "portions", engine.mesh());
    is_sound &= engine.maintain().ok();
    is_sound &= print(scene.name, upkeep.name, "rest", engine.mesh());
  }
  while (engine.undo()) {
  }
  return is_sound & print(scene.name, upkeep.name, "taken_back", engine.mesh());
}

bool run_improved(const Upkeep& upkeep, unsigned threads) {
  TetSoup soup = kuhn_cube(6);
  jitter(soup, 0.3, 8);
  Engine engine = make_engine(std::move(soup), upkeep, threads);
  return engine.improve().ok() && print("rough", upkeep.name, "improved", engine.mesh());
}

bool run_all_maintained(unsigned threads) {
  const std::array<Upkeep, 4> upkeeps = {{{"incise_snap", Profile::kIncise, 0.2, kUnlimitedWork},
                                          {"incise_no_snap", Profile::kIncise, 0, kUnlimitedWork},
                                          {"incise_budget", Profile::kIncise, 0, 2000},
                                          {"paper", Profile::kPaper, 0, kUnlimitedWork}}};
  bool is_sound = true;
  for (const Upkeep& upkeep : upkeeps) {
    for (const Scene& scene : scenes()) is_sound &= run_maintained(scene, upkeep, threads);
    is_sound &= run_improved(upkeep, threads);
  }
  return is_sound;
}

/// A ball in two halves, a thin plate in one of them.
image::LabelImage halves() {
  image::LabelImage image;
  image.size = {30, 28, 26};
  image.step = {Vec3(-1, 0.1, 0), Vec3(0.1, 1, 0), Vec3(0, 0, 1.25)};
  image.labels = {0, 1, 2, 5};
  for (int v = 0; v < 30 * 28 * 26; ++v) {
    const double x = v % 30 - 14.4, y = v / 30 % 28 - 13.7, z = 1.25 * (v / 840 - 12.6);
    const std::uint16_t half = x + 0.3 * y > 0.2 ? 1 : (y > 3 && y < 5.5 ? 3 : 2);
    image.voxels.push_back(x * x + y * y + z * z < 144 ? half : std::uint16_t{0});
  }
  return image;
}

bool run_label_image(unsigned threads) {
  image::MeshLabelsOptions options;
  options.size = 3;
  options.threads = threads;
  const Result<image::LabelMesh> mesh = image::mesh_labels(halves(), options);
  return mesh.ok() && print("halves", "image", "meshed", mesh->mesh);
}

}  // namespace
}  // namespace incise::test

int main(int argc, char** argv) {
  using namespace incise::test;
  unsigned threads = 1;
  if (argc == 3 && std::strcmp(argv[1], "--threads") == 0) {
    threads = static_cast<unsigned>(std::atoi(argv[2]));
  } else if (argc != 1) {
    std::fprintf(stderr, "usage: incise_determinism [--threads N]\n");
    return 2;
  }
  bool is_sound = true;
  for (const Scene& scene : scenes()) {
    is_sound &= run(scene, incise::Profile::kIncise, threads);
    is_sound &= run(scene, incise::Profile::kPaper, threads);
  }
  is_sound &= run_all_steps(threads);
  is_sound &= run_all_maintained(threads);
  is_sound &= run_all_simulated(threads);
  is_sound &= run_label_image(threads);
  return is_sound ? 0 : 1;
}
