// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace incise {
inline namespace v0 {
namespace app {

/// "1 step", "2 steps": a number with what it counts. `one`: a word whose plural takes an s.
inline std::string counted(std::uint64_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

}  // namespace app
}  // namespace v0
}  // namespace incise
