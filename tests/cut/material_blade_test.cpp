// SPDX-License-Identifier: Apache-2.0
// Where points of a blade stand at rest, beside a body that moves.
#include "cut/material_blade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "incise/mesh/journal.h"
#include "support/bodies.h"
#include "support/engines.h"

namespace incise::test {
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

}  // namespace
}  // namespace incise::test
