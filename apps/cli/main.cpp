// SPDX-License-Identifier: Apache-2.0
// The command `incise`: reads arguments, runs one command, returns its exit code.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "incise/app/cut_job.h"
#include "incise/app/scene.h"
#include "incise/version.h"
#include "mesh_command.h"
#include "terminal.h"

namespace incise_cli {
namespace {

struct Arguments {
  InfoArguments info, check;
  CutArguments cut;
  ImproveArguments improve;
  SimulateArguments simulate;
  ReplayArguments replay;
  ConvertArguments convert;
  MeshArguments mesh;
};

constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 failure, 2 usage, 3 bad input, 4 a check failed, 5 no display, 130 interrupted.\n"
    "Formats: .mesh .msh .vtk .vtu .node/.ele .veg .inp, tetrahedral .ply (read only); all also gzipped.";

CLI::App* add_command(CLI::App& root, const std::string& name, const std::string& what, const std::string& examples) {
  CLI::App* command = root.add_subcommand(name, what);
  command->fallthrough();
  command->footer("Examples:\n" + examples);
  return command;
}

void add_info(CLI::App& root, Arguments& a) {
  CLI::App* info = add_command(root, "info", "Say what is in a mesh file and what is wrong with it",
                               "  incise info liver.msh\n  incise info liver.msh --json");
  info->add_option("MESH", a.info.mesh, "Mesh file; the format is found from its content")->required();
  info->add_flag("--json", a.info.as_json, "Print JSON");
  CLI::App* check = add_command(root, "check", "Check validity and quality; exit 4 where the mesh is invalid",
                                "  incise check liver.msh\n  incise check cut.vtu --json");
  check->add_option("MESH", a.check.mesh, "Mesh file; the format is found from its content")->required();
  check->add_flag("--json", a.check.as_json, "Print JSON");
}

void add_profile(CLI::App& command, std::string& profile) {
  command.add_option("--profile", profile, "incise (default), or paper: the published method")
      ->check(CLI::IsMember({"incise", "paper"}));
}

void add_budget(CLI::App& command, std::uint64_t& budget_us, const std::string& what) {
  command.add_option("--budget-us", budget_us, what)->check(CLI::Range(std::uint64_t{1}, incise::app::kMaxBudgetUs));
}

void add_cut(CLI::App& root, Arguments& a) {
  CLI::App* cut = add_command(root, "cut", "Cut a mesh along a blade's path or a plane",
                              "  incise cut cube.mesh --plane 1,0,0,0.5 -o halves.vtu\n"
                              "  incise cut bunny.node --blade scenes/bunny_stroke.json -o cut.vtu --report cut.json\n"
                              "  incise cut bunny.node --plane=-1,0,2,0.3 --profile paper --report -\n"
                              "  incise cut cube.mesh --plane 1,0,0,0.5 --no-merge --no-improve -o raw.vtu\n"
                              "  incise cut bunny.node --blade scenes/bunny_stroke.json --budget-us 2000 -o cut.vtu\n"
                              "  incise cut bunny.node --blade scenes/bunny_stroke.json --record cut.jsonl\n"
                              "  incise cut bunny.node --blade scenes/bunny_stroke.json --picture cut.png");
  cut->add_option("MESH", a.cut.mesh, "Mesh file; the format is found from its content")->required();
  cut->add_option("--blade", a.cut.blade, "Blade file: JSON of format incise-blade");
  cut->add_option("--plane", a.cut.plane, "nx,ny,nz,d: cut through everything along n.x = d, n of any length");
  cut->add_option("-o,--output", a.cut.output, "Write the cut mesh; the extension names the format");
  add_profile(*cut, a.cut.profile);
  cut->add_option("--snap", a.cut.snap,
                  "Snapping distance as a fraction of the mean incident edge, 0 to 0.4 (default 0.2)");
  cut->add_flag("--no-merge", a.cut.no_merge, "Do not merge short edges after a stroke");
  cut->add_flag("--no-improve", a.cut.no_improve, "Do not improve the mesh around a cut after a stroke");
  cut->add_flag("--no-smooth-boundary", a.cut.no_smooth_boundary,
                "Of --profile paper: leave its Boundary Laplacian out (the paper's Figure 10)");
  cut->add_option("--report", a.cut.report, "Write figures as JSON; - for stdout");
  cut->add_option("--seed", a.cut.seed, "Seed, repeated in the report");
  cut->add_option("--threads", a.cut.threads, "Worker threads, 1 to 256; the result does not depend on it")
      ->check(CLI::Range(1, 256));
  cut->add_option("--record", a.cut.record, "Record every step as JSON lines, for incise replay");
  cut->add_option("--picture", a.cut.picture, "Draw the result to this PNG; needs OpenGL, and no display");
  add_budget(
      *cut, a.cut.budget_us,
      "Microseconds for maintenance per stroke, 1 to 3600000000; what is left over may be spent later, what is not "
      "done waits for the next stroke. The cut itself is never left undone");
}

void add_improve(CLI::App& root, Arguments& a) {
  CLI::App* improve =
      add_command(root, "improve", "Maintain a whole mesh: merge short edges and make the worst tets better",
                  "  incise improve liver.msh -o better.msh\n"
                  "  incise improve cut.vtu -o better.vtu --report better.json\n"
                  "  incise improve liver.msh --budget-us 500000 -o better.msh\n"
                  "  incise improve liver.msh --profile paper --report -");
  improve->add_option("MESH", a.improve.mesh, "Mesh file; the format is found from its content")->required();
  improve->add_option("-o,--output", a.improve.output, "Write the mesh; the extension names the format");
  add_profile(*improve, a.improve.profile);
  improve->add_option("--report", a.improve.report, "Write figures as JSON; - for stdout");
  add_budget(
      *improve, a.improve.budget_us,
      "Microseconds for the work, 1 to 3600000000; the worst tets come first, what is not done is left as it was");
}

void add_simulate(CLI::App& root, Arguments& a) {
  CLI::App* simulate = add_command(
      root, "simulate", "Run a scene: a soft body that is held, pulled and cut while it deforms (docs/scenes.md)",
      "  incise simulate scenes/sim_cube.json\n"
      "  incise simulate scenes/sim_cube.json -o cube.pvd --report cube.json\n"
      "  incise simulate scenes/sim_skin.json --frames 60 --report -\n"
      "  incise simulate scenes/sim_cube.json --profile paper --threads 2\n"
      "  incise simulate scenes/sim_cube.json --record cube.jsonl && incise replay cube.jsonl --verify");
  SimulateArguments& s = a.simulate;
  simulate->add_option("SCENE", s.scene, "Scene file: JSON of format incise-scene")->required();
  simulate->add_option("--frames", s.frames, "Frames to run, instead of the scene's")
      ->check(CLI::Range(std::uint64_t{1}, incise::app::kMaxSceneFrames));
  simulate->add_option("-o,--output", s.output, "Write the body over time: NAME.pvd with the folder NAME_frames");
  simulate->add_option("--every", s.every, "Frames from one file of -o to the next (default: about 100 files)")
      ->check(CLI::Range(std::uint64_t{1}, incise::app::kMaxSceneFrames));
  simulate->add_option("--report", s.report, "Write figures as JSON; - for stdout");
  simulate->add_option("--record", s.record, "Record every frame as JSON lines, for incise replay");
  simulate->add_option("--profile", s.profile, "incise, or paper: the published method; instead of the scene's")
      ->check(CLI::IsMember({"incise", "paper"}));
  add_budget(*simulate, s.budget_us,
             "Microseconds for maintenance per frame, 1 to 3600000000, taken as 50 work units each: no clock is read");
  simulate->add_option("--seed", s.seed, "Seed, instead of the scene's");
  simulate->add_flag("--ideal", s.is_ideal, "Show and score an exercise's ideal strokes, instead of the scene's");
  simulate->add_option("--threads", s.threads, "Worker threads, 1 to 256; the result does not depend on it")
      ->check(CLI::Range(1, 256));
}

void add_replay(CLI::App& root, Arguments& a) {
  CLI::App* replay =
      add_command(root, "replay", "Do again what was recorded with --record; exit 4 where it comes out differently",
                  "  incise replay cut.jsonl --verify\n  incise replay cut.jsonl -o cut.vtu");
  replay->add_option("REC", a.replay.recording, "Recording: JSON lines of format incise-recording or incise-simulation")
      ->required();
  replay->add_flag("--verify", a.replay.verify, "Compare after every step or frame, not only at the end");
  replay->add_option("-o,--output", a.replay.output, "Write the mesh at the end; the extension names the format");
}

void add_convert(CLI::App& root, Arguments& a) {
  CLI::App* convert =
      add_command(root, "convert", "Convert a mesh or surface; a mesh becomes its boundary in .obj .stl .ply .off",
                  "  incise convert bunny.node bunny.vtu\n  incise convert cut.vtu walls.stl");
  convert->add_option("IN", a.convert.in, "File to read")->required();
  convert->add_option("OUT", a.convert.out, "File to write; the extension names the format")->required();
}

/// How many letters must be changed, added or left out to make one word of another.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, changed}));
    }
  }
  return row[b.size()];
}

/// " (did you mean ...?)" with the known word nearest to one that is not known; empty where none is near.
std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  const std::string* nearest = nullptr;
  for (const std::string& candidate : known) {
    const std::size_t steps = distance(word, candidate);
    if (steps < least) {
      least = steps;
      nearest = &candidate;
    }
  }
  return nearest == nullptr ? "" : " (did you mean " + *nearest + "?)";
}

std::vector<std::string> commands_of(const CLI::App& root) {
  std::vector<std::string> names = {"help"};
  for (const CLI::App* command : root.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

const CLI::App* command_named(const CLI::App& root, const std::string& name) {
  for (const CLI::App* command : root.get_subcommands({})) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

/// Where the command is to be: at the first word that is no option. What comes before takes no values.
std::vector<std::string>::const_iterator command_word(const std::vector<std::string>& words) {
  return std::find_if(words.begin(), words.end(), [](const auto& word) { return !word.empty() && word[0] != '-'; });
}

/// Says that a command is not known; empty where it is, or where none is named.
std::string unknown_command(const CLI::App& root, const std::vector<std::string>& words) {
  const auto word = command_word(words);
  if (word == words.end() || command_named(root, *word) != nullptr) return "";
  return "'" + *word + "' is no command" + suggestion(*word, commands_of(root)) + "; see incise help";
}

/// What is wrong with the words of a call whose command, if it names one, is known: in one line.
std::string explain(const CLI::App& root, const std::vector<std::string>& words, const CLI::ParseError& error) {
  const auto command = command_word(words);
  std::vector<std::string> known = options_of(root);
  std::string text = error.what(), see = "; see incise help";
  if (command != words.end()) {
    const std::vector<std::string> more = options_of(*command_named(root, *command));
    known.insert(known.end(), more.begin(), more.end());
    see += " " + *command;
  }
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    const bool is_unknown = name.rfind("--", 0) == 0 && std::find(known.begin(), known.end(), name) == known.end();
    if (is_unknown) text += suggestion(name, known);
  }
  return text + see;
}

/// `incise help` and `incise help COMMAND` are `--help` of either.
void take_help(std::vector<std::string>& words) {
  const auto word = command_word(words);
  if (word == words.end() || *word != "help") return;
  words.erase(std::remove(words.begin(), words.end(), "help"), words.end());
  words.emplace_back("--help");
}

int dispatch(const CLI::App& root, Arguments& a, const Terminal& terminal) {
  if (root.got_subcommand("info")) return run_info(a.info, terminal);
  if (root.got_subcommand("check")) return run_check(a.check, terminal);
  if (root.got_subcommand("improve")) return run_improve(a.improve, terminal);
  if (root.got_subcommand("simulate")) return run_simulate(a.simulate, terminal);
  if (root.got_subcommand("replay")) return run_replay(a.replay, terminal);
  if (root.got_subcommand("convert")) return run_convert(a.convert, terminal);
  if (root.got_subcommand("mesh")) return run_mesh(a.mesh, terminal);
  a.cut.has_snap = root.get_subcommand("cut")->count("--snap") > 0;
  return run_cut(a.cut, terminal);
}

int run(int argc, char** argv) {
  CLI::App root("incise cuts tetrahedral meshes", "incise");
  Arguments arguments;
  Terminal terminal;
  root.set_version_flag("--version", "incise " INCISE_VERSION);
  root.add_flag("-q,--quiet", terminal.is_quiet, "Print errors and asked-for data only");
  root.add_flag("-v,--verbose", terminal.is_verbose, "Print more of what happens");
  root.require_subcommand(1);
  root.footer(std::string("incise help COMMAND tells more of a command.\n\nExamples:\n  incise info liver.msh\n  "
                          "incise cut cube.mesh --plane 1,0,0,0.5 -o halves.vtu\n"
                          "  incise improve halves.vtu -o better.vtu\n  incise cut --help\n\n") +
              kExitCodes);
  add_info(root, arguments);
  add_cut(root, arguments);
  add_improve(root, arguments);
  add_simulate(root, arguments);
  add_replay(root, arguments);
  add_convert(root, arguments);
  add_mesh(root, arguments.mesh);
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  take_help(words);
  if (const std::string unknown = unknown_command(root, words); !unknown.empty()) {
    terminal.error(unknown);
    return kUsage;
  }
  try {
    root.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes the last word first
  } catch (const CLI::Success& asked) {
    return root.exit(asked);
  } catch (const CLI::ParseError& error) {
    terminal.error(explain(root, words, error));
    return kUsage;
  }
  return dispatch(root, arguments, terminal);
}

}  // namespace
}  // namespace incise_cli

int main(int argc, char** argv) {
  incise_cli::catch_interrupts();
  try {
    return incise_cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    incise_cli::Terminal().error("out of memory; use a smaller mesh or a larger machine");
  } catch (const std::exception& error) {
    incise_cli::Terminal().error(error.what());
  }
  return incise_cli::kFailure;
}
