// SPDX-License-Identifier: Apache-2.0
// The command `incise mesh`: a segmented scan, or a surface, becomes tets.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/model/organ.h"
#include "app/text/text_file.h"
#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_file.h"
#include "incise/mesh/components.h"
#include "incise/mesh/validate.h"
#include "input_kind.h"
#include "mesh_arguments.h"
#include "mesh_report.h"
#include "picture.h"

namespace incise_cli {
namespace {

using namespace incise;
namespace fs = std::filesystem;

constexpr const char* kAll = "all";  // labels

/// What is wrong with the arguments, or nothing.
std::string usage_problem(const MeshArguments& a) {
  for (const std::string& merge : a.merges) {
    if (!app::parse_merge(merge)) return "--merge " + merge + ": two labels are needed, as in --merge 2=1";
  }
  if (!(a.size > 0) || !std::isfinite(a.size)) return "--size must be above 0 mm; give a larger one";
  if (const std::string problem = app::problem_of_layers(a.layers); !problem.empty()) return problem;
  if (!a.layers_in.empty() && a.layers.empty()) return "--layers-in says where layers grow; give them by --layers";
  if (!a.picture.empty() && fs::path(a.picture).extension() != ".png") {
    return "--picture " + a.picture + ": unknown extension; pictures are .png";
  }
  if (a.output.is_stdout() && a.has_report_on_stdout()) {
    return "-o - writes the mesh to stdout, where the figures would go too; give either a file";
  }
  std::vector<std::string> files = {a.input, a.names, a.report, a.picture};
  const std::vector<std::string> meshes = files_of(a.output.file);
  files.insert(files.end(), meshes.begin(), meshes.end());
  for (std::size_t i = 2; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool are_files = !files[i].empty() && files[i] != "-" && !files[j].empty() && files[j] != "-";
      if (!are_files || !is_same_file(files[i], files[j])) continue;
      return files[i] + " is two files of this command at once; give each a name of its own";
    }
  }
  return {};
}

std::optional<OutputProblem> output_problem(const MeshArguments& a) {
  if (auto problem = problem_of(a.output)) return problem;
  for (const std::string& file : {a.report, a.picture}) {
    if (!has_folder(file)) return OutputProblem{file + ": its folder does not exist; create it first", kFailure};
  }
  return std::nullopt;
}

app::OrganJob job_of(const MeshArguments& a) {
  app::OrganJob job;
  job.input = input_of(a.input);
  job.names = a.names;
  job.size = a.size;
  job.smooth = a.smooth;
  job.grade = a.grade;
  job.halvings = a.halvings;
  job.threads = a.threads;
  job.labels.assign(a.labels.begin(), a.labels.end());
  job.layers_in.assign(a.layers_in.begin(), a.layers_in.end());
  for (const std::string& merge : a.merges) job.merges.push_back(*app::parse_merge(merge));
  for (const std::string& layer : a.layers) job.layers.push_back(*app::parse_layer(layer));
  return job;
}

Result<app::Organ> make_organ(app::OrganJob& job, app::OrganInput& input, const Terminal& terminal) {
  ProgressBar bar(terminal, "stages");
  job.progress = [&bar](std::size_t done, std::size_t total) { bar.show(done, total); };
  return app::mesh_organ(job, input);
}

Status write_report(const MeshArguments& a, const MeshReport& report, const Terminal& terminal) {
  if (!a.report.empty() && a.report != "-") {
    if (Status status = app::write_text_file(a.report, to_json(report)); !status.ok()) return status;
    terminal.wrote(a.report, "report");
  }
  return a.has_report_on_stdout() ? terminal.data(to_json(report)) : Status();
}

Status write_picture(const TetMesh& mesh, const std::string& file, const Terminal& terminal) {
  Result<Engine> engine = Engine::create(mesh);
  if (!engine.ok()) return engine.error();
  if (Status status = draw_labels(*engine, file); !status.ok()) return status;
  terminal.wrote(file, "picture");
  return {};
}

Status write_outputs(const MeshArguments& a, const MeshReport& report, const Terminal& terminal) {
  const TetMesh& mesh = report.organ->made.mesh;
  io::MeshData data = io::to_mesh_data(mesh, find_components(mesh));
  data.region_names = report.organ->names;
  if (Status status = write_output(a.output, data, terminal); !status.ok()) return status;
  if (!a.picture.empty()) {
    if (Status status = write_picture(mesh, a.picture, terminal); !status.ok()) return status;
  }
  return write_report(a, report, terminal);
}

/// Labels that are lost and may not be, with commas between.
std::string lost_labels(const MeshArguments& a, const app::Organ& organ) {
  std::string lost;
  for (const std::int32_t label : organ.lost) {
    const bool may_be = std::any_of(a.may_lose.begin(), a.may_lose.end(),
                                    [&](const std::string& text) { return text == kAll || std::stol(text) == label; });
    if (!may_be) lost += (lost.empty() ? "" : ",") + std::to_string(label);
  }
  return lost;
}

/// An error of reading; of stdin, which is read as a label image whatever it is, also what else may be wrong.
Error explained(Error error, const MeshArguments& a) {
  const bool is_other = is_stdin(a.input) && error.code == ErrorCode::kUnsupported;
  if (is_other) error.message += "; give a surface as a file";
  return error;
}

/// Milliseconds since the last call.
class Watch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

int run_mesh(const MeshArguments& arguments, const Terminal& terminal) {
  if (const std::string problem = usage_problem(arguments); !problem.empty()) return fail(terminal, problem, kUsage);
  if (const auto problem = output_problem(arguments)) return fail(terminal, problem->text, problem->code);
  if (!arguments.picture.empty()) {  // before the work
    if (const Status status = check_drawing(); !status.ok()) return fail(terminal, status.error(), kNoDisplay);
  }
  MeshReport report;
  report.arguments = &arguments;
  app::OrganJob job = job_of(arguments);
  Watch watch;
  std::optional<ProgressBar> bar(std::in_place, terminal);
  bar->show_stage("reading", 0);
  Result<app::OrganInput> input = app::read_organ(job);
  bar.reset();
  if (!input.ok())
    return fail(terminal, explain_kind(explained(input.error(), arguments), arguments.input, FileKind::kUnknown),
                kBadInput);
  report.input = &*input;
  report.layers = job.layers;
  report.read_ms = watch.lap();
  print_notes(input->file.notes, arguments.input, terminal);
  const Result<app::Organ> organ = make_organ(job, *input, terminal);
  if (!organ.ok()) return fail(terminal, organ.error(), exit_of(organ.error()));
  report.organ = &*organ;
  report.mesh_ms = watch.lap();
  report.is_valid = validate(organ->made.mesh, ValidateLevel::kGeometry).ok;
  if (!report.is_valid) {
    return fail(
        terminal,
        name_of_input(arguments.input) + ": the mesh broke the validity contract and was not written; report this",
        kCheckFailed);
  }
  for (const std::string& note : organ->notes) terminal.note(note);
  const WritingZone zone;
  if (const Status status = write_outputs(arguments, report, terminal); !status.ok()) {
    return fail(terminal, status.error(), status.error().code == ErrorCode::kBadArgument ? kUsage : kFailure);
  }
  if (!arguments.has_report_on_stdout()) terminal.summary(to_text(report), arguments.output.is_stdout());
  const std::string lost = lost_labels(arguments, *organ);
  if (lost.empty()) return kDone;
  return fail(terminal,
              name_of_input(arguments.input) + ": less than half came out of label " + lost +
                  "; use a smaller --size, choose others (--labels), merge (--merge), or allow it: --may-lose " + lost,
              kCheckFailed);
}

}  // namespace

Command add_mesh(CLI::App& root) {
  const auto arguments = std::make_shared<MeshArguments>();
  MeshArguments& a = *arguments;
  CLI::App* mesh =
      add_command(root, "mesh",
                  "Make tets of a segmented scan or a surface, a region for each label or closed part (docs/organs.md)",
                  "  incise mesh liver.nii.gz -o liver.mesh --size 4\n"
                  "  incise mesh spine.nrrd -o spine.vtu --size 2 --labels 20,21 --report spine.json\n"
                  "  incise mesh organ.mha -o organ.msh --size 3 --merge 2=1 --names names.txt --picture organ.png\n"
                  "  incise mesh body.nii.gz -o body.vtu --size 4 --layers skin=2,fat=8\n"
                  "  incise mesh femur.stl -o femur.mesh --size 5");
  mesh->add_option("LABELS", a.input,
                   "Label image: NIfTI (.nii, .nii.gz, .hdr/.img), NRRD, MetaImage or INRIMAGE; or a triangle surface: "
                   ".stl .obj .ply .off, nearly closed; - for a label image from stdin")
      ->required();
  mesh->add_option("-o,--output", a.output.file,
                   "Write the mesh, in RAS millimetres; the extension names the format; - for stdout, with --format")
      ->required()
      ->transform(names_a_result());
  add_format(*mesh, a.output.format);
  mesh->add_option("--size", a.size, "Size of the tets where labels meet, mm; finer where a label is thin")->required();
  mesh->add_option("--labels", a.labels, "Mesh these labels alone: 1,3")->delimiter(',')->check(app::problem_of_label);
  mesh->add_option("--merge", a.merges, "A=B: give label A's voxels to label B first; 2=1,3=1 for several")
      ->delimiter(',');
  mesh->add_option("--layers", a.layers,
                   "NAME=MM: layers from the surface inwards, as regions of their own: skin=1.5,fat=8")
      ->delimiter(',');
  mesh->add_option("--layers-in", a.layers_in, "Labels that layers may take from (default: all): 1,3")
      ->delimiter(',')
      ->check(app::problem_of_label);
  mesh->add_option("--names", a.names, "Text file: a label and its name on each line");
  mesh->add_option("--smooth", a.smooth, "Smoothing of the voxels' steps, voxels, 0.4 to 10 (default 0.7)");
  mesh->add_option("--grade", a.grade,
                   "Growth of the tets per mm of distance from where labels meet, 0 to 10 (default 0.5)");
  mesh->add_option("--halvings", a.halvings,
                   "How often the size may be halved where a label is thin, 0 to 4 (default 2); never below a voxel");
  mesh->add_option(
          "--may-lose", a.may_lose,
          "Labels of which less than half may come out, or all; without it such a mesh is written, but the exit "
          "code is 4")
      ->delimiter(',')
      ->check([](const std::string& text) { return text == kAll ? "" : app::problem_of_label(text); });
  add_report(*mesh, a.report, a.as_json);
  mesh->add_option(
      "--picture", a.picture,
      "Draw the mesh to this PNG, each region in its colour, cut open where there are several; needs OpenGL, but no "
      "display");
  add_threads(*mesh, a.threads);
  return {mesh, [arguments](const Terminal& terminal) { return run_mesh(*arguments, terminal); }};
}

}  // namespace incise_cli
