// SPDX-License-Identifier: Apache-2.0
// Each region keeps its own volume, however the mesh around borders is improved.
#include "improve/region_volumes.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "improve/edge_collapse.h"
#include "improve/maintainer_cases.h"
#include "improve/smooth.h"

namespace incise::test::region_volumes_test {
namespace {

/// Six times the volume of each region.
std::map<std::int32_t, double> region_volumes6(const TetMesh& mesh) {
  std::map<std::int32_t, double> volumes;
  mesh.for_each_tet([&](TetId tet) { volumes[mesh.region(tet)] += mesh.rest_volume6(tet); });
  return volumes;
}

/// Labels a body by where the centroids of its tets lie in another one of the same tets.
template <class LabelOf>
TetSoup labelled(TetSoup soup, const TetSoup& plain, LabelOf&& label_of) {
  for (const auto& [a, b, c, d] : soup.tets) {
    soup.regions.push_back(label_of(0.25 * (plain.points[a] + plain.points[b] + plain.points[c] + plain.points[d])));
  }
  return soup;
}

struct Body {
  std::string name;
  TetSoup soup;
};

/// Notes the volumes of regions, and compares them with those of the same mesh later.
class RegionsOf {
 public:
  explicit RegionsOf(const TetMesh& mesh) : before_(region_volumes6(mesh)) {}
  void expect_kept(const TetMesh& mesh, double tolerance) const {
    const std::map<std::int32_t, double> after = region_volumes6(mesh);
    ASSERT_EQ(after.size(), before_.size());
    for (const auto& [region, volume6] : before_) {
      EXPECT_NEAR(after.at(region), volume6, tolerance * volume6) << "region " << region;
    }
  }

 private:
  std::map<std::int32_t, double> before_;
};

/// Cubes, even and round, with straight and curved borders, which meet skin at right angles, at others, or not at all.
std::vector<Body> labelled_bodies() {
  const TetSoup plain = kuhn_box(Vec3(-1, -1, -1), Vec3(1, 1, 1), {8, 8, 8});
  const auto half = [](const Vec3& p) { return p.x() < 0 ? 1 : 2; };
  const auto slice = [](const Vec3& p) { return p.x() < -0.25 ? 1 : (p.x() < 0.25 ? 2 : 3); };
  const auto core = [](const Vec3& p) { return p.cwiseAbs().maxCoeff() < 0.5 ? 2 : 1; };
  const auto tee = [](const Vec3& p) { return p.x() < 0 ? 1 : (p.y() < 0 ? 2 : 3); };
  const auto layers = [](const Vec3& p) { return p.z() > 0.5 ? 1 : (p.x() < 0 ? 2 : 3); };
  TetSoup rough = plain, round = plain;
  jitter(rough, 0.15, 3);
  for (Vec3& p : round.points) p += 0.1 * (3.0 - p.squaredNorm()) * p;
  TetSoup sheared = round;
  for (Vec3& p : sheared.points) p += Vec3(0.5 * p.y() + 0.2 * p.z() * p.z(), 0, 0);
  return {{"a straight border in a cube", labelled(plain, plain, half)},
          {"rough borders in a cube", labelled(rough, plain, slice)},
          {"rough layers of a cube", labelled(rough, plain, layers)},
          {"a straight border in a round body", labelled(round, plain, half)},
          {"a curved border inside a round body", labelled(round, plain, core)},
          {"curved borders that meet curved skin", labelled(round, plain, slice)},
          {"borders that meet skin at an angle", labelled(sheared, plain, slice)},
          {"three labels along a line in a round body", labelled(round, plain, tee)},
          {"three labels along a line, at an angle", labelled(sheared, plain, tee)}};
}

/// A stroke at random through the middle of a body: a plane, a wave, or one that stops inside.
Stroke random_stroke(const TetSoup& soup, Random& random) {
  const Vec3 normal = random.point(-1, 1).normalized();
  if (random.integer(0, 2) > 0) return plane_of(soup, normal, random.real(-0.4, 0.4));
  const Vec3 along = normal.cross(random.point(-1, 1)).normalized(), across = normal.cross(along);
  const Vec3 start = random.real(-0.3, 0.3) * normal - 1.8 * along;
  return quad_stroke(start - 2.0 * across, start + 2.0 * across, start + random.real(1.5, 2.2) * along - 2.0 * across,
                     start + random.real(1.5, 2.2) * along + 2.0 * across);
}

// --- one vertex

TEST(RegionVolumes, of_one_region_are_given_back_along_its_gradient) {
  RegionVolumes volumes;
  volumes.add(7, Vec3(0, 3, 0));
  volumes.add(7, Vec3(0, 0, 4));
  volumes.lose(7, 5.0);
  Vec3 step;
  ASSERT_TRUE(volumes.find_step(step));
  EXPECT_LT((step - Vec3(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(volumes.held().count, 1U);
}

TEST(RegionVolumes, of_two_that_share_a_border_alone_hold_one_direction) {
  RegionVolumes volumes;
  volumes.add(1, Vec3(2, 0, 0));
  volumes.add(2, Vec3(-2, 1e-15, 0));
  EXPECT_EQ(volumes.held().count, 1U);
  volumes.lose(1, 1.0);
  volumes.lose(2, -1.0);
  Vec3 step;
  ASSERT_TRUE(volumes.find_step(step));
  EXPECT_LT((step - Vec3(0.5, 0, 0)).norm(), 1e-15);
}

TEST(RegionVolumes, are_given_back_to_each_by_the_shortest_step) {
  const std::array<Vec3, 3> gradients = {Vec3(1, 0.2, 0), Vec3(-0.8, 0.5, 0), Vec3(0, 0.1, 0.7)};
  const std::array<double, 3> lost6 = {0.3, -0.1, 0.2};
  for (unsigned count = 1; count <= 3; ++count) {
    RegionVolumes volumes;
    for (unsigned i = 0; i < count; ++i) {
      volumes.add(static_cast<std::int32_t>(i), gradients[i]);
      volumes.lose(static_cast<std::int32_t>(i), lost6[i]);
    }
    Vec3 step, within = Vec3::Zero();
    ASSERT_TRUE(volumes.find_step(step));
    const RegionVolumes::Held held = volumes.held();
    EXPECT_EQ(held.count, count);
    for (unsigned i = 0; i < count; ++i) {
      EXPECT_NEAR(gradients[i].dot(step), lost6[i], 1e-15);
      within += held.directions[i].dot(step) * held.directions[i];
    }
    EXPECT_LT((within - step).norm(), 1e-15) << "longer than needed";
  }
}

TEST(RegionVolumes, that_no_step_gives_back_are_refused) {
  Vec3 step;
  RegionVolumes one_sided;
  one_sided.add(1, Vec3(1, 0, 0));
  one_sided.add(2, Vec3(-1, 0, 0));
  one_sided.lose(1, 0.1);
  EXPECT_FALSE(one_sided.find_step(step));
  RegionVolumes elsewhere;
  elsewhere.add(1, Vec3(1, 0, 0));
  elsewhere.lose(2, 0.1);
  EXPECT_FALSE(elsewhere.find_step(step));
  RegionVolumes four;
  for (int i = 0; i < 4; ++i) four.add(i, Vec3(i == 0, i == 1, i == 2) + Vec3(0.1, 0.1, 0.1));
  EXPECT_EQ(four.held().count, 3U);
  four.lose(3, 0.1);
  EXPECT_FALSE(four.find_step(step));
}

TEST(RegionVolumes, hold_surfaces_besides) {
  RegionVolumes volumes;
  volumes.add(1, Vec3(1, 1, 0));
  volumes.lose(1, 0.2);
  volumes.add_surface(Vec3(0, 1, 0), 0.0);
  Vec3 step;
  ASSERT_TRUE(volumes.find_step(step));
  EXPECT_LT((step - Vec3(0.2, 0, 0)).norm(), 1e-15);
}

// --- where borders meet what is curved

TEST(RegionVolumes, stay_where_vertices_of_borders_move) {
  for (const Body& body : labelled_bodies()) {
    SCOPED_TRACE(body.name);
    TetMesh mesh = cut_mesh(body.soup, coring_stroke(Vec3(0.13, 0.06, 0), 0.6, 24, -2.0, 2.0), 0.2);
    const RegionsOf regions(mesh);
    Smoother smoother;
    CareOf care(mesh);
    std::size_t moved = 0;
    for (unsigned round = 0; round < 3; ++round) {
      for (const VertexId v : vertices_of(mesh)) {
        if (!has_one_region(mesh, star_of(mesh, v)) && smoother.improve(care.care, v)) ++moved;
      }
    }
    care.commit();
    EXPECT_GT(moved, 10U);
    regions.expect_kept(mesh, 1e-13);
    expect_valid(mesh, volume_of(mesh));
  }
}

TEST(RegionVolumes, stay_where_vertices_merge_into_those_of_borders) {
  unsigned merged = 0;
  for (const Body& body : labelled_bodies()) {
    SCOPED_TRACE(body.name);
    TetMesh mesh = cut_mesh(body.soup, coring_stroke(Vec3(0.13, 0.06, 0), 0.6, 24, -2.0, 2.0));
    const RegionsOf regions(mesh);
    EdgeCollapser collapser;
    CareOf care(mesh);
    for (const VertexId v : vertices_of(mesh)) {
      if (!mesh.is_live(v) || mesh.origin(v).is_valid() || !collapser.thin_out(care.care, v)) continue;
      if (std::any_of(care.changed.begin(), care.changed.end(),
                      [&](TetId tet) { return mesh.region(tet) != mesh.region(care.changed.front()); })) {
        ++merged;
      }
    }
    care.commit();
    regions.expect_kept(mesh, 1e-13);
    expect_valid(mesh, volume_of(mesh));
  }
  EXPECT_GT(merged, 20U);
}

// --- all of maintenance

TEST(RegionVolumes, stay_under_random_strokes) {
  for (const Body& body : labelled_bodies()) {
    SCOPED_TRACE(body.name);
    for (std::uint64_t seed = 2; seed <= 3; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      Result<Engine> engine = Engine::create(build(body.soup));
      ASSERT_TRUE(engine.ok());
      const RegionsOf regions(engine->mesh());
      for (unsigned i = 0; i < 3; ++i) cut_and_maintain(*engine, random_stroke(body.soup, random));
      regions.expect_kept(engine->mesh(), 1e-11);
      const QualityStats quality = touched_quality(*engine);
      EXPECT_LE(quality.lr_max, 60);
      expect_valid(engine->mesh(), volume_of(engine->mesh()));
    }
  }
}

}  // namespace
}  // namespace incise::test::region_volumes_test
