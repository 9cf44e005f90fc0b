// SPDX-License-Identifier: Apache-2.0
// Faces between collision points around a corner of the sheet: those that span the corner are no incision faces.
#include "paper/sheet_sides.h"

#include <gtest/gtest.h>

#include <utility>

#include "incise/geom/predicates.h"
#include "paper_support.h"

namespace incise::test::sheet_sides_test {
namespace {

/// Two tets with one face in common, a triangle across the corner of a sheet that comes along +y and goes on along +x.
class SheetSidesTest : public ::testing::Test {
 protected:
  /// `tip`, beyond the face towards the corner, and `far` are the corners of the two tets besides the face's.
  explicit SheetSidesTest(const Vec3& tip = {0.1, 0.1, 0.5}, const Vec3& far = {1.0, 1.0, 0.4}) {
    TetSoup soup;
    soup.points = {Vec3(0, 0.8, 0), Vec3(0, 0.8, 1), Vec3(0.8, 0, 0.5), tip, far};
    soup.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    if (orient3d(soup.points[0], soup.points[1], soup.points[2], soup.points[3]) < 0) {
      for (auto& tet : soup.tets) std::swap(tet[0], tet[1]);
    }
    mesh_ = build(std::move(soup));
    mesh_.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        const Side side(tet, s);
        if (!mesh_.link(side).is_boundary()) face_ = {side, mesh_.link(side).side()};
      }
    });
    mesh_.for_each_vertex([&](VertexId v) {
      const Vec3& place = mesh_.rest(v);
      if (place.x() == 0) points_.push_back({v, mesh_.generation(v), Vec3(1, 0, 0)});
      if (place.y() == 0) points_.push_back({v, mesh_.generation(v), Vec3(0, -1, 0)});
    });
    EXPECT_EQ(points_.size(), 3U);
  }
  /// Down the plane x = 0, and on along y = 0.
  static SweptSurface corner() {
    return sweep(
        stroke_of({{Vec3(0, 2, -1), Vec3(0, 2, 2)}, {Vec3(0, 0, -1), Vec3(0, 0, 2)}, {Vec3(2, 0, -1), Vec3(2, 0, 2)}}));
  }
  [[nodiscard]] std::size_t kept(const SweptSurface& surface) const {
    const Sheet sheet(surface);
    std::vector<IncisionFace> incision = {face_};
    keep_between_sides(mesh_, points_, 1e-6, SheetSoFar(sheet), incision);
    return incision.size();
  }

  TetMesh mesh_;
  IncisionFace face_;
  std::vector<CollisionPoint> points_;
};

/// The tip of the corner is cut off by the face: the tet behind that lies outside.
class CutCornerTest : public SheetSidesTest {
 protected:
  CutCornerTest() : SheetSidesTest({-0.1, -0.1, 0.5}, {1.0, 1.0, 0.4}) {}
};

TEST_F(CutCornerTest, keeps_the_chord_that_stands_for_the_corner) {
  EXPECT_EQ(kept(corner()), 1U);
}

TEST_F(SheetSidesTest, drops_a_face_across_the_corner_with_tissue_of_one_side_behind_it) {
  EXPECT_EQ(kept(corner()), 0U);
}

TEST_F(SheetSidesTest, keeps_what_lies_along_one_part_of_the_sheet) {
  for (CollisionPoint& point : points_) point.normal = Vec3(1, 0, 0);
  EXPECT_EQ(kept(corner()), 1U);
}

TEST_F(SheetSidesTest, keeps_what_the_sheet_is_not_known_at) {
  const SweptSurface half = sweep(stroke_of({{Vec3(0, 2, -1), Vec3(0, 2, 2)}, {Vec3(0, 0, -1), Vec3(0, 0, 2)}}));
  EXPECT_EQ(kept(half), 1U);
}

}  // namespace

}  // namespace incise::test::sheet_sides_test
