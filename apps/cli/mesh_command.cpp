// SPDX-License-Identifier: Apache-2.0
// The command `incise mesh`: a segmented scan, or a surface, becomes tets.
#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/text/text_file.h"
#include "command.h"
#include "command_options.h"
#include "command_support.h"
#include "incise/image/image_file.h"
#include "incise/image/mesh_labels.h"
#include "incise/image/surface_labels.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_file.h"
#include "incise/io/surface_file.h"
#include "incise/mesh/components.h"
#include "incise/mesh/validate.h"
#include "label_names.h"
#include "mesh_arguments.h"
#include "mesh_report.h"
#include "picture.h"

namespace incise_cli {
namespace {

using namespace incise;
namespace fs = std::filesystem;

struct Merge {
  int from = 0, to = 0;
};

/// "2=1": label 2 becomes label 1.
std::optional<Merge> parse_merge(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return std::nullopt;
  Merge merge;
  const bool is_good = CLI::detail::lexical_cast(text.substr(0, equals), merge.from) &&
                       CLI::detail::lexical_cast(text.substr(equals + 1), merge.to);
  return is_good ? std::optional<Merge>(merge) : std::nullopt;
}

/// What is wrong with the arguments, or nothing.
std::string usage_problem(const MeshArguments& a) {
  for (const std::string& merge : a.merges) {
    if (!parse_merge(merge)) return "--merge " + merge + ": two labels are needed, as in --merge 2=1";
  }
  if (!a.picture.empty() && fs::path(a.picture).extension() != ".png") {
    return "--picture " + a.picture + ": unknown extension; pictures are .png";
  }
  if (a.output.is_stdout() && a.has_report_on_stdout()) {
    return "-o - writes the mesh to stdout, where the figures would go too; give either a file";
  }
  const std::vector<std::string> files = {a.input, a.names, a.output.file, a.report, a.picture};
  for (std::size_t i = 2; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (files[i].empty() || files[i] == "-" || files[j].empty() || !is_same_file(files[i], files[j])) continue;
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

bool is_surface(const std::string& file) {
  std::string name = CLI::detail::to_lower(file);
  if (name.size() > 3 && name.compare(name.size() - 3, 3, ".gz") == 0) name.resize(name.size() - 3);
  const std::string extension = fs::path(name).extension().string();
  return extension == ".stl" || extension == ".obj" || extension == ".ply" || extension == ".off";
}

/// What a surface encloses, as labels, and the volumes of these.
Result<image::ImageFile> read_surface_labels(const MeshArguments& a, std::vector<double>& volumes) {
  constexpr double kVoxelShare = 1.0 / 3;  // of the tets' size
  Result<io::SurfaceSoup> surface = io::read_surface(a.input);
  if (!surface.ok()) return surface.error();
  const std::size_t triangles = surface->triangles.size();
  Result<image::SurfaceLabels> labels =
      image::label_surface(std::move(surface).value(), kVoxelShare * a.size, a.threads);
  if (!labels.ok()) return Error{labels.error().code, a.input + ": " + labels.error().message};
  image::ImageFile file;
  file.image = std::move(labels->image);
  file.format_name = "surface of " + std::to_string(triangles) + " triangles, sampled by winding numbers";
  file.placed_by = "its own coordinates";
  file.notes = std::move(labels->notes);
  if (a.merges.empty() && a.labels.empty()) volumes = std::move(labels->volumes);
  return file;
}

Result<image::ImageFile> read_input(const MeshArguments& a, std::vector<double>& volumes) {
  return is_surface(a.input) ? read_surface_labels(a, volumes) : image::read_labels(a.input);
}

/// Merges labels, then keeps those that are asked for. Says which is not there.
Status choose_labels(const MeshArguments& a, image::LabelImage& image) {
  const auto is_missing = [&](int label) { return label == 0 || image.find_label(label) == image.labels.size(); };
  const auto missing = [&](int label) {
    std::string there;
    for (const std::int32_t l : image.labels) there += l != 0 && there.size() < 60 ? " " + std::to_string(l) : "";
    return Error{ErrorCode::kBadArgument, a.input + ": has no label " + std::to_string(label) + "; there are" +
                                              (there.empty() ? " none" : there)};
  };
  for (const std::string& text : a.merges) {
    const Merge merge = *parse_merge(text);
    if (is_missing(merge.from)) return missing(merge.from);
    image::merge_label(image, merge.from, merge.to);
  }
  for (const int label : a.labels) {
    if (is_missing(label)) return missing(label);
  }
  if (!a.labels.empty()) image::keep_labels(image, {a.labels.begin(), a.labels.end()});
  return {};
}

image::MeshLabelsOptions options_of(const MeshArguments& a, ProgressBar& bar) {
  image::MeshLabelsOptions options;
  options.size = a.size;
  options.smooth = a.smooth;
  options.grade = a.grade;
  options.most_halvings = a.halvings;
  options.threads = a.threads;
  options.progress = [&bar](std::size_t done, std::size_t total) { bar.show(done, total); };
  return options;
}

Result<image::LabelMesh> make_mesh(const MeshArguments& a, const image::LabelImage& image, std::vector<double> volumes,
                                   const Terminal& terminal) {
  ProgressBar bar(terminal, "stages");
  image::MeshLabelsOptions options = options_of(a, bar);
  options.volumes = std::move(volumes);
  return image::mesh_labels(image, options);
}

/// Says what the user may want to know before the figures.
void note_what_changed(const MeshArguments& a, const MeshReport& report, const Terminal& terminal) {
  const image::LabelMesh& made = *report.made;
  if (made.island_voxels > 0) {
    terminal.note(a.input + ": " + std::to_string(made.island_voxels) +
                  " voxels of islands too small for this size joined what is around them");
  }
  if (made.pinched_points > 0) {
    terminal.note(a.input + ": a label touches itself in " + std::to_string(made.pinched_points) +
                  " points; use a smaller --size, or merge labels");
  }
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
  if (Status status = draw_cut(*engine, file); !status.ok()) return status;
  terminal.wrote(file, "picture");
  return {};
}

Status write_outputs(const MeshArguments& a, const MeshReport& report, const Terminal& terminal) {
  const TetMesh& mesh = report.made->mesh;
  if (Status status = write_output(a.output, io::to_mesh_data(mesh, find_components(mesh)), terminal); !status.ok()) {
    return status;
  }
  if (!a.picture.empty()) {
    if (Status status = write_picture(mesh, a.picture, terminal); !status.ok()) return status;
  }
  return write_report(a, report, terminal);
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
  Result<LabelNames> names = arguments.names.empty() ? LabelNames() : read_label_names(arguments.names);
  if (!names.ok()) return fail(terminal, names.error(), kBadInput);
  report.names = std::move(names).value();
  Watch watch;
  std::vector<double> volumes;
  Result<image::ImageFile> file = read_input(arguments, volumes);
  if (!file.ok()) return fail(terminal, file.error(), kBadInput);
  report.file = &*file;
  report.is_scan = !is_surface(arguments.input);
  report.read_ms = watch.lap();
  print_notes(file->notes, arguments.input, terminal);
  if (const Status status = choose_labels(arguments, file->image); !status.ok()) {
    return fail(terminal, status.error(), kBadInput);
  }
  const Result<image::LabelMesh> made = make_mesh(arguments, file->image, std::move(volumes), terminal);
  if (!made.ok()) {
    return fail(terminal, made.error(), made.error().code == ErrorCode::kBadArgument ? kUsage : exit_of(made.error()));
  }
  report.made = &*made;
  report.mesh_ms = watch.lap();
  report.is_valid = validate(made->mesh, ValidateLevel::kGeometry).ok;
  if (!report.is_valid) {
    return fail(terminal, arguments.input + ": the mesh broke the validity contract and was not written; report this",
                kCheckFailed);
  }
  note_what_changed(arguments, report, terminal);
  const WritingZone zone;
  if (const Status status = write_outputs(arguments, report, terminal); !status.ok()) {
    return fail(terminal, status.error(), status.error().code == ErrorCode::kBadArgument ? kUsage : kFailure);
  }
  if (!arguments.has_report_on_stdout()) terminal.summary(to_text(report), arguments.output.is_stdout());
  return kDone;
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
                  "  incise mesh femur.stl -o femur.mesh --size 5");
  mesh->add_option("LABELS", a.input,
                   "Label image: NIfTI (.nii, .nii.gz, .hdr/.img), NRRD, MetaImage or INRIMAGE; or a triangle surface: "
                   ".stl .obj .ply .off, nearly closed")
      ->required();
  mesh->add_option("-o,--output", a.output.file,
                   "Write the mesh, in RAS millimetres; the extension names the format; - for stdout, with --format")
      ->required();
  add_format(*mesh, a.output.format);
  mesh->add_option("--size", a.size, "Size of the tets where labels meet, mm; finer where a label is thin")->required();
  mesh->add_option("--labels", a.labels, "Mesh these labels alone: 1,3")->delimiter(',');
  mesh->add_option("--merge", a.merges, "A=B: give label A's voxels to label B first; 2=1,3=1 for several")
      ->delimiter(',');
  mesh->add_option("--names", a.names, "Text file: a label and its name on each line");
  mesh->add_option("--smooth", a.smooth, "Smoothing of the voxels' steps, voxels, 0.4 to 10 (default 0.7)");
  mesh->add_option("--grade", a.grade,
                   "Growth of the tets per mm of distance from where labels meet, 0 to 10 (default 0.5)");
  mesh->add_option("--halvings", a.halvings,
                   "How often the size may be halved where a label is thin, 0 to 4 (default 2); never below a voxel");
  add_report(*mesh, a.report, a.as_json);
  mesh->add_option("--picture", a.picture, "Draw the mesh to this PNG; needs OpenGL, but no display");
  add_threads(*mesh, a.threads);
  return {mesh, [arguments](const Terminal& terminal) { return run_mesh(*arguments, terminal); }};
}

}  // namespace incise_cli
