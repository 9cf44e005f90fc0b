// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "incise/core/result.h"
#include "incise/sim/local_tissue.h"
#include "incise/sim/passivity.h"

namespace incise {
inline namespace v0 {

/// How a blade in the hand feels.
/// Numbers above 0 lie in [1e-15, 1e15], others in [0, 1e15].
struct HapticToolOptions {
  double coupling_stiffness = 500;   ///< N/m between device and tool, above 0; 300 to 800 suits desktop arms
  double coupling_damping = 1;       ///< N·s/m on the stretch of the coupling, at least 0
  double drag = 0.3;                 ///< N·s/m on the device at all times; above half of (stiffness · dt) it pays for
                                     ///< what sampling gives away (Colgate & Brown 1994); more over a delayed link
  double max_stretch = 0.01;         ///< m, at most between device and tool; above 0
  double max_force = 3.3;            ///< N on the device, above 0; 3.3 N is a common desktop arm's peak
  double physics_period = 1.0 / 60;  ///< s: the time over which the force goes over to a new snapshot; at least 0
  RuptureOptions rupture;            ///< when the tissue gives way
  PassivityOptions passivity;        ///< how much energy may come back
};

/// Errors: kBadArgument names the first option out of its range.
[[nodiscard]] Status check(const HapticToolOptions& options);

/// The blade in the hand at 1 kHz: a device coupled to a tool that feels the last physics snapshot.
///
/// The tool has no mass. A spring and damper hold it to the device (virtual coupling), the tissue of the snapshot holds
/// it back, and each tick puts it where both agree, so no stiffness can make it unstable. A new snapshot does not
/// click: the difference to the old one at the same place fades over one physics period. What is felt passes the
/// passivity controller last. `tool_position` is what the physics should move its blade to.
/// Over a link with a delay (`PassivityOptions::link_delay`) the drag is at least stiffness · (dt/2 + both ways), and
/// the coupling no stiffer than 0.02 kg by the square of both ways: 556 N/m at 3 ms each way, 200 N/m at 5 ms.
/// **Source:** Colgate, Stanley & Brown 1995 (virtual coupling); Colgate & Brown 1994 (passivity of sampled walls);
/// Gil, Sánchez, Hulin, Preusche & Hirzinger 2009 (stability of walls over a delay: stiffness below damping by dt/2 +
/// delay).
///
/// One thread, O(1) without a delay, no allocation, no clock, no libm but sqrt: equal inputs give equal bits. About 0.3
/// µs per tick.
class HapticTool {
 public:
  /// Options that `check` refuses give a tool that stays unspecified but finite.
  explicit HapticTool(const HapticToolOptions& options = {});

  /// Takes over a snapshot; it counts from the next tick on. False, and no effect, where it is not sound, or its
  /// serial is not above the last one's.
  bool accept(const HapticSnapshot& snapshot);

  /// The force to command, N on the device, at most max_force.
  ///
  /// @param dt  s since the last tick, in [kShortestTick, kLongestTick]; usually 1e-3.
  /// @param device_position  m, within 1e15.
  /// @param device_velocity  m/s, within 1e15; where the device has none, its last displacement over dt.
  /// Input that `check_tick` refuses gives no force and changes nothing else; the next sound tick starts anew.
  Vec3 tick(double dt, const Vec3& device_position, const Vec3& device_velocity);
  /// Whether `tick` takes these. Errors: kBadArgument names the first that is out of its range.
  [[nodiscard]] static Status check_tick(double dt, const Vec3& device_position, const Vec3& device_velocity);
  static constexpr double kShortestTick = 1e-9, kLongestTick = 1;  ///< s

  [[nodiscard]] const Vec3& tool_position() const { return tool_position_; }  ///< m, after the last tick
  [[nodiscard]] const Vec3& force() const { return force_; }                  ///< N, what the last tick returned
  /// Force of the tissue on the tool at the last tick, N, before the limits of device and passivity.
  [[nodiscard]] const Vec3& tissue_force() const { return tissue_force_; }
  /// The tissue as the last snapshot has it.
  [[nodiscard]] const LocalTissue& tissue() const { return tissue_; }
  /// What the passivity controller saw and did.
  [[nodiscard]] PassivityReport passivity() const { return controller_.report(); }
  [[nodiscard]] std::uint64_t ticks() const { return ticks_; }  ///< so far
  /// The drag on the device with ticks of `dt` s, N·s/m: as asked for, or more over a link with a delay.
  [[nodiscard]] double drag(double dt) const;
  /// N/m: as asked for, or less over a link with a delay.
  [[nodiscard]] double coupling_stiffness() const { return options_.coupling_stiffness; }

 private:
  struct Coupling {
    double stiffness = 0;        ///< N/m: spring and damper over this dt
    Vec3 rest = Vec3::Zero();    ///< m: the stretch that damping alone would leave
    Vec3 handle = Vec3::Zero();  ///< m: the tool without tissue
  };
  [[nodiscard]] Coupling couple(double dt, const Vec3& device_position) const;
  Vec3 blend(double dt, const Coupling& coupling);
  void place_tool(const Coupling& coupling, const Vec3& device_position);
  Vec3 stop();

  HapticToolOptions options_;
  LocalTissue tissue_;
  PassivityController controller_;
  HapticSnapshot pending_;
  bool has_pending_ = false;
  bool has_moved_ = false;  ///< the position below is of the tick before
  Vec3 device_position_ = Vec3::Zero(), tool_position_ = Vec3::Zero();
  Vec3 stretch_ = Vec3::Zero();
  Vec3 tissue_force_ = Vec3::Zero(), force_ = Vec3::Zero();
  Vec3 fading_ = Vec3::Zero();  ///< N: what is left of earlier snapshots when the present one came
  double fading_left_ = 0;      ///< s
  std::uint64_t ticks_ = 0;
};

}  // namespace v0
}  // namespace incise
