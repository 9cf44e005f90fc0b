// SPDX-License-Identifier: Apache-2.0
// One copy of the mesh is checked at a time; while it is, the newest state is not taken, so that the light may be late
// but the thread never falls behind.
#include "app/session/validity_monitor.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "incise/mesh/validate.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

ValidityLight light_of(const ValidityReport& now, const ValidityChange& change) {
  if (change.ok && now.ok) return {ValidityState::kValid, "valid"};
  std::string text;
  for (std::size_t i = 0; i < kViolationKinds; ++i) {
    const std::uint64_t count = change.ok ? now.counts[i] : change.grown[i];
    if (count == 0) continue;
    text +=
        (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(name_of(static_cast<ViolationKind>(i)));
  }
  if (change.ok) return {ValidityState::kValid, "as sound as the input: " + text};
  return {ValidityState::kBroken, text};
}

}  // namespace

struct ValidityMonitor::State {
  double tolerance = 0;
  std::mutex mutex;  // of all below
  std::condition_variable wakes;
  std::optional<TetMesh> mesh;  // to be checked
  bool is_busy = false;
  bool quits = false;
  std::optional<ValidityReport> first;  // of the input
  ValidityLight light;
  std::thread thread;  // last: it uses the rest

  void run();
  void check_one(const TetMesh& checked);
};

void ValidityMonitor::State::run() {
  std::unique_lock lock(mutex);
  while (true) {
    wakes.wait(lock, [&] { return quits || mesh.has_value(); });
    if (quits) return;
    const TetMesh checked = std::move(*mesh);
    mesh.reset();
    lock.unlock();
    check_one(checked);
    lock.lock();
    is_busy = false;
  }
}

void ValidityMonitor::State::check_one(const TetMesh& checked) {
  ValidateOptions options;
  options.volume_tolerance = tolerance;
  if (first) options.expected_volume = first->volume;
  const ValidityReport report = validate(checked, ValidateLevel::kGeometry, options);
  if (!first) first = report;
  const ValidityLight found = light_of(report, compare_with_input(*first, report));
  const std::lock_guard lock(mutex);
  light = found;
}

ValidityMonitor::ValidityMonitor(const TetMesh& mesh, double volume_tolerance) : state_(std::make_unique<State>()) {
  state_->tolerance = volume_tolerance;
  state_->thread = std::thread([state = state_.get()] { state->run(); });
  check(mesh);
}

ValidityMonitor::ValidityMonitor(ValidityMonitor&&) noexcept = default;

ValidityMonitor& ValidityMonitor::operator=(ValidityMonitor&& other) noexcept {
  std::swap(state_, other.state_);
  return *this;
}

ValidityMonitor::~ValidityMonitor() {
  if (!state_) return;
  {
    const std::lock_guard lock(state_->mutex);
    state_->quits = true;
  }
  state_->wakes.notify_one();
  state_->thread.join();
}

bool ValidityMonitor::check(const TetMesh& mesh) {
  const std::lock_guard lock(state_->mutex);
  if (state_->is_busy) return false;
  state_->mesh = mesh;
  state_->is_busy = true;
  state_->light = {ValidityState::kChecking, "checking"};
  state_->wakes.notify_one();
  return true;
}

ValidityLight ValidityMonitor::light() const {
  const std::lock_guard lock(state_->mutex);
  return state_->light;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
