// SPDX-License-Identifier: Apache-2.0
// What a picture frames once pieces have fallen.
#include "app/view/piece_bounds.h"

#include <gtest/gtest.h>

#include "app/view/viewed_body.h"
#include "incise/engine/engine.h"

namespace incise::app::piece_bounds_test {
namespace {

/// A cube cut at x = 0.8, the smaller piece `fallen` below the other.
Engine cut_cube(double fallen) {
  Engine engine =
      Engine::create(TetMesh::build(kuhn_box(Vec3::Zero(), {1, 1, 1}, {5, 5, 5})).value(), EngineOptions()).value();
  EXPECT_TRUE(engine.cut(plane_stroke(Box{Vec3::Constant(-0.5), Vec3::Constant(1.5)}, {1, 0, 0}, 0.8).value()).ok());
  const Components pieces = find_components(engine.mesh());
  std::vector<Vec3> positions(engine.mesh().vertex_slots(), Vec3::Zero());
  engine.mesh().for_each_vertex([&](VertexId v) { positions[v.value] = engine.mesh().rest(v); });
  engine.mesh().for_each_tet([&](TetId tet) {
    if (pieces.volume[pieces.label[tet.value]] > 0.5) return;
    for (const VertexId v : engine.mesh().vertices(tet)) {
      positions[v.value] = engine.mesh().rest(v) - Vec3(0, 0, fallen);
    }
  });
  EXPECT_TRUE(engine.set_positions(positions).ok());
  return engine;
}

Box bounds(const Engine& engine) {
  return app::bounds_of_main_pieces(engine.mesh(), find_components(engine.mesh()));
}

TEST(PieceBounds, leave_out_what_has_fallen_away) {
  EXPECT_NEAR(bounds(cut_cube(0.2)).lo.z(), -0.2, 1e-12);
  const Box left = bounds(cut_cube(50));
  EXPECT_NEAR(left.lo.z(), 0, 1e-12);
  EXPECT_NEAR(left.hi.x(), 0.8, 1e-9);
}

TEST(PieceBounds, are_cut_down_by_a_clip_plane_and_not_stretched_by_what_has_fallen) {
  const Engine engine = cut_cube(50);
  const Components pieces = find_components(engine.mesh());
  const Box drawn{{0, 0, -50}, {1, 0.4, 1}}, shown = app::main_part(drawn, engine.mesh(), pieces);
  EXPECT_NEAR(shown.lo.z(), 0, 1e-12);
  EXPECT_NEAR(shown.hi.y(), 0.4, 1e-12);
  const Box elsewhere{{3, 3, 3}, {4, 4, 4}};
  EXPECT_EQ(app::main_part(elsewhere, engine.mesh(), pieces).lo, elsewhere.lo) << "nothing of the main piece is drawn";
}

}  // namespace
}  // namespace incise::app::piece_bounds_test
