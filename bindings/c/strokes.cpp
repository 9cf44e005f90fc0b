// SPDX-License-Identifier: Apache-2.0
// What changes an engine: strokes whole and step by step, positions, undo, maintenance.
#include "app/scene/blade_file.h"
#include "handles.h"
#include "incise/mesh/bounds.h"

namespace incise::c {
namespace {

incise_report to_c(const StrokeReport& stroke) {
  incise_report report{};
  fill(report, stroke.cut);
  fill(report, stroke.maintain);
  fill(report, stroke.times);
  report.stroke = stroke.stroke;
  return report;
}

incise_report to_c(const StepReport& step) {
  incise_report report{};
  fill(report, step.cut);
  fill(report, step.maintain);
  fill(report, step.times);
  return report;
}

incise_report to_c(const MaintainReport& maintained) {
  incise_report report{};
  fill(report, maintained.maintain);
  fill(report, maintained.times);
  return report;
}

/// A change that ends with a report: `call(Engine&)` returns a Result of one that `to_c` knows.
template <class Call>
incise_status change_and_report(incise_engine* handle, incise_report* report, const Call& call) {
  if (const incise_status bad = check_out(report, "incise_report")) return bad;
  return change(handle, [&](Engine& engine) -> incise_status {
    const std::uint64_t first = engine.journal().position();
    const auto done = call(engine);
    if (!done.ok()) return fail(done.error());
    incise_report all = to_c(*done);
    all.journal_first = first;
    all.journal_end = engine.journal().position();
    return give(all, report);
  });
}

Result<Stroke> stroke_of(const incise_stroke* given) {
  incise_stroke c{};
  if (take(given, c, "incise_stroke") != INCISE_OK) return Error{ErrorCode::kBadArgument, incise_last_error(), {}};
  if (c.times == nullptr || c.points == nullptr) {
    return Error{ErrorCode::kBadArgument, "times or points of the stroke are null; give both", {}};
  }
  Stroke stroke;
  if (c.name != nullptr) stroke.name = c.name;
  stroke.times.reserve(c.n_times);  // a number that was negative ends here
  stroke.times.assign(c.times, c.times + c.n_times);
  for (std::uint64_t i = 0; i < c.n_times; ++i) {
    stroke.edges.push_back(pose_of(c.points + 3 * i * c.n_points, c.n_points, nullptr).edge);
  }
  return stroke;
}

/// Cuts several strokes; the report has their sums, and the number of the last.
Result<StrokeReport> cut_all(Engine& engine, const std::vector<Stroke>& strokes) {
  StrokeReport sum;
  for (const Stroke& stroke : strokes) {
    const Result<StrokeReport> done = engine.cut(stroke);
    if (!done.ok()) return done.error();
    sum.cut += done->cut;
    sum.maintain += done->maintain;
    sum.times += done->times;
    sum.stroke = done->stroke;
  }
  return sum;
}

ShouldStop ask(incise_should_stop should_stop, void* user) {
  if (should_stop == nullptr) return {};
  return [should_stop, user, has_stopped = false]() mutable {
    has_stopped = has_stopped || should_stop(user) != 0;
    return has_stopped;
  };
}

incise_status check_edge(const double* edge) {
  return edge == nullptr ? refuse("the edge of the blade is null") : INCISE_OK;
}

/// Calls that say whether there was anything to do.
template <class Call>
incise_status change_if_any(incise_engine* handle, std::int32_t* done, const Call& call) {
  return change(handle, [&](Engine& engine) {
    const bool has_done = call(engine);
    if (done != nullptr) *done = has_done ? 1 : 0;
    return INCISE_OK;
  });
}

}  // namespace
}  // namespace incise::c

using namespace incise;

incise_status incise_engine_cut(incise_engine* engine, const incise_stroke* stroke, incise_report* report) {
  if (stroke == nullptr) return c::refuse("the stroke is null");
  return c::change_and_report(engine, report, [&](Engine& changed) -> Result<StrokeReport> {
    const Result<Stroke> taken = c::stroke_of(stroke);
    if (!taken.ok()) return taken.error();
    return changed.cut(*taken);
  });
}

incise_status incise_engine_cut_plane(incise_engine* engine, const double* normal, double offset,
                                      incise_report* report) {
  if (normal == nullptr) return c::refuse("the normal of the plane is null");
  return c::change_and_report(engine, report, [&](Engine& changed) -> Result<StrokeReport> {
    const Result<Stroke> stroke = plane_stroke(rest_bounds(changed.mesh()), c::to_vec(normal), offset);
    if (!stroke.ok()) return stroke.error();
    return changed.cut(*stroke);
  });
}

incise_status incise_engine_cut_blade(incise_engine* engine, const char* path, incise_report* report) {
  if (path == nullptr) return c::refuse("the name of the blade file is null");
  return c::change_and_report(engine, report, [&](Engine& changed) -> Result<StrokeReport> {
    const Result<std::vector<app::BladeStroke>> blade = app::read_blade_file(path);
    if (!blade.ok()) return blade.error();
    const Result<std::vector<Stroke>> strokes = app::held_strokes(*blade, changed.mesh(), engine->region_names);
    if (!strokes.ok()) return strokes.error();
    return c::cut_all(changed, *strokes);
  });
}

incise_status incise_engine_begin_stroke(incise_engine* engine, const double* edge, uint64_t n_points,
                                         const double* direction, uint32_t* stroke) {
  if (const incise_status bad = c::check_edge(edge)) return bad;
  return c::change(engine, [&](Engine& changed) -> incise_status {
    const Result<std::uint32_t> begun = changed.begin_stroke(c::pose_of(edge, n_points, direction));
    if (!begun.ok()) return c::fail(begun.error());
    if (stroke != nullptr) *stroke = *begun;
    return INCISE_OK;
  });
}

incise_status incise_engine_step(incise_engine* engine, const double* edge, uint64_t n_points, const double* direction,
                                 incise_report* report) {
  if (const incise_status bad = c::check_edge(edge)) return bad;
  return c::change_and_report(engine, report,
                              [&](Engine& changed) { return changed.step(c::pose_of(edge, n_points, direction)); });
}

incise_status incise_engine_end_stroke(incise_engine* engine, incise_report* report) {
  return c::change_and_report(engine, report, [](Engine& changed) { return changed.end_stroke(); });
}

incise_status incise_engine_set_positions(incise_engine* engine, const double* positions, uint64_t n_slots) {
  if (positions == nullptr && n_slots > 0) return c::refuse("the positions are null");
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return c::change(engine, [&](Engine& changed) {
    return c::finish(changed.set_positions({reinterpret_cast<const Vec3*>(positions), n_slots}));
  });
}

incise_status incise_engine_undo(incise_engine* engine, int32_t* done) {
  return c::change_if_any(engine, done, [](Engine& changed) { return changed.undo(); });
}

incise_status incise_engine_redo(incise_engine* engine, int32_t* done) {
  return c::change_if_any(engine, done, [](Engine& changed) { return changed.redo(); });
}

incise_status incise_engine_keep_undo(incise_engine* engine, uint64_t operations) {
  return c::change(engine, [&](Engine& changed) { return c::finish(changed.keep_undo(operations)); });
}

incise_status incise_engine_maintain(incise_engine* engine, uint64_t work_units, incise_should_stop should_stop,
                                     void* user, incise_report* report) {
  return c::change_and_report(engine, report,
                              [&](Engine& changed) { return changed.maintain(work_units, c::ask(should_stop, user)); });
}

incise_status incise_engine_improve(incise_engine* engine, incise_should_stop should_stop, void* user,
                                    incise_report* report) {
  return c::change_and_report(engine, report,
                              [&](Engine& changed) { return changed.improve(c::ask(should_stop, user)); });
}
