// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "incise/core/result.h"
#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {

/// What force feedback knows of the tissue at the blade: the state of the last physics step, linear around the tool.
///
/// SI units, world axes. Written by the physics at its own rate (20 to 100 Hz), read at 1 kHz or more; it crosses
/// threads in a `TripleBuffer`. The force on the tool at `x` is `force - compliance⁻¹ (x - tool_position)`, up to the
/// yield limits that follow from the numbers below (`LocalTissue`).
struct HapticSnapshot {
  std::uint64_t serial = 0;                              ///< 1, 2, …: the physics step; 0: nothing known yet
  bool touches = false;                                  ///< false: the tool is free, the rest is not read
  bool ruptured = false;                                 ///< the tissue yields at the edge now: the blade cuts
  Vec3 tool_position = Vec3::Zero();                     ///< m, of the tool point that `force` was computed for
  Vec3 force = Vec3::Zero();                             ///< N, of the tissue on the tool
  Eigen::Matrix3d compliance = Eigen::Matrix3d::Zero();  ///< m/N, symmetric, no negative eigenvalue; 0: rigid
  Vec3 contact_point = Vec3::Zero();                     ///< m, origin of the contact frame; for display and torques
  Vec3 cutting_direction = Vec3::UnitX();                ///< unit: the way the edge advances
  Vec3 flat_normal = Vec3::UnitZ();                      ///< unit, orthogonal to `cutting_direction`
  double engaged_length = 0;                             ///< m of edge in the tissue, at least 0
  double toughness = 0;                                  ///< J/m² of cut face, at least 0
  double cut_friction = 0;                               ///< N per m of engaged edge, at least 0

  /// The direction along the edge: unit.
  [[nodiscard]] Vec3 edge_direction() const { return flat_normal.cross(cutting_direction); }
  /// What cutting on costs, N: toughness · length, without friction.
  [[nodiscard]] double fracture_force() const { return toughness * engaged_length; }
  /// What the flanks of the edge rub with, N.
  [[nodiscard]] double friction_force() const { return cut_friction * engaged_length; }
};

/// Whether all promises above hold (directions to 1e-6). No allocation; any thread. Cost: tens of ns.
[[nodiscard]] bool is_sound(const HapticSnapshot& snapshot);

/// `is_sound` in words, for whoever fills snapshots. Errors: kBadArgument names the first promise that is broken.
[[nodiscard]] Status check(const HapticSnapshot& snapshot);

}  // namespace v0
}  // namespace incise
