// SPDX-License-Identifier: Apache-2.0
// A body that is cut while it deforms.
#include "incise/engine/simulation.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "app/scene/scene.h"
#include "app/scene/scene_simulation.h"
#include "handles.h"
#include "incise/io/mesh_loader.h"
#include "simulation_handle.h"

namespace incise::c {
namespace {

incise_body_options to_c(const BodyOptions& options) {
  incise_body_options c{};
  c.size = sizeof c;
  c.relaxation = static_cast<std::int32_t>(options.relaxation);
  c.length_unit = options.length_unit;
  from_vec(options.gravity, c.gravity);
  c.damping = options.damping;
  c.substeps = options.substeps;
  c.iterations = options.iterations;
  c.thinnest = options.thinnest;
  c.sleep_below = options.sleep_below;
  c.threads = options.threads;
  c.coarse = options.coarse ? 1 : 0;
  c.crumb = options.crumb;
  return c;
}

Result<BodyOptions> body_options(const incise_body_options* given) {
  BodyOptions options;
  incise_body_options c = to_c(options);
  if (take(given, c, "incise_body_options") != INCISE_OK)
    return Error{ErrorCode::kBadArgument, incise_last_error(), {}};
  if (c.relaxation != INCISE_BLOCK_DESCENT && c.relaxation != INCISE_POSITION_BASED) {
    return Error{ErrorCode::kBadArgument, "relaxation is 0 (block descent) or 1 (position based)", {}};
  }
  options.relaxation = static_cast<Relaxation>(c.relaxation);
  options.length_unit = c.length_unit;
  options.gravity = to_vec(c.gravity);
  options.damping = c.damping;
  options.substeps = c.substeps;
  options.iterations = c.iterations;
  options.thinnest = c.thinnest;
  options.sleep_below = c.sleep_below;
  options.threads = c.threads;
  options.coarse = c.coarse != 0;
  options.crumb = c.crumb;
  return options;
}

Result<Materials> materials_of(const incise_material* given, std::uint32_t n) {
  Materials materials;
  if (given == nullptr && n > 0)
    return Error{ErrorCode::kBadArgument, "materials are null, and n_materials is not 0", {}};
  if (std::count_if(given, given + n, [](const incise_material& c) { return c.is_fallback != 0; }) > 1)
    return Error{ErrorCode::kBadArgument, "more than one material is for all regions without their own", {}};
  for (std::uint32_t i = 0; i < n; ++i) {
    const incise_material& c = given[i];
    Material material{c.density, c.young, c.poisson, c.toughness, c.cut_friction, c.stiffening, c.rupture};
    std::copy_n(c.fibre, 3, material.fibre.begin());
    material.fibre_young = c.fibre_young;
    for (std::size_t k = 0; k < material.prony.size(); ++k) {
      material.prony[k] = {c.prony[2 * k], c.prony[2 * k + 1]};
    }
    material.rigid = c.rigid != 0;
    if (c.is_fallback != 0) {
      materials.fallback = material;
    } else {
      materials.by_region.push_back({c.region, material});
    }
  }
  return materials;
}

incise_simulation_options to_c(const SimulationOptions& options) {
  incise_simulation_options c{};
  c.size = sizeof c;
  c.frame_seconds = options.frame_seconds;
  c.contact_stiffness = options.contact_stiffness;
  c.flat_height = options.flat_height;
  return c;
}

Result<SimulationOptions> simulation_options(const incise_simulation_options* given) {
  SimulationOptions options;
  incise_simulation_options c = to_c(options);
  if (take(given, c, "incise_simulation_options") != INCISE_OK) {
    return Error{ErrorCode::kBadArgument, incise_last_error(), {}};
  }
  Result<EngineOptions> engine = engine_options(c.engine, options.engine);
  if (!engine.ok()) return engine.error();
  Result<BodyOptions> body = body_options(c.body);
  if (!body.ok()) return body.error();
  Result<Materials> materials = materials_of(c.materials, c.n_materials);
  if (!materials.ok()) return materials.error();
  options.engine = std::move(engine).value();
  options.body = *body;
  options.materials = std::move(materials).value();
  options.frame_seconds = c.frame_seconds;
  options.contact_stiffness = c.contact_stiffness;
  options.flat_height = c.flat_height;
  return options;
}

/// What a new simulation is made of.
struct Made {
  Simulation simulation;
  std::optional<app::Scene> scene;
  std::vector<std::string> notes;
  std::vector<std::uint32_t> file_vertex;
};

Result<Made> make(Result<TetMesh> mesh, const incise_simulation_options* given) {
  if (!mesh.ok()) return mesh.error();
  Result<SimulationOptions> options = simulation_options(given);
  if (!options.ok()) return options.error();
  Result<Simulation> simulation = Simulation::create(std::move(mesh).value(), std::move(options).value());
  if (!simulation.ok()) return simulation.error();
  return Made{std::move(simulation).value(), {}, {}, {}};
}

Result<Made> make(Result<io::LoadedMesh> loaded, const incise_simulation_options* given) {
  if (!loaded.ok()) return loaded.error();
  Result<Made> made = make(Result<TetMesh>(std::move(loaded->mesh)), given);
  if (!made.ok()) return made;
  made->notes = std::move(loaded->source.notes);
  made->file_vertex = std::move(loaded->file_vertex);
  return made;
}

Result<Made> make(Result<app::Scene> scene, std::uint32_t threads) {
  if (!scene.ok()) return scene.error();
  Result<io::LoadedMesh> loaded = app::take_model(*scene);
  if (!loaded.ok()) return loaded.error();
  Result<Simulation> simulation = app::make_simulation(*scene, std::move(loaded->mesh), threads);
  if (!simulation.ok()) return simulation.error();
  return Made{std::move(simulation).value(), std::move(scene).value(), std::move(loaded->source.notes),
              std::move(loaded->file_vertex)};
}

/// Of an argument that has to be there.
Result<Made> nothing(const char* what) {
  return Error{ErrorCode::kBadArgument, what, {}};
}

/// Creation: a simulation goes to `out`, which is null until then.
template <class Call>
incise_status create(incise_simulation** out, const Call& call) {
  if (out == nullptr) return refuse("there is no place for the simulation: the last argument is null");
  *out = nullptr;
  return guarded([&]() -> incise_status {
    Result<Made> made = call();
    if (!made.ok()) return fail(made.error());
    auto handle = std::make_unique<incise_simulation>(std::move(made->simulation));
    handle->scene = std::move(made->scene);
    handle->engine.notes = std::move(made->notes);
    handle->engine.file_vertex = std::move(made->file_vertex);
    *out = handle.release();
    return INCISE_OK;
  });
}

static_assert(INCISE_TOOL_BALL == 0 && INCISE_TOOL_ROD == 1 && INCISE_TOOL_PLANE == 2 && INCISE_TOOL_FLAT == 3 &&
                  std::variant_size_v<Tool> >= 4,
              "the kinds of tools are those of Tool, in order; one without a name in the header goes by its place");

/// Points are `a` and `b`, in the order of the tool's fields; its number is `offset` where it is called so, else
/// `radius`. A kind with more than these is no tool of C.
class ToolFields {
 public:
  explicit ToolFields(const incise_tool& given) : given_(given) {}

  void operator()(const char* /*name*/, Vec3& point) { point = to_vec(points_++ == 0 ? given_.a : given_.b); }
  void operator()(const char* name, double& number) {
    const bool is_offset = std::string_view(name) == "offset";
    numbers_ += is_offset ? 0 : 1;
    number = is_offset ? given_.offset : given_.radius;
  }
  void operator()(const char* /*name*/, std::vector<Vec3>& edge) {
    has_edge_ = given_.edge != nullptr;
    if (has_edge_) edge = pose_of(given_.edge, given_.n_edge, nullptr).edge;
  }
  [[nodiscard]] bool has_edge() const { return has_edge_; }
  [[nodiscard]] bool has_room() const { return points_ <= 2 && numbers_ <= 1; }

 private:
  const incise_tool& given_;
  unsigned points_ = 0, numbers_ = 0;
  bool has_edge_ = true;
};

Result<Tool> tool_of(const incise_tool& c) {
  std::optional<Tool> made;
  ToolFields fields(c);
  std::uint32_t kind = 0;
  for_each_tool_kind([&](auto shape) {
    if (kind++ != static_cast<std::uint32_t>(c.kind)) return;
    shape.for_each_field(shape, fields);
    made = std::move(shape);
  });
  if (!fields.has_edge()) return Error{ErrorCode::kBadArgument, "the edge of a flat is null", {}};
  if (!fields.has_room()) {
    return Error{
        ErrorCode::kUnsupported,
        "the interface of C has no room for all that a tool of kind " + std::to_string(c.kind) + " is told by; use C++",
        {}};
  }
  if (made) return *std::move(made);
  return Error{
      ErrorCode::kBadArgument,
      "there is no tool of kind " + std::to_string(c.kind) + "; 0 to " + std::to_string(std::variant_size_v<Tool> - 1),
      {}};
}

Result<FrameInput> input_of(const incise_frame_input* given) {
  incise_frame_input c{};
  if (take(given, c, "incise_frame_input") != INCISE_OK) return Error{ErrorCode::kBadArgument, incise_last_error(), {}};
  if ((c.hooks == nullptr && c.n_hooks > 0) || (c.tools == nullptr && c.n_tools > 0)) {
    return Error{ErrorCode::kBadArgument, "hooks or tools are null, and their number is not 0", {}};
  }
  FrameInput input;
  if (c.blade != nullptr) {
    input.blade = pose_of(c.blade, c.n_blade, c.direction);
    input.blade->slicing = c.slicing;
  }
  input.hooks.reserve(c.n_hooks);  // a number that was negative ends here
  input.tools.reserve(c.n_tools);
  for (std::uint64_t i = 0; i < c.n_hooks; ++i) {
    const incise_hook& hook = c.hooks[i];
    Hook& taken = input.hooks.emplace_back(Hook{hook.id, to_vec(hook.position), hook.radius, hook.stiffness});
    if (hook.strength != 0) taken.strength = hook.strength;
    taken.tears = hook.tears != 0;
  }
  for (std::uint64_t i = 0; i < c.n_tools; ++i) {
    Result<Tool> tool = tool_of(c.tools[i]);
    if (!tool.ok()) return tool.error();
    input.tools.push_back(std::move(tool).value());
  }
  return input;
}

incise_frame_report to_c(const FrameReport& frame) {
  incise_frame_report c{};
  c.stroke = frame.stroke;
  c.blade_touches = frame.blade.touches ? 1 : 0;
  c.blade_yields = frame.blade.yields ? 1 : 0;
  from_vec(frame.blade.force, c.blade_force);
  c.engaged_length = frame.blade.engaged_length;
  c.fracture_work = frame.blade.fracture_work;
  c.friction_work = frame.blade.friction_work;
  c.tool_work = frame.blade.tool_work;
  c.contacts = frame.contacts;
  c.active_vertices = frame.relax.active_vertices;
  c.fastest = frame.relax.fastest;
  c.n_hook_forces = frame.hook_forces.size();
  return c;
}

incise_status run_frame(incise_simulation& handle, const FrameInput& input, incise_frame_report* report) {
  const std::uint64_t first = handle.simulation.engine().journal().position();
  Result<FrameReport> frame = handle.simulation.frame(input);
  if (!frame.ok()) return fail(frame.error());
  handle.last = std::move(frame).value();
  handle.journal_first = first;
  return give(to_c(handle.last), report);
}

incise_status settle(incise_simulation& handle, std::uint32_t most, double speed, const ShouldStop& should_stop,
                     std::uint32_t* frames) {
  const Result<unsigned> done = handle.simulation.settle(most, speed, should_stop);
  if (!done.ok()) return fail(done.error());
  if (frames != nullptr) *frames = *done;
  return INCISE_OK;
}

incise_status no_scene() {
  return refuse("this simulation was made without a scene; make it from one");
}

incise_status settle_scene(incise_simulation& handle, const ShouldStop& should_stop, std::uint32_t* frames) {
  if (!handle.scene) return no_scene();
  const app::SceneSettle& how = handle.scene->settle;
  return settle(handle, how.frames, how.speed, should_stop, frames);
}

ShouldStop ask_while_settling(incise_should_stop should_stop, void* user) {
  if (should_stop == nullptr) return {};
  return [should_stop, user] { return should_stop(user) != 0; };  // settling ends at the first yes
}

incise_simulation_state state_of(const incise_simulation& handle) {
  const Simulation& simulation = handle.simulation;
  const DeformableBody& body = simulation.body();
  incise_simulation_state c{};
  c.frames = simulation.frames();
  c.scene_frames = handle.scene ? handle.scene->frames : 0;
  c.frame_seconds = simulation.options().frame_seconds;
  c.length_unit = simulation.options().body.length_unit;
  c.mass = body.mass();
  from_vec(body.momentum(), c.momentum);
  const BodyEnergy energy = body.energy();
  c.elastic = energy.elastic;
  c.kinetic = energy.kinetic;
  c.potential = energy.potential;
  c.held = energy.held;
  c.pulled = energy.pulled;
  from_vec(body.force_on_holds(), c.force_on_holds);
  c.inverted_tets = body.count_inverted();
  c.hash = simulation.hash();
  return c;
}

template <class Call>
incise_status change_if_any(incise_simulation* handle, std::int32_t* done, const Call& call) {
  return change(handle, [&](Simulation& simulation) {
    const bool has_done = call(simulation);
    if (done != nullptr) *done = has_done ? 1 : 0;
    return INCISE_OK;
  });
}

}  // namespace
}  // namespace incise::c

using namespace incise;

incise_status incise_default_body_options(incise_body_options* options, uint32_t size) {
  return c::give_default(c::to_c(BodyOptions()), options, size, "incise_body_options");
}

incise_status incise_default_simulation_options(incise_simulation_options* options, uint32_t size) {
  return c::give_default(c::to_c(SimulationOptions()), options, size, "incise_simulation_options");
}

incise_status incise_simulation_create(const incise_mesh_arrays* mesh, const incise_simulation_options* options,
                                       incise_simulation** simulation) {
  return c::create(simulation, [&] {
    std::vector<std::string> notes;
    Result<c::Made> made = c::make(c::mesh_of(mesh, notes), options);
    if (made.ok()) made->notes = std::move(notes);
    return made;
  });
}

incise_status incise_simulation_read(const char* path, const incise_simulation_options* options,
                                     incise_simulation** simulation) {
  return c::create(simulation, [&] {
    return path == nullptr ? c::nothing("the name of the file is null") : c::make(io::load_mesh(path), options);
  });
}

incise_status incise_simulation_read_scene(const char* path, uint32_t threads, incise_simulation** simulation) {
  return c::create(simulation, [&] {
    return path == nullptr ? c::nothing("the name of the scene is null") : c::make(app::read_scene(path), threads);
  });
}

incise_status incise_simulation_parse_scene(const char* json, const char* folder, uint32_t threads,
                                            incise_simulation** simulation) {
  return c::create(simulation, [&] {
    const std::filesystem::path seen_from = folder == nullptr ? "" : folder;
    return json == nullptr ? c::nothing("the scene is null")
                           : c::make(app::parse_scene(json, "scene", seen_from), threads);
  });
}

incise_status incise_simulation_free(incise_simulation* simulation) {
  if (simulation == nullptr) return INCISE_OK;
  if (!simulation->turn.begin(false)) return c::busy();
  delete simulation;
  return INCISE_OK;
}

const incise_engine* incise_simulation_engine(const incise_simulation* simulation) {
  return simulation == nullptr ? nullptr : &simulation->engine;
}

incise_status incise_simulation_frame(incise_simulation* simulation, const incise_frame_input* input,
                                      incise_frame_report* report) {
  if (const incise_status bad = c::check_out(report, "incise_frame_report")) return bad;
  return c::change(simulation, [&](Simulation&) -> incise_status {
    const Result<FrameInput> taken = c::input_of(input);
    if (!taken.ok()) return c::fail(taken.error());
    return c::run_frame(*simulation, *taken, report);
  });
}

incise_status incise_simulation_play(incise_simulation* simulation, incise_frame_report* report) {
  if (const incise_status bad = c::check_out(report, "incise_frame_report")) return bad;
  return c::change(simulation, [&](Simulation& changed) -> incise_status {
    if (!simulation->scene) return c::no_scene();
    return c::run_frame(*simulation, app::scene_input(*simulation->scene, changed.frames()), report);
  });
}

incise_status incise_simulation_cut_report(const incise_simulation* simulation, incise_report* report) {
  if (report == nullptr) return c::refuse("there is no place for the report: the last argument is null");
  if (const incise_status bad = c::check_out(report, "incise_report")) return bad;
  return c::look(simulation, [&](const Simulation& looked) {
    incise_report all{};
    c::fill(all, simulation->last.cut);
    c::fill(all, simulation->last.maintain);
    c::fill(all, simulation->last.times);
    all.stroke = simulation->last.stroke;
    all.journal_first = simulation->journal_first;
    all.journal_end = looked.engine().journal().position();
    return c::give(all, report);
  });
}

incise_status incise_simulation_hook_forces(const incise_simulation* simulation, double* forces, uint64_t room,
                                            uint64_t* count) {
  return c::look(simulation, [&](const Simulation&) {
    return c::give_vecs(std::span<const Vec3>(simulation->last.hook_forces), forces, room, count);
  });
}

incise_status incise_simulation_settle(incise_simulation* simulation, uint32_t max_frames, double speed,
                                       uint32_t* frames) {
  return incise_simulation_settle_until(simulation, max_frames, speed, nullptr, nullptr, frames);
}

incise_status incise_simulation_settle_scene(incise_simulation* simulation, uint32_t* frames) {
  return incise_simulation_settle_scene_until(simulation, nullptr, nullptr, frames);
}

incise_status incise_simulation_settle_until(incise_simulation* simulation, uint32_t max_frames, double speed,
                                             incise_should_stop should_stop, void* user, uint32_t* frames) {
  return c::change(simulation, [&](Simulation&) {
    return c::settle(*simulation, max_frames, speed, c::ask_while_settling(should_stop, user), frames);
  });
}

incise_status incise_simulation_settle_scene_until(incise_simulation* simulation, incise_should_stop should_stop,
                                                   void* user, uint32_t* frames) {
  return c::change(simulation, [&](Simulation&) {
    return c::settle_scene(*simulation, c::ask_while_settling(should_stop, user), frames);
  });
}

incise_status incise_simulation_look(const incise_simulation* simulation, incise_simulation_state* state) {
  if (state == nullptr) return c::refuse("there is no place for the state: the last argument is null");
  if (const incise_status bad = c::check_out(state, "incise_simulation_state")) return bad;
  return c::look(simulation, [&](const Simulation&) { return c::give(c::state_of(*simulation), state); });
}

incise_status incise_simulation_undo(incise_simulation* simulation, int32_t* done) {
  return c::change_if_any(simulation, done, [](Simulation& changed) { return changed.undo(); });
}

incise_status incise_simulation_redo(incise_simulation* simulation, int32_t* done) {
  return c::change_if_any(simulation, done, [](Simulation& changed) { return changed.redo(); });
}

incise_status incise_simulation_hold(incise_simulation* simulation, uint32_t vertex, double stiffness) {
  return c::change(simulation,
                   [&](Simulation& changed) { return c::finish(changed.body().hold(VertexId(vertex), stiffness)); });
}

incise_status incise_simulation_pin(incise_simulation* simulation, uint32_t vertex, double stiffness, double strength,
                                    int32_t tears) {
  return c::change(simulation, [&](Simulation& changed) {
    return c::finish(changed.body().hold(VertexId(vertex), stiffness, {strength, tears != 0}));
  });
}

incise_status incise_simulation_move_hold(incise_simulation* simulation, uint32_t vertex, const double* target) {
  if (target == nullptr) return c::refuse("the place of the hold is null");
  return c::change(simulation, [&](Simulation& changed) {
    return c::finish(changed.body().move_hold(VertexId(vertex), c::to_vec(target)));
  });
}

incise_status incise_simulation_is_held(const incise_simulation* simulation, uint32_t vertex, int32_t* is_held) {
  if (is_held == nullptr) return c::refuse("there is no place for the answer: the last argument is null");
  return c::look(simulation, [&](const Simulation& looked) -> incise_status {
    if (!looked.mesh().is_live(VertexId(vertex))) return c::fail(c::not_live(vertex));
    *is_held = looked.body().is_held(VertexId(vertex)) ? 1 : 0;
    return INCISE_OK;
  });
}

incise_status incise_simulation_velocities(const incise_simulation* simulation, double* velocities, uint64_t room,
                                           uint64_t* count) {
  return c::look(simulation, [&](const Simulation& looked) {
    std::vector<Vec3> all(looked.mesh().vertex_slots(), Vec3::Zero());
    looked.mesh().for_each_vertex([&](VertexId v) { all[v.value] = looked.body().velocity(v); });
    return c::give_vecs(std::span<const Vec3>(all), velocities, room, count);
  });
}

incise_status incise_simulation_set_velocity(incise_simulation* simulation, uint32_t vertex, const double* velocity) {
  if (velocity == nullptr) return c::refuse("the velocity is null");
  return c::change(simulation, [&](Simulation& changed) {
    return c::finish(changed.body().set_velocity(VertexId(vertex), c::to_vec(velocity)));
  });
}
