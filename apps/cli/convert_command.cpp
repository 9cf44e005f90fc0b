// SPDX-License-Identifier: Apache-2.0
// `incise convert`: files go through `app::convert`; stdin and stdout, which have no extension, are read and written
// here.
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/model/convert.h"
#include "app/model/extension.h"
#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "incise/io/mesh_loader.h"
#include "incise/io/surface_file.h"
#include "input_kind.h"
#include "mesh_output.h"

namespace incise_cli {
namespace {

using namespace incise;

/// Percent of the time of a million tets that has gone by when they are read: 20 where .vtu is written, 70 where .msh
/// is.
constexpr unsigned kRead = 40;

const std::vector<std::string> kSurfaceFormats = {"obj", "stl", "ply", "off"};

struct ConvertArguments {
  std::string in;
  MeshOutput out;
  bool as_json = false;
};

/// ".stl" of the format "stl"; empty where that is one of meshes, or none.
std::string surface_extension_of(const std::string& format) {
  const std::string extension = "." + format;
  return !format.empty() && app::is_surface_extension("a" + extension) ? extension : "";
}

/// A surface, or the boundary of a mesh, from a file or stdin to stdout.
Result<app::Conversion> surface_to_stdout(const ConvertArguments& a, const Terminal& terminal,
                                          const std::function<void()>& before_writing) {
  const Result<app::BoundaryOf> boundary = app::read_boundary(input_of(a.in));
  if (!boundary.ok()) return boundary.error();
  before_writing();
  std::optional<ProgressBar> bar(std::in_place, terminal);
  bar->show_stage("writing", 0);
  const Result<std::string> bytes = io::write_surface_bytes(surface_extension_of(a.out.format), boundary->surface);
  bar.reset();
  if (!bytes.ok()) return bytes.error();
  if (Status status = terminal.data(*bytes); !status.ok()) return status.error();
  app::Conversion done;
  done.notes = boundary->notes;
  return done;
}

/// A mesh from a file or stdin to stdout.
Result<app::Conversion> mesh_to_stdout(const ConvertArguments& a, const Terminal& terminal,
                                       const std::function<void()>& before_writing) {
  Result<io::MeshFile> file = io::read_mesh(input_of(a.in));
  if (!file.ok()) return file.error();
  io::drop_mid_nodes(*file);
  before_writing();
  if (Status status = write_output(a.out, file->data, terminal); !status.ok()) return status.error();
  app::Conversion done;
  done.notes = file->notes;
  return done;
}

/// An interrupt ends the program while it reads, and waits from `zone` on.
Result<app::Conversion> convert(const ConvertArguments& a, const Terminal& terminal, std::optional<WritingZone>& zone) {
  std::optional<ProgressBar> bar(std::in_place, terminal);
  bar->show_stage("reading", 0);
  const auto before_writing = [&] {
    zone.emplace();
    bar->show_stage("writing", kRead);
    if (a.out.is_stdout()) bar.reset();
  };
  const bool is_surface = !surface_extension_of(a.out.format).empty();
  if (a.out.is_stdout()) {
    return is_surface ? surface_to_stdout(a, terminal, before_writing) : mesh_to_stdout(a, terminal, before_writing);
  }
  return app::convert(input_of(a.in), a.out.file, is_surface ? io::WriteOptions() : write_options_of(a.out),
                      before_writing);
}

/// Of an output that may be a surface, too.
std::optional<OutputProblem> problem_of_conversion(const ConvertArguments& a) {
  if (a.out.is_stdout() && a.as_json) {
    return OutputProblem{"OUT is stdout, where --json would print too; name a file", kUsage};
  }
  const std::string surface = surface_extension_of(a.out.format);
  if (surface.empty() && (!a.out.format.empty() || a.out.is_stdout())) return problem_of(a.out, kSurfaceFormats);
  if (!surface.empty() && a.out.is_stdout()) return std::nullopt;
  if (!surface.empty() && app::extension_of(a.out.file) != surface) {
    return OutputProblem{
        a.out.file + ": --format " + a.out.format + " writes " + surface + " files; give it that extension", kUsage};
  }
  if (has_folder(a.out.file)) return std::nullopt;  // `app::convert` knows the extensions
  return OutputProblem{a.out.file + ": its folder does not exist; create it first", kFailure};
}

std::string json_of(const ConvertArguments& a, const app::Conversion& done) {
  nlohmann::ordered_json root;
  root["format"] = "incise-conversion";
  root["version"] = 1;
  root["input"] = name_of_input(a.in);
  root["output"] = nlohmann::ordered_json::array();
  for (const auto& file : done.files) root["output"].push_back(file.string());
  root["vertices"] = done.vertices;
  root["tets"] = done.tets;
  root["triangles"] = done.triangles;
  root["notes"] = done.notes;
  return root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string counts_of(const app::Conversion& done) {
  if (done.tets > 0) return counts_text(done.tets, done.vertices);
  return std::to_string(done.triangles) + " triangles, " + std::to_string(done.vertices) + " vertices";
}

int run_convert(const ConvertArguments& arguments, const Terminal& terminal) {
  if (const auto problem = problem_of_conversion(arguments)) return fail(terminal, problem->text, problem->code);
  std::optional<WritingZone> zone;
  const Result<app::Conversion> done = convert(arguments, terminal, zone);
  if (!done.ok()) {
    return fail(terminal, explain_kind(done.error(), arguments.in, FileKind::kMesh), exit_of(done.error()));
  }
  print_notes(done->notes, arguments.in, terminal);
  if (!done->files.empty()) terminal.wrote(names_text(done->files), counts_of(*done));
  return finish(terminal, arguments.as_json ? terminal.data(json_of(arguments, *done)) : Status());
}

}  // namespace

Command add_convert(CLI::App& root) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* convert =
      add_command(root, "convert", "Convert a mesh or surface; a mesh becomes its boundary in .obj .stl .ply .off",
                  "  incise convert bunny.node bunny.vtu\n  incise convert cut.vtu walls.stl\n"
                  "  incise convert cut.vtu cut.msh --format msh22\n"
                  "  zcat liver.mesh.gz | incise convert - - --format vtu > liver.vtu\n"
                  "  incise convert - - --format stl < cut.vtu > walls.stl");
  convert->add_option("IN", arguments->in, "File to read; - for stdin")->required();
  convert->add_option("OUT", arguments->out.file, "File to write; the extension names the format; - for stdout")
      ->required()
      ->transform(names_a_result());
  add_format(*convert, arguments->out.format, kSurfaceFormats);
  add_json(*convert, arguments->as_json);
  return {convert, [arguments](const Terminal& terminal) { return run_convert(*arguments, terminal); }};
}

}  // namespace incise_cli
