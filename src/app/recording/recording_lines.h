// SPDX-License-Identifier: Apache-2.0
// The lines of a recording as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "app/recording/recording.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The name of a call in recordings and messages.
[[nodiscard]] const char* name_of(CallKind kind);

/// One line, with a newline at the end.
[[nodiscard]] std::string to_line(const RecordingHeader& header);
[[nodiscard]] std::string to_line(const RecordedCall& call);

/// Errors: kBadFile "FILE:LINE: what".
[[nodiscard]] Result<RecordingHeader> parse_header(std::string_view text, std::string_view file_name);
[[nodiscard]] Result<RecordedCall> parse_call(std::string_view text, std::string_view file_name, std::uint32_t line);

}  // namespace app
}  // namespace v0
}  // namespace incise
