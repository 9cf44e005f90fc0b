// SPDX-License-Identifier: Apache-2.0
// The constants of haptic coupling, with what each is measured in and what goes wrong where it is changed. Where no
// source is named a value was chosen by hand.
#pragma once

namespace incise {
inline namespace v0 {
namespace detail {

/// Masses, stiffnesses and the like that are taken lie between, in SI units.
inline constexpr double kLeastAmount = 1e-15, kGreatestAmount = 1e15;

/// The lightest grip, kg, for which a coupling over a link with a delay is to settle, and the share of it by the delay
/// squared that its stiffness may reach: measured, docs/haptics.md.
inline constexpr double kLightestGrip = 0.05, kDelayedStiffness = 0.4;

/// Of the sampled energy, the share that one tick may spend: a force that runs out of energy fades and does not drop.
inline constexpr double kSpent = 0.2;
/// Of the saved energy, the share that one tick may risk. From the rest a drained store grows again, tick by tick.
inline constexpr double kRisked = 0.9;
/// The shortest ticks over a link with a delay, s.
inline constexpr double kShortestDelayedTick = 1e-4;

}  // namespace detail
}  // namespace v0
}  // namespace incise
