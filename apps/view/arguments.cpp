// SPDX-License-Identifier: Apache-2.0
// Options are added group by group, each writes into one struct; what they ask for together is checked at the end,
// before anything is opened.
#include "arguments.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

#include "app/scene/blade_file.h"
#include "app/scene/scene_simulation.h"
#include "app/session/scan_scene.h"
#include "app/session/starting_body.h"
#include "app/viewer/key_bindings.h"
#include "exit_code.h"
#include "film.h"
#include "incise/io/numbers.h"
#include "incise/mesh/bounds.h"
#include "incise/version.h"
#include "shared/command_words.h"
#include "shared/manual.h"
#include "shared/message_text.h"

namespace incise_view {
namespace {

using namespace incise;

constexpr const char* kExamples =
    "Examples:\n"
    "  incise-view scenes/sim_skin.json\n"
    "  incise-view models/bunny.mesh --up y\n"
    "  incise-view liver.nii.gz --size 5 --names names.txt        (a segmented scan, meshed first)\n"
    "  incise-view session.jsonl                                  (a recording, played)\n"
    "  incise-view --headless --replay session.jsonl --frame 120 --screenshot out.png\n"
    "  incise-view --headless scenes/sim_cube.json --frame 200 --color quality --wireframe --screenshot out.png\n";

void add_input(CLI::App& root, Arguments& a) {
  root.add_option(
      "FILE", a.file,
      "A scene, a mesh, or a recording of incise simulate, incise cut or this window; a segmented scan or a "
      "surface with --size MM");
  root.add_option_function<std::string>(
      "--replay", [&a](const std::string& file) { a.file = file; }, "The recording to play: the same as FILE");
  root.add_option("--record", a.record, "Record the session from its start to this file (JSON lines)");
  root.add_option("--keep-undo", a.keep_undo,
                  "Strokes that undo can take back, so that memory does not grow for ever (default 100); 0: all");
  root.add_option("--device", a.device,
                  "What moves the blade: mouse (pens are mice), none, haply or haply=HOST:PORT (a haptic device, by "
                  "Haply's service), or a blade file that is the hand");
  incise_apps::add_device(root, a.haptic);
  root.add_option("--up", a.up, "Of a mesh without a scene: the axis against gravity (default z; of a scan y: front)")
      ->check(CLI::IsMember({"x", "y", "z"}));
  root.add_option("--surface", a.surface,
                  "A fine triangle surface that is shown in the place of the mesh's skin (.obj .stl .ply .off)");
  root.add_option("--threads", a.threads, "Worker threads, 1 to 256; the result does not depend on it")
      ->check(CLI::Range(1, 256));
  root.add_flag("--paused", a.is_paused, "Wait for the space bar");
  root.add_option("--speed", a.speed, "Of the simulation against the clock; 0: as fast as it can")
      ->check(CLI::Range(0.0, 100.0));
}

/// Of scans and surfaces: as `incise mesh` has them.
void add_scan(CLI::App& root, Arguments& a) {
  root.add_option("--layers", a.layers, "Scan: NAME=MM, layers from the surface inwards: skin=1.5,fat=8")
      ->delimiter(',');
  root.add_option("--layers-in", a.layers_in, "Scan: labels that layers may take from (default: all)")
      ->delimiter(',')
      ->check(app::problem_of_label);
  root.add_option("--labels", a.labels, "Scan: mesh these labels alone: 1,3")
      ->delimiter(',')
      ->check(app::problem_of_label);
  root.add_option("--names", a.names, "Scan: text file, a label and its name on each line; names choose materials");
  root.add_option("--halvings", a.halvings, "Scan: how often the size may be halved where a label is thin (default 2)")
      ->check(CLI::Range(0, 4));
  root.add_option("--mesh", a.mesh, "Scan: keep the mesh in this file; recordings name it (default: a temporary file)");
}

void add_view(CLI::App& root, Arguments& a) {
  using Colors = std::map<std::string, app::ColorBy>;
  const auto seen = [&a](auto change) {
    return [&a, change](const auto&... value) {
      a.has_view = true;
      change(value...);
    };
  };
  root.add_option_function<std::string>("--color", seen([&a](const std::string& name) {
                                          static const Colors kColors = {{"tissue", app::ColorBy::kTissue},
                                                                         {"region", app::ColorBy::kRegion},
                                                                         {"stroke", app::ColorBy::kStroke},
                                                                         {"quality", app::ColorBy::kQuality},
                                                                         {"defects", app::ColorBy::kDefects}};
                                          a.view.color = kColors.at(name);
                                        }),
                                        "What colours show: tissue, region, stroke, quality or defects")
      ->check(CLI::IsMember({"tissue", "region", "stroke", "quality", "defects"}));
  root.add_option_function<std::string>("--theme", seen([&a](const std::string& name) {
                                          a.view.theme = name == "light" ? app::Theme::kLight : app::Theme::kDark;
                                        }),
                                        "dark or light")
      ->check(CLI::IsMember({"dark", "light"}));
  root.add_flag_callback(
      "--wireframe",
      [&a] {
        a.has_view = true;
        a.view.shows_wireframe = true;
      },
      "Draw the edges of the mesh");
  root.add_flag_callback(
      "--lines-only",
      [&a] {
        a.has_view = true;
        a.view.shows_wireframe = true;
        a.view.shows_surface = false;
      },
      "Draw nothing but the edges");
  root.add_flag("--no-shadows", a.has_no_shadows, "Headless: draw without shadows");
  root.add_option_function<double>("--opacity", seen([&a](double value) { a.view.skin_opacity = value; }),
                                   "Of the skin, above 0, at most 1")
      ->check(CLI::Range(0.05, 1.0));
}

/// `count` numbers that stand behind each other, with commas between.
Vec3 vector_of(const std::vector<double>& n) {
  return {n[0], n[1], n[2]};
}

/// Pixels of the picture, or millimetres of tets.
void take_size(const std::string& text, Arguments& a) {
  char end = 0;
  incise::app::Viewport pixels;  // a single number is written here too, and is none of the window's
  if (std::sscanf(text.c_str(), "%dx%d%c", &pixels.width, &pixels.height, &end) == 2 && pixels.width > 0 &&
      pixels.height > 0 && pixels.width <= 16384 && pixels.height <= 16384) {
    a.size = pixels;
    return;
  }
  if (io::parse_double(text, a.tet_size) && a.tet_size > 0 && std::isfinite(a.tet_size)) return;
  throw CLI::ValidationError("--size",
                             "must be WIDTHxHEIGHT in pixels, for instance 1280x720, or the size of the tets that a "
                             "scan becomes, in mm, for instance 5");
}

void add_camera(CLI::App& root, Arguments& a) {
  root.add_option_function<std::vector<double>>(
          "--from", [&a](const std::vector<double>& n) { a.from = vector_of(n); },
          "x,y,z: the direction from the body to the eye")
      ->delimiter(',')
      ->expected(3);
  root.add_option_function<std::vector<double>>(
          "--target", [&a](const std::vector<double>& n) { a.target = vector_of(n); },
          "x,y,z: the point in the middle of the picture")
      ->delimiter(',')
      ->expected(3);
  root.add_option("--zoom", a.zoom, "Above 1: nearer than what shows the whole body")->check(CLI::Range(0.01, 100.0));
  root.add_option_function<std::vector<double>>(
          "--clip",
          [&a](const std::vector<double>& n) {
            a.clip = app::HalfSpace{vector_of(n), n[3]};
          },
          "nx,ny,nz,d: leave out the tets where n.x <= d")
      ->delimiter(',')
      ->expected(4);
  root.add_option_function<std::vector<std::string>>(
          "--size",
          [&a](const std::vector<std::string>& sizes) {
            for (const std::string& size : sizes) take_size(size, a);
          },
          "WIDTHxHEIGHT in pixels; or, of a scan, the size of its tets in mm. Both may be given")
      ->allow_extra_args(false);
  root.add_option("--samples", a.samples, "Per pixel, to smooth edges: 0 to 16")->check(CLI::Range(0, 16));
}

void add_headless(CLI::App& root, Arguments& a) {
  root.add_flag("-q,--quiet", a.is_quiet, "Headless: print errors only");
  root.add_flag("--headless", a.is_headless, "No window, and no X server: only pictures");
  root.add_option_function<std::uint64_t>(
      "--frame",
      [&a](std::uint64_t frame) {
        a.frame = frame;
        a.has_frame = true;
      },
      "The picture's frame, counted in frames of a scene or calls of a recording (default: the end)");
  root.add_option("--screenshot", a.screenshot, "Write the picture to this PNG");
  root.add_option("--sequence", a.sequence, "Write pictures of all frames up to --frame to this folder");
  root.add_option("--film", a.film, "Write a film of all frames up to --frame to this file (.mp4); needs ffmpeg");
  root.add_option("--every", a.every, "Frames between two pictures of --sequence or --film")
      ->check(CLI::Range(std::uint64_t{1}, app::kMaxSceneFrames));
}

/// As in the paper's figures.
void add_figure(CLI::App& root, Arguments& a) {
  root.add_option("--spread", a.spread, "Headless: move pieces apart by this share of the body's size, 0 to 10")
      ->check(CLI::Range(0.0, 10.0));
  root.add_option("--trajectory", a.trajectory, "Headless: show what the blade of this blade file sweeps");
  root.add_flag("--incision", a.shows_incision, "Headless: show the walls of cuts as incision faces");
  root.add_flag("--cut-vertices", a.shows_cut_vertices, "Headless: show balls at the vertices that were divided");
}

bool asks_for_figure(const Arguments& a) {
  return a.spread > 0 || !a.trajectory.empty() || a.shows_incision || a.shows_cut_vertices;
}

std::string scan_problem(const Arguments& a) {
  const bool has_scan = a.has_scan();
  if (has_scan && !(a.tet_size > 0))
    return a.file + ": a scan is meshed first; say by --size MM how large its tets are";
  if (const std::string problem = app::problem_of_layers(a.layers); !problem.empty()) return problem;
  const bool asks = !a.layers.empty() || !a.layers_in.empty() || !a.labels.empty() || !a.names.empty() ||
                    !a.mesh.empty() || a.tet_size > 0;
  if (asks && !has_scan)
    return "--size MM, --layers, --labels, --names and --mesh are for scans and surfaces; name one";
  return {};
}

/// Of files that are written: what their names tell.
std::string output_problem(const Arguments& a) {
  const std::array<std::pair<const char*, const std::string&>, 5> outputs = {{{"--screenshot", a.screenshot},
                                                                              {"--sequence", a.sequence},
                                                                              {"--film", a.film},
                                                                              {"--record", a.record},
                                                                              {"--mesh", a.mesh}}};
  for (const auto& [option, name] : outputs) {
    if (name == "-") return std::string(option) + " does not go to stdout; name a file";
  }
  if (!a.screenshot.empty() && std::filesystem::path(a.screenshot).extension() != ".png") {
    return "--screenshot " + a.screenshot + ": unknown extension; pictures are .png";
  }
  return {};
}

std::string usage_problem(const Arguments& a) {
  const bool has_pictures = !a.screenshot.empty() || !a.sequence.empty() || !a.film.empty();
  if (a.is_headless && !has_pictures) {
    return "--headless makes pictures: say where with --screenshot OUT.png, --sequence FOLDER or --film OUT.mp4";
  }
  if (!a.is_headless && has_pictures) {
    return "--screenshot, --sequence and --film need --headless; in the window, S saves a picture";
  }
  if (const std::string problem = output_problem(a); !problem.empty()) return problem;
  if (!a.is_headless && asks_for_figure(a)) {
    return "--spread, --trajectory, --incision and --cut-vertices need --headless";
  }
  if (const std::string problem = scan_problem(a); !problem.empty()) return problem;
  if (a.is_headless && incise_apps::is_haply(a.device)) {
    return "--device haply is for the window; without one: incise simulate SCENE --device haply";
  }
  if (const Status status = check_device(a.device, a.haptic); !status.ok()) return status.error().message;
  if (a.from && !(a.from->norm() > 0)) return "--from must not be zero";
  if (a.clip && !(a.clip->normal.norm() > 0)) return "the normal of --clip must not be zero";
  return {};
}

}  // namespace

bool Arguments::has_scan() const {
  return app::is_image_file(file) || (app::is_surface_file(file) && tet_size > 0);
}

app::SessionOptions Arguments::session_options() const {
  app::SessionOptions options;
  options.threads = threads;
  options.record = record;
  options.keep_undo = keep_undo;
  if (!surface.empty()) options.surface = std::filesystem::absolute(surface).string();
  const std::string axis = !up.empty() ? up : (app::is_image_file(file) ? "y" : "z");
  options.up = axis == "x" ? Vec3::UnitX() : (axis == "y" ? Vec3::UnitY() : Vec3::UnitZ());
  return options;
}

std::optional<int> parse(int argc, char** argv, Arguments& arguments) {
  CLI::App root("incise-view shows bodies that are cut while they deform, and lets you cut them", "incise-view");
  root.set_version_flag("--version", "incise-view " INCISE_VERSION);
  bool wants_manual = false;
  root.add_flag("--man", wants_manual, "Print the manual page, for man(1)");
  add_input(root, arguments);
  add_scan(root, arguments);
  add_view(root, arguments);
  add_camera(root, arguments);
  add_headless(root, arguments);
  add_figure(root, arguments);
  root.footer(std::string(kExamples) + "\nKeys:\n" + app::list_of_keys() +
              "\nExit: 0 done, 1 failure, 2 usage, 3 bad input, 5 no display or no OpenGL 3.3\n");
  try {
    root.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return root.exit(error);
    return fail(kUsage, incise_apps::explain(root, std::vector<std::string>(argv + 1, argv + argc), error));
  }
  if (wants_manual) {
    std::fputs(incise_apps::manual_page(root, root, INCISE_VERSION).c_str(), stdout);
    return 0;
  }
  if (const std::string problem = usage_problem(arguments); !problem.empty()) return fail(kUsage, problem);
  return std::nullopt;
}

namespace {

app::OrganJob job_of(const Arguments& a) {
  app::OrganJob job;
  job.input = a.file;
  job.names = a.names;
  job.size = a.tet_size;
  job.halvings = a.halvings;
  job.threads = a.threads;
  job.labels.assign(a.labels.begin(), a.labels.end());
  job.layers_in.assign(a.layers_in.begin(), a.layers_in.end());
  for (const std::string& layer : a.layers) job.layers.push_back(*app::parse_layer(layer));
  return job;
}

Result<app::Session> open_scan(const Arguments& arguments, const app::SessionOptions& options) {
  const auto say = [&](const std::string& text) {
    if (!arguments.is_quiet) std::fprintf(stderr, "incise-view: %s\n", incise_apps::one_line(text).c_str());
  };
  say("meshing " + arguments.file);
  std::optional<TemporaryFolder> for_now;  // of a picture nothing is left that would name the mesh
  std::filesystem::path mesh = arguments.mesh;
  if (arguments.is_headless && mesh.empty() && options.record.empty()) mesh = for_now.emplace().path() / "scan.msh";
  const Result<app::ScanScene> made = app::make_scan_scene(job_of(arguments), mesh, options.up);
  if (!made.ok()) return made.error();
  for (const std::string& note : made->notes) say("note: " + note);
  if (!for_now) say("wrote " + made->mesh.string() + " (mesh)");
  return app::Session::open(made->scene, options);
}

}  // namespace

Result<app::Session> open_session(const Arguments& arguments) {
  const app::SessionOptions options = arguments.session_options();
  if (arguments.has_scan()) return open_scan(arguments, options);
  return arguments.file.empty() ? app::Session::open(app::skin_patch(), options)
                                : app::Session::open(arguments.file, options);
}

Result<std::vector<Stroke>> device_strokes(const Arguments& arguments) {
  const bool moves_by_itself =
      arguments.device != "mouse" && arguments.device != "none" && !incise_apps::is_haply(arguments.device);
  if (!moves_by_itself) return std::vector<Stroke>();
  return app::read_blade(arguments.device);
}

}  // namespace incise_view
