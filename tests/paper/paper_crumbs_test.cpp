// SPDX-License-Identifier: Apache-2.0
// What counts as a crumb in the paper's profile.
#include "paper/paper_crumbs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "incise/mesh/components.h"
#include "incise/mesh/shapes.h"
#include "support/engines.h"

namespace incise::test::paper_crumbs_test {
namespace {

/// A tet of a cube of 750 that has four neighbours.
TetId inner_tet(const TetMesh& mesh) {
  TetId inner;
  mesh.for_each_tet([&](TetId tet) {
    const auto links = mesh.links(tet);
    const auto is_joined = [](Link link) { return !link.is_boundary(); };
    if (!inner.is_valid() && std::all_of(links.begin(), links.end(), is_joined)) inner = tet;
  });
  return inner;
}

std::vector<IncisionFace> faces_of(const TetMesh& mesh, TetId tet) {
  std::vector<IncisionFace> faces;
  for (unsigned s = 0; s < 4; ++s) faces.push_back({Side(tet, s), mesh.links(tet)[s].side()});
  return faces;
}

/// The cube with a tet whose one corner is drawn towards the opposite face, so that a share of its height is left.
TetMesh with_flat_tet(double height, const Vec3& scale, TetId& flat) {
  TetSoup soup = kuhn_cube(5);
  const TetMesh straight = build(soup);
  flat = inner_tet(straight);
  const TetVertices& v = straight.vertices(flat);
  const Vec3 foot = (straight.rest(v[1]) + straight.rest(v[2]) + straight.rest(v[3])) / 3;
  for (Vec3& point : soup.points) {
    if (point == straight.rest(v[0])) point = foot + height * (point - foot);
  }
  for (Vec3& point : soup.points) point = point.cwiseProduct(scale);
  return build(soup);
}

}  // namespace

TEST(PaperCrumbs, stay_joined) {
  TetId flat;
  const TetMesh mesh = with_flat_tet(0.3, Vec3(1, 1, 1), flat);
  std::vector<IncisionFace> incision = faces_of(mesh, flat);
  CrumbScratch scratch;
  EXPECT_EQ(keep_paper_crumbs(mesh, incision, scratch), 1U);
  EXPECT_EQ(incision.size(), 3U) << "by one face: what is beyond the others may be another piece";
}

TEST(PaperCrumbs, are_no_elements_however_small_or_long) {
  for (const Vec3& scale :
       {Vec3(1, 1, 1), Vec3(1e-6, 1e-6, 1e-6), Vec3(1e6, 1e6, 1e6), Vec3(40, 1, 1), Vec3(1, 0.02, 1)}) {
    TetId whole;
    const TetMesh mesh = with_flat_tet(1, scale, whole);
    std::vector<IncisionFace> incision = faces_of(mesh, whole);
    CrumbScratch scratch;
    EXPECT_EQ(keep_paper_crumbs(mesh, incision, scratch), 0U) << scale.transpose();
    EXPECT_EQ(incision.size(), 4U) << scale.transpose();
  }
}

/// A corner of a hundredth of a tet, x + y + z < 0.05, in one frame and in ten.
TEST(PaperCrumbs, come_off_at_rest) {
  EngineOptions options;
  options.cut.profile = Profile::kPaper;
  for (const int frames : {1, 10}) {
    Engine engine = Engine::create(build(kuhn_cube(5)), options).value();
    const auto row = [&](int k) {
      const Vec3 middle = Vec3(1, 1, 1) * (0.05 / 3) + (2.0 * k / frames - 1) * Vec3(1, -1, 0), along(1, 1, -2);
      return BladePose{{middle - along, middle + along}};
    };
    ASSERT_TRUE(engine.begin_stroke(row(0)).ok());
    for (int k = 1; k <= frames; ++k) ASSERT_TRUE(engine.step(row(k)).ok());
    ASSERT_TRUE(engine.end_stroke().ok());
    EXPECT_EQ(find_components(engine.mesh()).count(), 2U) << frames;
  }
}

}  // namespace incise::test::paper_crumbs_test
