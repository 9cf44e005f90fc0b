// SPDX-License-Identifier: Apache-2.0
// Where points of a blade stand at rest, beside a body that moves.
#include "cut/material_blade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "incise/mesh/journal.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test::material_blade_test {
namespace {

constexpr double kSpacing = 0.25;

/// A cube that is pressed nearly flat: what its tets say of places beside them is a thousand times as far off.
class PressedCube : public testing::Test {
 protected:
  PressedCube() {
    std::vector<Vec3> current(mesh_.vertex_slots());
    mesh_.for_each_vertex([&](VertexId v) {
      current[v.value] = mesh_.rest(v);
      current[v.value].x() = 0.5 + 1e-3 * (mesh_.rest(v).x() - 0.5);
    });
    mesh_.set_current(current);
    surface_.follow(mesh_, Journal());
  }
  /// The blade goes by so much in every step; its front must stay near the cube, and leap no further than from one side
  /// of it to the other.
  void expect_calm(std::vector<Vec3> row, const Vec3& step) {
    blade_.begin(mesh_, surface_, row, kSpacing, complex_);
    double leap = 0, reach = 0;
    for (unsigned i = 0; i < 30; ++i) {
      for (Vec3& p : row) p += step;
      blade_.locate(mesh_, surface_, complex_, row, step.normalized());
      const std::vector<Vec3> before(blade_.anchors().begin(), blade_.anchors().end()), wanted = blade_.wanted();
      blade_.advance(mesh_, surface_, complex_);
      for (std::size_t k = 0; k < wanted.size(); ++k) {
        leap = std::max(leap, (wanted[k] - before[k]).norm());
        reach = std::max(reach, (wanted[k] - Vec3(0.5, 0.5, 0.5)).norm());
      }
    }
    EXPECT_LT(leap, 3.0);
    EXPECT_LT(reach, 8.0);
  }

  TetMesh mesh_ = build(jittered_cube(4, 3));
  SplitTemplates templates_;
  ClosedComplex complex_{templates_};
  SurfaceIndex surface_;
  MaterialBlade blade_;
};

TEST_F(PressedCube, does_not_throw_a_blade_that_leaves_it) {
  expect_calm({Vec3(0.5, -0.5, 0.5), Vec3(0.5, 1.5, 0.5)}, Vec3(0.05, 0, 0.01));
}

TEST_F(PressedCube, does_not_throw_a_blade_that_passes_it_by) {
  expect_calm({Vec3(0.6, -0.5, 0.5), Vec3(0.6, 1.5, 0.5)}, Vec3(0.05, 0, 0.01));
}

TEST_F(PressedCube, does_not_throw_a_blade_that_comes_to_it) {
  expect_calm({Vec3(-0.5, -0.5, 0.5), Vec3(-0.5, 1.5, 0.5)}, Vec3(0.05, 0, 0.0));
}

/// A body that flaps about a blade that gets on slowly: it slides along the edge, to and fro, and turns.
TEST(MaterialBlade, keeps_its_front_even_in_a_body_that_flaps) {
  TetMesh mesh = build(jittered_cube(5, 7));
  SplitTemplates templates;
  ClosedComplex complex(templates);
  SurfaceIndex surface;
  surface.follow(mesh, Journal());
  const double spacing = 0.2;
  std::vector<Vec3> row = {Vec3(-0.1, -0.3, 0.45), Vec3(-0.1, 1.3, 0.55)};
  MaterialBlade blade;
  blade.begin(mesh, surface, row, spacing, complex);
  double front = 0, edge = 0;
  for (unsigned i = 0; i < 60; ++i) {
    const double sway = std::sin(1.1 * i), turn = 0.3 * std::sin(0.7 * i);
    std::vector<Vec3> current(mesh.vertex_slots());
    mesh.for_each_vertex([&](VertexId v) {
      const Vec3 arm = mesh.rest(v) - Vec3(0.5, 0.5, 0.5);
      current[v.value] = Vec3(0.5 + arm.x() - turn * arm.y(), 0.5 + arm.y() + turn * arm.x() + 0.2 * sway,
                              0.5 + arm.z() + 0.1 * sway * arm.x());
    });
    mesh.set_current(current);
    for (Vec3& p : row) p.x() += 0.012;
    blade.locate(mesh, surface, complex, row, Vec3::Zero());
    const std::vector<Vec3> wanted = blade.wanted();
    blade.advance(mesh, surface, complex);
    const double part = (row[1] - row[0]).norm() / static_cast<double>(wanted.size() - 1);
    for (std::size_t k = 1; k < wanted.size(); ++k) {
      if (!blade.is_in_tissue(k) || !blade.is_in_tissue(k - 1)) continue;
      front += (wanted[k] - wanted[k - 1]).norm();
      edge += part;
    }
  }
  EXPECT_LT(front, 2 * edge);
}

/// Two cubes that have drawn apart: what each says of a place in between lies next to the other one at rest.
TEST(MaterialBlade, goes_by_the_body_that_it_is_nearest_to_where_two_name_each_other) {
  TetSoup soup = jittered_cube(2, 3);
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (const Vec3& p : jittered_cube(2, 3).points) soup.points.emplace_back(p + Vec3(3, 0, 0));
  for (const auto& tet : jittered_cube(2, 3).tets) {
    soup.tets.push_back({tet[0] + first, tet[1] + first, tet[2] + first, tet[3] + first});
  }
  TetMesh mesh = build(soup);
  std::vector<Vec3> current(mesh.vertex_slots());
  mesh.for_each_vertex([&](VertexId v) {
    const double way = mesh.rest(v).x() < 2 ? -2 : 2;
    current[v.value] = mesh.rest(v) + Vec3(way, 0, 0);
  });
  mesh.set_current(current);
  SplitTemplates templates;
  ClosedComplex complex(templates);
  SurfaceIndex surface;
  surface.follow(mesh, Journal());
  MaterialBlade blade;
  for (const double x : {1.9, 2.1}) {
    blade.begin(mesh, surface, std::vector<Vec3>{Vec3(x, 0.5, 0.2), Vec3(x, 0.5, 0.8)}, kSpacing, complex);
    for (const Vec3& anchor : blade.anchors()) EXPECT_NEAR(anchor.x(), x < 2 ? x + 2 : x - 2, 1e-9);
  }
}

}  // namespace
}  // namespace incise::test::material_blade_test
