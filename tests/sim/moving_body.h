// SPDX-License-Identifier: Apache-2.0
// An engine and a deformable body that follows it, and what tests ask of the two.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/sim/body.h"
#include "sim/body/body_state.h"
#include "support/bodies.h"
#include "support/random_strokes.h"
#include "support/strokes.h"

namespace incise::test {

inline Material tissue(double young, double poisson = 0.45, double density = 1000) {
  Material material;
  material.young = young;
  material.poisson = poisson;
  material.density = density;
  return material;
}

inline DeformableBody make_body(const TetMesh& mesh, const Material& material, const BodyOptions& options = {}) {
  return DeformableBody::create(mesh, {}, {material, {}}, options).value();
}

/// The lanes of a star, in ascending order: the other corners and the weights.
using Lane = std::array<double, 8>;
inline std::vector<Lane> lanes_of(const detail::Stars& stars, VertexId vertex) {
  std::vector<Lane> lanes;
  const detail::Star& star = stars.of(vertex);
  for (std::uint32_t lane = 0; lane < star.lanes; ++lane) {
    const detail::StarBlock& b = stars.blocks()[star.first + lane / detail::kLanes];
    const std::uint32_t i = lane % detail::kLanes;
    const auto wide = [](auto x) { return static_cast<double>(x); };
    lanes.push_back({wide(b.a[i]), wide(b.b[i]), wide(b.c[i]), wide(b.bulk[i]), wide(b.pressure[i]), wide(b.to_a[i]),
                     wide(b.to_b[i]), wide(b.to_c[i])});
  }
  std::sort(lanes.begin(), lanes.end());
  return lanes;
}

/// What must hold of the sweeps, whatever was cut.
inline void expect_sound_order(const DeformableBody::State& s) {
  using Part = detail::SweepOrder::Part;
  std::vector<unsigned> part_of(s.places.size(), 3);
  for (unsigned part = 0; part < 3; ++part) {
    for (const std::uint32_t v : s.order.awake(static_cast<Part>(part))) {
      ASSERT_EQ(part_of[v], 3U) << "vertex " << v << " is visited twice";
      part_of[v] = part;
    }
  }
  for (std::uint32_t slot = 0; slot < s.places.size(); ++slot) {
    const VertexId v(slot);
    ASSERT_EQ(part_of[slot] < 3, s.order.moves(v) && s.order.is_awake(v)) << slot;
    if (!s.is_live(v) || part_of[slot] > 1) continue;
    detail::SweepOrder::for_each_neighbour(s.stars, v, [&](VertexId n) {
      ASSERT_FALSE(part_of[n.value] < 2 && part_of[n.value] != part_of[slot]) << "vertices " << slot << ", " << n.value;
    });
  }
}

/// What a vertex averages.
inline void expect_same_average(const DeformableBody::State& a, const DeformableBody::State& b, VertexId v) {
  ASSERT_NEAR(a.nodal.stiffness(v), b.nodal.stiffness(v), 1e-12 * b.nodal.stiffness(v)) << v.value;
  ASSERT_FLOAT_EQ(a.nodal.term(v).rest_volume, b.nodal.term(v).rest_volume) << v.value;
  ASSERT_LT((a.pressure_slope(v) - b.pressure_slope(v)).norm(), 1e-9 * (1 + b.pressure_slope(v).norm())) << v.value;
}

/// A body that cuts as it moves. Everything is handed to and fro as users do.
class MovingBody {
 public:
  MovingBody(TetSoup soup, Materials materials, const BodyOptions& options = {}, const EngineOptions& engine = {})
      : engine_(Engine::create(TetMesh::build(std::move(soup)).value(), engine).value()),
        body_(DeformableBody::create(engine_.mesh(), {}, materials, options).value()) {}

  [[nodiscard]] Engine& engine() { return engine_; }
  [[nodiscard]] DeformableBody& body() { return body_; }
  [[nodiscard]] const TetMesh& mesh() const { return engine_.mesh(); }
  [[nodiscard]] const DeformableBody::State& state() const { return body_.state(); }

  FollowReport follow() {
    const Result<FollowReport> report = body_.follow(engine_.journal(), engine_.mesh());
    EXPECT_TRUE(report.ok());
    hand_over();
    return *report;
  }
  void hand_over() { ASSERT_TRUE(engine_.set_positions(body_.positions()).ok()); }
  void advance(unsigned steps = 1, double dt = 1.0 / 60) {
    for (unsigned i = 0; i < steps; ++i) ASSERT_TRUE(body_.advance(dt).ok());
    hand_over();
  }
  void cut(const Stroke& stroke) {
    ASSERT_TRUE(engine_.cut(stroke).ok());
    follow();
  }
  void cut_plane(const Vec3& normal, double offset) { cut(*plane_stroke(rest_bounds(mesh()), normal, offset)); }
  /// In steps, while the body moves.
  void cut_in_steps(const Stroke& stroke) {
    ASSERT_TRUE(engine_.begin_stroke({stroke.edges[0]}).ok());
    for (std::size_t i = 1; i < stroke.edges.size(); ++i) {
      ASSERT_TRUE(engine_.step({stroke.edges[i]}).ok());
      follow();
      advance();
    }
    ASSERT_TRUE(engine_.end_stroke().ok());
    follow();
  }
  void hold_where(double x, double stiffness = std::numeric_limits<double>::infinity()) {
    mesh().for_each_vertex([&](VertexId v) {
      if (std::abs(mesh().rest(v).x() - x) > 1e-9) return;
      ASSERT_TRUE(body_.hold(v, stiffness).ok());
    });
  }

  /// Tets, stars and what follows from them are those of a body that is made of the mesh as it stands.
  void expect_like_fresh() {
    const DeformableBody fresh = DeformableBody::create(mesh(), {}, body_.materials(), body_.options()).value();
    const DeformableBody::State &a = state(), &b = fresh.state();
    ASSERT_EQ(a.tets.size(), b.tets.size());
    for (std::uint32_t slot = 0; slot < a.tets.size(); ++slot) {
      const TetId t(slot);
      ASSERT_EQ(a.tets[t][0].is_valid(), b.tets[t][0].is_valid()) << slot;
      if (!a.tets[t][0].is_valid()) continue;
      ASSERT_EQ(a.tets[t], b.tets[t]);
      ASSERT_EQ(a.regions[t], b.regions[t]);
    }
    ASSERT_EQ(a.places.size(), b.places.size());
    for (std::uint32_t slot = 0; slot < a.places.size(); ++slot) {
      const VertexId v(slot);
      ASSERT_EQ(a.is_live(v), b.is_live(v)) << slot;
      ASSERT_EQ(lanes_of(a.stars, v), lanes_of(b.stars, v)) << "the star of vertex " << slot;
      if (!a.is_live(v) || a.in_crumb[v] == b.in_crumb[v]) {
        ASSERT_EQ(a.order.moves(v), b.order.moves(v) && !body_.is_held(v)) << slot;
      } else if (a.stale_pieces == 0 && !is_in_held_piece(v)) {
        // Pieces are told late. What counts as a crumb is measured by the mean tet of the mesh that a body was made of.
        const auto [least, most] = std::minmax({a.largest_crumb, b.largest_crumb});
        ASSERT_GE(volume_of_piece(v), least * (1 - 1e-9)) << slot;
        ASSERT_LT(volume_of_piece(v), most * (1 + 1e-9)) << slot;
      }
      if (!a.is_live(v)) continue;
      ASSERT_EQ(a.rest[v], b.rest[v]);
      ASSERT_EQ(a.places[slot], b.places[slot]);
      ASSERT_NEAR(a.motions[v].diagonal, b.motions[v].diagonal, 1e-9 * b.motions[v].diagonal);
      if (a.nodal.is_on) expect_same_average(a, b, v);
      ASSERT_NEAR(a.motions[v].reach, b.motions[v].reach, 1e-5F * b.motions[v].reach);
    }
    const double energy = fresh.energy().elastic;
    ASSERT_NEAR(body_.energy().elastic, energy, 1e-10 * std::abs(energy) + 1e-16);
  }
  /// The masses are those of the mesh: so it is where the density is the same everywhere.
  void expect_masses_of_fresh(double tolerance) {
    const DeformableBody fresh = DeformableBody::create(mesh(), {}, body_.materials(), body_.options()).value();
    mesh().for_each_vertex(
        [&](VertexId v) { ASSERT_NEAR(body_.mass(v), fresh.mass(v), tolerance * fresh.mass(v)) << v.value; });
  }

 private:
  /// Whether a vertex of the piece is held: such a piece is no crumb.
  [[nodiscard]] bool is_in_held_piece(VertexId vertex) {
    const DeformableBody::State& state = this->state();
    return std::any_of(state.holds.begin(), state.holds.end(), [&](const auto& hold) {
      return state.piece_of[VertexId(hold.first)] == state.piece_of[vertex];
    });
  }
  /// At rest, of the piece that the vertex is in.
  [[nodiscard]] double volume_of_piece(VertexId vertex) const {
    const Components components = find_components(mesh());
    double volume = 0;
    mesh().for_each_tet([&](TetId t) {
      const auto corners = mesh().vertices(t);
      const bool is_at = std::find(corners.begin(), corners.end(), vertex) != corners.end();
      if (is_at) volume = components.volume[components.label[t.value]];
    });
    return volume;
  }

  Engine engine_;
  DeformableBody body_;
};

/// Random calls of an engine whose body moves meanwhile; `check()` after each.
class RandomCalls {
 public:
  RandomCalls(MovingBody& moving, std::uint64_t seed)
      : moving_(moving), random_(seed), box_(rest_bounds(moving.mesh())) {}

  template <class Check>
  void run(unsigned count, const Check& check) {
    for (unsigned i = 0; i < count && !testing::Test::HasFatalFailure(); ++i) {
      const auto call = random_.integer(0, 9);
      SCOPED_TRACE(testing::Message() << "call " << i << " of kind " << call);
      run_one(call, check);
      check();
      moving_.advance(static_cast<unsigned>(random_.integer(0, 3)));
      SCOPED_TRACE("after moving on");
      check();
    }
  }
  unsigned undone = 0, redone = 0;

 private:
  template <class Check>
  void run_one(std::int64_t call, const Check& check) {
    Engine& engine = moving_.engine();
    if (call < 3) {
      moving_.hand_over();
      ASSERT_TRUE(engine.cut(random_stroke(random_, box_)).ok());
    } else if (call == 3) {
      step_through(check);
    } else if (call == 4) {
      EXPECT_TRUE(engine.maintain(static_cast<std::uint64_t>(random_.integer(0, 200000))).ok());
    } else if (call == 5) {
      EXPECT_TRUE(engine.improve().ok());
    } else if (call < 8) {
      undone += engine.undo() ? 1U : 0U;
    } else {
      redone += engine.redo() ? 1U : 0U;
    }
    moving_.follow();
  }
  template <class Check>
  void step_through(const Check& check) {
    const Stroke stroke = random_stroke(random_, box_);
    ASSERT_TRUE(moving_.engine().begin_stroke({stroke.edges[0]}).ok());
    for (std::size_t i = 1; i < stroke.edges.size() && !testing::Test::HasFatalFailure(); ++i) {
      ASSERT_TRUE(moving_.engine().step({stroke.edges[i]}).ok());
      moving_.follow();
      check();
      moving_.advance();
    }
    ASSERT_TRUE(moving_.engine().end_stroke().ok());
  }

  MovingBody& moving_;
  Random random_;
  Box box_;
};

}  // namespace incise::test
