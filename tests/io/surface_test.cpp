// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "incise/io/surface_file.h"

namespace incise::surface_test {
namespace {

namespace fs = std::filesystem;

io::SurfaceSoup tetrahedron() {
  io::SurfaceSoup s;
  s.points = {{0.1, 0, 0}, {1, 1.0 / 3, 0}, {0, 1, 0}, {0, 0, 1e-300}};
  s.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return s;
}

TEST(Surface, obj_ply_and_off_read_back_bit_for_bit) {
  const io::SurfaceSoup s = tetrahedron();
  for (const char* extension : {".obj", ".ply", ".off", ".obj.gz", ".ply.gz", ".off.gz"}) {
    SCOPED_TRACE(extension);
    const fs::path path = fs::path(testing::TempDir()) / (std::string("incise_surface") + extension);
    const Status written = io::write_surface(path, s);
    ASSERT_TRUE(written.ok()) << written.error().message;
    const auto back = io::read_surface(path);
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->points, s.points);
    EXPECT_EQ(back->triangles, s.triangles);
  }
}

TEST(Surface, obj_keeps_texture_coordinates_and_normals) {
  const auto read = io::read_surface_bytes(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0.5\nvt 0.25\nvn 0 0 2\n"
      "f 1/1/1 2/2/1 3/3/1\nf 1/2/1 3/3/1 4//1\n");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->texture, (std::vector<std::array<double, 2>>{{0, 0}, {1, 0.5}, {0.25, 0}}));
  EXPECT_EQ(read->texture_triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 2, kInvalidIndex}}));
  const fs::path path = fs::path(testing::TempDir()) / "incise_texture.obj";
  ASSERT_TRUE(io::write_surface(path, *read).ok());
  const auto back = io::read_surface(path);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->texture, read->texture);
  EXPECT_EQ(back->texture_triangles, read->texture_triangles);
  EXPECT_EQ(back->normals, read->normals);
  EXPECT_EQ(back->normal_triangles, read->normal_triangles);
  const FineSurface fine = io::to_fine_surface(*read);
  EXPECT_EQ(fine.points.size(), 5U);  // the first point stands on a seam
  EXPECT_EQ(fine.texture[fine.triangles[0][0]], (std::array<double, 2>{0, 0}));
  EXPECT_EQ(fine.texture[fine.triangles[1][0]], (std::array<double, 2>{1, 0.5}));
  EXPECT_EQ(fine.normals[0], Vec3(0, 0, 1));
}

TEST(Surface, stl_reads_back_in_single_precision_and_welds) {
  const io::SurfaceSoup s = tetrahedron();
  const fs::path path = fs::path(testing::TempDir()) / "incise_surface.stl";
  ASSERT_TRUE(io::write_surface(path, s).ok());
  auto back = io::read_surface(path);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->points.size(), 12U);
  EXPECT_EQ(io::weld(*back), 8U);
  EXPECT_EQ(back->points.size(), 4U);
  EXPECT_EQ(back->triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(back->points[0].x(), static_cast<double>(0.1F));
}

TEST(Surface, ascii_stl_polygons_and_negative_indices_are_read) {
  const auto stl = io::read_surface_bytes(
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid "
      "a\n");
  ASSERT_TRUE(stl.ok()) << stl.error().message;
  EXPECT_EQ(stl->triangles.size(), 1U);
  const auto obj = io::read_surface_bytes("v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nv 0 1 0\nf 1//1 2//1 3/1/1 -1\n");
  ASSERT_TRUE(obj.ok()) << obj.error().message;
  EXPECT_EQ(obj->triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

/// The text with other line ends.
std::string with_ends(const std::string& text, const std::string& end) {
  std::string out;
  for (const char c : text) out += c == '\n' ? end : std::string(1, c);
  return out;
}

TEST(Surface, lines_may_end_in_carriage_returns) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n", faces = "3 0 1 2\n3 0 2 3\n";
  const std::string ply_header =
      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string texts[] = {"OFF\n# two\n4 2 0\n" + points + faces,
                               "# four\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n",
                               "ply\nformat ascii 1.0\ncomment of two\n" + ply_header + points + faces,
                               "solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n"
                               "facet\nvertex 0 0 0\nvertex 0 1 0\nvertex 0 0 1\nendfacet\nendsolid a\n"};
  for (const std::string& text : texts) {
    for (const char* end : {"\n", "\r", "\r\n"}) {
      const auto read = io::read_surface_bytes(with_ends(text, end));
      ASSERT_TRUE(read.ok()) << text << read.error().message;
      EXPECT_EQ(read->triangles.size(), 2U) << text;
    }
  }
}

TEST(Surface, a_header_before_binary_rows_may_end_its_lines_in_carriage_returns) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
      "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
  const std::string rows("\n\r\0\1\0\r\0\1\n\3\0\1\2", 13);
  for (const char* end : {"\n", "\r", "\r\n"}) {
    const auto read = io::read_surface_bytes(with_ends(header, end) + rows);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->points[0], Vec3(10, 13, 0));
    EXPECT_EQ(read->triangles.size(), 1U);
  }
}

TEST(Surface, bad_surfaces_are_refused) {
  for (const char* bytes :
       {"", "v 0 0 0\nf 1 2 3\n", "v 0 0 nan\n", "OFF\n1 1 0\n0 0 0\n3 0 1 2\n", "OFF\n99999 1 0\n0 0 0\n",
        "solid a\nvertex 0 0 0\nendsolid\n", "solid a\n", "ply\nformat ascii 1.0\n", "hello\n"}) {
    const auto surface = io::read_surface_bytes(bytes, "a.obj");
    ASSERT_FALSE(surface.ok()) << bytes;
    EXPECT_EQ(surface.error().message.rfind("a.obj", 0), 0U) << surface.error().message;
    EXPECT_NE(surface.error().message.find(';'), std::string::npos) << surface.error().message;
  }
}

TEST(Surface, a_binary_stl_of_the_wrong_length_is_told_what_its_header_counts) {
  const fs::path path = fs::path(testing::TempDir()) / "incise_length.stl";
  ASSERT_TRUE(io::write_surface(path, tetrahedron()).ok());
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto message = [](const std::string& text) { return io::read_surface_bytes(text, "a.stl").error().message; };
  EXPECT_EQ(
      message(bytes.substr(0, bytes.size() - 60)),
      "a.stl: as a binary STL file its header counts 4 triangles, but the file holds 2 and 40 bytes more; copy the "
      "file again, or export the surface again");
  EXPECT_NE(message(bytes + std::string(100, '\0')).find("counts 4 triangles, but the file holds 6;"),
            std::string::npos);
  std::string solid = bytes.substr(0, bytes.size() - 50);  // as many programs begin their binary files
  solid.replace(0, 5, "solid");
  EXPECT_NE(message(solid).find("counts 4 triangles, but the file holds 3;"), std::string::npos) << message(solid);
}

TEST(Surface, surfaces_cut_at_any_byte_never_break_the_reader) {
  for (const char* extension : {".obj", ".ply", ".off", ".stl"}) {
    const fs::path path = fs::path(testing::TempDir()) / (std::string("incise_cut") + extension);
    ASSERT_TRUE(io::write_surface(path, tetrahedron()).ok());
    std::FILE* file = std::fopen(path.string().c_str(), "rb");
    std::string bytes(4096, '\0');
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file));
    std::fclose(file);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const auto surface = io::read_surface_bytes(bytes.substr(0, n), "a");
      if (!surface) {
        EXPECT_FALSE(surface.error().message.empty());
      }
    }
  }
}

}  // namespace
}  // namespace incise::surface_test
