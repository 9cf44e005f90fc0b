// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incise/core/profile.h"
#include "incise/cut/options.h"
#include "incise/improve/options.h"
#include "incise/lab/method.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/validate.h"

namespace incise {
inline namespace v0 {
namespace app {

struct MeshCounts {
  std::uint64_t vertices = 0, tets = 0, components = 0;
};

struct PieceFigures {
  std::uint64_t tets = 0;
  double volume = 0;  ///< cubed length units
};

/// A sample's distribution by nearest rank; all zero for an empty sample.
struct Percentiles {
  double p50 = 0, p99 = 0, p999 = 0, max = 0;
};
[[nodiscard]] Percentiles percentiles(std::vector<double> sample);

/// What was asked for, as the report repeats it.
struct ReportOptions {
  Profile profile = Profile::kIncise;
  std::optional<LabMethod> method = {};  ///< a method that the paper cites, instead of the profile
  double snap = 0.2;
  bool merge = true;
  bool improve = true;
  std::uint64_t budget_us = 0;  ///< per stroke; 0: none
  unsigned threads = 1;
  std::uint64_t seed = 0;
  std::string blade;  ///< the file, or empty
  std::string plane;  ///< "nx,ny,nz,d", or empty
};

/// The stroke that broke the validity contract, and was taken back with all that came after it.
struct BrokenStroke {
  std::uint64_t index = 0;      ///< among those of the job, from 0: as many were kept
  std::string name;             ///< may be empty
  std::uint64_t kept_hash = 0;  ///< of the mesh as it was last valid
};

/// Everything that `incise cut` and `incise improve` report.
struct JobReport {
  std::string input;  ///< the mesh file
  std::string input_format;
  std::vector<std::string> notes;  ///< from loading
  ReportOptions options;
  std::uint64_t strokes = 0;          ///< 0 for an improvement
  std::vector<std::uint64_t> missed;  ///< strokes, from 0, that opened nothing
  MeshCounts before, after;
  std::vector<PieceFigures> pieces;  ///< after, by label
  CutStatistics cut;
  MaintainStatistics maintain;                  ///< summed over the strokes
  std::vector<std::uint64_t> units_per_stroke;  ///< work of maintenance; one entry for an improvement
  QualityStats quality_before;
  QualityStats quality_cut;    ///< right after the last cut, before its maintenance; as before for an improvement
  QualityStats quality_after;  ///< at the end
  QualityStats quality_cut_incision, quality_incision;  ///< of the tets that touch a wall, after cut and at the end
  double volume_before = 0, volume_after = 0;
  ValidityReport validity_before, validity_after;
  ValidityChange change;  ///< `ok` is the report's verdict
  /// Of a cut where `change` is not ok. Everything else here is about the mesh after all strokes, the broken one.
  std::optional<BrokenStroke> broken;
  StageTimes times;
  double total_ms = 0;               ///< by the clock, over all strokes with their maintenance
  std::vector<double> step_ms;       ///< of each step of the blade; a stroke's last with its end and maintenance
  std::vector<StageTimes> stage_ms;  ///< one sample per entry
  std::uint64_t hash = 0;            ///< of the mesh after
};

/// The report as JSON, format "incise-report" version 1, with a newline at the end. Cost: O(steps + pieces).
[[nodiscard]] std::string to_json(const JobReport& report);

/// A few lines for people, with a table of the quality before, after cutting and after maintenance.
[[nodiscard]] std::string to_text(const JobReport& report);

}  // namespace app
}  // namespace v0
}  // namespace incise
