// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/quality_stats.h"
#include "tables_cases.h"

namespace incise::bench {

/// Ways to make the same cut.
enum class Way : unsigned char {
  kPaperCut,
  kPaperMerged,
  kPaperImproved,
  kPaper,
  kInciseCut,
  kInciseMerged,
  kIncise,
  kCount
};
inline constexpr std::size_t kWays = static_cast<std::size_t>(Way::kCount);

/// A mesh's tets in figures.
struct MeshFigures {
  QualityStats all;
  QualityStats wall;           ///< of the tets that touch a cut wall
  std::vector<double> ratios;  ///< L/r of every tet, infinite where it is flat
};
MeshFigures measure(const TetMesh& mesh);

/// A cut made in one way. Times are processor times of the fastest run; those of the stages are by the clock, each the
/// least of the runs, and together no more than the processor time.
struct CutResult {
  bool is_ok = false;
  MeshFigures mesh;
  CutStatistics cut;
  StageTimes stages;
  double cut_ms = 0, maintain_ms = 0;
  double volume_error = 0;  ///< relative
  std::string defects;      ///< beyond those of the input; empty where the mesh is as valid as it was

  [[nodiscard]] std::uint64_t tets() const { return mesh.all.tets; }
  [[nodiscard]] double total_ms() const { return cut_ms + maintain_ms; }
};

/// A case with all that was made of it.
struct CaseResults {
  const TableCase* of = nullptr;
  MeshFigures original;
  std::array<CutResult, kWays> cuts;

  [[nodiscard]] const CutResult& operator[](Way way) const { return cuts[static_cast<std::size_t>(way)]; }
  /// The tets of a way over those of the original.
  [[nodiscard]] double growth(Way way) const;
  /// The mean L/r of a way over that of the original.
  [[nodiscard]] double mean_ratio(Way way) const;
};

/// Makes the cut in every way, `runs` ≥ 1 times each. Where `mesh_folder` is not empty, the mesh before the cut and the
/// paper's cut without maintenance are written there, as ID_original.mesh and ID_cut.mesh.
CaseResults run_case(const TableCase& of, unsigned runs, const std::filesystem::path& mesh_folder);

}  // namespace incise::bench
