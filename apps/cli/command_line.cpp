// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <string>

#include "app/jobs/cut_job.h"
#include "app/scene/scene.h"

namespace incise_cli {
namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 failure, 2 usage, 3 bad input, 4 a check failed, 5 no display, 130 interrupted.\n"
    "Formats: .mesh .msh .vtk .vtu .node/.ele .veg .inp, tetrahedral .ply (read only); all also gzipped.\n"
    "- for a mesh reads it from stdin, and -o - writes it to stdout, with --format.";
constexpr const char* kMeshHelp = "Mesh file, or - for stdin; the format is found from its content";
constexpr const char* kOutputHelp = "Write the mesh; the extension names the format; - for stdout, with --format";

CLI::App* add_command(CLI::App& root, const std::string& name, const std::string& what, const std::string& examples) {
  CLI::App* command = root.add_subcommand(name, what);
  command->fallthrough();
  command->footer("Examples:\n" + examples);
  return command;
}

void add_json(CLI::App& command, bool& as_json) {
  command.add_flag("--json", as_json, "Print JSON to stdout");
}

void add_report(CLI::App& command, std::string& report, bool& as_json) {
  command.add_option("--report", report, "Write figures as JSON to this file; - for stdout");
  command.add_flag("--json", as_json, "Print the figures as JSON to stdout, instead of a few lines for people");
}

void add_format(CLI::App& command, std::string& format) {
  command
      .add_option("--format", format, "Of the mesh that is written, instead of what its extension says: msh is msh41")
      ->check(CLI::IsMember({"mesh", "msh", "msh41", "msh41-binary", "msh22", "vtk", "vtu", "node", "veg", "inp"}));
}

void add_output(CLI::App& command, MeshOutput& output) {
  command.add_option("-o,--output", output.file, kOutputHelp);
  add_format(command, output.format);
}

void add_info(CLI::App& root, Arguments& a) {
  CLI::App* info = add_command(root, "info", "Say what is in a mesh file and what is wrong with it",
                               "  incise info liver.msh\n  incise info liver.msh --json");
  info->add_option("MESH", a.info.mesh, kMeshHelp)->required();
  add_json(*info, a.info.as_json);
  CLI::App* check = add_command(root, "check", "Check validity and quality; exit 4 where the mesh is invalid",
                                "  incise check liver.msh\n  incise check cut.vtu --json");
  check->add_option("MESH", a.check.mesh, kMeshHelp)->required();
  add_json(*check, a.check.as_json);
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
  cut->add_option("MESH", a.cut.mesh, kMeshHelp)->required();
  cut->add_option("--blade", a.cut.blade, "Blade file: JSON of format incise-blade; - for stdin");
  cut->add_option("--plane", a.cut.plane, "nx,ny,nz,d: cut through everything along n.x = d, n of any length");
  add_output(*cut, a.cut.output);
  add_profile(*cut, a.cut.profile);
  cut->add_option("--snap", a.cut.snap,
                  "Snapping distance as a fraction of the mean incident edge, 0 to 0.4 (default 0.2)");
  cut->add_flag("--no-merge", a.cut.no_merge, "Do not merge short edges after a stroke");
  cut->add_flag("--no-improve", a.cut.no_improve, "Do not improve the mesh around a cut after a stroke");
  cut->add_flag("--no-smooth-boundary", a.cut.no_smooth_boundary,
                "Of --profile paper: leave its Boundary Laplacian out (the paper's Figure 10)");
  add_report(*cut, a.cut.report, a.cut.as_json);
  cut->add_option("--seed", a.cut.seed, "Seed, repeated in the report");
  cut->add_option("--threads", a.cut.threads, "Worker threads, 1 to 256; the result does not depend on it")
      ->check(CLI::Range(1, 256));
  cut->add_option("--record", a.cut.record, "Record every step as JSON lines, for incise replay");
  cut->add_option("--picture", a.cut.picture, "Draw the result to this PNG; needs OpenGL, but no display");
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
  improve->add_option("MESH", a.improve.mesh, kMeshHelp)->required();
  add_output(*improve, a.improve.output);
  add_profile(*improve, a.improve.profile);
  add_report(*improve, a.improve.report, a.improve.as_json);
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
  simulate->add_option("SCENE", s.scene, "Scene file: JSON of format incise-scene; - for stdin")->required();
  simulate->add_option("--frames", s.frames, "Frames to run, instead of the scene's")
      ->check(CLI::Range(std::uint64_t{1}, incise::app::kMaxSceneFrames));
  simulate->add_option("-o,--output", s.output, "Write the body over time: NAME.pvd with the folder NAME_frames");
  simulate->add_option("--every", s.every, "Frames between two files of -o (default: about 100 files)")
      ->check(CLI::Range(std::uint64_t{1}, incise::app::kMaxSceneFrames));
  add_report(*simulate, s.report, s.as_json);
  simulate->add_option("--record", s.record, "Record every frame as JSON lines, for incise replay");
  simulate->add_option("--profile", s.profile, "incise, or paper: the published method; instead of the scene's")
      ->check(CLI::IsMember({"incise", "paper"}));
  add_budget(*simulate, s.budget_us,
             "Microseconds for maintenance per frame, 1 to 3600000000, taken as 10 work units each: no clock is read");
  simulate->add_option("--seed", s.seed, "Seed, instead of the scene's");
  simulate->add_flag("--ideal", s.is_ideal, "Show and score an exercise's ideal strokes, instead of the scene's");
  simulate->add_option("--threads", s.threads, "Worker threads, 1 to 256; the result does not depend on it")
      ->check(CLI::Range(1, 256));
}

void add_replay(CLI::App& root, Arguments& a) {
  CLI::App* replay = add_command(root, "replay", "Repeat what --record has recorded; exit 4 where the result differs",
                                 "  incise replay cut.jsonl --verify\n  incise replay cut.jsonl -o cut.vtu");
  replay->add_option("REC", a.replay.recording, "Recording: JSON lines of format incise-recording or incise-simulation")
      ->required();
  replay->add_flag("--verify", a.replay.verify, "Compare after every step or frame, not only at the end");
  add_output(*replay, a.replay.output);
  add_json(*replay, a.replay.as_json);
}

void add_convert(CLI::App& root, Arguments& a) {
  CLI::App* convert =
      add_command(root, "convert", "Convert a mesh or surface; a mesh becomes its boundary in .obj .stl .ply .off",
                  "  incise convert bunny.node bunny.vtu\n  incise convert cut.vtu walls.stl\n"
                  "  incise convert cut.vtu cut.msh --format msh22\n"
                  "  zcat liver.mesh.gz | incise convert - - --format vtu > liver.vtu");
  convert->add_option("IN", a.convert.in, "File to read; - for a mesh from stdin")->required();
  convert->add_option("OUT", a.convert.out.file, "File to write; the extension names the format; - for stdout")
      ->required();
  add_format(*convert, a.convert.out.format);
  add_json(*convert, a.convert.as_json);
}

void add_mesh(CLI::App& root, Arguments& arguments) {
  MeshArguments& a = arguments.mesh;
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
  mesh->add_option("--threads", a.threads, "Worker threads, 1 to 256; the result does not depend on it")
      ->check(CLI::Range(1, 256));
}

void add_completion(CLI::App& root, Arguments& a) {
  CLI::App* completion =
      add_command(root, "completion", "Print a script that completes commands and options in a shell",
                  "  source <(incise completion bash)\n"
                  "  incise completion zsh > ~/.zsh/functions/_incise");
  completion->add_option("SHELL", a.shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
}

void add_man(CLI::App& root, Arguments& a) {
  CLI::App* man = add_command(root, "man", "Print the manual page of incise, or of one of its commands, for man(1)",
                              "  incise man | man -l -\n  incise man cut > incise-cut.1");
  man->add_option("COMMAND", a.manual, "The command; without it the page of incise itself");
}

}  // namespace

void add_commands(CLI::App& root, Arguments& arguments) {
  root.require_subcommand(1);
  root.footer(std::string("incise help COMMAND tells more of a command.\n\nExamples:\n  incise info liver.msh\n  "
                          "incise cut cube.mesh --plane 1,0,0,0.5 -o halves.vtu\n"
                          "  incise improve halves.vtu -o better.vtu\n  incise help cut\n\n") +
              kExitCodes);
  add_info(root, arguments);
  add_cut(root, arguments);
  add_improve(root, arguments);
  add_simulate(root, arguments);
  add_replay(root, arguments);
  add_convert(root, arguments);
  add_mesh(root, arguments);
  add_completion(root, arguments);
  add_man(root, arguments);
}

}  // namespace incise_cli
