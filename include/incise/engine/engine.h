// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "incise/core/log.h"
#include "incise/core/profile.h"
#include "incise/core/result.h"
#include "incise/cut/cutter.h"
#include "incise/cut/options.h"
#include "incise/cut/stroke.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::inline v0 {

struct EngineOptions {
  CutOptions cut;
  LogSink log;           ///< hears what a stroke could not do as asked
  unsigned threads = 1;  ///< that search the mesh, in [1, 256]; the result does not depend on it
};

/// What one stroke did.
struct StrokeReport {
  CutStatistics cut;
  StageTimes times;             ///< summed over the stroke
  std::vector<double> step_ms;  ///< one entry: a stroke is cut as a whole once its sweep is known
  std::uint32_t stroke = 0;     ///< its number, from 1: the tag of the walls that it made
};

/// Owns a mesh and orders the pipeline on it: collision → subdivide → separate (paper, Figure 1).
///
/// One writer; const reads from any thread between calls. A call either takes effect as a whole or not at all.
class Engine {
 public:
  /// Takes the mesh. Errors: kBadArgument for options out of range.
  static Result<Engine> create(TetMesh mesh, EngineOptions options = {});

  [[nodiscard]] const TetMesh& mesh() const { return mesh_; }
  [[nodiscard]] const Journal& journal() const { return journal_; }
  [[nodiscard]] const EngineOptions& options() const { return options_; }
  /// Strokes applied so far (undone ones not counted).
  [[nodiscard]] std::uint32_t stroke_count() const { return static_cast<std::uint32_t>(stroke_ends_.size()); }

  /// Cuts along the whole stroke. A blade that misses changes nothing and is no error.
  /// Errors: kBadArgument for a malformed stroke; kOutOfMemory where ids run out; the mesh is then unchanged.
  /// Cost: O(tets) to find the first contact, then O(cut tets).
  Result<StrokeReport> cut(const Stroke& stroke);

  /// Takes the last stroke back, bit for bit. Returns false where there is none. Cost: O(its edits).
  bool undo();
  /// Applies the stroke that was last taken back. Returns false where there is none.
  bool redo();

 private:
  Engine(TetMesh mesh, EngineOptions options);

  TetMesh mesh_;
  Journal journal_;
  EngineOptions options_;
  Cutter cutter_;
  std::vector<std::size_t> stroke_ends_;  // journal position after each stroke
  std::vector<std::size_t> undone_ends_;  // of strokes that redo would apply, last first
};

}  // namespace incise::inline v0
