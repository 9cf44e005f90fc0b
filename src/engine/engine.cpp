// SPDX-License-Identifier: Apache-2.0
// The conductor: cutter, maintenance and front of the paper behind one interface, steps of the journal gathered into
// operations for undo. Where a call fails, all of its steps are taken back.
#include "incise/engine/engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <string>
#include <utility>

#include "cut/cutter.h"
#include "engine/constants.h"
#include "improve/maintainer.h"
#include "incise/mesh/bounds.h"
#include "paper/paper_cut.h"
#include "paper/paper_maintenance.h"

namespace incise {
inline namespace v0 {

namespace {

void tell(const LogSink& log, const CutStatistics& cut) {
  if (log && cut.sheets > 1) {
    log(LogLevel::kInfo,
        "the sweep meets itself: it was cut in " + std::to_string(cut.sheets) + " parts, in time order");
  }
  if (log && cut.blocked_edges > 0) {
    log(LogLevel::kWarning, std::to_string(cut.blocked_edges) +
                                " edges were left whole beside flat tets: the parts may hang together there");
  }
}

std::uint32_t highest_tag(const TetMesh& mesh) {
  std::uint32_t highest = 0;
  mesh.for_each_tet([&](TetId tet) {
    for (const Link link : mesh.links(tet)) highest = std::max(highest, link.is_boundary() ? link.tag() : 0U);
  });
  return highest;
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

/// Holds the parts of an engine, and calls them in the order of the pipeline.
class Engine::Conductor {
 public:
  Conductor(TetMesh mesh, EngineOptions options);

  [[nodiscard]] const TetMesh& mesh() const { return mesh_; }
  [[nodiscard]] const Journal& journal() const { return journal_; }
  [[nodiscard]] const EngineOptions& options() const { return options_; }
  [[nodiscard]] std::uint32_t stroke_count() const { return stroke_count_; }
  [[nodiscard]] std::uint32_t next_stroke() const { return earlier_strokes_ + stroke_count_ + 1; }
  [[nodiscard]] bool is_in_stroke() const { return is_in_stroke_; }
  [[nodiscard]] bool has_maintenance() const;
  [[nodiscard]] Status check_pose(const BladePose& pose) const;

  Result<StrokeReport> cut(const Stroke& stroke);
  Result<std::uint32_t> begin_stroke(const BladePose& pose);
  Result<StepReport> step(const BladePose& pose);
  Result<StrokeReport> end_stroke();
  Status set_positions(std::span<const Vec3> positions);
  Result<MaintainReport> maintain(std::uint64_t work_units, const ShouldStop& should_stop);
  Result<MaintainReport> improve(const ShouldStop& should_stop);
  bool undo();
  bool redo();
  Status keep_undo(std::size_t operations);

 private:
  /// From where a stroke that starts where the last one ended goes on.
  struct Continuation {
    std::shared_ptr<const Cutter::Pause> pause;  ///< null: from nowhere
    std::size_t first_step = 0;                  ///< of those that ended the last one
  };

  /// A stroke, or an `improve`, with all that followed it.
  struct Operation {
    std::size_t end = 0;  ///< journal position after it
    bool is_stroke = true;
    Continuation continuation = {};
    IncisionFront front = {};  ///< after it, in the paper's profile
  };

  /// The stroke under way.
  struct OpenStroke {
    StrokeReport report;
    std::size_t first_step = 0;
    BladePose first_pose;
    std::size_t steps = 0;           ///< taken so far
    Continuation from = {};          ///< until it has gone on, or begins anew
    std::vector<BladePose> waiting;  ///< its poses until then, each further than those that it went on from
    std::size_t tried = 1;           ///< so many of them, in vain; the last one may come after them
    Continuation to = {};            ///< once it has ended
    bool is_whole = false;           ///< it is cut in the body at rest, however that stands
  };

  [[nodiscard]] std::string name_of_next_pose() const;
  Status check_steps(std::size_t first_step);
  void take_back(std::size_t first_step);
  void restore_front();
  void forget_lost_redo();
  void trim_history();
  [[nodiscard]] bool is_paper() const { return options_.cut.profile == Profile::kPaper; }
  [[nodiscard]] bool maintains() const;
  void take_up(const SweptTriangles& sweep, std::uint32_t tag, std::size_t first_step, const IsLocked& is_locked = {});
  [[nodiscard]] IsLocked busy() const;
  void maintain_wake(const IsLocked& is_locked, MaintainStatistics& sum, StageTimes& times);
  Result<CutStatistics> cut_whole(const Stroke& stroke);
  Result<CutStatistics> cut_by_steps(const Stroke& stroke);
  Result<CutStatistics> end_whole(Result<CutStatistics> cut);
  bool is_at_last_end(std::span<const Vec3> row);
  void maintain_rest(const Stroke& stroke);
  Result<CutStatistics> cut_step(const BladePose& pose, StepReport& report);
  Result<CutStatistics> move_blade(const BladePose& pose, MaintainStatistics& maintained, StageTimes& times);
  Result<CutStatistics> go_on_from_last_stroke(const BladePose& pose, MaintainStatistics& maintained,
                                               StageTimes& times);
  std::optional<CutStatistics> go_on_through(bool ends, StageTimes& times);
  Result<CutStatistics> stop_waiting();
  Result<CutStatistics> begin_anew(MaintainStatistics& maintained, StageTimes& times);
  [[nodiscard]] bool is_waiting() const { return open_.from.pause != nullptr; }
  [[nodiscard]] bool may_wait() const { return !cuts_in_motion() && open_.from.pause->is_at_rest(); }
  [[nodiscard]] bool cuts_in_motion() const { return has_moved_ && !open_.is_whole; }
  Status close_stroke();
  void maintain_between_sheets(MaintainStatistics& sum, StageTimes& times);
  Error abort_stroke(std::size_t first_step, Error error);
  Status close_stroke_as_paper();
  MaintainStatistics maintain(std::uint64_t work_units, StageTimes& times, const ShouldStop& should_stop,
                              const IsLocked& is_locked = {});
  MaintainStatistics maintain_incision(StageTimes& times);
  void push_operation(bool is_stroke) { push_operation(is_stroke, Continuation()); }
  void push_operation(bool is_stroke, Continuation continuation);

  TetMesh mesh_;
  Journal journal_;
  EngineOptions options_;
  Cutter cutter_;
  Maintainer maintainer_;
  PaperCutter paper_cutter_;
  PaperMaintainer paper_maintainer_;
  std::deque<Operation> operations_;
  std::size_t kept_operations_ = static_cast<std::size_t>(-1);
  std::size_t oldest_position_ = 0;  // of the journal, that undo leads back to
  std::vector<Operation> undone_;    // what redo would apply, last first
  std::uint32_t stroke_count_ = 0;
  std::uint32_t earlier_strokes_ = 0;  // the highest tag of the mesh that was taken
  OpenStroke open_;
  bool is_in_stroke_ = false;
  bool has_moved_ = false;  // the body stands otherwise than at rest
  Box rest_box_, box_;      // around the body at load, and as it stands
};

Engine::Conductor::Conductor(TetMesh mesh, EngineOptions options)
    : mesh_(std::move(mesh)),
      options_(std::move(options)),
      cutter_(options_.cut),
      maintainer_(options_.maintain),
      paper_cutter_(options_.threads),
      earlier_strokes_(highest_tag(mesh_)),
      rest_box_(rest_bounds(mesh_)),
      box_(rest_box_) {
  if (!is_paper()) {
    maintainer_.set_original(mesh_);
    cutter_.prepare(mesh_, journal_);
  }
}

Result<StrokeReport> Engine::Conductor::cut(const Stroke& stroke) {
  if (is_in_stroke_) {
    return Error{ErrorCode::kBadArgument, "a stroke is under way; end it first", {}};
  }
  if (Status status = check(stroke); !status) {
    return status.error();
  }
  if (Status status = check_reach(stroke, rest_box_); !status) {
    return status.error();
  }
  const auto start = std::chrono::steady_clock::now();
  const std::size_t first_step = journal_.position();
  open_ = {};
  StrokeReport& report = open_.report;
  report.stroke = next_stroke();
  open_.first_step = first_step;
  maintainer_.begin_reference(report.stroke);
  maintain_between_sheets(report.maintain, report.times);
  Result<CutStatistics> cut = cut_whole(stroke);
  if (!cut) {
    take_back(first_step);
    return cut.error();
  }
  const std::size_t first_maintaining = journal_.position();
  Status status = check_steps(first_step);
  if (status) {
    maintain_rest(stroke);
    status = check_steps(first_maintaining);
  }
  if (!status) {
    take_back(first_step);
    return status.error();
  }
  report.cut = *cut;
  tell(options_.log, *cut);
  report.step_ms.push_back(milliseconds_since(start));
  push_operation(true, std::move(open_.to));
  return std::move(report);
}

/// A stroke that begins or ends inside the body shares its front with others: it goes on from the last one, and the
/// next one from it.
Result<CutStatistics> Engine::Conductor::cut_whole(const Stroke& stroke) {
  StrokeReport& report = open_.report;
  if (is_paper()) return paper_cutter_.cut(mesh_, journal_, stroke, report.stroke, report.times);
  if (is_at_last_end(stroke.edges.front())) return end_whole(cut_by_steps(stroke));
  if (!cutter_.leaves_front(mesh_, journal_, stroke)) {
    return cutter_.cut(mesh_, journal_, stroke, report.stroke, report.times);
  }
  return end_whole(cutter_.cut_to_end(mesh_, journal_, stroke, report.stroke, report.times));
}

/// From where the last stroke has ended.
Result<CutStatistics> Engine::Conductor::cut_by_steps(const Stroke& stroke) {
  open_.from = operations_.back().continuation;
  open_.waiting = {{stroke.edges.front()}};
  open_.is_whole = true;
  CutStatistics sum;
  for (std::size_t row = 1; row < stroke.edges.size(); ++row) {
    Result<CutStatistics> cut = move_blade({stroke.edges[row]}, open_.report.maintain, open_.report.times);
    if (!cut) return cut;
    sum += *cut;
  }
  return sum;
}

/// What the blade has left behind is maintained before the end of the stroke, so that another one that goes on from
/// there takes back no more than that end.
Result<CutStatistics> Engine::Conductor::end_whole(Result<CutStatistics> cut) {
  if (!cut) return cut;
  if (is_waiting()) {
    Result<CutStatistics> more = stop_waiting();
    if (!more) return more;
    *cut += *more;
  } else {
    maintain_wake(busy(), open_.report.maintain, open_.report.times);
  }
  open_.to = {cutter_.pause(mesh_), journal_.position()};
  Result<CutStatistics> end = cutter_.end(mesh_, journal_, open_.report.times);
  if (!end) return end;
  *cut += *end;
  return cut;
}

/// Whether a blade that cuts at rest stands where the last operation has ended.
bool Engine::Conductor::is_at_last_end(std::span<const Vec3> row) {
  if (operations_.empty()) return false;
  const Continuation& last = operations_.back().continuation;
  return last.pause && last.pause->is_at_rest() &&
         cutter_.may_go_on(mesh_, journal_, *last.pause, last.first_step, row, /*has_moved=*/false);
}

/// Maintains what a whole stroke has cut; where its blade came in steps, with what that has left of the call's budget.
void Engine::Conductor::maintain_rest(const Stroke& stroke) {
  StrokeReport& report = open_.report;
  const bool came_in_steps = open_.to.pause != nullptr;
  const std::uint64_t budget = options_.maintain.work_units;
  const std::uint64_t spent = came_in_steps ? std::min(report.maintain.work_units, budget) : 0;
  take_up(came_in_steps ? cutter_.swept() : swept_triangles(stroke), report.stroke, open_.first_step);
  report.maintain += maintain(budget - spent, report.times, {});
}

/// What a call committed is checked by whom the options name.
Status Engine::Conductor::check_steps(std::size_t first_step) {
  const bool has_steps = journal_.position() > first_step;
  return has_steps && options_.check_step ? options_.check_step(mesh_, journal_, first_step) : Status{};
}

/// After a call that failed: as the mesh was before its first step.
void Engine::Conductor::take_back(std::size_t first_step) {
  journal_.take_back(mesh_, first_step);
  cutter_.forget();
  maintainer_.forget();
  paper_maintainer_.forget();
  restore_front();
  forget_lost_redo();
}

/// The front of the paper's incisions, as the last operation left it.
void Engine::Conductor::restore_front() {
  IncisionFront front = operations_.empty() ? IncisionFront() : operations_.back().front;
  front.renew(mesh_);
  paper_cutter_.restore(std::move(front));
}

/// What was undone before a call that then failed has left the journal for its steps.
void Engine::Conductor::forget_lost_redo() {
  if (!undone_.empty() && undone_.front().end > journal_.size()) {
    undone_.clear();
  }
}

namespace {

Error bad_pose(const std::string& name, const std::string& what) {
  return {ErrorCode::kBadArgument, name + ": " + what, {}};
}

std::string points(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " point" : " points");
}

Status check(const BladePose& pose, const std::string& name) {
  if (pose.edge.size() < 2) {
    return bad_pose(name, "its edge has " + points(pose.edge.size()) + "; it needs at least 2");
  }
  for (std::size_t k = 0; k < pose.edge.size(); ++k) {
    if (!pose.edge[k].allFinite()) return bad_pose(name, "point " + std::to_string(k) + " of its edge is not finite");
  }
  if (!pose.direction.allFinite()) return bad_pose(name, "its direction is not finite");
  if (!(pose.slicing >= 0 && pose.slicing <= BladePose::kMostSlicing))
    return bad_pose(name, "its slicing is not in [0, 100]");
  return {};
}

Vec3 direction_of(const BladePose& pose) {
  const double length = pose.direction.norm();
  return length > 0 ? Vec3(pose.direction / length) : Vec3(Vec3::Zero());
}

Error no_stroke() {
  return {ErrorCode::kBadArgument, "no stroke is under way; begin one first", {}};
}

Error in_stroke(const std::string& call) {
  return {ErrorCode::kBadArgument, call + ": a stroke is under way, and maintained as it goes; end it first", {}};
}

}  // namespace

std::string Engine::Conductor::name_of_next_pose() const {
  return "pose " + std::to_string(is_in_stroke_ ? open_.steps + 1 : 0) + " of stroke " + std::to_string(next_stroke());
}

Status Engine::Conductor::check_pose(const BladePose& pose) const {
  const std::string name = name_of_next_pose();
  if (Status status = check(pose, name); !status) return status;
  return check_reach(pose.edge, box_, name);
}

Result<std::uint32_t> Engine::Conductor::begin_stroke(const BladePose& pose) {
  if (is_in_stroke_) {
    return Error{ErrorCode::kBadArgument, "a stroke is under way; end it first", {}};
  }
  if (Status status = check_pose(pose); !status) {
    return status.error();
  }
  open_ = {};
  open_.report.stroke = next_stroke();
  open_.first_step = journal_.position();
  open_.first_pose = pose;
  maintainer_.begin_reference(open_.report.stroke);
  if (!operations_.empty()) {
    const Continuation& last = operations_.back().continuation;
    const bool goes_on =
        last.pause && cutter_.may_go_on(mesh_, journal_, *last.pause, last.first_step, pose.edge, has_moved_);
    if (goes_on) open_.from = last;
    open_.waiting = {pose};
  }
  if (is_paper()) {
    paper_cutter_.begin(mesh_, journal_, pose.edge, has_moved_, open_.report.stroke);
  } else if (!open_.from.pause) {
    cutter_.begin(mesh_, journal_, pose.edge, has_moved_, open_.report.stroke);
  }
  is_in_stroke_ = true;
  return open_.report.stroke;
}

Result<StepReport> Engine::Conductor::step(const BladePose& pose) {
  if (!is_in_stroke_) {
    return no_stroke();
  }
  if (Status status = check_pose(pose); !status) {
    return status.error();
  }
  if (const std::size_t count = open_.first_pose.edge.size(); pose.edge.size() != count) {
    return bad_pose(name_of_next_pose(), "its edge has " + points(pose.edge.size()) +
                                             "; all poses of a stroke have as many as its first, " +
                                             std::to_string(count));
  }
  ++open_.steps;
  const auto start = std::chrono::steady_clock::now();
  const std::size_t first_step = journal_.position();
  StepReport report;
  Result<CutStatistics> cut = cut_step(pose, report);
  if (!cut) {
    return abort_stroke(first_step, cut.error());
  }
  report.cut = *cut;
  if (Status status = check_steps(first_step); !status) {
    return abort_stroke(first_step, status.error());
  }
  const std::size_t first_maintaining = journal_.position();
  if (!is_paper() && !is_waiting()) maintain_wake(busy(), report.maintain, report.times);
  if (Status status = check_steps(first_maintaining); !status) {
    return abort_stroke(first_step, status.error());
  }
  open_.report.cut += *cut;
  open_.report.maintain += report.maintain;
  open_.report.times += report.times;
  open_.report.step_ms.push_back(milliseconds_since(start));
  return report;
}

Result<CutStatistics> Engine::Conductor::cut_step(const BladePose& pose, StepReport& report) {
  if (is_paper()) {
    return paper_cutter_.step(mesh_, journal_, pose.edge, direction_of(pose), has_moved_, report.times);
  }
  return move_blade(pose, report.maintain, report.times);
}

Result<CutStatistics> Engine::Conductor::move_blade(const BladePose& pose, MaintainStatistics& maintained,
                                                    StageTimes& times) {
  if (is_waiting()) return go_on_from_last_stroke(pose, maintained, times);
  maintain_between_sheets(maintained, times);
  return cutter_.step(mesh_, journal_, pose.edge, direction_of(pose), cuts_in_motion(), times);
}

/// A stroke that starts where the last one ended takes over the cut with its first step. Where that would join pieces,
/// since the last one has ended at an older wall, the blade waits until it is through.
Result<CutStatistics> Engine::Conductor::go_on_from_last_stroke(const BladePose& pose, MaintainStatistics& maintained,
                                                                StageTimes& times) {
  const Continuation from = open_.from;
  const bool is_first = open_.waiting.size() == 1;
  open_.waiting.resize(open_.tried);
  open_.waiting.push_back(pose);
  if (is_first && cutter_.go_on(mesh_, journal_, *from.pause, from.first_step, open_.waiting.front().edge,
                                cuts_in_motion(), open_.report.stroke)) {
    open_.from = {};
    return move_blade(pose, maintained, times);
  }
  const bool gets_on = from.pause->has_got_on(open_.waiting[open_.tried - 1].edge, pose.edge);
  if (may_wait() && !gets_on) return CutStatistics();
  if (const std::optional<CutStatistics> cut = go_on_through(/*ends=*/false, times)) return *cut;
  open_.tried = open_.waiting.size();
  if (may_wait() && from.pause->is_near(pose.edge)) return CutStatistics();
  return begin_anew(maintained, times);
}

/// Takes the end of the last stroke back and cuts along the poses at which the blade has waited, if all pieces stay
/// apart.
std::optional<CutStatistics> Engine::Conductor::go_on_through(bool ends, StageTimes& times) {
  if (!may_wait()) return std::nullopt;
  std::vector<std::vector<Vec3>> rows;
  for (const BladePose& pose : open_.waiting) rows.push_back(pose.edge);
  const Continuation& from = open_.from;
  std::optional<CutStatistics> cut =
      cutter_.go_on_through(mesh_, journal_, *from.pause, from.first_step, rows, ends, open_.report.stroke, times);
  if (cut) open_.from = {};
  return cut;
}

/// The stroke ends where its blade waits.
Result<CutStatistics> Engine::Conductor::stop_waiting() {
  StageTimes& times = open_.report.times;
  if (const std::optional<CutStatistics> cut = go_on_through(/*ends=*/true, times)) return *cut;
  return begin_anew(open_.report.maintain, times);
}

/// Cuts along the poses at which the blade has waited, as any other stroke.
Result<CutStatistics> Engine::Conductor::begin_anew(MaintainStatistics& maintained, StageTimes& times) {
  open_.from = {};
  cutter_.begin(mesh_, journal_, open_.waiting.front().edge, cuts_in_motion(), open_.report.stroke);
  CutStatistics sum;
  for (std::size_t i = 1; i < open_.waiting.size(); ++i) {
    Result<CutStatistics> cut = move_blade(open_.waiting[i], maintained, times);
    if (!cut) return cut;
    sum += *cut;
  }
  return sum;
}

/// Where the blade comes back to what it cut, it must find the mesh in shape: what it crosses twice would be slivers.
void Engine::Conductor::maintain_between_sheets(MaintainStatistics& sum, StageTimes& times) {
  cutter_.call_between_sheets([&, this] { maintain_wake(busy(), sum, times); });
}

/// The band around the front of the stroke under way.
IsLocked Engine::Conductor::busy() const {
  return [this](TetId tet) { return cutter_.is_busy(mesh_, tet); };
}

/// Maintains what the stroke has cut so far, but for what is locked.
void Engine::Conductor::maintain_wake(const IsLocked& is_locked, MaintainStatistics& sum, StageTimes& times) {
  take_up(cutter_.swept(), open_.report.stroke, open_.first_step, is_locked);
  sum += maintain(options_.maintain.work_units, times, {}, is_locked);
  open_.first_step = journal_.position();
}

/// A step that failed leaves the stroke as it was before; what it had found out about the mesh is lost, so that the
/// stroke ends there.
Error Engine::Conductor::abort_stroke(std::size_t first_step, Error error) {
  is_in_stroke_ = false;
  take_back(first_step);
  push_operation(true);
  return error;
}

Result<StrokeReport> Engine::Conductor::end_stroke() {
  if (!is_in_stroke_) {
    return no_stroke();
  }
  const std::size_t first_step = journal_.position();
  if (Status status = is_paper() ? close_stroke_as_paper() : close_stroke(); !status) {
    return abort_stroke(first_step, status.error());
  }
  is_in_stroke_ = false;
  push_operation(true, std::move(open_.to));
  tell(options_.log, open_.report.cut);
  return std::move(open_.report);
}

/// Cuts to where the blade was last, and maintains what is left.
Status Engine::Conductor::close_stroke() {
  if (is_waiting() && open_.waiting.size() == 1) {  // it took no step
    open_.to = open_.from;
    return {};
  }
  if (is_waiting()) {
    Result<CutStatistics> cut = stop_waiting();
    if (!cut) return cut.error();
    open_.report.cut += *cut;
  }
  const std::size_t first_step = journal_.position();
  open_.to = {cutter_.pause(mesh_), first_step};
  maintain_between_sheets(open_.report.maintain, open_.report.times);
  Result<CutStatistics> cut = cutter_.end(mesh_, journal_, open_.report.times);
  if (!cut) {
    return cut.error();
  }
  open_.report.cut += *cut;
  if (Status status = check_steps(first_step); !status) {
    return status;
  }
  const std::size_t first_maintaining = journal_.position();
  maintain_wake({}, open_.report.maintain, open_.report.times);
  return check_steps(first_maintaining);
}

/// Cuts to where the blade was last. The paper merges and maintains once the incision is made.
Status Engine::Conductor::close_stroke_as_paper() {
  std::size_t first_step = journal_.position();
  Result<CutStatistics> cut = paper_cutter_.end(mesh_, journal_, open_.report.times);
  if (!cut) {
    return cut.error();
  }
  open_.report.cut += *cut;
  if (Status status = check_steps(first_step); !status) {
    return status;
  }
  first_step = journal_.position();
  take_up({}, open_.report.stroke, open_.first_step);
  open_.report.maintain += maintain(options_.maintain.work_units, open_.report.times, {});
  return check_steps(first_step);
}

Status Engine::Conductor::set_positions(std::span<const Vec3> positions) {
  if (positions.size() != mesh_.vertex_slots()) {
    return Error{ErrorCode::kBadArgument,
                 "positions must be given for all " + std::to_string(mesh_.vertex_slots()) + " vertex slots",
                 {}};
  }
  bool has_moved = false;
  Box box;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const VertexId v(static_cast<std::uint32_t>(i));
    if (!mesh_.is_live(v)) continue;
    if (!positions[i].allFinite()) {
      return Error{ErrorCode::kBadArgument, "the position of vertex " + std::to_string(i) + " is not finite", {i}};
    }
    has_moved = has_moved || positions[i] != mesh_.rest(v);
    if (mesh_.tet_of(v).is_valid()) box.extend(positions[i]);
  }
  mesh_.set_current(positions);
  has_moved_ = has_moved;
  box_ = box;
  return {};
}

/// Hands the surroundings of a fresh cut to whoever maintains the mesh.
void Engine::Conductor::take_up(const SweptTriangles& sweep, std::uint32_t tag, std::size_t first_step,
                                const IsLocked& is_locked) {
  if (!maintains()) {
    return;
  }
  if (is_paper()) {
    paper_maintainer_.take_up(first_step);
    return;
  }
  maintainer_.extend_reference(tag, sweep.points, sweep.triangles);
  maintainer_.take_up(mesh_, journal_, first_step, is_locked);
}

bool Engine::Conductor::maintains() const {
  return (options_.maintain.merge || options_.maintain.improve) && !mesh_.folds_over_at_load();
}

MaintainStatistics Engine::Conductor::maintain(std::uint64_t work_units, StageTimes& times,
                                               const ShouldStop& should_stop, const IsLocked& is_locked) {
  if (!is_paper()) {
    return maintainer_.run(mesh_, journal_, work_units, times, should_stop, is_locked);
  }
  return work_units == 0 ? MaintainStatistics() : maintain_incision(times);
}

/// Leaves out the front of an incision that may go on.
MaintainStatistics Engine::Conductor::maintain_incision(StageTimes& times) {
  if (!paper_maintainer_.has_work() && !paper_maintainer_.has_held()) return {};
  return paper_maintainer_.run(mesh_, journal_, paper_cutter_.front().vertices(mesh_), options_.maintain, times);
}

Result<MaintainReport> Engine::Conductor::maintain(std::uint64_t work_units, const ShouldStop& should_stop) {
  if (is_in_stroke_) {
    return in_stroke("maintain");
  }
  MaintainReport report;
  const std::size_t first_step = journal_.position();
  if (is_paper() && work_units > 0 && !paper_maintainer_.has_work()) paper_cutter_.restore({});  // it is complete
  report.maintain = maintain(work_units, report.times, should_stop);
  if (Status status = check_steps(first_step); !status) {
    take_back(first_step);
    return status.error();
  }
  if (!operations_.empty()) {
    operations_.back().end = journal_.position();
    operations_.back().front = paper_cutter_.front();
  }
  return report;
}

bool Engine::Conductor::has_maintenance() const {
  return is_paper() ? paper_maintainer_.has_work() : maintainer_.has_work();
}

Result<MaintainReport> Engine::Conductor::improve(const ShouldStop& should_stop) {
  if (is_in_stroke_) {
    return in_stroke("improve");
  }
  MaintainReport report;
  const std::size_t first_step = journal_.position();
  if (maintains() && is_paper()) {
    paper_cutter_.restore({});
    paper_maintainer_.forget();
    report.maintain = maintain_all_as_paper(mesh_, journal_, options_.maintain, report.times);
  } else if (maintains()) {
    maintainer_.take_up_all(mesh_);
    report.maintain = maintainer_.run(mesh_, journal_, options_.maintain.work_units, report.times, should_stop);
  }
  if (Status status = check_steps(first_step); !status) {
    take_back(first_step);
    return status.error();
  }
  push_operation(false);
  return report;
}

void Engine::Conductor::push_operation(bool is_stroke, Continuation continuation) {
  operations_.push_back({journal_.position(), is_stroke, std::move(continuation), paper_cutter_.front()});
  if (operations_.size() > detail::kKeptContinuations) {
    operations_[operations_.size() - detail::kKeptContinuations - 1].continuation = {};
  }
  undone_.clear();
  stroke_count_ += is_stroke ? 1U : 0U;
  trim_history();
}

Status Engine::Conductor::keep_undo(std::size_t operations) {
  if (operations == 0) {
    return Error{ErrorCode::kBadArgument,
                 "the history keeps at least 1 operation: followers need the steps of the last one",
                 {}};
  }
  kept_operations_ = operations;
  trim_history();
  return {};
}

/// The paper's maintenance, which reads the journal later, keeps what it needs.
void Engine::Conductor::trim_history() {
  if (operations_.size() <= kept_operations_) {
    return;
  }
  for (; operations_.size() > kept_operations_; operations_.pop_front()) {
    oldest_position_ = operations_.front().end;
  }
  journal_.trim(std::min(oldest_position_, paper_maintainer_.first_step()));
}

bool Engine::Conductor::undo() {
  if (is_in_stroke_) {  // what is cut so far becomes an operation, as it stands
    is_in_stroke_ = false;
    cutter_.forget();
    push_operation(true);
  }
  if (operations_.empty()) {
    return false;
  }
  undone_.push_back(operations_.back());
  operations_.pop_back();
  stroke_count_ -= undone_.back().is_stroke ? 1U : 0U;
  const std::size_t target = operations_.empty() ? oldest_position_ : operations_.back().end;
  while (journal_.position() > target) {
    journal_.undo(mesh_);
  }
  maintainer_.forget();
  paper_maintainer_.forget();
  restore_front();
  return true;
}

bool Engine::Conductor::redo() {
  if (is_in_stroke_ || undone_.empty()) {
    return false;
  }
  operations_.push_back(undone_.back());
  undone_.pop_back();
  stroke_count_ += operations_.back().is_stroke ? 1U : 0U;
  while (journal_.position() < operations_.back().end) {
    journal_.redo(mesh_);
  }
  restore_front();
  return true;
}

// --- the engine itself

Result<Engine> Engine::create(TetMesh mesh, EngineOptions options) {
  if (!(options.cut.snap >= 0.0 && options.cut.snap <= 0.4)) {
    return Error{ErrorCode::kBadArgument, "the snapping distance must lie in [0, 0.4] of the mean edge length", {}};
  }
  if (options.threads < 1 || options.threads > 256) {
    return Error{ErrorCode::kBadArgument, "the number of threads must lie in [1, 256]", {}};
  }
  if (options.log && mesh.folds_over_at_load() && (options.maintain.merge || options.maintain.improve)) {
    options.log(LogLevel::kWarning,
                "the mesh folds over itself, since two neighbours lie on one side of the face between them: it is cut, "
                "but not maintained; mesh it again");
  }
  return Engine(std::make_unique<Conductor>(std::move(mesh), std::move(options)));
}

Engine::Engine(std::unique_ptr<Conductor> conductor) : conductor_(std::move(conductor)) {}
Engine::Engine(Engine&&) noexcept = default;
Engine& Engine::operator=(Engine&&) noexcept = default;
Engine::~Engine() = default;

const TetMesh& Engine::mesh() const {
  return conductor_->mesh();
}
const Journal& Engine::journal() const {
  return conductor_->journal();
}
const EngineOptions& Engine::options() const {
  return conductor_->options();
}
std::uint32_t Engine::stroke_count() const {
  return conductor_->stroke_count();
}
std::uint32_t Engine::next_stroke() const {
  return conductor_->next_stroke();
}
bool Engine::is_in_stroke() const {
  return conductor_->is_in_stroke();
}
bool Engine::has_maintenance() const {
  return conductor_->has_maintenance();
}
Status Engine::check_pose(const BladePose& pose) const {
  return conductor_->check_pose(pose);
}
Result<StrokeReport> Engine::cut(const Stroke& stroke) {
  return conductor_->cut(stroke);
}
Result<std::uint32_t> Engine::begin_stroke(const BladePose& pose) {
  return conductor_->begin_stroke(pose);
}
Result<StepReport> Engine::step(const BladePose& pose) {
  return conductor_->step(pose);
}
Result<StrokeReport> Engine::end_stroke() {
  return conductor_->end_stroke();
}
Status Engine::set_positions(std::span<const Vec3> positions) {
  return conductor_->set_positions(positions);
}
Result<MaintainReport> Engine::maintain(std::uint64_t work_units, const ShouldStop& should_stop) {
  return conductor_->maintain(work_units, should_stop);
}
Result<MaintainReport> Engine::improve(const ShouldStop& should_stop) {
  return conductor_->improve(should_stop);
}
bool Engine::undo() {
  return conductor_->undo();
}
bool Engine::redo() {
  return conductor_->redo();
}
Status Engine::keep_undo(std::size_t operations) {
  return conductor_->keep_undo(operations);
}

}  // namespace v0
}  // namespace incise
