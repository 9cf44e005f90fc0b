// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cut/blade_motion.h"
#include "cut/cut_context.h"
#include "cut/material_blade.h"
#include "cut/piece_finder.h"
#include "cut/stroke_cut.h"
#include "cut/twist.h"
#include "incise/core/profile.h"
#include "incise/core/result.h"
#include "incise/cut/options.h"
#include "incise/cut/stroke.h"
#include "incise/mesh/journal.h"

namespace incise {
inline namespace v0 {

/// Cuts a mesh along strokes, in the profile incise: the exact counterpart of the paper's sections 2.2 to 2.4. What
/// the profile paper does is `cut_as_paper`.
///
/// Keeps scratch memory and split templates between strokes. One mesh at a time; not thread-safe.
class Cutter {
 public:
  explicit Cutter(CutOptions options);

  /// Cuts along the whole stroke and appends the journal steps of each part of the sweep that does not meet itself.
  ///
  /// Cuts up to where the blade stops, inside elements. Walls get `tag`, which must be in [1, 2^31). Appends nothing
  /// where the blade misses.
  /// Errors: kBadArgument for a malformed stroke, kOutOfMemory where the mesh would exceed its id range; the mesh is
  /// then as before. Cost: one pass over the mesh at first, then O(cut tets).
  Result<CutStatistics> cut(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                            StageTimes& times);

  /// Whether the cut of a whole stroke ends or begins inside the body: others may go on from there, or it goes on from
  /// others. Such a stroke is to be cut by `cut_to_end`. `stroke` must pass `check`. Cost: that of sweeping it, and one
  /// pass over the mesh at first.
  [[nodiscard]] bool leaves_front(const TetMesh& mesh, const Journal& journal, const Stroke& stroke);
  /// Cuts along a whole stroke up to its end, which `end` makes, after `pause`: as one sheet in a body without cuts,
  /// else as if its blade came in steps, which find older cuts. Errors: as `cut`.
  Result<CutStatistics> cut_to_end(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                                   StageTimes& times);
  /// Puts the blade in place for a stroke that is cut step by step. `row`: its edge as the body
  /// stands, at least two finite points; `has_moved`: whether the body stands otherwise than at rest. Cost: one pass
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
  /// spacings of where this has taken the front. `first_step` as for `go_on`; nothing changes, but that undone steps
  /// are lost. Cost: O(points) at rest, else as `go_on`.
  [[nodiscard]] bool may_go_on(TetMesh& mesh, Journal& journal, const Pause& pause, std::size_t first_step,
                               std::span<const Vec3> row, bool has_moved);
  /// Begins a stroke that goes on from a paused one: what the steps of the journal from `first_step` on did to end that
  /// is taken back, by new steps. The journal must be as that stroke left it. `row`: where the blade stands now, as
  /// `may_go_on` has allowed it. From then on both are one cut; walls get `tag`, the next one after those of the
  /// strokes before. Returns false, with nothing changed, where that would join two pieces, and where memory runs out:
  /// there `begin`. Cost: O(those steps + band + strips), and that of `PieceFinder`.
  bool go_on(TetMesh& mesh, Journal& journal, const Pause& pause, std::size_t first_step, std::span<const Vec3> row,
             bool has_moved, std::uint32_t tag);
  /// As `go_on` at rest where that alone would join pieces, since the last stroke has ended at an older wall: the blade
  /// moves along `rows`, of which the first is where it stands, at once. Returns none, with nothing changed, where
  /// pieces that are apart would still be joined, and if it `ends` there, once it has ended: then the blade has to get
  /// on, or to begin anew. `end` is left to the caller. Cost: twice that of
  /// `go_on` and of the steps, and `KeptApart`. Source: ours (docs/decisions/0169).
  std::optional<CutStatistics> go_on_through(TetMesh& mesh, Journal& journal, const Pause& pause,
                                             std::size_t first_step, std::span<const std::vector<Vec3>> rows, bool ends,
                                             std::uint32_t tag, StageTimes& times);
  /// Has `between_sheets` called within `step` and `end` wherever a sheet of the stroke is finished and another one
  /// starts, since the blade has come back to what it cut: the mesh may be maintained there. It must not throw. Empty:
  /// nothing is called.
  void call_between_sheets(std::function<void()> between_sheets) { between_sheets_ = std::move(between_sheets); }
  /// Looks at the body: its surface, and how long its edges are, by which all strokes through it go while it moves. The
  /// first stroke would do it otherwise. Cost: O(tets), 9 ns each.
  void prepare(const TetMesh& mesh, const Journal& journal);
  /// Forgets a stroke whose steps were taken back.
  void forget() { stroke_cut_.forget(); }
  /// Whether a live tet lies in the band around the front of the stroke under way, or has a vertex of it: nobody else
  /// may change it. Cost: O(1).
  [[nodiscard]] bool is_busy(const TetMesh& mesh, TetId tet) const { return stroke_cut_.is_busy(mesh, tet); }
  /// What the stroke has swept at rest, so far.
  [[nodiscard]] const SweptTriangles& swept() const { return stroke_.swept; }

 private:
  /// What a stroke that is cut step by step knows of its blade.
  struct OpenStroke {
    enum class AtFront : std::uint8_t { kUnknown, kNo, kYes };

    BladeMotion motion;
    SweptTriangles swept;
    SweptTriangles joints;  // where one sheet ends and another one begins
    MaterialBlade material;
    EdgeDivision edge;
    std::vector<Vec3> given_row;  // the last one
    std::vector<Vec3> last_row;   // the same, divided
    double spacing = 1.0;
    Vec3 direction = Vec3::Zero();  // of the last step in the material
    bool is_in_material = false, is_last = false;
    bool has_ended = false;                   // a short stroke in the material
    bool has_left = false;                    // the body, after the last sheet
    AtFront is_at_front = AtFront::kUnknown;  // where the stroke began: at the front of older cuts
    std::uint32_t tag = 1;
  };

  [[nodiscard]] double spacing_of(const TetMesh& mesh, bool has_moved);
  void forget_tried(TetMesh& mesh, Journal& journal, std::size_t end) noexcept;
  bool resume(TetMesh& mesh, Journal& journal, const Pause& pause, std::size_t first_step, bool has_moved,
              std::uint32_t tag);
  bool take_end_back(TetMesh& mesh, Journal& journal, std::size_t first_step);
  Result<CutStatistics> go_on_along(TetMesh& mesh, Journal& journal, const Pause& pause, std::size_t first_step,
                                    std::span<const std::vector<Vec3>> rows, std::uint32_t tag, StageTimes& times);
  void take_up(const TetMesh& mesh, const Journal& journal, const Pause& pause, bool has_moved, std::uint32_t tag);
  [[nodiscard]] std::uint32_t pieces_at(const TetMesh& mesh, const Journal& journal, std::size_t first,
                                        std::size_t last);
  template <class Work>
  Result<CutStatistics> guarded(TetMesh& mesh, Journal& journal, StageTimes& times, Work&& work);
  [[nodiscard]] BladeMotion::Touches touches(const TetMesh& mesh) const;
  void enter_material(const TetMesh& mesh);
  Status move_at_rest(const CutContext& context, std::span<const Vec3> row);
  Status end_at_rest(const CutContext& context);
  Status end_sheets(const CutContext& context);
  void divide_edge(std::span<const Vec3> row);
  Status step_in_material(const CutContext& context, const std::vector<Vec3>& before, const Vec3& direction);
  Status step_from_far(const CutContext& context, const std::vector<Vec3>& before, const Vec3& direction);
  void put_in_place(const TetMesh& mesh, const Journal& journal, const std::vector<Vec3>& row);
  Status cut_to(const CutContext& context, const std::vector<Vec3>& row, const Vec3& direction, bool ends = false);
  void leave_body(const CutContext& context, const std::vector<Vec3>& row);
  BladeMotion::Proposal propose(const CutContext& context, const std::vector<Vec3>& row, const Vec3& direction);
  bool hold_where_it_closes(const TetMesh& mesh, const BladeMotion::Proposal& proposal);
  [[nodiscard]] Surroundings surroundings(const CutContext& context);
  [[nodiscard]] bool goes_on_shortly(const TetMesh& mesh, std::span<const Vec3> row);
  [[nodiscard]] bool lies_at_front(const TetMesh& mesh, std::span<const Vec3> start, std::span<const Vec3> row) const;
  double carry(const CutContext& context, std::span<const Vec3> from, std::span<const Vec3> to);
  double carry_along(const CutContext& context, std::span<const Vec3> row);
  Status end_shortly(const CutContext& context, std::span<const Vec3> row);
  Status end_in_point(const CutContext& context);
  Status follow_to(const CutContext& context, std::span<const Vec3> row);
  [[nodiscard]] std::vector<Vec3> drawn_back(std::vector<Vec3> row, std::span<const Vec3> to) const;
  void finish_sheet(const CutContext& context);
  void cut_bridges(const CutContext& context, const SweptTriangles& swept, const SweptTriangles& joints,
                   std::uint32_t tag);
  void note_joint(std::span<const Vec3> row);
  Status follow(const CutContext& context, BladeMotion::Move move);
  Status follow_round(const CutContext& context, BladeMotion::Move move);
  bool comes_back(const CutContext& context, const Strip& strip);
  void go_on_from_front(const CutContext& context);
  [[nodiscard]] FrontRules rules() const;
  Status cut_stroke(const CutContext& context, const Stroke& stroke, std::uint32_t tag);
  Status cut_in_steps(const CutContext& context, const Stroke& stroke, std::uint32_t tag);
  Status lay_rows(const CutContext& context, const Stroke& stroke);
  Status lay_at_once(const CutContext& context, const Stroke& stroke, SweptSurface surface);
  Status cut_strip(const CutContext& context, SweptSurface part, std::uint32_t tag);

  CutOptions options_;
  StrokeCut stroke_cut_;
  OpenStroke stroke_;
  double body_spacing_ = 0;  // of the body as it was first seen; 0: it was not yet
  PieceFinder finder_;
  std::function<void()> between_sheets_;
};

class Cutter::Pause {
 public:
  std::shared_ptr<const StrokeCut::Pause> cut;
  OpenStroke stroke;

  /// Whether the body stood at rest all the while.
  [[nodiscard]] bool is_at_rest() const { return !stroke.is_in_material; }
  /// Whether a blade that cuts at rest, with as many points, is still about where this stroke stopped: one that has to
  /// get on before it may go on from there waits so long.
  [[nodiscard]] bool is_near(std::span<const Vec3> row) const;
  /// Whether a blade is noticeably further from there than it was: only then it may be through where it was not. So one
  /// that trembles or rests is asked 20 times at most.
  [[nodiscard]] bool has_got_on(std::span<const Vec3> from, std::span<const Vec3> to) const;
};

}  // namespace v0
}  // namespace incise
