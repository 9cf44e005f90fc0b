// SPDX-License-Identifier: Apache-2.0
#include "image/mend_manifold.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "image/octree.h"
#include "incise/mesh/defects.h"

namespace incise::mend_manifold_test {
namespace {

using image::LabelIndex;
using image::LabelledTets;

LabelledTets lattice(std::int32_t n) {
  const image::Octree tree(Vec3(0, 0, 0), 1, {n, n, n}, 0);
  image::LatticeTets tets = tree.fill([](std::size_t) { return false; });
  return {std::move(tets.points), std::move(tets.tets), {}};
}

Vec3 middle_of(const LabelledTets& mesh, std::size_t tet) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t p : mesh.tets[tet]) sum += 0.25 * mesh.points[p];
  return sum;
}

Defects defects_of(const LabelledTets& mesh, LabelIndex least, LabelIndex most) {
  TetSoup soup;
  soup.points = mesh.points;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.labels[t] >= least && mesh.labels[t] <= most) soup.tets.push_back(mesh.tets[t]);
  }
  return find_defects(soup);
}

void expect_manifold(const LabelledTets& mesh, LabelIndex most) {
  for (LabelIndex label = 1; label <= most; ++label) {
    const Defects defects = defects_of(mesh, label, label);
    EXPECT_EQ(defects.nonmanifold_edges, 0U) << label;
    EXPECT_EQ(defects.singleton_vertices, 0U) << label;
  }
  const Defects whole = defects_of(mesh, 1, most);
  EXPECT_EQ(whole.nonmanifold_edges + whole.singleton_vertices, 0U);
}

TEST(MendManifold, leaves_alone_what_is_sound) {
  LabelledTets mesh = lattice(8);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    mesh.labels.push_back((middle_of(mesh, t) - Vec3(4, 4, 4)).norm() < 2.5);
  const auto before = mesh.labels;
  const image::ManifoldRepair repair = image::mend_manifold(mesh);
  EXPECT_EQ(repair.left, 0U);
  expect_manifold(mesh, 1);
  EXPECT_LE(repair.relabelled, before.size() / 100);
}

TEST(MendManifold, parts_what_touches_in_an_edge) {
  LabelledTets mesh = lattice(8);
  mesh.labels.assign(mesh.tets.size(), 0);
  // A tet in the middle, and one that shares an edge with it and no face.
  std::size_t first = 0;
  while ((middle_of(mesh, first) - Vec3(4, 4, 4)).norm() > 0.6) ++first;
  const auto shared = [&](std::size_t t) {
    return std::count_if(mesh.tets[t].begin(), mesh.tets[t].end(), [&](std::uint32_t p) {
      return std::find(mesh.tets[first].begin(), mesh.tets[first].end(), p) != mesh.tets[first].end();
    });
  };
  std::size_t second = 0;
  while (shared(second) != 2) ++second;
  mesh.labels[first] = mesh.labels[second] = 1;
  EXPECT_GT(defects_of(mesh, 1, 1).nonmanifold_edges, 0U);
  const image::ManifoldRepair repair = image::mend_manifold(mesh);
  EXPECT_EQ(repair.left, 0U);
  EXPECT_GT(repair.relabelled, 0U);
  expect_manifold(mesh, 1);
}

TEST(MendManifold, comes_to_an_end_on_noise) {
  LabelledTets mesh = lattice(10);
  std::uint32_t random = 5;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    random = random * 1664525U + 1013904223U;
    const bool is_outside = (middle_of(mesh, t) - Vec3(5, 5, 5)).cwiseAbs().maxCoeff() > 3.5;
    mesh.labels.push_back(is_outside ? LabelIndex{0} : static_cast<LabelIndex>((random >> 28U) % 4));
  }
  EXPECT_EQ(image::mend_manifold(mesh).left, 0U);
  expect_manifold(mesh, 3);
}

}  // namespace
}  // namespace incise::mend_manifold_test
