// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "incise/core/profile.h"
#include "incise/geom/triangle_tree.h"
#include "incise/improve/options.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// Keeps the neighbourhood of cuts fit to simulate: local, worst tets first, within a budget, monotone.
///
/// Every accepted change replaces a few tets by others whose worst L/r is smaller than theirs was. Where a cut goes on
/// from an older one, vertices are thinned out as well, which may cost shape down to L/r 13; stopping at any point
/// leaves a valid and better mesh. Quality is judged at rest; tets that are positive as the mesh stands deformed stay
/// so. Vertices move within what they are part of: interior ones freely, those of a wall or of the skin in their
/// surface, those where surfaces meet along the line, corners not; the volume on either side of every wall is kept.
/// Skin stays close to where it was before the first change of all: `run` follows the journal, and remembers the skin
/// of every place when it changes there first. What a budget left undone waits for the next call. Not thread-safe; the
/// result does not depend on threads or clocks.
/// **Source:** Paper §2.5 and §3; M. Wicke et al., "Dynamic local remeshing for elastoplastic simulation", 2010;
/// B. Klingner, J. Shewchuk, "Aggressive tetrahedral mesh improvement", 2007. Differs from the paper: vertices are
/// inserted and removed, and no average decides.
class Maintainer {
 public:
  /// `options`: what may be done.
  explicit Maintainer(MaintainOptions options = {});
  Maintainer(Maintainer&&) noexcept;
  Maintainer& operator=(Maintainer&&) noexcept;
  ~Maintainer();

  /// Begins a stroke: a number may have been used before, by one that was undone.
  void begin_reference(std::uint32_t stroke);
  /// The surface that the walls of a stroke shall stay close to, in the rest shape: what it has swept so far. Each call
  /// gives the triangles of the one before, with others behind them; points by their index. Cost: O(log n) for each
  /// new triangle, all in all.
  void extend_reference(std::uint32_t stroke, std::span<const Vec3> points,
                        std::span<const TriangleTree::Triangle> triangles);

  /// Queues the surroundings of what the journal's steps from `first_step` on changed. Tets that are locked wait for a
  /// later call. Cost: O(their tets).
  void take_up(const TetMesh& mesh, const Journal& journal, std::size_t first_step, const IsLocked& is_locked = {});
  /// Queues the whole mesh. Cost: O(tets).
  void take_up_all(const TetMesh& mesh);

  /// Works on what is queued until all is done, `work_units` are spent (by at most one operation more) or `should_stop`
  /// returns true, and appends journal steps. Tets that are locked stay as they are. Calls with one work budget after
  /// the other do the same operations as one call with their sum. Cost: about 0.1 µs per unit.
  MaintainStatistics run(TetMesh& mesh, Journal& journal, std::uint64_t work_units, StageTimes& times,
                         const ShouldStop& should_stop = {}, const IsLocked& is_locked = {});

  /// Reads the steps of the journal that `run` would read: they may then be trimmed. Cost: O(steps).
  void follow(const TetMesh& mesh, const Journal& journal);

  /// Whether tets wait for another `run`.
  [[nodiscard]] bool has_work() const;
  /// Empties the queue: after an undo. `position`: how many steps of the journal are still the same.
  void forget(std::size_t position);

 private:
  class Queue;
  std::unique_ptr<Queue> queue_;
};

}  // namespace v0
}  // namespace incise
