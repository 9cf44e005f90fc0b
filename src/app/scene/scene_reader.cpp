// SPDX-License-Identifier: Apache-2.0
// Readers that build upon each other by inheritance, one for each part of a scene, and share what has been read
// before; each key is checked where it is read, and its path is in the message.
#include "app/scene/scene_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "app/scene/blade_file.h"
#include "app/scene/stroke_reader.h"
#include "app/scene/view_names.h"
#include "app/text/named_file.h"
#include "app/text/range_reader.h"
#include "app/text/text_file.h"
#include "incise/sim/tissue.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// What a body can bear: beyond it energies overflow.
constexpr Range kBoundedAtLeast0{0, kGreatestExtent}, kBoundedAbove0{0, kGreatestExtent, true};

namespace fs = std::filesystem;

constexpr std::uint32_t kSceneVersion = 1;
constexpr std::uint64_t kMaxRegion = std::numeric_limits<std::int32_t>::max();
constexpr double kMaxBoxTets = 268435456;                  // as `kuhn_box`
constexpr double kMaxPoisson = 0.499;                      // as `Material`
constexpr double kMaxSnap = 0.4;                           // as `CutOptions`
constexpr double kMaxJitter = 0.15;                        // as `jitter`
constexpr double kMaxStretch = 1e6;                        // of the times of a blade
constexpr double kLeastStretch = 0.5, kMostStretch = 2.0;  // of the body
constexpr double kLatestStart = 1e7;                       // s, of a suture: beyond the last frame that there may be
constexpr double kTail = 0.5;  // s, that a scene without frames and duration goes on after its last key time
constexpr double kFramesBetweenStrokes = 2;
constexpr double kSteepestAngle = 89;           // degrees, of an exercise: an edge along the surface cuts no depth
constexpr std::size_t kMaxTargetPoints = 1000;  // each part of an attempt is compared with each of them
constexpr double kLineTolerance = 0.05;         // of the target line's length
constexpr double kDepthTolerance = 0.25;        // of the depth
constexpr double kAllPoints = 100;              // that an attempt may have

/// A scene as far as it is read, and what all of its readers need.
class SceneParts {
 public:
  SceneParts(std::string_view file_name, const fs::path& folder, const std::string& place) : read_(file_name, place) {
    scene_.folder = folder;
  }

 protected:
  /// Reads each item of a list that may be left out, by a member of `reader`; `path` ends with the list's key.
  template <class Reader>
  bool read_list(Reader& reader, const JsonValue& owner, const std::string& path,
                 bool (Reader::*read_item)(const JsonValue&, const std::string&)) {
    const JsonValue* list = owner.find(path.substr(path.rfind('.') + 1));
    if (list == nullptr) return true;
    if (!read_.is_array(*list, path, 0, kMaxSceneItems)) return false;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      if (!(reader.*read_item)(list->items[i], at(path, i))) return false;
    }
    return true;
  }
  /// Four numbers nx, ny, nz, d.
  bool read_plane(const JsonValue& value, const std::string& path, HalfSpace& out) {
    double numbers[4] = {};
    if (!read_.numbers(value, path, numbers, 4)) return false;
    out = {Vec3(numbers[0], numbers[1], numbers[2]), numbers[3]};
    const double length = out.normal.norm();
    return (length > 0 && std::isfinite(length)) ||
           read_.fail(value, path, "needs a normal that is not zero: [nx,ny,nz,d]");
  }
  bool has_one(const JsonValue& value, const std::string& path, const std::vector<std::string_view>& keys) {
    int found = 0;
    std::string names;
    for (const std::string_view key : keys) {
      found += value.find(key) != nullptr ? 1 : 0;
      names += (names.empty() ? "" : ", ") + std::string(key);
    }
    return found == 1 || read_.fail(value, path, "needs one of the keys " + names);
  }

  RangeReader read_;
  Scene scene_;
};

/// The body: model, materials, what holds it.
class SceneBodyReader : public SceneParts {
 public:
  using SceneParts::SceneParts;

  bool read_body(const JsonValue& root) {
    BodyOptions& body = scene_.options.body;
    const JsonValue* model = read_.member(root, "", "model");
    return model != nullptr && read_model(*model) &&
           read_.need_ranged(root, "", "length_unit", kBoundedAbove0, body.length_unit) && read_materials(root) &&
           read_.optional_point(root, "", "gravity", body.gravity) &&
           read_.optional_ranged(root, "", "damping", kBoundedAtLeast0, body.damping) && read_stretch(root) &&
           read_list(*this, root, "attachments", &SceneBodyReader::read_attachment);
  }

 private:
  bool read_model(const JsonValue& value) {
    SceneModel& model = scene_.model;
    return read_.is_object(value, "model", {"file", "box", "regions", "bodies", "surface"}) &&
           read_shape(value, "model", model.file, model.box) &&
           read_.optional_text(value, "model", "surface", model.surface) &&
           read_list(*this, value, "model.bodies", &SceneBodyReader::read_more_body) &&
           read_list(*this, value, "model.regions", &SceneBodyReader::read_painting);
  }
  /// A mesh file or a box.
  bool read_shape(const JsonValue& value, const std::string& path, std::string& file, SceneBox& out) {
    const JsonValue* box = value.find("box");
    if ((box == nullptr) == (value.find("file") == nullptr)) {
      return read_.fail(value, path, "needs either the key \"file\" or the key \"box\"");
    }
    if (box != nullptr && !read_box(*box, path + ".box", out)) return false;
    if (!read_.optional_text(value, path, "file", file)) return false;
    return box != nullptr || !file.empty() || read_.fail(value, path + ".file", "is empty; name a mesh file");
  }
  bool read_more_body(const JsonValue& value, const std::string& path) {
    SceneBody& body = scene_.model.bodies.emplace_back();
    return read_.is_object(value, path, {"file", "box", "move", "region"}) &&
           read_shape(value, path, body.file, body.box) && read_.optional_point(value, path, "move", body.move) &&
           (value.find("region") == nullptr || read_region(value, path, body.region.emplace()));
  }
  bool read_box(const JsonValue& value, const std::string& path, SceneBox& box) {
    if (!read_.is_object(value, path, {"cells", "size", "origin", "jitter"})) return false;
    const JsonValue* cells = read_.member(value, path, "cells");
    return cells != nullptr && read_cells(*cells, path + ".cells", box) &&
           read_.optional_point(value, path, "size", box.size) && is_positive(value, path, box.size) &&
           read_.optional_point(value, path, "origin", box.origin) &&
           read_.optional_ranged(value, path, "jitter", {0, kMaxJitter}, box.jitter);
  }
  bool is_positive(const JsonValue& value, const std::string& path, const Vec3& size) {
    return (size.array() > 0).all() || read_.fail(value, path + ".size", "must be above 0 on every axis");
  }
  bool read_cells(const JsonValue& value, const std::string& path, SceneBox& box) {
    double tets = 6;
    if (!read_.is_array(value, path, 3, 3)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const JsonValue& item = value.items[i];
      const bool is_count = item.is_whole && item.whole > 0 && item.whole <= kMaxRegion;
      if (!is_count) return read_.fail(item, at(path, i), "must be a whole number above 0");
      box.cells[i] = static_cast<std::uint32_t>(item.whole);
      tets *= static_cast<double>(item.whole);
    }
    return tets <= kMaxBoxTets || read_.fail(value, path, "make more than 2^28 tets; take fewer");
  }
  bool read_region(const JsonValue& value, const std::string& path, std::int32_t& region) {
    std::uint64_t label = 0;
    if (read_.member(value, path, "region") == nullptr ||
        !read_.optional_whole(value, path, "region", 0, kMaxRegion, label)) {
      return false;
    }
    region = static_cast<std::int32_t>(label);
    return true;
  }
  bool read_painting(const JsonValue& value, const std::string& path) {
    RegionPaint& paint = scene_.model.regions.emplace_back();
    return read_.is_object(value, path, {"region", "name", "below", "ball", "box"}) &&
           read_region(value, path, paint.region) && read_.optional_text(value, path, "name", paint.name) &&
           has_one(value, path, {"box", "ball", "below"}) && read_where(value, path, paint.where);
  }
  bool read_materials(const JsonValue& root) {
    const JsonValue* value = root.find("materials");
    if (value == nullptr) return true;
    if (!read_.is_object(*value, "materials", {"default", "regions", "by_name"})) return false;
    const JsonValue* fallback = value->find("default");
    const std::string path = "materials.default";
    if (fallback != nullptr && !(read_.is_object(*fallback, path, material_keys()) &&
                                 read_material(*fallback, path, scene_.options.materials.fallback))) {
      return false;
    }
    return read_.optional_boolean(*value, "materials", "by_name", scene_.has_materials_by_name) &&
           read_list(*this, *value, "materials.regions", &SceneBodyReader::read_region_material);
  }
  static std::vector<std::string_view> material_keys() {
    return {"material",   "density", "young", "poisson",     "toughness", "cut_friction",
            "stiffening", "rupture", "fibre", "fibre_young", "prony",     "rigid"};
  }
  bool read_region_material(const JsonValue& value, const std::string& path) {
    std::vector<std::string_view> keys = material_keys();
    keys.emplace_back("region");
    const JsonValue* region = read_.is_object(value, path, keys) ? read_.member(value, path, "region") : nullptr;
    if (region == nullptr) return false;
    Material material = scene_.options.materials.fallback;
    return read_material(value, path, material) &&
           (region->kind == JsonValue::Kind::kString ? add_named(*region, path + ".region", material)
                                                     : add_numbered(value, path, material));
  }
  bool add_numbered(const JsonValue& value, const std::string& path, const Material& material) {
    Materials& all = scene_.options.materials;
    Materials::Entry entry{0, material};
    if (!read_region(value, path, entry.region)) return false;
    for (const Materials::Entry& other : all.by_region) {
      if (other.region == entry.region) return read_.fail(value, path + ".region", "is named before; name it once");
    }
    all.by_region.push_back(entry);
    return true;
  }
  bool add_named(const JsonValue& region, const std::string& path, const Material& material) {
    std::string name;
    if (!read_.text(region, path, name)) return false;
    if (name.empty()) return read_.fail(region, path, "is empty; give a region's number or its name");
    for (const NamedMaterial& other : scene_.named_materials) {
      if (other.region == name) return read_.fail(region, path, "is named before; name it once");
    }
    scene_.named_materials.push_back({name, material});
    return true;
  }
  /// A tissue by name, and what the scene says otherwise.
  bool read_material(const JsonValue& value, const std::string& path, Material& material) {
    return read_tissue(value, path, material) &&
           read_.optional_ranged(value, path, "density", kBoundedAbove0, material.density) &&
           read_.optional_ranged(value, path, "young", kBoundedAbove0, material.young) &&
           read_.optional_ranged(value, path, "poisson", {0, kMaxPoisson}, material.poisson) &&
           read_.optional_ranged(value, path, "toughness", kBoundedAtLeast0, material.toughness) &&
           read_.optional_ranged(value, path, "cut_friction", kBoundedAtLeast0, material.cut_friction) &&
           read_.optional_ranged(value, path, "stiffening", {0, 100}, material.stiffening) &&
           read_.optional_ranged(value, path, "rupture", {0, 0.5}, material.rupture) &&
           read_.optional_boolean(value, path, "rigid", material.rigid) && read_fibres(value, path, material) &&
           read_prony(value.find("prony"), path + ".prony", material);
  }
  bool read_fibres(const JsonValue& value, const std::string& path, Material& material) {
    const JsonValue* fibre = value.find("fibre");
    if (!read_.optional_ranged(value, path, "fibre_young", kBoundedAtLeast0, material.fibre_young) ||
        (fibre != nullptr && !read_.numbers(*fibre, path + ".fibre", material.fibre.data(), 3))) {
      return false;
    }
    const auto [x, y, z] = material.fibre;
    if (!(material.fibre_young > 0) || x * x + y * y + z * z > 0) return true;
    return read_.fail(value, path, "has \"fibre_young\", but no direction; give it \"fibre\": [x,y,z]");
  }
  bool read_prony(const JsonValue* list, const std::string& path, Material& material) {
    if (list == nullptr) return true;
    material.prony = {};
    if (!read_.is_array(*list, path, 0, material.prony.size())) return false;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      const JsonValue& item = list->items[i];
      if (!read_.is_object(item, at(path, i), {"share", "seconds"}) ||
          !read_.need_ranged(item, at(path, i), "share", {0, 100}, material.prony[i].share) ||
          !read_.need_ranged(item, at(path, i), "seconds", {1e-4, 1e4}, material.prony[i].seconds)) {
        return false;
      }
    }
    return true;
  }
  bool read_tissue(const JsonValue& value, const std::string& path, Material& material) {
    const JsonValue* name = value.find("material");
    std::string text;
    if (name == nullptr) return true;
    if (!read_.text(*name, path + ".material", text)) return false;
    const Tissue* tissue = find_tissue(text);
    if (tissue != nullptr) return material = tissue->material, true;
    std::string known;
    for (const Tissue& t : tissues()) known += (known.empty() ? "" : ", ") + std::string(t.name);
    return read_.fail(*name, path + ".material", "is no tissue that Incise knows; take one of " + known);
  }
  bool read_stretch(const JsonValue& root) {
    if (!read_.optional_point(root, "", "stretch", scene_.stretch)) return false;
    const bool is_fit = scene_.stretch.minCoeff() >= kLeastStretch && scene_.stretch.maxCoeff() <= kMostStretch;
    return is_fit || read_.fail(*root.find("stretch"), "stretch", "must lie in [0.5, 2] on every axis; 1: as it is");
  }
  bool read_attachment(const JsonValue& value, const std::string& path) {
    Attachment& held = scene_.attachments.emplace_back();
    return read_.is_object(value, path, {"box", "ball", "below", "surface", "stiffness", "strength", "tears"}) &&
           has_one(value, path, {"box", "ball", "below"}) && read_where(value, path, held.where) &&
           read_.optional_boolean(value, path, "surface", held.surface_only) &&
           read_.optional_ranged(value, path, "stiffness", kBoundedAbove0, held.stiffness) &&
           read_.optional_ranged(value, path, "strength", kBoundedAbove0, held.strength) &&
           read_.optional_boolean(value, path, "tears", held.tears) && is_pin(value, path, held);
  }
  /// What is held rigidly bears all.
  bool is_pin(const JsonValue& value, const std::string& path, const Attachment& held) {
    return std::isfinite(held.stiffness) || !std::isfinite(held.strength) ||
           read_.fail(value, path, "has a strength, but holds rigidly; give it a \"stiffness\"");
  }
  bool read_where(const JsonValue& value, const std::string& path, ScenePlace& where) {
    if (const JsonValue* box = value.find("box")) return read_hold_box(*box, path + ".box", where.emplace<Box>());
    if (const JsonValue* ball = value.find("ball")) {
      return read_.is_object(*ball, path + ".ball", {"centre", "radius"}) &&
             read_ball(*ball, path + ".ball", where.emplace<BallTool>());
    }
    return read_plane(*value.find("below"), path + ".below", where.emplace<HalfSpace>());
  }
  bool read_hold_box(const JsonValue& value, const std::string& path, Box& box) {
    if (!read_.is_object(value, path, {"low", "high"}) || !read_.need_point(value, path, "low", box.lo) ||
        !read_.need_point(value, path, "high", box.hi)) {
      return false;
    }
    return !box.is_empty() || read_.fail(value, path, "has a low corner that is not below its high corner");
  }
  bool read_ball(const JsonValue& value, const std::string& path, BallTool& ball) {
    return read_.need_point(value, path, "centre", ball.centre) &&
           read_.need_ranged(value, path, "radius", kBoundedAbove0, ball.radius);
  }
};

/// How it is computed.
class SceneOptionsReader : public SceneBodyReader {
 public:
  using SceneBodyReader::SceneBodyReader;

  bool read_options(const JsonValue& root) {
    SimulationOptions& options = scene_.options;
    return read_.optional_ranged(root, "", "frame_seconds", {0, 1, true}, options.frame_seconds) &&
           read_settle(root.find("settle")) && read_solver(root.find("solver")) && read_cut(root.find("cut")) &&
           read_maintain(root.find("maintain")) && read_contact(root.find("contact"));
  }

 private:
  bool read_settle(const JsonValue* value) {
    if (value == nullptr) return true;
    std::uint64_t frames = 0;
    if (!read_.is_object(*value, "settle", {"frames", "speed"}) ||
        read_.member(*value, "settle", "frames") == nullptr ||
        !read_.optional_whole(*value, "settle", "frames", 0, 100'000, frames)) {
      return false;
    }
    scene_.settle.frames = static_cast<std::uint32_t>(frames);
    return read_.optional_ranged(*value, "settle", "speed", kBoundedAbove0, scene_.settle.speed);
  }
  bool read_solver(const JsonValue* value) {
    if (value == nullptr) return true;
    BodyOptions& body = scene_.options.body;
    std::string name = "block-descent";
    std::uint64_t substeps = body.substeps;
    std::uint64_t iterations = body.iterations;
    if (!read_.is_object(*value, "solver", {"relaxation", "substeps", "iterations", "average_volumes"}) ||
        !read_.optional_text(*value, "solver", "relaxation", name) ||
        !read_.optional_whole(*value, "solver", "substeps", 1, 1000, substeps) ||
        !read_.optional_whole(*value, "solver", "iterations", 1, 1000, iterations) ||
        !read_.optional_boolean(*value, "solver", "average_volumes", body.average_volumes)) {
      return false;
    }
    body.substeps = static_cast<unsigned>(substeps);
    body.iterations = static_cast<unsigned>(iterations);
    body.relaxation = name == "block-descent" ? Relaxation::kBlockDescent : Relaxation::kPositionBased;
    return name == "block-descent" || name == "position-based" ||
           read_.fail(*value, "solver.relaxation", R"(must be "block-descent" or "position-based")");
  }
  bool read_cut(const JsonValue* value) {
    if (value == nullptr) return true;
    CutOptions& cut = scene_.options.engine.cut;
    std::string profile = "incise";
    if (!read_.is_object(*value, "cut", {"snap", "profile"}) ||
        !read_.optional_ranged(*value, "cut", "snap", {0, kMaxSnap}, cut.snap) ||
        !read_.optional_text(*value, "cut", "profile", profile)) {
      return false;
    }
    cut.profile = profile == "paper" ? Profile::kPaper : Profile::kIncise;
    return profile == "incise" || profile == "paper" ||
           read_.fail(*value, "cut.profile", R"(must be "incise" or "paper")");
  }
  bool read_maintain(const JsonValue* value) {
    if (value == nullptr) return true;
    MaintainOptions& maintain = scene_.options.engine.maintain;
    const JsonValue* units = value->find("work_units");
    const bool is_unlimited = units != nullptr && units->kind == JsonValue::Kind::kNull;
    if (is_unlimited) maintain.work_units = kUnlimitedWork;
    return read_.is_object(*value, "maintain", {"merge", "improve", "work_units"}) &&
           read_.optional_boolean(*value, "maintain", "merge", maintain.merge) &&
           read_.optional_boolean(*value, "maintain", "improve", maintain.improve) &&
           (is_unlimited ||
            read_.optional_whole(*value, "maintain", "work_units", 0, kUnlimitedWork, maintain.work_units));
  }
  bool read_contact(const JsonValue* value) {
    if (value == nullptr) return true;
    SimulationOptions& options = scene_.options;
    return read_.is_object(*value, "contact", {"stiffness", "flat_height", "self", "friction"}) &&
           read_.optional_boolean(*value, "contact", "self", options.body.self.on) &&
           read_.optional_ranged(*value, "contact", "friction", kBoundedAtLeast0, options.body.self.friction) &&
           read_.optional_ranged(*value, "contact", "stiffness", kBoundedAtLeast0, options.contact_stiffness) &&
           read_.optional_ranged(*value, "contact", "flat_height", kBoundedAtLeast0, options.flat_height);
  }
};

/// What is done to it: tools, hooks, strokes.
class SceneHandsReader : public SceneOptionsReader {
 public:
  using SceneOptionsReader::SceneOptionsReader;

  bool read_hands(const JsonValue& root) {
    return read_list(*this, root, "tools", &SceneHandsReader::read_tool) &&
           read_list(*this, root, "hooks", &SceneHandsReader::read_hook) &&
           read_list(*this, root, "sutures", &SceneHandsReader::read_suture) &&
           read_list(*this, root, "strokes", &SceneHandsReader::read_blade_entry) &&
           read_list(*this, root, "spare", &SceneHandsReader::read_spare);
  }

 protected:
  /// `tool` stays as it is where the value has none.
  bool read_tool_name(const JsonValue& value, const std::string& path, bool has_to_cut, std::optional<ToolKind>& tool) {
    std::string name;
    const JsonValue* given = value.find("tool");
    if (given == nullptr) return true;
    if (!read_.optional_text(value, path, "tool", name)) return false;
    tool = tool_named(name);
    if (tool && (!has_to_cut || row_of(*tool).cuts)) return true;
    return read_.fail(*given, under(path, "tool"), "must be one of " + scene_tool_names(has_to_cut));
  }
  /// A time that is 0 or more, and after the one before it.
  bool read_time(const JsonValue& value, const std::string& path, std::vector<double>& times) {
    double t = 0;
    if (!read_.need_ranged(value, path, "t", kBoundedAtLeast0, t)) return false;
    if (!times.empty() && !(t > times.back())) {
      return read_.fail(*value.find("t"), path + ".t", "must be later than the time before it; sort the times");
    }
    times.push_back(t);
    return true;
  }
  /// Reads every key of the path of a tool or hook.
  template <class ReadKey>
  bool read_path(const JsonValue& owner, const std::string& owner_path, const ReadKey& read_key) {
    const JsonValue* list = read_.member(owner, owner_path, "path");
    const std::string path = owner_path + ".path";
    if (list == nullptr || !read_.is_array(*list, path, 2, kMaxBladePoints)) return false;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      if (!read_key(list->items[i], at(path, i))) return false;
    }
    return true;
  }
  bool read_tool(const JsonValue& value, const std::string& path) {
    SceneTool& tool = scene_.tools.emplace_back();
    std::vector<std::string_view> kinds = {"plane"};
    for_each_tool_kind([&](const auto& shape) {
      if (shape.kMoves) kinds.emplace_back(shape.kName);
    });
    std::vector<std::string_view> keys = {"name"};
    keys.insert(keys.end(), kinds.begin(), kinds.end());
    if (!read_.is_object(value, path, keys) || !has_one(value, path, kinds) ||
        !read_.optional_text(value, path, "name", tool.name)) {
      return false;
    }
    if (const JsonValue* plane = value.find("plane")) return read_plane_tool(*plane, path + ".plane", tool);
    bool is_read = false;
    for_each_tool_kind([&](auto shape) {
      const JsonValue* given = shape.kMoves ? value.find(shape.kName) : nullptr;
      if (given != nullptr) is_read = read_moving_tool(*given, path + "." + shape.kName, shape, tool);
    });
    return is_read;
  }
  bool read_plane_tool(const JsonValue& value, const std::string& path, SceneTool& tool) {
    HalfSpace plane;
    if (!read_plane(value, path, plane)) return false;
    const double length = plane.normal.norm();
    const bool is_unit = std::abs(length - 1) < 1e-12;  // then it stays as it is, bit for bit
    tool.keys.emplace_back(PlaneTool{is_unit ? plane.normal : Vec3(plane.normal / length),
                                     is_unit ? plane.offset : plane.offset / length});
    return true;
  }
  /// A tool with numbers above 0 and points, which may go along a path: then each key of it has them all.
  template <class Shape>
  bool read_moving_tool(const JsonValue& value, const std::string& path, Shape& shape, SceneTool& tool) {
    std::vector<std::string_view> points, keys;
    bool is_read = true;
    Shape::for_each_field(shape, [&](const char* name, const auto& field) {
      (std::is_same_v<std::decay_t<decltype(field)>, Vec3> ? points : keys).emplace_back(name);
    });
    keys.insert(keys.end(), points.begin(), points.end());
    keys.emplace_back("path");
    if (!read_.is_object(value, path, keys) || !has_one(value, path, {points.front(), "path"})) return false;
    Shape::for_each_field(shape, [&](const char* name, auto& field) {
      if constexpr (std::is_same_v<std::decay_t<decltype(field)>, double>) {
        is_read = is_read && read_.need_ranged(value, path, name, kBoundedAbove0, field);
      }
    });
    const auto read_key = [&](const JsonValue& key, const std::string& where) {
      bool is_key_read = true;
      Shape::for_each_field(shape, [&](const char* name, auto& field) {
        if constexpr (std::is_same_v<std::decay_t<decltype(field)>, Vec3>) {
          is_key_read = is_key_read && read_.need_point(key, where, name, field);
        }
      });
      return is_key_read && (tool.keys.emplace_back(shape), true);
    };
    if (!is_read) return false;
    if (value.find("path") == nullptr) return read_key(value, path);
    for (const std::string_view point : points) {
      if (value.find(point) != nullptr) {
        return read_.fail(value, path, "has \"" + std::string(point) + "\" beside \"path\"; put it into the path");
      }
    }
    points.insert(points.begin(), "t");
    return read_path(value, path, [&](const JsonValue& key, const std::string& where) {
      return read_.is_object(key, where, points) && read_time(key, where, tool.times) && read_key(key, where);
    });
  }
  bool read_hook(const JsonValue& value, const std::string& path) {
    SceneHook& hook = scene_.hooks.emplace_back();
    return read_.is_object(value, path, {"name", "radius", "stiffness", "strength", "tears", "path"}) &&
           read_.optional_text(value, path, "name", hook.name) &&
           read_.need_ranged(value, path, "radius", kBoundedAbove0, hook.radius) &&
           read_.optional_ranged(value, path, "stiffness", kBoundedAbove0, hook.stiffness) &&
           read_.optional_ranged(value, path, "strength", kBoundedAbove0, hook.strength) &&
           read_.optional_boolean(value, path, "tears", hook.tears) &&
           read_path(value, path, [&](const JsonValue& key, const std::string& where) {
             return read_.is_object(key, where, {"t", "position"}) && read_time(key, where, hook.times) &&
                    read_.need_point(key, where, "position", hook.positions.emplace_back());
           });
  }
  bool read_suture(const JsonValue& value, const std::string& path) {
    SceneSuture& suture = scene_.sutures.emplace_back();
    return read_.is_object(value, path,
                           {"name", "from", "to", "stiffness", "rest_length", "pushes", "strength", "start"}) &&
           read_.optional_text(value, path, "name", suture.name) &&
           read_.need_point(value, path, "from", suture.from) && read_.need_point(value, path, "to", suture.to) &&
           (suture.from != suture.to || read_.fail(value, path, "has both ends in one place; move \"to\"")) &&
           read_.optional_ranged(value, path, "stiffness", kBoundedAbove0, suture.stiffness) &&
           read_.optional_ranged(value, path, "rest_length", kBoundedAtLeast0, suture.rest_length) &&
           read_.optional_boolean(value, path, "pushes", suture.pushes) &&
           read_.optional_ranged(value, path, "strength", kBoundedAbove0, suture.strength) &&
           read_.optional_ranged(value, path, "start", {0, kLatestStart}, suture.start);
  }
  bool read_spare(const JsonValue& value, const std::string& path) {
    SpareRule& rule = scene_.spare.emplace_back();
    if (!read_.is_object(value, path, {"tool", "stop_at"}) || !read_tool_name(value, path, true, rule.tool) ||
        !read_stops(read_, value, path, rule.stop_at, rule.stop_names)) {
      return false;
    }
    if (rule.stop_at.empty() && rule.stop_names.empty()) {
      return read_.fail(value, path, "names no regions; give them as \"stop_at\"");
    }
    return true;
  }
  /// How the strokes of one blade lie in time.
  struct Timing {
    double start = 0, stretch = 1, pause = 0.1;
  };
  bool read_blade_entry(const JsonValue& value, const std::string& path) {
    return read_blade_entry(value, path, scene_.strokes);
  }
  /// Appends the strokes of one blade.
  bool read_blade_entry(const JsonValue& value, const std::string& path, std::vector<SceneStroke>& out) {
    std::vector<BladeStroke> strokes;
    Timing timing;
    Vec3 direction = Vec3::Zero();
    SceneStroke stop;
    if (!read_.is_object(value, path, {"blade", "start", "stretch", "pause", "direction", "slicing", "stop_at"}) ||
        !read_blade_of(value, path, strokes) ||
        !read_.optional_ranged(value, path, "start", kBoundedAtLeast0, timing.start) ||
        !read_.optional_ranged(value, path, "stretch", {0, kMaxStretch, true}, timing.stretch) ||
        !read_.optional_ranged(value, path, "pause", kBoundedAtLeast0, timing.pause) ||
        !read_.optional_point(value, path, "direction", direction) ||
        !read_.optional_ranged(value, path, "slicing", {0, BladePose::kMostSlicing}, stop.slicing) ||
        !read_stops(read_, value, path, stop.stop_at, stop.stop_names)) {
      return false;
    }
    double earliest = -std::numeric_limits<double>::infinity();
    for (auto& [stroke, stop_at, stop_names] : strokes) {
      place_in_time(timing, earliest, stroke.times);
      earliest = stroke.times.back() + timing.pause;
      if (!is_fit(value, path, stroke, out)) return false;
      // Its own, and those of the whole blade.
      stop_at.insert(stop_at.end(), stop.stop_at.begin(), stop.stop_at.end());
      stop_names.insert(stop_names.end(), stop.stop_names.begin(), stop.stop_names.end());
      out.push_back({std::move(stroke), direction, std::move(stop_at), std::move(stop_names), stop.slicing});
    }
    return true;
  }
  /// A blade file by its path, or strokes.
  bool read_blade_of(const JsonValue& value, const std::string& path, std::vector<BladeStroke>& strokes) {
    const JsonValue* blade = read_.member(value, path, "blade");
    if (blade == nullptr) return false;
    if (blade->kind != JsonValue::Kind::kString) return read_strokes(read_, *blade, path + ".blade", strokes);
    Result<std::vector<BladeStroke>> found =
        read_blade_file(find_named(scene_.folder, blade->text).value_or(blade->text));
    if (!found.ok()) {
      return read_.fail(*blade, path + ".blade", "names a file that cannot be taken: " + found.error().message);
    }
    strokes = std::move(found).value();
    return true;
  }
  static void place_in_time(const Timing& timing, double earliest, std::vector<double>& times) {
    for (double& t : times) t = timing.start + timing.stretch * t;
    const double delay = earliest - times.front();
    if (!(delay > 0)) return;
    for (double& t : times) t += delay;
  }
  bool is_fit(const JsonValue& value, const std::string& path, const Stroke& stroke,
              const std::vector<SceneStroke>& others) {
    const double frame = scene_.options.frame_seconds;
    const double first = stroke.times.front();
    const bool has_times = stroke.times.size() > 1;  // else it lasts no frame
    if (has_times && !check(stroke).ok())
      return read_.fail(value, path, "has times that are equal in the scene; stretch them");
    if (!(first >= 0)) return read_.fail(value, path, "begins before 0 s; start it later");
    if (!(stroke.times.back() - first >= frame)) {
      return read_.fail(value, path, "lasts less than a frame; stretch it, or give it two times");
    }
    if (others.empty()) return true;
    const double before = others.back().stroke.times.back();
    if (first - before >= kFramesBetweenStrokes * frame) return true;
    return read_.fail(value, path,
                      "begins at " + short_number(first) + " s, but the stroke before it ends at " +
                          short_number(before) + " s; leave two frames between strokes, in order of time");
  }
};

/// What a trainee shall do.
class SceneExerciseReader : public SceneHandsReader {
 public:
  using SceneHandsReader::SceneHandsReader;

  bool read_exercise(const JsonValue* value) {
    if (value == nullptr) return true;
    const std::string path = "exercise";
    Exercise& exercise = scene_.exercise.emplace();
    std::uint64_t strokes = exercise.strokes;
    if (!read_.is_object(*value, path,
                         {"name", "instructions", "target", "depth", "angle", "tolerances", "max_force", "strokes",
                          "ideal", "divide", "spare", "remove", "pass"}) ||
        !read_.optional_text(*value, path, "name", exercise.name) ||
        !read_.optional_text(*value, path, "instructions", exercise.instructions) ||
        !read_target(*value, path, exercise) ||
        !read_.need_ranged(*value, path, "depth", kBoundedAbove0, exercise.depth) ||
        !read_.optional_ranged(*value, path, "angle", {0, kSteepestAngle}, exercise.angle) ||
        !read_tolerances(*value, path + ".tolerances", exercise) ||
        !read_.optional_ranged(*value, path, "max_force", kBoundedAtLeast0, exercise.max_force) ||
        !read_.optional_whole(*value, path, "strokes", 1, kMaxSceneItems, strokes) ||
        !read_.optional_ranged(*value, path, "pass", {0, kAllPoints}, exercise.pass) || !read_goals(*value, path)) {
      return false;
    }
    exercise.strokes = static_cast<std::uint32_t>(strokes);
    return read_ideal(value->find("ideal"), path + ".ideal", exercise.ideal);
  }

 private:
  bool read_target(const JsonValue& value, const std::string& path, Exercise& exercise) {
    const JsonValue* target = read_.member(value, path, "target");
    if (target == nullptr || !read_.points(*target, path + ".target", kMaxTargetPoints, exercise.target)) return false;
    for (std::size_t i = 1; i < exercise.target.size(); ++i) {
      const double length = (exercise.target[i] - exercise.target[i - 1]).norm();
      if (length > 0 && std::isfinite(length)) continue;
      return read_.fail(target->items[i], at(path + ".target", i), "must be apart from the point before it");
    }
    return true;
  }
  bool read_tolerances(const JsonValue& value, const std::string& path, Exercise& exercise) {
    ExerciseTolerances& allowed = exercise.tolerances;
    double length = 0;
    for (std::size_t i = 1; i < exercise.target.size(); ++i) {
      length += (exercise.target[i] - exercise.target[i - 1]).norm();
    }
    allowed.line = kLineTolerance * length;
    allowed.depth = kDepthTolerance * exercise.depth;
    const JsonValue* given = value.find("tolerances");
    if (given == nullptr) return true;
    return read_.is_object(*given, path, {"line", "depth", "angle", "force"}) &&
           read_.optional_ranged(*given, path, "line", kBoundedAbove0, allowed.line) &&
           read_.optional_ranged(*given, path, "depth", kBoundedAbove0, allowed.depth) &&
           read_.optional_ranged(*given, path, "angle", {0, 90, true}, allowed.angle) &&
           read_.optional_ranged(*given, path, "force", kBoundedAtLeast0, allowed.force);
  }
  /// What becomes of regions.
  bool read_goals(const JsonValue& value, const std::string& path) {
    Exercise& exercise = *scene_.exercise;
    if (const JsonValue* divide = value.find("divide")) {
      const std::string at_divide = path + ".divide";
      if (!read_.is_object(*divide, at_divide, {"regions", "name"}) ||
          !read_regions(*divide, at_divide, exercise.divide.emplace())) {
        return false;
      }
    }
    const JsonValue* remove = value.find("remove");
    return read_list(*this, value, path + ".spare", &SceneExerciseReader::read_goal_spare) &&
           (remove == nullptr || read_remove(*remove, path + ".remove", exercise.remove.emplace()));
  }
  bool read_regions(const JsonValue& value, const std::string& path, ExerciseRegions& goal) {
    return read_.member(value, path, "regions") != nullptr &&
           app::read_regions(read_, value, path, "regions", goal.stop_at, goal.stop_names) &&
           read_.optional_text(value, path, "name", goal.name);
  }
  bool read_goal_spare(const JsonValue& value, const std::string& path) {
    ExerciseSpare& spare = scene_.exercise->spare.emplace_back();
    return read_.is_object(value, path, {"regions", "name", "depth"}) && read_regions(value, path, spare) &&
           read_.optional_ranged(value, path, "depth", kBoundedAtLeast0, spare.depth);
  }
  bool read_remove(const JsonValue& value, const std::string& path, ExerciseRemove& remove) {
    return read_.is_object(value, path, {"regions", "name", "share", "margin", "volume"}) &&
           read_regions(value, path, remove) &&
           read_.optional_ranged(value, path, "share", {0, 1, true}, remove.share) &&
           read_span(value, path, "margin", remove.margin) && read_span(value, path, "volume", remove.volume);
  }
  /// The least and the greatest of something.
  bool read_span(const JsonValue& value, const std::string& path, const std::string& key,
                 std::optional<std::array<double, 2>>& out) {
    const JsonValue* span = value.find(key);
    if (span == nullptr) return true;
    std::array<double, 2>& ends = out.emplace();
    const std::string place = path + "." + key;
    if (!read_.numbers(*span, place, ends.data(), 2)) return false;
    return (ends[0] >= 0 && ends[0] < ends[1]) ||
           read_.fail(*span, place, "must be the least and the greatest, [least,greatest], at least 0 and rising");
  }
  /// One of the scene's strokes by its number, or a blade.
  bool read_ideal(const JsonValue* value, const std::string& path, std::vector<SceneStroke>& ideal) {
    if (value == nullptr) return true;
    if (value->kind == JsonValue::Kind::kObject) return read_blade_entry(*value, path, ideal);
    if (!value->is_whole || value->whole >= scene_.strokes.size()) {
      return read_.fail(*value, path, "must be the number of one of the scene's strokes, from 0, or a blade");
    }
    ideal.push_back(scene_.strokes[static_cast<std::size_t>(value->whole)]);
    return true;
  }
};

/// How it is first seen.
class SceneViewReader : public SceneExerciseReader {
 public:
  using SceneExerciseReader::SceneExerciseReader;

  bool read_view(const JsonValue* value) {
    if (value == nullptr) return true;
    SceneView& view = scene_.view.emplace();
    return read_.is_object(*value, "view",
                           {"from", "up", "target", "distance", "zoom", "color", "wireframe", "opacity", "theme",
                            "clip", "look", "drapes", "demonstration"}) &&
           read_direction(*value, "from", view.from) && read_direction(*value, "up", view.up) &&
           read_eye(*value, view) && read_.optional_ranged(*value, "view", "zoom", kBoundedAbove0, view.zoom) &&
           read_name(*value, "color", kColorNames, view.color) &&
           read_.optional_boolean(*value, "view", "wireframe", view.shows_wireframe) &&
           read_.optional_ranged(*value, "view", "opacity", {0, 1, true}, view.skin_opacity) &&
           read_name(*value, "theme", kThemeNames, view.theme) && read_name(*value, "look", kLookNames, view.look) &&
           read_.optional_boolean(*value, "view", "drapes", view.has_drapes) &&
           read_.optional_boolean(*value, "view", "demonstration", view.is_demonstration) &&
           read_clip(value->find("clip"), view);
  }

 private:
  bool read_eye(const JsonValue& value, SceneView& view) {
    const JsonValue* target = value.find("target");
    const JsonValue* distance = value.find("distance");
    return (target == nullptr || read_.numbers(*target, "view.target", view.target.emplace().data(), 3)) &&
           (distance == nullptr || read_.ranged(*distance, "view.distance", kBoundedAbove0, view.distance.emplace()));
  }
  bool read_direction(const JsonValue& view, const std::string& key, std::optional<Vec3>& out) {
    const JsonValue* value = view.find(key);
    if (value == nullptr) return true;
    if (!read_.numbers(*value, "view." + key, out.emplace().data(), 3)) return false;
    return !out->isZero(0) || read_.fail(*value, "view." + key, "is zero; give a direction [x,y,z]");
  }
  bool read_clip(const JsonValue* value, SceneView& view) {
    return value == nullptr || read_plane(*value, "view.clip", view.clip.emplace());
  }
  /// One of the names of an enumeration, in the order of its values.
  template <class Names, class Enum>
  bool read_name(const JsonValue& view, const std::string& key, const Names& names, Enum& out) {
    std::string name(names[static_cast<std::size_t>(out)]);
    if (!read_.optional_text(view, "view", key, name)) return false;
    std::string all;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == name) return out = static_cast<Enum>(i), true;
      all += (i > 0 ? ", " : "") + std::string(names[i]);
    }
    return read_.fail(*view.find(key), "view." + key, "must be one of " + all);
  }
};

/// What a person begins with.
class SceneHandReader : public SceneViewReader {
 public:
  using SceneViewReader::SceneViewReader;

  bool read_hand(const JsonValue* value) {
    if (value == nullptr) return true;
    HandPreset& hand = scene_.hand.emplace();
    constexpr Range kTilt{-HandPreset::kMostTilt, HandPreset::kMostTilt};
    return read_.is_object(*value, "hand", {"tool", "depth", "angle", "ring", "grip"}) &&
           read_tool_name(*value, "hand", false, hand.tool) && read_if(*value, "depth", kBoundedAbove0, hand.depth) &&
           read_if(*value, "angle", kTilt, hand.angle) && read_if(*value, "ring", kBoundedAbove0, hand.ring) &&
           read_if(*value, "grip", kBoundedAbove0, hand.grip);
  }

 private:
  bool read_if(const JsonValue& hand, std::string_view key, const Range& range, std::optional<double>& out) {
    const JsonValue* value = hand.find(key);
    return value == nullptr || read_.ranged(*value, under("hand", key), range, out.emplace());
  }
};

/// The whole scene. Its readers come one on top of the other, since an exercise names the strokes before it.
class SceneReader : public SceneHandReader {
 public:
  using SceneHandReader::SceneHandReader;

  Result<Scene> run(const JsonValue& root) {
    if (read_header(root) && read_body(root) && read_options(root) && read_hands(root) &&
        read_exercise(root.find("exercise")) && read_frames(root) && read_view(root.find("view")) &&
        read_hand(root.find("hand"))) {
      return std::move(scene_);
    }
    return read_.error();
  }

 private:
  bool read_header(const JsonValue& root) {
    return read_.is_format(root, "incise-scene", kSceneVersion) &&
           read_.is_object(
               root, "", {"format",        "version",     "name",    "model",   "length_unit", "materials", "gravity",
                          "damping",       "attachments", "tools",   "hooks",   "strokes",     "frames",    "duration",
                          "frame_seconds", "settle",      "seed",    "solver",  "cut",         "maintain",  "contact",
                          "view",          "exercise",    "sutures", "stretch", "spare",       "hand"}) &&
           read_.optional_text(root, "", "name", scene_.name) &&
           read_.optional_whole(root, "", "seed", 0, std::numeric_limits<std::uint64_t>::max(), scene_.seed);
  }
  bool read_frames(const JsonValue& root) {
    const bool has_frames = root.find("frames") != nullptr;
    double duration = last_key_time() + kTail;
    if (has_frames && root.find("duration") != nullptr) {
      return read_.fail(root, "", "has both \"frames\" and \"duration\"; give one");
    }
    if (has_frames) return read_.optional_whole(root, "", "frames", 1, kMaxSceneFrames, scene_.frames);
    const double longest = static_cast<double>(kMaxSceneFrames) * scene_.options.frame_seconds;
    if (!read_.optional_ranged(root, "", "duration", {0, longest, true}, duration)) return false;
    if (!(duration <= longest)) return read_.fail(root, "", "has key times beyond the last possible frame");
    scene_.frames =
        static_cast<std::uint64_t>(std::max(1.0, std::ceil(duration / scene_.options.frame_seconds - 1e-9)));
    return true;
  }
  [[nodiscard]] double last_key_time() const {
    double last = 0;
    for (const SceneStroke& s : scene_.strokes) last = std::max(last, s.stroke.times.back());
    for (const SceneHook& hook : scene_.hooks) last = std::max(last, hook.times.back());
    for (const SceneSuture& suture : scene_.sutures) last = std::max(last, suture.start);
    for (const SceneTool& tool : scene_.tools) last = std::max(last, tool.times.empty() ? 0 : tool.times.back());
    return last;
  }
};

}  // namespace

Result<Scene> read_scene_tree(const JsonValue& root, std::string_view file_name, const fs::path& folder,
                              const std::string& place) {
  return SceneReader(file_name, folder, place).run(root);
}

Result<Scene> parse_scene(std::string_view json, std::string_view file_name, const fs::path& folder) {
  const Result<JsonValue> root = parse_json(json, file_name);
  if (!root.ok()) return root.error();
  return read_scene_tree(*root, file_name, folder);
}

Result<Scene> read_scene(const fs::path& path) {
  const Result<std::string> text = read_text_file(path, JsonLimits{}.max_bytes);
  if (!text.ok()) return text.error();
  return parse_scene(*text, path.string(), path.parent_path());
}

}  // namespace app
}  // namespace v0
}  // namespace incise
