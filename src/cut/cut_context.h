// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>

#include "incise/core/profile.h"
#include "incise/core/result.h"
#include "incise/cut/options.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// What every stage of a cut works on: the mesh, the journal that its steps are appended to, and the counts and times
/// of the call, which it adds to.
struct CutContext {
  TetMesh& mesh;
  Journal& journal;
  StageTimes& times;
  CutStatistics& statistics;
};

/// What `count` has become more since it was `before`; less than zero where it is fewer.
inline std::int64_t growth(std::uint64_t before, std::uint64_t count) {
  return static_cast<std::int64_t>(count) - static_cast<std::int64_t>(before);
}

/// Runs `work` on such a context. Where it fails, or memory runs out, the steps that it appended are taken back.
template <class Work>
Result<CutStatistics> cut_or_take_back(TetMesh& mesh, Journal& journal, StageTimes& times, Work&& work) {
  const std::size_t start = journal.position();
  CutStatistics statistics;
  Status status;
  try {
    status = work(CutContext{mesh, journal, times, statistics});
  } catch (const std::bad_alloc&) {
    status = Error{ErrorCode::kOutOfMemory, "not enough memory to cut; use a coarser mesh", {}};
  }
  if (status) return statistics;
  journal.take_back(mesh, start);
  return status.error();
}

}  // namespace v0
}  // namespace incise
