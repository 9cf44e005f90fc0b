// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/core/result.h"
#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace app {

/// When what a device says is believed. Times in s.
struct DeviceGuardOptions {
  double silence = 0.02;   ///< without a word after which it counts as gone; above 0
  double max_speed = 3;    ///< m/s, above 0, of its places and in its words: hands that cut stay below 1
  double max_step = 5e-3;  ///< m beyond what `max_speed` allows between two words, at least 0: for noise and late words
  double settle = 0.1;     ///< of sound words after anything unsound, before it is believed again; at least 0
  double recovery = 0.25;  ///< over which the force then comes back; above 0
};

/// Errors: kBadArgument names the first option out of its range.
[[nodiscard]] Status check(const DeviceGuardOptions& options);

/// Judges a device by when it speaks and where it says it is: silence, jumps and words that make no sense take the
/// force away at once, and it comes back slowly. No clock: times are handed in, and never fall.
class DeviceGuard {
 public:
  explicit DeviceGuard(const DeviceGuardOptions& options = {}) : options_(options) {}

  /// Takes in where the device says that it is: `position`, m, and `velocity`, m/s, by which dampers push. Returns
  /// false, and does as `lose`, where no hand can have come there or be so fast.
  bool hear(double time, const Vec3& position, const Vec3& velocity = Vec3::Zero());
  /// It made no sense, or went away.
  void lose(double time);

  /// Whether it is believed.
  [[nodiscard]] bool is_live(double time) const;
  /// The share of a force that it may get, in [0, 1]; 0 where it is not believed.
  [[nodiscard]] double share(double time) const;

 private:
  DeviceGuardOptions options_;
  bool was_heard_ = false;
  double heard_at_ = 0, live_from_ = 0;
  Vec3 position_ = Vec3::Zero();
};

}  // namespace app
}  // namespace v0
}  // namespace incise
