// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "improve/care.h"
#include "improve/care_lists.h"
#include "improve/edge_collapse.h"
#include "improve/reference.h"
#include "improve/remedies.h"
#include "improve/trial.h"
#include "incise/core/profile.h"
#include "incise/geom/triangle_tree.h"
#include "incise/improve/options.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// Keeps the neighbourhood of cuts fit to simulate: local, worst tets first, within a budget, monotone.
///
/// Every accepted change replaces a few tets by others whose worst L/r is smaller than theirs was, but for thinning out
/// where a cut goes on from an older one, which may cost shape down to L/r 13; stopping at any point leaves a valid and
/// better mesh. Quality is judged at rest; tets that are positive as the mesh stands deformed
/// stay so. Vertices move within what they are part of: interior ones freely, those of a wall or of the skin in their
/// surface, those where surfaces meet along the line, corners not; the volume on either side of every wall is kept.
/// Skin stays close to where the original had it, over all changes. What a budget left undone waits for the next call.
/// Not thread-safe; the result does not depend on threads or clocks.
/// **Source:** Paper §2.5 and §3; M. Wicke et al., "Dynamic local remeshing for elastoplastic simulation", 2010;
/// B. Klingner, J. Shewchuk, "Aggressive tetrahedral mesh improvement", 2007. Differs from the paper: vertices are
/// inserted and removed, and no average decides.
class Maintainer {
 public:
  explicit Maintainer(MaintainOptions options = {}) : options_(options) {}
  /// With other remedies than the usual ones.
  Maintainer(MaintainOptions options, Remedies remedies) : options_(options), remedies_(std::move(remedies)) {}

  /// Skin and sizes of elements are judged by those of a mesh as it stands at rest: the body before the first cut.
  /// Without this call skin is held to where each operation finds it. Cost: O(tets), 30 ns each.
  void set_original(const TetMesh& mesh) { references_.set_original(mesh); }
  /// Begins a stroke: a number may have been used before, by one that was undone.
  void begin_reference(std::uint32_t stroke) { references_.begin(stroke); }
  /// The surface that the walls of a stroke shall stay close to, in the rest shape: what it has swept so far. Each call
  /// gives the triangles of the one before, with others behind them; points by their index. Cost: O(log n) for each
  /// new triangle, all in all.
  void extend_reference(std::uint32_t stroke, std::span<const Vec3> points,
                        std::span<const TriangleTree::Triangle> triangles) {
    references_.extend(stroke, points, triangles);
  }

  /// Takes the surroundings of what the journal's steps from `first_step` on changed into care, but for what is locked:
  /// that waits for a later call. Cost: O(their tets).
  void take_up(const TetMesh& mesh, const Journal& journal, std::size_t first_step, const IsLocked& is_locked = {});
  /// Takes the whole mesh into care. Cost: O(tets).
  void take_up_all(const TetMesh& mesh);

  /// Works on what is in care until it is done, `work_units` are spent (by at most one operation more) or `should_stop`
  /// says so, and appends journal steps. Tets that are locked stay as they are. Calls with one work budget after the
  /// other do the same operations as one call with their sum. Cost: about 0.1 µs per unit.
  MaintainStatistics run(TetMesh& mesh, Journal& journal, std::uint64_t work_units, StageTimes& times,
                         const ShouldStop& should_stop = {}, const IsLocked& is_locked = {});

  /// Whether tets wait for another `run`.
  [[nodiscard]] bool has_work() const;
  /// Drops what is in care: after an undo.
  void forget();

 private:
  [[nodiscard]] bool waits_for_trials() const;
  /// Whether there is something to be done now.
  [[nodiscard]] bool is_due() const { return !heap_.empty() || !crowd_.is_empty(); }
  void take_hopeless(const TetMesh& mesh);
  [[nodiscard]] std::uint64_t changed_at(VertexId v) const;
  [[nodiscard]] bool is_free(const TetMesh& mesh, VertexId v, const IsLocked& is_locked);
  void touch(VertexId v);
  std::vector<VertexId> take_touched(const TetMesh& mesh, const IsLocked& is_locked);
  std::vector<OpenedFace> take_opened(const TetMesh& mesh, const IsLocked& is_locked);
  void take_held(const TetMesh& mesh);
  void hold(TetId tet);
  [[nodiscard]] bool is_locked(TetId tet) const { return *is_locked_ && (*is_locked_)(tet); }
  [[nodiscard]] unsigned nearness(VertexId v) const;
  void add_to_care(VertexId v, unsigned near, std::vector<VertexId>& ring);
  void add_to_ring(VertexId v, std::vector<VertexId>& ring);
  void add_with_neighbours(const TetMesh& mesh, VertexId touched, std::vector<VertexId>& ring);
  void look_for_seam(const TetMesh& mesh, std::vector<VertexId>& ring);
  bool add_older_seam(const TetMesh& mesh, std::uint32_t tag, std::vector<VertexId>& ring);
  void push_stars(const TetMesh& mesh, const std::vector<VertexId>& centres);
  void push(const TetMesh& mesh, TetId tet, unsigned least_near = 0);
  Waiting pop();

  [[nodiscard]] bool has_budget() const;

  void run_step(TetMesh& mesh, Journal& journal, StageTimes& times);
  bool improve_worst(Care& care, StageTimes& times);
  bool thin_out_next(Care& care, StageTimes& times);
  Hopeless* find_trial(const TetMesh& mesh);
  [[nodiscard]] bool is_of_cut(const TetMesh& mesh, TetId tet) const;
  [[nodiscard]] unsigned splits_at(const TetMesh& mesh, TetId tet) const;
  bool try_next(TetMesh& mesh, Journal& journal, StageTimes& times);
  bool try_on(Care& care, TetId tet, unsigned trial);
  void take_born(VertexId vertex);
  void requeue(Care& care);

  MaintainOptions options_;
  const IsLocked* is_locked_ = nullptr;  // of the run in progress
  References references_;
  MaintainStatistics statistics_;  // of the run in progress
  std::vector<Waiting> heap_;
  std::vector<TetId> changed_;
  std::vector<Hopeless> hopeless_;
  std::uint64_t trial_work_ = 0, other_work_ = 0;  // units spent since all was done last
  std::uint64_t time_ = 0, began_ = 0;             // changes so far, and when the stroke began
  ZeroedArray<std::uint64_t> changed_at_;          // the time of the last change at a vertex, by its slot
  Crowd crowd_;
  std::vector<VertexId> touched_;   // by steps of the journal; not taken into care yet, since tets there are locked
  std::vector<OpenedFace> opened_;  // likewise
  std::vector<TetId> held_;         // came up while they were locked
  std::vector<KnownVertex> taken_;  // into care, during this stroke
  std::uint32_t tag_ = 0;           // of this stroke's walls; 0 while there are none
  ZeroedArray<std::uint8_t> is_touched_, is_held_;  // by vertex slot; by tet slot
  bool is_at_seam_ = false;
  std::uint64_t work_units_ = 0;  // of the run in progress
  const ShouldStop* should_stop_ = nullptr;
  ZeroedArray<std::uint32_t> in_care_;    // per vertex slot: 4 · the epoch that took it up + nearness
  ZeroedArray<std::uint32_t> splits_;     // likewise: 8 · epoch + the trials in turn that led to it
  ZeroedArray<std::uint8_t> is_in_ring_;  // scratch of `take_up`, zero between calls
  ZeroedArray<std::uint8_t> is_pushed_;   // scratch of `push_stars`, zero between calls
  std::uint32_t epoch_ = 1;
  StarWalker walker_;
  Remedies remedies_;
  EdgeCollapser collapser_;  // of what is thinned out
  Trial trial_;
};

}  // namespace v0
}  // namespace incise
