// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "incise/core/result.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/star.h"
#include "incise/mesh/validate.h"

namespace incise {
inline namespace v0 {

/// Looks at the mesh as the steps from `first_step` on left it; an error has them taken back.
using StepCheck = std::function<Status(const TetMesh& mesh, const Journal& journal, std::size_t first_step)>;

/// Checks the validity contract where steps touched the mesh: what `validate` asks for on its level kGeometry, except
/// for live counts, duplicate tets and the total volume. It asks this of the touched tets and vertices, of the corners
/// of these tets, and the sign of the volume of tets at moved vertices.
///
/// The input's own defects are passed over: tets that were flat at load, and, where the input touched itself, what is
/// asked of edges and of whole stars. A `StepCheck`; a copy has scratch of its own. Not thread-safe.
/// Errors: kInternal names the first violation. Cost: O(tets at the corners of those that were touched).
class TouchedCheck {
  struct Corner {
    VertexId vertex;
    TetId tet;
  };

 public:
  /// Looks at what the steps from `first_step` on touched.
  Status operator()(const TetMesh& mesh, const Journal& journal, std::size_t first_step);

 private:
  void collect(const TetMesh& mesh, const Journal& journal, std::size_t first_step);
  void add(const TetMesh& mesh, TetId tet);
  void add_neighbours(const TetMesh& mesh, const GoneTet& gone);
  void add(const TetMesh& mesh, VertexId vertex);
  void forget();
  [[nodiscard]] static Status check_tet(const TetMesh& mesh, TetId tet);
  Status check_vertex(const TetMesh& mesh, VertexId vertex, std::span<const Corner> corners);
  Status check_star(const TetMesh& mesh, VertexId vertex, const std::vector<TetId>& star);
  Status check_moved(const TetMesh& mesh, const Journal& journal, std::size_t first_step);
  Status check_corners(const TetMesh& mesh);

  std::vector<TetId> tets_;                         // touched and live, each once
  std::vector<VertexId> vertices_;                  // likewise, and those at the tets
  std::vector<Corner> corners_;                     // of the tets, by vertex
  ZeroedArray<std::uint8_t> has_tet_, has_vertex_;  // zero between calls
  StarWalker walker_;
  std::vector<VertexId> ends_;                  // of the boundary sides at a vertex: their other corners
  std::vector<std::array<VertexId, 2>> faces_;  // at a vertex, the lowest of theirs: their other corners
};

/// What an engine asks of its steps where nobody chooses: `TouchedCheck` in builds with assertions (the preset `dev`
/// and those on top of it), nothing in others.
[[nodiscard]] StepCheck default_step_check();

}  // namespace v0
}  // namespace incise
