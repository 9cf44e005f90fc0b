// SPDX-License-Identifier: Apache-2.0
// `incise mesh`: from a label image to a mesh that can be cut.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "incise/io/mesh_file.h"

namespace mesh_test {
namespace {

using namespace incise_test;
using nlohmann::json;

/// A MetaImage of 24³ voxels of 1 mm: a ball of label 1 with a ball of label 2 in it.
std::string balls() {
  std::string bytes =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nTransformMatrix = 1 0 0 0 1 0 "
      "0 0 "
      "1\nOffset = 5 -6 7\nElementSpacing = 1 1 1\nDimSize = 24 24 24\nElementType = MET_UCHAR\nElementDataFile = "
      "LOCAL\n";
  for (int v = 0; v < 24 * 24 * 24; ++v) {
    const double x = v % 24 - 11.6, y = v / 24 % 24 - 11.7, z = v / 576 - 11.4;
    const double r2 = x * x + y * y + z * z;
    bytes += r2 < 16 ? '\2' : (r2 < 81 ? '\1' : '\0');
  }
  return bytes;
}

TEST(CliMesh, makes_a_mesh_with_a_region_for_each_label) {
  const Folder folder;
  const std::string image = folder.write("balls.mha", balls()), out = folder / "balls.mesh";
  const std::string names = folder.write("names.txt", "# label name\n1 = liver\n2 255 0 0 1 1 1 \"a tumour\"\n");
  const Outcome mesh = run({"mesh", image, "-o", out, "--size", "2", "--names", names, "--report", "-"});
  ASSERT_EQ(mesh.code, 0) << mesh.err;
  const json report = json::parse(mesh.out);
  EXPECT_EQ(report["coordinates"], "RAS, mm");
  EXPECT_EQ(report["validity"]["ok"], true);
  EXPECT_GE(report["quality"]["dihedral_min_deg"], 8.0);
  ASSERT_EQ(report["labels"].size(), 2U);
  EXPECT_EQ(report["labels"][0]["name"], "liver");
  EXPECT_EQ(report["labels"][1]["name"], "a tumour");
  EXPECT_NEAR(report["labels"][0]["relative_error"].get<double>(), 0, 0.02);
  EXPECT_NEAR(report["mesh"]["bounds"][0][0].get<double>(), -5 - 11.6 - 9, 0.6);  // MetaImage is LPS
  const Outcome check = run({"check", out, "--json"});
  EXPECT_EQ(check.code, 0) << check.out;
  const auto file = incise::io::read_mesh(out);
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->file_tets, report["mesh"]["tets"]);
}

TEST(CliMesh, says_what_it_wrote_or_writes_to_stdout) {
  const Folder folder;
  const std::string image = folder.write("balls.mha", balls()), out = folder / "a.msh", report = folder / "a.json";
  const Outcome file = run({"mesh", image, "-o", out, "--size", "3", "--report", report, "--json"});
  ASSERT_EQ(file.code, 0) << file.err;
  EXPECT_NE(file.err.find("wrote " + out + " ("), std::string::npos) << file.err;
  EXPECT_NE(file.err.find("wrote " + report + " (report)"), std::string::npos) << file.err;
  EXPECT_EQ(json::parse(file.out)["format"], "incise-mesh-report");
  const Outcome piped = run({"mesh", image, "-o", "-", "--format", "msh41", "--size", "3"});
  ASSERT_EQ(piped.code, 0) << piped.err;
  EXPECT_EQ(piped.out.rfind("$MeshFormat\n4.1 0 8\n", 0), 0U);
  EXPECT_EQ(run({"mesh", image, "-o", "-", "--format", "msh41", "--size", "3", "--json"}).code, 2);
  EXPECT_EQ(run({"mesh", image, "-o", out, "--format", "vtu", "--size", "3"}).code, 2);
}

TEST(CliMesh, meshes_some_labels_and_merges_others) {
  const Folder folder;
  const std::string image = folder.write("balls.mha", balls()), out = folder / "a.vtu";
  const Outcome one = run({"mesh", image, "-o", out, "--size", "2", "--labels", "2", "--report", "-"});
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(json::parse(one.out)["labels"].size(), 1U);
  const Outcome merged = run({"mesh", image, "-o", out, "--size", "3", "--merge", "2=1,1=8", "--report", "-"});
  ASSERT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(json::parse(merged.out)["labels"][0]["label"], 8);
  EXPECT_EQ(json::parse(merged.out)["labels"].size(), 1U);
}

TEST(CliMesh, the_mesh_can_be_cut) {
  const Folder folder;
  const std::string image = folder.write("balls.mha", balls()), out = folder / "a.mesh";
  ASSERT_EQ(run({"mesh", image, "-o", out, "--size", "2.5"}).code, 0);
  const Outcome cut = run({"cut", out, "--plane=1,0.2,0.1,-14", "--report", "-"});
  ASSERT_EQ(cut.code, 0) << cut.err;
  EXPECT_EQ(json::parse(cut.out)["mesh"]["after"]["components"], 2);
}

TEST(CliMesh, grows_layers_whose_names_files_and_reports_have) {
  const Folder folder;
  const std::string image = folder.write("balls.mha", balls());
  const std::string names = folder.write("names.txt", "1 muscle\n");
  for (const std::string name : {"a.msh", "a.vtu", "a.mesh"}) {
    const Outcome mesh = run({"mesh", image, "-o", folder / name, "--size", "4", "--layers", "skin=2.5", "--layers-in",
                              "1", "--names", names, "--report", "-"});
    ASSERT_EQ(mesh.code, 0) << mesh.err;
    const json report = json::parse(mesh.out);
    EXPECT_EQ(report["layers"], json::parse(R"([{"label": 3, "name": "skin", "thickness": 2.5}])"));
    EXPECT_EQ(report["labels"][2]["name"], "skin");
    const auto file = incise::io::read_mesh(folder / name);
    ASSERT_TRUE(file.ok());
    EXPECT_EQ(file->data.region_names, (incise::io::RegionNames{{1, "muscle"}, {3, "skin"}})) << name;
  }
  EXPECT_EQ(run({"convert", folder / "a.msh", folder / "b.vtu"}).code, 0);
  EXPECT_EQ(incise::io::read_mesh(folder / "b.vtu")->data.region_names.at(3), "skin");
}

TEST(CliMesh, a_cut_stops_at_a_region_by_its_name) {
  const Folder folder;
  const std::string image = folder.write("balls.mha", balls());
  const std::string names = folder.write("names.txt", "2 core\n"), mesh = folder / "a.msh", cut = folder / "b.msh";
  ASSERT_EQ(run({"mesh", image, "-o", mesh, "--size", "2.5", "--names", names}).code, 0);
  const std::string blade =
      folder.write("blade.json", R"({"format": "incise-blade", "version": 1, "strokes": [{"edges": [
        {"t": 0, "points": [[-16.5, 8, 40], [-16.5, 8, 31]]}, {"t": 1, "points": [[-16.5, 8, 31], [-16.5, 8, 17]]},
        {"t": 2, "points": [[-16.5, -6, 31], [-16.5, -6, 17]]}]}]})");
  const Outcome held = run({"cut", mesh, "--blade", blade, "--stop-at", "Core", "-o", cut});
  ASSERT_EQ(held.code, 0) << held.err;
  const auto file = incise::io::read_mesh(cut);
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->data.region_names.at(2), "core");
  EXPECT_GT(file->data.triangles.size(), 20U);
  const Outcome missing = run({"cut", mesh, "--blade", blade, "--stop-at", "liver", "-o", cut});
  EXPECT_EQ(missing.code, 3);
  EXPECT_NE(missing.err.find("called \"liver\"; there are core"), std::string::npos) << missing.err;
  const Outcome absent = run({"cut", mesh, "--blade", blade, "--stop-at", "77", "-o", folder / "absent.msh"});
  EXPECT_EQ(absent.code, 3);
  EXPECT_NE(absent.err.find("stop_at: no tet of the model is in region 77; there are regions 1, 2"), std::string::npos)
      << absent.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "absent.msh"));
  // The blade file may say so itself: the same cut, by name or number.
  const std::string text = read(blade);
  for (const char* stop : {R"("Core")", "2", R"(2,"core")"}) {
    const std::string stops = folder.write("stops.json", std::string(R"({"format": "incise-blade", "version": 1,
      "strokes": [{"stop_at": [)") + stop + "]," + text.substr(text.find("\"edges\"")));
    ASSERT_EQ(run({"cut", mesh, "--blade", stops, "-o", folder / "c.msh"}).code, 0) << stop;
    EXPECT_EQ(read(folder / "c.msh"), read(cut)) << stop;
  }
  const std::string bad = folder.write("bad.json", std::string(R"({"format": "incise-blade", "version": 1,
      "strokes": [{"name": "deep", "stop_at": ["liver"],)") +
                                                       text.substr(text.find("\"edges\"")));
  const Outcome unknown = run({"cut", mesh, "--blade", bad, "-o", cut});
  EXPECT_EQ(unknown.code, 3);
  EXPECT_NE(unknown.err.find("bad.json: stroke 0 (deep): stop_at: no region"), std::string::npos) << unknown.err;
}

TEST(CliMesh, tells_of_labels_that_did_not_come_out_as_they_are) {
  const Folder folder;
  std::string bytes = balls();
  const std::size_t voxels = bytes.size() - 24 * 24 * 24;
  for (std::size_t i = 0; i < 24; ++i) bytes[voxels + (2 * 24 + 2) * 24 + i] = '\3';  // a line of voxels
  const std::string image = folder.write("line.mha", bytes), out = folder / "line.mesh";
  const std::string report = folder / "line.json";
  const Outcome made = run({"mesh", image, "-o", out, "--size", "1", "--report", report});
  ASSERT_EQ(made.code, 4) << made.err;
  EXPECT_NE(made.err.find("error: " + image + ": less than half came out of label 3; "), std::string::npos) << made.err;
  const json figures = json::parse(read(report));
  EXPECT_EQ(figures["lost_labels"], json::parse("[3]"));
  EXPECT_EQ(figures["labels"][2]["is_lost"], true);
  EXPECT_EQ(figures["labels"][0]["is_lost"], false);
  EXPECT_TRUE(incise::io::read_mesh(out).ok());
  for (const char* allowed : {"3", "all", "1,3"}) {
    EXPECT_EQ(run({"mesh", image, "-o", out, "--size", "1", "--may-lose", allowed}).code, 0) << allowed;
  }
  EXPECT_EQ(run({"mesh", image, "-o", out, "--size", "1", "--may-lose", "1"}).code, 4);
  EXPECT_NE(made.err.find("label 3 is too small or too thin to be there"), std::string::npos) << made.err;
  EXPECT_EQ(made.err.find("label 1"), std::string::npos) << made.err;
}

TEST(CliMesh, makes_a_mesh_of_a_surface) {
  const Folder folder;
  const std::string cube = folder.write("cube.obj",
                                        "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 0 0 9\nv 9 0 9\nv 9 9 9\nv 0 9 9\n"
                                        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const Outcome mesh = run({"mesh", cube, "-o", folder / "cube.mesh", "--size", "2", "--report", "-"});
  ASSERT_EQ(mesh.code, 0) << mesh.err;
  const json report = json::parse(mesh.out);
  EXPECT_EQ(report["coordinates"], "of the surface");
  EXPECT_NEAR(report["labels"][0]["volume_mm3"].get<double>() / 729, 1, 0.05);
  EXPECT_EQ(run({"mesh", cube, "-o", folder / "b.mesh", "--size", "200"}).code, 3);
}

TEST(CliMesh, says_what_is_wrong_and_writes_nothing) {
  const Folder folder;
  const std::string image = folder.write("balls.mha", balls()), out = folder / "a.mesh";
  const auto expect = [&](int code, const std::string& part, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"mesh", image, "-o", out, "--size", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome mesh = run(arguments);
    EXPECT_EQ(mesh.code, code) << mesh.err;
    EXPECT_NE(mesh.err.find(part), std::string::npos) << mesh.err;
  };
  expect(3, "has no label 5; there are 1 2", {"--labels", "1,5"});
  expect(3, "has no label 9", {"--merge", "9=1"});
  expect(2, "two labels are needed", {"--merge", "9"});
  expect(2, "smoothing must lie in", {"--smooth", "0.1"});
  expect(2, "0 to 4 times", {"--halvings", "9"});
  expect(2, "a name and a thickness in mm are needed", {"--layers", "skin"});
  expect(2, "layer skin of 0.5 mm is thinner than 1.2 times the finest tets", {"--layers", "skin=0.5"});
  expect(2, "give them by --layers", {"--layers-in", "1"});
  expect(3, "has no label 5", {"--layers", "skin=2", "--layers-in", "5"});
  expect(2, "there is a layer of this name already", {"--layers", "skin=3,Skin=2"});
  expect(2, "'' is no label", {"--labels", ""});
  expect(2, "'1x' is no label", {"--labels", "1,1x"});
  expect(2, "'' is no label", {"--layers", "skin=2", "--layers-in", ""});
  expect(2, "two files of this command", {"--report", out});
  expect(3, "names.txt:1: a label and its name are needed", {"--names", folder.write("names.txt", "liver 1\n")});
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"balls.mha", "names.txt"}));
  const auto expect_size = [&](const std::string& size, int code, const std::string& part) {
    const Outcome mesh = run({"mesh", image, "-o", out, "--size", size});
    EXPECT_EQ(mesh.code, code) << mesh.err;
    EXPECT_NE(mesh.err.find(part), std::string::npos) << mesh.err;
  };
  expect_size("0", 2, "larger one");
  expect_size("1e300", 3, image + ": no label is thick enough: of tets of 1e+300 mm");
  expect_size("0.1", 3, image + ": tets of size 0.1 mm are smaller than half a voxel");
  EXPECT_EQ(run({"mesh", image, "-o", folder / "a.xyz", "--size", "2"}).code, 2);
  const std::string cut = folder.write("cut.nii.gz", std::string("\x1f\x8b\x08\0\0\0\0\0\0\3abc", 13));
  EXPECT_NE(run({"mesh", cut, "-o", out, "--size", "2"}).err.find(cut + ": "), std::string::npos);
  EXPECT_EQ(run({"mesh", folder.write("a.nii", "none"), "-o", out, "--size", "2"}).code, 3);
}

}  // namespace

}  // namespace mesh_test
