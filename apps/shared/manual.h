// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace incise_apps {

/// The manual page of a program, or of one of its commands, for man(7): what `--help` prints, in its form.
/// @param version  for the page's foot.
[[nodiscard]] std::string manual_page(const CLI::App& root, const CLI::App& command, const std::string& version);

}  // namespace incise_apps
