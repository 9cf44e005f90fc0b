// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "app/jobs/latency_histogram.h"
#include "app/scene/scene.h"
#include "incise/sim/haptic_tool.h"
#include "incise/sim/simulated_operator.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What a hand felt over a whole scene.
struct HapticFigures {
  std::uint64_t ticks = 0;     ///< of 1 ms
  double peak_force = 0;       ///< on the hand, N
  double sampled_minimum = 0;  ///< least observed energy, J: the controller keeps it from falling below 0
  double held_minimum = 0;     ///< likewise of the force that is held over each tick
  double removed_energy = 0;   ///< by the passivity controller, J
  Percentiles compute_us;      ///< of one tick
};

/// A simulated hand that holds the blade of a scene by a force-feedback device at 1 kHz: what a scene feels like,
/// without a device.
///
/// The hand (a mass on a spring and a damper) means to go where the scene's blade goes, and yields to the force; the
/// scene goes its own way. Between two frames it feels the tissue as the last snapshot tells it. SI units.
class SceneHand {
 public:
  explicit SceneHand(const Scene& scene);

  /// The ticks of one frame, after it was simulated: `snapshot` is `Simulation::haptic_snapshot` now.
  /// Cost: about 0.2 µs per millisecond of the frame. The clock is read for the figures alone.
  void feel(std::uint64_t frame, const HapticSnapshot& snapshot);

  [[nodiscard]] HapticFigures figures() const;

 private:
  void pick_up(std::uint64_t frame);
  void tick(double time);

  const Scene& scene_;
  HapticTool tool_;
  std::optional<SimulatedOperator> hand_;  // while the scene has a blade
  double picked_up_ = 0;                   // s
  double peak_force_ = 0;
  LatencyHistogram compute_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
