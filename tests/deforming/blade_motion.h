// SPDX-License-Identifier: Apache-2.0
// How people move a blade: eight motions of a straight, oblique edge through a body, from above and in the world.
#pragma once

#include <cstdint>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/geom/box.h"
#include "support/random.h"

namespace incise::test {

enum class Motion : std::uint8_t {
  kStraight,
  kPause,         ///< waits at half depth
  kTremor,        ///< shakes by 0.08 of the spacing
  kReversal,      ///< down by 0.6 of the way, back by half of that, on
  kCurve,         ///< sideways on the way down
  kWithdrawal,    ///< back from half depth and out: the body stays in one piece
  kReentry,       ///< the same, then in again and through
  kStrongTremor,  ///< shakes by 0.3 of the spacing
};
inline constexpr unsigned kMotions = 8;

/// A blade's way through a body whose rest box is `box`.
class BladeMotion {
 public:
  /// `seed` draws the two slants, the place and the tremor. `spacing`: length of the body's usual edge; the edge has
  /// points 0.23 of it apart.
  BladeMotion(Motion motion, const Box& box, double spacing, std::uint64_t seed);

  /// Where the blade is at a share of the time, in [0, 1]; the same frame twice shakes differently.
  [[nodiscard]] BladePose pose(double time);
  [[nodiscard]] const char* name() const;
  /// How many pieces a convex body falls into.
  [[nodiscard]] std::size_t expected_pieces() const { return motion_ == Motion::kWithdrawal ? 1 : 2; }
  [[nodiscard]] const Vec3& direction() const { return down_; }

 private:
  [[nodiscard]] double depth(double share) const;
  [[nodiscard]] double tremor() const;

  Motion motion_;
  Random random_;
  double spacing_, length_, sway_ = 0;
  double above_, below_;                 // along down_: from the first place to the body's middle, and on to the last
  Vec3 middle_, along_, down_, across_;  // where the middle of the edge passes the body's; unit vectors
};

}  // namespace incise::test
