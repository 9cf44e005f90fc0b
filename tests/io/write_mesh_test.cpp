// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "incise/io/mesh_file.h"
#include "io/fixtures.h"

namespace incise::write_mesh_test {
namespace {

namespace fs = std::filesystem;

// Everything a cut mesh can carry, with numbers that are hard to print.
io::MeshData full_mesh() {
  io::MeshData data = test::two_tets();
  std::mt19937_64 random(7);
  for (Vec3& p : data.soup.points) {
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t bits = (random() & 0x800FFFFFFFFFFFFFULL) | ((900 + random() % 200) << 52U);
      std::memcpy(&p[k], &bits, sizeof bits);
    }
  }
  data.soup.points[0] = {-0.0, 4.9e-324, 1.7976931348623157e308};
  data.soup.regions = {3, -2};
  data.piece = {1, 2};
  data.triangles = {{1, 2, 3}, {1, 3, 2}, {0, 1, 2}};
  data.triangle_stroke = {1, 2, 0};
  data.origin_vertex = {0, 1, 2, -1, 1};
  data.cut_front = {0, 0, 1, 0, 1};
  data.region_names = {{-2, "around it"}, {3, "left kidney, \u00e4"}};
  return data;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

Result<io::MeshFile> round_trip(const io::MeshData& data, const std::string& extension) {
  const std::string process = std::to_string(::getpid());  // tests run beside each other
  const fs::path folder = fs::path(testing::TempDir()) / ("incise_round_trip" + extension + "." + process);
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path path = folder / ("mesh" + extension);
  const Status written = io::write_mesh(path, data);
  EXPECT_TRUE(written.ok()) << written.error().message;
  const bool pair = extension.find(".node") == 0 || extension.find(".ele") == 0;
  const auto files = std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  EXPECT_EQ(files, pair ? 2 : 1) << "temporary files were left behind";
  auto back = io::read_mesh(path);
  fs::remove_all(folder);
  return back;
}

class WriteMesh : public testing::TestWithParam<const char*> {};

TEST_P(WriteMesh, reads_back_bit_for_bit) {
  const std::string extension = GetParam();
  const std::string kind = extension.substr(0, extension.find('.', 1));
  const io::MeshData data = full_mesh();
  const auto back = round_trip(data, extension);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->gzipped, kind != extension);
  EXPECT_TRUE(same_bits(back->data.soup.points, data.soup.points));
  EXPECT_EQ(back->data.soup.tets, data.soup.tets);
  EXPECT_EQ(back->data.soup.regions, data.soup.regions);
  const bool faces = kind == ".mesh" || kind == ".msh" || kind == ".msh2" || kind == ".vtk" || kind == ".vtu";
  if (faces) {
    EXPECT_EQ(back->data.triangles, data.triangles);
  }
  if (faces) {
    EXPECT_EQ(back->data.triangle_stroke, data.triangle_stroke);
  }
  if (kind != ".mesh") {
    EXPECT_EQ(back->data.piece, data.piece);
  }
  if (kind != ".veg" && kind != ".inp") {
    EXPECT_EQ(back->data.origin_vertex, data.origin_vertex);
  }
  if (faces) {
    EXPECT_EQ(back->data.cut_front, data.cut_front);
    EXPECT_FALSE(back->data.has_foreign_labels);
  }
  io::RegionNames names;  // Gmsh has no groups of negative numbers
  if (kind == ".mesh" || kind == ".vtu") names = data.region_names;
  if (kind == ".msh" || kind == ".msh2") names = {{3, data.region_names.at(3)}};
  EXPECT_EQ(back->data.region_names, names);
}

TEST_P(WriteMesh, names_that_would_break_the_file_are_mended) {
  io::MeshData data = test::two_tets();
  data.soup.regions = {3, 5};
  data.region_names = {{3, " a \"b\"\nc "}, {5, "\t"}, {9, std::string(300, 'x')}};
  const auto back = round_trip(data, GetParam());
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->data.soup.regions, data.soup.regions);
  if (back->data.region_names.empty()) return;
  EXPECT_EQ(back->data.region_names.at(3), "a 'b' c");
  EXPECT_EQ(back->data.region_names.count(5), 0U);
}

TEST_P(WriteMesh, leaves_out_what_is_not_given) {
  io::MeshData data = test::two_tets();
  data.soup.regions.clear();
  const auto back = round_trip(data, GetParam());
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_TRUE(same_bits(back->data.soup.points, data.soup.points));
  EXPECT_EQ(back->data.soup.tets, data.soup.tets);
  EXPECT_TRUE(back->data.soup.regions.empty());
  EXPECT_TRUE(back->data.triangles.empty());
  EXPECT_TRUE(back->data.piece.empty());
  EXPECT_TRUE(back->data.origin_vertex.empty());
  EXPECT_TRUE(back->data.cut_front.empty());
  EXPECT_FALSE(back->data.has_foreign_labels);
}

TEST_P(WriteMesh, foreign_labels_of_triangles_never_become_strokes) {
  const std::string extension = GetParam();
  const std::string kind = extension.substr(0, extension.find('.', 1));
  if (kind != ".mesh" && kind != ".msh" && kind != ".msh2" && kind != ".vtk" && kind != ".vtu") return;
  io::MeshData data = full_mesh();
  data.has_foreign_labels = true;
  for (int i = 0; i < 2; ++i) {
    const auto back = round_trip(data, extension);
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_TRUE(back->data.has_foreign_labels);
    EXPECT_EQ(back->data.triangle_stroke, full_mesh().triangle_stroke);
    data = back->data;
  }
}

TEST_P(WriteMesh, the_same_mesh_gives_the_same_bytes) {
  std::string extension = GetParam();
  extension = extension.substr(0, extension.find('.', 1));
  const auto once = io::write_mesh_bytes(extension, full_mesh());
  const auto twice = io::write_mesh_bytes(extension, full_mesh());
  ASSERT_TRUE(once.ok());
  EXPECT_EQ(*once, *twice);
}

INSTANTIATE_TEST_SUITE_P(Formats, WriteMesh,
                         testing::Values(".mesh", ".msh", ".msh2", ".vtk", ".vtu", ".node", ".ele", ".veg", ".inp",
                                         ".mesh.gz", ".msh.gz", ".vtk.gz", ".vtu.gz", ".node.gz", ".ele.gz", ".veg.gz",
                                         ".inp.gz"));

TEST(WriteMsh, groups_by_region_and_keeps_the_order) {
  io::MeshData data = test::two_tets();
  const auto tets = data.soup.tets;
  data.soup.tets = {tets[0], tets[1], tets[0], tets[1]};
  data.soup.regions = {5, 2, 5, 0};
  data.piece = {1, 2, 3, 4};
  const auto bytes = io::write_mesh_bytes(".msh", data);
  ASSERT_TRUE(bytes.ok());
  EXPECT_NE(bytes->find("$MeshFormat\n4.1 0 8\n"), std::string::npos);
  EXPECT_NE(bytes->find("3 3 4 2\n3 "), std::string::npos) << "the two tets of region 5 are one block";
  const auto back = io::read_mesh_bytes(*bytes);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->data.soup.tets, data.soup.tets);
  EXPECT_EQ(back->data.soup.regions, data.soup.regions);
  EXPECT_EQ(back->data.piece, data.piece);
}

TEST(WriteMsh, version_2_is_there_for_programs_that_read_no_other) {
  const auto bytes = io::write_mesh_bytes(".msh2", test::two_tets());
  ASSERT_TRUE(bytes.ok());
  EXPECT_EQ(bytes->find("$MeshFormat\n2.2 0 8\n"), 0U);
}

class WriteMsh : public testing::TestWithParam<const char*> {};

TEST_P(WriteMsh, reads_back_bit_for_bit_in_the_same_order) {
  const io::WriteOptions options = *io::write_options_named(GetParam());
  io::MeshData data = full_mesh();
  data.soup.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}, {0, 1, 2, 4}, {0, 1, 3, 4}};  // regions take turns
  data.soup.regions = {3, -2, 3, 0};
  data.piece = {1, 2, 1, 2};
  for (const bool is_foreign : {false, true}) {
    data.has_foreign_labels = is_foreign;
    const auto bytes = io::write_mesh_bytes(options.extension, data, options.msh);
    ASSERT_TRUE(bytes.ok());
    const auto back = io::read_mesh_bytes(*bytes);
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_TRUE(same_bits(back->data.soup.points, data.soup.points));
    EXPECT_EQ(back->data.soup.tets, data.soup.tets);
    EXPECT_EQ(back->data.soup.regions, data.soup.regions);
    EXPECT_EQ(back->data.piece, data.piece);
    EXPECT_EQ(back->data.triangles, data.triangles);
    EXPECT_EQ(back->data.triangle_stroke, data.triangle_stroke);
    EXPECT_EQ(back->data.has_foreign_labels, is_foreign);
    EXPECT_EQ(back->data.origin_vertex, data.origin_vertex);
    EXPECT_EQ(back->data.cut_front, data.cut_front);
    EXPECT_TRUE(back->notes.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, WriteMsh, testing::Values("msh", "msh41", "msh41-binary", "msh22"));

TEST(WriteMsh, has_a_physical_group_for_each_region_and_each_stroke) {
  io::MeshData data = full_mesh();
  data.soup.regions = {3, 7};
  data.region_names = {{7, "liver"}};
  const std::string bytes = *io::write_mesh_bytes(".msh", data);
  for (const char* part : {"4.1 0 8\n", "$PhysicalNames\n4\n2 1 \"stroke_1\"\n2 2 \"stroke_2\"\n3 3 \"region_3\"\n",
                           "3 7 \"liver\"\n", "$Entities\n0 0 3 2\n", " 1 7 0\n"}) {
    EXPECT_NE(bytes.find(part), std::string::npos) << part;
  }
}

TEST(WriteMsh, has_a_physical_group_everywhere_or_nowhere) {
  io::MeshData data = full_mesh();
  data.soup.regions = {0, 0};
  const std::string groups = *io::write_mesh_bytes(".msh", data);
  EXPECT_NE(groups.find(" 1 0 0\n$EndEntities"), std::string::npos) << "beside strokes, region 0 is a group, too";
  data.triangles.clear();
  data.triangle_stroke.clear();
  const std::string none = *io::write_mesh_bytes(".msh", data);
  EXPECT_NE(none.find(" 0 0\n$EndEntities"), std::string::npos);
  EXPECT_EQ(none.find(" 1 0 0\n$EndEntities"), std::string::npos);
}

TEST(WriteOptions, are_named) {
  EXPECT_EQ(io::write_options_named("msh")->msh, io::MshVariant::k41);
  EXPECT_EQ(io::write_options_named("msh22")->msh, io::MshVariant::k22);
  EXPECT_EQ(io::write_options_named("vtu")->extension, ".vtu");
  EXPECT_FALSE(io::write_options_named("stl").has_value());
  EXPECT_EQ(io::mesh_files("a.msh").size(), 1U);
  EXPECT_EQ(io::mesh_files("b/a.node.gz"), (std::vector<fs::path>{"b/a.node.gz", "b/a.ele.gz"}));
}

/// A new folder of this test.
fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / (name + "." + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// The number of a process that has ended.
pid_t ended_process() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return child;
}

TEST(WriteMesh, takes_away_what_killed_processes_left_of_the_same_file) {
  const fs::path folder = fresh_folder("incise_stale");
  const std::string stale = "a.mesh." + std::to_string(ended_process()) + ".0.incise-part";
  const std::string busy = "a.mesh." + std::to_string(::getppid()) + ".0.incise-part";
  const std::vector<std::string> others = {"a.mesh.5.txt", "a.mesh.x.0.incise-part", "b" + stale, busy};
  for (const std::string& name : others) std::ofstream(folder / name) << "kept";
  std::ofstream(folder / stale) << "half a mesh";
  ASSERT_TRUE(io::write_mesh(folder / "a.mesh", test::two_tets()).ok());
  std::vector<std::string> expected = others;
  expected.push_back("a.mesh");
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(names_in(folder), expected);
  fs::remove_all(folder);
}

TEST(WriteMesh, has_room_for_the_longest_name_and_takes_its_parts_away_too) {
  const fs::path folder = fresh_folder("incise_long_name");
  std::string name(249, 'a');
  name.replace(219, 2, "\u00e4");  // no half of a character in the name of a part
  const std::string process = std::to_string(ended_process());
  std::ofstream(folder / (name.substr(0, 219) + "." + process + ".0.incise-part")) << "half a mesh";
  ASSERT_TRUE(io::write_mesh(folder / (name + ".mesh"), test::two_tets()).ok());
  EXPECT_EQ(names_in(folder), std::vector<std::string>{name + ".mesh"});
  fs::remove_all(folder);
}

TEST(WriteMeshErrors, a_file_that_is_write_protected_stays) {
  const fs::path folder = fresh_folder("incise_protected");
  const fs::path file = folder / "kept.mesh";
  std::ofstream(file) << "kept";
  fs::permissions(folder, fs::perms::all);
  fs::permissions(file, fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
  const pid_t child = fork();
  if (child == 0) {
    if (::geteuid() == 0 && ::setuid(65534) != 0) _exit(2);  // nothing is protected from root
    const Status status = io::write_mesh(file, test::two_tets());
    _exit(!status.ok() && status.error().message.find("is write-protected") != std::string::npos ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"kept.mesh"});
  EXPECT_EQ(fs::file_size(file), 4U);
  fs::remove_all(folder);
}

TEST(WriteMesh, writes_into_a_pipe_and_leaves_it_there) {
  const fs::path folder = fresh_folder("incise_pipe");
  const fs::path pipe = folder / "pipe.mesh";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const pid_t child = fork();
  if (child == 0) _exit(io::write_mesh(pipe, test::two_tets()).ok() ? 0 : 1);
  const auto back = io::read_mesh(pipe);
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->data.soup.tets, test::two_tets().soup.tets);
  EXPECT_TRUE(fs::is_fifo(pipe));
  fs::remove_all(folder);
}

TEST(WriteMeshErrors, bad_data_and_bad_places_are_refused_and_leave_nothing) {
  const fs::path folder = fs::path(testing::TempDir()) / "incise_write_errors";
  fs::remove_all(folder);
  fs::create_directories(folder / "taken.mesh" / "inside");
  io::MeshData data = test::two_tets();
  EXPECT_EQ(io::write_mesh(folder / "a.xyz", data).error().code, ErrorCode::kBadArgument);
  EXPECT_EQ(io::write_mesh(folder / "none" / "a.mesh", data).error().code, ErrorCode::kIo);
  EXPECT_EQ(io::write_mesh(folder / "taken.mesh", data).error().code, ErrorCode::kIo);
  data.soup.tets[0][0] = 99;
  EXPECT_EQ(io::write_mesh(folder / "a.mesh", data).error().code, ErrorCode::kBadArgument);
  data = test::two_tets();
  data.piece = {1};
  EXPECT_EQ(io::write_mesh(folder / "a.mesh", data).error().code, ErrorCode::kBadArgument);
  data = test::two_tets();
  data.soup.points[0].x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(io::write_mesh(folder / "a.mesh", data).error().code, ErrorCode::kBadArgument);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST(WriteMeshErrors, an_old_file_is_replaced_at_once) {
  const fs::path path = fs::path(testing::TempDir()) / "incise_replace.mesh";
  io::MeshData data = test::two_tets();
  ASSERT_TRUE(io::write_mesh(path, data).ok());
  data.soup.points[0].x() = -3;
  ASSERT_TRUE(io::write_mesh(path, data).ok());
  const auto back = io::read_mesh(path);
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->data.soup.points[0].x(), -3);
}

}  // namespace
}  // namespace incise::write_mesh_test
