// SPDX-License-Identifier: Apache-2.0
// How the command talks: what it wrote, JSON, stdin and stdout, warnings, files of another kind.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "incise/io/mesh_file.h"
#include "support/scene_cases.h"

namespace habits_test {
namespace {

using namespace incise_test;
using nlohmann::json;

class CliHabits : public testing::Test {
 protected:
  Folder folder_;
  std::string cube_ = folder_.write("cube.mesh", cube_mesh(3));
};

TEST_F(CliHabits, says_what_was_written_unless_it_shall_be_quiet) {
  const std::string out = folder_ / "out.vtu", report = folder_ / "r.json", record = folder_ / "r.jsonl";
  const std::vector<std::string> cut = {"cut", cube_,      "--plane", "1,0,0,0.4", "-o",
                                        out,   "--report", report,    "--record",  record};
  const Outcome told = run(cut);
  ASSERT_EQ(told.code, 0) << told.err;
  const auto mesh = incise::io::read_mesh(out);
  EXPECT_NE(told.err.find("incise: wrote " + out + " (" + std::to_string(mesh->file_tets) + " tets, " +
                          std::to_string(mesh->file_vertices) + " vertices)\n"),
            std::string::npos)
      << told.err;
  EXPECT_NE(told.err.find("incise: wrote " + report + " (report)\n"), std::string::npos) << told.err;
  EXPECT_NE(told.err.find("incise: wrote " + record + " (recording)\n"), std::string::npos) << told.err;
  const std::string node = folder_ / "a.node", ele = folder_ / "a.ele", obj = folder_ / "a.obj";
  EXPECT_EQ(run({"convert", cube_, node}).err, "incise: wrote " + node + " and " + ele + " (162 tets, 64 vertices)\n");
  EXPECT_EQ(run({"convert", cube_, obj}).err, "incise: wrote " + obj + " (108 triangles, 56 vertices)\n");
  EXPECT_EQ(run({"convert", cube_, obj, "-q"}).err, "");
}

TEST_F(CliHabits, prints_json_where_it_is_asked_to) {
  const std::string record = folder_ / "r.jsonl";
  const Outcome cut = run({"cut", cube_, "--plane", "1,0,0,0.4", "--json", "--record", record, "-q"});
  EXPECT_EQ(json::parse(cut.out)["format"], "incise-report");
  EXPECT_EQ(json::parse(run({"improve", cube_, "--json"}).out)["format"], "incise-report");
  const json replay = json::parse(run({"replay", record, "--verify", "--json"}).out);
  EXPECT_EQ(replay["format"], "incise-replay");
  EXPECT_EQ(replay["mesh"]["after"], json::parse(cut.out)["mesh"]["after"]);
  EXPECT_EQ(replay["hash"], json::parse(cut.out)["hash"]);
  EXPECT_TRUE(replay["difference"].is_null());
  const json convert = json::parse(run({"convert", cube_, folder_ / "a.node", "--json"}).out);
  EXPECT_EQ(convert["tets"], 162);
  EXPECT_EQ(convert["output"].size(), 2U);
  const std::string scene = folder_.write("scene.json", full_scene().dump());
  EXPECT_EQ(json::parse(run({"simulate", scene, "--frames", "2", "--json"}).out)["scene"]["frames"], 2);
}

TEST_F(CliHabits, json_of_a_replay_names_the_difference) {
  const std::string record = folder_ / "r.jsonl";
  ASSERT_EQ(run({"cut", cube_, "--plane", "1,0,0,0.4", "--record", record, "-q"}).code, 0);
  std::string text = read(record);
  const std::size_t at = text.find("\"hash\":\"", text.find('\n')) + 8;
  text[at] = text[at] == '0' ? '1' : '0';
  folder_.write("r.jsonl", text);
  const Outcome replay = run({"replay", record, "--verify", "--json"});
  EXPECT_EQ(replay.code, 4);
  EXPECT_EQ(json::parse(replay.out)["difference"]["line"], 2);
}

TEST_F(CliHabits, meshes_come_by_stdin_and_go_by_stdout) {
  const Outcome vtu = run({"convert", cube_, "-", "--format", "vtu"});
  ASSERT_EQ(vtu.code, 0) << vtu.err;
  EXPECT_EQ(vtu.err, "");
  EXPECT_EQ(json::parse(run_on(vtu.out, {"info", "-", "--json"}).out)["tets"], 162);
  const Outcome cut = run_on(vtu.out, {"cut", "-", "--plane", "1,0,0,0.4", "-o", "-", "--format", "msh41-binary"});
  ASSERT_EQ(cut.code, 0) << cut.err;
  EXPECT_NE(cut.err.find("1 -> 2 pieces"), std::string::npos) << "the summary makes room: " << cut.err;
  EXPECT_EQ(json::parse(run_on(cut.out, {"check", "-", "--json"}).out)["components"], 2);
  const std::string better = folder_ / "better.mesh";
  EXPECT_EQ(run_on(cut.out, {"improve", "-", "-o", better, "-q"}).code, 0);
  EXPECT_EQ(json::parse(run({"check", better, "--json"}).out)["components"], 2);
  const std::string blade = read(INCISE_SCENES "/cube_plane.json");
  EXPECT_EQ(run_on(blade, {"cut", cube_, "--blade", "-", "-q"}).code, 0);
  EXPECT_EQ(run_on(full_scene().dump(), {"simulate", "-", "--frames", "2", "-q"}).code, 0);
}

const std::string kTetrahedronOff = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

TEST_F(CliHabits, surfaces_come_by_stdin_and_go_by_stdout) {
  const std::string obj = folder_ / "a.obj";
  const Outcome to_file = run_on(kTetrahedronOff, {"convert", "-", obj});
  ASSERT_EQ(to_file.code, 0) << to_file.err;
  EXPECT_NE(to_file.err.find("4 triangles"), std::string::npos) << to_file.err;
  const Outcome stl = run_on(kTetrahedronOff, {"convert", "/dev/stdin", "-", "--format", "stl"});
  EXPECT_EQ(stl.out.size(), 84U + 4 * 50) << stl.err;
  const Outcome walls = run({"convert", cube_, "-", "--format", "off"});
  EXPECT_EQ(walls.out.substr(0, 12), "OFF\n56 108 0") << walls.err;
  EXPECT_EQ(run({"convert", cube_, folder_ / "a.stl", "--format", "stl"}).code, 0);
  const Outcome other = run({"convert", cube_, obj, "--format", "stl"});
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("writes .stl files"), std::string::npos) << other.err;
}

TEST_F(CliHabits, a_pipe_that_is_no_mesh_is_refused_by_its_beginning) {
  const std::string mesh = folder_ / "out.mesh", surface = folder_ / "out.stl";
  for (const std::string& text :
       {std::string("y\n"), std::string(64, '\0'), std::string("\xff\x13"), std::string("{\n"), std::string("1\n"),
        std::string("1 2 3 4\n"), std::string("\n"), std::string("# x\n"), std::string("*\n"), std::string("<a>\n")}) {
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"info", "-"},
                                               {"check", "-"},
                                               {"convert", "-", mesh},
                                               {"convert", "-", surface},
                                               {"cut", "-", "--plane", "1,0,0,0.4"},
                                               {"mesh", "-", "--size", "1", "-o", mesh}}) {
      const Outcome outcome = run_on_endless(text, command);
      EXPECT_EQ(outcome.code, 3) << command[0] << ": " << outcome.err;
      EXPECT_EQ(outcome.err.find("incise: error: stdin:"), 0U) << command[0] << ": " << outcome.err;
    }
  }
}

TEST_F(CliHabits, large_files_of_every_format_come_by_a_pipe) {
  const std::string large = folder_.write("large.mesh", cube_mesh(18, 0.1));
  for (const char* format : {"mesh", "msh41", "msh41-binary", "msh22", "vtk", "vtu", "veg", "inp"}) {
    const std::string bytes = run({"convert", large, "-", "--format", format}).out;
    EXPECT_GT(bytes.size(), 1U << 18U) << format;
    const Outcome info = run_on(bytes, {"info", "-", "--json"});
    ASSERT_EQ(info.code, 0) << format << ": " << info.err;
    EXPECT_EQ(json::parse(info.out)["tets"], 6 * 18 * 18 * 18) << format;
  }
}

TEST_F(CliHabits, what_is_replaced_keeps_its_permissions_and_its_links) {
  namespace fs = std::filesystem;
  const std::string mesh = folder_.write("real.mesh", ""), link = folder_ / "link.mesh",
                    report = folder_ / "report.json";
  fs::permissions(mesh, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real.mesh", link);
  fs::create_symlink("later.json", report);
  ASSERT_EQ(run({"cut", cube_, "--plane", "1,0,0,0.4", "-o", link, "--report", report, "-q"}).code, 0);
  EXPECT_TRUE(fs::is_symlink(link) && fs::is_symlink(report));
  EXPECT_GT(fs::file_size(mesh), 1000U);
  EXPECT_GT(fs::file_size(folder_ / "later.json"), 1000U);
  EXPECT_EQ(fs::status(mesh).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(fs::status(folder_ / "later.json").permissions() & fs::perms::group_exec, fs::perms::none);
}

TEST_F(CliHabits, the_device_of_stdout_is_stdout) {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"convert", cube_, "/dev/stdout", "--format", "stl"},
           {"cut", cube_, "--plane", "1,0,0,0.4", "-o", "/dev/stdout", "--format", "vtu"}}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_GT(outcome.out.size(), 1000U);
  }
  EXPECT_TRUE(json::accept(run({"cut", cube_, "--plane", "1,0,0,0.4", "--report", "/dev/stdout"}).out));
}

TEST_F(CliHabits, a_seed_is_a_whole_number_in_decimal_digits) {
  const auto cut = [&](const std::string& seed) {
    return run({"cut", cube_, "--plane", "1,0,0,0.4", "--json", "--seed", seed});
  };
  EXPECT_EQ(json::parse(cut("010").out)["options"]["seed"], 10);
  EXPECT_EQ(json::parse(cut("18446744073709551615").out)["options"]["seed"], 18446744073709551615U);
  for (const char* seed : {"-1", "1e3", "0x10", "", "18446744073709551616"}) {
    const Outcome outcome = cut(seed);
    EXPECT_EQ(outcome.code, 2) << seed;
    EXPECT_NE(outcome.err.find("--seed"), std::string::npos) << outcome.err;
  }
}

TEST_F(CliHabits, errors_of_usage_are_plain) {
  const auto error = [&](std::vector<std::string> words) { return run(words).err; };
  EXPECT_EQ(error({}), "incise: error: no command is given; see incise help\n");
  EXPECT_EQ(error({"-x"}), "incise: error: -x: not known here; see incise help\n");
  EXPECT_EQ(error({"cut"}), "incise: error: MESH is missing; see incise help cut\n");
  EXPECT_EQ(error({"cut", cube_, "--plan", "1"}),
            "incise: error: --plan, 1: not known here (did you mean --plane?); see incise help cut\n");
  EXPECT_EQ(error({"cut", cube_, "--plane", "1", "--plane", "2"}),
            "incise: error: --plane is given 2 times; once is enough; see incise help cut\n");
  EXPECT_EQ(error({"cut", cube_, "--threads", "x"}).find("incise: error: --threads: "), 0U);
  EXPECT_EQ(error({"completion", "fish"}),
            "incise: error: SHELL: fish is none of bash, zsh; see incise help completion\n");
}

TEST_F(CliHabits, words_for_a_shell_and_pages_come_as_json_too) {
  EXPECT_EQ(json::parse(run({"man", "cut", "--json"}).out)["page"], run({"man", "cut"}).out);
  EXPECT_EQ(json::parse(run({"completion", "bash", "--json"}).out)["script"], run({"completion", "bash"}).out);
}

TEST_F(CliHabits, a_recording_comes_by_stdin) {
  const std::string record = folder_ / "r.jsonl";
  ASSERT_EQ(run({"cut", cube_, "--plane", "1,0,0,0.4", "--record", record, "-q"}).code, 0);
  std::string text = read(record);
  const std::string name = "\"cube.mesh\"";
  if (const std::size_t at = text.find(name); at != std::string::npos) {
    text.replace(at, name.size(), json(cube_).dump());  // there it is named from where the command runs
  }
  for (const char* in : {"-", "/dev/stdin"}) {
    const Outcome replay = run_on(text, {"replay", in, "--verify"});
    EXPECT_EQ(replay.code, 0) << replay.err;
    EXPECT_EQ(replay.out, run({"replay", record, "--verify"}).out);
  }
}

TEST_F(CliHabits, stdin_has_one_name_in_messages) {
  for (const char* in : {"-", "/dev/stdin"}) {
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"info", in},
                                               {"cut", in, "--plane", "1,0,0,0.4"},
                                               {"cut", cube_, "--blade", in},
                                               {"convert", in, folder_ / "a.obj"},
                                               {"mesh", in, "-o", folder_ / "a.mesh", "--size", "1"},
                                               {"simulate", in},
                                               {"replay", in}}) {
      const Outcome outcome = run_on("nothing of use\n", command);
      EXPECT_EQ(outcome.code, 3) << command[0];
      EXPECT_EQ(outcome.err.find("incise: error: stdin:"), 0U) << outcome.err;
      EXPECT_EQ(outcome.err.find("/dev/stdin"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(json::parse(run_on(read(cube_), {"info", in, "--json"}).out)["file"], "stdin");
  }
  EXPECT_EQ(run_on("{}", {"batch", "-", "-o", folder_ / "out"}).code, 2);
  const Outcome mesh = run_on(kTetrahedronOff, {"mesh", "-", "-o", folder_ / "a.mesh", "--size", "1"});
  EXPECT_NE(mesh.err.find("give a surface as a file"), std::string::npos) << mesh.err;
}

TEST_F(CliHabits, what_is_no_recording_is_refused_before_it_fills_the_memory) {
  const Outcome device = run({"replay", "/dev/zero"});
  EXPECT_EQ(device.code, 3);
  EXPECT_NE(device.err.find("is a device"), std::string::npos) << device.err;
  const Outcome zeros = run_on(std::string(1000, '\0'), {"replay", "-"});
  EXPECT_EQ(zeros.code, 3);
  EXPECT_NE(zeros.err.find("stdin:1: a zero byte"), std::string::npos) << zeros.err;
}

TEST_F(CliHabits, what_stdout_does_not_take_is_a_failure) {
  const std::string record = folder_ / "r.jsonl", scene = folder_.write("scene.json", full_scene().dump());
  ASSERT_EQ(run({"cut", cube_, "--plane", "1,0,0,0.4", "--record", record, "-q"}).code, 0);
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"cut", cube_, "--plane", "1,0,0,0.4"},
                                             {"improve", cube_},
                                             {"simulate", scene, "--frames", "1"},
                                             {"replay", record},
                                             {"info", cube_},
                                             {"check", cube_, "--json"},
                                             {"help"},
                                             {"help", "cut"},
                                             {"--version"},
                                             {"man"}}) {
    const Outcome full = run_to("/dev/full", command);
    EXPECT_EQ(full.code, 1) << command[0];
    EXPECT_NE(full.err.find("error: stdout: writing failed"), std::string::npos) << full.err;
  }
  EXPECT_EQ(run_to("/dev/full", {"cut", cube_, "--plane", "1,0,0,0.4", "-q"}).code, 0) << "nothing was to be printed";
}

TEST_F(CliHabits, what_killed_runs_left_goes_whatever_is_written) {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  const std::string ending = "." + std::to_string(child) + ".0.incise-part";
  const std::string mesh = folder_ / "a.vtu", report = folder_ / "a.json", record = folder_ / "a.jsonl";
  for (const char* name : {"a.vtu", "a.json", "a.jsonl"}) folder_.write(name + ending, "half");
  ASSERT_EQ(run({"cut", cube_, "--plane", "1,0,0,0.4", "-o", mesh, "--report", report, "--record", record}).code, 0);
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a.json", "a.jsonl", "a.vtu", "cube.mesh"}));
}

TEST_F(CliHabits, stdout_takes_one_thing_in_a_format_that_is_named) {
  const auto expect_usage = [&](std::vector<std::string> words, const std::string& part) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  };
  const std::vector<std::string> cut = {"cut", cube_, "--plane", "1,0,0,0.4"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), cut.begin(), cut.end());
    return more;
  };
  expect_usage(with({"-o", "-"}), "needs --format");
  expect_usage(with({"-o", "-", "--format", "node"}), "makes two files");
  expect_usage(with({"-o", "-", "--format", "vtu", "--json"}), "stdout");
  expect_usage(with({"-o", "-", "--format", "vtu", "--report", "-"}), "stdout");
  expect_usage(with({"--format", "vtu"}), "give both");
  expect_usage(with({"-o", folder_ / "a.vtu", "--format", "msh22"}), "writes .msh files");
  expect_usage(with({"--record", "-"}), "name a file");
  expect_usage({"cut", "-", "--blade", "-"}, "cannot both come from stdin");
  expect_usage({"cut", "-", "--plane", "1,0,0,0.4", "--record", folder_ / "r.jsonl"}, "as a file");
  expect_usage({"convert", cube_, "-"}, "needs --format");
  expect_usage({"convert", cube_, "-"}, "msh, obj, stl, ply, off");
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"cube.mesh"});
}

TEST_F(CliHabits, writes_the_variant_of_gmsh_that_is_asked_for) {
  const std::string out = folder_ / "a.msh";
  const std::vector<std::pair<std::string, std::string>> variants = {
      {"msh", "Gmsh MSH 4.1 ASCII"}, {"msh41-binary", "Gmsh MSH 4.1 binary"}, {"msh22", "Gmsh MSH 2.2 ASCII"}};
  for (const auto& [format, name] : variants) {
    ASSERT_EQ(run({"convert", cube_, out, "--format", format}).code, 0);
    EXPECT_EQ(json::parse(run({"info", out, "--json"}).out)["format"], name);
  }
}

TEST_F(CliHabits, warns_of_a_plane_or_a_blade_that_misses) {
  const Outcome plane = run({"cut", cube_, "--plane", "2,0,0,5"});
  EXPECT_EQ(plane.code, 0);
  EXPECT_NE(plane.err.find("warning: the plane 2,0,0,5 misses the mesh: nothing was cut; d has to lie between 0 and 2"),
            std::string::npos)
      << plane.err;
  const Outcome beside = run({"cut", cube_, "--plane", "1,0,0,1"});
  EXPECT_NE(beside.err.find("the plane 1,0,0,1 only touches the mesh: no face came open; d has to lie between 0 and 1"),
            std::string::npos)
      << beside.err;
  EXPECT_EQ(run({"cut", cube_, "--plane", "2,0,0,5", "-q"}).err, "");
  EXPECT_EQ(run({"cut", cube_, "--plane", "2,0,0,1"}).err.find("warning"), std::string::npos);
  const std::string blade = folder_.write("blade.json", R"({"format":"incise-blade","version":1,"strokes":[
        {"edges":[{"t":0,"points":[[0.4,-1,-1],[0.4,2,-1]]},{"t":1,"points":[[0.4,-1,2],[0.4,2,2]]}]},
        {"name":"far","edges":[{"t":0,"points":[[4,-1,-1],[4,2,-1]]},{"t":1,"points":[[4,-1,2],[4,2,2]]}]}]})");
  const Outcome far = run({"cut", cube_, "--blade", blade});
  EXPECT_NE(far.err.find("warning: " + blade + ": stroke 1 \"far\" cut nothing"), std::string::npos) << far.err;
}

TEST_F(CliHabits, warns_of_a_stroke_along_an_older_cut_and_of_a_blade_in_the_air) {
  const std::string halves = folder_ / "halves.vtu";
  ASSERT_EQ(run({"cut", cube_, "--plane", "1,0,0,0.4", "-o", halves, "-q"}).code, 0);
  const Outcome again = run({"cut", halves, "--plane", "1,0,0,0.4"});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("warning: the plane 1,0,0,0.4 cut nothing"), std::string::npos) << again.err;
  for (const char* method : {"snapping", "moving", "minimal"}) {
    const Outcome lab = run({"cut", halves, "--plane", "1,0,0,0.4", "--profile", method});
    EXPECT_NE(lab.err.find("warning: the plane 1,0,0,0.4 cut nothing"), std::string::npos) << method << lab.err;
  }
  json scene = json::parse(R"({"format":"incise-scene","version":1,"model":{"box":{"cells":[2,2,2]}},"length_unit":0.1,
      "materials":{"default":{"density":1000,"young":5000,"poisson":0.4}},"duration":0.2,
      "attachments":[{"below":[0,0,1,0.1]}],"strokes":[{"start":0,"blade":[{"edges":[
        {"t":0,"points":[[4,-1,-1],[4,2,-1]]},{"t":0.1,"points":[[4,-1,2],[4,2,2]]}]}]}]})");
  const auto warned = [&] {
    const Outcome outcome = run({"simulate", folder_.write("scene.json", scene.dump())});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err.find("scene.json: stroke 0 cut nothing") != std::string::npos;
  };
  EXPECT_TRUE(warned());
  for (auto& edge : scene["strokes"][0]["blade"][0]["edges"]) {
    for (auto& point : edge["points"]) point[0] = 0.4;
  }
  EXPECT_FALSE(warned());
}

TEST_F(CliHabits, reports_a_cut_that_leaves_nothing_and_writes_no_file) {
  const std::string tet = folder_.write("tet.mesh", R"(MeshVersionFormatted 1
Dimension 3
Vertices
4
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
Tetrahedra
1
1 2 3 4 0
End
)");
  const std::string out = folder_ / "none.vtu";
  const Outcome gone = run({"cut", tet, "--plane", "1,0,0,0.3", "--profile", "removal", "-o", out, "--report", "-"});
  EXPECT_EQ(gone.code, 1);
  EXPECT_NE(gone.err.find("incise: error: nothing is left of the mesh, so that " + out), std::string::npos) << gone.err;
  EXPECT_EQ(json::parse(gone.out)["mesh"]["after"]["tets"], 0);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(CliHabits, cuts_a_stroke_as_one_sheet_where_it_is_asked_to) {
  const std::string blade = INCISE_SCENES "/table2_cube_complex.json";
  const std::string cube = folder_.write("five.mesh", cube_mesh(5));
  const auto tets = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"cut", cube, "--blade", blade, "--profile", "paper", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return json::parse(run(words).out)["mesh"]["after"]["tets"].get<int>();
  };
  EXPECT_EQ(tets({"--at-once", "--no-merge", "--no-improve"}), 3836);  // docs/paper_map.md, Table 2
  EXPECT_EQ(tets({"--at-once", "--no-improve"}), 1978);
  EXPECT_EQ(run({"cut", cube, "--plane", "1,0,0,0.5", "--at-once"}).err.find("note: --at-once has no effect") !=
                std::string::npos,
            true);
}

TEST_F(CliHabits, says_of_files_of_another_kind_what_they_are_and_what_to_use) {
  const std::string scene = folder_.write("scene.json", full_scene().dump());
  const std::string blade = INCISE_SCENES "/cube_plane.json", record = folder_ / "r.jsonl";
  ASSERT_EQ(run({"cut", cube_, "--plane", "1,0,0,0.4", "--record", record, "-q"}).code, 0);
  const auto expect_told = [&](const std::vector<std::string>& words, const std::string& file,
                               const std::string& part) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("incise: error: " + file + ": is " + part), std::string::npos) << outcome.err;
  };
  expect_told({"simulate", cube_}, cube_, "a mesh (MEDIT .mesh ASCII, 162 tets); cut it with incise cut");
  expect_told({"simulate", record}, record, "a recording; run it again with incise replay");
  expect_told({"simulate", blade}, blade, "a blade file");
  expect_told({"cut", cube_, "--blade", scene}, scene, "a scene; run it with incise simulate");
  expect_told({"cut", scene, "--plane", "1,0,0,0.4"}, scene, "a scene");
  expect_told({"info", record}, record, "a recording");
  expect_told({"check", blade}, blade, "a blade file");
  expect_told({"replay", cube_}, cube_, "a mesh");
}

TEST_F(CliHabits, a_full_stdout_is_a_failure) {
  EXPECT_EQ(run_to("/dev/full", {"info", cube_}).code, 1);
  EXPECT_NE(run_to("/dev/full", {"info", cube_}).err.find("stdout: writing failed"), std::string::npos);
}

}  // namespace

}  // namespace habits_test
