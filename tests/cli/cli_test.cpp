// SPDX-License-Identifier: Apache-2.0
// What the command does when all is well.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "incise/io/mesh_file.h"

namespace cli_test {
namespace {

using namespace incise_test;
using nlohmann::json;

/// Cuts and leaves the mesh as the cut left it.
Outcome run_plain_cut(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "cut");
  arguments.insert(arguments.end(), {"--no-merge", "--no-improve"});
  return run(arguments);
}

TEST(Cli, cuts_by_the_methods_that_the_paper_cites) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(5));
  const std::vector<std::pair<std::string, int>> tets = {{"removal", 600},   {"snapping", 750},   {"moving", 1300},
                                                         {"adaptive", 2450}, {"seventeen", 3750}, {"minimal", 1300}};
  for (const auto& [method, count] : tets) {
    const std::string out = folder / (method + ".vtu");
    const Outcome outcome = run({"cut", cube, "--plane", "1,0,0,0.5", "--profile", method, "-o", out, "--report", "-"});
    ASSERT_EQ(outcome.code, 0) << method << outcome.err;
    const json figures = json::parse(outcome.out);
    EXPECT_EQ(figures["options"]["profile"], method);
    EXPECT_EQ(figures["options"]["merge"], false);
    EXPECT_EQ(figures["mesh"]["after"]["tets"], count) << method;
    EXPECT_EQ(figures["mesh"]["after"]["components"], 2) << method;
    EXPECT_TRUE(figures["validity"]["ok"]) << method;
    EXPECT_EQ(run({"check", out}).code, 0) << method;
  }
}

TEST(Cli, cuts_by_a_cited_method_along_every_stroke_of_a_blade_file) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(5));
  for (const std::string method : {"removal", "snapping", "moving", "adaptive", "seventeen", "minimal"}) {
    const Outcome cut =
        run({"cut", cube, "--blade", INCISE_SCENES "/cube_cross.json", "--profile", method, "--report", "-"});
    ASSERT_EQ(cut.code, 0) << method << cut.err;
    const json figures = json::parse(cut.out);
    EXPECT_EQ(figures["mesh"]["after"]["components"], 4) << method;
  }
  const std::string err =
      run({"cut", cube, "--plane", "1,0,0,0.5", "--profile", "removal", "--snap", "0.1", "--budget-us", "9"}).err;
  EXPECT_NE(err.find("--snap has no effect with --profile removal"), std::string::npos) << err;
  EXPECT_NE(err.find("--budget-us has no effect with --profile removal"), std::string::npos) << err;
}

TEST(Cli, cuts_the_papers_cube_with_both_profiles) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(5));
  for (const std::string profile : {"paper", "incise"}) {
    const std::string out = folder / (profile + ".vtu");
    const std::string report = folder / (profile + ".json");
    const Outcome cut =
        run_plain_cut({cube, "--plane", "1,0,0,0.5", "--profile", profile, "-o", out, "--report", report});
    EXPECT_EQ(cut.code, 0) << cut.err;
    EXPECT_NE(cut.out.find("750 -> 1300 tets"), std::string::npos) << cut.out;
    EXPECT_NE(cut.out.find("cut 150 tets in 1 step: 200 faces opened"), std::string::npos) << cut.out;
    const json figures = json::parse(read(report));
    EXPECT_EQ(figures["mesh"]["after"]["tets"], 1300);
    EXPECT_EQ(figures["mesh"]["after"]["components"], 2);
    EXPECT_EQ(figures["options"]["profile"], profile);
    EXPECT_EQ(figures["validity"]["ok"], true);
    const Outcome check = run({"check", out, "--json"});
    EXPECT_EQ(check.code, 0) << check.out;
    EXPECT_EQ(json::parse(check.out)["components"], 2);
  }
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"cube.mesh", "incise.json", "incise.vtu", "paper.json", "paper.vtu"}));
}

TEST(Cli, takes_planes_of_any_length_and_sign) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(5));
  std::string hash;
  for (const std::string plane : {"1,0,0,0.5", "4,0,0,2", "1e0,0.0,-0,5e-1"}) {
    const Outcome cut = run_plain_cut({cube, "--plane", plane, "--report", "-"});
    ASSERT_EQ(cut.code, 0) << plane << cut.err;
    EXPECT_EQ(json::parse(cut.out)["mesh"]["after"]["tets"], 1300) << plane;
  }
  for (const std::string plane : {"--plane=-1,0,0,-0.5", "--plane=0,-3,0,-1.5"}) {
    EXPECT_NE(run_plain_cut({cube, plane}).out.find("-> 1300 tets"), std::string::npos) << plane;
  }
  EXPECT_NE(run_plain_cut({cube, "--plane", "-1,0,0,-0.5"}).out.find("-> 1300 tets"), std::string::npos);
}

TEST(Cli, a_plane_or_blade_that_misses_changes_nothing) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(2));
  const Outcome cut = run({"cut", cube, "--plane", "1,0,0,5", "--report", "-"});
  ASSERT_EQ(cut.code, 0) << cut.err;
  const json report = json::parse(cut.out);
  EXPECT_EQ(report["mesh"]["after"], report["mesh"]["before"]);
  EXPECT_TRUE(report["quality"]["after"]["incision"]["lr_max"].is_null());
  EXPECT_TRUE(report["quality"]["cut"]["incision"]["lr_max"].is_null());
}

TEST(Cli, cuts_along_every_scene_of_the_cube) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(5));
  const std::vector<std::pair<std::string, int>> scenes = {{"cube_plane", 2}, {"cube_cross", 4}, {"cube_core", 2}};
  for (const auto& [scene, pieces] : scenes) {
    for (const std::string profile : {"paper", "incise"}) {
      const Outcome cut =
          run({"cut", cube, "--blade", INCISE_SCENES "/" + scene + ".json", "--profile", profile, "--report", "-"});
      ASSERT_EQ(cut.code, 0) << scene << profile << cut.err;
      EXPECT_EQ(json::parse(cut.out)["mesh"]["after"]["components"], pieces) << scene << profile;
    }
  }
}

TEST(Cli, equal_calls_give_equal_bytes) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(4));
  for (const std::string threads : {"1", "3"}) {
    ASSERT_EQ(
        run({"cut", cube, "--plane", "1,2,3,2.9", "-q", "--threads", threads, "-o", folder / (threads + ".msh")}).code,
        0);
  }
  EXPECT_EQ(read(folder / "1.msh"), read(folder / "3.msh"));
  EXPECT_FALSE(read(folder / "1.msh").empty());
}

TEST(Cli, says_which_flags_have_no_effect) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(2));
  const std::vector<std::string> cut = {"cut", cube, "--plane", "1,0,0,0.3", "--seed", "7"};
  const auto err_of = [&](std::vector<std::string> more) {
    more.insert(more.begin(), cut.begin(), cut.end());
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_EQ(err_of({"--no-merge", "--no-improve", "--snap", "0"}), "");
  EXPECT_EQ(err_of({"--no-merge", "--budget-us", "100000"}), "");
  EXPECT_NE(err_of({"--profile", "paper", "--snap", "0.1"}).find("--snap has no effect"), std::string::npos);
  EXPECT_NE(err_of({"--profile", "paper", "--budget-us", "9"}).find("--budget-us has no effect"), std::string::npos);
  EXPECT_NE(err_of({"--no-merge", "--no-improve", "--budget-us", "9"}).find("no effect"), std::string::npos);
}

TEST(Cli, without_maintenance_writes_the_cutters_mesh_and_says_so) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(5));
  const Outcome cut = run_plain_cut({cube, "--plane", "1,2,3,2.9", "--report", "-"});
  ASSERT_EQ(cut.code, 0) << cut.err;
  const json report = json::parse(cut.out);
  EXPECT_EQ(report["options"]["merge"], false);
  EXPECT_EQ(report["options"]["improve"], false);
  EXPECT_EQ(report["maintain"]["work_units"], 0);
  EXPECT_EQ(report["quality"]["cut"], report["quality"]["after"]);
  EXPECT_EQ(report["mesh"]["after"]["tets"], 750 + report["cut"]["created_tets"].get<int>());
  EXPECT_LE(report["volume"]["relative_error"].get<double>(), 1e-12);
}

TEST(Cli, maintains_each_stroke_within_its_budget) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(5));
  const std::string blade = INCISE_SCENES "/cube_cross.json";
  std::map<std::string, std::string> hashes;
  for (const std::string budget : {"", "--budget-us=1", "--budget-us=3600000000", "--budget-us=3500000000"}) {
    std::vector<std::string> arguments = {"cut", cube, "--blade", blade, "--snap", "0", "--report", "-"};
    if (!budget.empty()) arguments.push_back(budget);
    const Outcome cut = run(arguments);
    ASSERT_EQ(cut.code, 0) << budget << cut.err;
    const json report = json::parse(cut.out);
    EXPECT_EQ(report["mesh"]["after"]["components"], 4) << budget;  // cutting is never left undone
    EXPECT_EQ(report["maintain"]["units_per_stroke"].size(), report["strokes"]);
    hashes[budget] = report["hash"];
    if (budget != "--budget-us=1") {
      EXPECT_EQ(report["maintain"]["waiting_tets"], 0) << budget;
    }
  }
  EXPECT_EQ(hashes["--budget-us=3600000000"], hashes["--budget-us=3500000000"]);
  EXPECT_NE(hashes[""], hashes["--budget-us=1"]);
}

TEST(Cli, improves_a_mesh) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(4));
  const std::string raw = folder / "raw.vtu";
  ASSERT_EQ(run_plain_cut({cube, "--plane", "1,2,3,2.9", "--snap", "0", "-o", raw, "-q"}).code, 0);
  for (const std::string profile : {"incise", "paper"}) {
    const std::string out = folder / (profile + ".msh");
    const std::string figures = folder / (profile + ".json");
    const Outcome outcome = run({"improve", raw, "-o", out, "--profile", profile, "--report", figures});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("L/r mean"), std::string::npos) << outcome.out;
    const json report = json::parse(read(figures));
    EXPECT_EQ(report["validity"]["ok"], true);
    EXPECT_EQ(report["options"]["profile"], profile);
    EXPECT_EQ(report["mesh"]["after"]["components"], 2);
    EXPECT_EQ(run({"check", out}).code, 0);
  }
}

TEST(Cli, improves_within_a_budget_and_to_stdout) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(3));
  const Outcome outcome = run({"improve", cube, "--budget-us", "5", "--report", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["options"]["budget_us"], 5);
  const Outcome paper = run({"improve", cube, "--budget-us", "5", "--profile", "paper"});
  EXPECT_EQ(paper.code, 0);
  EXPECT_NE(paper.err.find("--budget-us has no effect"), std::string::npos) << paper.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"cube.mesh"}));
}

TEST(Cli, helps) {
  const Outcome help = run({"help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_EQ(help.out, run({"--help"}).out);
  EXPECT_NE(help.out.find("Exit codes"), std::string::npos);
  const Outcome cut = run({"help", "cut"});
  EXPECT_EQ(cut.code, 0);
  EXPECT_EQ(cut.out, run({"cut", "--help"}).out);
  EXPECT_NE(cut.out.find("--plane"), std::string::npos);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"-q", "help"}, {"help", "help"}}) {
    EXPECT_EQ(run(words).out, help.out);
  }
  EXPECT_EQ(run({"help", "cat"}).err, "incise: error: 'cat' is no command (did you mean cut?); see incise help\n");
}

TEST(Cli, quiet_says_nothing) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(2));
  const Outcome cut = run({"-q", "cut", cube, "--plane", "1,0,0,0.3", "--profile", "paper", "--snap", "0.1"});
  EXPECT_EQ(cut.code, 0);
  EXPECT_EQ(cut.out + cut.err, "");
}

TEST(Cli, info_has_the_keys_of_the_contract) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(5));
  const Outcome info = run({"info", cube, "--json"});
  ASSERT_EQ(info.code, 0) << info.err;
  const json report = json::parse(info.out);
  for (const char* key : {"format", "vertices", "tets", "regions", "bounds", "volume", "defects", "components"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  for (const char* key : {"inverted", "zero_volume", "unreferenced_vertices", "duplicate_vertices", "duplicate_tets",
                          "overshared_faces", "nonmanifold_edges", "singleton_vertices"}) {
    EXPECT_EQ(report["defects"].at(key), 0) << key;
  }
  EXPECT_EQ(report["vertices"], 216);
  EXPECT_EQ(report["tets"], 750);
  EXPECT_NE(run({"info", cube}).out.find("defects     none"), std::string::npos);
}

TEST(Cli, dirty_input_is_told_by_info_and_failed_by_check) {
  const Folder folder;
  const std::string dirty =
      folder.write("dirty.mesh",
                   "MeshVersionFormatted 2\nDimension 3\nVertices\n6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
                   "0 0 1 0\n0 0 -1 0\n5 5 5 0\nTetrahedra\n3\n1 2 3 4 1\n1 2 3 5 1\n4 3 2 1 1\nEnd\n");
  const Outcome info = run({"info", dirty, "--json"});
  EXPECT_EQ(info.code, 0) << info.err;
  const json defects = json::parse(info.out)["defects"];
  EXPECT_EQ(defects["unreferenced_vertices"], 1);
  EXPECT_EQ(defects["duplicate_tets"], 1);
  EXPECT_EQ(defects["inverted"], 1);
  EXPECT_EQ(run({"check", dirty}).code, 4);
  const Outcome cut = run({"cut", dirty, "--plane", "1,0,0,0.5", "-o", folder / "cut.msh"});
  EXPECT_EQ(cut.code, 0) << cut.err << cut.out;
  EXPECT_NE(cut.err.find("duplicate"), std::string::npos);
}

TEST(Cli, converts_to_every_format_and_keeps_numbers_and_labels) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(2));
  const std::string cut = folder / "cut.vtu";
  ASSERT_EQ(run({"cut", cube, "--plane", "1,1,1,1.3", "-o", cut, "-q"}).code, 0);
  for (const std::string name : {"a.msh", "a.vtk", "a.vtu", "a.veg", "a.inp", "a.node", "a.mesh", "a.msh.gz"}) {
    const Outcome there = run({"convert", cut, folder / name});
    ASSERT_EQ(there.code, 0) << name << there.err;
    const Outcome back = run({"convert", folder / name, folder / "back.veg"});
    ASSERT_EQ(back.code, 0) << name << back.err;
  }
  const auto first = incise::io::read_mesh(cut);
  for (const std::string name : {"a.msh", "a.vtk", "a.msh.gz"}) {
    const auto second = incise::io::read_mesh(folder / name);
    ASSERT_TRUE(first.ok() && second.ok());
    EXPECT_EQ(first->data.soup.points, second->data.soup.points) << name;
    EXPECT_EQ(first->data.soup.tets, second->data.soup.tets) << name;
    EXPECT_EQ(first->data.piece, second->data.piece) << name;
    EXPECT_EQ(first->data.triangle_stroke, second->data.triangle_stroke) << name;
    EXPECT_EQ(first->data.origin_vertex, second->data.origin_vertex) << name;
  }
}

/// How many triangles of each stroke a file has.
std::map<std::int32_t, std::size_t> walls_in(const std::string& path) {
  std::map<std::int32_t, std::size_t> walls;
  const auto file = incise::io::read_mesh(path);
  EXPECT_TRUE(file.ok());
  for (const std::int32_t stroke : file->data.triangle_stroke) ++walls[stroke];
  return walls;
}

TEST(Cli, a_second_run_goes_on_from_the_wound_of_the_first) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(5));
  const std::string log = folder / "second.jsonl";
  for (const std::string end : {".mesh", ".msh", ".vtk", ".vtu", ".msh.gz"}) {
    const std::string once = folder / ("once" + end), twice = folder / ("twice" + end);
    ASSERT_EQ(run({"cut", cube, "--plane", "1,0.1,0.2,0.6", "-o", once, "-q"}).code, 0) << end;
    const Outcome second = run({"cut", once, "--plane", "0.1,1,0.2,0.7", "-o", twice, "-q", "--record", log});
    ASSERT_EQ(second.code, 0) << end << second.err;
    const auto before = walls_in(once), after = walls_in(twice);
    ASSERT_EQ(before.size(), 1U) << end;
    ASSERT_EQ(after.size(), 2U) << end;
    EXPECT_GT(after.at(1), 0U);
    EXPECT_GT(after.at(2), 50U);
    EXPECT_EQ(json::parse(run({"check", twice, "--json"}).out)["components"], 4) << end;
    EXPECT_EQ(run({"replay", log, "--verify", "-q", "-o", folder / ("replayed" + end)}).code, 0) << end;
    EXPECT_EQ(read(folder / ("replayed" + end)), read(twice)) << end;
    const auto origins = incise::io::read_mesh(twice)->data.origin_vertex;
    EXPECT_EQ(*std::max_element(origins.begin(), origins.end()), 215) << end;  // of the cube's 216 vertices
  }
}

TEST(Cli, converted_cut_meshes_keep_their_wounds_and_foreign_labels_make_none) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(2));
  ASSERT_EQ(run({"cut", cube, "--plane", "1,1,1,1.3", "-o", folder / "cut.vtu", "-q"}).code, 0);
  std::string from = folder / "cut.vtu";
  for (const std::string name : {"a.mesh", "a.msh", "a.vtk", "a.vtu"}) {
    ASSERT_EQ(run({"convert", from, folder / name}).code, 0) << name;
    EXPECT_EQ(walls_in(folder / name), walls_in(from)) << name;
    from = folder / name;
  }
  std::string foreign = cube_mesh(2);
  foreign.insert(foreign.find("Tetrahedra"), "Triangles\n1\n1 2 4 6\n");
  from = folder.write("foreign.mesh", foreign);
  for (const std::string name : {"b.vtu", "b.msh", "b.vtk", "b.mesh"}) {
    ASSERT_EQ(run({"convert", from, folder / name}).code, 0) << name;
    from = folder / name;
    EXPECT_TRUE(incise::io::read_mesh(from)->data.has_foreign_labels) << name;
    ASSERT_EQ(run({"cut", from, "--plane", "1,0,0,0.3", "-o", folder / "cut.msh", "-q"}).code, 0);
    EXPECT_EQ(walls_in(folder / "cut.msh").count(6), 0U) << name;
  }
}

TEST(Cli, converts_a_mesh_to_its_boundary) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(2));
  for (const std::string name : {"a.obj", "a.stl", "a.ply", "a.off"}) {
    EXPECT_EQ(run({"convert", cube, folder / name}).code, 0) << name;
    EXPECT_EQ(run({"convert", folder / name, folder / "again.obj"}).code, 0) << name;
  }
}

TEST(Cli, helps_and_tells_its_version) {
  EXPECT_EQ(run({"--version"}).out.substr(0, 9), "incise 0.");
  for (const std::string command : {"info", "check", "cut", "improve", "replay", "convert"}) {
    const Outcome help = run({command, "-h"});
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("Examples:"), std::string::npos) << command;
  }
  for (const char* flag : {"--budget-us", "--profile", "--report", "incise improve "}) {
    EXPECT_NE(run({"improve", "--help"}).out.find(flag), std::string::npos) << flag;
  }
  EXPECT_EQ(run({"cut", "--help"}).out.find("always so"), std::string::npos);
  EXPECT_NE(run({"-h"}).out.find("Exit codes"), std::string::npos);
}

TEST(Cli, an_interrupt_leaves_no_partial_file) {
  const Folder folder;
  const std::string cube = folder.write("cube.mesh", cube_mesh(24));
  for (const double seconds : {0.02, 0.1, 0.2, 0.3, 0.4}) {
    const Outcome cut = run_interrupted({"cut", cube, "--plane", "1,2,3,2.9", "-o", folder / "cut.mesh"}, seconds);
    ASSERT_TRUE(cut.code == 130 || cut.code == 0) << cut.code;
    for (const std::string& name : folder.names()) EXPECT_TRUE(name == "cube.mesh" || name == "cut.mesh") << name;
    if (folder.names().size() == 2) {
      EXPECT_EQ(read(folder / "cut.mesh").substr(read(folder / "cut.mesh").size() - 4), "End\n");
    }
  }
}

TEST(Cli, an_interrupt_ends_what_waits_for_its_input) {
  const Folder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string command : {"convert", "improve"}) {
    std::vector<std::string> arguments = {command, pipe};
    if (command == "improve") arguments.emplace_back("-o");
    arguments.push_back(folder / "out.vtu");
    EXPECT_EQ(run_interrupted(arguments, 0.2).code, 130) << command;
  }
}

}  // namespace

}  // namespace cli_test
