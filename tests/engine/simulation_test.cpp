// SPDX-License-Identifier: Apache-2.0
#include "incise/engine/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "incise/mesh/components.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/validate.h"

namespace incise::simulation_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A block of 40 × 20 × 20 mm, held at its bottom and at both ends, and a blade that comes down on it along y.
class Block {
 public:
  static constexpr unsigned kCells = 6;  // across the block

  explicit Block(double young = 300e3, double toughness = 0, unsigned threads = 1, Material material = {}) {
    SimulationOptions options;
    options.materials.fallback = material;
    options.body.gravity = Vec3::Zero();
    options.body.threads = options.engine.threads = threads;
    options.engine.maintain.work_units = 20000;
    options.materials.fallback.young = young;
    options.materials.fallback.toughness = toughness;
    Result<TetMesh> mesh = TetMesh::build(kuhn_box(Vec3::Zero(), {0.04, 0.02, 0.02}, {2 * kCells, kCells, kCells}));
    simulation_.emplace(Simulation::create(std::move(mesh).value(), options).value());
    sim().mesh().for_each_vertex([&](VertexId v) {
      const Vec3& p = sim().mesh().rest(v);
      if (p.z() < 1e-9 || p.x() < 1e-9 || p.x() > 0.04 - 1e-9) {
        EXPECT_TRUE(sim().body().hold(v, kInfinity).ok());
      }
    });
  }

  [[nodiscard]] Simulation& sim() { return *simulation_; }

  static BladePose pose(double z) { return {{{0.0203, -0.001, z}, {0.0203, 0.021, z}}, -Vec3::UnitZ()}; }
  static FrameInput blade_at(double z) {
    FrameInput input;
    input.blade = pose(z);
    return input;
  }
  /// One frame, which must succeed and leave a valid mesh.
  FrameReport frame(const FrameInput& input) {
    const Result<FrameReport> report = sim().frame(input);
    EXPECT_TRUE(report.ok()) << report.error().message;
    EXPECT_TRUE(validate(sim().mesh(), ValidateLevel::kGeometry).ok);
    return report.ok() ? *report : FrameReport{};
  }
  /// Moves the blade from `from` to `to` and lifts it.
  void cut(double from, double to, unsigned frames) {
    for (unsigned i = 0; i <= frames; ++i) frame(blade_at(from + (to - from) * i / frames));
    frame({});
  }

 private:
  std::optional<Simulation> simulation_;
};

double wall_area(const TetMesh& mesh) {
  double area = 0;
  mesh.for_each_tet([&](TetId t) {
    for (unsigned side = 0; side < 4; ++side) {
      const Link link = mesh.links(t)[side];
      if (!link.is_boundary() || link.tag() == 0) continue;
      const auto v = mesh.vertices(Side(t, side));
      area += 0.25 * (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0])).norm();
    }
  });
  return area;
}

TEST(Simulation, TissueWithoutToughnessIsCutToWhereTheBladeIs) {
  Block block;
  block.cut(0.021, 0.008, 20);
  EXPECT_NEAR(wall_area(block.sim().mesh()), 0.02 * 0.012, 0.02 * 0.001);
  EXPECT_EQ(find_components(block.sim().mesh()).count(), 1U);
  EXPECT_EQ(block.sim().engine().stroke_count(), 1U);
}

TEST(Simulation, FramesTellEachStepOnce) {
  Block block;
  std::uint64_t steps = 0;
  std::int64_t faces = 0;
  for (unsigned i = 0; i <= 15; ++i) {
    const FrameReport report = block.frame(Block::blade_at(0.021 - 0.001 * i));
    steps += report.cut.steps;
    faces += report.cut.incision_faces;
  }
  const FrameReport last = block.frame({});
  for (const double ms : last.times.ms) EXPECT_GE(ms, -1e-9);
  std::uint64_t opened = 0;
  block.sim().mesh().for_each_tet([&](TetId t) {
    for (const Link link : block.sim().mesh().links(t)) opened += link.is_boundary() && link.tag() == 1 ? 1U : 0U;
  });
  EXPECT_EQ(steps + last.cut.steps, 16U);
  EXPECT_GT(opened, 0U);
  EXPECT_GT(faces + last.cut.incision_faces, 0);
}

TEST(Simulation, WhatAFrameTakesBackCountsBelowZero) {
  Block block;
  double least = 0, most = 0, sum = 0;
  for (unsigned i = 0; i <= 25; ++i) {
    const CutStatistics cut = block.frame(Block::blade_at(0.021 - 0.00088 * i)).cut;
    const auto vertices = static_cast<double>(cut.new_vertices), faces = static_cast<double>(cut.incision_faces);
    least = std::min({least, vertices, faces});
    most = std::max({most, vertices, faces});
    sum += faces;
  }
  EXPECT_LT(least, 0);
  EXPECT_LT(most, 1e4);
  EXPECT_GT(sum, 0);
}

TEST(Simulation, AThroughCutLeavesTwoPieces) {
  Block block;
  block.cut(0.021, -0.001, 25);
  EXPECT_EQ(find_components(block.sim().mesh()).count(), 2U);
}

TEST(Simulation, ToughTissueDentsBeforeItIsCut) {
  Block block(300e3, 200);
  double strongest = 0;
  bool has_dented = false;
  for (unsigned i = 0; i <= 40; ++i) {
    const FrameReport report = block.frame(Block::blade_at(0.021 - 0.0002 * i));
    strongest = std::max(strongest, report.blade.force.z());
    if (report.blade.touches && !report.blade.yields && report.cut.cut_tets == 0) has_dented = true;
  }
  EXPECT_TRUE(has_dented);
  EXPECT_GT(wall_area(block.sim().mesh()), 0);
  EXPECT_NEAR(strongest, 200 * 0.02, 0.02 * 200 * 0.02);  // toughness · length of the edge
}

/// What a blade meets that goes 15 mm deep.
struct Cutting {
  double steady = 0;   ///< mean force from 1 mm after the first opening on, N
  double dented = 0;   ///< the greatest before it
  double balance = 0;  ///< work at the holds by what it pays for
  double paid = 0;     ///< work of the tool by the same
  std::size_t inverted = 0;
  std::size_t cracks = 0;  ///< falls of the force from above 1.1 of toughness · length to below 0.9
};

Cutting cut_deep(Block& block, double toughness, double slicing = 0) {
  Cutting cutting;
  double tool_work = 0, work = 0, last_force = 0, opened = -1, sum = 0, count = 0;
  bool is_high = false;
  for (unsigned i = 0; i <= 31; ++i) {
    const double z = 0.0205 - 0.0005 * i;
    FrameInput input = Block::blade_at(z);
    input.blade->slicing = slicing;
    const BladeState blade = block.frame(input).blade;
    tool_work += blade.tool_work;
    const double force = block.sim().body().force_on_holds().z();
    work -= 0.5 * (force + last_force) * 0.0005;
    last_force = force;
    if (blade.yields && opened < 0) opened = z;
    if (opened < 0) cutting.dented = std::max(cutting.dented, blade.force.z());
    const double by_toughness = blade.force.z() / (toughness * 0.02);
    if (is_high && by_toughness < 0.9) ++cutting.cracks;
    is_high = by_toughness > 1.1 || (is_high && by_toughness >= 0.9);
    cutting.inverted = std::max(cutting.inverted, block.sim().body().count_inverted());
    if (opened < 0 || z > opened - 0.001) continue;
    sum += blade.force.z();
    ++count;
  }
  const BodyEnergy energy = block.sim().body().energy();
  cutting.steady = sum / count;
  const double bought = toughness * wall_area(block.sim().mesh()) + energy.elastic + energy.kinetic;
  cutting.balance = work / bought;
  cutting.paid = tool_work / bought;
  return cutting;
}

TEST(Simulation, SoftTissueThatStiffensIsCutWithTheForceOfItsToughnessAndTheWorkIsPaid) {
  Material liver;
  liver.stiffening = 20;
  Block block(5e3, 150, 1, liver);
  const Cutting cutting = cut_deep(block, 150);
  EXPECT_NEAR(cutting.steady, 150 * 0.02, 0.05 * 150 * 0.02);
  EXPECT_NEAR(cutting.balance, 1, 0.15);
  EXPECT_EQ(cutting.inverted, 0U);
}

// Atkins, Xu and Jeronimidis (2004): the push falls by 1 + ξ², and what is cut costs the same.
TEST(Simulation, AnEdgeThatSlicesIsPushedWithLessAndItsWorkIsPaidAllTheSame) {
  Material liver;
  liver.stiffening = 20;
  for (const double slicing : {0.0, 1.0, 2.0}) {
    Block block(5e3, 150, 1, liver);
    const Cutting cutting = cut_deep(block, 150, slicing);
    const double pushed = 150 * 0.02 / (1 + slicing * slicing);
    EXPECT_NEAR(cutting.steady, pushed, 0.06 * pushed) << slicing;
    EXPECT_NEAR(cutting.paid, 1, 0.15) << slicing;
  }
}

/// A ring of 16 corners around a place of the block.
BladePose ring_at(double z, double radius) {
  BladePose pose;
  for (int i = 0; i < 16; ++i) {
    const double angle = 2 * std::numbers::pi * i / 16;
    pose.edge.emplace_back(0.0212 + radius * std::cos(angle), 0.0093 + radius * std::sin(angle), z);
  }
  pose.edge.push_back(pose.edge.front());
  pose.direction = -Vec3::UnitZ();
  return pose;
}

/// Drives it into soft, tough tissue, and draws it together below. Returns how many pieces there are.
std::size_t pieces_of_a_core(double slicing) {
  Block block(4e3, 300);
  for (unsigned i = 0; i <= 36; ++i) {
    const double drawn = i < 24 ? 0 : (i - 24) / 12.0;
    FrameInput input;
    input.blade = ring_at(0.022 - 0.010 * i / 36.0, (1 - drawn) * 0.005);
    input.blade->slicing = slicing;
    block.frame(input);
  }
  block.frame({});
  EXPECT_TRUE(validate(block.sim().mesh(), ValidateLevel::kGeometry).ok);
  return find_components(block.sim().mesh()).count();
}

TEST(Simulation, ARingThatIsTwistedTakesACoreOutWhereOneThatIsPressedDoesNot) {
  EXPECT_EQ(pieces_of_a_core(6), 2U);
  EXPECT_EQ(pieces_of_a_core(0), 1U);
}

TEST(Simulation, PosesWithASlicingThatIsNoneAreRefused) {
  for (const double slicing : {-1.0, 101.0, kInfinity, std::nan("")}) {
    Block block;
    FrameInput input = Block::blade_at(0.021);
    input.blade->slicing = slicing;
    const auto report = block.sim().frame(input);
    ASSERT_FALSE(report.ok());
    EXPECT_NE(report.error().message.find("slicing"), std::string::npos);
  }
}

TEST(Simulation, AFrontThatRupturesBearsMoreAtRestThanWhileItRuns) {
  Material liver;
  liver.stiffening = 20;
  Block even(5e3, 150, 1, liver);
  liver.rupture = 0.2;
  Block block(5e3, 150, 1, liver);
  const Cutting steady = cut_deep(even, 150), cutting = cut_deep(block, 150);
  EXPECT_GT(cutting.dented, 1.2 * steady.dented);
  EXPECT_GE(cutting.cracks, 3U);
  EXPECT_EQ(steady.cracks, 0U);
  EXPECT_NEAR(cutting.steady, steady.steady, 0.15 * steady.steady);
}

TEST(Simulation, WorkAtTheHoldsPaysForTheCut) {
  Block block(300e3, 200);
  const double stored = block.sim().body().energy().total();
  double work = 0, fracture = 0, last_force = 0, last_z = 0.021;
  for (unsigned i = 0; i <= 60; ++i) {
    const double z = 0.021 - 0.015 * i / 60;
    fracture += block.frame(Block::blade_at(z)).blade.fracture_work;
    const double force = block.sim().body().force_on_holds().z();
    work += 0.5 * (force + last_force) * (z - last_z);
    last_force = force;
    last_z = z;
  }
  const double area = wall_area(block.sim().mesh());
  EXPECT_NEAR(fracture, 200 * area, 0.05 * 200 * area);
  EXPECT_NEAR(work, 200 * area + block.sim().body().energy().total() - stored, 0.1 * work);
}

TEST(Simulation, TheSameFramesGiveTheSameBitsOnOneThreadAndTwo) {
  Block one(100e3, 100, 1), two(100e3, 100, 2);
  one.cut(0.021, 0.006, 15);
  two.cut(0.021, 0.006, 15);
  EXPECT_EQ(one.sim().hash(), two.sim().hash());
}

TEST(Simulation, UndoTakesTheStrokeBackAndLeavesTheTissueWhereItIs) {
  Block block;
  const std::uint64_t before = block.sim().mesh().hash();
  block.cut(0.021, 0.008, 15);
  const std::uint64_t after = block.sim().mesh().hash();
  ASSERT_TRUE(block.sim().undo());
  EXPECT_EQ(block.sim().mesh().hash(), before);
  block.frame({});
  EXPECT_TRUE(block.sim().body().is_finite());
  ASSERT_TRUE(block.sim().redo());
  EXPECT_EQ(block.sim().mesh().hash(), after);
  block.frame({});
}

TEST(Simulation, AHookTakesHoldPullsAndLetsGo) {
  Block block(20e3);
  const Vec3 top(0.02, 0.01, 0.02);
  FrameInput input;
  input.hooks.push_back({7, top, 0.004, 50});
  block.frame(input);
  Vec3 force = Vec3::Zero();
  for (unsigned i = 1; i <= 20; ++i) {
    input.hooks[0].position = top + Vec3(0, 0, 0.0002 * i);
    force = block.frame(input).hook_forces.at(0);
  }
  EXPECT_LT(force.z(), -0.01);  // the tissue pulls it back
  for (unsigned i = 0; i < 60; ++i) block.frame({});
  EXPECT_LT(block.sim().body().energy().elastic, 1e-6);
}

TEST(Simulation, ABallDentsTheSurface) {
  Block block(20e3);
  FrameInput input;
  for (unsigned i = 1; i <= 20; ++i) {
    input.tools = {BallTool{{0.02, 0.01, 0.03 - 0.00015 * i}, 0.01}};
    block.frame(input);
  }
  double deepest = 0;
  block.sim().mesh().for_each_vertex([&](VertexId v) {
    const double depth = 0.01 - (block.sim().mesh().current(v) - Vec3(0.02, 0.01, 0.027)).norm();
    deepest = std::max(deepest, depth);
  });
  EXPECT_LT(deepest, 0.0006);
  EXPECT_GT(block.sim().body().energy().elastic, 0);
}

TEST(Simulation, BadInputIsRefusedAndChangesNothing) {
  Block block;
  block.frame(Block::blade_at(0.021));
  const std::uint64_t before = block.sim().hash();
  FrameInput input = Block::blade_at(0.02);
  input.blade->edge.emplace_back(0, 0, 0);
  EXPECT_NE(block.sim().frame(input).error().message.find("same number of points"), std::string::npos);
  input = Block::blade_at(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(block.sim().frame(input).ok());
  input = Block::blade_at(0.02);
  input.hooks = {{1, Vec3::Zero(), 1, 1}, {1, Vec3::Zero(), 1, 1}};
  EXPECT_NE(block.sim().frame(input).error().message.find("comes twice"), std::string::npos);
  input.hooks = {{1, Vec3::Zero(), 0, 1}};
  EXPECT_NE(block.sim().frame(input).error().message.find("radius"), std::string::npos);
  input.hooks.clear();
  input.tools = {PlaneTool{Vec3(0, 0, 2), 0}};
  EXPECT_NE(block.sim().frame(input).error().message.find("normal"), std::string::npos);
  // Finite, and its square is not: the body would not stay finite.
  input.tools = {PlaneTool{Vec3(0, 0, 1), 1e300}};
  EXPECT_NE(block.sim().frame(input).error().message.find("offset"), std::string::npos);
  input.tools.clear();
  input.hooks = {{1, Vec3(1e300, 0, 0), 1, 1}};
  EXPECT_NE(block.sim().frame(input).error().message.find("beyond 1e+30"), std::string::npos);
  EXPECT_FALSE(block.sim().body().set_velocity(VertexId(0), Vec3(0, -1e300, 0)).ok());
  EXPECT_FALSE(block.sim().settle(1'000'000'000, std::numeric_limits<double>::quiet_NaN()).ok());
  input.hooks.clear();
  input.blade->direction = Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_NE(block.sim().frame(input).error().message.find("direction"), std::string::npos);
  EXPECT_EQ(block.sim().hash(), before);
}

/// Numbers that are finite, and whose products with others are not: the body would be no body ever after.
TEST(Simulation, NumbersThatNoBodyCanBearAreRefused) {
  constexpr double kHuge = 1e300;
  Block block;
  block.frame({});
  const std::uint64_t before = block.sim().hash();
  const Vec3 far(kHuge, 0, 0);
  for (const Hook& hook : {Hook{1, Vec3::Zero(), kHuge, 1}, Hook{1, Vec3::Zero(), 1, kHuge}}) {
    FrameInput input;
    input.hooks = {hook};
    EXPECT_FALSE(block.sim().frame(input).ok());
  }
  for (const Tool& tool :
       {Tool(BallTool{Vec3::Zero(), kHuge}), Tool(BallTool{far, 1}), Tool(RodTool{Vec3::Zero(), far, 1}),
        Tool(RodTool{Vec3::Zero(), Vec3::Ones(), kHuge}), Tool(FlatTool{{Vec3::Zero(), far}, Vec3::UnitZ(), 0}),
        Tool(FlatTool{{Vec3::Zero(), Vec3::UnitX()}, far, 0}),
        Tool(FlatTool{{Vec3::Zero(), Vec3::UnitX()}, Vec3::UnitZ(), kHuge})}) {
    FrameInput input;
    input.tools = {tool};
    EXPECT_FALSE(block.sim().frame(input).ok());
  }
  EXPECT_FALSE(block.sim().body().place(VertexId(0), far).ok());
  EXPECT_EQ(block.sim().hash(), before);
  const Result<TetMesh> mesh = TetMesh::build(kuhn_box(Vec3::Zero(), Vec3::Ones(), {1, 1, 1}));
  const auto refuses = [&](const std::function<void(SimulationOptions&)>& spoil) {
    SimulationOptions options;
    spoil(options);
    return !Simulation::create(*mesh, options).ok();
  };
  EXPECT_FALSE(refuses([](SimulationOptions& /*options*/) {}));
  EXPECT_TRUE(refuses([](SimulationOptions& options) { options.body.length_unit = kHuge; }));
  EXPECT_TRUE(refuses([](SimulationOptions& options) { options.body.length_unit = 1 / kHuge; }));
  EXPECT_TRUE(refuses([](SimulationOptions& options) { options.body.damping = kHuge; }));
  EXPECT_TRUE(refuses([](SimulationOptions& options) { options.contact_stiffness = kHuge; }));
  EXPECT_TRUE(refuses([](SimulationOptions& options) { options.flat_height = kHuge; }));
  for (double Material::*number :
       {&Material::density, &Material::young, &Material::toughness, &Material::cut_friction, &Material::fibre_young}) {
    EXPECT_TRUE(refuses([&](SimulationOptions& options) {
      options.materials.fallback.fibre = {1, 0, 0};
      options.materials.fallback.*number = kHuge;
    }));
  }
}

/// At the bounds themselves everything that is refused beyond them keeps the body finite.
TEST(Simulation, ABodyStaysFiniteAtTheBounds) {
  const auto is_finite_with = [](const std::function<void(SimulationOptions&, FrameInput&)>& stretch) {
    SimulationOptions options;
    options.body.length_unit = 0.1;
    FrameInput input;
    input.hooks = {Hook{1, Vec3(1, 0, 0), 0.6, 100}};
    input.tools = {BallTool{Vec3(0.5, 0.5, 1.2), 0.4}};
    stretch(options, input);
    Result<Simulation> made =
        Simulation::create(TetMesh::build(kuhn_box(Vec3::Zero(), Vec3::Ones(), {2, 2, 2})).value(), options);
    if (!made.ok() || !made->body().hold(VertexId(0), std::numeric_limits<double>::infinity()).ok()) return false;
    for (int i = 0; i < 5; ++i) {
      if (!made->frame(input).ok()) return false;
    }
    return std::isfinite(made->body().energy().elastic) && made->body().momentum().allFinite();
  };
  for (const double unit : {kLeastExtent, kGreatestExtent}) {
    EXPECT_TRUE(is_finite_with([&](auto& options, auto& /*input*/) { options.body.length_unit = unit; })) << unit;
  }
  EXPECT_TRUE(is_finite_with([](auto& options, auto&) { options.materials.fallback.young = kGreatestExtent; }));
  EXPECT_TRUE(is_finite_with([](auto& options, auto&) { options.materials.fallback.density = kGreatestExtent; }));
  EXPECT_TRUE(is_finite_with([](auto& options, auto&) { options.contact_stiffness = kGreatestExtent; }));
  EXPECT_TRUE(is_finite_with([](auto& options, auto&) { options.body.damping = kGreatestExtent; }));
  EXPECT_TRUE(is_finite_with([](auto&, auto& input) { input.hooks[0].radius = kGreatestExtent; }));
  EXPECT_TRUE(is_finite_with([](auto&, auto& input) { input.hooks[0].stiffness = kGreatestExtent; }));
  EXPECT_TRUE(is_finite_with([](auto&, auto& input) { input.hooks[0].position = Vec3(0, 0, kGreatestExtent); }));
  EXPECT_TRUE(is_finite_with([](auto&, auto& input) { input.tools = {BallTool{Vec3(0, 0, 1), kGreatestExtent}}; }));
  EXPECT_TRUE(is_finite_with([](auto&, auto& input) {
    input.tools = {RodTool{Vec3::Zero(), Vec3(0, 0, kGreatestExtent), kGreatestExtent}};
  }));
}

TEST(Simulation, OptionsOutOfRangeAreRefused) {
  SimulationOptions options;
  options.frame_seconds = 0;
  Result<TetMesh> mesh = TetMesh::build(kuhn_box(Vec3::Zero(), Vec3::Ones(), {1, 1, 1}));
  EXPECT_FALSE(Simulation::create(*mesh, options).ok());
  options = {};
  options.materials.fallback.young = -1;
  EXPECT_FALSE(Simulation::create(*mesh, options).ok());
  options = {};
  options.engine.cut.snap = 2;
  EXPECT_FALSE(Simulation::create(*mesh, options).ok());
}

TEST(Simulation, TheSnapshotForForceFeedbackIsSound) {
  Block block(300e3, 200);
  for (unsigned i = 0; i <= 30; ++i) {
    block.frame(Block::blade_at(0.021 - 0.0003 * i));
    ASSERT_TRUE(check(block.sim().haptic_snapshot()).ok()) << check(block.sim().haptic_snapshot()).error().message;
  }
  EXPECT_TRUE(block.sim().haptic_snapshot().touches);
  EXPECT_GT(block.sim().haptic_snapshot().engaged_length, 0.015);
}

}  // namespace
}  // namespace incise::simulation_test
