// SPDX-License-Identifier: Apache-2.0
// What the front of an incision keeps: the points at which tissue is left on both sides of the sheet.
#include "paper/incision_front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "incise/mesh/transaction.h"
#include "paper/paper_cut.h"
#include "paper_support.h"

namespace incise::test::incision_front_test {
namespace {

/// The plane x = 0.5 in the unit cube, for z from below to a height.
SweptSurface swept_up_to(double z) {
  return sweep(quad_stroke({0.5, -0.2, -0.2}, {0.5, 1.2, -0.2}, {0.5, -0.2, z}, {0.5, 1.2, z}));
}

class IncisionFrontTest : public ::testing::Test {
 protected:
  IncisionFrontTest() : mesh_(build(kuhn_cube(4))), centre_(vertex_at(mesh_, {0.5, 0.5, 0.5})) {}

  [[nodiscard]] bool is_in_quarter(TetId tet) const {
    Vec3 middle = Vec3::Zero();
    for (const VertexId v : mesh_.vertices(tet)) middle += 0.25 * mesh_.rest(v);
    return middle.x() > 0.5 && middle.y() > 0.5;
  }
  /// Parts one quarter of the tets around the centre, x > 0.5 and y > 0.5, from the others: it, or they, get the copy.
  VertexId divide(bool quarter_gets_copy) {
    const std::vector<TetId> star = walker_.star(mesh_, centre_);
    Transaction transaction(mesh_);
    const VertexId copy = transaction.copy_vertex(centre_);
    for (const TetId tet : star) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(tet)[s];
        if (mesh_.vertices(tet)[s] == centre_ || link.is_boundary()) continue;
        if (is_in_quarter(tet) != is_in_quarter(link.side().tet())) transaction.open({tet, s}, link.side(), 1);
      }
    }
    for (const TetId tet : star) {
      const bool gets_copy = is_in_quarter(tet) == quarter_gets_copy;
      if (gets_copy) transaction.set_corner(tet, mesh_.corner_of(tet, centre_), copy);
      transaction.set_tet_of(gets_copy ? copy : centre_, tet);
    }
    for (const VertexId v : {centre_, copy}) transaction.set_shape(v, shape::kWall);
    step_ = transaction.commit();
    return copy;
  }

  static Sheet whole(const SweptSurface& surface) {
    std::vector<std::uint32_t> all(surface.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    return {surface, all};
  }

  /// A front that a sheet has left, of the centre alone.
  IncisionFront front_at_centre() {
    const SweptSurface surface = swept_up_to(0.6);
    Neighbourhood near;
    near.clear(mesh_);
    near.mark_on(centre_);
    near.coincidence = 1e-6;
    IncisionFront front;
    front.take(mesh_, whole(surface), near, walker_);
    return front;
  }

  /// The vertices that take part in a cut along the plane up to a height.
  std::vector<VertexId> met_by(const SweptSurface& surface, IncisionFront front = {}, std::uint32_t tag = 1) {
    Neighbourhood near;
    near.clear(mesh_);
    mesh_.for_each_tet([&](TetId tet) {
      near.tets.emplace_back();
      near.tets.back().id = tet;
    });
    const Strip strip(surface, {});
    front.mark(mesh_, SheetSoFar(strip), tag, near, walker_);
    return near.on;
  }

  TetMesh mesh_;
  VertexId centre_;
  StarWalker walker_;
  Step step_;
};

TEST_F(IncisionFrontTest, keeps_what_is_divided_in_one_place_and_joined_in_another) {
  IncisionFront front = front_at_centre();
  ASSERT_EQ(front.vertices(mesh_), std::vector{centre_});
  divide(/*quarter_gets_copy=*/true);
  const SweptSurface surface = swept_up_to(0.6);
  front.follow(mesh_, whole(surface), step_, walker_);
  EXPECT_EQ(front.vertices(mesh_), std::vector{centre_}) << "below y = 0.5 its tets meet across the plane";
  front.leave_lips(mesh_, walker_);
  EXPECT_EQ(front.vertices(mesh_), std::vector{centre_});
}

TEST_F(IncisionFrontTest, keeps_the_copy_where_that_is_joined) {
  IncisionFront front = front_at_centre();
  const VertexId copy = divide(/*quarter_gets_copy=*/false);
  const SweptSurface surface = swept_up_to(0.6);
  front.follow(mesh_, whole(surface), step_, walker_);
  EXPECT_EQ(front.vertices(mesh_), std::vector{copy});
  front.leave_lips(mesh_, walker_);
  EXPECT_EQ(front.vertices(mesh_), std::vector{copy});
}

TEST_F(IncisionFrontTest, leaves_the_lips_of_a_bent_sheet_once_its_stroke_has_ended) {
  Journal journal;
  StageTimes times;
  PaperCutter cutter(1);
  const auto bent = [](double z) { return 0.4 + 0.8 * (z - z * z); };
  Stroke stroke;
  for (double z = -0.2; z < 1.3; z += 0.1) {
    stroke.times.push_back(z);
    stroke.edges.push_back({{bent(z), -0.2, z}, {bent(z), 1.2, z}});
  }
  ASSERT_TRUE(cutter.cut(mesh_, journal, stroke, 1, times).ok());
  ASSERT_EQ(piece_volumes(mesh_).size(), 2U);
  EXPECT_TRUE(cutter.front().is_empty()) << "neighbours on a bent lip lie on both sides of each other's planes";
}

TEST_F(IncisionFrontTest, goes_on_at_points_of_an_earlier_sheet_that_are_no_walls_yet) {
  IncisionFront front = front_at_centre();
  front.begin_sheet();
  EXPECT_EQ(met_by(swept_up_to(0.4), front), std::vector{centre_});
  const SweptSurface oblique =
      sweep(quad_stroke({0.45, -0.2, -0.2}, {0.45, 1.2, -0.2}, {0.5, -0.2, 0.45}, {0.5, 1.2, 0.45}));
  EXPECT_EQ(met_by(oblique, front), std::vector{centre_}) << "by a hand that does not come back to the plane itself";
}

TEST_F(IncisionFrontTest, goes_on_where_a_sheet_passes_the_rim_of_an_earlier_one) {
  const SweptSurface surface = swept_up_to(0.6);
  const Strip earlier(surface, {});
  IncisionFront front = front_at_centre();
  front.end_sheet(mesh_, earlier.border);
  front.begin_sheet();
  // From the rim at z = 0.6 on, leaning by 40 degrees: the point below it does not lie in the plane of that sheet.
  const SweptSurface bent = sweep(quad_stroke({0.5, -0.2, 0.6}, {0.5, 1.2, 0.6}, {0.92, -0.2, 1.1}, {0.92, 1.2, 1.1}));
  EXPECT_EQ(met_by(bent, front), std::vector{centre_});
  const SweptSurface elsewhere =
      sweep(quad_stroke({0.45, -0.2, 0.6}, {0.45, 1.2, 0.6}, {0.87, -0.2, 1.1}, {0.87, 1.2, 1.1}));
  EXPECT_TRUE(met_by(elsewhere, front).empty());
  const SweptSurface through =
      sweep(quad_stroke({0.5 - 0.42, -0.2, 0.1}, {0.5 - 0.42, 1.2, 0.1}, {0.92, -0.2, 1.1}, {0.92, 1.2, 1.1}));
  EXPECT_TRUE(met_by(through, front).empty()) << "one that crosses at the rim goes on from none";
}

TEST_F(IncisionFrontTest, takes_the_wall_of_an_older_stroke_beside_the_sheet_for_its_own) {
  divide(/*quarter_gets_copy=*/true);
  const auto beside = [](double x) {
    return sweep(quad_stroke({x, -0.2, -0.2}, {x, 1.2, -0.2}, {x, -0.2, 0.6}, {x, 1.2, 0.6}));
  };
  EXPECT_EQ(met_by(beside(0.49), {}, 2).size(), 2U) << "maintenance has moved it: the vertex and its copy";
  EXPECT_TRUE(met_by(beside(0.49), {}, 1).empty()) << "one of its own is no older one";
  EXPECT_TRUE(met_by(beside(0.45), {}, 2).empty());
}

TEST_F(IncisionFrontTest, goes_on_at_a_wall_in_the_plane_that_tissue_joins) {
  divide(/*quarter_gets_copy=*/true);
  EXPECT_EQ(met_by(swept_up_to(0.4)), std::vector{centre_}) << "an edge from the sheet, in its plane";
}

TEST_F(IncisionFrontTest, leaves_walls_alone_that_are_not_in_the_plane_or_far_from_the_sheet_or_not_walls) {
  EXPECT_TRUE(met_by(swept_up_to(0.4)).empty()) << "no wall yet";
  divide(/*quarter_gets_copy=*/true);
  const SweptSurface far = sweep(quad_stroke({0.5, -0.2, -2}, {0.5, 1.2, -2}, {0.5, -0.2, -1}, {0.5, 1.2, -1}));
  EXPECT_TRUE(met_by(far).empty());
  const SweptSurface beside =
      sweep(quad_stroke({0.51, -0.2, -0.2}, {0.51, 1.2, -0.2}, {0.51, -0.2, 0.4}, {0.51, 1.2, 0.4}));
  EXPECT_TRUE(met_by(beside).empty());
  const SweptSurface across =
      sweep(quad_stroke({-0.2, -0.2, 0.5}, {-0.2, 1.2, 0.5}, {0.4, -0.2, 0.5}, {0.4, 1.2, 0.5}));
  EXPECT_TRUE(met_by(across).empty()) << "a wall across the sheet ends nothing";
}

}  // namespace
}  // namespace incise::test::incision_front_test
