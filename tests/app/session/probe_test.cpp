// SPDX-License-Identifier: Apache-2.0
#include "app/session/probe.h"

#include <gtest/gtest.h>

#include "app/view/viewed_body.h"
#include "incise/engine/engine.h"
#include "incise/geom/quality.h"

namespace incise::app::probe_test {
namespace {

Engine cut_cube() {
  Engine engine = Engine::create(cube_mesh(3), {}).value();
  const Box around{Vec3::Constant(-0.5), Vec3::Constant(1.5)};
  EXPECT_TRUE(engine.cut(plane_stroke(around, Vec3(1, 0.2, 0.1), 0.5).value()).ok());
  return engine;
}

template <class IsAsked>
Side find_side(const TetMesh& mesh, const IsAsked& is_asked) {
  Side found(TetId(0), 0);
  mesh.for_each_tet([&](TetId t) {
    for (unsigned s = 0; s < 4; ++s) {
      if (is_asked(mesh.links(t)[s])) found = Side(t, s);
    }
  });
  return found;
}

TEST(Probe, FiguresEqualTheQualityFunctions) {
  const Engine engine = cut_cube();
  const TetMesh& mesh = engine.mesh();
  mesh.for_each_tet([&](TetId t) {
    const ProbeInfo info = probe(mesh, Side(t, 2)).value();
    const auto& [a, b, c, d] = mesh.vertices(t);
    EXPECT_EQ(info.tet, t);
    EXPECT_EQ(info.vertices, mesh.vertices(t));
    EXPECT_EQ(info.region, mesh.region(t));
    EXPECT_EQ(info.lr, longest_edge_over_inradius(mesh.rest(a), mesh.rest(b), mesh.rest(c), mesh.rest(d)));
    const DihedralExtremes angles = dihedral_extremes_deg(mesh.rest(a), mesh.rest(b), mesh.rest(c), mesh.rest(d));
    EXPECT_EQ(info.dihedral_min_deg, angles.least);
    EXPECT_EQ(info.dihedral_max_deg, angles.greatest);
    EXPECT_EQ(info.volume, mesh.rest_volume(t));
    EXPECT_NEAR(info.stretch, 1, 1e-12);
    EXPECT_EQ(info.corners[3], mesh.current(d).cast<float>());
  });
}

TEST(Probe, TellsSkinWallsAndTheInsideApart) {
  const Engine engine = cut_cube();
  const TetMesh& mesh = engine.mesh();
  const auto line_of = [&](const auto& is_asked) {
    return to_lines(probe(mesh, find_side(mesh, is_asked)).value())[1];
  };
  EXPECT_EQ(line_of([](Link link) { return link.is_boundary() && link.tag() == 0; }), "Region 0, skin");
  EXPECT_EQ(line_of([](Link link) { return link.is_boundary() && link.tag() == 1; }), "Region 0, wall of stroke 1");
  EXPECT_EQ(line_of([](Link link) { return !link.is_boundary(); }), "Region 0, inside");
}

TEST(Probe, TellsHowMuchTheTetIsStretched) {
  TetMesh mesh = cube_mesh(1);
  std::vector<Vec3> positions(mesh.vertex_slots());
  mesh.for_each_vertex([&](VertexId v) { positions[v.value] = 2 * mesh.rest(v); });
  mesh.set_current(positions);
  const ProbeInfo info = probe(mesh, Side(TetId(0), 0)).value();
  EXPECT_NEAR(info.stretch, 8, 1e-12);
  EXPECT_NEAR(info.volume, 1.0 / 6, 1e-12);
  EXPECT_EQ(to_lines(info).at(3), "Volume 0.1667 at rest, now 800 % of that");
}

TEST(Probe, OfADeadTetIsNothing) {
  const Engine engine = cut_cube();
  const TetMesh& mesh = engine.mesh();
  EXPECT_FALSE(probe(mesh, Side(TetId(mesh.tet_slots()), 0)).has_value());
  std::uint32_t dead = 0;
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    if (mesh.is_live(TetId(slot))) continue;
    ++dead;
    EXPECT_FALSE(probe(mesh, Side(TetId(slot), 1)).has_value());
  }
  EXPECT_EQ(dead, mesh.tet_slots() - mesh.tet_count());
}

}  // namespace
}  // namespace incise::app::probe_test
