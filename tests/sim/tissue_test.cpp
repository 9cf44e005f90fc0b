// SPDX-License-Identifier: Apache-2.0
#include "incise/sim/tissue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace incise::tissue_test {
namespace {

const char* name_of(const Tissue* tissue) {
  return tissue == nullptr ? "none" : tissue->name.data();
}

TEST(Tissues, are_sound_materials) {
  for (const Tissue& tissue : tissues()) {
    Materials materials;
    materials.fallback = tissue.material;
    EXPECT_TRUE(check(materials).ok()) << tissue.name;
    EXPECT_GT(tissue.material.toughness, 0) << tissue.name;
    EXPECT_EQ(find_tissue(tissue.name), &tissue);
  }
}

TEST(Tissues, are_found_by_name) {
  EXPECT_STREQ(name_of(find_tissue("Liver")), "liver");
  EXPECT_STREQ(name_of(find_tissue("livers")), "none");
  EXPECT_STREQ(name_of(find_tissue("")), "none");
}

TEST(Tissues, are_told_from_the_words_of_a_regions_name) {
  const std::vector<std::pair<const char*, const char*>> expected = {{"left kidney", "kidney"},
                                                                     {"kidney_left", "kidney"},
                                                                     {"Subcutaneous_Fat", "fat"},
                                                                     {"vertebrae_L1", "bone"},
                                                                     {"liver tumor 2", "tumour"},
                                                                     {"liver vessels", "vessel"},
                                                                     {"SKIN", "skin"},
                                                                     {"rib_left_3", "bone"},
                                                                     {"gluteus_maximus", "muscle"},
                                                                     {"breast gland", "breast gland"},
                                                                     {"costal_cartilages", "cartilage"},
                                                                     {"submandibular gland", "salivary gland"},
                                                                     {"inferior_vena_cava", "vessel"},
                                                                     {"label 3", "none"},
                                                                     {"", "none"},
                                                                     {"liverwort", "none"},
                                                                     {"thin", "none"}};
  for (const auto& [name, tissue] : expected) EXPECT_STREQ(name_of(tissue_of_region_name(name)), tissue) << name;
}

/// A number of the table: "0.45*" is 0.45, and a reading.
struct Cell {
  double value;
  bool is_reading;
};

Cell parse(const std::string& text) {
  return {std::stod(text), text.find('*') != std::string::npos};
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream in(row.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

TEST(Tissues, are_those_of_the_document) {
  std::ifstream file(INCISE_SOURCE_DIR "/docs/tissues.md");
  ASSERT_TRUE(file.good());
  std::size_t found = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] != '|') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() < 7 || cells[0] == "tissue" || cells[0][0] == '-') continue;
    const Tissue* tissue = find_tissue(cells[0]);
    ASSERT_NE(tissue, nullptr) << cells[0];
    EXPECT_EQ(tissue, &tissues()[found++]) << cells[0] << " stands elsewhere in the table of the code";
    const Material& m = tissue->material;
    const double numbers[5] = {m.density, m.young, m.poisson, m.toughness, m.cut_friction};
    for (unsigned n = 0; n < 5; ++n) {
      const Cell cell = parse(cells[n + 1]);
      EXPECT_NEAR(numbers[n], cell.value, n == 4 ? 0.5 : 0) << cells[0] << ", column " << n + 1;
      EXPECT_EQ((tissue->readings >> n & 1U) != 0, cell.is_reading) << cells[0] << ", column " << n + 1;
    }
    EXPECT_FALSE(cells[6].empty()) << cells[0];
  }
  EXPECT_EQ(found, tissues().size());
}

}  // namespace
}  // namespace incise::tissue_test
