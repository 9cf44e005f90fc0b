// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "app/scene/scene.h"
#include "app/scene/scene_simulation.h"
#include "handle.h"
#include "incise/mesh/shapes.h"

namespace simulation_test {
namespace {

using namespace incise;
using incise_test::rows;
using incise_test::SimulationHandle;
using incise_test::sized;

const char* const kScene = R"({
  "format": "incise-scene", "version": 1, "name": "hanging cube",
  "model": {"box": {"cells": [4, 4, 4]}},
  "length_unit": 0.1,
  "materials": {"default": {"young": 20000, "toughness": 20}},
  "attachments": [{"below": [0, 0, -1, -0.99]}],
  "strokes": [{"blade": [{"edges": [{"t": 0, "points": [[0.5, -0.3, -0.2], [0.5, -0.3, 0.6]]},
                                    {"t": 0.3, "points": [[0.5, 1.3, -0.2], [0.5, 1.3, 0.6]]}]}]}],
  "duration": 0.4})";

SimulationHandle hanging_cube() {
  incise_simulation* simulation = nullptr;
  EXPECT_EQ(incise_simulation_parse_scene(kScene, nullptr, 1, &simulation), INCISE_OK) << incise_last_error();
  return SimulationHandle(simulation);
}

incise_simulation_state state_of(const incise_simulation* simulation) {
  auto state = sized<incise_simulation_state>();
  EXPECT_EQ(incise_simulation_look(simulation, &state), INCISE_OK) << incise_last_error();
  return state;
}

TEST(CSimulation, of_a_scene_has_the_hashes_of_cpp) {
  const app::Scene scene = app::parse_scene(kScene, "scene").value();
  Simulation expected = app::make_simulation(scene, app::load_model(scene)->mesh).value();
  const SimulationHandle simulation = hanging_cube();
  ASSERT_NE(simulation, nullptr);
  std::uint64_t cut = 0;
  for (std::uint64_t i = 0; i < scene.frames; ++i) {
    ASSERT_TRUE(expected.frame(app::scene_input(scene, i)).ok());
    ASSERT_EQ(incise_simulation_play(simulation.get(), nullptr), INCISE_OK) << incise_last_error();
    ASSERT_EQ(state_of(simulation.get()).hash, expected.hash()) << "frame " << i;
    auto report = sized<incise_report>();
    ASSERT_EQ(incise_simulation_cut_report(simulation.get(), &report), INCISE_OK);
    cut += report.cut_tets;
  }
  EXPECT_GT(cut, 0U);
  EXPECT_EQ(state_of(simulation.get()).frames, scene.frames);
  EXPECT_EQ(state_of(simulation.get()).scene_frames, scene.frames);
}

TEST(CSimulation, its_engine_is_to_be_read) {
  const SimulationHandle simulation = hanging_cube();
  const incise_engine* engine = incise_simulation_engine(simulation.get());
  EXPECT_EQ(incise_test::counts(engine).tets, 384U);
  const std::uint64_t version = incise_test::counts(engine).version;
  ASSERT_EQ(incise_simulation_frame(simulation.get(), nullptr, nullptr), INCISE_OK);
  EXPECT_GT(incise_test::counts(engine).version, version);
  auto* forced = const_cast<incise_engine*>(engine);
  EXPECT_EQ(incise_engine_undo(forced, nullptr), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_engine_free(forced), INCISE_BAD_ARGUMENT);
}

TEST(CSimulation, hooks_pull_and_tools_press) {
  const SimulationHandle simulation = hanging_cube();
  incise_hook hook{7, 0, {0.5, 0.5, 0}, 0.3, 200, 0, 0, 0};
  incise_tool plane{INCISE_TOOL_PLANE, 0, {1, 0, 0}, {0, 0, 0}, 0, 0.1, nullptr, 0};
  auto input = sized<incise_frame_input>();
  input.hooks = &hook;
  input.n_hooks = 1;
  input.tools = &plane;
  input.n_tools = 1;
  auto report = sized<incise_frame_report>();
  for (int i = 0; i < 10; ++i) {
    hook.position[2] = -0.05 * i;
    ASSERT_EQ(incise_simulation_frame(simulation.get(), &input, &report), INCISE_OK) << incise_last_error();
  }
  EXPECT_GT(report.contacts, 0U);
  EXPECT_EQ(report.n_hook_forces, 1U);
  double force[3] = {};
  std::uint64_t count = 0;
  ASSERT_EQ(incise_simulation_hook_forces(simulation.get(), force, 1, &count), INCISE_OK);
  EXPECT_GT(force[2], 0) << "the tissue pulls the hook up";
  plane.a[0] = 2;
  EXPECT_EQ(incise_simulation_frame(simulation.get(), &input, &report), INCISE_BAD_ARGUMENT);
  std::uint64_t id = 9;
  EXPECT_EQ(incise_last_error_ids(&id, 1), 1U);
  EXPECT_EQ(id, 0U) << "the number of the tool";
  plane.a[0] = 1;
  hook.radius = -1;
  EXPECT_EQ(incise_simulation_frame(simulation.get(), &input, &report), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_last_error_ids(&id, 1), 1U);
  EXPECT_EQ(id, 7U);
  hook.radius = 0.3;
  plane.kind = 9;
  EXPECT_EQ(incise_simulation_frame(simulation.get(), &input, &report), INCISE_BAD_ARGUMENT);
}

TEST(CSimulation, an_edge_that_slices_is_pushed_with_less) {
  std::array<double, 2> strongest{};
  for (const std::size_t k : {0U, 1U}) {
    const SimulationHandle simulation = hanging_cube();
    double edge[6] = {0.5, -0.2, -0.2, 0.5, -0.2, 0.5};
    auto input = sized<incise_frame_input>();
    input.blade = edge;
    input.n_blade = 2;
    input.slicing = 3.0 * static_cast<double>(k);
    auto report = sized<incise_frame_report>();
    for (int i = 0; i < 20; ++i) {
      edge[1] = edge[4] = -0.2 + 0.05 * i;
      ASSERT_EQ(incise_simulation_frame(simulation.get(), &input, &report), INCISE_OK) << incise_last_error();
      strongest[k] = std::max(strongest[k], std::abs(report.blade_force[1]));
    }
    input.slicing = -1;
    EXPECT_EQ(incise_simulation_frame(simulation.get(), &input, &report), INCISE_BAD_ARGUMENT);
  }
  EXPECT_LT(strongest[1], 0.3 * strongest[0]);
}

TEST(CSimulation, the_blade_cuts_and_feels) {
  const SimulationHandle simulation = hanging_cube();
  double edge[6] = {0.5, -0.2, -0.2, 0.5, -0.2, 0.5};
  auto input = sized<incise_frame_input>();
  input.blade = edge;
  input.n_blade = 2;
  auto report = sized<incise_frame_report>();
  auto snapshot = sized<incise_haptic_snapshot>();
  double force = 0;
  bool was_felt = false;
  for (int i = 0; i < 20; ++i) {
    edge[1] = edge[4] = -0.2 + 0.05 * i;
    ASSERT_EQ(incise_simulation_frame(simulation.get(), &input, &report), INCISE_OK) << incise_last_error();
    force = std::max(force, std::hypot(report.blade_force[0], report.blade_force[1], report.blade_force[2]));
    ASSERT_EQ(incise_simulation_haptic_snapshot(simulation.get(), &snapshot), INCISE_OK);
    was_felt = was_felt || snapshot.touches != 0;
  }
  EXPECT_GT(force, 0);
  EXPECT_TRUE(was_felt);
  EXPECT_EQ(report.stroke, 1U);
  const std::uint64_t tets = incise_test::counts(incise_simulation_engine(simulation.get())).tets;
  std::int32_t done = 0;
  ASSERT_EQ(incise_simulation_undo(simulation.get(), &done), INCISE_OK);
  EXPECT_EQ(done, 1);
  EXPECT_NE(incise_test::counts(incise_simulation_engine(simulation.get())).tets, tets);
  ASSERT_EQ(incise_simulation_redo(simulation.get(), &done), INCISE_OK);
  EXPECT_EQ(done, 1);
}

TEST(CSimulation, of_arrays_is_held_by_hand) {
  const auto cube = incise_test::cube(2);
  const auto points = rows<double>(cube.get(), INCISE_REST);
  const auto tets = rows<std::uint32_t>(cube.get(), INCISE_TETS);
  auto mesh = sized<incise_mesh_arrays>();
  mesh.points = points.data();
  mesh.n_points = points.size() / 3;
  mesh.tets = tets.data();
  mesh.n_tets = tets.size() / 4;
  auto body = sized<incise_body_options>();
  ASSERT_EQ(incise_default_body_options(&body, sizeof body), INCISE_OK);
  body.length_unit = 0.1;
  incise_material stiff{};
  stiff.is_fallback = 1;
  stiff.density = 1000;
  stiff.young = 50e3;
  stiff.poisson = 0.4;
  auto options = sized<incise_simulation_options>();
  ASSERT_EQ(incise_default_simulation_options(&options, sizeof options), INCISE_OK);
  options.body = &body;
  options.materials = &stiff;
  options.n_materials = 1;
  incise_simulation* made = nullptr;
  ASSERT_EQ(incise_simulation_create(&mesh, &options, &made), INCISE_OK) << incise_last_error();
  const SimulationHandle simulation(made);
  for (std::uint32_t v = 0; v < mesh.n_points; ++v) {
    if (points[3 * v + 2] == 1) {
      ASSERT_EQ(incise_simulation_hold(made, v, std::numeric_limits<double>::infinity()), INCISE_OK);
    }
  }
  std::uint32_t frames = 0;
  ASSERT_EQ(incise_simulation_settle(made, 300, 1e-3, &frames), INCISE_OK) << incise_last_error();
  EXPECT_GT(frames, 0U);
  const incise_simulation_state state = state_of(made);
  EXPECT_NEAR(state.mass, 1, 1e-9) << "0.1 m cubed of 1000 kg/m^3";
  EXPECT_NEAR(state.force_on_holds[2], -9.81, 0.2) << "its weight";
  std::int32_t is_held = -1;
  ASSERT_EQ(incise_simulation_is_held(made, 0, &is_held), INCISE_OK);
  EXPECT_EQ(is_held, 0);
  EXPECT_EQ(incise_simulation_is_held(made, 1000, &is_held), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_simulation_hold(made, 1000, 1), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(incise_simulation_play(made, nullptr), INCISE_BAD_ARGUMENT) << "there is no scene";
  EXPECT_EQ(incise_simulation_settle_scene(made, &frames), INCISE_BAD_ARGUMENT);
  const double up[3] = {0, 0, 1};
  ASSERT_EQ(incise_simulation_set_velocity(made, 0, up), INCISE_OK);
  std::vector<double> velocities(points.size());
  std::uint64_t count = 0;
  ASSERT_EQ(incise_simulation_velocities(made, velocities.data(), mesh.n_points, &count), INCISE_OK);
  EXPECT_EQ(count, mesh.n_points);
  EXPECT_NEAR(velocities[2], 1, 1e-6);
}

TEST(CSimulation, settles_until_it_is_told_to_stop) {
  const char* scene = R"({"format": "incise-scene", "version": 1, "model": {"box": {"cells": [2, 2, 2]}},
    "length_unit": 0.1, "attachments": [{"below": [0, 0, 1, 0.01]}], "settle": {"frames": 20, "speed": 1e-12}})";
  const auto made = [&] {
    incise_simulation* simulation = nullptr;
    EXPECT_EQ(incise_simulation_parse_scene(scene, nullptr, 1, &simulation), INCISE_OK) << incise_last_error();
    return SimulationHandle(simulation);
  };
  const SimulationHandle by_scene = made(), by_call = made(), whole = made(), stopped = made();
  std::uint32_t frames = 0;
  ASSERT_EQ(incise_simulation_settle_scene(by_scene.get(), &frames), INCISE_OK);
  EXPECT_EQ(frames, 20U);
  ASSERT_EQ(incise_simulation_settle_scene_until(by_call.get(), nullptr, nullptr, &frames), INCISE_OK);
  EXPECT_EQ(frames, 20U);
  EXPECT_EQ(state_of(by_scene.get()).hash, state_of(by_call.get()).hash);
  ASSERT_EQ(incise_simulation_settle(whole.get(), 5, 0, &frames), INCISE_OK);
  int asked = 0;
  const auto stop = [](void* user) -> std::int32_t { return ++*static_cast<int*>(user) > 5 ? 1 : 0; };
  ASSERT_EQ(incise_simulation_settle_until(stopped.get(), 40, 0, stop, &asked, &frames), INCISE_OK);
  EXPECT_EQ(frames, 5U);
  EXPECT_EQ(asked, 6) << "who said stop is not asked again";
  EXPECT_EQ(state_of(whole.get()).hash, state_of(stopped.get()).hash);
  const auto call_back = [](void* user) -> std::int32_t {
    EXPECT_EQ(incise_simulation_frame(static_cast<incise_simulation*>(user), nullptr, nullptr), INCISE_BUSY);
    return 1;
  };
  ASSERT_EQ(incise_simulation_settle_scene_until(stopped.get(), call_back, stopped.get(), &frames), INCISE_OK);
  EXPECT_EQ(frames, 0U);
}

/// The law of a material as C++ has it: the same hash; numbers out of range are refused with the same words.
TEST(CSimulation, materials_have_all_that_those_of_the_library_have) {
  const TetSoup soup = kuhn_cube(3);
  std::vector<double> points;
  std::vector<std::uint32_t> tets;
  for (const Vec3& p : soup.points) points.insert(points.end(), p.data(), p.data() + 3);
  for (const auto& tet : soup.tets) tets.insert(tets.end(), tet.begin(), tet.end());
  auto mesh = sized<incise_mesh_arrays>();
  mesh.points = points.data();
  mesh.n_points = points.size() / 3;
  mesh.tets = tets.data();
  mesh.n_tets = tets.size() / 4;
  incise_material c{};
  c.is_fallback = 1;
  c.density = 900;
  c.young = 2e4;
  c.poisson = 0.3;
  c.stiffening = 5;
  c.rupture = 0.2;
  c.fibre[1] = 2;
  c.fibre_young = 1e4;
  c.prony[0] = 0.5;
  c.prony[1] = 0.2;
  auto options = sized<incise_simulation_options>();
  ASSERT_EQ(incise_default_simulation_options(&options, sizeof options), INCISE_OK);
  options.materials = &c;
  options.n_materials = 1;
  SimulationOptions expected;
  Material& material = expected.materials.fallback;
  material = {900, 2e4, 0.3, 0, 0, 5, 0.2};
  material.fibre = {0, 2, 0};
  material.fibre_young = 1e4;
  material.prony[0] = {0.5, 0.2};
  Simulation same = Simulation::create(TetMesh::build(soup).value(), expected).value();
  incise_simulation* made = nullptr;
  ASSERT_EQ(incise_simulation_create(&mesh, &options, &made), INCISE_OK) << incise_last_error();
  const SimulationHandle simulation(made);
  ASSERT_EQ(incise_simulation_pin(made, 0, 100, 0.5, 1), INCISE_OK);
  ASSERT_TRUE(same.body().hold(VertexId(0), 100, {0.5, true}).ok());
  EXPECT_EQ(incise_simulation_pin(made, 0, 100, 0, 1), INCISE_BAD_ARGUMENT);
  for (int i = 0; i < 5; ++i) {
    auto input = sized<incise_frame_input>();
    incise_hook hook{};
    hook.position[2] = 1 + 0.02 * i;
    hook.radius = 0.4;
    hook.stiffness = 50;
    hook.strength = 1;
    input.hooks = &hook;
    input.n_hooks = 1;
    auto report = sized<incise_frame_report>();
    ASSERT_EQ(incise_simulation_frame(made, &input, &report), INCISE_OK) << incise_last_error();
    FrameInput there;
    there.hooks.push_back({0, Vec3(0, 0, 1 + 0.02 * i), 0.4, 50});
    there.hooks[0].strength = 1;
    ASSERT_TRUE(same.frame(there).ok());
  }
  EXPECT_EQ(state_of(made).hash, same.hash());
  c.fibre[1] = 0;
  EXPECT_EQ(incise_simulation_create(&mesh, &options, &made), INCISE_BAD_ARGUMENT);
  EXPECT_NE(std::string(incise_last_error()).find("fibres need a direction"), std::string::npos);
}

TEST(CSimulation, bad_scenes_are_errors) {
  incise_simulation* simulation = nullptr;
  EXPECT_EQ(incise_simulation_parse_scene("{}", nullptr, 1, &simulation), INCISE_BAD_FILE);
  EXPECT_EQ(incise_simulation_read_scene("/no/such/scene.json", 1, &simulation), INCISE_BAD_FILE);
  EXPECT_EQ(incise_simulation_parse_scene(kScene, nullptr, 0, &simulation), INCISE_BAD_ARGUMENT);
  EXPECT_EQ(simulation, nullptr);
}

/// The force of a tool that has cut in by some way, and where it is then.
void press(incise_haptic_tool* tool, double (&force)[3], double (&place)[3]) {
  const SimulationHandle simulation = hanging_cube();
  auto snapshot = sized<incise_haptic_snapshot>();
  ASSERT_EQ(incise_simulation_haptic_snapshot(simulation.get(), &snapshot), INCISE_OK);
  snapshot.serial = 1;
  snapshot.touches = 1;
  snapshot.cutting_direction[0] = 1;
  snapshot.cutting_direction[1] = snapshot.cutting_direction[2] = 0;
  snapshot.flat_normal[0] = snapshot.flat_normal[1] = 0;
  snapshot.flat_normal[2] = 1;
  for (int k = 0; k < 3; ++k) snapshot.compliance[4 * k] = 1e-3;
  snapshot.toughness = 1000;
  snapshot.engaged_length = 0.01;
  ASSERT_EQ(incise_haptic_tool_accept(tool, &snapshot), INCISE_OK) << incise_last_error();
  EXPECT_EQ(incise_haptic_tool_accept(tool, &snapshot), INCISE_BAD_ARGUMENT) << "not newer";
  for (int i = 0; i <= 40; ++i) {
    const double position[3] = {1e-4 * i, 0, 0}, velocity[3] = {0.1, 0, 0};
    ASSERT_EQ(incise_haptic_tool_tick(tool, 1e-3, position, velocity, force, place), INCISE_OK);
  }
}

TEST(CHaptics, the_tool_pushes_back) {
  incise_haptic_tool* tool = nullptr;
  auto options = sized<incise_haptic_options>();
  ASSERT_EQ(incise_default_haptic_options(&options, sizeof options), INCISE_OK);
  ASSERT_EQ(incise_haptic_tool_create(&options, &tool), INCISE_OK) << incise_last_error();
  double force[3] = {}, place[3] = {};
  press(tool, force, place);
  EXPECT_LT(force[0], 0);
  EXPECT_GT(place[0], 0);
  const double infinite = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const double here[3] = {0, 0, 0};
  for (const double bad : {nan, infinite, -infinite, 1e300, -1e300, -1.0, 0.0, 1e-300}) {
    force[0] = 1;
    EXPECT_EQ(incise_haptic_tool_tick(tool, bad, here, here, force, place), INCISE_BAD_ARGUMENT) << bad;
    EXPECT_NE(std::string(incise_last_error()).find("a tick must last from 1e-9 to 1 s"), std::string::npos);
    EXPECT_EQ(force[0], 0) << "a device gets no force rather than a wrong one";
    const double far[3] = {bad, 0, 0};
    if (std::abs(bad) <= 1) continue;
    EXPECT_EQ(incise_haptic_tool_tick(tool, 1e-3, far, here, force, place), INCISE_BAD_ARGUMENT) << bad;
    EXPECT_EQ(incise_haptic_tool_tick(tool, 1e-3, here, far, force, place), INCISE_BAD_ARGUMENT) << bad;
  }
  EXPECT_EQ(incise_haptic_tool_free(tool), INCISE_OK);
  options.max_force = -1;
  EXPECT_EQ(incise_haptic_tool_create(&options, &tool), INCISE_BAD_ARGUMENT);
}

TEST(CHaptics, a_link_that_is_late_is_told) {
  incise_haptic_tool *here = nullptr, *far = nullptr;
  auto options = sized<incise_haptic_options>();
  ASSERT_EQ(incise_default_haptic_options(&options, sizeof options), INCISE_OK);
  EXPECT_EQ(options.link_delay, 0);
  ASSERT_EQ(incise_haptic_tool_create(&options, &here), INCISE_OK) << incise_last_error();
  options.link_delay = 3e-3;
  ASSERT_EQ(incise_haptic_tool_create(&options, &far), INCISE_OK) << incise_last_error();
  double force_here[3] = {}, force_far[3] = {}, place[3] = {};
  press(here, force_here, place);
  press(far, force_far, place);
  EXPECT_NE(force_here[0], force_far[0]);
  EXPECT_EQ(incise_haptic_tool_free(here), INCISE_OK);
  EXPECT_EQ(incise_haptic_tool_free(far), INCISE_OK);
  options.link_delay = 0.06;
  EXPECT_EQ(incise_haptic_tool_create(&options, &far), INCISE_BAD_ARGUMENT);
  EXPECT_NE(std::string(incise_last_error()).find("delay"), std::string::npos) << incise_last_error();
}

}  // namespace

}  // namespace simulation_test
