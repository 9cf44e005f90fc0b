// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "incise/core/id.h"

namespace incise {
inline namespace v0 {

/// Maintenance without a budget.
inline constexpr std::uint64_t kUnlimitedWork = std::numeric_limits<std::uint64_t>::max();

/// Asked between operations; true ends the maintenance for now. It may be asked again after it returned true, within
/// the same call or by a later one: whoever stops for an event (Ctrl-C) must remember the event. Where a clock decides,
/// a recording keeps the units spent.
using ShouldStop = std::function<bool()>;

/// Tets that a cut under way may make anew, and tets that share a vertex with them: maintenance does not change them.
/// Empty: there are none.
using IsLocked = std::function<bool(TetId)>;

/// What is done to a mesh after a cut.
struct MaintainOptions {
  bool merge = true;    ///< merge short edges (paper, section 2.5)
  bool improve = true;  ///< smooth, swap, and do what else makes the worst tets better (paper, section 3)
  /// Work units per stroke that is cut as a whole, and per step of one that is cut step by step; what is left undone
  /// waits for the next one. One unit is one evaluation of one tet's
  /// quality, about 0.1 µs. The paper's maintenance ignores it.
  std::uint64_t work_units = kUnlimitedWork;
  /// Of the paper's improving alone: its Boundary Laplacian (section 3.4). False to see what it does (Figure 10).
  bool smooth_boundary = true;
};

/// What maintenance did.
struct MaintainStatistics {
  std::uint64_t work_units = 0;         ///< spent
  std::uint64_t collapsed_edges = 0;    ///< vertices merged into a neighbour
  std::uint64_t moved_vertices = 0;     ///< moves, of interior and boundary vertices
  std::uint64_t removed_edges = 0;      ///< edges swapped away: 3-2, 4-4 and larger rings
  std::uint64_t removed_faces = 0;      ///< 2-3 swaps
  std::uint64_t inserted_vertices = 0;  ///< vertices put in where nothing else helped
  std::uint64_t peeled_tets = 0;        ///< flat on a surface, and taken away
  std::uint64_t waiting_tets = 0;       ///< still below the goal and not tried again since; 0 where all is done
  std::int64_t created_tets = 0;        ///< tets after minus tets before

  MaintainStatistics& operator+=(const MaintainStatistics& other);
  /// What a sum has beyond one that it contains; `waiting_tets` stays.
  MaintainStatistics& operator-=(const MaintainStatistics& part);
};

}  // namespace v0
}  // namespace incise
