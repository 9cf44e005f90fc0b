// SPDX-License-Identifier: Apache-2.0
// The part of a session that plays recordings.
#include <utility>

#include "app/jobs/replay_job.h"
#include "app/session/session_state.h"
#include "app/text/json_write.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

bool has_blade(const SimulationCall& call) {
  return call.kind == SimulationCallKind::kFrame && call.input.blade.has_value();
}

/// Whether a person would call this the end of a step: a stroke ends, or something is taken back.
bool ends_step(const std::vector<SimulationCall>& calls, std::size_t i) {
  const SimulationCallKind kind = calls[i].kind;
  if (kind != SimulationCallKind::kFrame && kind != SimulationCallKind::kSettle) return true;
  return i > 0 && has_blade(calls[i - 1]) && !has_blade(calls[i]);
}

bool ends_step(const std::vector<RecordedCall>& calls, std::size_t i) {
  switch (calls[i].kind) {
    case CallKind::kBegin:
    case CallKind::kStep:
    case CallKind::kPositions:
    case CallKind::kMaintain:
      return false;
    default:
      return true;
  }
}

}  // namespace

Status Session::State::play_call() {
  const std::size_t i = next_call++;
  if (is_engine_replay) return play(engine_calls[i]);
  const Status status = play(calls[i]);
  if (next_call == calls.size() && status.ok()) compare_at_end(calls[i]);
  return status;
}

Status Session::State::play(const SimulationCall& call) {
  const auto status_of = [](const auto& result) { return result.ok() ? Status() : Status(result.error()); };
  switch (call.kind) {
    case SimulationCallKind::kSettle:
      return status_of(simulation->settle(call.settle));
    case SimulationCallKind::kFrame:
      return run(call.input);
    case SimulationCallKind::kUndo:
      note(Operation::Kind::kUndo, "Stroke taken back");
      return status_of(simulation->undo());
    case SimulationCallKind::kRedo:
      note(Operation::Kind::kRedo, "Stroke made again");
      return status_of(simulation->redo());
    case SimulationCallKind::kSuture:
      return sew(call.suture.ends, call.suture.suture);
    case SimulationCallKind::kUnpick:
      std::erase_if(sewn, [&](const Sewn& suture) { return suture.call.id == call.suture.id; });
      note(Operation::Kind::kUndo, "Suture taken out");
      return simulation->remove_suture(call.suture.id);
  }
  return {};
}

Status Session::State::play(const RecordedCall& call) {
  const std::uint32_t strokes = engine->stroke_count();
  Result<std::optional<ReplayDifference>> done = replay_call(*engine, call, false, recording_name);
  ++figures.frames;
  last_input.blade.reset();
  if (call.kind == CallKind::kBegin || call.kind == CallKind::kStep) last_input.blade = call.pose;
  count();
  if (engine->stroke_count() > strokes) note(Operation::Kind::kStroke, "Stroke " + std::to_string(strokes + 1));
  if (engine->stroke_count() < strokes) note(Operation::Kind::kUndo, "Stroke taken back");
  if (!done.ok()) return done.error();
  if (next_call == engine_calls.size()) {
    const bool is_same = call.hash == engine->mesh().hash();
    note(Operation::Kind::kReplay,
         is_same ? "End: the same mesh as was recorded" : "End: NOT the mesh that was recorded");
  }
  return {};
}

void Session::State::compare_at_end(const SimulationCall& call) {
  if (!call.hash) return note(Operation::Kind::kReplay, "End of the recording");
  const bool is_same = *call.hash == simulation->simulation().hash();
  note(Operation::Kind::kReplay,
       is_same ? "End: the same state as was recorded" : "End: NOT the state that was recorded");
}

bool Session::is_replay() const {
  return state_->is_replay;
}

ReplayPlace Session::place() const {
  if (!state_->is_replay) return {};
  return {state_->next_call, state_->call_count()};
}

Status Session::seek(std::uint64_t call, const ShouldStop& should_stop) {
  State& s = *state_;
  if (!s.is_replay) return {};
  if (call < s.next_call) {
    stop_recording();  // it would go back as well
    if (Status status = s.start(); !status.ok()) return status;
  }
  while (s.next_call < std::min<std::uint64_t>(call, s.call_count())) {
    if (Status status = s.play_call(); !status.ok()) return status;
    if (should_stop && should_stop()) break;
  }
  return {};
}

Status Session::seek_next_step(const ShouldStop& should_stop) {
  const State& s = *state_;
  if (!s.is_replay) return {};
  std::size_t i = s.next_call;
  while (i < s.call_count() && !(s.is_engine_replay ? ends_step(s.engine_calls, i) : ends_step(s.calls, i))) ++i;
  return seek(i + 1, should_stop);
}

bool Session::take_over() {
  State& s = *state_;
  if (s.is_engine_replay) return false;
  if (s.is_replay) s.note(Operation::Kind::kReplay, "The recording ends here: go on by hand");
  // The recording's blade is lifted before the hand's is set down.
  if (s.is_replay && s.last_input.blade) s.blade_source = State::BladeSource::kScript;
  s.is_replay = false;
  s.plays_script = false;
  if (s.options.keep_undo > 0 && s.simulation) static_cast<void>(s.simulation->keep_undo(s.options.keep_undo));
  return true;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
