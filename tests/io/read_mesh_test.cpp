// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "io/fixtures.h"
#include "io/gzip.h"
#include "io/reader.h"

namespace incise::read_mesh_test {
namespace {

using io::read_mesh_bytes;
using test::Fixture;
using test::fixtures;
using test::read_fixture;

bool same_mesh(const io::MeshFile& file, bool with_regions) {
  const io::MeshData expected = test::two_tets();
  return file.data.soup.points == expected.soup.points && file.data.soup.tets == expected.soup.tets &&
         (!with_regions || file.data.soup.regions == expected.soup.regions);
}

std::string message_of(const std::string& bytes, const std::string& name = "a.x") {
  const auto file = read_mesh_bytes(bytes, name);
  return file ? "(read without an error)" : file.error().message;
}

#define EXPECT_SAYS(bytes, part)                           \
  do {                                                     \
    const std::string said = message_of(bytes);            \
    EXPECT_NE(said.find(part), std::string::npos) << said; \
    EXPECT_NE(said.find(';'), std::string::npos) << said;  \
  } while (false)

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string bytes_of(const std::string& name) {
  for (const Fixture& f : fixtures()) {
    if (f.name == name) return f.bytes;
  }
  ADD_FAILURE() << name;
  return {};
}

TEST(ReadMesh, every_format_gives_the_same_mesh) {
  for (const Fixture& f : fixtures()) {
    SCOPED_TRACE(f.name);
    const auto file = read_fixture(f, f.bytes);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_TRUE(same_mesh(*file, f.regions));
    EXPECT_EQ(file->file_vertices, 5U);
    EXPECT_EQ(file->file_tets, 2U);
    EXPECT_FALSE(file->ten_node);
    EXPECT_FALSE(file->format_name.empty());
  }
}

TEST(ReadMesh, windows_line_ends_change_nothing) {
  for (const Fixture& f : fixtures()) {
    if (f.bytes.find('\0') != std::string::npos || f.name.find("raw") == 0) continue;
    SCOPED_TRACE(f.name);
    std::string bytes;
    for (const char c : f.bytes) bytes += c == '\n' ? std::string("\r\n") : std::string(1, c);
    const auto file = read_fixture(f, bytes);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_TRUE(same_mesh(*file, f.regions));
  }
}

// An .inp file has neither counts nor an end: cut between two rows it is a sound, smaller mesh.
bool is_smaller_deck(const Fixture& f, const io::MeshFile& file) {
  return f.name == "abaqus.inp" && file.data.soup.tets.size() == 1 &&
         file.data.soup.tets[0] == test::two_tets().soup.tets[0];
}

// A file need not end with a line end, so a cut within a number may lose digits unseen where nothing more is needed.
bool is_cut_within_number(const std::string& whole, std::size_t n) {
  const std::string digits = "0123456789.";
  return n > 0 && n < whole.size() && digits.find(whole[n - 1]) != std::string::npos &&
         digits.find(whole[n]) != std::string::npos;
}
bool is_cut_in_last_row(const std::string& whole, std::size_t n) {
  return is_cut_within_number(whole, n) || n > whole.find_last_of('\n', whole.find_last_of("0123456789"));
}

TEST(ReadMesh, a_file_may_end_without_a_line_end) {
  for (const Fixture& f : fixtures()) {
    if (f.bytes.find('\0') != std::string::npos || f.bytes.back() != '\n') continue;
    SCOPED_TRACE(f.name);
    const auto file = read_fixture(f, f.bytes.substr(0, f.bytes.size() - 1));
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_TRUE(same_mesh(*file, f.regions));
  }
}

TEST(ReadMesh, a_file_cut_at_any_byte_is_refused_or_gives_the_same_tets) {
  for (const Fixture& f : fixtures()) {
    SCOPED_TRACE(f.name);
    for (std::size_t n = 0; n < f.bytes.size(); ++n) {
      const auto file = read_fixture(f, f.bytes.substr(0, n));
      if (file) {
        EXPECT_TRUE(same_mesh(*file, false) || is_smaller_deck(f, *file) || is_cut_in_last_row(f.bytes, n))
            << "cut at " << n;
      } else {
        EXPECT_NE(file.error().message.find(';'), std::string::npos) << file.error().message;
      }
    }
  }
}

TEST(ReadMesh, a_changed_byte_never_breaks_the_reader) {
  for (const Fixture& f : fixtures()) {
    for (std::size_t i = 0; i < f.bytes.size(); ++i) {
      for (const char c : {'\0', '9', '-', '\n', '\xff'}) {
        std::string bytes = f.bytes;
        bytes[i] = c;
        const auto file = read_fixture(f, bytes);
        if (!file) {
          EXPECT_FALSE(file.error().message.empty());
        }
      }
    }
  }
}

TEST(ReadMesh, the_second_file_of_a_pair_may_be_cut_as_well) {
  for (Fixture f : fixtures()) {
    if (f.other.empty()) continue;
    const std::string whole = f.other;
    for (std::size_t n = 0; n < whole.size(); ++n) {
      f.other = whole.substr(0, n);
      const auto file = read_fixture(f, f.bytes);
      if (file) {
        EXPECT_TRUE(same_mesh(*file, true) || is_cut_in_last_row(whole, n)) << f.name << " cut at " << n;
      }
    }
  }
}

TEST(ReadMesh, an_empty_file_is_refused) {
  EXPECT_SAYS("", "empty");
}

TEST(ReadMesh, known_kinds_of_no_use_are_named) {
  const std::vector<std::pair<std::string, std::string>> kinds = {{std::string("\xFD"
                                                                               "7zXZ\0",
                                                                               6),
                                                                   "xz"},
                                                                  {"BZh91AY", "bzip2"},
                                                                  {"\x28\xB5\x2F\xFD.", "Zstandard"},
                                                                  {"CDF\1", "NetCDF"},
                                                                  {"NRRD0004\n", "incise mesh"},
                                                                  {"PK\3\4", "zip"}};
  for (const auto& [bytes, part] : kinds) {
    const auto file = read_mesh_bytes(bytes, "a.x");
    ASSERT_FALSE(file.ok());
    EXPECT_EQ(file.error().code, ErrorCode::kUnsupported);
    EXPECT_NE(file.error().message.find(part), std::string::npos) << file.error().message;
  }
}

TEST(ReadMesh, unknown_formats_are_refused_with_a_list_of_the_known_ones) {
  for (const std::string& bytes :
       {std::string("{\"verts\":[]}"), std::string("\x89HDF\r\n\x1a\n"), std::string("MATLAB 5.0 MAT-file"),
        std::string("hello\nworld\n"), std::string("\1\0\0\0\2\0\0\0", 8)}) {
    const auto file = read_mesh_bytes(bytes, "a.x");
    ASSERT_FALSE(file.ok());
    EXPECT_EQ(file.error().code, ErrorCode::kUnsupported);
    EXPECT_NE(file.error().message.find(".vtu"), std::string::npos);
  }
}

TEST(ReadMesh, surfaces_are_refused) {
  EXPECT_SAYS("solid a\nendsolid a\n", "surface");
  EXPECT_SAYS("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n", "POLYDATA");
  EXPECT_SAYS("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n", "surface");
  EXPECT_SAYS("MeshVersionFormatted 1\nDimension 3\nVertices\n1\n0 0 0 0\nEnd\n", "no tetrahedra");
}

TEST(ReadMesh, messages_name_the_line) {
  EXPECT_SAYS(replaced(bytes_of("medit.mesh"), "0 1 0 1", "0 nan 0 1"), "a.x:9: ");
  EXPECT_SAYS(replaced(bytes_of("v2.msh"), "7 1 0 0", "7 1 0"), "a.x:11: ");
  EXPECT_SAYS(replaced(bytes_of("v2.msh"), "7 1 0 0", "7 1 0 0 0"), "a.x:11: ");
}

TEST(ReadMesh, coordinates_must_be_finite) {
  for (const char* word : {"nan", "inf", "-inf", "1e999", "0x10", "1.5.2", "--1"}) {
    SCOPED_TRACE(word);
    EXPECT_SAYS(replaced(bytes_of("medit.mesh"), "1.5", word), word);
    EXPECT_SAYS(replaced(bytes_of("v2.msh"), "1.5", word), word);
    EXPECT_SAYS(replaced(bytes_of("ascii.vtk"), "1.5", word), word);
    EXPECT_SAYS(replaced(bytes_of("ascii.vtu"), "1.5", word), word);
    EXPECT_SAYS(replaced(bytes_of("vega.veg"), "1.5", word), word);
    EXPECT_SAYS(replaced(bytes_of("abaqus.inp"), "1.5", word), word);
    EXPECT_SAYS(replaced(bytes_of("surgsim.ply"), "1.5", word), word);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double last = 1.5;
  std::string from(8, '\0');
  std::string to(8, '\0');
  std::memcpy(from.data(), &last, 8);
  std::memcpy(to.data(), &nan, 8);
  EXPECT_SAYS(replaced(bytes_of("v2_little.msh"), from, to), "not finite");
  EXPECT_SAYS(replaced(bytes_of("raw_little.vtu"), from, to), "not finite");
}

TEST(ReadMesh, data_of_no_use_may_hold_anything) {
  EXPECT_TRUE(read_mesh_bytes(replaced(bytes_of("ascii.vtk"), "\n1 2 3 4 5\n", "\n1 nan -inf 1e999 5\n")).ok());
  EXPECT_TRUE(read_mesh_bytes(replaced(bytes_of("surgsim.ply"), "0 0 0 .5", "0 0 0 nan")).ok());
  EXPECT_TRUE(
      read_mesh_bytes(bytes_of("v2.msh") + "$NodeData\n1\n\"heat\"\n1\n0\n3\n0\n1\n2\n9 nan\n7 1e999\n$EndNodeData\n")
          .ok());
}

TEST(ReadMesh, vertex_numbers_must_be_in_range) {
  EXPECT_SAYS(replaced(bytes_of("medit.mesh"), "2 3 4 5 7", "2 3 4 6 7"), "out of range");
  EXPECT_SAYS(replaced(bytes_of("medit.mesh"), "2 3 4 5 7", "0 3 4 5 7"), "out of range");
  EXPECT_SAYS(replaced(bytes_of("v2.msh"), "3 4 3 7 1 0 7 5 3 1", "3 4 3 7 1 0 7 5 3 2"), "not among");
  EXPECT_SAYS(replaced(bytes_of("ascii.vtk"), "4 1 2 3 4", "4 1 2 3 5"), "vertex 5");
  EXPECT_SAYS(replaced(bytes_of("ascii.vtu"), "1 2 3 4<", "1 2 3 -1<"), "vertex -1");
  EXPECT_SAYS(replaced(bytes_of("vega.veg"), "2 2 3 4 5", "2 2 3 4 6"), "not among");
  EXPECT_SAYS(replaced(bytes_of("abaqus.inp"), "3, 4, 5\n", "3, 4, 6\n"), "not there");
  EXPECT_SAYS(replaced(bytes_of("surgsim.ply"), "4 1 2 3 4", "4 1 2 3 5"), "vertex number");
}

TEST(ReadMesh, counts_that_promise_too_much_are_refused_at_once) {
  const std::string huge = "3000000000";
  EXPECT_SAYS(replaced(bytes_of("medit.mesh"), "Vertices\n5", "Vertices\n" + huge), "more than the rest");
  EXPECT_SAYS(replaced(bytes_of("medit.mesh"), "Tetrahedra\n2", "Tetrahedra\n" + huge), "more than the rest");
  EXPECT_SAYS(replaced(bytes_of("v1.msh"), "$NOD\n5", "$NOD\n" + huge), "more than the rest");
  EXPECT_SAYS(replaced(bytes_of("v2.msh"), "$Nodes\n5", "$Nodes\n" + huge), "more than the rest");
  EXPECT_SAYS(replaced(bytes_of("v2.msh"), "$Elements\n3", "$Elements\n" + huge), "more than the rest");
  EXPECT_SAYS(replaced(bytes_of("v41.msh"), "2 5 1 5", "2 " + huge + " 1 5"), "more than the rest");
  EXPECT_SAYS(replaced(bytes_of("v2_little.msh"), "$Nodes\n5", "$Nodes\n" + huge), "more than the rest");
  EXPECT_SAYS(replaced(bytes_of("ascii.vtk"), "POINTS 5", "POINTS " + huge), "more than the rest");
  EXPECT_SAYS(replaced(bytes_of("binary.vtk"), "POINTS 5", "POINTS " + huge), "more than the rest");
  EXPECT_SAYS(replaced(bytes_of("ascii.vtu"), "NumberOfPoints=\"5\"", "NumberOfPoints=\"" + huge + "\""), "must hold");
  EXPECT_SAYS(replaced(bytes_of("raw_big.vtu"), "NumberOfPoints=\"5\"", "NumberOfPoints=\"" + huge + "\""),
              "must hold");
  EXPECT_SAYS(replaced(bytes_of("vega.veg"), "5 3 0 0", huge + " 3 0 0"), "more than the rest");
  EXPECT_SAYS(replaced(bytes_of("surgsim.ply"), "vertex 5", "vertex " + huge), "more rows");
  EXPECT_SAYS(replaced(bytes_of("little.ply"), "vertex 5", "vertex " + huge), "more rows");
}

TEST(ReadMesh, counts_that_differ_by_one_are_refused) {
  EXPECT_SAYS(replaced(bytes_of("medit.mesh"), "Vertices\n5", "Vertices\n6"), "Edges");
  EXPECT_SAYS(replaced(bytes_of("v2.msh"), "$Nodes\n5", "$Nodes\n4"), "$EndNodes");
  EXPECT_SAYS(replaced(bytes_of("ascii.vtu"), "NumberOfCells=\"2\"", "NumberOfCells=\"1\""), "must hold");
  EXPECT_SAYS(replaced(bytes_of("ascii.vtk"), "CELLS 2 10", "CELLS 2 9"), "CELLS");
  EXPECT_SAYS(replaced(bytes_of("vega.veg"), "2 4 0", "1 4 0"), "expected a section");
}

TEST(ReadMesh, tetgen_counts_must_match_and_chastes_binary_is_refused) {
  const auto message = [](const std::string& ele, const std::string& node) {
    const auto file = read_fixture({"a.ele", ele, node}, ele);
    return file ? std::string() : file.error().message;
  };
  const std::string node = "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
  EXPECT_EQ(message("1 4\n0 0 1 2 3\n", node), "");
  EXPECT_EQ(message("1 4 # the only one of 1 3 5\n0 0 1 2 3\n", node), "") << "numbers of a comment count nothing";
  EXPECT_NE(message("2 4\n0 0 1 2 3\n", node), "");
  EXPECT_NE(message("0 4\n0 0 1 2 3\n", node).find("more rows"), std::string::npos);
  EXPECT_NE(message("1 4\n0 0 1 2 4\n", node).find("not among"), std::string::npos);
  EXPECT_NE(message("1 4\n5 0 1 2 3\n", node).find("from 0 or 1"), std::string::npos);
  EXPECT_NE(message("1 4 1\n0 0 1 2 3\n", node).find("missing"), std::string::npos);
  EXPECT_NE(message("1 4 1 BIN\nxxxx\n", node).find("BIN"), std::string::npos);
  EXPECT_NE(message("1 8\n0 0 1 2 3 0 1 2 3\n", node).find("4 or 10"), std::string::npos);
  EXPECT_NE(message_of("1 4\n0 0 1 2 3\n", "a.ele").find("a.node"), std::string::npos);
}

TEST(ReadMesh, msh_without_a_format_section_is_refused) {
  EXPECT_SAYS("$Nodes\n1 4\n1 0 0 0\n$EndNodes\n", "$MeshFormat");
  EXPECT_SAYS("$MeshFormat\n4 0 8\n$EndMeshFormat\n", "4.0");
}

TEST(ReadMesh, ten_node_tets_keep_their_corners_and_name_the_rest) {
  std::string bytes = "*NODE\n";
  for (int i = 1; i <= 11; ++i)
    bytes += std::to_string(i) + ", " + std::to_string(i * i) + ", 0, " + std::to_string(i % 3) + "\n";
  bytes += "*ELEMENT, TYPE=C3D10, ELSET=Eall\n1, 11, 2, 3, 4, 5, 6,\n7, 8, 9, 10\n";
  const auto file = read_mesh_bytes(bytes, "a.inp");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_TRUE(file->ten_node);
  EXPECT_EQ(file->file_vertices, 11U);
  EXPECT_EQ(file->data.soup.points.size(), 11U);
  EXPECT_EQ(file->mid_nodes, (std::vector<std::uint32_t>{4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(file->data.soup.tets[0], (std::array<std::uint32_t, 4>{10, 1, 2, 3}));
  EXPECT_TRUE(file->data.soup.regions.empty());
}

TEST(ReadMesh, vega_includes_are_followed_and_loops_stop) {
  const std::string main = "*VERTICES\n*INCLUDE v.txt\n*ELEMENTS\nTET\n1 4 0\n1 1 2 3 4\n";
  const io::SiblingLoader sibling = [](const std::string& name) -> Result<std::string> {
    if (name == "v.txt") return std::string("4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
    if (name == "loop") return std::string("*INCLUDE loop\n");
    return Error{ErrorCode::kBadFile, name + " is not there; put it beside"};
  };
  const auto file = read_mesh_bytes(main, "a.veg", sibling);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->file_vertices, 4U);
  EXPECT_FALSE(read_mesh_bytes("*INCLUDE loop\n*VERTICES\n", "a.veg", sibling).ok());
  EXPECT_FALSE(read_mesh_bytes("*INCLUDE none\n*VERTICES\n", "a.veg", sibling).ok());
  EXPECT_FALSE(read_mesh_bytes(main, "a.veg").ok());
}

TEST(ReadMesh, repeated_and_sparse_numbers_are_told_apart) {
  EXPECT_SAYS(replaced(bytes_of("v1.msh"), "50 1 1 1.5", "40 1 1 1.5"), "twice");
  EXPECT_SAYS(replaced(bytes_of("abaqus.inp"), "5, 1, 1,", "4, 1, 1,"), "twice");
}

TEST(ReadMesh, numbers_are_read_correctly_rounded) {
  const std::vector<std::pair<const char*, double>> numbers = {
      {"0.1", 0.1},
      {"1e23", 1e23},
      {"9007199254740993", 9007199254740992.0},
      {"4.9e-324", 4.9e-324},
      {"1D2", 100.0},
      {"-0.0", -0.0},
      {"1.7976931348623157e308", 1.7976931348623157e308},
      {"1e-400", 0.0},
      {".5", 0.5},
      {"5.", 5.0},
      {"+2", 2.0},
      {"0.30000000000000004", 0.30000000000000004},
      {"2.2250738585072011e-308", 2.2250738585072011e-308},
      {"123456789012345678901234567890", 123456789012345678901234567890.0}};
  for (const auto& [text, value] : numbers) {
    const auto file = read_mesh_bytes(replaced(bytes_of("medit.mesh"), "1.5", text), "a.mesh");
    ASSERT_TRUE(file.ok()) << text;
    const double got = file->data.soup.points[4].z();
    EXPECT_EQ(std::memcmp(&got, &value, sizeof got), 0) << text << " gave " << got;
  }
}

TEST(ReadMesh, files_that_are_not_there_or_are_folders_are_refused) {
  EXPECT_EQ(io::read_mesh("/no/such/file.mesh").error().code, ErrorCode::kBadFile);
  EXPECT_EQ(io::read_mesh(std::filesystem::temp_directory_path()).error().code, ErrorCode::kBadFile);
}

TEST(ReadMesh, damaged_or_endless_gzip_is_refused) {
  const auto path = std::filesystem::path(testing::TempDir()) / "incise_read_mesh_test.mesh.gz";
  ASSERT_TRUE(io::write_mesh(path, test::two_tets()).ok());
  std::ifstream in(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const auto whole = read_mesh_bytes(bytes, "a.mesh.gz");
  ASSERT_TRUE(whole.ok());
  EXPECT_TRUE(whole->gzipped);
  for (std::size_t n = 0; n + 1 < bytes.size(); ++n)
    EXPECT_FALSE(read_mesh_bytes(bytes.substr(0, n), "a.mesh.gz").ok());
  io::ReadLimits limits;
  limits.max_inflated_bytes = 100;
  const auto refused = read_mesh_bytes(bytes, "a.mesh.gz", {}, limits);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("100 bytes"), std::string::npos);
}

TEST(ReadMesh, a_file_larger_than_what_is_read_is_refused_by_its_size) {
  const auto path = std::filesystem::path(testing::TempDir()) / "incise_sparse.mesh";
  std::ofstream(path) << "MeshVersionFormatted 2\nDimension 3\n";
  std::filesystem::resize_file(path, std::uintmax_t{60} << 30U);  // of which next to nothing is on the disk
  const auto refused = io::read_mesh(path);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("is larger than 4 GiB"), std::string::npos) << refused.error().message;
  std::filesystem::remove(path);
}

TEST(ReadMesh, gzip_that_grows_like_a_bomb_is_refused_with_the_limit) {
  const std::size_t large = std::size_t{80} << 20U;
  std::string bytes = "MeshVersionFormatted 2\nDimension 3\n";
  bytes.resize(large, ' ');
  std::string packed;
  ASSERT_TRUE(io::gzip(bytes, packed));
  ASSERT_LT(packed.size() * 64, large);
  const auto refused = read_mesh_bytes(packed, "a.mesh.gz");
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("more than 64 MiB"), std::string::npos) << refused.error().message;
}

TEST(ReadMesh, gzip_that_grows_more_than_64_times_is_refused_before_memory_is_taken) {
  std::string bytes(std::size_t{2} << 20U, '\0');
  std::mt19937 any(1);
  for (char& c : bytes) c = static_cast<char>(any());
  bytes.resize(std::size_t{160} << 20U, ' ');
  std::string packed, out, why;
  ASSERT_TRUE(io::gzip(bytes, packed));
  ASSERT_GT(packed.size() * 128, bytes.size());
  EXPECT_FALSE(io::gunzip(packed, std::uint64_t{4} << 30U, out, why));
  EXPECT_NE(why.find("64 times"), std::string::npos) << why;
  EXPECT_LT(out.capacity(), 1000U);
}

TEST(ReadMesh, gzip_of_several_members_is_read_whole) {
  std::string first, second, out, why;
  ASSERT_TRUE(io::gzip(std::string(3'000'000, 'a'), first));
  ASSERT_TRUE(io::gzip("bc", second));
  ASSERT_TRUE(io::gunzip(first + second, 1U << 30U, out, why)) << why;
  EXPECT_EQ(out, std::string(3'000'000, 'a') + "bc");
  ASSERT_TRUE(io::gunzip(second + first, 1U << 30U, out, why)) << why;
  EXPECT_EQ(out, "bc" + std::string(3'000'000, 'a'));
}

TEST(ReadMesh, devices_are_refused) {
  const auto refused = io::read_mesh("/dev/zero");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kBadFile);
  EXPECT_NE(refused.error().message.find("device"), std::string::npos) << refused.error().message;
}

TEST(ReadMesh, lines_may_end_in_carriage_returns) {
  for (const std::string name : {"medit.mesh", "v2.msh", "v1.msh"}) {
    std::string text = bytes_of(name);
    const auto plain = read_mesh_bytes(text, name);
    ASSERT_TRUE(plain.ok()) << name;
    std::replace(text.begin(), text.end(), '\n', '\r');
    const auto file = read_mesh_bytes(text, name);
    ASSERT_TRUE(file.ok()) << name << ": " << file.error().message;
    EXPECT_EQ(file->data.soup.tets, plain->data.soup.tets);
    EXPECT_EQ(file->data.soup.points, plain->data.soup.points);
  }
}

TEST(ReadMesh, formats_of_text_that_are_not_read_are_named) {
  EXPECT_SAYS("8 5 0 0 0\n1 0 0 0\n", "AVS UCD");
  EXPECT_SAYS("5 8 6\n0 0 1\n", "FreeFem (.msh of a plane mesh)");
  EXPECT_SAYS("5 1 6\n0 0 1 2\n", "FreeFem (.msh of a mesh in space)");
  EXPECT_SAYS("# by hand\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "incise mesh fills it");
  std::string stl(84 + 50, '\1');
  stl.replace(80, 4, std::string("\1\0\0\0", 4));
  EXPECT_SAYS(stl, "incise mesh fills it");
  EXPECT_SAYS("    -1\n  2411\n         1         1         1        11\n", "I-DEAS universal");
  EXPECT_SAYS("$ a model\nSOL 101\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\n", "Nastran");
  EXPECT_SAYS("GRID    1               0.0     0.0     0.0\n", "Nastran");
  EXPECT_SAYS(std::string("\4\x22M\x18 and so on"), "LZ4");
  EXPECT_SAYS("$MeshFormat\n4.0 0 8\n$EndMeshFormat\n", "not 4.0");
}

std::string notes_of(const std::string& bytes, const std::string& name = "a.x") {
  const auto file = read_mesh_bytes(bytes, name);
  if (!file) return file.error().message;
  std::string notes;
  for (const std::string& note : file->notes) notes += note + "\n";
  return notes;
}

TEST(ReadMesh, elements_that_are_left_out_are_counted_by_name) {
  const std::string rest = " were left out; only tets are cut\n";
  EXPECT_EQ(notes_of(replaced(bytes_of("medit.mesh"), "Edges\n1\n1 2 0\n",
                              "Edges\n1\n1 2 0\nHexahedra\n1\n1 2 3 4 5 1 2 3 0\nQuadrilaterals\n2\n1 2 3 4 0\n1 2 3 4 "
                              "0\nPrisms\n1\n1 2 3 4 5 1 0\n")),
            "1 hexahedron, 1 prism and 2 quadrilaterals" + rest);
  EXPECT_EQ(notes_of(replaced(bytes_of("v2.msh"), "$Elements\n3\n",
                              "$Elements\n5\n8 5 2 0 1 9 7 5 3 1 9 7 5\n9 3 2 0 1 9 7 5 3\n")),
            "1 hexahedron and 1 quadrilateral" + rest);
  std::string vtk = replaced(bytes_of("ascii.vtk"), "CELLS 2 10\n", "CELLS 4 22\n5 0 1 2 3 4\n5 0 1 2 3 4\n");
  vtk = replaced(replaced(vtk, "CELL_TYPES 2\n", "CELL_TYPES 4\n14 99 "), "CELL_DATA 2", "CELL_DATA 4");
  EXPECT_EQ(notes_of(replaced(vtk, "default\n0 7", "default\n0 0 0 7")), "1 cell of type 99 and 1 pyramid" + rest);
  EXPECT_EQ(notes_of(replaced(bytes_of("abaqus.inp"), "*ELSET,",
                              "*ELEMENT, TYPE=C3D8R\n7, 1, 2, 3, 4,\n5, 1, 2, 3\n8, 1, 2, 3, 4, 5, 1, 2, 3\n*ELSET,")),
            "2 elements of type 'c3d8r'" + rest);
}

TEST(ReadMesh, a_few_kinds_that_are_left_out_are_named_and_the_others_counted) {
  io::LeftOut one, many;
  one.add("polyhedra");
  std::vector<std::string> notes;
  one.note(notes);
  EXPECT_EQ(notes[0], "1 polyhedron was left out; only tets are cut");
  for (int type = 100; type < 250; ++type) many.add("cells of type " + std::to_string(type), 2);
  many.note(notes);
  EXPECT_NE(notes[1].find("2 cells of type 111 and 276 of 138 more kinds were left out"), std::string::npos)
      << notes[1];
  EXPECT_EQ(io::singular("triangles6"), "triangle6");
  EXPECT_EQ(io::singular("elements of type 'c3d8r'"), "element of type 'c3d8r'");
}

TEST(ReadMesh, base64_of_the_wrong_length_is_refused) {
  const auto bytes = io::write_mesh_bytes(".vtu", test::two_tets());
  ASSERT_TRUE(bytes.ok());
  const std::size_t end = bytes->find("\n</DataArray>");  // of the points
  EXPECT_SAYS(std::string(*bytes).insert(end, "AAAA"), "must hold 15 numbers");
  EXPECT_SAYS(std::string(*bytes).insert(end, "AA=="), "must hold 15 numbers");
  EXPECT_SAYS(std::string(*bytes).erase(end - 4, 4), "must hold 15 numbers");
  EXPECT_TRUE(read_mesh_bytes(std::string(*bytes).insert(end, " \n\t ")).ok());
}

const std::string kMeditHead = "MeshVersionFormatted 2\nDimension 3\n";
const std::string kMeditRest =
    "Vertices\n4\n0 0 0 3\n1 0 0 0\n0 1 0 1\n0 0 1 9\nCorners\n2\n2\n3\nTriangles\n1\n1 2 3 5\nTetrahedra\n1\n1 2 3 4 "
    "0\nEnd\n";

TEST(ReadMedit, takes_labels_for_strokes_origins_and_fronts_where_incise_says_so) {
  const auto ours = io::read_mesh_bytes(kMeditHead + "# incise: stroke origin_vertex cut_front\r\n" + kMeditRest);
  ASSERT_TRUE(ours.ok()) << ours.error().message;
  EXPECT_FALSE(ours->data.has_foreign_labels);
  EXPECT_EQ(ours->data.triangle_stroke, std::vector<std::int32_t>{5});
  EXPECT_EQ(ours->data.origin_vertex, (std::vector<std::int32_t>{2, -1, 0, 8}));
  EXPECT_EQ(ours->data.cut_front, (std::vector<std::int32_t>{0, 1, 1, 0}));
  for (const std::string mark : {"", "# written by somebody\n", "# incise was here: stroke\n"}) {
    const auto foreign = io::read_mesh_bytes(kMeditHead + mark + kMeditRest);
    ASSERT_TRUE(foreign.ok()) << foreign.error().message;
    EXPECT_TRUE(foreign->data.has_foreign_labels) << mark;
    EXPECT_EQ(foreign->data.triangle_stroke, std::vector<std::int32_t>{5});
    EXPECT_TRUE(foreign->data.origin_vertex.empty() && foreign->data.cut_front.empty()) << mark;
  }
  const auto late = io::read_mesh_bytes(kMeditHead + kMeditRest + "# incise: stroke\n");
  EXPECT_TRUE(late.ok() && late->data.has_foreign_labels);
}

TEST(ReadMedit, names_the_line_of_a_corner_that_does_not_exist) {
  std::string bytes = kMeditHead + "# incise: cut_front\n" + kMeditRest;
  bytes.replace(bytes.find("Corners\n2\n2"), 11, "Corners\n2\n7");
  const auto file = io::read_mesh_bytes(bytes, "a.mesh");
  ASSERT_FALSE(file.ok());
  EXPECT_EQ(file.error().message.substr(0, 10), "a.mesh:12:");
}

TEST(ReadMsh, takes_triangles_for_walls_only_where_element_data_name_strokes) {
  const std::string elements =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n3\n"
      "1 4 2 0 1 1 2 3 4\n2 2 2 7 1 1 2 3\n3 2 2 8 1 1 2 4\n$EndElements\n";
  const auto foreign = io::read_mesh_bytes(elements);
  ASSERT_TRUE(foreign.ok());
  EXPECT_TRUE(foreign->data.has_foreign_labels);
  EXPECT_EQ(foreign->data.triangle_stroke, (std::vector<std::int32_t>{7, 8}));
  const auto ours =
      io::read_mesh_bytes(elements + "$ElementData\n1\n\"stroke\"\n1\n0\n3\n0\n1\n1\n3 2\n$EndElementData\n");
  ASSERT_TRUE(ours.ok()) << ours.error().message;
  EXPECT_FALSE(ours->data.has_foreign_labels);
  EXPECT_EQ(ours->data.triangle_stroke, (std::vector<std::int32_t>{0, 2}));
}

}  // namespace
}  // namespace incise::read_mesh_test
