// SPDX-License-Identifier: Apache-2.0
// The lines of a simulation's recording as text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "app/recording/simulation_recording.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The name of a call in recordings and messages.
[[nodiscard]] const char* name_of(SimulationCallKind kind);

/// One line, with a newline at the end.
[[nodiscard]] std::string to_line(const SimulationHeader& header);
[[nodiscard]] std::string to_line(const SimulationCall& call);

/// Errors: kBadFile "FILE:LINE: what".
[[nodiscard]] Result<SimulationHeader> parse_simulation_header(std::string_view text, std::string_view file_name,
                                                               const std::filesystem::path& folder);
[[nodiscard]] Result<SimulationCall> parse_simulation_call(std::string_view text, std::string_view file_name,
                                                           std::uint32_t line);

}  // namespace app
}  // namespace v0
}  // namespace incise
