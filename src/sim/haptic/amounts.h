// SPDX-License-Identifier: Apache-2.0
// Which numbers options and snapshots may have.
#pragma once

#include <cmath>

namespace incise {
inline namespace v0 {
namespace detail {

[[nodiscard]] inline bool is_amount(double number) {
  return number >= 0 && std::isfinite(number);
}

[[nodiscard]] inline bool is_positive(double number) {
  return number > 0 && std::isfinite(number);
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
