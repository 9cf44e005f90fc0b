// SPDX-License-Identifier: Apache-2.0
// Where the commands' meshes go: a file or stdout, in the format that its extension or --format names.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "incise/io/mesh_file.h"
#include "terminal.h"

namespace incise_cli {

/// Where a mesh is written, and as what.
struct MeshOutput {
  std::string file;    ///< "-": stdout; empty: nowhere
  std::string format;  ///< a name of `io::write_options_named`; empty: what the extension says

  [[nodiscard]] bool is_wanted() const { return !file.empty(); }
  [[nodiscard]] bool is_stdout() const { return file == "-"; }
};

/// What is wrong with an output, as far as its name and format tell; nothing where it can be written.
struct OutputProblem {
  std::string text;
  ExitCode code = kUsage;
};
[[nodiscard]] std::optional<OutputProblem> problem_of(const MeshOutput& output,
                                                      const std::vector<std::string>& more_formats = {});

/// Names of formats for --format: those of meshes, and `more`.
[[nodiscard]] std::vector<std::string> format_names(const std::vector<std::string>& more = {});

/// All files that a mesh of this name is in: of a .node the .ele as well. Empty for stdin, stdout and no name.
[[nodiscard]] std::vector<std::string> files_of(const std::string& mesh);

/// The options that the output's name and format stand for; `problem_of` found nothing.
[[nodiscard]] incise::io::WriteOptions write_options_of(const MeshOutput& output);

/// Writes the mesh, and says so. Errors: as `io::write_mesh`.
[[nodiscard]] incise::Status write_output(const MeshOutput& output, const incise::io::MeshData& mesh,
                                          const Terminal& terminal);

/// "750 tets, 216 vertices".
[[nodiscard]] std::string counts_text(std::size_t tets, std::size_t vertices);

/// "a.node and a.ele".
[[nodiscard]] std::string names_text(const std::vector<std::filesystem::path>& files);

}  // namespace incise_cli
