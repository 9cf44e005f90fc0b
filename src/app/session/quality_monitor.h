// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/mesh/journal_cursor.h"
#include "incise/mesh/star.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The quality of all tets at rest, as a display shows it. L/r as in `QualityStats`.
struct QualityFigures {
  /// Counts of tets by `quality_byte`, 8 bytes to a bin: logarithmic from 2√6 to 200; the last bin has what is above
  /// about 178 as well.
  static constexpr std::size_t kBins = 32;
  std::array<std::uint32_t, kBins> histogram{};
  std::uint64_t tets = 0;
  double lr_min = 0, lr_mean = 0, lr_max = 0;  ///< flat tets stay out of these
  double lr_over_200_pct = 0;                  ///< percent of `tets`, flat ones included
};

/// Follows a mesh through its journal and keeps the quality of every tet: what a display needs while a blade cuts.
///
/// *Differs* from `measure_quality` in what a change costs: O(changed tets) to measure, plus about 2 ns per tet to sum.
/// Not thread-safe.
class QualityMonitor {
 public:
  QualityMonitor(const TetMesh& mesh, const Journal& journal);

  /// Catches up with the journal. Returns whether anything changed. Cost: after an undo or redo O(tets).
  bool follow(const TetMesh& mesh, const Journal& journal);
  [[nodiscard]] const QualityFigures& now() const { return now_; }
  /// When the monitor was made.
  [[nodiscard]] const QualityFigures& before() const { return before_; }
  /// The `count` live tets of greatest L/r, worst first, of equals the lowest slot. Cost: O(tets).
  [[nodiscard]] std::vector<TetId> worst(std::size_t count) const;

 private:
  void measure_all(const TetMesh& mesh);
  void measure(const TetMesh& mesh, TetId tet);
  void apply(const Step& step, const TetMesh& mesh);
  void sum();

  std::vector<float> ratios_;  // per tet slot; 0: not live; infinite: flat
  StarWalker walker_;
  QualityFigures now_, before_;
  JournalCursor cursor_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
