// SPDX-License-Identifier: Apache-2.0
// A scan that was meshed by label is cut, maintained and simulated: labels are kept exactly, and borders between them
// stay where they were, as decision 14 has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "image/made_images.h"
#include "incise/engine/simulation.h"
#include "incise/geom/triangle_tree.h"
#include "incise/image/image_file.h"
#include "incise/image/mesh_labels.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/validate.h"
#include "support/random.h"
#include "support/random_strokes.h"

namespace incise::test::organ_cut_test {
namespace {

TetMesh meshed(const image::LabelImage& labels, double size, int halvings) {
  image::MeshLabelsOptions options;
  options.size = size;
  options.most_halvings = halvings;
  Result<image::LabelMesh> made = image::mesh_labels(labels, options);
  EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
  return std::move(made->mesh);
}

std::map<std::int32_t, double> volumes_of(const TetMesh& mesh) {
  std::map<std::int32_t, double> volumes;
  mesh.for_each_tet([&](TetId tet) { volumes[mesh.region(tet)] += mesh.rest_volume(tet); });
  return volumes;
}

/// Cuts and maintenance keep the volume of each label to rounding.
constexpr double kRounding = 1e-9;

void expect_same_volumes(const TetMesh& mesh, const std::map<std::int32_t, double>& before) {
  const std::map<std::int32_t, double> now = volumes_of(mesh);
  ASSERT_EQ(now.size(), before.size());
  for (const auto& [label, volume] : before) {
    EXPECT_NEAR(now.at(label) / volume, 1, kRounding) << "label " << label;
  }
}

/// The faces between each two labels, at rest.
class Borders {
 public:
  explicit Borders(const TetMesh& mesh) {
    std::vector<Vec3> points(mesh.vertex_slots(), Vec3::Zero());
    mesh.for_each_vertex([&](VertexId v) { points[v.value] = mesh.rest(v); });
    std::map<Pair, std::vector<TriangleTree::Triangle>> triangles;
    for_each(mesh, [&](const Pair& labels, const std::array<VertexId, 3>& v) {
      triangles[labels].push_back({v[0].value, v[1].value, v[2].value});
    });
    for (const auto& [labels, list] : triangles) trees_.emplace(labels, TriangleTree(points, list));
  }

  /// How far each corner of the borders of another mesh lies from these, in mean edges of its triangle; rising.
  [[nodiscard]] std::vector<double> distances(const TetMesh& mesh) const {
    std::vector<double> found;
    for_each(mesh, [&](const Pair& labels, const std::array<VertexId, 3>& v) {
      const Vec3 &a = mesh.rest(v[0]), &b = mesh.rest(v[1]), &c = mesh.rest(v[2]);
      const double edge = ((b - a).norm() + (c - b).norm() + (a - c).norm()) / 3;
      for (const Vec3& p : {a, b, c}) found.push_back(std::sqrt(trees_.at(labels).closest(p).distance2) / edge);
    });
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  using Pair = std::pair<std::int32_t, std::int32_t>;

  template <class Visit>
  static void for_each(const TetMesh& mesh, const Visit& visit) {
    mesh.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh.links(tet)[s];
        if (link.is_boundary() || !(mesh.region(tet) < mesh.region(link.side().tet()))) continue;
        visit(Pair(mesh.region(tet), mesh.region(link.side().tet())), mesh.vertices(Side(tet, s)));
      }
    });
  }

  std::map<Pair, TriangleTree> trees_;
};

/// Borders give way as surfaces do (decision 14): by a few hundredths of an edge for nearly all of their vertices.
void expect_borders_stay(const Borders& before, const TetMesh& mesh) {
  const std::vector<double> distances = before.distances(mesh);
  ASSERT_GT(distances.size(), 100U);
  EXPECT_LT(distances[distances.size() * 99 / 100], 0.04);
  EXPECT_LT(distances.back(), 0.25);
}

/// Planes through all of it and blades that end within, then undone.
void cut_and_judge(TetMesh mesh, bool is_maintained) {
  SCOPED_TRACE(is_maintained ? "maintained" : "as cut");
  const std::map<std::int32_t, double> volumes = volumes_of(mesh);
  const Borders borders(mesh);
  EngineOptions options;
  options.maintain.merge = options.maintain.improve = is_maintained;
  Engine engine = Engine::create(std::move(mesh), options).value();
  const std::uint64_t hash = engine.mesh().hash();
  Random random(7);
  for (int i = 0; i < 4; ++i) {
    SCOPED_TRACE("stroke " + std::to_string(i));
    const Box box = rest_bounds(engine.mesh());
    const Vec3 normal = random_direction(random);
    const Stroke stroke = i % 2 == 0 ? plane_stroke(box, normal, 0.5 * normal.dot(box.lo + box.hi)).value()
                                     : random_incision(random, box);
    ASSERT_TRUE(engine.cut(stroke).ok());
    const ValidityReport report = validate(engine.mesh(), ValidateLevel::kGeometry);
    EXPECT_TRUE(report.ok);
    expect_same_volumes(engine.mesh(), volumes);
    expect_borders_stay(borders, engine.mesh());
    EXPECT_TRUE(is_maintained || borders.distances(engine.mesh()).back() < kRounding);
  }
  while (engine.undo()) continue;
  EXPECT_EQ(engine.mesh().hash(), hash);
}

/// A blade that goes in from above in a body under its weight, held below.
void simulate_and_judge(TetMesh mesh) {
  const std::map<std::int32_t, double> volumes = volumes_of(mesh);
  const Borders borders(mesh);
  const Box box = rest_bounds(mesh);
  const Vec3 size = box.hi - box.lo;
  SimulationOptions options;
  options.body.length_unit = 0.001;
  options.materials.fallback.young = 6000;
  options.engine.maintain.work_units = 20000;
  Result<Simulation> made = Simulation::create(std::move(mesh), options);
  ASSERT_TRUE(made.ok()) << made.error().message;
  Simulation& simulation = *made;
  simulation.mesh().for_each_vertex([&](VertexId v) {
    if (simulation.mesh().rest(v).z() > box.lo.z() + 0.1 * size.z()) return;
    EXPECT_TRUE(simulation.body().hold(v, std::numeric_limits<double>::infinity()).ok());
  });
  const std::size_t before = simulation.mesh().tet_count();
  for (int i = 0; i < 40; ++i) {
    FrameInput input;
    const double x = box.lo.x() + size.x() * (0.3 + 0.01 * i);
    const double y = 0.5 * (box.lo.y() + box.hi.y());
    if (i >= 5 && i < 35) {
      input.blade = BladePose{{Vec3(x, y, box.hi.z() + 5), Vec3(x, y, box.lo.z() + 0.4 * size.z())}};
    }
    ASSERT_TRUE(simulation.frame(input).ok());
  }
  EXPECT_GT(simulation.mesh().tet_count(), before);
  EXPECT_TRUE(validate(simulation.mesh(), ValidateLevel::kGeometry).ok);
  simulation.mesh().for_each_vertex(
      [&](VertexId v) { EXPECT_TRUE(simulation.mesh().current(v).allFinite()) << v.value; });
  expect_same_volumes(simulation.mesh(), volumes);
  expect_borders_stay(borders, simulation.mesh());
}

/// The label image of a liver that libcgal-demo has; empty where it is not there.
std::filesystem::path liver_image() {
  std::vector<std::filesystem::path> places = {std::filesystem::path(INCISE_MODELS) / "liver.inr.gz"};
  if (const char* corpus = std::getenv("INCISE_CORPUS")) {
    places.push_back(std::filesystem::path(corpus) / "surfaces/cgal_liver.inr.gz");
  }
  for (const auto& place : places) {
    if (std::filesystem::exists(place)) return place;
  }
  return {};
}

TEST(OrganCut, a_spine_of_three_labels_is_cut_with_its_labels_kept) {
  const TetMesh mesh = meshed(incise_test::to_image(incise_test::spine_segment()), 6, 0);
  cut_and_judge(mesh, false);
  cut_and_judge(mesh, true);
}

TEST(OrganCut, a_spine_of_three_labels_is_simulated_with_its_labels_kept) {
  simulate_and_judge(meshed(incise_test::to_image(incise_test::spine_segment()), 8, 0));
}

TEST(OrganCut, a_liver_of_a_scan_is_cut_and_simulated_with_its_labels_kept) {
  const std::filesystem::path file = liver_image();
  if (file.empty()) GTEST_SKIP() << "no label image of a liver: script/models liver_image makes one";
  Result<image::ImageFile> scan = image::read_labels(file);
  ASSERT_TRUE(scan.ok()) << scan.error().message;
  const TetMesh mesh = meshed(scan->image, 12, 0);
  cut_and_judge(mesh, false);
  cut_and_judge(mesh, true);
  simulate_and_judge(mesh);
}

}  // namespace
}  // namespace incise::test::organ_cut_test
