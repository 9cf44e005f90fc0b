// SPDX-License-Identifier: Apache-2.0
// The recorded corpus: what was recorded from C++ comes out of C with the same hash after every call.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/recording/engine_recording.h"
#include "handle.h"

namespace same_hash_test {
namespace {

namespace fs = std::filesystem;
using namespace incise;
using incise_test::EngineHandle;
using incise_test::hash;
using incise_test::sized;

incise_engine_options options_of(const app::RecordingHeader& header) {
  auto options = sized<incise_engine_options>();
  EXPECT_EQ(incise_default_engine_options(&options, sizeof options), INCISE_OK);
  options.profile = header.cut.profile == Profile::kPaper ? INCISE_PROFILE_PAPER : INCISE_PROFILE_INCISE;
  options.snap = header.cut.snap;
  options.merge = header.maintain.merge ? 1 : 0;
  options.improve = header.maintain.improve ? 1 : 0;
  options.work_units = header.maintain.work_units;
  return options;
}

std::vector<double> numbers_of(const std::vector<Vec3>& points) {
  std::vector<double> numbers;
  for (const Vec3& p : points) numbers.insert(numbers.end(), p.data(), p.data() + 3);
  return numbers;
}

incise_status cut(incise_engine* engine, const Stroke& from) {
  std::vector<double> points;
  for (const auto& edge : from.edges) {
    const std::vector<double> row = numbers_of(edge);
    points.insert(points.end(), row.begin(), row.end());
  }
  auto stroke = sized<incise_stroke>();
  stroke.times = from.times.data();
  stroke.n_times = from.times.size();
  stroke.points = points.data();
  stroke.n_points = from.edges[0].size();
  stroke.name = from.name.c_str();
  return incise_engine_cut(engine, &stroke, nullptr);
}

/// Says stop when it is asked for the n-th time.
struct Stop {
  std::uint64_t at = 0, asked = 0;
  static std::int32_t ask(void* user) {
    auto* stop = static_cast<Stop*>(user);
    return ++stop->asked >= stop->at ? 1 : 0;
  }
};

incise_status maintain(incise_engine* engine, const app::RecordedCall& call) {
  Stop stop{call.stop_ask.value_or(0)};
  return incise_engine_maintain(engine, call.limit, call.stop_ask ? Stop::ask : nullptr, &stop, nullptr);
}

incise_status play(incise_engine* engine, const app::RecordedCall& call) {
  const std::vector<double> edge = numbers_of(call.pose.edge), positions = numbers_of(call.positions);
  const double* direction = call.pose.direction.data();
  switch (call.kind) {
    case app::CallKind::kBegin:
      return incise_engine_begin_stroke(engine, edge.data(), edge.size() / 3, direction, nullptr);
    case app::CallKind::kStep:
      return incise_engine_step(engine, edge.data(), edge.size() / 3, direction, nullptr);
    case app::CallKind::kEnd:
      return incise_engine_end_stroke(engine, nullptr);
    case app::CallKind::kCut:
      return cut(engine, call.stroke);
    case app::CallKind::kUndo:
      return incise_engine_undo(engine, nullptr);
    case app::CallKind::kRedo:
      return incise_engine_redo(engine, nullptr);
    case app::CallKind::kMaintain:
      return maintain(engine, call);
    case app::CallKind::kImprove:
      return incise_engine_improve(engine, nullptr, nullptr, nullptr);
    case app::CallKind::kPositions:
      return incise_engine_set_positions(engine, positions.data(), positions.size() / 3);
  }
  return INCISE_INTERNAL;
}

void expect_same_hashes(const fs::path& path) {
  Result<app::RecordingReader> reader = app::RecordingReader::open(path);
  ASSERT_TRUE(reader.ok()) << reader.error().message;
  const incise_engine_options options = options_of(reader->header());
  incise_engine* made = nullptr;
  const std::string mesh = (path.parent_path() / reader->header().mesh_file).string();
  ASSERT_EQ(incise_engine_read(mesh.c_str(), &options, &made), INCISE_OK) << incise_last_error();
  const EngineHandle engine(made);
  EXPECT_EQ(hash(engine.get()), reader->header().mesh_hash);
  std::size_t calls = 0;
  for (auto call = reader->next(); call.ok() && *call; call = reader->next(), ++calls) {
    const incise_status status = play(engine.get(), **call);
    EXPECT_EQ(status, (*call)->error ? static_cast<int>(*(*call)->error) + 1 : INCISE_OK) << incise_last_error();
    EXPECT_EQ(hash(engine.get()), (*call)->hash) << path << ", line " << (*call)->line;
  }
  EXPECT_GE(calls, 20U);
}

TEST(CHash, of_the_recorded_corpus_is_that_of_cpp) {
  std::size_t recordings = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(INCISE_SOURCE_DIR) / "tests/recordings")) {
    if (entry.path().extension() != ".jsonl") continue;
    expect_same_hashes(entry.path());
    ++recordings;
  }
  EXPECT_GE(recordings, 2U);
}

}  // namespace

}  // namespace same_hash_test
