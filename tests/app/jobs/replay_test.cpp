// SPDX-License-Identifier: Apache-2.0
// Sessions are recorded with one engine and replayed with another: the same hashes, call for call.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "app/jobs/cut_job.h"
#include "app/jobs/replay_job.h"
#include "app/recording/recorded_engine.h"
#include "app/text/text_file.h"
#include "incise/mesh/bounds.h"
#include "support/folder.h"

namespace replay_test {
namespace {

namespace fs = std::filesystem;
using namespace incise;
using incise_test::Folder;
using incise_test::read;

const Box kUnitBox{Vec3(0, 0, 0), Vec3(1, 1, 1)};

app::RecordedEngine record_on(const std::string& mesh_file, const std::string& recording, EngineOptions options = {}) {
  io::LoadedMesh loaded = io::load_mesh(mesh_file).value();
  return app::RecordedEngine::create(std::move(loaded.mesh), std::move(options), {recording, mesh_file, 7}).value();
}

BladePose pose_at(double x) {
  return {{Vec3(x, 0.43 + 0.1 * x, -0.5), Vec3(x + 0.02, 0.41, 0.5), Vec3(x, 0.44, 1.5)}, Vec3(1, 0, 0)};
}

void make_stroke(app::RecordedEngine& engine, int steps) {
  ASSERT_TRUE(engine.begin_stroke(pose_at(-0.3)).ok());
  for (int i = 1; i <= steps; ++i) ASSERT_TRUE(engine.step(pose_at(-0.3 + 1.7 * i / steps)).ok());
  ASSERT_TRUE(engine.end_stroke().ok());
}

/// Where every vertex slot stands when the body is stretched by a third.
std::vector<Vec3> stretched(const TetMesh& mesh) {
  std::vector<Vec3> positions(mesh.vertex_slots(), Vec3::Zero());
  mesh.for_each_vertex([&](VertexId v) { positions[v.value] = mesh.rest(v) * (4.0 / 3.0); });
  return positions;
}

/// Every kind of call, with maintenance that is bounded by units, by a question and not at all.
void play_everything(app::RecordedEngine& engine) {
  make_stroke(engine, 6);
  ASSERT_TRUE(engine.maintain(500).ok());
  int questions = 0;
  ASSERT_TRUE(engine.maintain(kUnlimitedWork, [&] { return ++questions > 9; }).ok());
  EXPECT_TRUE(*engine.undo());
  EXPECT_TRUE(*engine.redo());
  ASSERT_TRUE(engine.maintain().ok());
  ASSERT_TRUE(engine.cut(*plane_stroke(kUnitBox, Vec3(0.2, 0.1, 1), 0.57)).ok());
  ASSERT_TRUE(engine.maintain().ok());
  ASSERT_TRUE(engine.set_positions(stretched(engine.mesh())).ok());
  ASSERT_TRUE(engine.improve().ok());
  ASSERT_TRUE(engine.cut(*plane_stroke(kUnitBox, Vec3(1, 0.1, 0.2), 0.61)).ok());
  EXPECT_TRUE(*engine.undo());
  ASSERT_TRUE(engine.maintain(0).ok());
}

class Replay : public testing::Test {
 protected:
  /// Records what `play` does on a cube of 6·n³ rough tets.
  template <class Play>
  app::RecordedEngine record(unsigned n, const Play& play, EngineOptions options = {}) {
    app::RecordedEngine engine = record_on(folder_.write("cube.mesh", incise_test::cube_mesh(n, 0.1)), log_, options);
    play(engine);
    return engine;
  }
  app::ReplayResult replay(bool verify = true) {
    const app::ReplayJob job{log_, verify, true};
    Result<app::ReplayResult> result = app::run_replay(job);
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result.ok() ? std::move(result).value() : app::ReplayResult();
  }
  std::string error_of_replay() {
    const auto result = app::run_replay({log_});
    return result.ok() ? "" : result.error().message;
  }
  /// Writes the log anew with one line changed.
  void change_line(std::size_t number, const std::string& from, const std::string& to) {
    std::istringstream lines(read(log_));
    std::string text;
    std::string line;
    for (std::size_t i = 1; std::getline(lines, line); ++i) {
      if (i == number) line.replace(line.find(from), from.size(), to);
      text += line + "\n";
    }
    ASSERT_TRUE(app::write_text_file(log_, text).ok());
  }

  Folder folder_;
  std::string log_ = folder_ / "log.jsonl";
};

TEST_F(Replay, does_every_kind_of_call_again) {
  for (const Profile profile : {Profile::kIncise, Profile::kPaper}) {
    for (const std::uint64_t units : {std::uint64_t{0}, std::uint64_t{300}, kUnlimitedWork}) {
      EngineOptions options;
      options.cut = {profile, 0.1};
      options.maintain.work_units = units;
      const app::RecordedEngine engine = record(3, play_everything, options);
      const app::ReplayResult result = replay();
      EXPECT_FALSE(result.difference.has_value())
          << result.difference->line << result.difference->expected << result.difference->found;
      EXPECT_EQ(result.hash, engine.mesh().hash());
      EXPECT_EQ(result.calls, 20U);
      EXPECT_EQ(result.strokes, 2U);
      EXPECT_FALSE(result.is_cut_off || result.is_in_stroke);
      EXPECT_EQ(result.after.tets, engine.mesh().tet_count());
      EXPECT_EQ(result.mesh.soup.tets.size(), engine.mesh().tet_count());
    }
  }
}

TEST_F(Replay, restores_where_a_deforming_body_stood) {
  const app::RecordedEngine engine =
      record(2, [](app::RecordedEngine& e) { ASSERT_TRUE(e.set_positions(stretched(e.mesh())).ok()); });
  Engine again = Engine::create(io::load_mesh(folder_ / "cube.mesh")->mesh).value();
  Result<app::RecordingReader> reader = app::RecordingReader::open(log_);
  ASSERT_TRUE(reader.ok());
  const auto call = reader->next();
  ASSERT_TRUE(call.ok() && call->has_value());
  ASSERT_TRUE(app::replay_call(again, **call, true, log_).ok());
  engine.mesh().for_each_vertex([&](VertexId v) { EXPECT_EQ(again.mesh().current(v), engine.mesh().current(v)); });
  EXPECT_NE(again.mesh().current(VertexId(3)), again.mesh().rest(VertexId(3)));
}

TEST_F(Replay, of_a_log_cut_off_at_any_byte_ends_with_its_last_whole_step) {
  record(1, [](app::RecordedEngine& engine) {
    make_stroke(engine, 3);
    ASSERT_TRUE(engine.maintain(40).ok());
  });
  const std::string whole = read(log_);
  const std::size_t header_size = whole.find('\n');
  for (std::size_t size = 1; size < whole.size(); ++size) {
    ASSERT_TRUE(app::write_text_file(log_, whole.substr(0, size)).ok());
    const Result<app::ReplayResult> result = app::run_replay({log_, true});
    ASSERT_EQ(result.ok(), size >= header_size) << size;
    if (!result.ok()) {
      EXPECT_NE(result.error().message.find("header is cut off"), std::string::npos);
      continue;
    }
    const std::string part = whole.substr(0, size + 1);  // a line that lacks only its line end is whole
    EXPECT_EQ(result->calls + 1, static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n'))) << size;
    EXPECT_FALSE(result->difference.has_value()) << size;
  }
}

TEST_F(Replay, finds_the_first_hash_that_differs) {
  record(2, [](app::RecordedEngine& engine) { make_stroke(engine, 3); });
  const std::string hash = read(log_).substr(read(log_).rfind("\"hash\":\"") + 8, 16);
  const std::string other = std::string(15, '0') + "1";
  change_line(4, "\"hash\":\"", "\"hash\":\"" + other + "\",\"x\":\"");  // first of all a key that nobody knows
  EXPECT_NE(error_of_replay().find("log.jsonl:4: the call has the unknown key \"x\""), std::string::npos);
  record(2, [](app::RecordedEngine& engine) { make_stroke(engine, 3); });
  std::istringstream lines(read(log_));
  std::string line;
  for (int i = 0; i < 4; ++i) std::getline(lines, line);
  const std::string fourth = line.substr(line.rfind('"') - 16, 16);
  change_line(4, fourth, other);
  const app::ReplayResult verified = replay();
  ASSERT_TRUE(verified.difference.has_value());
  EXPECT_EQ(verified.difference->line, 4U);
  EXPECT_EQ(verified.difference->call, "step");
  EXPECT_EQ(verified.difference->expected, "hash " + other);
  EXPECT_EQ(verified.difference->found, "hash " + fourth);
  EXPECT_TRUE(verified.mesh.soup.tets.empty());
  EXPECT_FALSE(replay(false).difference.has_value());  // only the end is compared
  change_line(6, hash, other);
  EXPECT_EQ(replay(false).difference->line, 6U);
}

TEST_F(Replay, finds_work_and_ends_that_differ) {
  record(3, play_everything);
  const std::string whole = read(log_);
  change_line(10, "\"work_units\":", "\"work_units\":9");
  EXPECT_NE(replay().difference->expected.find("work units"), std::string::npos);
  ASSERT_TRUE(app::write_text_file(log_, whole).ok());
  change_line(9, "\"hash\":", "\"error\":\"internal\",\"hash\":");
  const app::ReplayResult result = replay(false);
  EXPECT_EQ(result.difference->line, 9U);
  EXPECT_EQ(result.difference->expected, "error internal");
  EXPECT_EQ(result.difference->found, "success");
}

TEST_F(Replay, refuses_what_cannot_be_replayed) {
  record(2, [](app::RecordedEngine& engine) { make_stroke(engine, 2); });
  const std::string whole = read(log_);
  change_line(2, "\"begin\"", "\"step\"");
  EXPECT_NE(error_of_replay().find("log.jsonl:2: the call \"step\" cannot be made: no stroke is under way"),
            std::string::npos)
      << error_of_replay();
  ASSERT_TRUE(app::write_text_file(log_, whole).ok());
  change_line(1, "\"snap\":0.2", "\"snap\":0.9");
  EXPECT_NE(error_of_replay().find("log.jsonl:1: the snapping distance"), std::string::npos) << error_of_replay();
  ASSERT_TRUE(app::write_text_file(log_, whole).ok());
  change_line(5, "{\"call\":\"end\"", "{\"call\":\"redo\"");
  EXPECT_NE(error_of_replay().find("log.jsonl:5: the call \"redo\" cannot be made"), std::string::npos);
}

TEST_F(Replay, refuses_another_mesh_and_one_that_is_not_there) {
  record(2, [](app::RecordedEngine& engine) { make_stroke(engine, 2); });
  const std::string mesh = folder_.write("cube.mesh", incise_test::cube_mesh(2));
  EXPECT_NE(error_of_replay().find("cube.mesh: is not the mesh of the recording"), std::string::npos);
  fs::remove(mesh);
  EXPECT_NE(error_of_replay().find("log.jsonl:1: the mesh \"cube.mesh\" is not there"), std::string::npos);
  change_line(1, "\"file\":\"cube.mesh\"", "\"file\":\"\"");
  EXPECT_NE(error_of_replay().find("on a mesh of no file"), std::string::npos);
}

TEST_F(Replay, finds_the_mesh_from_the_recordings_folder_and_as_given) {
  record(2, [](app::RecordedEngine& engine) { make_stroke(engine, 2); });
  const std::string mesh = folder_ / "cube.mesh";
  const Folder other;
  fs::copy(log_, other / "log.jsonl");
  fs::copy(mesh, other / "cube.mesh");
  log_ = other / "log.jsonl";
  EXPECT_EQ(replay().source.file, other / "cube.mesh");
  fs::remove(other / "cube.mesh");
  change_line(1, "\"file\":\"cube.mesh\"", "\"file\":\"" + mesh + "\"");
  EXPECT_EQ(replay().source.file, mesh);
}

TEST_F(Replay, of_nothing_that_was_refused_is_needed) {
  record(2, [](app::RecordedEngine& engine) {
    EXPECT_FALSE(engine.step(pose_at(0)).ok());
    EXPECT_FALSE(engine.end_stroke().ok());
    EXPECT_FALSE(engine.begin_stroke({{Vec3(0, 0, 0)}}).ok());
    EXPECT_FALSE(engine.cut({}).ok());
    EXPECT_FALSE(engine.set_positions({}).ok());
    EXPECT_FALSE(*engine.undo());
    EXPECT_FALSE(*engine.redo());
  });
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"cube.mesh"});
}

TEST_F(Replay, a_recording_that_fails_says_so_after_the_call) {
  app::RecordedEngine engine =
      record_on(folder_.write("cube.mesh", incise_test::cube_mesh(2)), folder_ / "none/log.jsonl");
  const auto cut = engine.cut(*plane_stroke(kUnitBox, Vec3(1, 0, 0), 0.4));
  ASSERT_FALSE(cut.ok());
  EXPECT_EQ(cut.error().code, ErrorCode::kIo);
  EXPECT_NE(cut.error().message.find("none/log.jsonl: cannot be written"), std::string::npos);
  EXPECT_EQ(engine.engine().stroke_count(), 1U);
}

TEST_F(Replay, of_a_cut_job_with_a_clock_gives_its_mesh) {
  const std::string mesh = folder_.write("cube.mesh", incise_test::cube_mesh(6, 0.15));
  for (const bool by_steps : {false, true}) {
    app::CutJob job;
    job.by_steps = by_steps;
    job.budget_us = 2000;
    job.record = log_;
    job.strokes = {*plane_stroke(kUnitBox, Vec3(1, 0.1, 0.2), 0.63), *plane_stroke(kUnitBox, Vec3(0.2, 1, 0), 0.48)};
    const app::JobResult cut = app::run_cut(io::load_mesh(mesh).value(), job, true).value();
    const app::ReplayResult result = replay();
    EXPECT_FALSE(result.difference.has_value());
    EXPECT_EQ(result.hash, cut.report.hash);
    EXPECT_EQ(result.mesh.soup.points, cut.mesh.soup.points);
    EXPECT_EQ(result.mesh.soup.tets, cut.mesh.soup.tets);
    EXPECT_EQ(result.mesh.piece, cut.mesh.piece);
  }
}

TEST_F(Replay, leaves_the_figures_of_a_cut_job_alone) {
  const std::string mesh = folder_.write("cube.mesh", incise_test::cube_mesh(4));
  app::CutJob job;
  job.by_steps = true;
  Stroke stroke;
  for (int i = 0; i <= 8; ++i) {
    stroke.times.push_back(i);
    stroke.edges.push_back(pose_at(-0.3 + 0.2 * i).edge);
  }
  job.strokes = {stroke, stroke};
  job.strokes[1].edges.resize(2);  // before it meets the body
  job.strokes[1].times.resize(2);
  const app::JobReport report = app::run_cut(io::load_mesh(mesh).value(), job, false)->report;
  EXPECT_EQ(report.step_ms.size(), 9U);
  EXPECT_EQ(report.stage_ms.size(), 9U);
  EXPECT_EQ(report.units_per_stroke.size(), 2U);
  EXPECT_EQ(report.cut.steps, 9U);
  EXPECT_EQ(report.after.components, 2U);
  double sum = 0;
  double stages = 0;
  for (const double ms : report.step_ms) sum += ms;
  for (const StageTimes& times : report.stage_ms) stages += times.total();
  EXPECT_NEAR(sum, report.total_ms, 1e-9);
  EXPECT_NEAR(stages, report.times.total(), 1e-9);
  EXPECT_LE(stages, sum);
  job.engine.cut.profile = Profile::kPaper;
  EXPECT_EQ(app::run_cut(io::load_mesh(mesh).value(), job, false)->report.step_ms.size(), 9U);
}

// The recordings in tests/recordings replay on every build. After a change that means to change results, and after
// nothing else, make them anew: INCISE_WRITE_RECORDINGS=1 app_test --gtest_filter=Recordings.*
void write_recordings(const fs::path& folder) {
  fs::create_directories(folder);
  const std::string mesh = (folder / "cube.mesh").string();
  ASSERT_TRUE(app::write_text_file(mesh, incise_test::cube_mesh(3, 0.1)).ok());
  app::RecordedEngine everything = record_on(mesh, (folder / "everything.jsonl").string());
  play_everything(everything);
  EngineOptions paper;
  paper.cut.profile = Profile::kPaper;
  app::RecordedEngine as_paper = record_on(mesh, (folder / "as_paper.jsonl").string(), paper);
  play_everything(as_paper);
}

/// Every recording of the folder, sorted.
std::vector<fs::path> recordings_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    if (entry.path().extension() == ".jsonl") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Recordings, replay_as_they_were_made) {
  if (std::getenv("INCISE_WRITE_RECORDINGS") != nullptr) write_recordings(INCISE_RECORDINGS);
  const std::vector<fs::path> recordings = recordings_in(INCISE_RECORDINGS);
  if (recordings.empty()) GTEST_SKIP() << "no recordings in " << INCISE_RECORDINGS;
  for (const fs::path& recording : recordings) {
    for (const unsigned threads : {1U, 2U}) {
      const Result<app::ReplayResult> result = app::run_replay({recording, true, false, {}, threads});
      ASSERT_TRUE(result.ok()) << result.error().message;
      EXPECT_FALSE(result->difference.has_value())
          << recording << ":" << result->difference->line << " " << result->difference->found;
    }
  }
}

}  // namespace

}  // namespace replay_test
