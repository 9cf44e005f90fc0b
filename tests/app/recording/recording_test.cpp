// SPDX-License-Identifier: Apache-2.0
// Recordings as files: what is written reads back bit for bit, and what is no recording is refused by name and line.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>

#include "app/recording/engine_recording.h"
#include "support/folder.h"

namespace recording_test {
namespace {

using namespace incise;
using app::CallKind;
using app::RecordedCall;
using incise_test::Folder;
using incise_test::read;

using Limits = std::numeric_limits<double>;

/// Doubles at which writing or reading might slip, and some of random bits.
std::vector<double> hard_doubles() {
  std::vector<double> all = {0.0,
                             -0.0,
                             Limits::denorm_min(),
                             -Limits::denorm_min(),
                             Limits::min(),
                             Limits::max(),
                             -Limits::max(),
                             0.1,
                             1.0 / 3,
                             1e22,
                             5e-324,
                             9007199254740993.0,
                             123456789012345680.0,
                             2.2250738585072011e-308,
                             Limits::epsilon()};
  std::mt19937_64 random(7);
  while (all.size() < 3000) {
    const std::uint64_t bits = random();
    double x = 0;
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x)) all.push_back(x);
  }
  return all;
}

std::vector<Vec3> hard_points() {
  const std::vector<double> numbers = hard_doubles();
  std::vector<Vec3> points;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return points;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0);
}

RecordedCall there_and_back(const RecordedCall& call) {
  const std::string line = to_line(call);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const Result<RecordedCall> back = app::EngineCodec::parse_call(line, "r.jsonl", 5);
  EXPECT_TRUE(back.ok()) << back.error().message;
  return back.ok() ? *back : RecordedCall();
}

TEST(Recording, poses_and_strokes_read_back_bit_for_bit) {
  RecordedCall step;
  step.kind = CallKind::kStep;
  step.pose = {hard_points(), Vec3(-0.0, Limits::denorm_min(), -Limits::max())};
  step.hash = 0xFEDCBA9876543210ULL;
  const RecordedCall same_step = there_and_back(step);
  EXPECT_EQ(same_step.kind, CallKind::kStep);
  EXPECT_TRUE(same_bits(same_step.pose.edge, step.pose.edge));
  EXPECT_TRUE(same_bits({same_step.pose.direction}, {step.pose.direction}));
  EXPECT_EQ(same_step.hash, step.hash);
  EXPECT_EQ(same_step.line, 5U);
  EXPECT_FALSE(same_step.error.has_value());

  RecordedCall cut;
  cut.kind = CallKind::kCut;
  cut.stroke = {"quotes \" and \\ and \n", {-0.0, 5e-324, 1e300}, {hard_points(), hard_points(), hard_points()}};
  cut.error = ErrorCode::kInternal;
  const RecordedCall same_cut = there_and_back(cut);
  EXPECT_EQ(same_cut.stroke.name, cut.stroke.name);
  EXPECT_EQ(same_cut.stroke.times, cut.stroke.times);
  EXPECT_TRUE(std::signbit(same_cut.stroke.times[0]));
  ASSERT_EQ(same_cut.stroke.edges.size(), 3U);
  for (const auto& edge : same_cut.stroke.edges) EXPECT_TRUE(same_bits(edge, hard_points()));
  EXPECT_EQ(same_cut.error, ErrorCode::kInternal);
}

TEST(Recording, positions_keep_every_bit_pattern) {
  RecordedCall call;
  call.kind = CallKind::kPositions;
  for (std::size_t size : {0U, 1U, 2U, 3U, 1000U}) {
    call.positions = hard_points();
    call.positions.resize(size, Vec3(Limits::quiet_NaN(), -Limits::infinity(), -0.0));  // as dead slots may hold
    EXPECT_TRUE(same_bits(there_and_back(call).positions, call.positions)) << size;
  }
}

TEST(Recording, work_is_kept_to_the_unit) {
  RecordedCall call;
  call.kind = CallKind::kMaintain;
  for (const std::uint64_t units :
       {std::uint64_t{0}, (std::uint64_t{1} << 53U) + 1, kUnlimitedWork - 1, kUnlimitedWork}) {
    call.limit = call.work_units = units;
    EXPECT_FALSE(there_and_back(call).stop_ask.has_value());
    call.stop_ask = units;
    const RecordedCall back = there_and_back(call);
    EXPECT_EQ(back.limit, units);
    EXPECT_EQ(back.stop_ask, units);
    EXPECT_EQ(back.work_units, units);
    call.stop_ask.reset();
  }
}

TEST(Recording, header_reads_back) {
  app::RecordingHeader header;
  header.mesh_file = "../a \"mesh\".msh";
  header.mesh_hash = 1;
  header.cut = {Profile::kPaper, 0.1};
  header.maintain = {false, true, 77};
  header.seed = ~std::uint64_t{0};
  const Result<app::RecordingHeader> back = app::EngineCodec::parse_header(to_line(header), "r.jsonl");
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->program.substr(0, 7), "incise ");
  EXPECT_EQ(back->mesh_file, header.mesh_file);
  EXPECT_EQ(back->mesh_hash, 1U);
  EXPECT_EQ(back->cut.profile, Profile::kPaper);
  EXPECT_EQ(back->cut.snap, 0.1);
  EXPECT_FALSE(back->maintain.merge);
  EXPECT_TRUE(back->maintain.improve);
  EXPECT_EQ(back->maintain.work_units, 77U);
  EXPECT_TRUE(back->maintain.smooth_boundary);
  EXPECT_EQ(back->seed, header.seed);
}

TEST(Recording, header_says_where_the_boundary_is_not_smoothed) {
  app::RecordingHeader header;
  EXPECT_EQ(to_line(header).find("smooth_boundary"), std::string::npos);
  header.maintain.smooth_boundary = false;
  const Result<app::RecordingHeader> back = app::EngineCodec::parse_header(to_line(header), "r.jsonl");
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_FALSE(back->maintain.smooth_boundary);
}

std::string header_error(const std::string& line) {
  const auto header = app::EngineCodec::parse_header(line, "r.jsonl");
  return header.ok() ? "" : header.error().message;
}

std::string call_error(const std::string& line) {
  const auto call = app::EngineCodec::parse_call(line, "r.jsonl", 7);
  return call.ok() ? "" : call.error().message;
}

TEST(Recording, refuses_headers_of_other_formats_versions_and_keys) {
  const std::string mesh = R"("mesh":{"file":"a.mesh","hash":"0000000000000001"},)";
  const std::string options = R"("options":{"profile":"incise","snap":0.2,"merge":true,"improve":true,"work_units":0,)";
  const std::string start = R"({"format":"incise-recording","version":1,"program":"p",)";
  EXPECT_EQ(header_error(start + mesh + options + R"("seed":0}})"), "");
  EXPECT_EQ(header_error(R"({"format":"incise-recording","version":2,"news":1})"),
            "r.jsonl:1: version is 2; this program reads version 1");
  EXPECT_EQ(header_error(R"({"format":"incise-blade","version":1})"), "r.jsonl:1: format must be \"incise-recording\"");
  EXPECT_NE(header_error(start + mesh + options + R"("seed":0,"speed":1}})").find("unknown key \"speed\""),
            std::string::npos);
  EXPECT_NE(header_error(start + mesh + options + R"("seed":-1}})").find("seed must be a whole number"),
            std::string::npos);
  EXPECT_NE(header_error(start + options + R"("seed":0}})").find("the header lacks the key \"mesh\""),
            std::string::npos);
  EXPECT_NE(header_error("[]").find("must be an object"), std::string::npos);
}

TEST(Recording, refuses_calls_by_line_and_key) {
  const std::string hash = R"("hash":"0123456789abcdef"})";
  EXPECT_EQ(call_error(R"({"call":"undo",)" + hash), "");
  for (const auto& [line, part] : std::vector<std::pair<std::string, std::string>>{
           {R"({"call":"undo","depth":2,)" + hash, "the call has the unknown key \"depth\""},
           {R"({"call":"carve",)" + hash, "the call \"carve\" is unknown; known are: begin, step,"},
           {R"({"call":"undo","hash":"0123"})", "hash must be 16 hexadecimal digits"},
           {R"({"call":"undo","hash":"0123456789ABCDEF"})", "hash must be 16 hexadecimal digits"},
           {R"({"call":"undo"})", "the call lacks the key \"hash\""},
           {R"({"call":"undo","error":"bad luck",)" + hash, "error \"bad luck\" is unknown"},
           {R"({"call":"step","edge":[[0,0,0]],"direction":[0,0,0],)" + hash, "edge has 1 entries"},
           {R"({"call":"step","edge":[[0,0,0],[0,null,0]],"direction":[0,0,0],)" + hash, "edge[1][1] must be a finite"},
           {R"({"call":"cut","name":"","times":[0,1],"edges":[[[0,0,0],[1,0,0]]],)" + hash, "edges has 1 entries"},
           {R"({"call":"maintain","limit":-1,"work_units":0,)" + hash, "limit must be a whole number"},
           {R"({"call":"maintain","limit":1.5,"work_units":0,)" + hash, "limit must be a whole number"},
           {R"({"call":"positions","base64":"AAAA",)" + hash, "base64 does not hold 24 bytes"},
           {R"({"call":"positions","base64":"A!AAAAAAAAAAAAAAAAAAAAAAAAAAAAAA",)" + hash, "base64 does not hold"},
           {R"({"call":"positions","base64":"AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA",)" + hash, "base64 does not hold"},
           {"", "the line is empty"},
           {"[1]", "must be an object"}}) {
    const std::string error = call_error(line);
    EXPECT_EQ(error.substr(0, 11), "r.jsonl:7: ") << line << error;
    EXPECT_NE(error.find(part), std::string::npos) << line << error;
  }
}

RecordedCall undo_call(std::uint64_t hash) {
  RecordedCall call;
  call.hash = hash;
  return call;
}

TEST(RecordingWriter, puts_each_line_into_the_file_at_once) {
  const Folder folder;
  app::RecordingWriter writer(folder / "r.jsonl", {});
  for (std::uint64_t i = 1; i < 4; ++i) {
    ASSERT_TRUE(writer.write(undo_call(i)).ok());
    Result<app::RecordingReader> reader = app::RecordingReader::open(folder / "r.jsonl");
    ASSERT_TRUE(reader.ok()) << reader.error().message;
    for (std::uint64_t k = 1; k <= i; ++k) {
      const auto call = reader->next();
      ASSERT_TRUE(call.ok() && call->has_value());
      EXPECT_EQ((*call)->hash, k);
      EXPECT_EQ((*call)->line, k + 1);
    }
    EXPECT_FALSE(reader->next()->has_value());
    EXPECT_FALSE(reader->is_cut_off());
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"r.jsonl"});
}

TEST(RecordingWriter, leaves_what_was_there_until_the_first_call) {
  const Folder folder;
  const std::string file = folder.write("r.jsonl", "what was there");
  { const app::RecordingWriter unused(file, {}); }
  app::RecordingWriter writer(file, {});
  EXPECT_EQ(read(file), "what was there");
  ASSERT_TRUE(writer.write(undo_call(1)).ok());
  EXPECT_EQ(read(file).substr(0, 28), R"({"format":"incise-recording")");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"r.jsonl"});
}

TEST(RecordingWriter, names_a_file_that_cannot_be_written_and_stays_so) {
  const Folder folder;
  for (const std::string& file : {folder / "none/r.jsonl", folder / "", std::string("/dev/full")}) {
    app::RecordingWriter writer(file, {});
    for (int i = 0; i < 2; ++i) {
      const Status status = writer.write(undo_call(1));
      ASSERT_FALSE(status.ok()) << file;
      EXPECT_EQ(status.error().code, ErrorCode::kIo);
      EXPECT_EQ(status.error().message.substr(0, file.size() + 2), file + ": ");
    }
  }
  EXPECT_TRUE(folder.names().empty());
}

/// Lets files grow to `bytes` at most while it lives, as on a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit less = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &less);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_DFL);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
};

TEST(RecordingWriter, leaves_what_it_could_write_on_a_full_disk) {
  const Folder folder;
  app::RecordingWriter writer(folder / "r.jsonl", {});
  int written = 0;
  {
    const FullDisk disk(1000);
    while (writer.write(undo_call(1)).ok()) ++written;
    EXPECT_EQ(writer.write(undo_call(1)).error().code, ErrorCode::kIo);
  }
  EXPECT_FALSE(writer.write(undo_call(1)).ok());  // a line is missing: what followed would replay wrongly
  EXPECT_EQ(read(folder / "r.jsonl").size(), 1000U);
  Result<app::RecordingReader> reader = app::RecordingReader::open(folder / "r.jsonl");
  ASSERT_TRUE(reader.ok());
  for (int i = 0; i < written; ++i) EXPECT_TRUE(reader->next()->has_value());
  EXPECT_FALSE(reader->next()->has_value());
  EXPECT_TRUE(reader->is_cut_off());
}

TEST(RecordingReader, names_what_it_cannot_open) {
  const Folder folder;
  const auto error_of = [&](const std::string& file) {
    const auto reader = app::RecordingReader::open(file);
    return reader.ok() ? "" : reader.error().message;
  };
  EXPECT_NE(error_of(folder / "r.jsonl").find("r.jsonl: no such file"), std::string::npos);
  EXPECT_NE(error_of(folder / "").find("is a folder"), std::string::npos);
  EXPECT_NE(error_of(folder.write("e.jsonl", "")).find("e.jsonl:1: the file is empty"), std::string::npos);
}

/// Reads to the end or the first error.
struct ReadOut {
  std::string error;
  std::size_t calls = 0;
  bool is_cut_off = false;
};

ReadOut read_out(const std::string& text) {
  Result<app::RecordingReader> reader = app::RecordingReader::open(std::make_unique<std::istringstream>(text), "r");
  if (!reader.ok()) return {reader.error().message};
  ReadOut out;
  for (;; ++out.calls) {
    const auto call = reader->next();
    if (!call.ok()) return {call.error().message, out.calls};
    if (!call->has_value()) break;
  }
  out.is_cut_off = reader->is_cut_off();
  return out;
}

TEST(RecordingReader, takes_a_text_cut_off_anywhere_up_to_its_last_whole_line) {
  RecordedCall positions;
  positions.kind = CallKind::kPositions;
  positions.positions = {Vec3(1, 2, 3)};
  const std::string text = app::to_line(app::RecordingHeader()) + to_line(undo_call(1)) + to_line(positions);
  const std::size_t header_end = text.find('\n');
  const std::size_t undo_end = text.find('\n', header_end + 1);
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const ReadOut out = read_out(text.substr(0, size));
    if (size < header_end) {
      EXPECT_NE(out.error.find(size == 0 ? "empty" : "r:1: the header is cut off"), std::string::npos) << out.error;
      continue;
    }
    bool is_whole = false;
    std::size_t calls = 0;
    for (const std::size_t end : {header_end, undo_end, text.size() - 1}) {
      is_whole = is_whole || size == end || size == end + 1;  // a line may lack its very end
      calls += end > header_end && size >= end ? 1U : 0U;
    }
    EXPECT_EQ(out.error, "") << size;
    EXPECT_EQ(out.calls, calls) << size;
    EXPECT_EQ(out.is_cut_off, !is_whole) << size;
  }
}

TEST(RecordingReader, forgives_only_the_last_line) {
  const std::string head = app::to_line(app::RecordingHeader());
  const std::string call = to_line(undo_call(1));
  EXPECT_NE(read_out(head + call.substr(0, 20) + "\n" + call).error.find("r:2: "), std::string::npos);
  EXPECT_NE(read_out(head + call + "\n" + call).error.find("r:3: the line is empty"), std::string::npos);
  EXPECT_NE(read_out(head + call + "{\"call\":\"jump\"}").error.find("r:3: "), std::string::npos);
}

}  // namespace

}  // namespace recording_test
