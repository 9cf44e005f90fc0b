// SPDX-License-Identifier: Apache-2.0
// Tets all corners of which lie on the sheet: the incision passes them on one side.
#include "paper/flat_tets.h"

#include <gtest/gtest.h>

#include "incise/mesh/transaction.h"
#include "paper_support.h"

namespace incise::test::flat_tets_test {
namespace {

/// A flat tet along the sheet z = 0.02, with three tets above its upper faces and one below.
class FlatTetsTest : public ::testing::Test {
 protected:
  FlatTetsTest() : surface_(sweep(quad_stroke({-1, -1, 0.02}, {2, -1, 0.02}, {2, 2, 0.02}, {-1, 2, 0.02}))) {
    TetSoup soup;
    soup.points = {Vec3(0, 0, 0),        Vec3(1, 0, 0),     Vec3(0, 1, 0),
                   Vec3(0.3, 0.3, 0.05), Vec3(0.3, 0.3, 1), Vec3(0.3, 0.3, -1)};
    soup.tets = {{0, 1, 2, 3}, {0, 1, 3, 4}, {1, 2, 3, 4}, {2, 0, 3, 4}, {0, 2, 1, 5}};
    mesh_ = build(std::move(soup));
    near_.clear(mesh_);
    mesh_.for_each_vertex([&](VertexId v) {
      if (std::abs(mesh_.rest(v).z()) < 0.5) near_.mark_on(v);
    });
    mesh_.for_each_tet([&](TetId tet) {
      if (are_on(tet)) flat_ = tet;
    });
  }
  [[nodiscard]] bool are_on(TetId tet) const {
    const TetVertices& v = mesh_.vertices(tet);
    return std::all_of(v.begin(), v.end(), [&](VertexId w) { return near_.is_on[w.value] != 0; });
  }
  /// Whether a side of the flat tet is one of the upper ones.
  [[nodiscard]] bool is_upper(Side side) const {
    const auto v = mesh_.vertices(side);
    return std::any_of(v.begin(), v.end(), [&](VertexId w) { return mesh_.rest(w).z() > 0; });
  }
  /// The sides of the flat tet by which it is joined.
  [[nodiscard]] std::vector<IncisionFace> joined() const {
    std::vector<IncisionFace> faces;
    for (unsigned s = 0; s < 4; ++s) {
      const Side side(flat_, s);
      if (!mesh_.link(side).is_boundary()) faces.push_back({side, mesh_.link(side).side()});
    }
    return faces;
  }
  void open(bool upper) {
    Transaction transaction(mesh_);
    for (const IncisionFace& face : joined()) {
      if (is_upper(face.a) == upper) transaction.open(face.a, face.b, 7);
    }
    transaction.commit();
  }
  [[nodiscard]] std::vector<IncisionFace> kept() {
    std::vector<IncisionFace> faces = joined();
    keep_flat_tets_joined(mesh_, near_, points_, Sheet(surface_), 7, walker_, faces);
    return faces;
  }

  SweptSurface surface_;
  TetMesh mesh_;
  Neighbourhood near_;
  StarWalker walker_;
  std::vector<CollisionPoint> points_;
  TetId flat_;
};

TEST_F(FlatTetsTest, stay_joined_to_what_is_below_the_sheet) {
  ASSERT_EQ(joined().size(), 4U);
  const std::vector<IncisionFace> faces = kept();
  EXPECT_EQ(faces.size(), 3U);
  EXPECT_TRUE(std::all_of(faces.begin(), faces.end(), [&](const IncisionFace& face) { return is_upper(face.a); }));
}

TEST_F(FlatTetsTest, stay_on_the_lip_that_they_are_on) {
  open(/*upper=*/false);
  ASSERT_EQ(joined().size(), 3U);
  EXPECT_TRUE(kept().empty()) << "on the upper lip: above them is tissue";
}

TEST_F(FlatTetsTest, stay_on_the_lower_lip) {
  open(/*upper=*/true);
  ASSERT_EQ(joined().size(), 1U);
  EXPECT_TRUE(kept().empty());
}

TEST_F(FlatTetsTest, are_no_tips_of_what_is_cut_off_from_an_older_wall) {
  open(/*upper=*/false);
  const VertexId made = mesh_.vertices(flat_)[0];
  points_.push_back({made, mesh_.generation(made), Vec3(0, 0, 1), mesh_.rest(made), /*is_split=*/true});
  EXPECT_TRUE(kept().empty()) << "all that it is joined to lies above the sheet";
}

TEST_F(FlatTetsTest, are_those_alone_all_corners_of_which_lie_on_the_sheet) {
  near_.is_on[mesh_.vertices(flat_)[0].value] = 0;
  EXPECT_EQ(kept().size(), 4U);
}

}  // namespace
}  // namespace incise::test::flat_tets_test
