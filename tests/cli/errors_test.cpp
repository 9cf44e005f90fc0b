// SPDX-License-Identifier: Apache-2.0
// What the command does when something is wrong: a code, a message that names the place, and no output file.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "incise/io/mesh_file.h"
#include "support/bodies.h"

namespace errors_test {
namespace {

using namespace incise;
using namespace incise_test;

const char* const kBladeHead = R"({"format":"incise-blade","version":1,"strokes":[)";

class CliErrors : public testing::Test {
 protected:
  /// Runs a cut that must fail with `code` and a message that contains `part`, and leave nothing behind.
  void expect_refused(std::vector<std::string> arguments, int code, const std::string& part) {
    const auto before = folder_.names();
    arguments.insert(arguments.end(), {"-o", folder_ / "out.vtu", "--report", folder_ / "out.json"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(folder_.names(), before);
  }
  void expect_blade_refused(const std::string& text, const std::string& part) {
    const std::string blade = folder_.write("blade.json", text);
    expect_refused({"cut", cube_, "--blade", blade}, 3, part);
  }

  Folder folder_;
  std::string cube_ = folder_.write("cube.mesh", cube_mesh(2));
};

TEST_F(CliErrors, usage) {
  expect_refused({"cut", cube_}, 2, "--blade");
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--blade", "b.json"}, 2, "either");
  for (const std::string plane : {"1,0,0", "1,0,0,0,0", "0,0,0,1", "1,0,0,x", "nan,0,0,1", "1,inf,0,0"}) {
    expect_refused({"cut", cube_, "--plane=" + plane}, 2, "plane");
  }
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--snap", "0.5"}, 2, "snap");
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--snap", "nan"}, 2, "snap");
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--snap=-0.1"}, 2, "snap");
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--profile", "best"}, 2, "profile");
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--profile", "removal", "--record", folder_ / "r.jsonl"}, 2,
                 "--record does not go with --profile removal");
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--threads", "0"}, 2, "threads");
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--threads", "257"}, 2, "threads");
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--unknown"}, 2, "not known here");
  for (const std::string budget : {"0", "-3", "1.5", "fast", "3600000001"}) {
    expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--budget-us=" + budget}, 2, "--budget-us");
    expect_refused({"improve", cube_, "--budget-us=" + budget}, 2, "--budget-us");
  }
  EXPECT_EQ(run({}).code, 2);
  EXPECT_EQ(run({"carve"}).code, 2);
  EXPECT_EQ(run({"info"}).code, 2);
  EXPECT_EQ(run({"improve"}).code, 2);
  EXPECT_EQ(run({"convert", cube_}).code, 2);
}

TEST_F(CliErrors, say_what_was_meant) {
  const Outcome carve = run({"cutt", cube_});
  EXPECT_EQ(carve.err, "incise: error: 'cutt' is no command (did you mean cut?); see incise help\n");
  const Outcome option = run({"cut", cube_, "--plan=1,0,0,0.5"});
  EXPECT_NE(option.err.find("(did you mean --plane?); see incise help cut"), std::string::npos) << option.err;
  EXPECT_EQ(option.err.rfind("incise: error: ", 0), 0U) << option.err;
  const Outcome named_like_one = run({"cut", "info", "--plan=1,0,0,0.5"});
  EXPECT_NE(named_like_one.err.find("see incise help cut"), std::string::npos) << named_like_one.err;
  EXPECT_NE(run({"--hlp"}).err.find("(did you mean --help?)"), std::string::npos);
  EXPECT_EQ(run({"cutt", "--help"}).err, carve.err);
  EXPECT_EQ(run({"zzzzzzzz"}).err, "incise: error: 'zzzzzzzz' is no command; see incise help\n");
}

TEST_F(CliErrors, are_short_lines_whatever_the_arguments) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", std::string(3000, 'x')},
        std::vector<std::string>{"cut", cube_, "--profile", std::string(3000, 'x')},
        std::vector<std::string>{std::string(3000, 'x')}, std::vector<std::string>{"info", "two\nlines\033[31m"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.err.rfind("incise: error: ", 0), 0U) << outcome.err;
    EXPECT_LE(outcome.err.size(), 500U);
    EXPECT_EQ(outcome.err.find_first_of("\n\033"), outcome.err.size() - 1) << outcome.err;
  }
}

TEST_F(CliErrors, a_file_that_may_not_grow_is_answered_like_a_full_disk) {
  const std::string large = folder_.write("large.mesh", cube_mesh(8));
  const auto before = folder_.names();
  const Outcome outcome = run_limited({"convert", large, folder_ / "out.vtu"}, 4096);
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("is the disk full?"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(CliErrors, pictures_have_names_of_their_own) {
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--picture=p.jpg"}, 2, "pictures are .png");
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--record=p.png", "--picture=p.png"}, 2, "name of its own");
  expect_refused({"cut", cube_, "--plane", "1,0,0,0.5", "--picture=no/folder/p.png"}, 1, "folder does not exist");
}

TEST_F(CliErrors, improve_has_no_flags_of_cutting) {
  for (const std::string flag : {"--threads=2", "--seed=1", "--snap=0.1", "--no-merge", "--plane=1,0,0,0.5"}) {
    expect_refused({"improve", cube_, flag}, 2, "not known here");
  }
  expect_refused({"improve", cube_, "--profile", "best"}, 2, "profile");
}

TEST_F(CliErrors, unknown_extensions) {
  const Outcome cut = run({"cut", cube_, "--plane", "1,0,0,0.5", "-o", folder_ / "out.xyz"});
  EXPECT_EQ(cut.code, 2);
  EXPECT_NE(cut.err.find(".vtu"), std::string::npos);
  const Outcome improve = run({"improve", cube_, "-o", folder_ / "out.stl"});
  EXPECT_EQ(improve.code, 2);
  EXPECT_NE(improve.err.find("out.stl: unknown extension"), std::string::npos) << improve.err;
  EXPECT_EQ(run({"convert", cube_, folder_ / "out"}).code, 2);
}

TEST_F(CliErrors, meshes_that_cannot_be_read) {
  const std::string whole = cube_mesh(1);
  expect_refused({"cut", folder_ / "none.mesh", "--plane", "1,0,0,0.5"}, 3, "none.mesh");
  expect_refused({"cut", folder_ / "", "--plane", "1,0,0,0.5"}, 3, "folder");
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"empty.mesh", ""},
           {"words.mesh", "this is no mesh\n"},
           {"half.mesh", whole.substr(0, whole.size() / 2)},
           {"nan.mesh",
            "MeshVersionFormatted 2\nDimension 3\nVertices\n4\nnan 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
            "Tetrahedra\n1\n1 2 3 4 0\nEnd\n"},
           {"inf.mesh",
            "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n1e999 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
            "Tetrahedra\n1\n1 2 3 4 0\nEnd\n"},
           {"range.mesh",
            "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
            "Tetrahedra\n1\n1 2 3 9 0\nEnd\n"},
           {"lie.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n1000000000000\n0 0 0 0\n"},
           {"twice.mesh",
            "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
            "Tetrahedra\n1\n1 2 3 3 0\nEnd\n"}}) {
    const std::string path = folder_.write(name, text);
    expect_refused({"cut", path, "--plane", "1,0,0,0.5"}, 3, name);
    expect_refused({"improve", path}, 3, name);
    const int info = run({"info", path}).code;
    EXPECT_EQ(info, name == "twice.mesh" ? 0 : 3) << name;  // a tet with a repeated corner is dirty, but readable
    EXPECT_EQ(run({"check", path}).code, 3) << name;
  }
}

TEST_F(CliErrors, meshes_truncated_anywhere) {
  const std::string whole = cube_mesh(1);
  for (std::size_t size = 0; size + 8 < whole.size(); size += 97) {
    const std::string path = folder_.write("part.mesh", whole.substr(0, size));
    const Outcome outcome = run({"convert", path, folder_ / "out.vtu"});
    EXPECT_EQ(outcome.code, 3) << size << outcome.err;
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"cube.mesh", "part.mesh"}));
  }
}

TEST_F(CliErrors, blades_that_cannot_be_read) {
  expect_refused({"cut", cube_, "--blade", folder_ / "none.json"}, 3, "none.json: no such file");
  expect_refused({"cut", cube_, "--blade", folder_ / ""}, 3, "is a folder");
  const std::string head = kBladeHead;
  expect_blade_refused("", "blade.json:1: the file is empty");
  expect_blade_refused(head, "blade.json:1:");
  expect_blade_refused("{\"format\":\"incise-blade\",\n\"version\":1,\"strokes\":[{\"edges\":[],\n\"speed\":3}]}",
                       "unknown key \"speed\"");
  expect_blade_refused(head + R"({"edges":[{"t":0,"points":[[0,0,0]]}]}]})", "needs at least 2");
  expect_blade_refused(head + R"({"edges":[{"t":1,"points":[[0,0,0],[1,0,0]]},{"t":0,"points":[[0,0,1],[1,0,1]]}]}]})",
                       "strokes[0].edges[1].t must be later");
  expect_blade_refused(head + R"({"edges":[{"t":0,"points":[[0,0,NaN],[1,0,0]]}]}]})", "not valid JSON");
  expect_blade_refused(
      head + R"({"edge":[[0,0,0],[1,0,0]],"poses":[{"t":0,"position":[0,1e999,0],"orientation":[1,0,0,0]}]}]})",
      "blade.json:1:");
  expect_blade_refused(
      head + R"({"edge":[[0,0,0],[1,0,0]],"poses":[{"t":0,"position":[0,0,0],"orientation":[2,0,0,0]}]}]})",
      "unit quaternion");
}

TEST_F(CliErrors, outputs_that_cannot_be_written) {
  const Outcome cut = run({"cut", cube_, "--plane", "1,0,0,0.5", "-o", folder_ / "no/out.vtu"});
  EXPECT_EQ(cut.code, 1);
  EXPECT_NE(cut.err.find("folder does not exist"), std::string::npos) << cut.err;
  EXPECT_EQ(run({"cut", cube_, "--plane", "1,0,0,0.5", "--report", folder_ / "no/r.json"}).code, 1);
  EXPECT_EQ(run({"improve", cube_, "-o", folder_ / "no/out.vtu"}).code, 1);
  EXPECT_EQ(run({"improve", cube_, "--report", folder_ / "no/r.json"}).code, 1);
  EXPECT_EQ(run({"convert", cube_, folder_ / "no/out.vtu"}).code, 1);
}

TEST_F(CliErrors, outputs_that_would_take_the_place_of_other_files) {
  const std::string blade = folder_.write("blade.json", "{}"), out = folder_ / "same.vtu", page = folder_ / "same.txt";
  const std::vector<std::vector<std::string>> commands = {
      {"cut", cube_, "--plane", "1,0,0,0.5", "--report", cube_},
      {"cut", cube_, "--blade", blade, "--report", blade},
      {"cut", cube_, "--plane", "1,0,0,0.5", "-o", out, "--report", out},
      {"cut", cube_, "--plane", "1,0,0,0.5", "--report", page, "--record", page},
      {"improve", cube_, "--report", cube_},
      {"improve", cube_, "-o", folder_ / "a.node", "--report", folder_ / "a.ele"},
      {"cut", folder_ / "b.node", "--plane", "1,0,0,0.5", "--report", folder_ / "b.ele"},
  };
  const auto before = folder_.names();
  for (const auto& command : commands) {
    const Outcome refused = run(command);
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("is another file of this command"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(folder_.names(), before);
  EXPECT_EQ(read(cube_), cube_mesh(2));
  EXPECT_EQ(read(blade), "{}");
}

TEST_F(CliErrors, a_name_that_is_no_text_is_still_told_as_json) {
  const std::string mesh = folder_.write("x\xff.mesh", cube_mesh(1));
  for (const char* command : {"info", "check"}) {
    const Outcome outcome = run({command, "--json", mesh});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(nlohmann::json::parse(outcome.out).dump().find("x\xef\xbf\xbd.mesh"), std::string::npos) << outcome.out;
  }
}

TEST_F(CliErrors, a_flat_mesh_is_not_called_damaged) {
  const std::string mesh = folder_.write("flat.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices\n0\nEnd\n");
  const Outcome outcome = run({"info", mesh});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("the mesh is flat, of dimension 2; Incise cuts volumes"), std::string::npos)
      << outcome.err;
}

TEST_F(CliErrors, outputs_without_a_name) {
  const std::vector<std::vector<std::string>> commands = {
      {"cut", cube_, "--plane", "1,0,0,0.5", "-o", ""},
      {"cut", cube_, "--plane", "1,0,0,0.5", "--report", ""},
      {"cut", cube_, "--plane", "1,0,0,0.5", "--record", ""},
      {"improve", cube_, "-o", ""},
      {"convert", cube_, ""},
  };
  for (const auto& command : commands) {
    const Outcome refused = run(command);
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("the name is empty; give one"), std::string::npos) << refused.err;
  }
}

TEST_F(CliErrors, meshes_whose_lengths_cannot_be_computed_with) {
  for (const std::string unit : {"1e150", "1e-150"}) {
    const std::string path = folder_.write(
        "huge" + unit + ".mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n" + unit + " 0 0 0\n0 " +
                                     unit + " 0 0\n0 0 " + unit + " 0\nTetrahedra\n1\n1 2 3 4 0\nEnd\n");
    expect_refused({"cut", path, "--plane", "1,0,0,0.5"}, 3, "huge" + unit + ".mesh: the mesh");
    expect_refused({"improve", path}, 3, "rescale");
    EXPECT_EQ(run({"info", path}).code, 0);
    EXPECT_EQ(run({"check", path}).code, 3);
  }
}

TEST_F(CliErrors, blades_out_of_reach) {
  expect_blade_refused(std::string(kBladeHead) +
                           R"({"name":"near","edges":[{"t":0,"points":[[0.4,-1,-1],[0.4,2,-1]]},
                              {"t":1,"points":[[0.4,-1,2],[0.4,2,2]]}]},{"name":"slip","edges":[
                              {"t":0,"points":[[0.5,-1,-1],[0.5,2,-1]]},{"t":1,"points":[[0.5,-1,2],[0.5,2e9,2]]}]}]})",
                       "stroke 1 \"slip\": point 1 at time 1 lies 2e+09 times");
}

std::string ball_mesh() {
  io::MeshData data;
  data.soup = test::ball(2);
  return io::write_mesh_bytes(".mesh", data).value();
}

/// A coarse ball, thin slices of which the profile paper smoothes until the volume has drifted too far.
TEST(Cli, a_cut_that_breaks_the_contract_is_taken_back_and_what_was_valid_is_written) {
  Folder folder;
  const std::string body = folder.write("ball.mesh", ball_mesh());
  std::string strokes;
  for (int i = 0; i < 40; ++i) {
    const double y = -0.8 + 0.04 * i;
    const auto edge = [&](double at, double z) {
      return "[[-2," + std::to_string(at) + "," + std::to_string(z) + "],[2," + std::to_string(at + 0.3) + "," +
             std::to_string(z) + "]]";
    };
    strokes += std::string(i > 0 ? "," : "") + R"({"name":"slice )" + std::to_string(i) +
               R"(","edges":[{"t":0,"points":)" + edge(y, -2) + R"(},{"t":1,"points":)" + edge(y - 0.8, 2) + "}]}";
  }
  const std::string blade = folder.write("blade.json", kBladeHead + strokes + "]}");
  const std::vector<std::string> arguments = {"cut",       body,
                                              "--blade",   blade,
                                              "--profile", "paper",
                                              "-o",        folder / "out.mesh",
                                              "--report",  folder / "out.json",
                                              "--record",  folder / "out.jsonl"};
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("\" broke the validity contract and was taken back"), std::string::npos) << outcome.err;
  EXPECT_EQ(run({"check", folder / "out.mesh"}).code, 0);
  const auto report = nlohmann::json::parse(read(folder / "out.json"));
  EXPECT_EQ(report["validity"]["ok"], false);
  const auto broken = report["validity"]["broken_stroke"];
  EXPECT_NE(outcome.err.find("stroke " + broken["index"].dump() + " " + broken["name"].dump()), std::string::npos);
  const Outcome replay = run({"replay", folder / "out.jsonl", "--verify"});
  EXPECT_EQ(replay.code, 0);
  EXPECT_NE(replay.out.find(broken["kept_hash"].get<std::string>()), std::string::npos) << replay.out;
}

}  // namespace

}  // namespace errors_test
