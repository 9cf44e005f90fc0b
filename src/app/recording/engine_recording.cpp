// SPDX-License-Identifier: Apache-2.0
// One line of JSON for each call: an encoder for each kind, and a reader that refuses what it does not know. Poses are
// the bytes of their doubles in base64, and so read back bit for bit.
#include "app/recording/engine_recording.h"

#include <array>
#include <cstring>
#include <utility>

#include "app/text/json_write.h"
#include "app/text/line_reader.h"
#include "incise/io/base64.h"
#include "incise/version.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::uint32_t kRecordingVersion = 1;
constexpr std::size_t kMaxPoints = std::size_t{1} << 20U;  // of a pose, and times of a stroke
constexpr std::size_t kBytesPerPoint = 24;

constexpr std::array<const char*, 9> kCallNames = {"begin", "step",     "end",     "cut",      "undo",
                                                   "redo",  "maintain", "improve", "positions"};
constexpr std::array<const char*, 2> kProfileNames = {"paper", "incise"};

// ---- writing ----

Json encode_limit(std::uint64_t work_units) {
  return work_units == kUnlimitedWork ? Json() : Json(work_units);
}

/// Doubles as little-endian bytes in base64: exact for every bit pattern, whatever the machine.
std::string encode_bits(const std::vector<Vec3>& points) {
  std::string bytes;
  bytes.reserve(points.size() * kBytesPerPoint);
  for (const Vec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &point[axis], sizeof bits);
      for (unsigned shift = 0; shift < 64; shift += 8) bytes += static_cast<char>((bits >> shift) & 255U);
    }
  }
  std::string text;
  io::append_base64(text, bytes);
  return text;
}

void add_pose(const BladePose& pose, Json& root) {
  root["edge"] = encode(pose.edge);
  root["direction"] = encode(pose.direction);
}

void add_stroke(const Stroke& stroke, Json& root) {
  root["name"] = stroke.name;
  root["times"] = stroke.times;
  root["edges"] = Json::array();
  for (const std::vector<Vec3>& edge : stroke.edges) root["edges"].push_back(encode(edge));
}

void add_maintenance(const RecordedCall& call, Json& root) {
  root["limit"] = encode_limit(call.limit);
  if (call.stop_ask) root["stop_ask"] = *call.stop_ask;
  root["work_units"] = call.work_units;
}

void add_arguments(const RecordedCall& call, Json& root) {
  switch (call.kind) {
    case CallKind::kBegin:
    case CallKind::kStep:
      return add_pose(call.pose, root);
    case CallKind::kCut:
      return add_stroke(call.stroke, root);
    case CallKind::kMaintain:
      return add_maintenance(call, root);
    case CallKind::kImprove:
      root["work_units"] = call.work_units;
      return;
    case CallKind::kPositions:
      root["base64"] = encode_bits(call.positions);
      return;
    case CallKind::kEnd:
    case CallKind::kUndo:
    case CallKind::kRedo:
      return;
  }
}

// ---- reading ----

class HeaderReader : public LineReader {
 public:
  using LineReader::LineReader;

  bool run(const JsonValue& root, RecordingHeader& header) {
    const std::string path = "the header";
    if (!read_.is_format(root, "incise-recording", kRecordingVersion) ||
        !read_.is_object(root, path, {"format", "version", "program", "mesh", "options"}) ||
        !read_text(root, path, "program", header.program)) {
      return false;
    }
    const JsonValue* mesh = read_.member(root, path, "mesh");
    const JsonValue* options = mesh ? read_.member(root, path, "options") : nullptr;
    return options != nullptr && read_mesh(*mesh, header) && read_options(*options, header);
  }

 private:
  bool read_mesh(const JsonValue& mesh, RecordingHeader& header) {
    return read_.is_object(mesh, "mesh", {"file", "hash"}) && read_text(mesh, "mesh", "file", header.mesh_file) &&
           read_hash(mesh, "mesh", header.mesh_hash);
  }
  bool read_options(const JsonValue& options, RecordingHeader& header) {
    const std::string path = "options";
    if (!read_.is_object(options, path,
                         {"profile", "snap", "merge", "improve", "smooth_boundary", "work_units", "seed"})) {
      return false;
    }
    const JsonValue* snap = read_profile(options, header) ? read_.member(options, path, "snap") : nullptr;
    return snap != nullptr && read_.number(*snap, "snap", header.cut.snap) &&
           read_flag(options, path, "merge", header.maintain.merge) &&
           read_flag(options, path, "improve", header.maintain.improve) &&
           (options.find("smooth_boundary") == nullptr ||
            read_flag(options, path, "smooth_boundary", header.maintain.smooth_boundary)) &&
           read_limit(options, path, "work_units", header.maintain.work_units) &&
           read_whole(options, path, "seed", header.seed);
  }
  bool read_profile(const JsonValue& options, RecordingHeader& header) {
    std::string name;
    if (!read_text(options, "options", "profile", name)) return false;
    if (find_name(kProfileNames, name, header.cut.profile)) return true;
    return read_.fail(*options.find("profile"), "profile", "must be \"incise\" or \"paper\"");
  }
};

class CallReader : public LineReader {
 public:
  using LineReader::LineReader;

  bool run(const JsonValue& root, RecordedCall& call) {
    return read_call_kind(root, kPath, kCallNames, call.kind) && read_arguments(root, call) &&
           read_error(root, call.error) && read_hash(root, kPath, call.hash);
  }

 private:
  static constexpr const char* kPath = "the call";

  bool read_arguments(const JsonValue& root, RecordedCall& call) {
    switch (call.kind) {
      case CallKind::kBegin:
      case CallKind::kStep:
        return read_.is_object(root, kPath, {"call", "edge", "direction", "error", "hash"}) &&
               read_pose(root, call.pose);
      case CallKind::kCut:
        return read_.is_object(root, kPath, {"call", "name", "times", "edges", "error", "hash"}) &&
               read_stroke(root, call.stroke);
      case CallKind::kMaintain:
        return read_.is_object(root, kPath, {"call", "limit", "stop_ask", "work_units", "error", "hash"}) &&
               read_maintenance(root, call);
      case CallKind::kImprove:
        return read_.is_object(root, kPath, {"call", "work_units", "error", "hash"}) &&
               read_whole(root, kPath, "work_units", call.work_units);
      case CallKind::kPositions:
        return read_.is_object(root, kPath, {"call", "base64", "error", "hash"}) && read_bits(root, call.positions);
      case CallKind::kEnd:
      case CallKind::kUndo:
      case CallKind::kRedo:
        break;
    }
    return read_.is_object(root, kPath, {"call", "error", "hash"});
  }
  bool read_pose(const JsonValue& root, BladePose& pose) {
    const JsonValue* edge = read_.member(root, kPath, "edge");
    const JsonValue* direction = edge ? read_.member(root, kPath, "direction") : nullptr;
    return direction != nullptr && read_.points(*edge, "edge", kMaxPoints, pose.edge) &&
           read_.numbers(*direction, "direction", pose.direction.data(), 3);
  }
  bool read_stroke(const JsonValue& root, Stroke& stroke) {
    if (!read_text(root, kPath, "name", stroke.name)) return false;
    const JsonValue* times = read_.member(root, kPath, "times");
    const JsonValue* edges = times ? read_.member(root, kPath, "edges") : nullptr;
    if (edges == nullptr || !read_.is_array(*times, "times", 1, kMaxPoints)) return false;
    stroke.times.resize(times->items.size());
    return read_.numbers(*times, "times", stroke.times.data(), stroke.times.size()) && read_edges(*edges, stroke);
  }
  bool read_edges(const JsonValue& edges, Stroke& stroke) {
    if (!read_.is_array(edges, "edges", stroke.times.size(), stroke.times.size())) return false;
    for (std::size_t i = 0; i < edges.items.size(); ++i) {
      if (!read_.points(edges.items[i], at("edges", i), kMaxPoints, stroke.edges.emplace_back())) return false;
    }
    return true;
  }
  bool read_maintenance(const JsonValue& root, RecordedCall& call) {
    if (root.find("stop_ask") != nullptr && !read_whole(root, kPath, "stop_ask", call.stop_ask.emplace())) return false;
    return read_limit(root, kPath, "limit", call.limit) && read_whole(root, kPath, "work_units", call.work_units);
  }
  bool read_bits(const JsonValue& root, std::vector<Vec3>& points) {
    std::string text;
    if (!read_text(root, kPath, "base64", text)) return false;
    const std::size_t padding = text.size() - (text.find_last_not_of('=') + 1);
    const std::size_t bytes = text.size() / 4 * 3 - std::min(padding, text.size() / 4 * 3);
    points.resize(bytes / kBytesPerPoint);
    io::ByteSource source(text, true);
    bool is_sound = text.size() % 4 == 0 && padding <= 2 && bytes % kBytesPerPoint == 0;
    for (std::size_t i = 0; is_sound && i < 3 * points.size(); ++i) {
      is_sound = read_double(source, points[i / 3][static_cast<Eigen::Index>(i % 3)]);
    }
    is_sound = is_sound && source.is_at_end();
    return is_sound || read_.fail(*root.find("base64"), "base64", "does not hold 24 bytes per vertex slot");
  }
  static bool read_double(io::ByteSource& source, double& out) {
    std::array<char, 8> bytes{};
    if (!source.read(bytes.data(), bytes.size())) return false;
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < 8; ++i) bits |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    std::memcpy(&out, &bits, sizeof out);
    return true;
  }
};

}  // namespace

const char* name_of(CallKind kind) {
  return kCallNames[static_cast<std::size_t>(kind)];
}

std::string to_line(const RecordingHeader& header) {
  Json root;
  root["format"] = "incise-recording";
  root["version"] = kRecordingVersion;
  root["program"] = header.program.empty() ? "incise " INCISE_VERSION : header.program;
  root["mesh"] = {{"file", header.mesh_file}, {"hash", hash_text(header.mesh_hash)}};
  root["options"] = {{"profile", kProfileNames[static_cast<std::size_t>(header.cut.profile)]},
                     {"snap", header.cut.snap},
                     {"merge", header.maintain.merge},
                     {"improve", header.maintain.improve},
                     {"work_units", encode_limit(header.maintain.work_units)},
                     {"seed", header.seed}};
  if (!header.maintain.smooth_boundary) root["options"]["smooth_boundary"] = false;
  return line_of(root);
}

std::string to_line(const RecordedCall& call) {
  Json root;
  root["call"] = name_of(call.kind);
  add_arguments(call, root);
  if (call.error) root["error"] = name_of(*call.error);
  root["hash"] = hash_text(call.hash);
  return line_of(root);
}

Result<RecordingHeader> EngineCodec::parse_header(std::string_view text, std::string_view file_name,
                                                  const std::filesystem::path& /*folder*/) {
  const Result<JsonValue> root = parse_json(text, file_name, kLineLimits);
  if (!root.ok()) return root.error();
  RecordingHeader header;
  HeaderReader reader(file_name);
  if (!reader.run(*root, header)) return reader.error();
  return header;
}

Result<RecordedCall> EngineCodec::parse_call(std::string_view text, std::string_view file_name, std::uint32_t line) {
  const Result<JsonValue> root = parse_json(text, file_name, kLineLimits, line);
  if (!root.ok()) return root.error();
  RecordedCall call;
  call.line = line;
  CallReader reader(file_name);
  if (!reader.run(*root, call)) return reader.error();
  return call;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
