// SPDX-License-Identifier: Apache-2.0
// The report of a cut, with forces, energies, what the hand felt and the shares of time added to its tree.
#include "app/jobs/simulation_report.h"

#include "app/jobs/report_tree.h"
#include "app/scene/exercise_score_tree.h"
#include "app/text/counted.h"
#include "app/text/formatted.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

Json json_of(const BodyEnergy& energy) {
  return {{"elastic", encode(energy.elastic)},     {"kinetic", encode(energy.kinetic)},
          {"potential", encode(energy.potential)}, {"held", encode(energy.held)},
          {"pulled", encode(energy.pulled)},       {"tied", encode(energy.tied)},
          {"total", encode(energy.total())}};
}

Json json_of(const ForceFigures& forces) {
  return {{"peak_force", encode(forces.peak_force)},
          {"engaged_length", encode(forces.engaged_length)},
          {"fracture_work", encode(forces.fracture_work)},
          {"friction_work", encode(forces.friction_work)},
          {"tool_work", encode(forces.tool_work)},
          {"touching_frames", forces.touching_frames},
          {"yielding_frames", forces.yielding_frames},
          {"peak_hook_force", encode(forces.peak_hook_force)},
          {"peak_suture_force", encode(forces.peak_suture_force)},
          {"torn_sutures", forces.torn_sutures},
          {"contacts", forces.contacts}};
}

Json json_of(const HapticFigures& haptics) {
  return {{"ticks", haptics.ticks},
          {"peak_force", encode(haptics.peak_force)},
          {"energy_minimum", encode(haptics.sampled_minimum)},
          {"held_energy_minimum", encode(haptics.held_minimum)},
          {"removed_energy", encode(haptics.removed_energy)},
          {"tick_us", encode(haptics.compute_us)}};
}

Json json_of(const TimeShare& share) {
  return {{"cd", share.collision}, {"gm", share.geometry}, {"rlx", share.relax}, {"rd", share.render}};
}

void add_options(const SimulationReport& report, Json& options) {
  options["snap"] = report.job.options.snap;
  options["threads"] = report.job.options.threads;
  options["seed"] = report.job.options.seed;
}

}  // namespace

TimeShare share_of(const StageTimes& times) {
  const double total = times.total();
  if (!(total > 0)) return {};
  const double geometry =
      times[Stage::kSubdivide] + times[Stage::kSeparate] + times[Stage::kMerge] + times[Stage::kImprove];
  return {times[Stage::kCollision] / total, geometry / total, times[Stage::kRelax] / total, 0};
}

std::string to_json(const SimulationReport& report) {
  Json root = report_tree(report.job);
  add_options(report, root["options"]);
  root["scene"] = {{"file", report.scene},
                   {"name", report.name},
                   {"frames", report.frames},
                   {"frame_seconds", report.frame_seconds},
                   {"settle_frames", report.settle_frames}};
  root["frame_ms"] = encode(percentiles(report.frame_ms));
  root["share"] = json_of(share_of(report.job.times));
  root["energy"] = {{"before", json_of(report.energy_before)}, {"after", json_of(report.energy_after)}};
  root["forces"] = json_of(report.forces);
  root["haptics"] = json_of(report.haptics);
  root["body"] = {{"inverted_tets", report.inverted_tets}, {"is_finite", report.is_finite}};
  root["state_hash"] = hash_text(report.state_hash);
  if (report.exercise) root["exercise"] = score_tree(*report.exercise);
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_text(const SimulationReport& report) {
  const Percentiles ms = percentiles(report.frame_ms);
  const TimeShare share = share_of(report.job.times);
  const double seconds = static_cast<double>(report.frames) * report.frame_seconds;
  std::string text = formatted("{}, {:.3g} s, after {} of settling\n", counted(report.frames, "frame"), seconds,
                               counted(report.settle_frames, "frame"));
  text += to_text(report.job);
  text += formatted("a frame took {:.2f} ms (median), {:.2f} (99 %), {:.2f} (longest); {:.0f} frames a second\n",
                    ms.p50, ms.p99, ms.max,
                    report.job.total_ms > 0 ? 1e3 * static_cast<double>(report.frames) / report.job.total_ms : 0.0);
  text += formatted("collision {:.1f} %, mesh {:.1f} %, relaxation {:.1f} % of the time\n", 1e2 * share.collision,
                    1e2 * share.geometry, 1e2 * share.relax);
  const ForceFigures& f = report.forces;
  if (f.touching_frames > 0) {
    text += formatted("blade: at most {:.3g} N on {:.3g} mm of its edge; {:.3g} J of fracture, {:.3g} J of friction\n",
                      f.peak_force, 1e3 * f.engaged_length, f.fracture_work, f.friction_work);
  }
  if (report.haptics.peak_force > 0) {
    text += formatted(
        "a hand at 1 kHz: at most {:.3g} N; observed energy at least {:.3g} J; a tick takes {:.2g} us (99.9 %)\n",
        report.haptics.peak_force, report.haptics.sampled_minimum, report.haptics.compute_us.p999);
  }
  if (f.peak_hook_force > 0) text += formatted("hooks: at most {:.3g} N\n", f.peak_hook_force);
  if (f.peak_suture_force > 0 || f.torn_sutures > 0) {
    text += formatted("sutures: at most {:.3g} N, {} torn\n", f.peak_suture_force, f.torn_sutures);
  }
  if (report.inverted_tets > 0) {
    text += formatted("inverted as the body stands: {}\n", counted(report.inverted_tets, "tet"));
  }
  if (report.exercise) text += to_text(*report.exercise);
  return text;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
