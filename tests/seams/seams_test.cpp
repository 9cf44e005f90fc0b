// SPDX-License-Identifier: Apache-2.0
// What is brought from outside works like what Incise has: a solver in a simulation, a format of files.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "incise/engine/simulation.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_loader.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/validate.h"
#include "seams/spring_solver.h"
#include "seams/toy_format.h"

namespace incise::test {
namespace {

namespace fs = std::filesystem;

Simulation cube_on_springs(SpringSolver*& solver) {
  TetMesh mesh = *TetMesh::build(kuhn_cube(5));
  auto made = std::make_unique<SpringSolver>(mesh);
  solver = made.get();
  Result<Simulation> simulation = Simulation::create(std::move(mesh), {}, std::move(made));
  EXPECT_TRUE(simulation.ok());
  return std::move(simulation).value();
}

/// A blade that goes in from the side, frame by frame, below the middle.
FrameInput blade_at(int frame) {
  const double x = -0.3 + 0.05 * frame;
  FrameInput input;
  input.blade = BladePose{{{x, -0.5, 0.42}, {x, 1.5, 0.42}}, Vec3::UnitX()};
  return input;
}

TEST(OwnSolver, follows_a_cut_through_a_body_that_moves) {
  SpringSolver* solver = nullptr;
  Simulation simulation = cube_on_springs(solver);
  EXPECT_FALSE(simulation.has_body());
  EXPECT_EQ(&simulation.solver(), solver);
  std::uint64_t cut_tets = 0;
  for (int frame = 0; frame < 20; ++frame) {
    const Result<FrameReport> report = simulation.frame(frame < 18 ? blade_at(frame) : FrameInput());
    ASSERT_TRUE(report.ok()) << report.error().message;
    cut_tets += report->cut.cut_tets;
    ASSERT_TRUE(solver->fits(simulation.mesh())) << "frame " << frame;
  }
  EXPECT_GT(cut_tets, 50U);
  double lowest = 0;
  for (const Vec3& place : solver->positions()) lowest = std::min(lowest, place.z());
  EXPECT_LT(lowest, -0.01);  // what is cut hangs
  EXPECT_TRUE(validate(simulation.mesh(), ValidateLevel::kGeometry).ok);
}

TEST(OwnSolver, feels_hooks) {
  SpringSolver* solver = nullptr;
  Simulation simulation = cube_on_springs(solver);
  FrameInput input;
  input.hooks.push_back({1, Vec3(0.5, 0.5, 0), 0.05, 500});
  ASSERT_TRUE(simulation.frame(input).ok());
  input.hooks[0].position.z() = -0.3;
  Result<FrameReport> report = simulation.frame(input);
  for (int frame = 0; frame < 30; ++frame) report = simulation.frame(input);
  ASSERT_TRUE(report.ok());
  EXPECT_GT(report->hook_forces[0].z(), 0.1);  // it pulls back
}

TEST(OwnSolver, refuses_sutures_unless_it_has_ties) {
  SpringSolver* solver = nullptr;
  Simulation simulation = cube_on_springs(solver);
  const auto id = simulation.add_suture({Vec3(0.5, 0.5, 0.2), Vec3(0.5, 0.5, 0.8)}, Suture());
  ASSERT_FALSE(id.ok());
  EXPECT_NE(id.error().message.find("override `set_ties`"), std::string::npos) << id.error().message;
  EXPECT_TRUE(simulation.sutures().empty());
  EXPECT_TRUE(simulation.frame({}).ok());
}

TEST(OwnSolver, is_asked_for) {
  EXPECT_FALSE(Simulation::create(*TetMesh::build(kuhn_cube(1)), {}, nullptr).ok());
}

TEST(OwnFormat, is_written_and_read_like_the_others) {
  const fs::path file = fs::temp_directory_path() /
                        ("incise_seams_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + ".toy");
  const TetMesh mesh = *TetMesh::build(kuhn_cube(2));
  const io::MeshData data = io::to_mesh_data(mesh, find_components(mesh));
  io::WriteOptions options;
  options.formats = {toy_format()};
  ASSERT_TRUE(io::write_mesh(file, data, options).ok());
  EXPECT_FALSE(io::load_mesh(file).ok()) << "nobody else knows it";
  const Result<io::LoadedMesh> loaded = io::load_mesh(file, {toy_format()});
  fs::remove(file);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded->source.format, "Toy");
  EXPECT_EQ(loaded->mesh.hash(), mesh.hash());
}

TEST(OwnFormat, is_checked_like_the_others) {
  const auto wrong =
      io::read_mesh_bytes("toy 4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 2 9 0\n", "wrong.toy", {}, {}, {toy_format()});
  ASSERT_FALSE(wrong.ok());
  EXPECT_NE(wrong.error().message.find("names vertex 9"), std::string::npos) << wrong.error().message;
  const auto cut_off = io::read_mesh_bytes("toy 4 1\n0 0 0\n", "short.toy", {}, {}, {toy_format()});
  ASSERT_FALSE(cut_off.ok());
  EXPECT_EQ(cut_off.error().code, ErrorCode::kBadFile);
}

}  // namespace
}  // namespace incise::test
