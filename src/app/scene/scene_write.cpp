// SPDX-License-Identifier: Apache-2.0
// The inverse of the reader: what has its default is left out where the reader puts it in again, so that scenes stay
// as short as people write them.
#include "app/scene/scene_write.h"

#include <cmath>

#include "app/scene/view_names.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

Json json_of(const HalfSpace& plane) {
  return Json::array({plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset});
}

/// A mesh file or a box.
Json json_of_shape(const std::string& file, const SceneBox& box) {
  if (!file.empty()) return {{"file", file}};
  return {{"box",
           {{"cells", box.cells}, {"size", encode(box.size)}, {"origin", encode(box.origin)}, {"jitter", box.jitter}}}};
}

struct EncodeWhere {
  Json operator()(const Box& box) const { return {{"box", {{"low", encode(box.lo)}, {"high", encode(box.hi)}}}}; }
  Json operator()(const BallTool& ball) const {
    return {{"ball", {{"centre", encode(ball.centre)}, {"radius", ball.radius}}}};
  }
  Json operator()(const HalfSpace& plane) const { return {{"below", json_of(plane)}}; }
};

Json json_of(const SceneModel& model) {
  Json root = json_of_shape(model.file, model.box);
  if (!model.surface.empty()) root["surface"] = model.surface;
  for (const SceneBody& body : model.bodies) {
    Json item = json_of_shape(body.file, body.box);
    item["move"] = encode(body.move);
    if (body.region) item["region"] = *body.region;
    root["bodies"].push_back(std::move(item));
  }
  root["regions"] = Json::array();
  for (const RegionPaint& paint : model.regions) {
    Json item = std::visit(EncodeWhere{}, paint.where);
    item["region"] = paint.region;
    if (!paint.name.empty()) item["name"] = paint.name;
    root["regions"].push_back(std::move(item));
  }
  return root;
}

/// Keys that few materials have; a region's must be named where it does not have what the default has.
bool has_more(const Material& material) {
  return material.fibre_young > 0 || material.is_viscous() || material.rigid ||
         material.fibre != std::array<double, 3>{};
}

void add_more(const Material& material, Json& root) {
  root["rigid"] = material.rigid;
  root["fibre"] = material.fibre;
  root["fibre_young"] = material.fibre_young;
  root["prony"] = Json::array();
  for (const PronyTerm& term : material.prony) {
    if (term.share > 0) root["prony"].push_back({{"share", term.share}, {"seconds", term.seconds}});
  }
}

void add_material(const Material& material, bool has_all, Json& root) {
  root["density"] = material.density;
  root["young"] = material.young;
  root["poisson"] = material.poisson;
  root["toughness"] = material.toughness;
  root["cut_friction"] = material.cut_friction;
  root["stiffening"] = material.stiffening;
  root["rupture"] = material.rupture;
  if (has_all || has_more(material)) add_more(material, root);
}

Json json_of_materials(const Scene& scene) {
  const Materials& materials = scene.options.materials;
  Json root;
  const bool has_all = has_more(materials.fallback);
  add_material(materials.fallback, has_all, root["default"]);
  root["regions"] = Json::array();
  for (const Materials::Entry& entry : materials.by_region) {
    Json item = {{"region", entry.region}};
    add_material(entry.material, has_all, item);
    root["regions"].push_back(std::move(item));
  }
  for (const NamedMaterial& named : scene.named_materials) {
    Json item = {{"region", named.region}};
    add_material(named.material, has_all, item);
    root["regions"].push_back(std::move(item));
  }
  if (scene.has_materials_by_name) root["by_name"] = true;
  return root;
}

Json json_of(const Attachment& held) {
  Json root = std::visit(EncodeWhere{}, held.where);
  root["surface"] = held.surface_only;
  if (std::isfinite(held.stiffness)) root["stiffness"] = held.stiffness;
  if (std::isfinite(held.strength)) root["strength"] = held.strength;
  if (held.tears) root["tears"] = true;
  return root;
}

/// Of a tool's fields the points, which change along its path, or the numbers, which do not.
void add_fields(const Tool& tool, bool wants_points, Json& root) {
  std::visit(
      [&](const auto& shape) {
        shape.for_each_field(shape, [&](const char* name, const auto& field) {
          if (std::is_same_v<std::decay_t<decltype(field)>, Vec3> == wants_points) root[name] = encode(field);
        });
      },
      tool);
}

Json json_of(const SceneTool& tool) {
  Json root = {{"name", tool.name}};
  if (const auto* plane = std::get_if<PlaneTool>(&tool.keys.front())) {
    root["plane"] = json_of(HalfSpace{plane->normal, plane->offset});
    return root;
  }
  Json& shape = root[std::visit([](const auto& key) { return key.kName; }, tool.keys.front())];
  add_fields(tool.keys.front(), false, shape);
  if (tool.times.empty()) add_fields(tool.keys.front(), true, shape);
  for (std::size_t i = 0; i < tool.times.size(); ++i) {
    Json key = {{"t", tool.times[i]}};
    add_fields(tool.keys[i], true, key);
    shape["path"].push_back(std::move(key));
  }
  return root;
}

Json json_of(const SceneHook& hook) {
  Json root = {{"name", hook.name}, {"radius", hook.radius}, {"stiffness", hook.stiffness}};
  if (std::isfinite(hook.strength)) root["strength"] = hook.strength;
  if (hook.tears) root["tears"] = true;
  for (std::size_t i = 0; i < hook.times.size(); ++i) {
    root["path"].push_back({{"t", hook.times[i]}, {"position", encode(hook.positions[i])}});
  }
  return root;
}

Json json_of(const SceneSuture& suture) {
  Json root = {{"name", suture.name},           {"from", encode(suture.from)}, {"to", encode(suture.to)},
               {"stiffness", suture.stiffness}, {"pushes", suture.pushes},     {"rest_length", suture.rest_length},
               {"start", suture.start}};
  if (std::isfinite(suture.strength)) root["strength"] = suture.strength;
  return root;
}

Json json_of(const SceneStroke& s) {
  Json stroke = {{"name", s.stroke.name}};
  for (std::size_t i = 0; i < s.stroke.times.size(); ++i) {
    stroke["edges"].push_back({{"t", s.stroke.times[i]}, {"points", encode(s.stroke.edges[i])}});
  }
  Json root = {{"blade", Json::array({std::move(stroke)})}, {"direction", encode(s.direction)}};
  if (s.slicing > 0) root["slicing"] = s.slicing;
  for (const std::int32_t region : s.stop_at) root["stop_at"].push_back(region);
  for (const std::string& name : s.stop_names) root["stop_at"].push_back(name);
  return root;
}

Json json_of(const SpareRule& rule) {
  Json root = Json::object();
  if (rule.tool) root["tool"] = scene_name_of(*rule.tool);
  for (const std::int32_t region : rule.stop_at) root["stop_at"].push_back(region);
  for (const std::string& name : rule.stop_names) root["stop_at"].push_back(name);
  return root;
}

template <class Item>
Json json_of_all(const std::vector<Item>& items) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(json_of(item));
  return list;
}

template <class Value>
void add_if(const std::optional<Value>& value, const char* key, Json& root) {
  if (value) root[key] = encode(*value);
}

Json json_of(const SceneView& view) {
  Json root = Json::object();
  add_if(view.from, "from", root);
  add_if(view.up, "up", root);
  add_if(view.target, "target", root);
  add_if(view.distance, "distance", root);
  root["zoom"] = view.zoom;
  root["color"] = name_of(view.color);
  root["wireframe"] = view.shows_wireframe;
  root["opacity"] = view.skin_opacity;
  root["theme"] = name_of(view.theme);
  if (view.look != TissueLook::kSkin) root["look"] = name_of(view.look);
  if (view.has_drapes) root["drapes"] = true;
  if (view.is_demonstration) root["demonstration"] = true;
  if (view.clip) root["clip"] = json_of(*view.clip);
  return root;
}

Json json_of(const HandPreset& hand) {
  Json root = Json::object();
  if (hand.tool) root["tool"] = scene_name_of(*hand.tool);
  add_if(hand.depth, "depth", root);
  add_if(hand.angle, "angle", root);
  add_if(hand.ring, "ring", root);
  add_if(hand.grip, "grip", root);
  return root;
}

/// The ideal as one blade: its times are the scene's already, and nothing is put off.
Json json_of_ideal(const std::vector<SceneStroke>& strokes) {
  Json root = json_of(strokes.front());
  for (std::size_t i = 1; i < strokes.size(); ++i) root["blade"].push_back(json_of(strokes[i])["blade"][0]);
  root["pause"] = 0.0;
  return root;
}

Json json_of(const ExerciseRegions& goal) {
  Json root = {{"regions", Json::array()}};
  for (const std::int32_t region : goal.stop_at) root["regions"].push_back(region);
  for (const std::string& name : goal.stop_names) root["regions"].push_back(name);
  if (!goal.name.empty()) root["name"] = goal.name;
  return root;
}

void add_goals(const Exercise& exercise, Json& root) {
  if (exercise.divide) root["divide"] = json_of(*exercise.divide);
  for (const ExerciseSpare& spare : exercise.spare) {
    Json item = json_of(static_cast<const ExerciseRegions&>(spare));
    item["depth"] = spare.depth;
    root["spare"].push_back(std::move(item));
  }
  if (!exercise.remove) return;
  Json& remove = root["remove"] = json_of(static_cast<const ExerciseRegions&>(*exercise.remove));
  remove["share"] = exercise.remove->share;
  if (exercise.remove->margin) remove["margin"] = *exercise.remove->margin;
  if (exercise.remove->volume) remove["volume"] = *exercise.remove->volume;
}

Json json_of(const Exercise& exercise) {
  const ExerciseTolerances& allowed = exercise.tolerances;
  Json root = {{"name", exercise.name},
               {"instructions", exercise.instructions},
               {"target", encode(exercise.target)},
               {"depth", exercise.depth},
               {"angle", exercise.angle},
               {"tolerances",
                {{"line", allowed.line}, {"depth", allowed.depth}, {"angle", allowed.angle}, {"force", allowed.force}}},
               {"max_force", exercise.max_force},
               {"strokes", exercise.strokes},
               {"pass", exercise.pass}};
  add_goals(exercise, root);
  if (!exercise.ideal.empty()) root["ideal"] = json_of_ideal(exercise.ideal);
  return root;
}

void add_options(const SimulationOptions& options, Json& root) {
  const MaintainOptions& maintain = options.engine.maintain;
  const bool is_descent = options.body.relaxation == Relaxation::kBlockDescent;
  root["frame_seconds"] = options.frame_seconds;
  root["solver"] = {{"relaxation", is_descent ? "block-descent" : "position-based"},
                    {"substeps", options.body.substeps},
                    {"iterations", options.body.iterations},
                    {"average_volumes", options.body.average_volumes}};
  root["cut"] = {{"snap", options.engine.cut.snap},
                 {"profile", options.engine.cut.profile == Profile::kPaper ? "paper" : "incise"}};
  root["maintain"] = {{"merge", maintain.merge},
                      {"improve", maintain.improve},
                      {"work_units", maintain.work_units == kUnlimitedWork ? Json() : Json(maintain.work_units)}};
  root["contact"] = {{"stiffness", options.contact_stiffness},
                     {"flat_height", options.flat_height},
                     {"self", options.body.self.on},
                     {"friction", options.body.self.friction}};
}

}  // namespace

Json scene_tree(const Scene& scene) {
  const BodyOptions& body = scene.options.body;
  Json root = {{"format", "incise-scene"}, {"version", 1}, {"name", scene.name}};
  root["model"] = json_of(scene.model);
  root["length_unit"] = body.length_unit;
  root["materials"] = json_of_materials(scene);
  root["gravity"] = encode(body.gravity);
  root["damping"] = body.damping;
  if (scene.stretch != Vec3::Ones()) root["stretch"] = encode(scene.stretch);
  root["attachments"] = json_of_all(scene.attachments);
  root["tools"] = json_of_all(scene.tools);
  root["hooks"] = json_of_all(scene.hooks);
  root["sutures"] = json_of_all(scene.sutures);
  root["strokes"] = json_of_all(scene.strokes);
  if (!scene.spare.empty()) root["spare"] = json_of_all(scene.spare);
  root["frames"] = scene.frames;
  root["settle"] = {{"frames", scene.settle.frames}, {"speed", scene.settle.speed}};
  root["seed"] = scene.seed;
  add_options(scene.options, root);
  if (scene.view) root["view"] = json_of(*scene.view);
  if (scene.hand) root["hand"] = json_of(*scene.hand);
  if (scene.exercise) root["exercise"] = json_of(*scene.exercise);
  return root;
}

std::string to_json(const Scene& scene) {
  return scene_tree(scene).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
