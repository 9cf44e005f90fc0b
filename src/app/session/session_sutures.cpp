// SPDX-License-Identifier: Apache-2.0
// Sutures that hands set, among the strokes: what was done last is taken back first.
#include "app/session/session_state.h"

namespace incise {
inline namespace v0 {
namespace app {

Status Session::add_suture(const std::array<Vec3, 2>& rest_places, const Suture& suture) {
  State& s = *state_;
  if (s.is_replay) return Error{ErrorCode::kBadArgument, "a recording is played: go on by hand first", {}};
  s.unpicked.clear();
  s.forgets_undone = true;
  return s.sew(rest_places, suture);
}

Status Session::State::sew(const std::array<Vec3, 2>& rest_places, const Suture& suture) {
  const Result<std::uint32_t> id = simulation->add_suture(rest_places, suture);
  if (!id.ok()) return id.error();
  sewn.push_back({{rest_places, suture, *id}, engine_now().stroke_count()});
  note(Operation::Kind::kSuture, suture.pushes ? "Staple set" : "Suture set");
  return {};
}

Result<bool> Session::State::unpick() {
  if (sewn.empty() || engine_now().is_in_stroke() || sewn.back().strokes != engine_now().stroke_count()) return false;
  const Sewn last = sewn.back();
  if (const Status status = simulation->remove_suture(last.call.id); !status.ok()) return status.error();
  sewn.pop_back();
  unpicked.push_back(last);
  note(Operation::Kind::kUndo, last.call.suture.pushes ? "Staple taken out" : "Suture taken out");
  return true;
}

Result<bool> Session::State::sew_again() {
  if (unpicked.empty() || engine_now().is_in_stroke() || unpicked.back().strokes != engine_now().stroke_count()) {
    return false;
  }
  const Sewn last = unpicked.back();
  if (const Status status = sew(last.call.ends, last.call.suture); !status.ok()) return status.error();
  unpicked.pop_back();
  return true;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
