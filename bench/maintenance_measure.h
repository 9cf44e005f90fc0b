// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/validate.h"

namespace incise::bench {

/// The vertices that the journal's steps from a position on made, copied or moved, and those on cut walls.
class Touched {
 public:
  Touched(const TetMesh& mesh, const Journal& journal, std::size_t first_step);
  [[nodiscard]] bool holds(VertexId vertex) const { return is_touched_[vertex.value]; }
  /// Whether a tet has such a vertex.
  [[nodiscard]] bool touches(const TetMesh& mesh, TetId tet) const;
  /// The quality of the tets that do.
  [[nodiscard]] QualityStats quality(const TetMesh& mesh) const;

 private:
  void add(const Step& step);
  void add(VertexId vertex) { is_touched_[vertex.value] = true; }
  std::vector<bool> is_touched_;
};

/// Places on the walls of a stroke: corners, middles of edges, centroids.
struct WallSample {
  Vec3 place;
  double distance;  ///< from the sweep, in length units
};

/// How far the walls of a stroke lie from its sweep, in mean lengths of the walls' edges around, as they are in the
/// end.
struct WallDistance {
  double greatest = 0;
  double mean = 0;  ///< over the samples
};

/// A mesh at one moment of a stroke.
struct Snapshot {
  std::size_t tets = 0;
  QualityStats all, touched;
  std::vector<double> volumes;  ///< of the pieces, largest first
  std::vector<WallSample> walls;
  WallDistance wall;
};

/// One stroke and its maintenance.
struct Measurement {
  bool is_ok = false;
  CutStatistics cut_work;
  MaintainStatistics maintain_work;
  std::size_t input_tets = 0;
  QualityStats input;
  QualityStats neighbourhood;  ///< of the input's tets at and around the places that changed later
  Snapshot cut, after;
  std::uint64_t above_input = 0;  ///< touched tets in the end with an L/r above both 25 and the input's worst
  /// By how much a place on the walls lies further from the sweep than any within a local edge did before maintenance,
  /// in local edges; the greatest of all.
  double wall_added = 0;
  double cut_ms = 0, maintain_ms = 0;  ///< processor time, the best of the runs
  std::string defects;                 ///< as from `new_defects`

  [[nodiscard]] bool is_valid() const { return defects.empty(); }

  [[nodiscard]] double growth() const;
  /// Tets added for each tet that was cut.
  [[nodiscard]] double new_per_cut_tet() const;
  [[nodiscard]] double us_per_cut_tet(double ms) const;
  /// Greatest change of a piece's volume by maintenance, relative; 1 where pieces come or go.
  [[nodiscard]] double volume_change() const;
  [[nodiscard]] double mean_wall_added() const { return after.wall.mean - cut.wall.mean; }
  /// The worst L/r around the cut that maintenance may leave.
  [[nodiscard]] double lr_bound(bool is_cube) const;
};

/// Cuts a mesh, then maintains it, and measures after each. `runs` ≥ 1: the stroke is taken back and made again.
Measurement measure_maintenance(const TetMesh& mesh, const Stroke& stroke, const EngineOptions& options, unsigned runs);

/// The worst L/r of the touched tets after each of some times of maintenance, in ms; the best of `runs`.
std::vector<double> measure_anytime(const TetMesh& mesh, const Stroke& stroke, const EngineOptions& options,
                                    const std::vector<double>& times, unsigned runs);

/// The kinds of defects that came to those of the input, with their counts; empty where the mesh is as valid as it was.
std::string new_defects(const ValidityReport& input, const TetMesh& mesh);

}  // namespace incise::bench
