// SPDX-License-Identifier: Apache-2.0
// Extension and --format must agree; what neither tells is asked for.
#include "mesh_output.h"

#include <filesystem>
#include <utility>

#include "app/model/convert.h"
#include "command_support.h"

namespace incise_cli {
namespace {

namespace fs = std::filesystem;
using namespace incise;

/// ".vtu" of "a.vtu.gz".
std::string extension_of(const std::string& file) {
  const fs::path path(file);
  return (path.extension() == ".gz" ? path.stem().extension() : path.extension()).string();
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string problem_of_format(const MeshOutput& output) {
  const io::WriteOptions options = *io::write_options_named(output.format);
  const std::string extension = extension_of(output.file);
  const bool is_pair = options.extension == ".node";
  if (output.is_stdout()) return is_pair ? "--format node makes two files, and stdout is one; name a file" : "";
  std::error_code code;
  const bool is_device =
      fs::exists(output.file, code) && !fs::is_regular_file(output.file, code) && !fs::is_directory(output.file, code);
  if (is_device && !is_pair) return "";
  if (extension == options.extension || (is_pair && extension == ".ele")) return "";
  return output.file + ": --format " + output.format + " writes " + options.extension +
         " files; give it that extension";
}

std::string problem_of_name(const MeshOutput& output, const std::vector<std::string>& more_formats) {
  if (!output.format.empty()) return problem_of_format(output);
  if (output.is_stdout())
    return "- needs --format, which says what to write to stdout: " + listed(format_names(more_formats));
  if (app::is_mesh_extension(output.file)) return "";
  return output.file + ": unknown extension; use " + app::mesh_extensions();
}

}  // namespace

std::vector<std::string> format_names(const std::vector<std::string>& more) {
  std::vector<std::string> names = io::write_option_names();
  names.emplace_back("msh");
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

std::vector<std::string> files_of(const std::string& mesh) {
  if (mesh.empty() || mesh == "-") return {};
  std::vector<std::string> files;
  for (const fs::path& file : io::mesh_files(mesh)) files.push_back(file.string());
  return files;
}

std::optional<OutputProblem> problem_of(const MeshOutput& output, const std::vector<std::string>& more_formats) {
  if (!output.is_wanted()) {
    if (output.format.empty()) return std::nullopt;
    return OutputProblem{"--format says what -o writes; give both", kUsage};
  }
  if (const std::string problem = problem_of_name(output, more_formats); !problem.empty())
    return OutputProblem{problem, kUsage};
  if (has_folder(output.file)) return std::nullopt;
  return OutputProblem{output.file + ": its folder does not exist; create it first", kFailure};
}

io::WriteOptions write_options_of(const MeshOutput& output) {
  return output.format.empty() ? io::WriteOptions() : *io::write_options_named(output.format);
}

Status write_output(const MeshOutput& output, const io::MeshData& mesh, const Terminal& terminal) {
  const io::WriteOptions options = write_options_of(output);
  std::optional<ProgressBar> bar(std::in_place, terminal);
  bar->show_stage("writing", 0);
  if (output.is_stdout()) {
    const Result<std::string> bytes = io::write_mesh_bytes(options.extension, mesh, options.msh);
    bar.reset();
    if (!bytes.ok()) return bytes.error();
    return terminal.data(*bytes);
  }
  const Status status = io::write_mesh(output.file, mesh, options);
  bar.reset();
  if (!status.ok()) return status;
  terminal.wrote(names_text(io::mesh_files(output.file, options)),
                 counts_text(mesh.soup.tets.size(), mesh.soup.points.size()));
  return {};
}

std::string counts_text(std::size_t tets, std::size_t vertices) {
  return std::to_string(tets) + " tets, " + std::to_string(vertices) + " vertices";
}

std::string names_text(const std::vector<fs::path>& files) {
  std::string text;
  for (const fs::path& file : files) text += (text.empty() ? "" : " and ") + file.string();
  return text;
}

}  // namespace incise_cli
