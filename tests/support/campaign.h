// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

namespace incise::test {

/// Whether campaigns run as a whole, as they do at night (INCISE_CAMPAIGNS_ALL=1), and not a slice of each.
inline bool is_whole_campaign() {
  return std::getenv("INCISE_CAMPAIGNS_ALL") != nullptr;
}

/// `slice`, or `whole` where campaigns run as a whole.
template <class T>
T of_campaign(T slice, T whole) {
  return is_whole_campaign() ? whole : slice;
}

}  // namespace incise::test
