// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "incise/core/profile.h"
#include "incise/core/result.h"
#include "incise/cut/options.h"
#include "incise/cut/stroke.h"
#include "incise/mesh/journal.h"

namespace incise::inline v0 {

/// Cuts a mesh along strokes: the paper's sections 2.2 to 2.4, or their exact counterpart (see `Profile`).
///
/// Keeps scratch memory and split templates between strokes. One mesh at a time; not thread-safe.
class Cutter {
 public:
  /// `threads` in [1, 256] search the mesh; the result does not depend on it.
  explicit Cutter(CutOptions options, unsigned threads = 1);
  Cutter(Cutter&&) noexcept;
  Cutter& operator=(Cutter&&) noexcept;
  ~Cutter();

  /// Cuts along the whole stroke and appends one journal step per part of the sweep that does not meet itself.
  ///
  /// Where the blade stops inside the body the cut ends at the last tets that it has crossed completely. Walls get
  /// `tag`, which must be in [1, 2^31). Appends nothing where the blade misses.
  /// Errors: kBadArgument for a malformed stroke, kOutOfMemory where the mesh would exceed its id range; the mesh is
  /// then as before. Cost: one pass over the mesh per part, then O(cut tets).
  Result<CutStatistics> cut(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                            StageTimes& times);

 private:
  class Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace incise::inline v0
