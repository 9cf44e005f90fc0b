// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "incise/core/profile.h"
#include "incise/core/result.h"
#include "incise/cut/options.h"
#include "incise/cut/stroke.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// Cuts a mesh along strokes, in the profile incise: the exact counterpart of the paper's sections 2.2 to 2.4.
/// `cut_as_paper` does what the profile paper does.
///
/// Keeps scratch memory and split templates between strokes. One mesh at a time; not thread-safe.
class Cutter {
 public:
  /// `options` as `Engine::create` accepts them.
  explicit Cutter(CutOptions options);
  Cutter(Cutter&&) noexcept;
  Cutter& operator=(Cutter&&) noexcept;
  ~Cutter();

  /// Cuts along the whole stroke and appends the journal steps of each part of the sweep that does not meet itself.
  ///
  /// Cuts up to where the blade stops, inside elements. Walls get `tag`, which must be in [1, 2^31). Appends nothing
  /// where the blade misses.
  /// Errors: kBadArgument for a malformed stroke, kOutOfMemory where the mesh would exceed its id range; the mesh is
  /// then as before. Cost: one pass over the mesh at first, then O(cut tets).
  Result<CutStatistics> cut(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                            StageTimes& times);

  /// Puts the blade in place for a stroke that is cut step by step. `row`: the blade's edge as the body stands, at
  /// least two finite points; `has_moved`: whether the body stands otherwise than at rest. Cost: one pass
  /// over the mesh at first, to find its surface.
  void begin(const TetMesh& mesh, const Journal& journal, std::span<const Vec3> row, bool has_moved, std::uint32_t tag);
  /// Cuts on to where the blade is now; `row` has as many points as the first. `direction`: where the edge cuts, unit;
  /// zero: where it has cut so far. Appends to the journal what changed.
  /// Errors: kOutOfMemory where ids run out; the mesh is then as before the step. Cost: O(tets that the blade touches).
  Result<CutStatistics> step(TetMesh& mesh, Journal& journal, std::span<const Vec3> row, const Vec3& direction,
                             bool has_moved, StageTimes& times);
  /// Ends the stroke where the blade was last. Errors: as `step`.
  Result<CutStatistics> end(TetMesh& mesh, Journal& journal, StageTimes& times);
  /// A stroke as it stands before its end: its blade, its sheet, and the band around its front.
  class Pause;
  /// The stroke under way, so that a stroke to come may go on from it. To be called before `end`. Cost: O(band +
  /// strips).
  [[nodiscard]] std::shared_ptr<const Pause> pause(const TetMesh& mesh) const;
  /// Whether a blade stands where that of a paused stroke would, so that its stroke may go on from that one: it has the
  /// same number of points, each within 0.05 spacings; in a body that has moved those in tissue are within 0.05
  /// spacings of where this has taken the front. `first_step` as for `go_on`. Only undone steps are lost. Cost:
  /// O(points) at rest, else as `go_on`.
  [[nodiscard]] bool may_go_on(TetMesh& mesh, Journal& journal, const Pause& pause, std::size_t first_step,
                               std::span<const Vec3> row, bool has_moved);
  /// Begins a stroke that goes on from a paused one: what the steps of the journal from `first_step` on did to end that
  /// is taken back, by new steps. The journal must be as that stroke left it. From then on both are one cut;
  /// walls get `tag`, the next one after those of the strokes before. Returns false, with nothing changed, where that
  /// would join two pieces, and where memory runs out: there `begin`. Cost: O(those steps + band + strips), and that of
  /// `PieceFinder`.
  bool go_on(TetMesh& mesh, Journal& journal, const Pause& pause, std::size_t first_step, bool has_moved,
             std::uint32_t tag);
  /// Sets a function that `step` and `end` call wherever a sheet of the stroke is finished and another one starts,
  /// because the blade has come back to what it cut: the mesh may be maintained there. It must not throw; empty:
  /// nothing is called.
  void call_between_sheets(std::function<void()> between_sheets);
  /// Forgets a stroke whose steps were taken back.
  void forget();
  /// Whether a live tet lies in the band around the front of the stroke under way, or shares a vertex with it: only the
  /// cutter may change such a tet. Cost: O(1).
  [[nodiscard]] bool is_busy(const TetMesh& mesh, TetId tet) const;
  /// What the stroke has swept at rest, so far.
  [[nodiscard]] const SweptTriangles& swept() const;

 private:
  class Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace v0
}  // namespace incise
