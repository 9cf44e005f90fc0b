// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace incise::inline v0 {
namespace io {

/// In the section $Comments of a MSH 4.1 file that Incise wrote: the numbers of its elements are their order.
inline constexpr std::string_view kMshMark = "written by Incise; element numbers tell the order";

}  // namespace io
}  // namespace incise::inline v0
