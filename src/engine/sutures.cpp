// SPDX-License-Identifier: Apache-2.0
// Of an end only the place at rest is kept; the tet that holds it is looked for among those that stand there whenever
// its own has changed.
#include "engine/sutures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace incise {
inline namespace v0 {
namespace detail {

namespace {

Error bad(std::string message) {
  return {ErrorCode::kBadArgument, std::move(message), {}};
}

Status check(const Suture& suture) {
  if (!(suture.stiffness > 0 && suture.stiffness <= kGreatestExtent)) {
    return bad("a suture: its stiffness must be above 0 N/m, at most 1e+30");
  }
  if (!(suture.rest_length >= 0 && suture.rest_length <= kGreatestExtent)) {
    return bad("a suture: its rest length must be at least 0 m, at most 1e+30");
  }
  return suture.strength > 0 ? Status{} : Status{bad("a suture: its strength must be above 0 N")};
}

std::string text_of(const Vec3& p) {
  std::ostringstream text;
  text << "(" << p.x() << ", " << p.y() << ", " << p.z() << ")";
  return text.str();
}

std::array<Vec3, 4> rest_corners(const TetMesh& mesh, const TetVertices& vertices) {
  return {mesh.rest(vertices[0]), mesh.rest(vertices[1]), mesh.rest(vertices[2]), mesh.rest(vertices[3])};
}

}  // namespace

Result<std::uint32_t> Sutures::add(const TetMesh& mesh, const std::array<TissuePoint, 2>& ends, const Suture& suture) {
  if (Status status = check(suture); !status) return status.error();
  Entry entry{0, suture, SutureStatus::kWaits, true, {}};
  for (std::size_t i = 0; i < 2; ++i) {
    const TissuePoint& point = ends[i];
    const std::string name = "end " + std::to_string(i) + " of a suture: ";
    if (!point.holds(mesh)) return bad(name + "its tet is not live, or has other vertices");
    const auto is_share = [](double w) { return w >= -1e-9 && w <= 1 + 1e-9; };
    const double sum = std::accumulate(point.weights.begin(), point.weights.end(), 0.0);
    if (!std::all_of(point.weights.begin(), point.weights.end(), is_share) || !(std::abs(sum - 1) < 1e-9)) {
      return bad(name + "its weights must lie in [0, 1] and sum up to 1");
    }
    End& end = entry.ends[i];
    end.point = point;
    end.rest = point.place(mesh, BodyShape::kRest);
    end.corners.fill(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    (void)find(mesh, end);  // so that its weights are those that the place alone gives: undo comes back to them
  }
  return put(std::move(entry));
}

Result<std::uint32_t> Sutures::add(const TetMesh& mesh, const std::array<Vec3, 2>& rest, const Suture& suture) {
  std::array<TissuePoint, 2> ends;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string name = "end " + std::to_string(i) + " of a suture ";
    if (!rest[i].allFinite()) return bad(name + "is not finite");
    if (const auto found = find_nearest(mesh, BodyShape::kRest, rest[i], reach_)) {
      ends[i] = *found;
      continue;
    }
    std::ostringstream message;
    message << name << "is at " << text_of(rest[i]) << ", where there is no tissue at rest";
    if (const auto far = find_nearest(mesh, BodyShape::kRest, rest[i], std::numeric_limits<double>::infinity())) {
      message << "; the nearest is at " << text_of(far->place(mesh, BodyShape::kRest));
    }
    return bad(message.str());
  }
  return add(mesh, ends, suture);
}

std::uint32_t Sutures::put(Entry entry) {
  entry.id = next_id_++;
  all_.push_back(std::move(entry));
  return all_.back().id;
}

Status Sutures::remove(std::uint32_t id) {
  if (std::erase_if(all_, [&](const Entry& entry) { return entry.id == id; }) > 0) return {};
  return bad("there is no suture " + std::to_string(id));
}

void Sutures::begin_frame(std::uint64_t frame) {
  for (Entry& entry : all_) {
    entry.waits = entry.waits && frame < entry.suture.first_frame;
    if (entry.status == SutureStatus::kWaits && !entry.waits) entry.status = SutureStatus::kHolds;
  }
}

void Sutures::follow(const TetMesh& mesh) {
  for (Entry& entry : all_) {
    if (entry.status == SutureStatus::kTorn) continue;
    const bool has_first = find(mesh, entry.ends[0]), has_second = find(mesh, entry.ends[1]);
    if (!has_first || !has_second) {
      entry.status = SutureStatus::kLost;
    } else if (entry.status == SutureStatus::kLost) {
      entry.status = entry.waits ? SutureStatus::kWaits : SutureStatus::kHolds;
    }
  }
}

bool Sutures::find(const TetMesh& mesh, End& end) const {
  const bool has_tet = end.point.holds(mesh);
  if (has_tet && rest_corners(mesh, end.point.vertices) == end.corners) return true;
  std::optional<TissuePoint> found;
  if (has_tet) found = find_among(mesh, BodyShape::kRest, end.rest, {&end.point.tet, 1});
  if (!found) found = find_nearest(mesh, BodyShape::kRest, end.rest, reach_);
  if (!found) return false;
  end.point = *found;
  end.corners = rest_corners(mesh, found->vertices);
  return true;
}

std::vector<std::uint32_t> Sutures::tear(const TetMesh& mesh) {
  std::vector<std::uint32_t> torn;
  for (Entry& entry : all_) {
    if (!(std::abs(state_of(mesh, entry).force) > entry.suture.strength)) continue;
    entry.status = SutureStatus::kTorn;
    torn.push_back(entry.id);
  }
  return torn;
}

static Tie tie_of(const std::array<TissuePoint, 2>& ends, const Suture& suture) {
  return {ends, suture.stiffness, suture.rest_length, suture.pushes};
}

std::vector<Tie> Sutures::ties() const {
  std::vector<Tie> ties;
  for (const Entry& entry : all_) {
    if (entry.status != SutureStatus::kHolds) continue;
    ties.push_back(tie_of({entry.ends[0].point, entry.ends[1].point}, entry.suture));
  }
  return ties;
}

SutureState Sutures::state_of(const TetMesh& mesh, const Entry& entry) const {
  SutureState state{entry.id, entry.suture, entry.status, {}, {}, {Vec3::Zero(), Vec3::Zero()}, 0, 0};
  for (std::size_t i = 0; i < 2; ++i) {
    state.ends[i] = entry.ends[i].point;
    state.rest[i] = entry.ends[i].rest;
  }
  const auto is_there = [&](const TissuePoint& end) { return end.holds(mesh); };
  if (entry.status == SutureStatus::kTorn || entry.status == SutureStatus::kLost) return state;
  if (!std::all_of(state.ends.begin(), state.ends.end(), is_there)) return state;  // a step failed: nobody followed it
  for (std::size_t i = 0; i < 2; ++i) state.places[i] = state.ends[i].place(mesh);
  state.length = unit_ * (state.places[1] - state.places[0]).norm();
  if (entry.status == SutureStatus::kHolds) state.force = tie_of(state.ends, entry.suture).tension(state.length);
  return state;
}

std::vector<SutureState> Sutures::states(const TetMesh& mesh) const {
  std::vector<SutureState> states;
  for (const Entry& entry : all_) states.push_back(state_of(mesh, entry));
  return states;
}

void Sutures::add_to(StateHash& hash) const {
  for (const Entry& entry : all_) {
    hash.add(std::uint64_t{entry.id});
    hash.add(static_cast<std::uint64_t>(entry.status));
    for (const End& end : entry.ends) {
      hash.add(std::uint64_t{end.point.tet.value});
      for (const double weight : end.point.weights) hash.add(weight);
    }
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
