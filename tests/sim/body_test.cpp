// SPDX-License-Identifier: Apache-2.0
// The deformable body as users see it: rest and sleep, cuts under load, energy, wild starts, arguments, units.
#include "incise/sim/body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "moving_body.h"
#include "support/beam.h"
#include "support/campaign.h"

namespace incise::test::body_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kStep = 1.0 / 60;

TetSoup beam_soup(const Beam& beam) {
  return kuhn_box(Vec3::Zero(), beam.size, beam.cells);
}

double sag(const MovingBody& moving, const Beam& beam) {
  return tip_sag(moving.mesh(), {moving.state().places.begin(), moving.state().places.end()}, beam);
}

BodyOptions damped(double damping = 5) {
  BodyOptions options;
  options.damping = damping;
  return options;
}

// --- sleep

const Beam kBeam{{12, 4, 4}, Vec3(0.09, 0.03, 0.03)};

MovingBody held_beam(const BodyOptions& options, double young = 60e3) {
  MovingBody moving(beam_soup(kBeam), {tissue(young), {}}, options);
  moving.hold_where(0);
  return moving;
}

void fall_asleep(MovingBody& moving) {
  ASSERT_GT(moving.body().active_vertices(), 0U);
  for (unsigned i = 0; i < 3000 && moving.body().active_vertices() > 0; ++i) moving.advance();
  ASSERT_EQ(moving.body().active_vertices(), 0U);
}

TEST(BodySleep, ABeamAtRestFallsAsleepAndStaysWhereItIs) {
  MovingBody moving = held_beam(damped());
  moving.advance();
  EXPECT_EQ(moving.body().active_vertices(), moving.mesh().vertex_count() - 25);
  fall_asleep(moving);
  const std::uint64_t hash = moving.body().hash();
  moving.advance(10);
  EXPECT_EQ(moving.body().hash(), hash);
  EXPECT_EQ(moving.body().energy().kinetic, 0);
}

TEST(BodySleep, TheSagIsThatOfABeamThatNeverSleeps) {
  BodyOptions restless = damped();
  restless.sleep_below = 0;
  MovingBody moving = held_beam(damped()), awake = held_beam(restless);
  fall_asleep(moving);
  awake.advance(1500);
  EXPECT_EQ(awake.body().active_vertices(), awake.mesh().vertex_count() - 25);
  const double expected = sag(awake, kBeam);
  std::printf("sag with sleep %.6g, without %.6g: %.2e apart\n", sag(moving, kBeam), expected,
              std::abs(sag(moving, kBeam) / expected - 1));
  EXPECT_GT(expected, 1e-3);
  EXPECT_NEAR(sag(moving, kBeam), expected, 0.005 * expected);
}

TEST(BodySleep, WhatPullsAsBeforeLetsItSleep) {
  MovingBody moving = held_beam(damped());
  Pull pull;
  pull.vertices = {vertices_at(moving.mesh(), kBeam.size.x()).front()};
  pull.target = moving.state().places[pull.vertices[0].value] + Vec3(0, 0, 0.01);
  pull.stiffness = 20;
  for (unsigned i = 0; i < 3000 && (i == 0 || moving.body().active_vertices() > 0); ++i) {
    ASSERT_TRUE(moving.body().set_pulls({pull}).ok());
    moving.advance();
  }
  EXPECT_EQ(moving.body().active_vertices(), 0U);
  EXPECT_GT(moving.body().pull_force(0).norm(), 1e-3);
  ASSERT_TRUE(moving.body().set_pulls({}).ok());
  moving.advance();
  EXPECT_GT(moving.body().active_vertices(), 0U);
}

TEST(BodySleep, WhatIsAsleepWakes) {
  const std::vector<std::pair<const char*, std::function<void(MovingBody&)>>> causes = {
      {"a pull",
       [](MovingBody& moving) {
         Pull pull;
         pull.vertices = {vertices_at(moving.mesh(), kBeam.size.x()).front()};
         pull.target = moving.state().places[pull.vertices[0].value] + Vec3(0, 0, 0.01);
         pull.stiffness = 20;
         ASSERT_TRUE(moving.body().set_pulls({pull}).ok());
       }},
      {"a cut", [](MovingBody& moving) { moving.cut_plane(Vec3(1, 0, 0), 0.048); }},
      {"a moved hold",
       [](MovingBody& moving) {
         for (const VertexId v : vertices_at(moving.mesh(), 0)) {
           ASSERT_TRUE(moving.body().move_hold(v, moving.mesh().rest(v) + Vec3(0, 0, 0.005)).ok());
         }
       }},
      {"a hold let go",
       [](MovingBody& moving) {
         for (const VertexId v : vertices_at(moving.mesh(), 0)) ASSERT_TRUE(moving.body().hold(v, 0).ok());
       }},
      {"a place",
       [](MovingBody& moving) {
         const VertexId v = vertices_at(moving.mesh(), kBeam.size.x()).front();
         ASSERT_TRUE(moving.body().place(v, moving.state().places[v.value] + Vec3(0, 0, 0.003)).ok());
       }},
      {"a velocity", [](MovingBody& moving) {
         const VertexId v = vertices_at(moving.mesh(), kBeam.size.x()).front();
         ASSERT_TRUE(moving.body().set_velocity(v, Vec3(0, 0, 0.5)).ok());
       }}};
  for (const auto& [name, cause] : causes) {
    SCOPED_TRACE(name);
    MovingBody moving = held_beam(damped());
    fall_asleep(moving);
    cause(moving);
    moving.advance();
    EXPECT_GE(moving.body().active_vertices(), 5U);
    const std::vector<Vec3> before = moving.state().places;
    moving.advance(5);
    double furthest = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      furthest = std::max(furthest, (moving.state().places[i] - before[i]).norm());
    }
    EXPECT_GT(furthest, 1e-7);
  }
}

// --- the same bits

std::uint64_t run_and_cut(unsigned threads) {
  BodyOptions options;
  options.threads = threads;
  MovingBody moving(jittered_cube(8, 6), {tissue(5e3), {}}, options);
  moving.hold_where(0);
  moving.advance(5);
  Random random(6);
  const Box box = rest_bounds(moving.mesh());
  for (int i = 0; i < 4; ++i) {
    moving.cut(random_stroke(random, box));
    moving.advance(3);
  }
  moving.cut_in_steps(random_stroke(random, box));
  EXPECT_TRUE(moving.engine().undo());
  moving.follow();
  moving.advance(5);
  return moving.body().hash();
}

TEST(Body, TheSameCallsGiveTheSameBitsOnAnyNumberOfThreads) {
  const std::uint64_t hash = run_and_cut(1);
  EXPECT_EQ(run_and_cut(2), hash);
  if (is_whole_campaign()) {
    EXPECT_EQ(run_and_cut(1), hash);
  }
}

/// The places at rest of the vertices in the order in which they are visited.
std::vector<Vec3> visited_places(TetSoup soup) {
  const TetMesh mesh = *TetMesh::build(std::move(soup));
  DeformableBody body = make_body(mesh, {});
  EXPECT_TRUE(body.advance(kStep).ok());
  const auto& s = body.state();
  std::vector<Vec3> places;
  for (const auto part : {detail::SweepOrder::Part::kFirst, detail::SweepOrder::Part::kSecond}) {
    for (const std::uint32_t v : s.order.awake(part)) places.push_back(s.rest[VertexId(v)]);
  }
  return places;
}

TEST(Body, VerticesAreVisitedInOneOrderWhateverThatOfTheFile) {
  TetSoup soup = beam_soup(kBeam), shuffled = soup;
  const auto count = static_cast<std::uint32_t>(soup.points.size());
  const auto place = [&](std::uint32_t v) { return (v * 37 + 11) % count; };
  ASSERT_NE(count % 37, 0U);
  for (std::uint32_t v = 0; v < count; ++v) shuffled.points[place(v)] = soup.points[v];
  for (auto& tet : shuffled.tets) {
    for (std::uint32_t& v : tet) v = place(v);
  }
  const std::vector<Vec3> expected = visited_places(soup);
  EXPECT_GT(expected.size(), count / 2);
  EXPECT_EQ(visited_places(shuffled), expected);
}

// --- cuts under load

/// A beam that is stretched by a fifth and cut across opens within one frame.
TEST(Body, WallsOfAStretchedBeamOpenAtOnce) {
  MovingBody moving(beam_soup(kBeam), {tissue(20e3), {}}, damped());
  moving.hold_where(0);
  moving.hold_where(kBeam.size.x());
  for (const VertexId v : vertices_at(moving.mesh(), kBeam.size.x())) {
    ASSERT_TRUE(moving.body().move_hold(v, moving.mesh().rest(v) + Vec3(0.018, 0, 0)).ok());
  }
  moving.advance(120);
  const double x = 0.0475;
  moving.cut_plane(Vec3(1, 0, 0), x);
  moving.advance();
  double near_side = -kInfinity, far_side = kInfinity;  // of the walls, by where they stand
  moving.mesh().for_each_tet([&](TetId t) {
    double middle = 0;
    for (const VertexId v : moving.mesh().vertices(t)) middle += 0.25 * moving.mesh().rest(v).x();
    for (const VertexId v : moving.mesh().vertices(t)) {
      if ((moving.mesh().shape_of(v) & shape::kWall) == 0) continue;
      const double place = moving.body().positions()[v.value].x();
      if (middle < x) near_side = std::max(near_side, place);
      if (middle > x) far_side = std::min(far_side, place);
    }
  });
  std::printf("one frame after the cut the gap is %.3g m\n", far_side - near_side);
  EXPECT_GT(far_side - near_side, 1e-4);
  EXPECT_LT(far_side - near_side, 0.018);
}

// --- energy

/// Lets a body go that is held out of shape; returns the greatest rise of its energy within one frame, and checks that
/// it goes down in the long run.
double greatest_rise(MovingBody& moving, unsigned steps) {
  const double start = moving.body().energy().total();
  double last = start, worst = 0;
  for (unsigned i = 0; i < steps; ++i) {
    moving.advance();
    const double now = moving.body().energy().total();
    EXPECT_LE(now, start);
    worst = std::max(worst, now - last);
    last = now;
  }
  EXPECT_LT(last, 0.01 * start);
  return worst / start;
}

/// A beam that was bent and stretched, unforced.
double rise_of_bent_beam(double poisson, double damping, unsigned iterations) {
  BodyOptions options = damped(damping);
  options.gravity = Vec3::Zero();
  options.sleep_below = 0;
  options.iterations = iterations;
  MovingBody moving(beam_soup(kBeam), {tissue(20e3, poisson), {}}, options);
  moving.hold_where(0);
  moving.mesh().for_each_vertex([&](VertexId v) {
    const Vec3& x = moving.mesh().rest(v);
    const Vec3 bent = x + Vec3(0.1 * x.x(), 0, -4 * x.x() * x.x());
    ASSERT_TRUE(moving.body().place(v, x.x() > 0 ? bent : x).ok());
  });
  return greatest_rise(moving, 200);
}

TEST(Body, EnergyOfADampedBeamNeverRises) {
  for (const double poisson : {0.0, 0.3, 0.45, 0.49}) EXPECT_LT(rise_of_bent_beam(poisson, 100, 5), 1e-6) << poisson;
}

TEST(Body, EnergyNeverRisesWhereTheDescentIsFinished) {
  EXPECT_LT(rise_of_bent_beam(0.45, 1, 300), 1e-6);
}

/// Few iterations with little damping: a swing takes more out of the velocities than it should at one time, and less at
/// another. It stays below where it began.
TEST(Body, EnergyOfAnUnfinishedDescentRisesLittle) {
  const double rise = rise_of_bent_beam(0.45, 1, 5);
  std::printf("energy: greatest rise in a frame %.2e of the peak at 5 iterations, damping 1/s\n", rise);
  EXPECT_LT(rise, 0.1);
}

TEST(Body, EnergyOfAFreeBodyNeverRises) {
  BodyOptions options = damped(1);
  options.gravity = Vec3::Zero();
  options.sleep_below = 0;
  MovingBody moving(jittered_cube(5, 3), {tissue(2e3), {}}, options);
  moving.mesh().for_each_vertex([&](VertexId v) {
    const Vec3 x = moving.mesh().rest(v);
    ASSERT_TRUE(moving.body().place(v, Vec3(1.3 * x.x(), 0.9 * x.y() + 0.2 * x.x() * x.z(), x.z())).ok());
  });
  EXPECT_LT(greatest_rise(moving, 400), 1e-6);
}

// --- from anywhere

void expect_finite_from_anywhere(Relaxation relaxation, double spread, double eps, bool touches) {
  SCOPED_TRACE(testing::Message() << "spread " << spread << " eps " << eps);
  const CutBeam cut = cut_beam({}, eps);
  ASSERT_GT(cut.mesh.tet_count(), 0U);
  BodyOptions options = damped();
  options.relaxation = relaxation;
  options.self.on = touches;
  DeformableBody body = make_body(cut.mesh, tissue(20e3, 0.45), options);
  for (const VertexId v : vertices_at(cut.mesh, 0)) ASSERT_TRUE(body.hold(v, kInfinity).ok());
  Random random(9);
  cut.mesh.for_each_vertex([&](VertexId v) {
    const Vec3 off = random.point(-spread, spread);
    ASSERT_TRUE(body.is_held(v) || body.place(v, cut.mesh.rest(v) + off).ok());
  });
  for (unsigned i = 0; i < 60; ++i) {
    ASSERT_TRUE(body.advance(kStep).ok());
    ASSERT_TRUE(body.is_finite()) << "step " << i;
  }
  double furthest = 0;
  cut.mesh.for_each_vertex(
      [&](VertexId v) { furthest = std::max(furthest, (body.positions()[v.value] - cut.mesh.rest(v)).norm()); });
  EXPECT_LT(furthest, 1 + 10 * spread);  // nothing flies off
  EXPECT_TRUE(std::isfinite(body.energy().total()));
}

void expect_finite_from_anywhere(Relaxation relaxation, bool touches = false) {
  using Values = std::vector<double>;
  for (const double spread : of_campaign<Values>({0.005, 5.0}, {0.005, 0.05, 5.0})) {
    for (const double eps : of_campaign<Values>({0.3, 1e-4}, {0.3, 1e-2, 1e-4})) {
      expect_finite_from_anywhere(relaxation, spread, eps, touches);
    }
  }
}

TEST(Body, StaysFiniteFromAnyStart) {
  expect_finite_from_anywhere(Relaxation::kBlockDescent);
}

TEST(Body, StaysFiniteFromAnyStartWithContact) {
  expect_finite_from_anywhere(Relaxation::kBlockDescent, true);
}

TEST(Body, ThePositionBasedRelaxationStaysFiniteFromAnyStart) {
  expect_finite_from_anywhere(Relaxation::kPositionBased);
}

TEST(Body, ABodyWithoutTetsMovesOn) {
  Result<DeformableBody> body = DeformableBody::create(TetMesh(), {}, {});
  ASSERT_TRUE(body.ok());
  EXPECT_TRUE(body->advance(kStep).ok());
  EXPECT_EQ(body->mass(), 0);
}

// --- arguments

void expect_bad(const Status& status, const std::string& part) {
  ASSERT_FALSE(status.ok()) << part;
  EXPECT_EQ(status.error().code, ErrorCode::kBadArgument);
  EXPECT_NE(status.error().message.find(part), std::string::npos) << status.error().message;
}

Status create_with(const std::function<void(BodyOptions&)>& change, const Materials& materials = {}) {
  BodyOptions options;
  change(options);
  const TetMesh mesh = TetMesh::build(kuhn_cube(1)).value();
  const Result<DeformableBody> body = DeformableBody::create(mesh, {}, materials, options);
  return body.ok() ? Status{} : Status{body.error()};
}

TEST(BodyArguments, OptionsOutOfRangeAreRefused) {
  using O = BodyOptions;
  for (const double bad : {0.0, -1.0, kNan, kInfinity}) {
    expect_bad(create_with([&](O& o) { o.length_unit = bad; }), "length unit");
  }
  expect_bad(create_with([](O& o) { o.gravity.y() = kNan; }), "gravity");
  for (const double bad : {-1.0, kNan, kInfinity}) {
    expect_bad(create_with([&](O& o) { o.damping = bad; }), "damping");
  }
  for (const unsigned bad : {0U, 1001U}) {
    expect_bad(create_with([&](O& o) { o.substeps = bad; }), "substeps");
    expect_bad(create_with([&](O& o) { o.iterations = bad; }), "iterations");
  }
  for (const double bad : {-0.1, 0.6, kNan}) {
    expect_bad(create_with([&](O& o) { o.thinnest = bad; }), "thinnest");
    expect_bad(create_with([&](O& o) { o.sleep_below = bad; }), "sleep_below");
  }
  for (const unsigned bad : {0U, 257U}) {
    expect_bad(create_with([&](O& o) { o.threads = bad; }), "threads");
  }
  Materials materials;
  materials.fallback.poisson = 0.5;
  expect_bad(create_with([](O&) {}, materials), "oisson");
  EXPECT_TRUE(create_with([](O&) {}).ok());
}

TEST(BodyArguments, CallsThatMakeNoSenseAreRefusedAndChangeNothing) {
  const TetMesh mesh = TetMesh::build(kuhn_cube(2)).value();
  DeformableBody body = make_body(mesh, tissue(5e3));
  ASSERT_TRUE(body.hold(VertexId(0), kInfinity).ok());
  const std::uint64_t hash = body.hash();
  const VertexId nobody(9999), somebody(1);
  for (const VertexId v : {nobody, VertexId()}) {
    expect_bad(body.hold(v, 1), "not live");
    expect_bad(body.place(v, Vec3::Zero()), "not live");
    expect_bad(body.set_velocity(v, Vec3::Zero()), "not live");
    expect_bad(body.move_hold(v, Vec3::Zero()), "not held");
    EXPECT_EQ(body.mass(v), 0);
    EXPECT_EQ(body.velocity(v), Vec3(Vec3::Zero()));
    EXPECT_EQ(body.local_stiffness(v), Mat3(Mat3::Zero()));
    EXPECT_FALSE(body.is_held(v));
    for (const Status& status : {body.hold(v, 1), body.place(v, Vec3::Zero()), body.set_velocity(v, Vec3::Zero()),
                                 body.move_hold(v, Vec3::Zero())}) {
      EXPECT_EQ(status.error().ids, std::vector<std::uint64_t>{v.value}) << status.error().message;
    }
  }
  expect_bad(body.hold(somebody, -1), "stiffness");
  expect_bad(body.hold(somebody, kNan), "stiffness");
  expect_bad(body.move_hold(somebody, Vec3::Zero()), "not held");
  expect_bad(body.move_hold(VertexId(0), Vec3(kNan, 0, 0)), "not finite");
  expect_bad(body.move_hold(VertexId(0), Vec3(0, 1e300, 0)), "beyond 1e+30");
  expect_bad(body.place(somebody, Vec3(0, kInfinity, 0)), "not finite");
  expect_bad(body.set_velocity(somebody, Vec3(0, kNan, 0)), "not finite");
  for (const double bad : {0.0, -0.1, 1.5, kNan}) {
    const Result<AdvanceReport> report = body.advance(bad);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, ErrorCode::kBadArgument);
  }
  EXPECT_EQ(body.hash(), hash);
}

TEST(BodyArguments, TheFirstMalformedPullIsNamed) {
  const TetMesh mesh = TetMesh::build(kuhn_cube(2)).value();
  DeformableBody body = make_body(mesh, tissue(5e3));
  Pull good;
  good.vertices = {VertexId(1)};
  good.stiffness = 5;
  ASSERT_TRUE(body.set_pulls({good}).ok());
  const auto with = [&](const std::function<void(Pull&)>& change) {
    Pull pull = good;
    change(pull);
    return body.set_pulls({good, pull});
  };
  expect_bad(with([](Pull& p) { p.stiffness = -1; }), "pull 1: the stiffness");
  expect_bad(with([](Pull& p) { p.stiffness = kInfinity; }), "pull 1: the stiffness");
  expect_bad(with([](Pull& p) { p.target.x() = kNan; }), "pull 1: the target");
  expect_bad(with([](Pull& p) { p.limit = -1; }), "pull 1: the limit");
  expect_bad(with([](Pull& p) { p.axis = Vec3(0, 0, 2); }), "pull 1: the axis");
  expect_bad(with([](Pull& p) { p.axis = Vec3(0, 0, kNan); }), "pull 1: the axis");
  expect_bad(with([](Pull& p) { p.weights[2] = kNan; }), "pull 1: a weight");
  expect_bad(with([](Pull& p) { p.weights[0] = 0; }), "pull 1: all weights");
  expect_bad(with([](Pull& p) { p.vertices[0] = VertexId(9999); }), "pull 1: a vertex");
  expect_bad(with([](Pull& p) { p.weights[3] = 0.5; }), "pull 1: a vertex");
  expect_bad(with([](Pull& p) {
               p.vertices = {VertexId(0), VertexId(26), {}, {}};  // opposite corners of the cube
               p.weights = {0.5, 0.5, 0, 0};
             }),
             "pull 1: its vertices are not of one tet");
  ASSERT_EQ(body.pulls().size(), 1U);
  EXPECT_EQ(body.pulls()[0].stiffness, 5);
}

// --- units

/// A beam that was modelled in another unit, after a swing, a cut and a pull; all in SI units.
struct BeamInSi {
  std::vector<Vec3> places;   ///< m
  std::vector<Vec3> figures;  ///< energies, mass, momentum, forces, a velocity, a stiffness
};

BeamInSi beam_in(double unit, bool is_cut) {
  const Beam beam{{12, 4, 4}, Vec3(0.09, 0.03, 0.03) / unit};
  BodyOptions options = damped(1);
  options.length_unit = unit;
  EngineOptions engine;
  engine.maintain.merge = engine.maintain.improve = false;
  MovingBody moving(beam_soup(beam), {tissue(30e3), {}}, options, engine);
  for (const VertexId v : vertices_at(moving.mesh(), 0)) {
    EXPECT_TRUE(moving.body().hold(v, v.value % 2 == 0 ? kInfinity : 40).ok());
  }
  Pull pull;
  pull.vertices = {VertexId(12)};
  pull.target = Vec3(0.1, 0.02, 0.02) / unit;
  pull.stiffness = 3;
  Pull limited = pull;
  limited.vertices = {VertexId(300)};
  limited.axis = Vec3(0, 0, 1);
  limited.limit = 0.01;
  EXPECT_TRUE(moving.body().set_pulls({pull, limited}).ok());
  moving.advance(10);
  if (is_cut) moving.cut_plane(Vec3(0, 0, 1), 0.0131 / unit);
  moving.advance(10);
  BeamInSi result;
  const DeformableBody& body = moving.body();
  for (const Vec3& p : body.positions()) result.places.push_back(unit * p);
  const BodyEnergy energy = body.energy();
  result.figures = {Vec3(energy.elastic, energy.kinetic, energy.held),
                    Vec3(energy.pulled, energy.potential, body.mass()),
                    body.momentum(),
                    body.angular_momentum(),
                    body.force_on_holds(),
                    body.pull_force(0),
                    body.pull_force(1),
                    body.velocity(VertexId(12)),
                    body.local_stiffness(VertexId(12)).diagonal()};
  return result;
}

/// Where the unit is a power of two even the rounding is the same: no number in the solver has a length of its own.
TEST(Body, ABeamInAUnitOfAPowerOfTwoHasTheSameBits) {
  const BeamInSi metres = beam_in(1, false), small = beam_in(0x1p-10, false);
  ASSERT_EQ(metres.places.size(), small.places.size());
  for (std::size_t i = 0; i < metres.places.size(); ++i) EXPECT_EQ(metres.places[i], small.places[i]) << i;
  for (std::size_t i = 0; i < metres.figures.size(); ++i) EXPECT_EQ(metres.figures[i], small.figures[i]) << i;
}

TEST(Body, ABeamInMillimetresBehavesAsOneInMetres) {
  const BeamInSi metres = beam_in(1, true), millimetres = beam_in(1e-3, true);
  ASSERT_EQ(metres.places.size(), millimetres.places.size());
  for (std::size_t i = 0; i < metres.places.size(); ++i) {
    EXPECT_LT((metres.places[i] - millimetres.places[i]).norm(), 2e-4 * 0.09) << i;
  }
  for (std::size_t i = 0; i < metres.figures.size(); ++i) {  // they are differences of places, or nearly so
    const Vec3 &a = metres.figures[i], &b = millimetres.figures[i];
    EXPECT_GT(a.norm(), 0) << i;
    EXPECT_LT((a - b).norm(), 2e-3 * a.norm()) << i << ": " << a.transpose() << " against " << b.transpose();
  }
}

}  // namespace
}  // namespace incise::test::body_test
