// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "incise/cut/stroke.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::bench {

/// A row of the paper's Table 2, with the count of Table 1.
struct PrintedRow {
  std::uint64_t tets, unmerged, merged;
  double fps, relaxation_pct, collision_pct, rendering_pct, modifying_pct;

  [[nodiscard]] double growth() const { return static_cast<double>(unmerged) / static_cast<double>(tets); }
  [[nodiscard]] double merged_growth() const { return static_cast<double>(merged) / static_cast<double>(tets); }
  /// What the collision took of the time for collision and modification alone.
  [[nodiscard]] double collision_share() const { return 100 * collision_pct / (collision_pct + modifying_pct); }
};

/// A model with the strokes that the tables make in it.
struct TableCase {
  std::string name;  ///< as in the tables
  std::string id;    ///< in names of files
  TetMesh mesh;
  std::vector<Stroke> strokes;
  std::optional<PrintedRow> printed;  ///< in Table 2
  bool is_in_table3 = false;
};

/// The cases whose model and strokes are there, from `root`/models and `root`/scenes; says on stderr which are not. The
/// cubes are computed.
std::vector<TableCase> make_table_cases(const std::filesystem::path& root);

/// The models of Table 2, each with one stroke by one rule, whatever comes of it: the plane across the longest side of
/// the body's box (the first of equal ones), through its middle.
std::vector<TableCase> make_rule_cases(const std::filesystem::path& root);

/// The oblique plane A of the other benchmark through the cube of 750 tets with one of its jitters.
TableCase make_oblique_case(std::uint64_t seed);

}  // namespace incise::bench
