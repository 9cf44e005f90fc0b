// SPDX-License-Identifier: Apache-2.0
// One line of JSON for each call. A field that has its default has no key, so that frames without hands are short.
#include "app/recording/simulation_recording.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/scene/blade_file.h"
#include "app/scene/scene_reader.h"
#include "app/scene/scene_write.h"
#include "app/text/line_reader.h"
#include "app/text/line_source.h"
#include "app/text/range_reader.h"
#include "incise/version.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::uint32_t kSimulationVersion = 1;
constexpr std::size_t kMaxItems = 1'000'000;  // hooks and tools of one frame
constexpr std::array<const char*, 2> kReachNames = {"ball", "surface"};
constexpr std::array<const char*, 6> kSimulationCallNames = {"settle", "frame", "undo", "redo", "suture", "unpick"};

// ---- writing ----

/// What is as it mostly is has no key.
Json encode_hook(const Hook& hook) {
  Json root = {
      {"id", hook.id}, {"position", encode(hook.position)}, {"radius", hook.radius}, {"stiffness", hook.stiffness}};
  if (hook.reach != HookReach::kBall) root["reach"] = kReachNames[static_cast<std::size_t>(hook.reach)];
  if (hook.closed != 0) root["closed"] = hook.closed;
  if (std::isfinite(hook.strength)) root["strength"] = hook.strength;
  if (hook.tears) root["tears"] = true;
  return root;
}

Json encode_tool(const Tool& tool) {
  return std::visit(
      [](const auto& shape) {
        Json root = {{"kind", shape.kName}};
        shape.for_each_field(shape, [&](const char* name, const auto& field) { root[name] = encode(field); });
        return root;
      },
      tool);
}

void add_suture(const SutureCall& call, Json& root) {
  root["id"] = call.id;
  root["ends"] = {encode(call.ends[0]), encode(call.ends[1])};
  root["stiffness"] = call.suture.stiffness;
  root["rest_length"] = call.suture.rest_length;
  root["pushes"] = call.suture.pushes;
  if (std::isfinite(call.suture.strength)) root["strength"] = call.suture.strength;
}

void add_input(const FrameInput& input, Json& root) {
  if (input.blade) root["blade"] = {{"edge", encode(input.blade->edge)}, {"direction", encode(input.blade->direction)}};
  if (input.blade && input.blade->slicing != 0) root["blade"]["slicing"] = input.blade->slicing;
  for (const Hook& hook : input.hooks) root["hooks"].push_back(encode_hook(hook));
  for (const Tool& tool : input.tools) root["tools"].push_back(encode_tool(tool));
}

// ---- reading ----

class SimulationHeaderReader : public LineReader {
 public:
  explicit SimulationHeaderReader(std::string_view file_name) : LineReader(file_name), file_name_(file_name) {}

  Result<SimulationHeader> run(const JsonValue& root, const std::filesystem::path& folder) {
    const std::string path = "the header";
    SimulationHeader header;
    if (!read_.is_format(root, "incise-simulation", kSimulationVersion) ||
        !read_.is_object(root, path, {"format", "version", "program", "mesh", "scene"}) ||
        !read_text(root, path, "program", header.program)) {
      return error();
    }
    const JsonValue* mesh = read_.member(root, path, "mesh");
    const JsonValue* scene = mesh != nullptr ? read_.member(root, path, "scene") : nullptr;
    if (scene == nullptr || !read_.is_object(*mesh, "mesh", {"hash"}) || !read_hash(*mesh, "mesh", header.mesh_hash)) {
      return error();
    }
    Result<Scene> found = read_scene_tree(*scene, file_name_, folder, "scene");
    if (!found.ok()) return found.error();
    header.scene = std::move(found).value();
    return header;
  }

 private:
  std::string_view file_name_;
};

class SimulationCallReader : public LineReader {
 public:
  using LineReader::LineReader;

  bool run(const JsonValue& root, SimulationCall& call) {
    return read_call_kind(root, kPath, kSimulationCallNames, call.kind) && read_arguments(root, call) &&
           read_error(root, call.error) &&
           (root.find("hash") == nullptr || read_hash(root, kPath, call.hash.emplace()));
  }

 private:
  static constexpr const char* kPath = "the call";

  bool read_arguments(const JsonValue& root, SimulationCall& call) {
    switch (call.kind) {
      case SimulationCallKind::kSettle:
        return read_.is_object(root, kPath, {"call", "frames", "speed", "error", "hash"}) &&
               read_settle(root, call.settle);
      case SimulationCallKind::kFrame:
        return read_.is_object(root, kPath, {"call", "blade", "hooks", "tools", "error", "hash"}) &&
               read_blade(root.find("blade"), call.input) &&
               read_items(root, "hooks",
                          [&](const JsonValue& v, const std::string& p) {
                            return read_hook(v, p, call.input.hooks.emplace_back());
                          }) &&
               read_items(root, "tools", [&](const JsonValue& v, const std::string& p) {
                 return read_tool(v, p, call.input.tools.emplace_back());
               });
      case SimulationCallKind::kSuture:
        return read_.is_object(
                   root, kPath,
                   {"call", "id", "ends", "stiffness", "rest_length", "pushes", "strength", "error", "hash"}) &&
               read_suture(root, call.suture);
      case SimulationCallKind::kUnpick:
        return read_.is_object(root, kPath, {"call", "id", "error", "hash"}) && read_id(root, kPath, call.suture.id);
      case SimulationCallKind::kUndo:
      case SimulationCallKind::kRedo:
        break;
    }
    return read_.is_object(root, kPath, {"call", "error", "hash"});
  }
  bool read_settle(const JsonValue& root, SceneSettle& settle) {
    std::uint64_t frames = 0;
    if (!read_whole(root, kPath, "frames", frames)) return false;
    settle.frames = static_cast<std::uint32_t>(frames);
    return (settle.frames == frames || read_.fail(root, "frames", "must be below 2^32")) &&
           read_number(root, "", "speed", settle.speed);
  }
  bool read_suture(const JsonValue& root, SutureCall& call) {
    std::vector<Vec3> ends;
    const JsonValue* list = read_.member(root, kPath, "ends");
    if (list == nullptr || !read_.points(*list, "ends", 2, ends)) return false;
    call.ends = {ends[0], ends[1]};
    Suture& suture = call.suture;
    return read_id(root, kPath, call.id) && read_number(root, "", "stiffness", suture.stiffness) &&
           read_number(root, "", "rest_length", suture.rest_length) &&
           read_flag(root, kPath, "pushes", suture.pushes) &&
           (root.find("strength") == nullptr || read_number(root, "", "strength", suture.strength));
  }
  bool read_id(const JsonValue& value, const std::string& path, std::uint32_t& out) {
    std::uint64_t id = 0;
    if (!read_whole(value, path, "id", id)) return false;
    out = static_cast<std::uint32_t>(id);
    return out == id || read_.fail(value, under(path, "id"), "must be below 2^32");
  }
  bool read_blade(const JsonValue* value, FrameInput& input) {
    if (value == nullptr) return true;
    BladePose& pose = input.blade.emplace();
    if (!read_.is_object(*value, "blade", {"edge", "direction", "slicing"})) return false;
    const JsonValue* edge = read_.member(*value, "blade", "edge");
    return edge != nullptr && read_.points(*edge, "blade.edge", kMaxBladePoints, pose.edge) &&
           read_point(*value, "blade", "direction", pose.direction) &&
           (value->find("slicing") == nullptr || read_number(*value, "blade", "slicing", pose.slicing));
  }
  template <class ReadItem>
  bool read_items(const JsonValue& root, const std::string& key, const ReadItem& read_item) {
    const JsonValue* list = root.find(key);
    if (list == nullptr) return true;
    if (!read_.is_array(*list, key, 0, kMaxItems)) return false;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      if (!read_item(list->items[i], at(key, i))) return false;
    }
    return true;
  }
  bool read_hook(const JsonValue& value, const std::string& path, Hook& hook) {
    if (!read_.is_object(value, path,
                         {"id", "position", "radius", "stiffness", "reach", "closed", "strength", "tears"}) ||
        !read_id(value, path, hook.id) || !read_reach(value, path, hook.reach) ||
        (value.find("closed") != nullptr && !read_number(value, path, "closed", hook.closed)) ||
        (value.find("strength") != nullptr && !read_number(value, path, "strength", hook.strength)) ||
        (value.find("tears") != nullptr && !read_.boolean(*value.find("tears"), path + ".tears", hook.tears))) {
      return false;
    }
    return read_point(value, path, "position", hook.position) && read_number(value, path, "radius", hook.radius) &&
           read_number(value, path, "stiffness", hook.stiffness);
  }
  bool read_reach(const JsonValue& value, const std::string& path, HookReach& reach) {
    const JsonValue* name = value.find("reach");
    if (name == nullptr) return true;
    const auto* const known = std::find(kReachNames.begin(), kReachNames.end(), name->text);
    if (known == kReachNames.end()) return read_.fail(*name, under(path, "reach"), "must be \"ball\" or \"surface\"");
    reach = static_cast<HookReach>(known - kReachNames.begin());
    return true;
  }
  bool read_tool(const JsonValue& value, const std::string& path, Tool& tool) {
    std::string kind;
    if (value.kind != JsonValue::Kind::kObject) return read_.fail(value, path, "must be an object");
    if (!read_text(value, path, "kind", kind)) return false;
    bool is_known = false, is_read = false;
    std::string kinds;
    for_each_tool_kind([&](auto shape) {
      kinds += std::string(kinds.empty() ? "" : ", ") + shape.kName;
      if (kind != shape.kName) return;
      is_known = true;
      is_read = read_shape(value, path, shape);
      tool = std::move(shape);
    });
    return is_known ? is_read : read_.fail(*value.find("kind"), under(path, "kind"), "must be one of " + kinds);
  }
  template <class Shape>
  bool read_shape(const JsonValue& value, const std::string& path, Shape& shape) {
    std::vector<std::string_view> keys = {"kind"};
    shape.for_each_field(shape, [&](const char* name, const auto& /*field*/) { keys.emplace_back(name); });
    bool is_read = read_.is_object(value, path, keys);
    shape.for_each_field(
        shape, [&](const char* name, auto& field) { is_read = is_read && read_field(value, path, name, field); });
    return is_read;
  }
  bool read_field(const JsonValue& object, const std::string& path, const char* key, Vec3& out) {
    return read_point(object, path, key, out);
  }
  bool read_field(const JsonValue& object, const std::string& path, const char* key, double& out) {
    return read_number(object, path, key, out);
  }
  bool read_field(const JsonValue& object, const std::string& path, const char* key, std::vector<Vec3>& out) {
    const JsonValue* value = read_.member(object, path, key);
    return value != nullptr && read_.points(*value, under(path, key), kMaxBladePoints, out);
  }
  bool read_point(const JsonValue& object, const std::string& path, const char* key, Vec3& out) {
    const JsonValue* value = read_.member(object, path, key);
    return value != nullptr && read_.numbers(*value, under(path, key), out.data(), 3);
  }
  bool read_number(const JsonValue& object, const std::string& path, const char* key, double& out) {
    const JsonValue* value = read_.member(object, path, key);
    return value != nullptr && read_.number(*value, under(path, key), out);
  }
};

}  // namespace

const char* name_of(SimulationCallKind kind) {
  return kSimulationCallNames[static_cast<std::size_t>(kind)];
}

std::string to_line(const SimulationHeader& header) {
  Json root;
  root["format"] = "incise-simulation";
  root["version"] = kSimulationVersion;
  root["program"] = header.program.empty() ? "incise " INCISE_VERSION : header.program;
  root["mesh"]["hash"] = hash_text(header.mesh_hash);
  root["scene"] = scene_tree(header.scene);
  return line_of(root);
}

std::string to_line(const SimulationCall& call) {
  Json root;
  root["call"] = name_of(call.kind);
  if (call.kind == SimulationCallKind::kFrame) add_input(call.input, root);
  if (call.kind == SimulationCallKind::kSettle) {
    root["frames"] = call.settle.frames;
    root["speed"] = call.settle.speed;
  }
  if (call.kind == SimulationCallKind::kSuture) add_suture(call.suture, root);
  if (call.kind == SimulationCallKind::kUnpick) root["id"] = call.suture.id;
  if (call.error) root["error"] = name_of(*call.error);
  if (call.hash) root["hash"] = hash_text(*call.hash);
  return line_of(root);
}

Result<SimulationHeader> SimulationCodec::parse_header(std::string_view text, std::string_view file_name,
                                                       const std::filesystem::path& folder) {
  const Result<JsonValue> root = parse_json(text, file_name, kLineLimits);
  if (!root.ok()) return root.error();
  return SimulationHeaderReader(file_name).run(*root, folder);
}

Result<SimulationCall> SimulationCodec::parse_call(std::string_view text, std::string_view file_name,
                                                   std::uint32_t line) {
  const Result<JsonValue> root = parse_json(text, file_name, kLineLimits, line);
  if (!root.ok()) return root.error();
  SimulationCall call;
  call.line = line;
  SimulationCallReader reader(file_name);
  if (!reader.run(*root, call)) return reader.error();
  return call;
}

bool is_simulation_header(std::string_view line) {
  const Result<JsonValue> root = parse_json(line, "", kLineLimits);
  const JsonValue* format = root.ok() ? root->find("format") : nullptr;
  return format != nullptr && format->text == "incise-simulation";
}

}  // namespace app
}  // namespace v0
}  // namespace incise
