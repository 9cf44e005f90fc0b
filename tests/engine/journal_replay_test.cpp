// SPDX-License-Identifier: Apache-2.0
// A follower that knows tets, vertices and a mass only, and keeps up with the mesh through the journal.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "cut/bodies.h"
#include "cut/random_strokes.h"
#include "cut/strokes.h"
#include "cut/support.h"
#include "incise/mesh/bounds.h"

namespace incise::test {
namespace {

class Mirror {
 public:
  explicit Mirror(const TetMesh& mesh) {
    mesh.for_each_tet([&](TetId tet) { tets_[tet] = {mesh.vertices(tet), mesh.region(tet)}; });
    mesh.for_each_vertex([&](VertexId v) {
      vertices_[v] = {mesh.rest(v), mesh.current(v), velocity_at(mesh.rest(v))};
    });
  }

  void catch_up(const Journal& journal) {
    for (; position_ < journal.position(); ++position_) apply(journal.step(position_));
  }

  void expect_equal(const TetMesh& mesh) const {
    ASSERT_EQ(tets_.size(), mesh.tet_count());
    ASSERT_EQ(vertices_.size(), mesh.vertex_count());
    for (const auto& [id, tet] : tets_) {
      ASSERT_TRUE(mesh.is_live(id));
      EXPECT_EQ(tet.vertices, mesh.vertices(id));
      EXPECT_EQ(tet.region, mesh.region(id));
    }
    for (const auto& [id, vertex] : vertices_) {
      ASSERT_TRUE(mesh.is_live(id));
      EXPECT_EQ(vertex.rest, mesh.rest(id));
      EXPECT_EQ(vertex.current, mesh.current(id));
    }
  }
  /// An affine velocity is known everywhere: wherever vertices were born, moved or copied it must be met.
  void expect_affine_velocity() const {
    for (const auto& [id, vertex] : vertices_) {
      EXPECT_LT((vertex.velocity - velocity_at(vertex.rest)).norm(), 1e-9) << "vertex " << id.value;
    }
  }
  /// A quarter of each tet's volume at each of its corners.
  [[nodiscard]] std::map<VertexId, double> masses() const {
    std::map<VertexId, double> mass;
    for (const auto& entry : tets_) {
      const TetVertices& corners = entry.second.vertices;
      const auto at = [&](unsigned c) { return vertices_.at(corners[c]).rest; };
      const double volume = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
      for (const VertexId v : corners) mass[v] += volume / 4;
    }
    return mass;
  }
  [[nodiscard]] double mass() const {
    double sum = 0;
    for (const auto& [v, m] : masses()) sum += m;
    return sum;
  }
  [[nodiscard]] Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (const auto& [v, m] : masses()) sum += m * vertices_.at(v).velocity;
    return sum;
  }

 private:
  struct Vertex {
    Vec3 rest, current, velocity;
  };
  struct Tet {
    TetVertices vertices;
    std::int32_t region = 0;
  };

  static Vec3 velocity_at(const Vec3& p) {
    return {0.3 + 2 * p.x() - p.y(), -1 + 0.5 * p.z(), p.x() + p.y() - 0.25 * p.z()};
  }
  [[nodiscard]] Vec3 interpolate(const std::array<VertexId, 4>& parents, const std::array<double, 4>& weights) const {
    Vec3 velocity = Vec3::Zero();
    for (unsigned i = 0; i < 4; ++i) {
      if (parents[i].is_valid()) velocity += weights[i] * vertices_.at(parents[i]).velocity;
    }
    return velocity;
  }
  void apply(const Step& step) {
    if (step.edits.empty()) {
      apply_lists(step);
    } else {
      apply_edits(step);
    }
    for (const VertexId id : step.died) vertices_.erase(id);
  }
  void apply_edits(const Step& step) {
    std::size_t consumed = 0, produced = 0;
    for (const Edit& edit : step.edits) {
      if (edit.kind == Edit::Kind::kMove) {
        move(step.moved[edit.vertex]);
      } else if (edit.vertex != kInvalidIndex) {
        bear(step.born[edit.vertex]);
      }
      replace(std::span(step.edit_consumed).subspan(consumed, edit.consumed_end - consumed),
              std::span(step.edit_produced).subspan(produced, edit.produced_end - produced));
      consumed = edit.consumed_end;
      produced = edit.produced_end;
    }
  }
  void bear(const BornVertex& born) {
    vertices_[born.id] = {born.rest, born.current, interpolate(born.parents, born.weights)};
  }
  void move(const MovedVertex& moved) {
    EXPECT_EQ(vertices_.at(moved.id).rest, moved.old_rest);
    vertices_.at(moved.id) = {moved.rest, moved.current, interpolate(moved.basis, moved.weights)};
  }
  void replace(std::span<const ConsumedTet> consumed, std::span<const ProducedTet> produced) {
    std::map<TetId, Tet> parents;
    for (const ConsumedTet& tet : consumed) {
      EXPECT_EQ(tets_.at(tet.id).vertices, tet.vertices);
      parents[tet.id] = tets_.at(tet.id);
      tets_.erase(tet.id);
    }
    for (const ProducedTet& tet : produced) {
      ASSERT_EQ(parents.count(tet.parent), 1U) << "a tet's parent must be consumed in the same step or edit";
      EXPECT_EQ(parents.at(tet.parent).region, tet.region);
      tets_[tet.id] = {tet.vertices, tet.region};
    }
  }
  void apply_lists(const Step& step) {
    for (const BornVertex& born : step.born) bear(born);
    for (const MovedVertex& moved : step.moved) move(moved);
    for (const CopiedVertex& copied : step.copied) vertices_[copied.id] = vertices_.at(copied.source);
    replace(step.consumed, step.produced);
    for (const RewiredTet& rewired : step.rewired) {
      EXPECT_EQ(tets_.at(rewired.id).vertices, rewired.old_vertices);
      tets_.at(rewired.id).vertices = rewired.vertices;
    }
  }

  std::map<TetId, Tet> tets_;
  std::map<VertexId, Vertex> vertices_;
  std::size_t position_ = 0;
};

void follow(TetSoup soup, double snap, Profile profile, const std::vector<Stroke>& strokes) {
  Engine engine = make_engine(std::move(soup), snap, profile);
  Mirror mirror(engine.mesh());
  const double mass = mirror.mass();
  const Vec3 momentum = mirror.momentum();
  for (const Stroke& stroke : strokes) {
    SCOPED_TRACE(stroke.name);
    cut(engine, stroke);
    mirror.catch_up(engine.journal());
    mirror.expect_equal(engine.mesh());
    mirror.expect_affine_velocity();
    EXPECT_NEAR(mirror.mass(), mass, 1e-12 * mass);
    EXPECT_LT((mirror.momentum() - momentum).norm(), 1e-12 * std::max(1.0, momentum.norm()));
    if (testing::Test::HasFailure()) return;
  }
}

/// The same on an engine that maintains. Where walls are bent they may give or take a little volume, the paper's more.
void follow_maintained(TetSoup soup, double snap, Profile profile, const std::vector<Stroke>& strokes) {
  EngineOptions options;
  options.cut = {profile, snap};
  Engine engine = Engine::create(build(std::move(soup)), options).value();
  Mirror mirror(engine.mesh());
  const double mass = mirror.mass();
  for (const Stroke& stroke : strokes) {
    SCOPED_TRACE(stroke.name);
    ASSERT_TRUE(engine.cut(stroke).ok());
    mirror.catch_up(engine.journal());
    mirror.expect_equal(engine.mesh());
    mirror.expect_affine_velocity();
    EXPECT_NEAR(mirror.mass(), mass, (profile == Profile::kPaper ? 1e-2 : 1e-3) * mass);
    if (testing::Test::HasFailure()) return;
  }
  bool has_edits = false;
  for (std::size_t i = 0; i < engine.journal().size(); ++i) has_edits |= !engine.journal().step(i).edits.empty();
  EXPECT_TRUE(has_edits);
}

std::vector<Stroke> some_strokes(std::uint64_t seed, unsigned count) {
  Random random(seed);
  std::vector<Stroke> strokes;
  for (unsigned i = 0; i < count; ++i) strokes.push_back(random_stroke(random, {Vec3(0, 0, 0), Vec3(1, 1, 1)}));
  return strokes;
}

TEST(JournalReplay, on_a_mirror_gives_the_mesh_bit_for_bit_with_mass_and_momentum_kept) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    follow(jittered_cube(4, seed), 0.2, Profile::kIncise, some_strokes(seed, 6));
  }
}
TEST(JournalReplay, works_without_snapping) {
  follow(kuhn_cube(4), 0.0, Profile::kIncise, some_strokes(7, 5));
}
TEST(JournalReplay, works_in_the_paper_profile) {
  follow(jittered_cube(4, 8), 0.0, Profile::kPaper, some_strokes(8, 5));
}

TEST(JournalReplay, follows_cuts_that_cross_and_double_passes) {
  const Box box{Vec3(0, 0, 0), Vec3(1, 1, 1)};
  const Stroke down =
      quad_stroke(Vec3(0.47, -0.2, 1.2), Vec3(0.47, 1.2, 1.2), Vec3(0.47, -0.2, -0.2), Vec3(0.47, 1.2, -0.2), 7);
  follow(kuhn_cube(5), 0.2, Profile::kIncise,
         {*plane_stroke(box, Vec3(0, 1, 0), 0.53), followed_by(down, reversed(down)),
          coring_stroke(Vec3(0.5, 0.5, 0), 0.3, 24, -0.2, 1.2), *plane_stroke(box, Vec3(1, 1, 1), 1.5)});
}

TEST(JournalReplay, follows_maintenance_edit_by_edit) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    follow_maintained(jittered_cube(4, seed), 0.2, Profile::kIncise, some_strokes(seed, 4));
  }
}
TEST(JournalReplay, follows_maintenance_of_cuts_without_snapping) {
  follow_maintained(kuhn_cube(4), 0.0, Profile::kIncise, some_strokes(7, 4));
}
TEST(JournalReplay, follows_the_papers_maintenance) {
  follow_maintained(jittered_cube(4, 8), 0.0, Profile::kPaper, some_strokes(8, 4));
}

}  // namespace
}  // namespace incise::test
