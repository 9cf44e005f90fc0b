// SPDX-License-Identifier: Apache-2.0
// The constants of the reference solver, with what each is measured in. All were chosen by hand.
#pragma once

#include <cstddef>

namespace incise {
inline namespace v0 {
namespace detail {

/// Progress in energy that a line search asks for, as a share of what the slope promises.
inline constexpr double kSufficient = 1e-4;
/// The energy's rounding errors, as a share of the sizes of its terms.
inline constexpr double kReferenceNoise = 1e-14;
/// A step is halved so often before it is given up.
inline constexpr int kMostStepHalvings = 40;
/// So often a matrix that gives no way down is made stiffer in one step.
inline constexpr std::size_t kMostSingular = 3;

}  // namespace detail
}  // namespace v0
}  // namespace incise
