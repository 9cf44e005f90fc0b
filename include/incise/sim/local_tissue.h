// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/sim/haptic_snapshot.h"

namespace incise {
inline namespace v0 {

/// When the tissue at the edge gives way, relative to what cutting costs. Both are ratios, 1.
struct RuptureOptions {
  /// Toughness is felt this many times over before the first crack opens; at least 1. The force drops at rupture.
  double onset = 1.2;
  /// Cutting ends once the force along the cut is below this share of the cutting force; in [0, 1).
  double arrest = 0.5;
};

/// The tissue around the blade between two physics steps: elastic, with dry yield in the plane of the blade.
///
/// Along the cutting direction the tissue resists up to `fracture_force · onset + friction_force`; then it ruptures,
/// and resists with `fracture_force + friction_force` while the blade goes on (deform, rupture, cut). Drawn back, or
/// moved along its own edge, where it opens no new face, the blade meets friction alone. Across its flat it meets the
/// elastic body. What yields is remembered as slip, so the way back is another (hysteresis).
/// **Source:** Mahvash & Hayward 2001, Okamura et al. 2004 (energy balance of cutting). *Differs:* the elastic part is
/// the physics' own local compliance, not a measured curve.
///
/// One thread. No call allocates.
class LocalTissue {
 public:
  /// Without tissue, until `follow`.
  explicit LocalTissue(const RuptureOptions& options = {}) : options_(options) {}

  /// Starts from a sound snapshot (`is_sound`), without slip.
  void follow(const HapticSnapshot& snapshot);

  /// The force on a tool, N, that a spring holds to `handle`; the tool then stands at `handle + force / spring`.
  ///
  /// @param spring  N/m, above 0.  @param handle  m, where the tool would stand without tissue.
  /// Spring and tissue are in equilibrium: C F = C F₀ - (x - x₀) + slip with x = handle + F/spring, which is solved at
  /// once whether the tissue is soft or rigid. Cost: one 3×3 inverse, about 100 ns.
  Vec3 force(double spring, const Vec3& handle);

  [[nodiscard]] const HapticSnapshot& snapshot() const { return snapshot_; }  ///< as followed last
  /// How far the edge has cut on since the snapshot, m.
  [[nodiscard]] double cut_slip() const { return cut_slip_; }
  [[nodiscard]] bool is_cutting() const { return is_cutting_; }  ///< the tissue has ruptured at the edge

 private:
  struct Limits {
    double low = 0;
    double high = 0;
  };
  [[nodiscard]] Limits cut_limits() const;
  void switch_rupture(double force_along_cut);

  RuptureOptions options_;
  HapticSnapshot snapshot_;
  double cut_slip_ = 0, edge_slip_ = 0;  ///< m
  bool is_cutting_ = false;
};

}  // namespace v0
}  // namespace incise
