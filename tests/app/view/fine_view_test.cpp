// SPDX-License-Identifier: Apache-2.0
#include "app/view/fine_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <tuple>

#include "app/view/scene_fine_view.h"
#include "incise/engine/engine.h"
#include "incise/mesh/shapes.h"
#include "support/fine_surfaces.h"
#include "support/folder.h"
#include "support/strokes.h"

namespace incise::app::fine_view_test {
namespace {

constexpr std::uint32_t kFine = 16;  // squares along an edge of the surface of the unit cube

FineSurface fine_skin() {
  return test::fine_box(Vec3::Zero(), Vec3::Ones(), kFine);
}

/// A cut of the unit cube down from its top, at `x`.
Stroke incision(double x, unsigned steps = 1) {
  return test::quad_stroke(Vec3(x, -0.1, 1.1), Vec3(x, -0.1, 0.4), Vec3(x, 0.7, 1.1), Vec3(x, 0.7, 0.4), steps);
}

/// A coarse cube that is seen by a fine surface.
class Seen {
 public:
  Seen() : engine_(Engine::create(TetMesh::build(kuhn_cube(4)).value()).value()) {
    view_.emplace(FineView::bind(fine_skin(), engine_.mesh(), engine_.journal()).value());
    show();
  }

  [[nodiscard]] Engine& engine() { return engine_; }
  [[nodiscard]] const TetMesh& mesh() const { return engine_.mesh(); }
  [[nodiscard]] FineView& view() { return *view_; }
  [[nodiscard]] const SurfaceFrame& frame() const { return frame_; }
  [[nodiscard]] const SurfaceTopology& topology() const { return *frame_.topology; }
  void show() { ASSERT_TRUE(view_->show(engine_.mesh(), engine_.journal(), frame_).ok()); }
  void cut(const Stroke& stroke) {
    ASSERT_TRUE(engine_.cut(stroke).ok());
    show();
  }

 private:
  Engine engine_;
  std::optional<FineView> view_;
  SurfaceFrame frame_;
};

bool has(const SurfaceTopology& topology, std::size_t slot, std::uint8_t flag) {
  return (topology.looks[slot].flags & flag) != 0;
}

/// What is to be seen, whatever the slots: of each triangle its look and its corners, each with its depth.
using Corner = std::array<float, 7>;
using Shown = std::multiset<std::tuple<std::uint8_t, std::uint8_t, std::array<Corner, 3>>>;

Shown shown_by(const SurfaceFrame& frame) {
  const SurfaceTopology& t = *frame.topology;
  Shown shown;
  for (std::size_t slot = 0; slot < t.triangles.size(); ++slot) {
    if (has(t, slot, TriangleLook::kUnused)) continue;
    std::array<Corner, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t p = t.triangles[slot][i];
      const Eigen::Vector3f &at = frame.positions[p], &rest = t.rest[p];
      corners[i] = {at.x(), at.y(), at.z(), rest.x(), rest.y(), rest.z(), t.depths[p]};
    }
    shown.insert({t.looks[slot].flags, t.looks[slot].stroke, corners});
  }
  return shown;
}

/// What a view shows that is bound to the body as it stands.
Shown shown_anew(const Engine& engine) {
  FineView view = FineView::bind(fine_skin(), engine.mesh(), engine.journal()).value();
  SurfaceFrame frame;
  EXPECT_TRUE(view.show(engine.mesh(), engine.journal(), frame).ok());
  return shown_by(frame);
}

/// What whoever picks, grabs or colours relies on.
void expect_sound(const Seen& seen) {
  const SurfaceTopology& t = seen.topology();
  ASSERT_EQ(t.looks.size(), t.triangles.size());
  ASSERT_EQ(t.sides.size(), t.triangles.size());
  ASSERT_EQ(seen.frame().positions.size(), t.vertices.size());
  ASSERT_EQ(t.rest.size(), t.vertices.size());
  ASSERT_EQ(t.depths.size(), t.vertices.size());
  std::size_t used = 0;
  for (std::size_t slot = 0; slot < t.triangles.size(); ++slot) {
    for (const std::uint32_t p : t.triangles[slot]) ASSERT_LT(p, t.vertices.size());
    if (has(t, slot, TriangleLook::kUnused)) continue;
    ++used;
    EXPECT_TRUE(seen.mesh().is_live(t.sides[slot].tet()));
    for (const std::uint32_t p : t.triangles[slot]) {
      EXPECT_TRUE(seen.mesh().is_live(t.vertices[p]));
      EXPECT_TRUE(seen.frame().positions[p].allFinite());
    }
  }
  EXPECT_EQ(used, t.used);
}

TEST(FineView, an_uncut_body_is_seen_by_its_fine_skin_alone) {
  const Seen seen;
  expect_sound(seen);
  EXPECT_EQ(seen.topology().used, 12 * kFine * kFine);
  for (std::size_t slot = 0; slot < seen.topology().looks.size(); ++slot) {
    EXPECT_EQ(seen.topology().looks[slot].flags, 0);
  }
  for (std::size_t i = 0; i < seen.frame().positions.size(); ++i) {
    EXPECT_LT((seen.frame().positions[i] - seen.topology().rest[i]).norm(), 1e-6F);
    EXPECT_EQ(seen.topology().depths[i], 0);
  }
}

TEST(FineView, a_body_that_only_moves_keeps_its_topology) {
  Seen seen;
  seen.cut(incision(0.53));
  const auto topology = seen.frame().topology;
  const std::vector<Eigen::Vector3f> before = seen.frame().positions;
  std::vector<Vec3> places;
  for (std::uint32_t v = 0; v < seen.mesh().vertex_slots(); ++v) {
    places.emplace_back(seen.mesh().current(VertexId(v)) + Vec3(0.5, -0.25, 2));
  }
  ASSERT_TRUE(seen.engine().set_positions(places).ok());
  seen.show();
  EXPECT_EQ(seen.frame().topology, topology);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT((seen.frame().positions[i] - before[i] - Eigen::Vector3f(0.5F, -0.25F, 2)).norm(), 1e-5F);
  }
}

TEST(FineView, each_step_of_a_blade_is_seen_as_the_body_then_is) {
  Seen seen;
  for (const double x : {0.53, 0.28}) {
    const Stroke stroke = incision(x, 8);
    ASSERT_TRUE(seen.engine().begin_stroke({stroke.edges.front()}).ok());
    for (std::size_t i = 1; i < stroke.edges.size(); ++i) {
      ASSERT_TRUE(seen.engine().step({stroke.edges[i]}).ok());
      seen.show();
      expect_sound(seen);
      EXPECT_TRUE(shown_by(seen.frame()) == shown_anew(seen.engine()));
    }
    ASSERT_TRUE(seen.engine().end_stroke().ok());
    EXPECT_GT(seen.topology().used, 12 * kFine * kFine);
  }
}

TEST(FineView, undo_and_redo_are_seen) {
  Seen seen;
  const Shown whole = shown_by(seen.frame());
  seen.cut(incision(0.53));
  const Shown cut_once = shown_by(seen.frame());
  EXPECT_TRUE(cut_once != whole);
  ASSERT_TRUE(seen.engine().undo());
  seen.show();
  EXPECT_TRUE(shown_by(seen.frame()) == whole);
  ASSERT_TRUE(seen.engine().redo());
  seen.show();
  EXPECT_TRUE(shown_by(seen.frame()) == cut_once);
  expect_sound(seen);
}

TEST(FineView, walls_are_told_apart_and_deeper_away_from_the_skin) {
  Seen seen;
  seen.cut(incision(0.53));
  seen.cut(incision(0.28));
  const SurfaceTopology& t = seen.topology();
  std::array<std::size_t, 3> triangles{};  // skin, first wall, second wall
  for (std::size_t slot = 0; slot < t.triangles.size(); ++slot) {
    if (has(t, slot, TriangleLook::kUnused)) continue;
    const bool is_wall = has(t, slot, TriangleLook::kWall);
    ASSERT_LE(t.looks[slot].stroke, 2);
    EXPECT_EQ(is_wall, t.looks[slot].stroke > 0);
    EXPECT_EQ(has(t, slot, TriangleLook::kNewest), t.looks[slot].stroke == 2);
    ++triangles[t.looks[slot].stroke];
    for (const std::uint32_t p : t.triangles[slot]) {
      const Eigen::Vector3f& rest = t.rest[p];
      const float below = std::min({rest.minCoeff(), (Eigen::Vector3f::Ones() - rest).minCoeff()});
      EXPECT_NEAR(t.depths[p], is_wall ? std::max(below, 0.0F) : 0.0F, 1e-5F);
    }
  }
  for (const std::size_t count : triangles) EXPECT_GT(count, 0U);
  EXPECT_EQ(seen.view().drawn().skin.size(), triangles[0]);
  EXPECT_EQ(seen.view().drawn().walls.size(), triangles[1] + triangles[2]);
}

TEST(FineView, history_that_was_trimmed_away_does_not_stop_it) {
  Seen seen;
  ASSERT_TRUE(seen.engine().keep_undo(1).ok());
  ASSERT_TRUE(seen.engine().cut(incision(0.53)).ok());
  ASSERT_TRUE(seen.engine().cut(incision(0.28)).ok());
  const std::uint64_t version = seen.topology().version;
  seen.show();
  EXPECT_GT(seen.topology().version, version);
  EXPECT_TRUE(shown_by(seen.frame()) == shown_anew(seen.engine()));
}

TEST(FineView, what_does_not_change_keeps_its_slots) {
  Seen seen;
  const std::shared_ptr<const SurfaceTopology> before = seen.frame().topology;
  seen.cut(test::quad_stroke(Vec3(0.53, -0.1, 1.1), Vec3(0.53, -0.1, 0.8), Vec3(0.53, 0.2, 1.1), Vec3(0.53, 0.2, 0.8)));
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before->triangles.size(); ++i) {
    changed += before->triangles[i] != seen.topology().triangles[i] ? 1U : 0U;
  }
  EXPECT_GT(changed, 0U);
  EXPECT_LT(changed, before->triangles.size() / 10);
}

class FineViewOfScene : public ::testing::Test {
 protected:
  Result<std::optional<FineView>> view(const std::string& surface) {
    const std::string scene = folder_.write(
        "scene.json",
        R"({"format": "incise-scene", "version": 1, "length_unit": 1, "model": {"box": {"cells": [2, 2, 2], "size": [1, 1, 1]})" +
            surface + "}}");
    const Result<Scene> read = read_scene(scene);
    if (!read.ok()) return read.error();
    return fine_view_of(*read, mesh_, Journal());
  }

  incise_test::Folder folder_;
  TetMesh mesh_ = TetMesh::build(kuhn_cube(2)).value();
};

TEST_F(FineViewOfScene, is_that_of_the_surface_that_it_names) {
  folder_.write("skin.obj", "v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n");
  Result<std::optional<FineView>> made = view(R"(, "surface": "skin.obj")");
  ASSERT_TRUE(made.ok()) << made.error().message;
  ASSERT_TRUE(made->has_value());
  EXPECT_EQ((*made)->surface().source().triangles.size(), 1U);
}

TEST_F(FineViewOfScene, is_none_where_it_names_none) {
  const Result<std::optional<FineView>> made = view("");
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_FALSE(made->has_value());
}

TEST_F(FineViewOfScene, says_what_is_wrong_with_it) {
  const auto message = [&](const std::string& surface) {
    const Result<std::optional<FineView>> made = view(surface);
    return made.ok() ? std::string() : made.error().message;
  };
  EXPECT_NE(message(R"(, "surface": "absent.obj")").find("absent.obj"), std::string::npos);
  folder_.write("far.obj", "v 50 0 1\nv 51 0 1\nv 50 1 1\nf 1 2 3\n");
  const std::string far = message(R"(, "surface": "far.obj")");
  EXPECT_NE(far.find("far.obj"), std::string::npos) << far;
  EXPECT_NE(far.find("outside the mesh"), std::string::npos) << far;
}

}  // namespace
}  // namespace incise::app::fine_view_test
