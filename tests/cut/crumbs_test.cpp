// SPDX-License-Identifier: Apache-2.0
// Debris of a blade stays with a piece.
#include "cut/crumbs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "incise/mesh/shapes.h"
#include "support/engines.h"

namespace incise::test::crumbs_test {
namespace {

/// All faces of two neighbours that lead to other tets, the one between them first: cut, both are crumbs.
struct CutOut {
  TetMesh mesh = build(kuhn_cube(3));
  TetId a, b;
  std::vector<IncisionFace> faces;

  CutOut() {
    // Of two tets in the middle of the cube, what they share is a largest face of both.
    mesh.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4 && !a.is_valid(); ++s) {
        const Link link = mesh.links(tet)[s];
        if (!is_inside(tet) || link.is_boundary() || !is_inside(link.side().tet())) continue;
        if (area(Side(tet, s)) < largest(tet) || area(Side(tet, s)) < largest(link.side().tet())) continue;
        a = tet;
        b = link.side().tet();
        faces.push_back({Side(tet, s), link.side()});
      }
    });
    for (const TetId tet : {a, b}) {
      for (unsigned s = 0; s < 4; ++s) {
        const Side behind = mesh.links(tet)[s].side();
        if (behind.tet() != a && behind.tet() != b) faces.push_back({Side(tet, s), behind});
      }
    }
  }
  [[nodiscard]] bool is_inside(TetId tet) const {
    return std::none_of(mesh.links(tet).begin(), mesh.links(tet).end(), [](Link l) { return l.is_boundary(); });
  }
  [[nodiscard]] double area(Side side) const {
    const auto v = mesh.vertices(side);
    return (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0])).norm();
  }
  [[nodiscard]] double largest(TetId tet) const {
    double most = 0;
    for (unsigned s = 0; s < 4; ++s) most = std::max(most, area(Side(tet, s)));
    return most * (1 - 1e-12);
  }
  /// Whether a tet hangs on others than the two, over faces that were dropped, be it by the other one.
  [[nodiscard]] bool hangs(TetId tet, const std::vector<IncisionFace>& dropped) const {
    bool meets_other = false, is_out = false;
    const auto look = [&](TetId from) {
      for (const IncisionFace& face : dropped) {
        if (face.a.tet() != from && face.b.tet() != from) continue;
        const TetId behind = face.a.tet() == from ? face.b.tet() : face.a.tet();
        (behind == a || behind == b ? meets_other : is_out) = true;
      }
    };
    look(tet);
    if (meets_other) look(tet == a ? b : a);
    return is_out;
  }
};

CrumbRules all_are_crumbs() {
  CrumbRules rules;
  rules.limit = [](TetId) { return 0.1; };
  return rules;
}

TEST(Crumbs, side_by_side_hang_on_the_body_not_on_each_other) {
  CutOut cut;
  ASSERT_EQ(cut.faces.size(), 7U);
  std::vector<IncisionFace> incision = cut.faces, dropped;
  CrumbScratch scratch;
  EXPECT_EQ(keep_crumbs(cut.mesh, all_are_crumbs(), incision, dropped, scratch), 2U);
  EXPECT_EQ(incision.size() + dropped.size(), 7U);
  EXPECT_TRUE(cut.hangs(cut.a, dropped));
  EXPECT_TRUE(cut.hangs(cut.b, dropped));
}

TEST(Crumbs, hang_on_no_face_that_stood_open_before) {
  CutOut cut;
  CrumbRules rules = all_are_crumbs();
  rules.stands_open = [&](const IncisionFace& face) { return face.a.tet() == cut.a && face.b.tet() != cut.b; };
  std::vector<IncisionFace> incision = cut.faces, dropped;
  CrumbScratch scratch;
  EXPECT_EQ(keep_crumbs(cut.mesh, rules, incision, dropped, scratch), 2U);
  EXPECT_TRUE(std::none_of(dropped.begin(), dropped.end(), rules.stands_open));
  EXPECT_TRUE(cut.hangs(cut.a, dropped)) << "by the other one";
  EXPECT_TRUE(cut.hangs(cut.b, dropped));
}

TEST(Crumbs, of_a_piece_that_is_all_crumbs_stay_together) {
  CutOut cut;
  CrumbRules rules = all_are_crumbs();
  rules.are_apart = [&](TetId x, TetId y) { return (x == cut.a || x == cut.b) != (y == cut.a || y == cut.b); };
  std::vector<IncisionFace> incision = cut.faces, dropped;
  CrumbScratch scratch;
  EXPECT_EQ(keep_crumbs(cut.mesh, rules, incision, dropped, scratch), 1U);
  EXPECT_EQ(incision.size(), 6U);
  ASSERT_EQ(dropped.size(), 1U);
  EXPECT_EQ(dropped.front().a, cut.faces.front().a) << "the face between the two";
}

TEST(Crumbs, that_may_hang_on_nothing_fall) {
  CutOut cut;
  CrumbRules rules = all_are_crumbs();
  rules.are_apart = [](TetId, TetId) { return true; };
  std::vector<IncisionFace> incision = cut.faces, dropped;
  CrumbScratch scratch;
  EXPECT_EQ(keep_crumbs(cut.mesh, rules, incision, dropped, scratch), 0U);
  EXPECT_EQ(incision.size(), 7U);
}

TEST(Crumbs, are_smaller_than_the_limit) {
  CutOut cut;
  CrumbRules rules = all_are_crumbs();
  rules.limit = [&](TetId) { return 0.5 * cut.mesh.rest_volume(cut.a); };
  std::vector<IncisionFace> incision = cut.faces, dropped;
  CrumbScratch scratch;
  EXPECT_EQ(keep_crumbs(cut.mesh, rules, incision, dropped, scratch), 0U);
  EXPECT_TRUE(dropped.empty());
}

}  // namespace
}  // namespace incise::test::crumbs_test
