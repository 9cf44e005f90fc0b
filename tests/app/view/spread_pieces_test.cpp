// SPDX-License-Identifier: Apache-2.0
#include "app/view/spread_pieces.h"

#include <gtest/gtest.h>

#include <array>

#include "app/view/viewed_body.h"
#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"

namespace incise::app::spread_pieces_test {
namespace {

/// A block from the origin to (2, 1, 1), cut by planes across axes.
Engine cut_block(const std::vector<std::pair<Vec3, double>>& planes) {
  Engine engine =
      Engine::create(TetMesh::build(kuhn_box(Vec3::Zero(), {2, 1, 1}, {8, 4, 4})).value(), EngineOptions()).value();
  const Box around{Vec3::Constant(-0.5), Vec3::Constant(2.5)};
  for (const auto& [normal, offset] : planes) {
    EXPECT_TRUE(engine.cut(plane_stroke(around, normal, offset).value()).ok());
  }
  return engine;
}

SurfaceFrame spread(const TetMesh& mesh, double share) {
  SurfaceFrame frame = surface_of(mesh);
  spread_pieces(mesh, find_components(mesh), share, frame);
  return frame;
}

/// How far each point has moved must be what `expected` says of where it was.
template <class Expected>
void expect_shifts(const TetMesh& mesh, const SurfaceFrame& frame, const Expected& expected) {
  const Components pieces = find_components(mesh);
  for (std::size_t i = 0; i < frame.positions.size(); ++i) {
    const VertexId v = frame.topology->vertices[i];
    if (!v.is_valid()) continue;
    const Vec3 shift = frame.positions[i].cast<double>() - mesh.current(v);
    EXPECT_LT((shift - expected(pieces.label[mesh.tet_of(v).value])).norm(), 1e-6);
  }
}

/// The mean of the corners of a piece's tets.
Vec3 inner_point(const TetMesh& mesh, std::uint32_t piece) {
  const Components pieces = find_components(mesh);
  Vec3 sum = Vec3::Zero();
  double count = 0;
  mesh.for_each_tet([&](TetId tet) {
    if (pieces.label[tet.value] != piece) return;
    for (const VertexId v : mesh.vertices(tet)) sum += mesh.current(v);
    count += 4;
  });
  return sum / count;
}

TEST(SpreadPieces, MovesHalvesApartByAShareOfTheBodysWidth) {
  const Engine engine = cut_block({{Vec3::UnitX(), 0.9}});
  const TetMesh& mesh = engine.mesh();
  ASSERT_EQ(find_components(mesh).count(), 2U);
  expect_shifts(mesh, spread(mesh, 0.25),
                [&](std::uint32_t piece) { return Vec3(inner_point(mesh, piece).x() < 0.9 ? -0.5 : 0.5, 0, 0); });
}

TEST(SpreadPieces, TakesTheWidthInThePiecesOwnDirection) {
  const Engine engine = cut_block({{Vec3::UnitZ(), 0.5}});
  const TetMesh& mesh = engine.mesh();
  expect_shifts(mesh, spread(mesh, 0.25),
                [&](std::uint32_t piece) { return Vec3(0, 0, inner_point(mesh, piece).z() < 0.5 ? -0.25 : 0.25); });
}

TEST(SpreadPieces, LeavesThePieceInTheMiddle) {
  const Engine engine = cut_block({{Vec3::UnitX(), 0.5}, {Vec3::UnitX(), 1.5}});
  const TetMesh& mesh = engine.mesh();
  ASSERT_EQ(find_components(mesh).count(), 3U);
  expect_shifts(mesh, spread(mesh, 0.1), [&](std::uint32_t piece) {
    const double x = inner_point(mesh, piece).x();
    return Vec3(x < 0.5 ? -0.2 : (x > 1.5 ? 0.2 : 0), 0, 0);
  });
}

TEST(SpreadPieces, LeavesWholeBodiesAndAShareOfZero) {
  const Engine whole = cut_block({});
  EXPECT_EQ(spread(whole.mesh(), 0.5).positions, surface_of(whole.mesh()).positions);
  const Engine halves = cut_block({{Vec3::UnitX(), 0.9}});
  EXPECT_EQ(spread(halves.mesh(), 0).positions, surface_of(halves.mesh()).positions);
}

TEST(SpreadPieces, AcceptsAFrameWithoutTopology) {
  const Engine whole = cut_block({});
  SurfaceFrame frame;
  spread_pieces(whole.mesh(), find_components(whole.mesh()), 0.5, frame);
  EXPECT_TRUE(frame.positions.empty());
}

}  // namespace
}  // namespace incise::app::spread_pieces_test
