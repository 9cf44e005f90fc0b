// SPDX-License-Identifier: Apache-2.0
#include "deforming/blade_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace incise::test {

namespace {

constexpr double kPointDistance = 0.23;  // of the spacing
constexpr double kHalf = 0.5;            // of the way: the middle of the body's rest box

/// Piecewise linear through (time, share of the way), ascending in time from 0 to 1.
double follow(std::span<const std::pair<double, double>> knots, double time) {
  std::size_t i = 1;
  while (i + 1 < knots.size() && knots[i].first < time) ++i;
  const auto [t0, s0] = knots[i - 1];
  const auto [t1, s1] = knots[i];
  return s0 + (s1 - s0) * std::clamp((time - t0) / (t1 - t0), 0.0, 1.0);
}

using Knots = std::vector<std::pair<double, double>>;

Knots knots_of(Motion motion) {
  switch (motion) {
    case Motion::kPause:
      return {{0, 0}, {0.4, kHalf}, {0.6, kHalf}, {1, 1}};
    case Motion::kReversal:
      return {{0, 0}, {0.4, 0.6}, {0.6, 0.3}, {1, 1}};
    case Motion::kWithdrawal:
      return {{0, 0}, {0.5, kHalf}, {1, 0}};
    case Motion::kReentry:
      return {{0, 0}, {0.3, kHalf}, {0.5, 0}, {1, 1}};
    default:
      return {{0, 0}, {1, 1}};
  }
}

}  // namespace

BladeMotion::BladeMotion(Motion motion, const Box& box, double spacing, std::uint64_t seed)
    : motion_(motion), random_(seed), spacing_(spacing) {
  const Vec3 size = box.hi - box.lo;
  const double yaw = random_.real(-0.3, 0.3), roll = random_.real(-0.25, 0.25), lean = random_.real(-0.25, 0.25);
  along_ = Vec3(yaw, 1, roll).normalized();
  down_ = Vec3(lean, 0, -1);
  down_ = (down_ - down_.dot(along_) * along_).normalized();
  across_ = along_.cross(down_);
  length_ = 1.7 * size.y();
  const double reach = std::abs(along_.z()) * 0.5 * length_ + 0.6 * spacing;  // no end of the edge starts inside
  middle_ = 0.5 * (box.lo + box.hi) + Vec3(random_.real(-0.1, 0.1) * size.x(), 0, 0);
  above_ = (0.5 * size.z() + reach) / -down_.z();
  below_ = (1.3 * size.z() + reach) / -down_.z();  // cut bodies sag
  if (motion == Motion::kCurve) sway_ = 0.15 * size.x();
}

const char* BladeMotion::name() const {
  static constexpr std::array<const char*, kMotions> kNames = {"straight", "pause",      "tremor",  "reversal",
                                                               "curve",    "withdrawal", "reentry", "strong tremor"};
  return kNames[static_cast<std::size_t>(motion_)];
}

/// How far along `down_` from the body's middle at a share of the way.
double BladeMotion::depth(double share) const {
  const double from_half = (share - kHalf) / kHalf;
  return from_half * (from_half < 0 ? above_ : below_);
}

double BladeMotion::tremor() const {
  if (motion_ == Motion::kTremor) return 0.08 * spacing_;
  return motion_ == Motion::kStrongTremor ? 0.3 * spacing_ : 0.0;
}

BladePose BladeMotion::pose(double time) {
  const Knots knots = knots_of(motion_);
  const double share = follow(knots, time), shake = tremor();
  const double shaken_down = random_.real(-1, 1) * shake, shaken_across = random_.real(-1, 1) * shake;
  const double sway = sway_ * (4 * share * (1 - share) - 0.5);
  const Vec3 middle = middle_ + (depth(share) + shaken_down) * down_ + (sway + shaken_across) * across_;
  const auto pieces = static_cast<unsigned>(std::ceil(length_ / (kPointDistance * spacing_)));
  BladePose pose;
  for (unsigned i = 0; i <= pieces; ++i) {
    pose.edge.emplace_back(middle + length_ * (static_cast<double>(i) / pieces - 0.5) * along_);
  }
  pose.direction = down_ + 4 * sway_ * (1 - 2 * share) / (above_ + below_) * across_;
  return pose;
}

}  // namespace incise::test
