// SPDX-License-Identifier: Apache-2.0
#include "app/view/surface_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "app/view/viewed_body.h"
#include "incise/engine/engine.h"
#include "incise/geom/quality.h"
#include "incise/mesh/components.h"

namespace incise::app::surface_view_test {
namespace {

/// What is to be seen, found without any journal.
using Shown = std::map<std::uint32_t, TriangleLook>;  // by side

std::uint32_t newest_tag(const TetMesh& mesh) {
  std::uint32_t newest = 0;
  mesh.for_each_tet([&](TetId t) {
    for (const Link link : mesh.links(t)) newest = std::max(newest, link.is_boundary() ? link.tag() : 0);
  });
  return newest;
}

TriangleLook look_of(const TetMesh& mesh, Side side, std::uint32_t newest) {
  const TetVertices& v = mesh.vertices(side.tet());
  const double lr = longest_edge_over_inradius(mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3]));
  const std::uint32_t tag = mesh.link(side).tag();
  TriangleLook look{0, static_cast<std::uint8_t>(tag), static_cast<std::uint8_t>(mesh.region(side.tet())),
                    quality_byte(lr)};
  if (tag > 0) look.flags = TriangleLook::kWall;
  if (tag > 0 && tag == newest) look.flags |= TriangleLook::kNewest;
  return look;
}

Shown boundary_of(const TetMesh& mesh) {
  Shown shown;
  const std::uint32_t newest = newest_tag(mesh);
  mesh.for_each_tet([&](TetId t) {
    for (unsigned s = 0; s < 4; ++s) {
      if (mesh.links(t)[s].is_boundary()) shown[Side(t, s).value] = look_of(mesh, Side(t, s), newest);
    }
  });
  return shown;
}

bool is_used(const SurfaceTopology& topology, std::size_t slot) {
  return (topology.looks[slot].flags & TriangleLook::kUnused) == 0;
}

Shown shown_by(const SurfaceTopology& topology) {
  Shown shown;
  for (std::size_t slot = 0; slot < topology.triangles.size(); ++slot) {
    if (!is_used(topology, slot)) continue;
    TriangleLook look = topology.looks[slot];
    look.flags = static_cast<std::uint8_t>(look.flags & ~unsigned{TriangleLook::kSmall});  // has a test of its own
    shown[topology.sides[slot].value] = look;
  }
  return shown;
}

/// A mesh that is cut, and a view that follows it.
class View {
 public:
  explicit View(std::uint32_t cells = 5, std::uint64_t work_units = kUnlimitedWork)
      : engine_(make(cells, work_units)), view_(engine_.mesh(), engine_.journal()) {
    view_.fill(engine_.mesh(), frame_);
  }

  [[nodiscard]] Engine& engine() { return engine_; }
  [[nodiscard]] SurfaceView& view() { return view_; }
  [[nodiscard]] const TetMesh& mesh() const { return engine_.mesh(); }
  [[nodiscard]] const SurfaceFrame& frame() const { return frame_; }
  [[nodiscard]] const SurfaceTopology& topology() const { return *frame_.topology; }
  bool follow() {
    const bool has_changed = view_.follow(engine_.mesh(), engine_.journal());
    view_.fill(engine_.mesh(), frame_);
    return has_changed;
  }
  void check() {
    follow();
    EXPECT_EQ(shown_by(topology()), boundary_of(mesh()));
    EXPECT_EQ(topology().used, boundary_of(mesh()).size());
    check_points();
  }
  void cut_plane(const Vec3& normal, double offset) {
    const Box around{Vec3::Constant(-0.5), Vec3::Constant(1.5)};
    EXPECT_TRUE(engine_.cut(plane_stroke(around, normal, offset).value()).ok());
  }
  /// A blade across y at x = 0.47 that comes down from above the cube.
  static BladePose pose(double z) { return {{{0.47, -0.2, z}, {0.47, 0.5, z}, {0.47, 1.2, z}}, -Vec3::UnitZ()}; }

 private:
  static Engine make(std::uint32_t cells, std::uint64_t work_units) {
    EngineOptions options;
    options.maintain.work_units = work_units;
    return Engine::create(cube_mesh(cells), options).value();
  }
  /// Points stand for the corners of the sides, and each for triangles of one kind.
  void check_points() const {
    std::map<std::uint32_t, int> kinds;
    ASSERT_EQ(frame_.positions.size(), topology().vertices.size());
    for (std::size_t slot = 0; slot < topology().triangles.size(); ++slot) {
      const auto& corners = topology().triangles[slot];
      if (!is_used(topology(), slot)) {
        EXPECT_TRUE(corners[0] == corners[1] && corners[1] == corners[2]);
        continue;
      }
      const int kind = topology().looks[slot].flags & (TriangleLook::kWall | TriangleLook::kInside);
      for (std::size_t i = 0; i < 3; ++i) {
        const VertexId vertex = mesh().vertices(topology().sides[slot])[i];
        EXPECT_EQ(topology().vertices[corners[i]], vertex);
        EXPECT_EQ(frame_.positions[corners[i]], mesh().current(vertex).cast<float>());
        EXPECT_EQ(kinds.emplace(corners[i], kind).first->second, kind);
      }
    }
  }

  Engine engine_;
  SurfaceView view_;
  SurfaceFrame frame_;
};

TEST(SurfaceView, ShowsTheBoundaryAtFirst) {
  View v;
  v.check();
  EXPECT_EQ(v.topology().used, 12U * 25U);
  EXPECT_TRUE(v.topology().front_edges.empty());
}

TEST(SurfaceView, FollowsStrokesUndoAndRedo) {
  View v;
  const std::array<std::pair<Vec3, double>, 4> planes = {
      {{Vec3(1, 0.1, 0), 0.5}, {Vec3(0, 1, 0.3), 0.6}, {Vec3(0.2, 0.3, 1), 0.7}, {Vec3(1, 1, 1), 1.4}}};
  for (const auto& [normal, offset] : planes) {
    v.cut_plane(normal, offset);
    v.check();
  }
  while (v.engine().undo()) v.check();
  while (v.engine().redo()) v.check();
  v.engine().undo();
  v.cut_plane(Vec3(1, -1, 0.1), 0.05);
  v.check();
}

TEST(SurfaceView, MarksTetsBelowAHundredthOfTheFirstOnes) {
  EngineOptions options;
  options.cut.profile = Profile::kPaper;
  options.maintain.merge = options.maintain.improve = false;
  Engine engine = Engine::create(cube_mesh(5), options).value();
  SurfaceView view(engine.mesh(), engine.journal());
  ASSERT_TRUE(engine.cut(plane_stroke({Vec3(-1, -1, -1), Vec3(2, 2, 2)}, Vec3(0.03, 0.01, 1), 0.64).value()).ok());
  view.follow(engine.mesh(), engine.journal());
  SurfaceFrame frame;
  view.fill(engine.mesh(), frame);
  std::size_t small_walls = 0;
  for (std::size_t slot = 0; slot < frame.topology->looks.size(); ++slot) {
    if (!is_used(*frame.topology, slot)) continue;
    const unsigned flags = frame.topology->looks[slot].flags;
    const double volume = engine.mesh().rest_volume(frame.topology->sides[slot].tet());
    EXPECT_EQ((flags & TriangleLook::kSmall) != 0, volume < 0.01 / 750);
    small_walls += (flags & TriangleLook::kSmall) != 0 && (flags & TriangleLook::kWall) != 0 ? 1U : 0U;
  }
  EXPECT_GT(small_walls, 50U);
}

TEST(SurfaceView, FollowsSeveralStrokesAtOnce) {
  View v;
  v.cut_plane(Vec3(1, 0.1, 0), 0.5);
  v.cut_plane(Vec3(0, 1, 0.3), 0.6);
  v.cut_plane(Vec3(1, 1, 1), 1.4);
  v.check();
}

TEST(SurfaceView, FollowsEachStepOfTheBladeAndMaintenance) {
  View v(5, 0);
  ASSERT_TRUE(v.engine().begin_stroke(View::pose(1.1)).ok());
  for (int i = 1; i <= 14; ++i) {
    ASSERT_TRUE(v.engine().step(View::pose(1.1 - 0.05 * i)).ok());
    v.check();
  }
  ASSERT_TRUE(v.engine().end_stroke().ok());
  v.check();
  for (int i = 0; i < 200 && v.engine().has_maintenance(); ++i) {
    EXPECT_TRUE(v.engine().maintain(200).ok());
    v.check();
  }
  EXPECT_TRUE(v.engine().improve().ok());
  v.check();
  while (v.engine().undo()) v.check();
}

TEST(SurfaceView, SaysWhetherAnythingChanged) {
  View v;
  EXPECT_FALSE(v.follow());
  const std::uint64_t version = v.topology().version;
  v.cut_plane(Vec3(1, 0.1, 0), 0.5);
  EXPECT_TRUE(v.follow());
  EXPECT_GT(v.topology().version, version);
  EXPECT_FALSE(v.follow());
}

TEST(SurfaceView, TopologiesThatWereTakenStay) {
  View v;
  const SurfaceFrame before = v.frame();
  const Shown shown = shown_by(*before.topology);
  v.cut_plane(Vec3(1, 0.1, 0), 0.5);
  v.follow();
  EXPECT_EQ(shown_by(*before.topology), shown);
  EXPECT_NE(v.frame().topology, before.topology);
}

TEST(SurfaceView, OneStepOfTheBladeChangesFewSlots) {
  View v(12, 0);
  ASSERT_TRUE(v.engine().begin_stroke({{{0.47, 1.1, 0.8}, {0.47, 1.1, 1.1}}, -Vec3::UnitY()}).ok());
  for (int i = 1; i <= 20; ++i) {
    const std::shared_ptr<const SurfaceTopology> before = v.frame().topology;
    const double y = 1.1 - 0.03 * i;
    ASSERT_TRUE(v.engine().step({{{0.47, y, 0.8}, {0.47, y, 1.1}}, -Vec3::UnitY()}).ok());
    v.follow();
    std::size_t changed = v.topology().triangles.size() - before->triangles.size();
    for (std::size_t slot = 0; slot < before->triangles.size(); ++slot) {
      changed += v.topology().triangles[slot] != before->triangles[slot] ? 1U : 0U;
    }
    EXPECT_LT(changed, 200U) << "of " << before->triangles.size();
  }
}

TEST(SurfaceView, PositionsFollowTheBody) {
  View v;
  std::vector<Vec3> positions(v.mesh().vertex_slots());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    positions[i] = 2 * v.mesh().rest(VertexId(i)) + Vec3(0, 0, 1);
  }
  ASSERT_TRUE(v.engine().set_positions(positions).ok());
  v.check();
  EXPECT_LT((bounds_of(v.frame()).hi - Vec3(2, 2, 3)).norm(), 1e-6);
}

TEST(SurfaceView, FrontEdgesAreWhereAPartialCutEnds) {
  View v(6, 0);
  ASSERT_TRUE(v.engine().begin_stroke(View::pose(1.1)).ok());
  for (const double z : {0.9, 0.7, 0.5}) ASSERT_TRUE(v.engine().step(View::pose(z)).ok());
  ASSERT_TRUE(v.engine().end_stroke().ok());
  v.check();
  double length = 0;
  for (const auto& [a, b] : v.topology().front_edges) {
    const Eigen::Vector3f from = v.frame().positions[a], to = v.frame().positions[b];
    EXPECT_NEAR(from.z(), 0.5, 0.05);
    EXPECT_NEAR(from.x(), 0.47, 0.02);
    length += static_cast<double>((to - from).norm());
  }
  EXPECT_NEAR(length, 1, 0.1);
}

TEST(SurfaceView, PointsKnowTheirPlaceAtRestAndTheirDepth) {
  View v(6, 0);
  ASSERT_TRUE(v.engine().begin_stroke(View::pose(1.1)).ok());
  for (const double z : {0.9, 0.7, 0.5}) ASSERT_TRUE(v.engine().step(View::pose(z)).ok());
  ASSERT_TRUE(v.engine().end_stroke().ok());
  v.check();
  const SurfaceTopology& topology = v.topology();
  ASSERT_EQ(topology.rest.size(), topology.vertices.size());
  ASSERT_EQ(topology.depths.size(), topology.vertices.size());
  float deepest = 0;
  for (std::size_t slot = 0; slot < topology.triangles.size(); ++slot) {
    if (!is_used(topology, slot)) continue;
    const bool is_wall = (topology.looks[slot].flags & TriangleLook::kWall) != 0;
    for (const std::uint32_t point : topology.triangles[slot]) {
      const Eigen::Vector3f rest = v.mesh().rest(topology.vertices[point]).cast<float>();
      EXPECT_EQ(topology.rest[point], rest);
      // The cut reaches the skin above and at both sides; the way along edges is a little longer.
      const float depth = std::min({1 - rest.z(), rest.y(), 1 - rest.y()});
      if (is_wall) {
        EXPECT_GE(topology.depths[point], depth - 0.05F);
        EXPECT_LE(topology.depths[point], 1.5F * depth + 0.05F);
      } else {
        EXPECT_EQ(topology.depths[point], 0);
      }
      deepest = std::max(deepest, topology.depths[point]);
    }
  }
  EXPECT_GT(deepest, 0.35F);
}

TEST(SurfaceView, ACompleteCutHasNoFront) {
  View v;
  v.cut_plane(Vec3(1, 0.1, 0), 0.5);
  v.check();
  EXPECT_EQ(find_components(v.mesh()).count(), 2U);
  EXPECT_TRUE(v.topology().front_edges.empty());
}

/// Whether each edge is run through as often in one direction as in the other.
bool is_closed(const SurfaceTopology& topology) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (std::size_t slot = 0; slot < topology.triangles.size(); ++slot) {
    if (!is_used(topology, slot)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = topology.vertices[topology.triangles[slot][i]].value;
      const std::uint32_t b = topology.vertices[topology.triangles[slot][(i + 1) % 3]].value;
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; });
}

/// How many edges of a set each point has.
std::map<std::uint32_t, int> degrees(const std::vector<std::array<std::uint32_t, 2>>& edges) {
  std::map<std::uint32_t, int> degrees;
  for (const auto& [a, b] : edges) {
    ++degrees[a];
    ++degrees[b];
  }
  return degrees;
}

/// Of the graph of edges.
std::size_t pieces_of(const std::vector<std::array<std::uint32_t, 2>>& edges) {
  std::map<std::uint32_t, std::uint32_t> parent;
  const auto root = [&](std::uint32_t point) {
    while (parent.emplace(point, point).first->second != point) point = parent[point];
    return point;
  };
  for (const auto& [a, b] : edges) parent[root(a)] = root(b);
  return static_cast<std::size_t>(
      std::count_if(parent.begin(), parent.end(), [](const auto& entry) { return entry.first == entry.second; }));
}

TEST(SurfaceView, WithoutCutsThereIsNoContour) {
  View v;
  EXPECT_TRUE(v.topology().contour_edges.empty());
}

TEST(SurfaceView, APartialCutsContourIsOneLoopOnTheSkin) {
  View v;
  ASSERT_TRUE(v.engine().begin_stroke(View::pose(1.1)).ok());
  ASSERT_TRUE(v.engine().step(View::pose(0.45)).ok());
  ASSERT_TRUE(v.engine().end_stroke().ok());
  v.follow();
  ASSERT_FALSE(v.topology().contour_edges.empty());
  EXPECT_EQ(pieces_of(v.topology().contour_edges), 1U);
  for (const auto& [point, degree] : degrees(v.topology().contour_edges)) EXPECT_EQ(degree, 2);
  for (const auto& edge : v.topology().contour_edges) {
    for (const std::uint32_t point : edge) {
      const Vec3 at = v.mesh().rest(v.topology().vertices[point]);
      EXPECT_NEAR(at.x(), 0.47, 1e-9);
      EXPECT_LT(std::min({at.y(), 1 - at.y(), 1 - at.z()}), 1e-9);
    }
  }
}

TEST(SurfaceView, ACompleteCutsContourIsTwoClosedLoops) {
  View v;
  v.cut_plane(Vec3(1, 0.1, 0), 0.5);
  v.follow();
  EXPECT_EQ(pieces_of(v.topology().contour_edges), 2U);
  for (const auto& [point, degree] : degrees(v.topology().contour_edges)) EXPECT_EQ(degree, 2);
}

TEST(SurfaceView, TheContourGoesWithUndo) {
  View v;
  v.cut_plane(Vec3(1, 0.1, 0), 0.5);
  v.follow();
  v.engine().undo();
  v.follow();
  EXPECT_TRUE(v.topology().contour_edges.empty());
}

TEST(SurfaceView, AClipPlaneMakesNoContour) {
  View v;
  v.cut_plane(Vec3(1, 0.1, 0), 0.5);
  v.follow();
  std::map<std::pair<VertexId, VertexId>, int> whole;
  const auto key = [&](const std::array<std::uint32_t, 2>& edge) -> std::pair<VertexId, VertexId> {
    return std::minmax(v.topology().vertices[edge[0]], v.topology().vertices[edge[1]]);
  };
  for (const auto& edge : v.topology().contour_edges) ++whole[key(edge)];
  v.view().set_options({HalfSpace{Vec3::UnitZ(), 0.5}});
  v.follow();
  EXPECT_LT(v.topology().contour_edges.size(), whole.size());
  for (const auto& edge : v.topology().contour_edges) EXPECT_EQ(whole.count(key(edge)), 1U);
}

TEST(SurfaceView, AClipPlaneShowsAClosedSurface) {
  View v;
  SurfaceOptions options;
  options.clip = HalfSpace{Vec3::UnitX(), 0.5};
  v.view().set_options(options);
  EXPECT_TRUE(v.follow());
  const auto count_inside = [&] {
    std::size_t inside = 0;
    for (const TriangleLook& look : v.topology().looks) inside += (look.flags & TriangleLook::kInside) != 0 ? 1U : 0U;
    return inside;
  };
  EXPECT_TRUE(is_closed(v.topology()));
  EXPECT_GT(count_inside(), 50U);
  EXPECT_GT(bounds_of(v.frame()).lo.x(), 0.3);
  v.cut_plane(Vec3(0.1, 1, 0), 0.5);
  EXPECT_TRUE(v.follow());
  EXPECT_TRUE(is_closed(v.topology()));
  v.view().set_options({});
  v.check();
  EXPECT_EQ(count_inside(), 0U);
}

TEST(SurfaceView, AnEmptyMeshShowsNothing) {
  const SurfaceFrame frame = surface_of(TetMesh());
  ASSERT_NE(frame.topology, nullptr);
  EXPECT_EQ(frame.topology->used, 0U);
  EXPECT_TRUE(bounds_of(frame).is_empty());
}

TEST(QualityByte, GrowsWithBadnessAndComesBack) {
  EXPECT_EQ(quality_byte(std::sqrt(24.0)), 0);
  EXPECT_EQ(quality_byte(200), 255);
  EXPECT_EQ(quality_byte(std::numeric_limits<double>::quiet_NaN()), 255);
  for (unsigned byte = 1; byte < 255; ++byte) {
    const double lr = lr_of_quality_byte(static_cast<std::uint8_t>(byte));
    EXPECT_EQ(quality_byte(lr * (1 + 1e-9)), byte);
  }
}

}  // namespace
}  // namespace incise::app::surface_view_test
