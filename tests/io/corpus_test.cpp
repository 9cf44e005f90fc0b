// SPDX-License-Identifier: Apache-2.0
// Reads every real mesh of $INCISE_CORPUS and compares it with the corpus's own table, MANIFEST.md.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "incise/io/mesh_file.h"
#include "incise/mesh/defects.h"

namespace incise::corpus_test {
namespace {

namespace fs = std::filesystem;

struct Row {
  std::string file;
  bool broken = false;
  std::map<std::string, std::string> column;

  [[nodiscard]] std::uint64_t number(const std::string& name) const { return std::stoull(column.at(name)); }
};

std::vector<std::string> split_row(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t at = 1;
  while (at < line.size()) {
    const std::size_t end = std::min(line.find('|', at), line.size());
    const std::string cell = line.substr(at, end - at);
    const std::size_t first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    at = end + 1;
  }
  return cells;
}

// The tables of tets: those with a column "tets".
std::vector<Row> parse_manifest(const fs::path& path) {
  std::ifstream in(path);
  std::vector<Row> rows;
  std::vector<std::string> names;
  bool broken = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("## ", 0) == 0) broken = line == "## Broken";
    if (line.empty() || line[0] != '|') {
      names.clear();
      continue;
    }
    const auto cells = split_row(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    if (names.size() < 6 || names[0] != "file" || names[4] != "tets" || cells[0].rfind("---", 0) == 0) continue;
    Row row;
    row.file = cells[0];
    row.broken = broken;
    for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i) row.column[names[i]] = cells[i];
    rows.push_back(row);
  }
  return rows;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool is_unsupported(const std::string& file) {
  return ends_with(file, ".json") || ends_with(file, ".h5") || ends_with(file, ".mat");
}

class Corpus : public testing::Test {
 protected:
  void SetUp() override {
    const char* root = std::getenv("INCISE_CORPUS");
    if (root == nullptr || !fs::exists(fs::path(root) / "tets")) {
      GTEST_SKIP() << "INCISE_CORPUS is not set: real meshes are not tested";
    }
    tets_ = fs::path(root) / "tets";
    rows_ = parse_manifest(fs::path(root) / "MANIFEST.md");
    ASSERT_GT(rows_.size(), 40U);
  }

  fs::path tets_;
  std::vector<Row> rows_;
};

TEST_F(Corpus, every_sound_file_reads_with_the_manifests_counts_and_defects) {
  for (const Row& row : rows_) {
    if (row.broken || is_unsupported(row.file)) continue;
    SCOPED_TRACE(row.file);
    const auto file = io::read_mesh(tets_ / row.file);
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ(file->file_vertices, row.number("verts"));
    EXPECT_EQ(file->file_tets, row.number("tets"));
    EXPECT_EQ(file->gzipped, ends_with(row.file, ".gz"));
    const Defects found = find_defects(file->data.soup);
    EXPECT_EQ(found.negative, row.column.at("or") == "-");
    EXPECT_EQ(found.inverted, row.number("inv"));
    EXPECT_EQ(found.zero_volume, row.number("zero"));
    EXPECT_EQ(found.unreferenced_vertices, row.number("unref"));
    EXPECT_EQ(found.duplicate_vertices, row.number("dupN"));
    EXPECT_EQ(found.duplicate_tets, row.number("dupT"));
    EXPECT_EQ(found.nonmanifold_edges, row.number("e!=2"));
    EXPECT_EQ(found.singleton_vertices, row.number("sing"));
    EXPECT_EQ(found.overshared_faces, row.number("f>2"));
    EXPECT_EQ(found.components, row.number("comp"));  // stoull stops at '/'
    EXPECT_EQ(file->ten_node, !file->mid_nodes.empty());
    if (file->ten_node) {
      EXPECT_EQ(file->mid_nodes.size(), found.unreferenced_vertices);
    }
  }
}

TEST_F(Corpus, every_broken_or_unsupported_file_is_refused_with_a_remedy) {
  for (const Row& row : rows_) {
    if (!row.broken && !is_unsupported(row.file)) continue;
    SCOPED_TRACE(row.file);
    const auto file = io::read_mesh(tets_ / row.file);
    ASSERT_FALSE(file.ok());
    EXPECT_NE(file.error().message.find(row.file.substr(0, row.file.find('.'))), std::string::npos);
    EXPECT_NE(file.error().message.find(';'), std::string::npos) << file.error().message;
    if (is_unsupported(row.file)) {
      EXPECT_EQ(file.error().code, ErrorCode::kUnsupported);
      EXPECT_NE(file.error().message.find(".msh"), std::string::npos) << file.error().message;
    }
    std::printf("  %s\n", file.error().message.c_str());
  }
}

TEST_F(Corpus, both_halves_of_a_tetgen_pair_give_the_same_mesh) {
  const auto by_ele = io::read_mesh(tets_ / "paper_cube_750.ele");
  const auto by_node = io::read_mesh(tets_ / "paper_cube_750.node");
  ASSERT_TRUE(by_ele.ok());
  ASSERT_TRUE(by_node.ok()) << by_node.error().message;
  EXPECT_EQ(by_ele->data.soup.tets, by_node->data.soup.tets);
  EXPECT_EQ(by_ele->data.soup.points, by_node->data.soup.points);
}

TEST_F(Corpus, every_writer_gives_a_real_mesh_back_bit_for_bit) {
  for (const char* name : {"cgal_liver_12k.mesh", "polyfem_P1_inverted.msh", "chaste_heart_decimation.vtu"}) {
    const auto file = io::read_mesh(tets_ / name);
    ASSERT_TRUE(file.ok());
    io::MeshData data = file->data;
    for (const char* extension : {".mesh", ".msh", ".vtk", ".vtu", ".ele", ".veg", ".inp", ".vtu.gz", ".node.gz"}) {
      SCOPED_TRACE(std::string(name) + " as " + extension);
      const fs::path path = fs::path(testing::TempDir()) / ("incise_corpus_copy" + std::string(extension));
      const Status written = io::write_mesh(path, data);
      ASSERT_TRUE(written.ok()) << written.error().message;
      const auto back = io::read_mesh(path);
      ASSERT_TRUE(back.ok()) << back.error().message;
      EXPECT_EQ(back->data.soup.points, data.soup.points);
      EXPECT_EQ(back->data.soup.tets, data.soup.tets);
      EXPECT_EQ(back->data.soup.regions, data.soup.regions);
    }
  }
}

}  // namespace
}  // namespace incise::corpus_test
