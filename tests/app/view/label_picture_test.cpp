// SPDX-License-Identifier: Apache-2.0
#include "app/view/label_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "incise/mesh/shapes.h"

namespace label_picture_test {
namespace {

using namespace incise;

/// A box whose inner cells are another region, or not.
TetMesh box_with_core(bool has_core) {
  TetSoup soup = kuhn_box(Vec3(0, 0, 0), Vec3(1, 1, 1), {5, 5, 5});
  soup.regions.assign(soup.tets.size(), 1);
  for (std::size_t i = 0; has_core && i < soup.tets.size(); ++i) {
    Vec3 centre = Vec3::Zero();
    for (const std::uint32_t v : soup.tets[i]) centre += 0.25 * soup.points[v];
    if ((centre - Vec3::Constant(0.5)).cwiseAbs().maxCoeff() < 0.3) soup.regions[i] = 2;
  }
  return TetMesh::build(std::move(soup)).value();
}

std::set<unsigned> regions_seen(const app::Picture& picture) {
  std::set<unsigned> seen;
  for (const app::TriangleLook& look : picture.surface.topology->looks) {
    if ((look.flags & app::TriangleLook::kUnused) == 0) seen.insert(look.region);
  }
  return seen;
}

TEST(LabelPicture, ShowsRegionsThatLieInside) {
  const TetMesh mesh = box_with_core(true);
  const app::Picture picture = app::picture_of_labels(mesh, Journal(), {});
  EXPECT_EQ(regions_seen(picture), (std::set<unsigned>{1, 2}));
  EXPECT_EQ(picture.options.color, app::ColorBy::kRegion);
  // The half towards the eye, which is in front, is not there.
  float front = 0;
  for (const auto& point : picture.surface.positions) front = std::max(front, point.y());
  EXPECT_LT(front, 0.65F);
  EXPECT_GT(picture.camera.backward().y(), 0.5);
}

TEST(LabelPicture, LeavesABodyOfOneRegionWhole) {
  const TetMesh mesh = box_with_core(false);
  const app::Picture picture = app::picture_of_labels(mesh, Journal(), {});
  EXPECT_EQ(regions_seen(picture), (std::set<unsigned>{1}));
  float front = 0;
  for (const auto& point : picture.surface.positions) front = std::max(front, point.y());
  EXPECT_EQ(front, 1.0F);
}

}  // namespace

}  // namespace label_picture_test
