// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>

#include "incise/io/mesh_file.h"
#include "io/fixtures.h"

namespace incise {
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
  EXPECT_NE(bytes->find("3 1 4 2\n1 "), std::string::npos) << "the two tets of region 5 are one block";
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
}  // namespace incise
