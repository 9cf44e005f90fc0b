// SPDX-License-Identifier: Apache-2.0
// Reads entries of a plan into items, in the order of the plan, and gives each a key: a hash of its own part of the
// plan, written out as JSON, so that changes elsewhere in the plan leave results valid.
#include "app/jobs/batch_plan.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "app/scene/blade_file.h"
#include "app/scene/scene_reader.h"
#include "app/scene/scene_write.h"
#include "app/scene/stroke_reader.h"
#include "app/text/json_write.h"
#include "app/text/range_reader.h"
#include "app/text/text_file.h"
#include "incise/core/hash.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kPlanVersion = 1;
constexpr double kMaxPlanSnap = 0.4;    // as `CutOptions`
constexpr double kMaxSeconds = 1000;    // of a random stroke
constexpr double kLeastSeconds = 0.05;  // three frames of most scenes
constexpr std::size_t kMaxNameLength = 200;
constexpr std::uint64_t kAnySeed = std::numeric_limits<std::uint64_t>::max();
constexpr const char* kNameCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";

std::string padded(std::uint64_t number, std::size_t digits) {
  std::string text = std::to_string(number);
  return text.size() < digits ? std::string(digits - text.size(), '0') + text : text;
}

// --- what a key is made of

Json json_of(const BatchOptions& options) {
  Json root = Json::object();
  if (options.profile) root["profile"] = *options.profile == Profile::kPaper ? "paper" : "incise";
  if (options.method) root["profile"] = std::string(name_of(*options.method));
  if (options.snap) root["snap"] = *options.snap;
  if (options.merge) root["merge"] = *options.merge;
  if (options.improve) root["improve"] = *options.improve;
  if (options.work_units) root["work_units"] = *options.work_units;
  return root;
}

struct EncodeBlade {
  Json operator()(const std::monostate& /*scene's own*/) const { return {}; }
  Json operator()(const HalfSpace& plane) const {
    return {{"plane", {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset}}};
  }
  Json operator()(const std::vector<BladeStroke>& strokes) const {
    Json list = Json::array();
    for (const auto& [stroke, stop_at, stop_names] : strokes) {
      Json edges = Json::array();
      for (const std::vector<Vec3>& edge : stroke.edges) edges.push_back(encode(edge));
      list.push_back({{"name", stroke.name}, {"times", stroke.times}, {"edges", std::move(edges)}});
      if (!stop_at.empty()) list.back()["stop_at"] = stop_at;
      if (!stop_names.empty()) list.back()["stop_names"] = stop_names;
    }
    return {{"strokes", std::move(list)}};
  }
  Json operator()(const RandomStrokes& random) const {  // without the seed, which repeated items differ in
    Json kinds = Json::array();
    for (const RandomKind kind : random.kinds) kinds.push_back(kRandomKindNames[static_cast<std::size_t>(kind)]);
    return {{"strokes", random.strokes},
            {"kinds", std::move(kinds)},
            {"start", random.start},
            {"seconds", random.seconds},
            {"pause", random.pause}};
  }
};

std::uint64_t seed_of(const BatchItem& item) {
  const auto* random = std::get_if<RandomStrokes>(&item.blade);
  return random == nullptr ? 0 : random->seed;
}

/// Of what all items of one entry share.
std::uint64_t shared_hash(const BatchItem& item, const BatchOutput& output) {
  const Json root = {{"label", item.label},
                     {"mesh", item.mesh},
                     {"blade", std::visit(EncodeBlade{}, item.blade)},
                     {"options", json_of(item.options)},
                     {"scene", item.scene ? scene_tree(*item.scene) : Json()},
                     {"output", {output.format, output.before, output.strokes, output.as_it_stands}}};
  return hash_of_text(root.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::uint64_t key_of(const BatchItem& item, std::uint64_t shared) {
  StateHash hash;
  hash.add(shared);
  hash.add(hash_of_text(item.name));
  hash.add(seed_of(item));
  return hash.value();
}

/// Of where a mesh comes from: files by where they are, so that two ways of writing a path are one.
std::uint64_t source_hash(const BatchItem& item, const fs::path& folder) {
  Json model = item.scene ? scene_tree(*item.scene)["model"] : Json();
  const std::string& file = item.mesh.empty() && item.scene ? item.scene->model.file : item.mesh;
  const fs::path& from = item.mesh.empty() && item.scene ? item.scene->folder : folder;
  std::error_code code;
  const fs::path place = file.empty() ? fs::path() : fs::weakly_canonical(find_in_plan(from, file), code);
  if (model.is_object()) model.erase("file");
  if (model.empty()) model = Json();  // the mesh of a file, as it is cut at rest
  StateHash hash;
  hash.add(hash_of_text(code ? file : place.string()));
  hash.add(hash_of_text(model.dump(-1, ' ', false, Json::error_handler_t::replace)));
  return hash.value();
}

// --- the reader

/// What items and defaults have in common.
struct Common {
  std::string mesh;
  std::shared_ptr<const Scene> scene;
  BatchOptions options;
};

class PlanReader {
 public:
  PlanReader(std::string_view file_name, const fs::path& folder) : read_(file_name), file_name_(file_name) {
    plan_.folder = folder;
  }

  Result<BatchPlan> run(const JsonValue& root) {
    if (read_header(root) && read_output(root.find("output")) && read_defaults(root.find("defaults")) &&
        read_items(root)) {
      return std::move(plan_);
    }
    return other_error_ ? *other_error_ : read_.error();
  }

 private:
  bool read_header(const JsonValue& root) {
    return read_.is_format(root, "incise-plan", kPlanVersion) &&
           read_.is_object(root, "", {"format", "version", "name", "output", "defaults", "items"}) &&
           read_.optional_text(root, "", "name", plan_.name);
  }
  bool read_output(const JsonValue* value) {
    if (value == nullptr) return true;
    BatchOutput& out = plan_.output;
    std::string pose = "rest";
    if (!read_.is_object(*value, "output", {"mesh", "before", "strokes", "pose"}) ||
        !read_mesh_format(value->find("mesh")) || !read_.optional_boolean(*value, "output", "before", out.before) ||
        !read_.optional_boolean(*value, "output", "strokes", out.strokes) ||
        !read_.optional_text(*value, "output", "pose", pose)) {
      return false;
    }
    out.as_it_stands = pose == "deformed";
    return pose == "rest" || out.as_it_stands ||
           read_.fail(*value->find("pose"), "output.pose", "must be \"rest\" or \"deformed\"");
  }
  bool read_mesh_format(const JsonValue* value) {
    BatchOutput& out = plan_.output;
    if (value == nullptr) return true;
    if (value->kind == JsonValue::Kind::kNull) {
      out.format.clear();
      return true;
    }
    if (!read_.text(*value, "output.mesh", out.format)) return false;
    const auto options = io::write_options_named(out.format);
    if (options && options->extension != ".node") {  // a pair of files: one name would not do
      out.mesh = *options;
      return true;
    }
    std::string known;
    for (const std::string& name : io::write_option_names()) {
      if (name != "node") known += name + ", ";
    }
    return read_.fail(*value, "output.mesh", "must be one of " + known + "or null for no meshes");
  }
  bool read_defaults(const JsonValue* value) {
    return value == nullptr || (read_.is_object(*value, "defaults", {"mesh", "scene", "options"}) &&
                                read_common(*value, "defaults", defaults_));
  }

  bool read_common(const JsonValue& value, const std::string& path, Common& out) {
    if (!read_.optional_text(value, path, "mesh", out.mesh)) return false;
    const JsonValue* scene = value.find("scene");
    return (scene == nullptr || read_scene_of(*scene, under(path, "scene"), out.scene)) &&
           read_options(value.find("options"), under(path, "options"), out.options);
  }
  /// A scene file by its path, read once for all items, or a scene.
  bool read_scene_of(const JsonValue& value, const std::string& path, std::shared_ptr<const Scene>& out) {
    const bool is_file = value.kind == JsonValue::Kind::kString;
    if (!is_file && value.kind != JsonValue::Kind::kObject) {
      return read_.fail(value, path, "must be a scene file's path, or a scene");
    }
    if (is_file && scenes_.count(value.text) > 0) {
      out = scenes_.at(value.text);
      return true;
    }
    Result<Scene> scene = is_file ? read_scene(find_in_plan(plan_.folder, value.text))
                                  : read_scene_tree(value, file_name_, plan_.folder, path);
    if (!scene.ok()) return is_file ? fail_by_file(value, path, scene.error()) : fail_by(scene.error());
    out = std::make_shared<const Scene>(std::move(scene).value());
    if (is_file) scenes_[value.text] = out;
    return true;
  }
  bool read_options(const JsonValue* value, const std::string& path, BatchOptions& out) {
    if (value == nullptr) return true;
    return read_.is_object(*value, path, {"profile", "snap", "merge", "improve", "work_units"}) &&
           read_profile(value->find("profile"), path + ".profile", out) &&
           (value->find("snap") == nullptr ||
            read_.optional_ranged(*value, path, "snap", {0, kMaxPlanSnap}, out.snap.emplace())) &&
           (value->find("merge") == nullptr || read_.optional_boolean(*value, path, "merge", out.merge.emplace())) &&
           (value->find("improve") == nullptr ||
            read_.optional_boolean(*value, path, "improve", out.improve.emplace())) &&
           (value->find("work_units") == nullptr ||
            read_.optional_whole(*value, path, "work_units", 0, kAnySeed, out.work_units.emplace()));
  }
  bool read_profile(const JsonValue* value, const std::string& path, BatchOptions& out) {
    if (value == nullptr) return true;
    std::string name;
    if (!read_.text(*value, path, name)) return false;
    out.profile.reset();
    out.method = find_lab_method(name);
    if (name == "incise") out.profile = Profile::kIncise;
    if (name == "paper") out.profile = Profile::kPaper;
    if (out.profile || out.method) return true;
    std::string known = "incise, paper";
    for (const std::string_view method : kLabMethodNames) known += ", " + std::string(method);
    return read_.fail(*value, path, "must be one of " + known);
  }

  bool read_items(const JsonValue& root) {
    const JsonValue* items = read_.member(root, "", "items");
    if (items == nullptr || !read_.is_array(*items, "items", 1, kMaxBatchItems)) return false;
    for (std::size_t i = 0; i < items->items.size(); ++i) {
      if (!read_item(items->items[i], at("items", i))) return false;
    }
    return true;
  }
  bool read_item(const JsonValue& value, const std::string& path) {
    BatchItem item;
    Common common = defaults_;
    if (!read_.is_object(value, path,
                         {"name", "label", "repeat", "mesh", "plane", "blade", "random", "scene", "options"}) ||
        !read_common(value, path, common) || !read_.optional_text(value, path, "label", item.label) ||
        !read_blade_of(value, path, item.blade)) {
      return false;
    }
    item.mesh = std::move(common.mesh);
    item.scene = std::move(common.scene);
    item.options = common.options;
    return is_complete(value, path, item) && can_be_opened(value, path, item) && add(value, path, item);
  }
  bool read_blade_of(const JsonValue& value, const std::string& path, BatchBlade& out) {
    const JsonValue* plane = value.find("plane");
    const JsonValue* blade = value.find("blade");
    const JsonValue* random = value.find("random");
    if ((plane != nullptr) + (blade != nullptr) + (random != nullptr) > 1) {
      return read_.fail(value, path, "has more than one of the keys plane, blade, random; give one");
    }
    if (plane != nullptr) return read_plane(*plane, path + ".plane", out.emplace<HalfSpace>());
    if (blade != nullptr) return read_strokes_of(*blade, path + ".blade", out.emplace<std::vector<BladeStroke>>());
    return random == nullptr || read_random(*random, path + ".random", out.emplace<RandomStrokes>());
  }
  bool read_plane(const JsonValue& value, const std::string& path, HalfSpace& out) {
    double numbers[4] = {};
    if (!read_.numbers(value, path, numbers, 4)) return false;
    out = {Vec3(numbers[0], numbers[1], numbers[2]), numbers[3]};
    return !out.normal.isZero(0) || read_.fail(value, path, "needs a normal that is not zero: [nx,ny,nz,d]");
  }
  /// A file that the plan names is not as it has to be: its own message, behind the place in the plan.
  bool fail_by_file(const JsonValue& value, const std::string& path, const Error& error) {
    if (error.code != ErrorCode::kBadFile) return fail_by(error);
    return read_.fail(value, path, "names a file that cannot be taken: " + error.message);
  }
  bool fail_by(const Error& error) {
    other_error_ = error;
    return false;
  }

  /// A blade file by its path, or strokes.
  bool read_strokes_of(const JsonValue& value, const std::string& path, std::vector<BladeStroke>& out) {
    if (value.kind != JsonValue::Kind::kString) return read_strokes(read_, value, path, out);
    Result<std::vector<BladeStroke>> strokes = read_blade_file(find_in_plan(plan_.folder, value.text));
    if (!strokes.ok()) return fail_by_file(value, path, strokes.error());
    out = std::move(strokes).value();
    return true;
  }
  bool read_random(const JsonValue& value, const std::string& path, RandomStrokes& out) {
    std::uint64_t strokes = out.strokes;
    if (!read_.is_object(value, path, {"seed", "strokes", "kinds", "start", "seconds", "pause"}) ||
        !read_.optional_whole(value, path, "seed", 0, kAnySeed, out.seed) ||
        !read_.optional_whole(value, path, "strokes", 1, kMaxRandomStrokes, strokes) ||
        !read_kinds(value.find("kinds"), path + ".kinds", out.kinds) ||
        !read_.optional_ranged(value, path, "start", {0, kMaxSeconds}, out.start) ||
        !read_.optional_ranged(value, path, "seconds", {kLeastSeconds, kMaxSeconds}, out.seconds) ||
        !read_.optional_ranged(value, path, "pause", {kLeastSeconds, kMaxSeconds}, out.pause)) {
      return false;
    }
    out.strokes = static_cast<std::uint32_t>(strokes);
    return true;
  }
  bool read_kinds(const JsonValue* value, const std::string& path, std::vector<RandomKind>& out) {
    if (value == nullptr) return true;
    if (!read_.is_array(*value, path, 1, kRandomKindNames.size())) return false;
    out.clear();
    for (std::size_t i = 0; i < value->items.size(); ++i) {
      std::string name;
      if (!read_.text(value->items[i], at(path, i), name)) return false;
      const auto* found = std::find(kRandomKindNames.begin(), kRandomKindNames.end(), name);
      if (found == kRandomKindNames.end()) {
        return read_.fail(value->items[i], at(path, i), "must be one of plane, arc, slit, core");
      }
      out.push_back(static_cast<RandomKind>(found - kRandomKindNames.begin()));
    }
    return true;
  }

  bool is_complete(const JsonValue& value, const std::string& path, const BatchItem& item) {
    const bool is_random = std::holds_alternative<RandomStrokes>(item.blade);
    if (value.find("repeat") != nullptr && !is_random) {
      return read_.fail(value, path, "has \"repeat\", which goes with \"random\": each time has the next seed");
    }
    if (!item.scene) {
      if (is_random && !has_no_times(*value.find("random"), path + ".random")) return false;
      if (item.mesh.empty()) return read_.fail(value, path, "needs the key \"mesh\" or \"scene\"");
      return !std::holds_alternative<std::monostate>(item.blade) ||
             read_.fail(value, path, "needs one of the keys plane, blade, random");
    }
    if (item.options.method) {
      return read_.fail(value, path, "has a scene, which the profiles incise and paper alone can cut");
    }
    if (!is_random && !std::holds_alternative<std::monostate>(item.blade)) {
      return read_.fail(value, path, "has a scene beside a plane or a blade; put the strokes into the scene");
    }
    return is_random || !item.scene->strokes.empty() ||
           read_.fail(value, path, "has a scene without strokes; put some into it, or give \"random\"");
  }
  /// At rest nothing takes time: random strokes have their steps.
  bool has_no_times(const JsonValue& random, const std::string& path) {
    for (const char* key : {"start", "seconds", "pause"}) {
      const JsonValue* value = random.find(key);
      if (value != nullptr) {
        return read_.fail(*value, under(path, key),
                          "is of scenes, and the item has none; leave it out, or give a scene");
      }
    }
    return true;
  }
  /// Whether the item's mesh files are there. Each is looked at once.
  bool can_be_opened(const JsonValue& value, const std::string& path, const BatchItem& item) {
    if (!item.mesh.empty() && !can_be_opened(value, path, plan_.folder, item.mesh)) return false;
    if (!item.scene) return true;
    const Scene& scene = *item.scene;
    const auto is_there = [&](const std::string& file) { return can_be_opened(value, path, scene.folder, file); };
    const auto has_file = [&](const SceneBody& body) { return is_there(body.file); };
    return (!item.mesh.empty() || is_there(scene.model.file)) &&
           std::all_of(scene.model.bodies.begin(), scene.model.bodies.end(), has_file);
  }
  bool can_be_opened(const JsonValue& value, const std::string& path, const fs::path& folder, const std::string& file) {
    if (file.empty() || !opened_.insert(folder.string() + "\n" + file).second) return true;
    const Status status = check_readable(find_in_plan(folder, file));
    return status.ok() || read_.fail(value, path, "needs the mesh " + status.error().message);
  }

  bool add(const JsonValue& value, const std::string& path, const BatchItem& item) {
    std::uint64_t count = 1;
    if (!read_.optional_whole(value, path, "repeat", 1, kMaxBatchItems, count)) return false;
    if (plan_.items.size() + count > kMaxBatchItems) {
      return read_.fail(value, path, "brings the plan above " + std::to_string(kMaxBatchItems) + " items");
    }
    if (!has_seeds(value, path, seed_of(item), count)) return false;
    std::string name;
    if (!read_.optional_text(value, path, "name", name)) return false;
    const bool is_repeated = value.find("repeat") != nullptr;
    const std::size_t digits = std::max<std::size_t>(4, std::to_string(count - 1).size());
    const std::uint64_t shared = shared_hash(item, plan_.output), source = source_hash(item, plan_.folder);
    for (std::uint64_t i = 0; i < count; ++i) {
      BatchItem& one = plan_.items.emplace_back(item);
      one.name = name.empty() ? "item-" + padded(plan_.items.size() - 1, 6)
                              : name + (is_repeated ? "-" + padded(i, digits) : "");
      if (auto* random = std::get_if<RandomStrokes>(&one.blade)) random->seed += i;
      one.key = key_of(one, shared);
      one.source = source;
      if (!is_fit_name(value, path, one.name)) return false;
    }
    return true;
  }
  /// Whether each of the repeated items has a seed of its own: none is above the highest.
  bool has_seeds(const JsonValue& value, const std::string& path, std::uint64_t seed, std::uint64_t count) {
    if (count - 1 <= kAnySeed - seed) return true;
    return read_.fail(*value.find("random")->find("seed"), path + ".random.seed",
                      "is " + std::to_string(seed) + ", and the last of " + std::to_string(count) +
                          " items would need one above 2^64 - 1; begin with a lower one");
  }
  bool is_fit_name(const JsonValue& value, const std::string& path, const std::string& name) {
    if (name.front() == '.' || name.back() == '.' || name.size() > kMaxNameLength ||
        name.find_first_not_of(kNameCharacters) != name.npos) {
      return read_.fail(value, path + ".name",
                        "is \"" + name +
                            "\"; files are named by it: use letters, digits, _ - and . within it, at most " +
                            std::to_string(kMaxNameLength));
    }
    std::string folded = name;  // some file systems do not tell A from a
    for (char& letter : folded) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    const auto& [other, is_new] = names_.try_emplace(std::move(folded), name);
    return is_new ||
           read_.fail(value, path + ".name",
                      "is \"" + name + "\", as that of an item before it" +
                          (other->second == name ? "" : " but for the case of letters: \"" + other->second + "\"") +
                          "; change one of them");
  }

  RangeReader read_;
  std::string file_name_;
  BatchPlan plan_;
  Common defaults_;
  std::map<std::string, std::shared_ptr<const Scene>> scenes_;
  std::set<std::string> opened_;
  std::map<std::string, std::string> names_;  // in lower case: as the items have them
  std::optional<Error> other_error_;          // of another file
};

}  // namespace

fs::path find_in_plan(const fs::path& folder, const std::string& file) {
  std::error_code code;
  const fs::path beside = folder / file;
  return fs::exists(beside, code) ? beside : fs::path(file);
}

std::uint64_t hash_of_text(std::string_view text) {
  StateHash hash;
  hash.add(static_cast<std::uint64_t>(text.size()));
  for (std::size_t i = 0; i < text.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, text.data() + i, std::min(sizeof word, text.size() - i));
    hash.add(word);
  }
  return hash.value();
}

Result<BatchPlan> parse_batch_plan(std::string_view json, std::string_view file_name, const fs::path& folder) {
  const Result<JsonValue> root = parse_json(json, file_name);
  if (!root.ok()) return root.error();
  return PlanReader(file_name, folder).run(*root);
}

Result<BatchPlan> read_batch_plan(const fs::path& path) {
  const Result<std::string> text = read_text_file(path, JsonLimits{}.max_bytes);
  if (!text.ok()) return text.error();
  return parse_batch_plan(*text, path.string(), path.parent_path());
}

}  // namespace app
}  // namespace v0
}  // namespace incise
