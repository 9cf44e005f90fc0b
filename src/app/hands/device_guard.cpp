// SPDX-License-Identifier: Apache-2.0
// Trust as one moment, `live_from_`: a jump, a silence or a word without sense moves it ahead, and the share of force
// grows from it linearly.
#include "app/hands/device_guard.h"

#include <algorithm>
#include <cmath>

namespace incise {
inline namespace v0 {
namespace app {

Status check(const DeviceGuardOptions& options) {
  const auto bad = [](const char* what) { return Error{ErrorCode::kBadArgument, what, {}}; };
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0; };
  const auto is_natural = [](double value) { return std::isfinite(value) && value >= 0; };
  if (!is_positive(options.silence)) return bad("the silence of a device that counts as gone must be above 0 s");
  if (!is_positive(options.max_speed)) return bad("the greatest speed of a device must be above 0 m/s");
  if (!is_natural(options.max_step)) return bad("the greatest step of a device must be at least 0 m");
  if (!is_natural(options.settle)) return bad("the time for which a device settles must be at least 0 s");
  if (!is_positive(options.recovery)) return bad("the time over which a force comes back must be above 0 s");
  return {};
}

bool DeviceGuard::hear(double time, const Vec3& position, const Vec3& velocity) {
  if (!position.allFinite() || !(velocity.norm() <= options_.max_speed)) {
    lose(time);
    return false;
  }
  const bool is_anew = !was_heard_ || time - heard_at_ > options_.silence;
  const double most = options_.max_step + options_.max_speed * (time - heard_at_);
  const bool has_jumped = !is_anew && (position - position_).norm() > most;
  if (is_anew || has_jumped) live_from_ = time + options_.settle;
  was_heard_ = true;
  heard_at_ = time;
  position_ = position;
  return !has_jumped;
}

void DeviceGuard::lose(double time) {
  was_heard_ = false;
  live_from_ = time + options_.settle;
}

bool DeviceGuard::is_live(double time) const {
  return was_heard_ && time - heard_at_ <= options_.silence && time >= live_from_;
}

double DeviceGuard::share(double time) const {
  if (!is_live(time)) return 0;
  return std::clamp((time - live_from_) / options_.recovery, 0.0, 1.0);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
