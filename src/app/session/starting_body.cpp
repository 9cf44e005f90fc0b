// SPDX-License-Identifier: Apache-2.0
// The patch of skin is a box with regions and a script. Organs are solids by signed distance, united smoothly, sampled
// into voxels and meshed as scans are.
#include "app/session/starting_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <system_error>
#include <utility>

#include "app/session/session.h"
#include "app/text/formatted.h"
#include "incise/image/mesh_labels.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_file.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr double kOrganUnit = 1e-3;  // m, of the bodies made here
constexpr std::int32_t kMuscle = 1, kFat = 2, kSkin = 3;

// --- the patch

Material tissue(double density, double young, double toughness) {
  Material material;
  material.density = density;
  material.young = young;
  material.poisson = 0.45;
  material.toughness = toughness;
  return material;
}

constexpr double kCutAlong = 31.3;   // y of the cut: between two rows of vertices
constexpr double kShownDepth = 4.6;  // mm of the cut, through the skin into the fat: shallower ones hardly open

/// A blade goes in, along and out; tip and upper end of its edge at each time.
SceneStroke demonstrated_stroke() {
  struct Key {
    double time, x, tip;
  };
  SceneStroke made;
  made.stroke.name = "incision";
  for (const Key& key :
       {Key{2.0, 24, 36}, Key{2.5, 26, 24 - kShownDepth}, Key{4.1, 58, 24 - kShownDepth}, Key{4.5, 61, 36}}) {
    made.stroke.times.push_back(key.time);
    made.stroke.edges.push_back(
        {Vec3(key.x, kCutAlong, key.tip + 7), Vec3(key.x, kCutAlong, key.tip + 3.5), Vec3(key.x, kCutAlong, key.tip)});
  }
  return made;
}

/// Beside the cut, further from it than it takes hold, so that it does not take the other lip as well.
SceneHook demonstrated_hook(double x, double side) {
  constexpr double kFrom = 6.4, kTo = 17.4;
  SceneHook hook;
  hook.name = side < 0 ? "near" : "far";
  hook.radius = 4;
  hook.stiffness = 60;
  hook.times = {5.0, 6.2, 3600};
  const Vec3 to(x, kCutAlong + side * kTo, 26);
  hook.positions = {Vec3(x, kCutAlong + side * kFrom, 24), to, to};
  return hook;
}

// --- organs, as solids that are inside below 0

/// Less by up to a quarter of `width` where two solids come near each other: they flow into one.
double smooth_union(double a, double b, double width) {
  const double near = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * width * near * near;
}

double ellipsoid(const Vec3& at, const Vec3& centre, const Vec3& radii) {
  return ((at - centre).cwiseQuotient(radii).norm() - 1) * radii.minCoeff();
}

double capsule(const Vec3& at, const Vec3& from, const Vec3& to, double radius) {
  const Vec3 way = to - from;
  const double share = std::clamp((at - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (at - from - share * way).norm() - radius;
}

double liver(const Vec3& at) {
  const double right = ellipsoid(at, {-30, 0, 0}, {52, 40, 34});
  const double left = ellipsoid(at, {34, 6, -2}, {58, 27, 22});
  const double lobes = smooth_union(right, left, 22);
  const double under = -22 - at.z() - 0.1 * at.x();  // it is flat below, and hollowed by what lies there
  const double hollow = -ellipsoid(at, {6, -6, -44}, {44, 36, 24});
  return std::max({lobes, under, hollow});
}

double vein(const Vec3& at) {
  const double across = std::hypot(at.y() - vein_bend(at.x()), at.z());
  return std::max({across - kVeinRadius, 6 - across, std::abs(at.x()) - 34});
}

double vertebra(const Vec3& at) {
  const double round = std::hypot(at.x() / 21, at.y() / 15);
  const double waist = 1 - 0.08 * std::cos(std::clamp(at.z() / 11, -1.0, 1.0) * std::numbers::pi / 2);
  double bone = std::max((round - waist) * 15, std::abs(at.z()) - 11);
  for (const double s : {-1.0, 1.0}) {
    bone = smooth_union(bone, capsule(at, {s * 12, -10, 3}, {s * 12, -24, 3}, 4.6), 5);   // pedicle
    bone = smooth_union(bone, capsule(at, {s * 12, -24, 3}, {0, -34, -1}, 4.6), 5);       // lamina
    bone = smooth_union(bone, capsule(at, {s * 12, -23, 3}, {s * 34, -29, 4}, 3.8), 5);   // transverse process
    bone = smooth_union(bone, capsule(at, {s * 13, -25, 1}, {s * 13, -28, 12}, 4.2), 4);  // articular process
    bone = smooth_union(bone, capsule(at, {s * 11, -26, 1}, {s * 11, -31, -12}, 4.0), 4);
  }
  bone = smooth_union(bone, capsule(at, {0, -34, -2}, {0, -56, -9}, 4.6), 6);  // spinous process
  const double canal = std::hypot(at.x() / 8.5, (at.y() + 22) / 7.5);
  return std::max(bone, (1 - canal) * 7.5);
}

struct OrganRow {
  double (*shape)(const Vec3&);
  Vec3 lo, hi;
  double voxel, size;  // mm
  int halvings;
};

OrganRow row_of(StartingBody organ) {
  if (organ == StartingBody::kLiver) return {liver, {-90, -48, -42}, {100, 48, 42}, 2, 8, 0};
  if (organ == StartingBody::kVein) return {vein, {-38, -16, -13}, {38, 16, 13}, 0.75, 2.2, 0};
  return {vertebra, {-42, -66, -20}, {42, 22, 20}, 1, 4, 0};
}

Scene organ_scene(StartingBody organ, const fs::path& mesh, const Box& body) {
  Scene scene = scene_of_mesh(mesh, body, Vec3::UnitZ());
  scene.name = kStartingBodies[static_cast<std::size_t>(organ)].text;
  scene.has_materials_by_name = false;
  scene.options.body.length_unit = kOrganUnit;
  scene.options.engine.maintain.work_units = 20'000;
  scene.hand.emplace().tool = ToolKind::kScalpel;
  SceneView& view = scene.view.emplace();
  Material& material = scene.options.materials.fallback;
  if (organ == StartingBody::kLiver) {
    material = tissue(1060, 8000, 50);
    view.look = TissueLook::kLiver;
    view.from = Vec3(0.3, -1, 0.85);
  } else if (organ == StartingBody::kVein) {
    material = tissue(1060, 100e3, 100);
    view.look = TissueLook::kVessel;
    view.from = Vec3(0.45, -1, 0.8);
    scene.tools.clear();
    scene.attachments = {{HalfSpace{Vec3::UnitX(), body.lo.x() + 3}, false},
                         {HalfSpace{-Vec3::UnitX(), -body.hi.x() + 3}, false}};
  } else {
    material = tissue(1200, 5e6, 100);
    material.poisson = 0.3;
    view.look = TissueLook::kBone;
    view.from = Vec3(0.7, -0.9, 0.8);
    scene.tools.clear();
    scene.attachments = {{HalfSpace{-Vec3::UnitY(), -8}, false}};
  }
  return scene;
}

}  // namespace

double vein_bend(double x) {
  return 2.5 * std::sin(x / 14);
}

Scene skin_patch() {
  Scene scene;
  scene.name = kStartingBodies[0].text;
  scene.model.box.cells = {16, 12, 8};
  scene.model.box.size = {84, 60, 24};
  scene.model.regions = {{kMuscle, "muscle", HalfSpace{Vec3::UnitZ(), 12}},
                         {kFat, "fat", HalfSpace{-Vec3::UnitZ(), -12}},
                         {kSkin, "skin", HalfSpace{-Vec3::UnitZ(), -21}}};
  scene.options.body.length_unit = kOrganUnit;
  scene.options.body.gravity = {0, 0, -9.81};
  scene.options.body.damping = 2;
  scene.options.body.self.on = true;
  scene.options.materials.fallback = tissue(1060, 12e3, 100);
  scene.options.materials.by_region = {
      {kMuscle, tissue(1060, 12e3, 100)}, {kFat, tissue(950, 4e3, 40)}, {kSkin, tissue(1100, 40e3, 200)}};
  scene.options.engine.maintain.work_units = 20'000;
  scene.attachments = {{HalfSpace{Vec3::UnitZ(), 0.1}, false},
                       {HalfSpace{Vec3::UnitX(), 0.1}, false, 100},
                       {HalfSpace{-Vec3::UnitX(), -83.9}, false, 100}};
  scene.strokes = {demonstrated_stroke()};
  for (const double side : {-1.0, 1.0}) {
    for (const double x : {37.0, 47.0}) scene.hooks.push_back(demonstrated_hook(x, side));
  }
  scene.settle.frames = 120;
  scene.frames = kMaxSceneFrames;
  SceneView& view = scene.view.emplace();
  view.from = Vec3(0.35, -1, 0.9);
  view.has_drapes = true;
  view.is_demonstration = true;
  scene.hand = HandPreset{ToolKind::kScalpel, kShownDepth, {}, {}, {}};
  return scene;
}

image::LabelImage voxels_of(StartingBody organ) {
  const OrganRow row = row_of(organ);
  image::LabelImage image;
  image.labels = {0, 1};
  image.origin = row.lo;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    image.step[i] = row.voxel * Vec3::Unit(axis);
    image.size[i] = static_cast<std::size_t>(std::ceil((row.hi - row.lo)[axis] / row.voxel)) + 1;
  }
  image.voxels.resize(image.size[0] * image.size[1] * image.size[2]);
  for (std::size_t k = 0; k < image.size[2]; ++k) {
    for (std::size_t j = 0; j < image.size[1]; ++j) {
      for (std::size_t i = 0; i < image.size[0]; ++i) {
        const Vec3 by(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        image.voxels[image.index(i, j, k)] = row.shape(row.lo + row.voxel * by) < 0 ? 1 : 0;
      }
    }
  }
  return image;
}

Result<Scene> scene_of(StartingBody body, const fs::path& folder) {
  if (body == StartingBody::kSkin || body >= StartingBody::kCount) return skin_patch();
  const OrganRow row = row_of(body);
  image::MeshLabelsOptions options;
  options.size = row.size;
  options.most_halvings = row.halvings;
  const Result<image::LabelMesh> made = image::mesh_labels(voxels_of(body), options);
  if (!made.ok()) return made.error();
  const char* name = kStartingBodies[static_cast<std::size_t>(body)].name;
  std::error_code code;
  const fs::path file = (folder.empty() ? fs::temp_directory_path(code) : folder) /
                        formatted("incise-{}-{:016x}.msh", name, made->mesh.hash());
  io::MeshData data = io::to_mesh_data(made->mesh, find_components(made->mesh));
  data.region_names = {{1, name}};
  io::WriteOptions written;
  written.msh = io::MshVariant::k41Binary;
  if (const Status status = io::write_mesh(file, data, written); !status.ok()) return status.error();
  return organ_scene(body, file, rest_bounds(made->mesh));
}

}  // namespace app
}  // namespace v0
}  // namespace incise
