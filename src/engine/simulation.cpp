// SPDX-License-Identifier: Apache-2.0
// A frame as the paper's Figure 1 has it: what touches presses, the tissue relaxes, the blade cuts where it stands,
// what was cut is maintained, and the solver follows the journal.
#include "incise/engine/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <string>

#include "engine/blade_coupling.h"
#include "engine/constants.h"
#include "engine/hook_grip.h"
#include "engine/sutures.h"
#include "engine/wall_area.h"
#include "incise/core/hash.h"
#include "incise/mesh/edge_length.h"

namespace incise {
inline namespace v0 {

namespace {

Error bad(std::string message) {
  return {ErrorCode::kBadArgument, std::move(message), {}};
}

double stiffest(const Materials& materials) {
  const auto soft = [](const Material& material) { return material.rigid ? 0.0 : material.young; };
  double young = soft(materials.fallback);
  for (const Materials::Entry& entry : materials.by_region) young = std::max(young, soft(entry.material));
  return young > 0 ? young : materials.fallback.young;  // where all is bone
}

/// As with all that a body is made of: beyond it energies overflow.
bool is_bounded(double number) {
  return number >= 0 && number <= kGreatestExtent;
}

Status check(const SimulationOptions& options) {
  if (!(options.frame_seconds > 0 && options.frame_seconds <= 1)) return bad("a frame must last between 0 and 1 s");
  if (!is_bounded(options.contact_stiffness)) {
    return bad("the contact stiffness must be at least 0 N/m, at most 1e+30");
  }
  if (!is_bounded(options.flat_height)) {
    return bad("the height of the blade's flat must be at least 0, at most 1e+30");
  }
  return {};
}

Status check(const Hook& hook) {
  const auto bad_hook = [&](const char* what) {
    return Error{ErrorCode::kBadArgument, "hook " + std::to_string(hook.id) + ": " + what, {hook.id}};
  };
  if (!(hook.position.array().abs() <= kGreatestExtent).all())
    return bad_hook("its position is not finite, or beyond 1e+30");
  if (!(hook.radius > 0 && is_bounded(hook.radius))) return bad_hook("its radius must be above 0, at most 1e+30");
  if (!(hook.stiffness > 0 && is_bounded(hook.stiffness))) {
    return bad_hook("its stiffness must be above 0 N/m, at most 1e+30");
  }
  if (!(hook.strength > 0)) return bad_hook("its strength must be above 0 N");
  if (!(hook.closed >= 0 && hook.closed < 1)) return bad_hook("it must be closed by at least 0 and less than 1");
  return {};
}

Status check(const FrameInput& input) {
  for (std::size_t i = 0; i < input.hooks.size(); ++i) {
    if (Status status = check(input.hooks[i]); !status) return status;
    for (std::size_t j = 0; j < i; ++j) {
      if (input.hooks[j].id == input.hooks[i].id)
        return Error{
            ErrorCode::kBadArgument, "hook " + std::to_string(input.hooks[i].id) + " comes twice", {input.hooks[i].id}};
    }
  }
  for (std::size_t i = 0; i < input.tools.size(); ++i) {
    const Status status = check(input.tools[i]);
    if (!status) return Error{status.error().code, "tool " + std::to_string(i) + ": " + status.error().message, {i}};
  }
  return {};
}

/// Where a mesh stands, if not at rest: the engine takes every mesh for one at rest.
std::vector<Vec3> places_off_rest(const TetMesh& mesh) {
  bool is_off = false;
  std::vector<Vec3> places(mesh.vertex_slots(), Vec3::Zero());
  mesh.for_each_vertex([&](VertexId v) {
    places[v.value] = mesh.current(v);
    is_off = is_off || mesh.current(v) != mesh.rest(v);
  });
  return is_off ? places : std::vector<Vec3>();
}

/// The tets that the latest steps of cutting made; some may be gone again. Those of maintenance list their edits.
std::vector<TetId> fresh_tets(const Journal& journal, std::size_t first_step) {
  std::vector<TetId> tets;
  for (std::size_t i = first_step; i < journal.position(); ++i) {
    if (!journal.step(i).edits.empty()) continue;
    for (const ProducedTet& tet : journal.step(i).produced) tets.push_back(tet.id);
  }
  return tets;
}

}  // namespace

struct Simulation::State {
  State(Engine taken, std::unique_ptr<Solver> made, SimulationOptions chosen)
      : engine(std::move(taken)),
        solver(std::move(made)),
        options(std::move(chosen)),
        spacing(mean_edge_length(engine.mesh())),
        sutures(detail::kSutureReach * spacing, options.body.length_unit) {}

  Engine engine;
  std::unique_ptr<Solver> solver;
  DeformableBody* body = nullptr;  // the same, where it is Incise's own
  SimulationOptions options;
  double spacing;
  detail::Sutures sutures;
  double contact_stiffness = 0;  // N/m
  std::uint64_t frames = 0;
  bool is_in_stroke = false;
  StepReport told;  // of the stroke under way: what the frames have reported
  std::vector<Vec3> blade_before;
  detail::BladeCoupling coupling;
  ToolContacts tool_contacts;
  std::size_t first_tool_pull = 0;  // of the last frame
  std::map<std::uint32_t, detail::HookGrip> grips;
  HapticSnapshot snapshot;

  Status start_blade(const FrameInput& input);
  Status press(const FrameInput& input, FrameReport& report);
  void hold_with_hooks(const FrameInput& input, std::vector<Pull>& pulls);
  void add_flat(const FrameInput& input, std::vector<Tool>& tools) const;
  std::vector<Vec3> hook_forces(const FrameInput& input) const;
  void tear_hooks(const FrameInput& input, std::vector<std::uint32_t>& torn);
  template <class Add>
  Result<std::uint32_t> add_suture(const Add& add);
  Status tie();
  Status tie_again();
  Status tear(std::vector<std::uint32_t>& torn);
  Status relax(FrameReport& report);
  Status cut(const FrameInput& input, FrameReport& report);
  Status lift_blade(FrameReport& report);
  Status maintain(FrameReport& report);
  Status follow(FrameReport& report);
  Status follow_mesh();
  Status hand_over();
};

// --- the frame, as the paper's Figure 1 has it

Result<FrameReport> Simulation::frame(const FrameInput& input) {
  State& s = *state_;
  if (Status status = check(input); !status) return status.error();
  FrameReport report;
  if (Status status = s.start_blade(input); !status) return status.error();
  if (Status status = s.tie(); !status) return status.error();
  if (Status status = s.press(input, report); !status) return status.error();
  if (Status status = s.relax(report); !status) return status.error();
  report.hook_forces = s.hook_forces(input);
  s.tear_hooks(input, report.torn_hooks);
  if (Status status = s.tear(report.torn_sutures); !status) return status.error();
  if (Status status = s.cut(input, report); !status) return status.error();
  if (Status status = s.maintain(report); !status) return status.error();
  if (Status status = s.follow(report); !status) return status.error();
  report.stroke = s.is_in_stroke ? s.engine.stroke_count() + 1 : 0;
  ++s.frames;
  s.snapshot.serial = s.frames;
  return report;
}

/// A blade that appears is put in place; a pose that does not fit the stroke is refused before anything happens.
Status Simulation::State::start_blade(const FrameInput& input) {
  if (!input.blade) return {};
  const BladePose& pose = *input.blade;
  if (Status status = engine.check_pose(pose); !status) return status;
  if (is_in_stroke) {
    return pose.edge.size() == blade_before.size()
               ? Status{}
               : Status{bad("all poses of a stroke must have the same number of points")};
  }
  coupling.begin(pose, engine.mesh(), options.materials, options.body.length_unit, spacing);
  BladePose first = pose;
  if (coupling.resists()) first = coupling.yield(engine.mesh());
  first.direction = pose.direction;
  if (const auto begun = engine.begin_stroke(first); !begun) return begun.error();
  is_in_stroke = true;
  told = {};
  blade_before = pose.edge;
  return {};
}

/// Collision: what touches the tissue, and presses on it while it relaxes.
Status Simulation::State::press(const FrameInput& input, FrameReport& report) {
  const StageZone zone(report.times, Stage::kCollision);
  std::vector<Pull> pulls;
  hold_with_hooks(input, pulls);
  if (input.blade && coupling.resists()) coupling.press(*input.blade, engine.mesh(), pulls);
  std::vector<Tool> tools = input.tools;
  add_flat(input, tools);
  ToolContactOptions contact{contact_stiffness, 0.1 * spacing, Vec3::Zero(), options.body.length_unit, 0};
  const double dt = options.frame_seconds;
  if (body != nullptr) contact.speed_up = dt * dt / options.body.length_unit * options.body.gravity;
  if (body != nullptr && options.body.self.on) contact.friction = options.body.self.friction;
  const std::size_t first = pulls.size();
  const auto force_of = [&](std::size_t index) { return solver->pull_force(first_tool_pull + index); };
  report.contacts = tool_contacts.find(engine.mesh(), solver->positions(), tools, contact, force_of, pulls);
  first_tool_pull = first;
  return solver->set_pulls(std::move(pulls));
}

void Simulation::State::hold_with_hooks(const FrameInput& input, std::vector<Pull>& pulls) {
  std::erase_if(grips, [&](const auto& grip) {
    return std::none_of(input.hooks.begin(), input.hooks.end(),
                        [&](const Hook& hook) { return hook.id == grip.first; });
  });
  for (const Hook& hook : input.hooks) {
    auto at = grips.find(hook.id);
    if (at == grips.end()) {
      at = grips.emplace(hook.id, detail::HookGrip(engine.mesh(), solver->positions(), hook)).first;
    }
    at->second.add_to(engine.mesh(), hook, pulls);
  }
}

/// What the tissue does to each hook.
std::vector<Vec3> Simulation::State::hook_forces(const FrameInput& input) const {
  std::vector<Vec3> forces;
  for (const Hook& hook : input.hooks) forces.push_back(grips.at(hook.id).force(*solver));
  return forces;
}

void Simulation::State::tear_hooks(const FrameInput& input, std::vector<std::uint32_t>& torn) {
  for (const Hook& hook : input.hooks) {
    if (grips.at(hook.id).give_way(*solver, hook, options.body.length_unit)) torn.push_back(hook.id);
  }
}

/// Walls are kept on their sides of the blade that is between them.
void Simulation::State::add_flat(const FrameInput& input, std::vector<Tool>& tools) const {
  if (!input.blade || options.flat_height <= 0) return;
  Vec3 way = input.blade->direction;
  if (way.isZero(0)) {
    for (std::size_t i = 0; i < blade_before.size(); ++i) way += input.blade->edge[i] - blade_before[i];
  }
  if (!(way.norm() > 0)) return;
  tools.emplace_back(FlatTool{input.blade->edge, -options.flat_height * way.normalized(), 0});
}

Status Simulation::State::relax(FrameReport& report) {
  const StageZone zone(report.times, Stage::kRelax);
  Result<AdvanceReport> advanced = solver->advance(options.frame_seconds);
  if (!advanced) return advanced.error();
  report.relax = *advanced;
  return hand_over();
}

Status Simulation::State::hand_over() {
  return engine.set_positions(solver->positions());
}

/// The blade cuts the tissue where it stands now.
Status Simulation::State::cut(const FrameInput& input, FrameReport& report) {
  snapshot = {};
  if (!input.blade) return is_in_stroke ? lift_blade(report) : Status{};
  BladePose pose = *input.blade;
  blade_before = pose.edge;
  if (coupling.resists()) pose = coupling.yield(engine.mesh());
  const std::size_t first_step = engine.journal().position();
  const Result<StepReport> step = engine.step(pose);
  if (!step) {
    is_in_stroke = false;
    return step.error();
  }
  report.cut = step->cut;
  report.maintain = step->maintain;
  report.times += step->times;
  told.cut += step->cut;
  told.maintain += step->maintain;
  told.times += step->times;
  if (!coupling.resists()) return {};
  const StageZone zone(report.times, Stage::kCollision);
  coupling.pay_for(detail::wall_growth(engine.journal(), first_step, engine.mesh()));
  coupling.take_hold(engine.mesh(), fresh_tets(engine.journal(), first_step));
  report.blade = coupling.state();
  return {};
}

/// The stroke's sums hold what the frames have told already.
Status Simulation::State::lift_blade(FrameReport& report) {
  is_in_stroke = false;
  const Result<StrokeReport> stroke = engine.end_stroke();
  if (!stroke) return stroke.error();
  report.cut = stroke->cut;
  report.cut -= told.cut;
  report.maintain = stroke->maintain;
  report.maintain -= told.maintain;
  report.times += stroke->times;
  report.times -= told.times;
  return {};
}

/// What a stroke's maintenance has left goes on in the frames after it.
Status Simulation::State::maintain(FrameReport& report) {
  if (is_in_stroke || !engine.has_maintenance() || report.maintain.work_units > 0) return {};
  const Result<MaintainReport> more = engine.maintain(options.engine.maintain.work_units);
  if (!more) return more.error();
  report.maintain += more->maintain;
  report.times += more->times;
  return {};
}

Status Simulation::State::follow(FrameReport& report) {
  StageTimes times;
  Status status;
  {
    const StageZone zone(times, Stage::kRelax);
    status = follow_mesh();
  }
  report.follow_ms = times[Stage::kRelax];
  report.times += times;
  return status;
}

Status Simulation::State::follow_mesh() {
  const Result<FollowReport> followed = solver->follow(engine.journal(), engine.mesh());
  if (!followed) return followed.error();
  if (is_in_stroke && coupling.resists()) snapshot = coupling.snapshot(*solver, engine.mesh());
  if (Status status = tie_again(); !status) return status;
  return followed->fresh_vertices > 0 ? hand_over() : Status{};
}

// --- sutures

/// Those whose turn comes are tied.
Status Simulation::State::tie() {
  if (sutures.is_empty()) return {};
  sutures.begin_frame(frames);
  return solver->set_ties(sutures.ties());
}

/// Where the mesh has changed the ends are in other tets.
Status Simulation::State::tie_again() {
  if (sutures.is_empty()) return {};
  sutures.follow(engine.mesh());
  return solver->set_ties(sutures.ties());
}

Status Simulation::State::tear(std::vector<std::uint32_t>& torn) {
  if (sutures.is_empty()) return {};
  torn = sutures.tear(engine.mesh());
  return torn.empty() ? Status{} : solver->set_ties(sutures.ties());
}

/// A solver that has no ties refuses: then there is no suture.
template <class Add>
Result<std::uint32_t> Simulation::State::add_suture(const Add& add) {
  const Result<std::uint32_t> id = add();
  if (!id) return id;
  if (Status status = tie(); !status) {
    (void)sutures.remove(*id);
    return status.error();
  }
  return id;
}

Result<std::uint32_t> Simulation::add_suture(const std::array<TissuePoint, 2>& ends, const Suture& suture) {
  State& s = *state_;
  return s.add_suture([&] { return s.sutures.add(s.engine.mesh(), ends, suture); });
}

Result<std::uint32_t> Simulation::add_suture(const std::array<Vec3, 2>& rest_places, const Suture& suture) {
  State& s = *state_;
  return s.add_suture([&] { return s.sutures.add(s.engine.mesh(), rest_places, suture); });
}

Status Simulation::remove_suture(std::uint32_t id) {
  if (Status status = state_->sutures.remove(id); !status) return status;
  return state_->solver->set_ties(state_->sutures.ties());
}

std::vector<SutureState> Simulation::sutures() const {
  return state_->sutures.states(state_->engine.mesh());
}

// --- the rest

Result<Simulation> Simulation::create(TetMesh mesh, SimulationOptions options) {
  if (Status status = check(options); !status) return status.error();
  Result<DeformableBody> made = DeformableBody::create(mesh, {}, options.materials, options.body);
  if (!made) return made.error();
  auto body = std::make_unique<DeformableBody>(std::move(made).value());
  DeformableBody* const own = body.get();
  Result<Simulation> simulation = create(std::move(mesh), std::move(options), std::move(body));
  if (simulation) simulation->state_->body = own;
  return simulation;
}

Result<Simulation> Simulation::create(TetMesh mesh, SimulationOptions options, std::unique_ptr<Solver> solver) {
  if (Status status = check(options); !status) return status.error();
  if (solver == nullptr) return bad("a simulation needs a solver");
  if (const double unit = options.body.length_unit; !(unit >= kLeastExtent && unit <= kGreatestExtent)) {
    return bad("the length unit must be above 0 m, from 1e-30 to 1e+30");
  }
  const std::vector<Vec3> drawn_out = places_off_rest(mesh);
  Result<Engine> engine = Engine::create(std::move(mesh), options.engine);
  if (!engine) return engine.error();
  if (!drawn_out.empty()) {
    if (Status status = engine->set_positions(drawn_out); !status) return status.error();
  }
  auto state = std::make_unique<State>(std::move(engine).value(), std::move(solver), std::move(options));
  const SimulationOptions& o = state->options;
  state->contact_stiffness =
      o.contact_stiffness > 0 ? o.contact_stiffness : 10 * stiffest(o.materials) * state->spacing * o.body.length_unit;
  return Simulation(std::move(state));
}

Simulation::Simulation(std::unique_ptr<State> state) : state_(std::move(state)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Result<unsigned> Simulation::settle(unsigned max_frames, double speed, const ShouldStop& should_stop) {
  State& s = *state_;
  if (!(speed >= 0)) return bad("the speed at which a body counts as at rest must be at least 0 m/s");
  for (unsigned i = 0; i < max_frames; ++i) {
    if (should_stop && should_stop()) return i;
    Result<AdvanceReport> advanced = s.solver->advance(s.options.frame_seconds);
    if (!advanced) return advanced.error();
    if (Status status = s.hand_over(); !status) return status.error();
    std::vector<std::uint32_t> torn;
    if (Status status = s.tear(torn); !status) return status.error();
    if (advanced->fastest < speed) return i + 1;
    s.solver->slow_down(0.5);
  }
  return max_frames;
}

bool Simulation::undo() {
  State& s = *state_;
  s.is_in_stroke = false;
  if (!s.engine.undo()) return false;
  return s.solver->follow(s.engine.journal(), s.engine.mesh()).ok() && s.tie_again().ok() && s.hand_over().ok();
}

bool Simulation::redo() {
  State& s = *state_;
  if (!s.engine.redo()) return false;
  return s.solver->follow(s.engine.journal(), s.engine.mesh()).ok() && s.tie_again().ok() && s.hand_over().ok();
}

Status Simulation::keep_undo(std::size_t operations) {
  return state_->engine.keep_undo(operations);
}

const SimulationOptions& Simulation::options() const {
  return state_->options;
}
const Engine& Simulation::engine() const {
  return state_->engine;
}
const TetMesh& Simulation::mesh() const {
  return state_->engine.mesh();
}
const Solver& Simulation::solver() const {
  return *state_->solver;
}
Solver& Simulation::solver() {
  return *state_->solver;
}
bool Simulation::has_body() const {
  return state_->body != nullptr;
}
const DeformableBody& Simulation::body() const {
  return *state_->body;
}
DeformableBody& Simulation::body() {
  return *state_->body;
}
std::uint64_t Simulation::frames() const {
  return state_->frames;
}
const HapticSnapshot& Simulation::haptic_snapshot() const {
  return state_->snapshot;
}

std::uint64_t Simulation::hash() const {
  StateHash hash;
  hash.add(state_->engine.mesh().hash());
  hash.add(state_->solver->hash());
  state_->tool_contacts.add_to(hash);
  state_->sutures.add_to(hash);
  return hash.value();
}

}  // namespace v0
}  // namespace incise
