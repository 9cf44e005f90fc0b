// SPDX-License-Identifier: Apache-2.0
// Force feedback: what the simulation tells, and the blade in the hand.
#include <memory>

#include "incise/sim/haptic_snapshot.h"
#include "incise/sim/haptic_tool.h"
#include "simulation_handle.h"

// NOLINTBEGIN(readability-identifier-naming): a C name
struct incise_haptic_tool {
  incise::HapticTool tool;
  incise::c::Turn turn;
};
// NOLINTEND(readability-identifier-naming)

namespace incise::c {
namespace {

incise_haptic_options to_c(const HapticToolOptions& options) {
  incise_haptic_options c{};
  c.size = sizeof c;
  c.coupling_stiffness = options.coupling_stiffness;
  c.coupling_damping = options.coupling_damping;
  c.drag = options.drag;
  c.max_stretch = options.max_stretch;
  c.max_force = options.max_force;
  c.physics_period = options.physics_period;
  c.link_delay = options.passivity.link_delay;
  return c;
}

HapticToolOptions tool_options(const incise_haptic_options& c) {
  HapticToolOptions options;
  options.coupling_stiffness = c.coupling_stiffness;
  options.coupling_damping = c.coupling_damping;
  options.drag = c.drag;
  options.max_stretch = c.max_stretch;
  options.max_force = c.max_force;
  options.physics_period = c.physics_period;
  options.passivity.link_delay = c.link_delay;
  return options;
}

incise_haptic_snapshot to_c(const HapticSnapshot& snapshot) {
  incise_haptic_snapshot c{};
  c.serial = snapshot.serial;
  c.touches = snapshot.touches ? 1 : 0;
  c.ruptured = snapshot.ruptured ? 1 : 0;
  from_vec(snapshot.tool_position, c.tool_position);
  from_vec(snapshot.force, c.force);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) c.compliance[3 * i + k] = snapshot.compliance(i, k);
  }
  from_vec(snapshot.contact_point, c.contact_point);
  from_vec(snapshot.cutting_direction, c.cutting_direction);
  from_vec(snapshot.flat_normal, c.flat_normal);
  c.engaged_length = snapshot.engaged_length;
  c.toughness = snapshot.toughness;
  c.cut_friction = snapshot.cut_friction;
  return c;
}

HapticSnapshot from_c(const incise_haptic_snapshot& c) {
  HapticSnapshot snapshot;
  snapshot.serial = c.serial;
  snapshot.touches = c.touches != 0;
  snapshot.ruptured = c.ruptured != 0;
  snapshot.tool_position = to_vec(c.tool_position);
  snapshot.force = to_vec(c.force);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) snapshot.compliance(i, k) = c.compliance[3 * i + k];
  }
  snapshot.contact_point = to_vec(c.contact_point);
  snapshot.cutting_direction = to_vec(c.cutting_direction);
  snapshot.flat_normal = to_vec(c.flat_normal);
  snapshot.engaged_length = c.engaged_length;
  snapshot.toughness = c.toughness;
  snapshot.cut_friction = c.cut_friction;
  return snapshot;
}

template <class Call>
incise_status change_tool(incise_haptic_tool* handle, const Call& call) {
  if (handle == nullptr) return refuse("the tool is null");
  return in_turn(handle->turn, false, [&] { return call(handle->tool); });
}

}  // namespace
}  // namespace incise::c

using namespace incise;

incise_status incise_simulation_haptic_snapshot(const incise_simulation* simulation, incise_haptic_snapshot* snapshot) {
  if (snapshot == nullptr) return c::refuse("there is no place for the snapshot: the last argument is null");
  if (const incise_status bad = c::check_out(snapshot, "incise_haptic_snapshot")) return bad;
  return c::look(simulation,
                 [&](const Simulation& looked) { return c::give(c::to_c(looked.haptic_snapshot()), snapshot); });
}

incise_status incise_default_haptic_options(incise_haptic_options* options, uint32_t size) {
  return c::give_default(c::to_c(HapticToolOptions()), options, size, "incise_haptic_options");
}

incise_status incise_haptic_tool_create(const incise_haptic_options* options, incise_haptic_tool** tool) {
  if (tool == nullptr) return c::refuse("there is no place for the tool: the last argument is null");
  *tool = nullptr;
  incise_haptic_options all = c::to_c(HapticToolOptions());
  if (const incise_status bad = c::take(options, all, "incise_haptic_options")) return bad;
  return c::guarded([&]() -> incise_status {
    const HapticToolOptions taken = c::tool_options(all);
    if (const Status status = check(taken); !status.ok()) return c::fail(status.error());
    *tool = new incise_haptic_tool{HapticTool(taken), {}};
    return INCISE_OK;
  });
}

incise_status incise_haptic_tool_accept(incise_haptic_tool* tool, const incise_haptic_snapshot* snapshot) {
  if (snapshot == nullptr) return c::refuse("the snapshot is null");
  return c::change_tool(tool, [&](HapticTool& changed) -> incise_status {
    incise_haptic_snapshot all = c::to_c(HapticSnapshot());
    if (const incise_status bad = c::take(snapshot, all, "incise_haptic_snapshot")) return bad;
    const HapticSnapshot taken = c::from_c(all);
    if (const Status status = check(taken); !status.ok()) return c::fail(status.error());
    return changed.accept(taken) ? INCISE_OK : c::refuse("the snapshot is not newer than the last one");
  });
}

incise_status incise_haptic_tool_tick(incise_haptic_tool* tool, double dt, const double* position,
                                      const double* velocity, double* force, double* tool_position) {
  if (position == nullptr || velocity == nullptr || force == nullptr) {
    return c::refuse("position, velocity or force is null");
  }
  return c::change_tool(tool, [&](HapticTool& changed) -> incise_status {
    const Vec3 place = c::to_vec(position), speed = c::to_vec(velocity);
    const Status sound = HapticTool::check_tick(dt, place, speed);
    c::from_vec(changed.tick(dt, place, speed), force);
    if (!sound.ok()) return c::fail(sound.error());
    if (tool_position != nullptr) c::from_vec(changed.tool_position(), tool_position);
    return INCISE_OK;
  });
}

incise_status incise_haptic_tool_free(incise_haptic_tool* tool) {
  if (tool == nullptr) return INCISE_OK;
  if (!tool->turn.begin(false)) return c::busy();
  delete tool;
  return INCISE_OK;
}
