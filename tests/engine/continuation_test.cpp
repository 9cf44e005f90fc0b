// SPDX-License-Identifier: Apache-2.0
// A stroke that starts where the last one ended is one cut with it: at rest, in a body that moves, after undo.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "compose/compose_rows.h"
#include "incise/engine/engine.h"
#include "incise/mesh/components.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/validate.h"
#include "support/bodies.h"
#include "support/campaign.h"
#include "support/engines.h"
#include "support/mirror_checks.h"
#include "support/random.h"

namespace incise::test::continuation_test {
namespace {

/// A blade that goes through the unit cube along a random plane: its pose where it has gone `way` from its middle.
struct RandomPlane {
  Vec3 centre, along, forwards;

  explicit RandomPlane(std::uint64_t seed) {
    Random random(seed);
    const auto direction = [&] {
      const double z = random.real(-1, 1), angle = random.real(0, 6.2831853071795862);
      const double r = std::sqrt(1 - z * z);
      return Vec3(r * std::cos(angle), r * std::sin(angle), z);
    };
    const Vec3 normal = direction();
    forwards = direction();
    forwards = (forwards - forwards.dot(normal) * normal).normalized();
    along = normal.cross(forwards);
    centre = {random.real(0.35, 0.65), random.real(0.35, 0.65), random.real(0.35, 0.65)};
  }
  /// A plane that meets this one in the line along which the edge of both goes through the centre.
  [[nodiscard]] RandomPlane turned(double degrees) const {
    const double angle = degrees * 3.14159265358979323846 / 180;
    RandomPlane other = *this;
    other.forwards = std::cos(angle) * forwards + std::sin(angle) * along.cross(forwards);
    return other;
  }
  [[nodiscard]] BladePose at(double way) const {
    const Vec3 middle = centre + way * forwards;
    return {{middle - 2 * along, middle + 2 * along}, forwards};
  }
};

/// A fifth of the cube: an element.
constexpr double kElement = 0.2;

Engine engine_of_cube() {
  return Engine::create(TetMesh::build(kuhn_cube(5)).value()).value();
}

void stroke(Engine& engine, const RandomPlane& plane, double from, double to) {
  ASSERT_TRUE(engine.begin_stroke(plane.at(from)).ok());
  ASSERT_TRUE(engine.step(plane.at(to)).ok());
  ASSERT_TRUE(engine.end_stroke().ok());
}

/// Through all of the cube by strokes of a certain length.
void cut_through(Engine& engine, const RandomPlane& plane, double length) {
  for (double way = -1.0; way < 1.0; way += length) stroke(engine, plane, way, way + length);
}

TEST(Continuation, of_short_strokes_makes_the_cut_of_one_stroke) {
  for (const double share : {0.1, 0.3, 0.48, 0.65}) {
    for (std::uint64_t seed = 1; seed <= of_campaign(1U, 8U); ++seed) {
      SCOPED_TRACE(testing::Message() << share << " elements, seed " << seed);
      const RandomPlane plane(seed);
      Engine engine = engine_of_cube();
      cut_through(engine, plane, share * kElement);
      EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
      EXPECT_LE(measure_quality(engine.mesh()).lr_max, 25.0);
      EXPECT_LE(engine.mesh().tet_count(), 1000U);  // of 750; one stroke makes 700 to 850
      EXPECT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
    }
  }
}

TEST(Continuation, leaves_a_mesh_in_shape_after_each_stroke) {
  const RandomPlane plane(3);
  Engine engine = engine_of_cube();
  for (double way = -1.0; way < 1.0; way += 0.05) {
    stroke(engine, plane, way, way + 0.05);
    EXPECT_LE(measure_quality(engine.mesh()).lr_max, 60.0);
    ASSERT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
  }
}

/// A pass through the cube in strokes that meet at its centre, each of some steps; pieces that came apart stay apart.
void pass_through(Engine& engine, const RandomPlane& plane, unsigned strokes, unsigned steps) {
  std::size_t pieces = find_components(engine.mesh()).count();
  const auto has_kept_apart = [&] {
    const std::size_t now = find_components(engine.mesh()).count();
    return now >= std::exchange(pieces, now);
  };
  for (unsigned i = 0; i < strokes; ++i) {
    const double from = -1.0 + 2.0 * i / strokes, length = 2.0 / strokes;
    ASSERT_TRUE(engine.begin_stroke(plane.at(from)).ok());
    for (unsigned k = 1; k <= steps; ++k) {
      ASSERT_TRUE(engine.step(plane.at(from + length * k / steps)).ok());
      EXPECT_TRUE(has_kept_apart()) << "stroke " << i << ", step " << k;
    }
    ASSERT_TRUE(engine.end_stroke().ok());
    EXPECT_TRUE(has_kept_apart()) << "stroke " << i;
  }
}

TEST(Continuation, of_a_stroke_that_ended_at_an_older_wall_goes_on_through_it) {
  struct Pass {
    unsigned strokes, steps;
  };
  for (const Pass pass : {Pass{2, 1}, Pass{2, 10}, Pass{28, 1}, Pass{28, 4}}) {
    for (const double degrees : {62.0, 73.0, 90.0}) {
      for (std::uint64_t seed = 1; seed <= of_campaign(2U, 8U); ++seed) {
        SCOPED_TRACE(testing::Message() << pass.strokes << " strokes of " << pass.steps << " steps, " << degrees
                                        << " degrees, seed " << seed);
        const RandomPlane plane(seed);
        Engine engine = engine_of_cube();
        pass_through(engine, plane, 1, 20);
        pass_through(engine, plane.turned(degrees), pass.strokes, pass.steps);
        EXPECT_EQ(find_components(engine.mesh()).count(), 4U);
        EXPECT_LE(engine.mesh().tet_count(), 1000U);
        EXPECT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
      }
    }
  }
}

/// Half of a plane, another plane exactly where that has ended, and the other half.
TEST(Continuation, of_half_a_plane_behind_another_one_that_passes_its_rim) {
  for (const double degrees : {50.0, 70.0, 90.0}) {
    for (std::uint64_t seed = 1; seed <= of_campaign(4U, 16U); ++seed) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees, seed " << seed);
      const RandomPlane plane(seed);
      Engine engine = engine_of_cube();
      stroke(engine, plane, -1, 0);
      pass_through(engine, plane.turned(degrees), 1, 28);
      EXPECT_EQ(find_components(engine.mesh()).count(), 3U) << "the first half reaches the other plane";
      stroke(engine, plane, 0, 1);
      EXPECT_EQ(find_components(engine.mesh()).count(), 4U);
      EXPECT_LE(engine.mesh().tet_count(), 1000U);
      EXPECT_LE(measure_quality(engine.mesh()).lr_max, 30.0);
      EXPECT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
    }
  }
}

/// A hand rests at the wall, trembling, before it goes on: it neither cuts nor tries again each time.
TEST(Continuation, through_an_older_wall_waits_for_a_hand_that_rests_there) {
  const RandomPlane plane(1);
  Engine engine = engine_of_cube();
  pass_through(engine, plane, 1, 20);
  stroke(engine, plane.turned(73), -1, 0);
  ASSERT_TRUE(engine.begin_stroke(plane.turned(73).at(0)).ok());
  std::uint64_t resting_hash = 0;
  for (unsigned k = 0; k < 1500; ++k) {
    const Result<StepReport> step = engine.step(plane.turned(73).at(0.0005 * (k % 3)));
    ASSERT_TRUE(step.ok());
    EXPECT_EQ(step->cut.cut_tets, 0U);
    if (k == 0) resting_hash = engine.mesh().hash();
    if (k % 500 == 499) {
      EXPECT_EQ(engine.mesh().hash(), resting_hash);
    }
  }
  for (const double way : {0.01, 0.05, 0.2, 1.0}) ASSERT_TRUE(engine.step(plane.turned(73).at(way)).ok());
  ASSERT_TRUE(engine.end_stroke().ok());
  EXPECT_EQ(find_components(engine.mesh()).count(), 4U);
  EXPECT_LE(engine.mesh().tet_count(), 1000U);
}

TEST(Continuation, through_an_older_wall_is_undone_redone_and_made_again_bit_for_bit) {
  const RandomPlane plane(1);
  Engine engine = engine_of_cube();
  pass_through(engine, plane, 1, 20);
  stroke(engine, plane.turned(73), -1, 0);
  expect_undone_and_redone(engine, [&] { stroke(engine, plane.turned(73), 0, 1); });
  EXPECT_EQ(find_components(engine.mesh()).count(), 4U);
}

TEST(Continuation, is_undone_redone_and_made_again_bit_for_bit) {
  const RandomPlane plane(5);
  Engine engine = engine_of_cube();
  for (double way = -1.0; way < 0.0; way += 0.1) stroke(engine, plane, way, way + 0.1);
  const std::uint64_t after = expect_undone_and_redone(engine, [&] { stroke(engine, plane, 0.0, 0.1); });
  EXPECT_TRUE(engine.undo());
  stroke(engine, plane, 0.0, 0.1);
  EXPECT_EQ(engine.mesh().hash(), after);
}

TEST(Continuation, begun_and_ended_without_a_step_changes_nothing) {
  const RandomPlane plane(6);
  Engine engine = engine_of_cube();
  stroke(engine, plane, -1.0, 0.0);
  const std::uint64_t before = engine.mesh().hash();
  const std::size_t position = engine.journal().position();
  ASSERT_TRUE(engine.begin_stroke(plane.at(0.0)).ok());
  ASSERT_TRUE(engine.end_stroke().ok());
  EXPECT_EQ(engine.mesh().hash(), before);
  EXPECT_EQ(engine.journal().position(), position);
  stroke(engine, plane, 0.0, 1.0);
  EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
}

/// Where the body stands at a moment: it is sheared to and fro.
void sway(Engine& engine, unsigned moment) {
  const TetMesh& mesh = engine.mesh();
  std::vector<Vec3> positions(mesh.vertex_slots(), Vec3::Zero());
  const double shear = 0.3 * std::sin(0.15 * moment);
  mesh.for_each_vertex([&](VertexId v) {
    const Vec3& x = mesh.rest(v);
    positions[v.value] = x + shear * Vec3(x.z(), 0.5 * x.x(), 0);
  });
  ASSERT_TRUE(engine.set_positions(positions).ok());
}

TEST(Continuation, goes_on_in_a_body_that_moves_between_strokes) {
  for (std::uint64_t seed = 1; seed <= of_campaign(2U, 4U); ++seed) {
    SCOPED_TRACE(seed);
    const RandomPlane plane(seed);
    Engine engine = engine_of_cube();
    JournalMirror mirror = mirror_of(engine.mesh());
    const double mass = mass_of(mirror);
    unsigned moment = 0;
    const auto pose = [&](double way) {
      const double shear = 0.3 * std::sin(0.15 * moment);
      BladePose now = plane.at(way);
      for (Vec3& x : now.edge) x += shear * Vec3(x.z(), 0.5 * x.x(), 0);
      now.direction += shear * Vec3(now.direction.z(), 0.5 * now.direction.x(), 0);
      return now;
    };
    for (double way = -1.0; way < 1.0; way += 0.08) {
      sway(engine, ++moment);
      ASSERT_TRUE(engine.begin_stroke(pose(way)).ok());
      sway(engine, ++moment);
      ASSERT_TRUE(engine.step(pose(way + 0.08)).ok());
      ASSERT_TRUE(engine.end_stroke().ok());
      ASSERT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
      mirror.follow(engine.journal());
      EXPECT_NEAR(mass_of(mirror), mass, 1e-3 * mass);
    }
    EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
    EXPECT_LE(measure_quality(engine.mesh()).lr_max, 25.0);
  }
}

/// A jittered cube that is sheared, and a blade that goes with it.
class ShearedCube {
 public:
  explicit ShearedCube(std::uint64_t seed) : plane_(seed), engine_(engine_of(seed)) {}

  Engine& engine() { return engine_; }
  void shear(double amount) {
    amount_ = amount;
    std::vector<Vec3> positions;
    for (std::uint32_t v = 0; v < engine_.mesh().vertex_slots(); ++v) {
      positions.push_back(map(engine_.mesh().rest(VertexId(v))));
    }
    ASSERT_TRUE(engine_.set_positions(positions).ok());
  }
  /// The blade some way through the cube as it stands.
  [[nodiscard]] BladePose at(double way) const {
    BladePose pose;
    for (const Vec3& x : plane_.at(way).edge) pose.edge.push_back(map(x));
    return pose;
  }
  void is_cut_in_two() {
    EXPECT_EQ(find_components(engine_.mesh()).count(), 2U);
    EXPECT_LE(measure_quality(engine_.mesh()).lr_max, 25.0);
  }

 private:
  static Engine engine_of(std::uint64_t seed) {
    TetSoup soup = kuhn_cube(5);
    jitter(soup, 0.2, seed);
    return Engine::create(TetMesh::build(soup).value()).value();
  }
  [[nodiscard]] Vec3 map(const Vec3& x) const { return x + amount_ * Vec3(x.z(), 0.5 * x.x(), 0); }

  RandomPlane plane_;
  Engine engine_;
  double amount_ = 0;
};

/// Three strokes in a body that stands still in each and far away in the next.
TEST(Continuation, goes_on_where_the_tissue_has_taken_the_front) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    ShearedCube cube(seed);
    double shear = 0.5;
    for (double way = -1.05; way < 1.0; way += 0.7, shear = -shear) {
      cube.shear(shear);
      ASSERT_TRUE(cube.engine().begin_stroke(cube.at(way)).ok());
      for (const double share : {0.25, 0.5, 0.75, 1.0})
        ASSERT_TRUE(cube.engine().step(cube.at(way + share * 0.7)).ok());
      ASSERT_TRUE(cube.engine().end_stroke().ok());
    }
    cube.is_cut_in_two();
  }
}

/// One stroke in a body that moves by up to an element and a half from pose to pose.
TEST(Continuation, of_steps_in_a_body_that_moves_as_far_as_the_blade) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    ShearedCube cube(seed);
    unsigned moment = 0;
    const auto move = [&] { cube.shear(0.4 * std::sin(0.9 * ++moment)); };
    move();
    ASSERT_TRUE(cube.engine().begin_stroke(cube.at(-1.05)).ok());
    for (double pose = 1; pose <= 5; ++pose) {
      move();
      ASSERT_TRUE(cube.engine().step(cube.at(-1.05 + 2.1 * pose / 5)).ok());
    }
    ASSERT_TRUE(cube.engine().end_stroke().ok());
    cube.is_cut_in_two();
  }
}

/// A blade that goes round along any axis through a jittered cube: back to its start, or a little inside or outside
/// of it.
TEST(Continuation, of_one_stroke_back_to_its_start_cuts_a_core_out) {
  for (const double off : {0.0, 0.004, -0.004}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE(testing::Message() << "off by " << off << ", seed " << seed);
      const RandomPlane plane(seed);
      ShearedCube cube(seed);
      Engine& engine = cube.engine();
      const Vec3 axis = plane.along.cross(plane.forwards), middle(0.5, 0.52, 0.49);
      for (unsigned i = 0; i <= 20; ++i) {
        const double share = i / 20.0, angle = 6.2831853071795862 * share;
        const Vec3 outwards = std::cos(angle) * plane.along + std::sin(angle) * plane.forwards;
        const Vec3 x = middle + (0.31 + off * share) * outwards;
        const BladePose pose{{x - 1.5 * axis, x + 1.5 * axis}};
        ASSERT_TRUE(i == 0 ? engine.begin_stroke(pose).ok() : engine.step(pose).ok());
      }
      ASSERT_TRUE(engine.end_stroke().ok());
      EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
      EXPECT_LE(measure_quality(engine.mesh()).lr_max, 60.0);
    }
  }
}

/// Strokes that overlap by half an element each: what lies a little beyond the last one's end is cut by the next,
/// though that ends in the same tet an element further on.
TEST(Continuation, of_strokes_that_overlap_cuts_what_lies_between_their_ends) {
  Engine engine = Engine::create(TetMesh::build(jittered_cube(4, 1)).value()).value();
  const Vec3 from(0.7227295, 2.3809363, -1.0594947), to(1.5339349, 0.1533637, 2.7693258);
  const Vec3 forwards(-0.3919509, -0.8288694, -0.3991867);
  const auto at = [&](double way) { return BladePose{{from + way * forwards, to + way * forwards}, forwards}; };
  for (unsigned i = 0; i < 6; ++i) {
    const double end = 0.341273 + 0.341273 * i, begin = i == 0 ? 0.0 : end - 0.491093;
    ASSERT_TRUE(engine.begin_stroke(at(begin)).ok());
    ASSERT_TRUE(engine.step(at(0.5 * (begin + end))).ok());
    ASSERT_TRUE(engine.step(at(end)).ok());
    ASSERT_TRUE(engine.end_stroke().ok());
  }
  EXPECT_EQ(find_components(engine.mesh()).count(), 2U);
}

/// Five passes up to a quarter of an element beside one another are one wall, its rim included.
TEST(Continuation, of_passes_beside_one_another_adds_next_to_nothing) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const RandomPlane plane(seed);
    Random random(seed);
    Engine engine = engine_of_cube();
    const std::size_t before = engine.mesh().tet_count();
    std::size_t once = 0;
    for (unsigned pass = 0; pass < 5; ++pass) {
      RandomPlane beside = plane;
      beside.centre += random.real(-0.12, 0.12) * kElement * plane.along.cross(plane.forwards);
      ASSERT_TRUE(engine.begin_stroke(beside.at(-1.0)).ok());
      for (unsigned i = 1; i <= 8; ++i) ASSERT_TRUE(engine.step(beside.at(-1.0 + 0.125 * i)).ok());
      ASSERT_TRUE(engine.end_stroke().ok());
      if (pass == 0) once = engine.mesh().tet_count();
    }
    const double few = 40, added = static_cast<double>(engine.mesh().tet_count()) - static_cast<double>(before);
    EXPECT_LE(added, 1.6 * std::max(few, static_cast<double>(once) - static_cast<double>(before)));
  }
}

TEST(Continuation, is_told_to_followers_by_steps_like_any_other) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const RandomPlane plane(seed);
    Engine engine = engine_of_cube();
    JournalMirror mirror = mirror_of(engine.mesh());
    for (double way = -1.0; way < 1.0; way += 0.11) {
      stroke(engine, plane, way, way + 0.11);
      expect_follows(mirror, engine.journal(), engine.mesh());
      expect_affine_velocity(mirror, 1e-6);
    }
    while (engine.undo()) expect_follows(mirror, engine.journal(), engine.mesh());
    while (engine.redo()) expect_follows(mirror, engine.journal(), engine.mesh());
  }
}

/// A ring cut in several strokes, each from where the last ended, in a body that sways all the while.
class SwayingRing {
 public:
  explicit SwayingRing(std::uint64_t seed) : random_(seed), engine_(engine_of(seed)) {}

  void cut() {
    const double turn = 2 * kPi / strokes_;
    const double poses = std::ceil(turn * radius_ / step_);
    for (int stroke = 0; stroke < strokes_; ++stroke) {
      const double from = start_ + turn * stroke;
      sway();
      ASSERT_TRUE(engine_.begin_stroke(at(from)).ok());
      for (double i = 1; i <= poses; ++i) {
        sway();
        ASSERT_TRUE(engine_.step(at(from + turn * i / poses)).ok());
        ASSERT_TRUE(validate(engine_.mesh(), ValidateLevel::kGeometry).ok) << "stroke " << stroke << ", pose " << i;
      }
      ASSERT_TRUE(engine_.end_stroke().ok());
      ASSERT_TRUE(validate(engine_.mesh(), ValidateLevel::kGeometry).ok) << "after stroke " << stroke;
    }
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;

  static Engine engine_of(std::uint64_t seed) {
    TetSoup soup = kuhn_cube(5 + static_cast<unsigned>(seed % 2));
    if (seed % 2 == 1) jitter(soup, 0.2, seed);
    return Engine::create(TetMesh::build(soup).value()).value();
  }
  [[nodiscard]] Vec3 map(const Vec3& p) const {
    const double s = amplitude_ * std::sin(rate_ * moment_);
    return {p.x() * (1 + 0.1 * s) + 0.2 * s * p.z(), p.y(), p.z() + 0.1 * s * p.y()};
  }
  void sway() {
    ++moment_;
    const TetMesh& mesh = engine_.mesh();
    std::vector<Vec3> positions;
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) positions.push_back(map(mesh.rest(VertexId(v))));
    ASSERT_TRUE(engine_.set_positions(positions).ok());
  }
  /// The edge as it goes round, tilted; in some rings it ends inside.
  [[nodiscard]] BladePose at(double angle) const {
    const Vec3 outwards(std::cos(angle), std::sin(angle), 0);
    const Vec3 low(x_, y_, -1.0), high(x_, y_, top_);
    return {{map(low + (radius_ - 1.5 * tilt_) * outwards), map(high + (radius_ + tilt_) * outwards)}, {}};
  }

  Random random_;
  Engine engine_;
  double moment_ = 0, amplitude_ = random_.real(0.5, 2.5), rate_ = random_.real(0.05, 0.4);
  double y_ = random_.real(0.4, 0.6), x_ = random_.real(0.4, 0.6);
  double radius_ = random_.real(0.12, 0.42), step_ = random_.real(0.03, 0.12), tilt_ = random_.real(-0.15, 0.15);
  double top_ = random_.integer(0, 2) == 0 ? random_.real(0.3, 1.0) : 2.0;
  int strokes_ = static_cast<int>(random_.integer(1, 7));
  double start_ = random_.real(0, 6.28);
};

TEST(Continuation, of_rings_in_a_swaying_body_keeps_it_valid_at_every_pose) {
  for (std::uint64_t seed = 160; seed < 166;
       ++seed) {  // 162: a place was looked for in a tet that is flat for a moment
    SCOPED_TRACE(seed);
    SwayingRing(seed).cut();
  }
}

/// Eight half planes around an axis, one stroke each, in a body that was moved and is back at rest. Where their walls
/// meet a rebuild may join vertices so that fans of tets touch along an edge that it leaves as they are: with these
/// angles the fourth did so.
TEST(Continuation, of_half_planes_around_an_axis_parts_all_edges_that_they_pinch) {
  const std::array<double, 3> angles = {4.8468901439150454, 2.3596380481733989, 3.6515593610266452};
  const auto turned = [&](const Vec3& place) {
    Vec3 p = place - Vec3(0.5, 0.5, 0.5);
    for (const auto& [u, v, axis] : {std::array{1U, 2U, 0U}, std::array{0U, 2U, 1U}, std::array{0U, 1U, 2U}}) {
      const double c = std::cos(angles[axis]), s = std::sin(angles[axis]), pu = p[u], pv = p[v];
      p[u] = c * pu - s * pv;
      p[v] = s * pu + c * pv;
    }
    return Vec3(p + Vec3(0.5, 0.5, 0.5));
  };
  const std::vector<ComposeRow> rows = compose_rows();
  const auto star =
      std::find_if(rows.begin(), rows.end(), [](const ComposeRow& row) { return row.name == "star of 8 half planes"; });
  ASSERT_NE(star, rows.end());
  TetSoup soup = kuhn_cube(5);
  jitter(soup, 0.2, 162);
  Engine engine = Engine::create(TetMesh::build(soup).value()).value();
  for (const BladePath& path : star->strokes) {
    std::vector<Vec3> rest;
    for (std::uint32_t v = 0; v < engine.mesh().vertex_slots(); ++v) rest.push_back(engine.mesh().rest(VertexId(v)));
    ASSERT_TRUE(engine.set_positions(rest).ok());
    const auto pose = [&](const Row& row) {
      BladePose now;
      for (const Vec3& p : row) now.edge.push_back(turned(p));
      return now;
    };
    ASSERT_TRUE(engine.begin_stroke(pose(path.front())).ok());
    for (std::size_t i = 1; i < path.size(); ++i) ASSERT_TRUE(engine.step(pose(path[i])).ok());
    ASSERT_TRUE(engine.end_stroke().ok());
    ASSERT_TRUE(validate(engine.mesh(), ValidateLevel::kGeometry).ok);
  }
}

}  // namespace
}  // namespace incise::test::continuation_test
