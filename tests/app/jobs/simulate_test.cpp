// SPDX-License-Identifier: Apache-2.0
// Scenes are run, reported, written and replayed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>

#include "app/jobs/frame_series.h"
#include "app/jobs/replay_job.h"
#include "app/jobs/simulate_job.h"
#include "app/recording/simulation_recording.h"
#include "app/scene/scene_simulation.h"
#include "app/text/text_file.h"
#include "incise/io/mesh_file.h"
#include "incise/mesh/shapes.h"
#include "support/folder.h"
#include "support/scene_cases.h"

namespace simulate_test {
namespace {

namespace fs = std::filesystem;
using namespace incise;
using namespace incise_test;

app::Scene parsed(const Json& json) {
  return app::parse_scene(json.dump(), "scene.json").value();
}

app::SimulateResult run(const app::Scene& scene, const app::SimulateJob& job = {}) {
  Result<app::SimulateResult> result = run_simulate(scene, job);
  EXPECT_TRUE(result.ok()) << result.error().message;
  return result.ok() ? std::move(result).value() : app::SimulateResult();
}

class Simulate : public testing::Test {
 protected:
  app::SimulateJob recording_job() const {
    app::SimulateJob job;
    job.run.record = log_;
    return job;
  }
  app::ReplayResult replay(bool verify = true, bool wants_mesh = false) const {
    Result<app::ReplayResult> result = app::run_replay({log_, verify, wants_mesh});
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result.ok() ? std::move(result).value() : app::ReplayResult();
  }
  std::string error_of_replay() const {
    const auto result = app::run_replay({log_});
    return result.ok() ? "" : result.error().message;
  }
  /// Writes the log anew with the first occurrence of a text changed.
  void change(const std::string& from, const std::string& to) const {
    std::string text = read(log_);
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    ASSERT_TRUE(app::write_text_file(log_, text).ok());
  }

  Folder folder_;
  std::string log_ = folder_ / "log.jsonl";
};

TEST_F(Simulate, reports_what_a_scene_came_to) {
  const app::Scene scene = parsed(full_scene());
  const app::SimulationReport report = run(scene).report;
  EXPECT_EQ(report.frames, 50U);
  EXPECT_EQ(report.frame_ms.size(), 50U);
  EXPECT_EQ(report.job.stage_ms.size(), 50U);
  EXPECT_EQ(report.job.strokes, 2U);
  EXPECT_EQ(report.job.units_per_stroke.size(), 2U);
  EXPECT_LT(report.job.step_ms.size(), 50U);
  EXPECT_GT(report.job.after.tets, report.job.before.tets);
  EXPECT_TRUE(report.job.change.ok);
  EXPECT_TRUE(report.is_finite);
  EXPECT_GE(report.settle_frames, 1U);
  EXPECT_LE(report.settle_frames, 5U);
  EXPECT_GT(report.energy_after.elastic, 0);
  EXPECT_GT(report.forces.contacts, 0U);
  EXPECT_GT(report.forces.peak_hook_force, 0);
  EXPECT_GT(report.forces.peak_suture_force, 0);
  EXPECT_EQ(report.forces.torn_sutures, 0U);
}

/// The same as one call, also where the body comes to rest at the end of what was a chunk of frames once.
TEST_F(Simulate, settles_as_one_call_does) {
  app::Scene scene = parsed(Json::parse(R"({"format": "incise-scene", "version": 1, "length_unit": 0.1,
    "model": {"box": {"cells": [2, 2, 2]}}, "attachments": [{"below": [0, 0, 1, 0.01]}], "frames": 1})"));
  const auto simulation = [&] { return make_simulation(scene, std::move(load_model(scene)->mesh)).value(); };
  scene.settle = {1000, 1};
  while (simulation().settle(1000, scene.settle.speed).value() < 30) scene.settle.speed *= 0.8;
  Simulation at_once = simulation();
  ASSERT_EQ(at_once.settle(1000, scene.settle.speed).value(), 30U) << "another speed is needed";
  ASSERT_TRUE(at_once.frame(scene_input(scene, 0)).ok());
  const app::SimulationReport report = run(scene).report;
  EXPECT_EQ(report.settle_frames, 30U);
  EXPECT_EQ(report.state_hash, at_once.hash());
}

TEST_F(Simulate, is_stopped_while_it_settles_and_replays_what_was_done) {
  app::Scene scene = parsed(full_scene());
  scene.settle = {1000, 1e-12};
  app::SimulateJob job = recording_job();
  int asked = 0;
  job.should_stop = [&] { return ++asked > 7; };
  const app::SimulateResult result = run(scene, job);
  EXPECT_TRUE(result.was_stopped);
  EXPECT_EQ(result.report.settle_frames, 7U);
  EXPECT_NE(read(log_).find("\"frames\":7"), std::string::npos) << read(log_).substr(0, 4000);
  EXPECT_FALSE(replay().difference);
}

/// The wound of the shipped scene gapes until the sutures close it, which hold what pulls at it.
TEST_F(Simulate, a_wound_is_closed_by_sutures) {
  const app::Scene scene = app::read_scene(INCISE_SCENES "/sutured_wound.json").value();
  Simulation simulation = make_simulation(scene, std::move(load_model(scene)->mesh)).value();
  ASSERT_TRUE(simulation.settle(scene.settle.frames).ok());
  const auto lip = [&](double x, double y) {
    return find_nearest(simulation.mesh(), BodyShape::kRest, Vec3(x, y, 23.9), 1e-9)->place(simulation.mesh());
  };
  const auto gape = [&](double x) { return lip(x, 32).y() - lip(x, 30.6).y(); };
  const double closed = gape(40);
  double open = 0;
  for (std::uint64_t i = 0; i < scene.frames; ++i) {
    if (i == 239) open = gape(40);
    ASSERT_TRUE(simulation.frame(scene_input(scene, i)).ok());
  }
  EXPECT_GT(open, closed + 5);
  const auto share = [&](double x) { return (gape(x) - closed) / (open - closed); };
  EXPECT_LT(share(40), 1.0 / 3);  // between the hooks that draw
  for (const double x : {30.0, 50.0}) EXPECT_LT(share(x), 0.05) << x;
  for (const SutureState& suture : simulation.sutures()) {
    EXPECT_EQ(suture.status, SutureStatus::kHolds);
    EXPECT_GT(suture.force, 0.02);
  }
}

TEST_F(Simulate, gives_the_same_whatever_the_threads_the_recording_and_the_run) {
  const app::Scene scene = parsed(full_scene());
  const std::uint64_t hash = run(scene).report.state_hash;
  app::SimulateJob job = recording_job();
  job.run.threads = 3;
  job.output = folder_ / "out.pvd";
  EXPECT_EQ(run(scene, job).report.state_hash, hash);
}

TEST_F(Simulate, report_in_json_has_what_the_contract_asks_for) {
  const Json json = Json::parse(to_json(run(parsed(full_scene())).report));
  for (const char* pointer : {"/format",
                              "/mesh/before/tets",
                              "/mesh/after/components",
                              "/cut/incision_faces",
                              "/quality/after/incision/lr_max",
                              "/volume/relative_error",
                              "/validity/ok",
                              "/time_ms/relax",
                              "/time_ms/total",
                              "/step_ms/p999",
                              "/stage_ms/relax/p50",
                              "/frame_ms/p50",
                              "/frame_ms/p99",
                              "/frame_ms/p999",
                              "/frame_ms/max",
                              "/share/cd",
                              "/share/gm",
                              "/share/rlx",
                              "/share/rd",
                              "/hash",
                              "/state_hash",
                              "/forces/peak_force",
                              "/forces/engaged_length",
                              "/forces/fracture_work",
                              "/forces/tool_work",
                              "/energy/after/elastic",
                              "/options/seed"}) {
    EXPECT_TRUE(json.contains(Json::json_pointer(pointer))) << pointer;
  }
  EXPECT_NEAR(
      json["share"]["cd"].get<double>() + json["share"]["gm"].get<double>() + json["share"]["rlx"].get<double>(), 1,
      1e-9);
}

TEST_F(Simulate, stops_where_it_is_told_to_and_leaves_nothing) {
  app::SimulateJob job;
  job.output = folder_ / "out.pvd";
  int questions = 0;
  job.should_stop = [&] { return ++questions > 12; };
  const app::SimulateResult result = run(parsed(full_scene()), job);
  EXPECT_TRUE(result.was_stopped);
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(Simulate, names_the_frame_that_failed) {
  app::Scene scene = parsed(full_scene());
  scene.hooks[0].radius = -1;  // as no file can say
  const auto result = run_simulate(scene, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().message.rfind("frame 2: ", 0), 0U) << result.error().message;
}

// --- the series

TEST_F(Simulate, writes_a_series_of_the_deforming_body) {
  app::SimulateJob job;
  job.output = folder_ / "a & b.pvd";
  job.every = 20;
  run(parsed(full_scene()), job);
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a & b.pvd", "a & b_frames"}));
  const std::string pvd = read(folder_ / "a & b.pvd");
  EXPECT_NE(pvd.find("timestep=\"0.4\" part=\"0\" file=\"a &amp; b_frames/frame_00001.vtu\""), std::string::npos)
      << pvd;
  EXPECT_NE(pvd.find("timestep=\"1\" part=\"0\" file=\"a &amp; b_frames/frame_00003.vtu\""), std::string::npos) << pvd;
  EXPECT_EQ(pvd.find("frame_00004"), std::string::npos);
  const auto first = io::read_mesh(fs::path(folder_ / "a & b_frames") / "frame_00000.vtu");
  const auto last = io::read_mesh(fs::path(folder_ / "a & b_frames") / "frame_00003.vtu");
  ASSERT_TRUE(first.ok() && last.ok());
  EXPECT_EQ(first->data.soup.tets.size(), 72U);
  EXPECT_GT(last->data.soup.tets.size(), 72U);
  EXPECT_FALSE(last->data.triangle_stroke.empty());
  EXPECT_EQ(last->data.piece.size(), last->data.soup.tets.size());
  EXPECT_NE(last->data.soup.points[5], first->data.soup.points[5]);
}

TEST_F(Simulate, writes_about_a_hundred_files_where_nobody_says_otherwise) {
  Json json = least_scene();
  json["frames"] = 250;
  app::SimulateJob job;
  job.output = folder_ / "out.pvd";
  run(parsed(json), job);
  const auto files = std::distance(fs::directory_iterator(folder_ / "out_frames"), fs::directory_iterator());
  EXPECT_EQ(files, 85);  // every third frame, the first state and the last
}

TEST_F(Simulate, replaces_an_older_series_and_nothing_else) {
  const io::MeshData mesh = [] {
    io::MeshData data;
    data.soup = kuhn_cube(1);
    return data;
  }();
  const auto write = [&](int moments) {
    Result<app::FrameSeries> series = app::FrameSeries::begin(folder_ / "s.pvd");
    if (!series.ok()) return series.error().message;
    for (int i = 0; i < moments; ++i) EXPECT_TRUE(series->add(i, mesh).ok());
    const Status status = series->finish();
    return status.ok() ? std::string() : status.error().message;
  };
  EXPECT_EQ(write(3), "");
  EXPECT_EQ(write(1), "");
  EXPECT_FALSE(fs::exists(fs::path(folder_ / "s_frames") / "frame_00002.vtu"));
  { const Result<app::FrameSeries> dropped = app::FrameSeries::begin(folder_ / "s.pvd"); }
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"s.pvd", "s_frames"}));
  folder_.write("s_frames/letters.txt", "dear");
  EXPECT_NE(write(1).find("is in the way of the series"), std::string::npos);
  EXPECT_EQ(read(folder_ / "s_frames/letters.txt"), "dear");
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"s.pvd", "s_frames"}));
}

TEST_F(Simulate, refuses_a_series_that_another_run_is_writing) {
  io::MeshData mesh;
  mesh.soup = kuhn_cube(1);
  Result<app::FrameSeries> first = app::FrameSeries::begin(folder_ / "s.pvd");
  ASSERT_TRUE(first.ok() && first->add(0, mesh).ok());
  const Result<app::FrameSeries> second = app::FrameSeries::begin(folder_ / "s.pvd");
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().message.find("another run is writing this series"), std::string::npos);
  ASSERT_TRUE(first->add(1, mesh).ok() && first->finish().ok());
  EXPECT_TRUE(fs::exists(folder_ / "s_frames/frame_00000.vtu") && fs::exists(folder_ / "s_frames/frame_00001.vtu"));
}

TEST_F(Simulate, takes_over_what_a_killed_run_left_of_a_series) {
  fs::create_directory(folder_ / "s_frames.incise-part");
  folder_.write("s_frames.incise-part/frame_00007.vtu", "half");
  io::MeshData mesh;
  mesh.soup = kuhn_cube(1);
  app::FrameSeries series = app::FrameSeries::begin(folder_ / "s.pvd").value();
  ASSERT_TRUE(series.add(0, mesh).ok() && series.finish().ok());
  EXPECT_FALSE(fs::exists(folder_ / "s_frames/frame_00007.vtu"));
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"s.pvd", "s_frames"}));
}

TEST_F(Simulate, keeps_the_older_series_where_the_new_one_cannot_be_finished) {
  io::MeshData mesh;
  mesh.soup = kuhn_cube(1);
  const auto begin = [&] { return app::FrameSeries::begin(folder_ / "s.pvd").value(); };
  app::FrameSeries old = begin();
  ASSERT_TRUE(old.add(0, mesh).ok() && old.add(1, mesh).ok() && old.finish().ok());
  fs::remove(folder_ / "s.pvd");
  fs::create_directory(folder_ / "s.pvd");  // where no file can take its place
  app::FrameSeries next = begin();
  ASSERT_TRUE(next.add(0, mesh).ok());
  EXPECT_FALSE(next.finish().ok());
  EXPECT_TRUE(fs::exists(fs::path(folder_ / "s_frames") / "frame_00001.vtu"));
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"s.pvd", "s_frames"}));
}

// --- recordings

TEST_F(Simulate, replays_to_the_same_hashes) {
  const app::SimulationReport made = run(parsed(full_scene()), recording_job()).report;
  const app::ReplayResult again = replay(true, true);
  EXPECT_FALSE(again.difference.has_value()) << again.difference->line << " " << again.difference->found;
  EXPECT_EQ(again.hash, made.state_hash);
  EXPECT_EQ(again.calls, 51U);  // and settling
  EXPECT_EQ(again.strokes, 2U);
  EXPECT_EQ(again.after.tets, made.job.after.tets);
  EXPECT_EQ(again.mesh.soup.tets.size(), made.job.after.tets);
}

TEST_F(Simulate, replays_undo_and_redo) {
  const app::Scene scene = parsed(full_scene());
  app::RecordedSimulation simulation =
      app::RecordedSimulation::create(scene, std::move(app::load_model(scene)->mesh), {1, {}, log_}).value();
  EXPECT_FALSE(*simulation.undo());
  for (std::uint64_t i = 0; i < 22; ++i) ASSERT_TRUE(simulation.frame(scene_input(scene, i)).ok());
  EXPECT_TRUE(*simulation.undo());
  ASSERT_TRUE(simulation.frame({}).ok());
  EXPECT_TRUE(*simulation.redo());
  ASSERT_TRUE(simulation.frame({}).ok());
  FrameInput malformed;
  malformed.blade = BladePose{{Vec3::Zero()}};
  EXPECT_FALSE(simulation.frame(malformed).ok());
  const app::ReplayResult again = replay();
  EXPECT_FALSE(again.difference.has_value());
  EXPECT_EQ(again.calls, 26U);
  EXPECT_EQ(again.hash, simulation.simulation().hash());
}

TEST_F(Simulate, finds_the_first_frame_that_differs) {
  run(parsed(full_scene()), recording_job());
  const std::string whole = read(log_);
  std::istringstream lines(whole);
  std::string line;
  for (int i = 0; i < 9; ++i) std::getline(lines, line);
  const std::string hash = line.substr(line.rfind("\"hash\":"));
  change(hash, "\"hash\":\"0000000000000001\"}");
  const app::ReplayResult result = replay();
  ASSERT_TRUE(result.difference.has_value());
  EXPECT_EQ(result.difference->line, 9U);
  EXPECT_EQ(result.difference->call, "frame");
  EXPECT_FALSE(replay(false).difference.has_value());  // only the end is compared
  ASSERT_TRUE(app::write_text_file(log_, whole).ok());
  change("\"hooks\":[{\"id\":0,\"position\":[1.0,1.0,1.0]", "\"hooks\":[{\"id\":0,\"position\":[1.0,1.0,3.0]");
  EXPECT_GE(replay().difference->line, 5U);  // where the hook takes hold, or after
}

TEST_F(Simulate, replays_a_log_cut_off_at_any_byte_up_to_its_last_whole_frame) {
  Json json = full_scene();
  json["model"]["box"]["cells"] = {1, 1, 1};
  json.erase("attachments");
  app::Scene scene = parsed(json);
  scene.frames = 3;
  run(scene, recording_job());
  const std::string whole = read(log_);
  const std::size_t header = whole.find('\n');
  for (std::size_t size = 1; size < whole.size(); size += 7) {
    ASSERT_TRUE(app::write_text_file(log_, whole.substr(0, size)).ok());
    const Result<app::ReplayResult> result = app::run_replay({log_, true});
    ASSERT_EQ(result.ok(), size >= header) << size;
    if (!result.ok()) {
      EXPECT_NE(result.error().message.find("header is cut off"), std::string::npos) << result.error().message;
      continue;
    }
    const std::string part = whole.substr(0, size + 1);
    EXPECT_EQ(result->calls + 1, static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n'))) << size;
    EXPECT_FALSE(result->difference.has_value()) << size;
  }
}

TEST_F(Simulate, refuses_what_cannot_be_replayed) {
  run(parsed(full_scene()), recording_job());
  const std::string whole = read(log_);
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& words) {
    ASSERT_TRUE(app::write_text_file(log_, whole).ok());
    change(from, to);
    EXPECT_NE(error_of_replay().find(words), std::string::npos) << error_of_replay();
  };
  expect("{\"call\":\"settle\"", "{\"nonsense\":1,\"call\":\"settle\"", "log.jsonl:2: the call has the unknown key");
  expect("\"call\":\"frame\"", "\"call\":\"undo\"", "log.jsonl:3:");
  expect("\"kind\":\"ball\"", "\"kind\":\"cat\"", "tools[1].kind must be one of ball, rod, plane, flat");
  expect("\"radius\":0.1},{\"kind\":\"rod\"", "\"radius\":-0.1},{\"kind\":\"rod\"",
         "log.jsonl:3: the call \"frame\" cannot be made");
  expect("\"cells\":[3,2,2]", "\"cells\":[3,2,3]", "is not the model of the recording");
  expect("\"damping\":1.5", "\"damping\":-1.5", "log.jsonl:1: scene.damping is -1.5");
  expect("\"version\":1", "\"version\":2", "log.jsonl:1: version is 2");
}

TEST_F(Simulate, finds_the_model_from_the_recordings_folder) {
  fs::create_directory(folder_ / "models");
  fs::create_directory(folder_ / "logs");
  folder_.write("models/cube.mesh", cube_mesh(2));
  Json json = least_scene();
  json["model"] = {{"file", "models/cube.mesh"}};
  const app::Scene scene = app::read_scene(folder_.write("s.json", json.dump())).value();
  log_ = folder_ / "logs/log.jsonl";
  run(scene, recording_job());
  EXPECT_NE(read(log_).find("\"file\":\"../models/cube.mesh\""), std::string::npos);
  EXPECT_FALSE(replay().difference.has_value());
}

TEST(SimulationLines, keep_every_double_bit_for_bit) {
  std::mt19937_64 random(5);
  const auto number = [&] {
    for (;;) {
      const std::uint64_t bits = random();
      double x = 0;
      std::memcpy(&x, &bits, sizeof x);
      if (std::isfinite(x)) return x;
    }
  };
  const auto point = [&] { return Vec3(number(), number(), number()); };
  for (int round = 0; round < 200; ++round) {
    app::SimulationCall call;
    call.input.blade = BladePose{{point(), point(), Vec3(-0.0, 0.0, 5e-324)}, point()};
    call.input.hooks = {{4294967295U, point(), number(), number()}};
    call.input.tools = {BallTool{point(), number()}, RodTool{point(), point(), number()}, PlaneTool{point(), number()},
                        FlatTool{{point(), point()}, point(), number()}};
    call.hash = random();
    const auto again = app::SimulationCodec::parse_call(to_line(call), "x", 2);
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(to_line(*again), to_line(call));
    const Vec3& a = again->input.blade->edge[0];
    EXPECT_EQ(std::memcmp(a.data(), call.input.blade->edge[0].data(), 24), 0);
    EXPECT_TRUE(std::signbit(again->input.blade->edge[2].x()));
    EXPECT_EQ(std::get<FlatTool>(again->input.tools[3]).thickness, std::get<FlatTool>(call.input.tools[3]).thickness);
  }
}

// --- the scenes that come with the program

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(INCISE_SCENES)) {
    const std::string name = entry.path().stem().string();
    if (name.rfind("sim_", 0) == 0) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, makes_its_first_cut) {
  Result<app::Scene> scene = app::read_scene(INCISE_SCENES "/" + GetParam() + ".json");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  if (!scene->model.file.empty() && !app::find_model(*scene).ok()) {
    GTEST_SKIP() << scene->model.file << " is not there; script/models all makes it";
  }
  const double end = scene->strokes.front().stroke.times.back();
  scene->frames = static_cast<std::uint64_t>(end / scene->options.frame_seconds);
  scene->settle.frames = std::min<std::uint32_t>(scene->settle.frames, 20);
  const app::SimulationReport report = run(*scene).report;
  EXPECT_TRUE(report.job.change.ok);
  EXPECT_TRUE(report.is_finite);
  EXPECT_GT(report.job.cut.cut_tets, 0U);
  EXPECT_GT(report.job.cut.incision_faces, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(shipped_scenes()),
                         [](const auto& scene) { return scene.param; });

/// The paper's Table 2 in a body that moves: eight pieces, merged and smoothed after each of three strokes.
TEST(ShippedSceneAsPaper, is_merged_and_smoothed_at_the_end_of_each_stroke) {
  Result<app::Scene> scene = app::read_scene(INCISE_SCENES "/sim_cube_complex.json");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  scene->options.engine.cut.profile = Profile::kPaper;
  const app::JobReport report = run(*scene).report.job;
  EXPECT_EQ(report.pieces.size(), 8U);
  EXPECT_LT(report.after.tets, 2418U) << "what Table 2 prints; without maintenance 3935";
  EXPECT_LT(report.quality_after.lr_mean, 15);
  EXPECT_NEAR(report.volume_after / report.volume_before, 1, 2e-3);
}

/// Where this blade touches down the body gives way, and pushes it aside: its first ways lead anywhere, and it was held
/// for all of its stroke as one that goes back.
TEST(ShippedSceneAsPaper, is_cut_where_the_blade_is_pushed_aside_as_it_touches_down) {
  Json json = Json::parse(read(INCISE_SCENES "/sim_cube_complex.json"));
  json["materials"]["default"]["young"] = 2500.0;
  Json stroke = Json::parse(read(INCISE_SCENES "/table2_cube_complex.json"))["strokes"][0];
  const double angle = -5.42 * 3.14159265358979323846 / 180, c = std::cos(angle), s = std::sin(angle);
  for (Json& edge : stroke["edges"]) {
    for (Json& point : edge["points"]) {
      const double y = point[1].get<double>() - 0.5, z = point[2].get<double>() - 0.5;
      point[1] = 0.5 + c * y - s * z;
      point[2] = 0.5 + s * y + c * z;
    }
  }
  json["strokes"][0]["blade"] = Json::array({stroke});
  app::Scene scene = parsed(json);
  scene.options.engine.cut.profile = Profile::kPaper;
  EXPECT_EQ(run(scene).report.job.pieces.size(), 2U);
}

/// In tissue this soft the strips of some frames pass a vertex on both sides: nine crumbs came off.
TEST(ShippedSceneAsPaper, leaves_no_crumbs_in_soft_tissue) {
  Json json = Json::parse(read(INCISE_SCENES "/sim_bone.json"));
  json["materials"]["default"]["young"] = 3439.2952132783316;
  json["strokes"][0]["stretch"] = 1.3990334751926918;
  json["strokes"][0]["blade"][0]["edges"] = Json::parse(R"([
      {"t": 0, "points": [[56.585158168510446, -7.398525399135383, 43.41941861764576],
                          [52.2667818981172, 40.34115792209906, 45.924266472417685]]},
      {"t": 1.6, "points": [[61.29199464611343, -4.049875118161597, -12.287602768072214],
                            [56.973618375720186, 43.68980820307284, -9.782754913300293]]}])");
  app::Scene scene = parsed(json);
  scene.options.engine.cut.profile = Profile::kPaper;
  const app::JobReport report = run(scene).report.job;
  EXPECT_EQ(report.pieces.size(), 2U);
  EXPECT_GT(report.cut.crumbs_kept, 0U);
}

}  // namespace

}  // namespace simulate_test
