// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace io {

/// Parse all of `token` as a decimal number, correctly rounded, in any locale.
///
/// Takes Fortran's `D` exponents; refuses hexadecimal, infinity and NaN. Underflow gives zero.
[[nodiscard]] bool parse_double(std::string_view token, double& out);

/// Parse all of `token` as a decimal integer.
[[nodiscard]] bool parse_int(std::string_view token, std::int64_t& out);

}  // namespace io
}  // namespace v0
}  // namespace incise
