// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cut/blade_motion.h"
#include "cut/closed_complex.h"
#include "cut/material_blade.h"
#include "cut/piece_finder.h"
#include "cut/surface_index.h"
#include "cut/twist.h"
#include "incise/core/profile.h"
#include "incise/core/result.h"
#include "incise/cut/options.h"
#include "incise/cut/stroke.h"
#include "incise/mesh/journal.h"
#include "paper/ended_strokes.h"
#include "paper/incision_front.h"
#include "paper/ring.h"
#include "paper/sheet_cut.h"

namespace incise {
inline namespace v0 {

/// Cuts a mesh along strokes as the paper does: its sections 2.2 to 2.4, in every frame.
///
/// What the blade swept since the last frame bisects the edges that it crosses; faces of three collision points are
/// opened where Algorithms 1 and 2 find their vertices dividable, with the points that frames and strokes before have
/// left joined (`IncisionFront`). Where the blade is inside an element nothing comes apart there (§4.5). In a body that
/// moves the blade is located in the elements as they stand (`MaterialBlade`), so that crossings are those of the body
/// as it stands; split points are placed on the same edges at rest. A whole stroke whose sweep meets itself is cut
/// frame by frame, too, as if its blade had come in steps. An edge that turns is divided (`EdgeDivision`). The ends of
/// an edge reach on by `kCoincident` spacings, so that one that ends on an older wall but for rounding meets it. Keeps
/// scratch memory. One mesh at a time; not thread-safe. Source: docs/decisions/0050.
class PaperCutter {
 public:
  /// `threads` in [1, 256] search the mesh; the result does not depend on it.
  explicit PaperCutter(unsigned threads) : sheet_cut_(threads), complex_(templates_) {}

  /// Cuts along a whole stroke, at rest, as one frame, or as many as it has times where its sweep meets itself: up to
  /// two journal steps for each. Walls get `tag`, in [1, 2^31). Appends nothing where the blade misses. Errors:
  /// kBadArgument for a malformed stroke, kOutOfMemory where ids or memory would run out; the mesh is then as before.
  /// Cost: one pass over the mesh for each frame, then O(cut tets · rounds).
  Result<CutStatistics> cut(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                            StageTimes& times);

  /// Puts the blade in place for a stroke that is cut frame by frame; nothing is cut yet. `row`: its edge as the body
  /// stands, at least two finite points; `has_moved`: whether the body stands otherwise than at rest. A blade that
  /// stands where the last stroke ended, its points within 0.05 spacings of a typical edge, goes on with that one; at
  /// rest also where one of the 16 before ended, whose last strips are then cut once more first. Cost: one pass over
  /// the mesh at first, to find its surface.
  void begin(const TetMesh& mesh, const Journal& journal, std::span<const Vec3> row, bool has_moved, std::uint32_t tag);
  /// Cuts on to where the blade is now; `row` has as many points as the first. `direction`: where the edge cuts, unit;
  /// zero: where it has cut so far. Appends to the journal what changed. Errors: kOutOfMemory; the mesh is then as
  /// before the step. Cost: as `cut`, for what the frame adds.
  Result<CutStatistics> step(TetMesh& mesh, Journal& journal, std::span<const Vec3> row, const Vec3& direction,
                             bool has_moved, StageTimes& times);
  /// Ends the stroke where the blade was last. Errors: as `step`.
  Result<CutStatistics> end(TetMesh& mesh, Journal& journal, StageTimes& times);

  /// Where incisions may go on.
  [[nodiscard]] const IncisionFront& front() const { return front_; }
  /// Takes a front, as it was when the mesh was as it is now; forgets the stroke under way, and that the last one may
  /// go on.
  void restore(IncisionFront front);

 private:
  /// What a stroke that is cut frame by frame knows of its blade.
  struct OpenStroke {
    BladeMotion motion;
    MaterialBlade material;
    OwnSheet sheet;
    std::vector<std::shared_ptr<const Strip>> gone_on_from;  // the last of the stroke before, if this one goes on
    EdgeDivision edge;
    std::vector<Vec3> first_row;  // of a stroke at rest that goes on from none
    Ring ring;                    // of the incision that it is of
    std::vector<Vec3> last_row;   // divided
    double spacing = 1.0;
    Vec3 direction = Vec3::Zero();  // of the last frame in a body that moves
    Vec3 course = Vec3::Zero();     // of the front there, at rest; unit
    double gone = 0;                // how far it has: the length of the wound
    bool is_in_material = false, is_last = false;
    bool has_cut = false;
    bool may_go_on = false;      // it has ended, and nothing else has happened since
    bool stands_at_end = false;  // of another one, until it moves
    bool goes_over = false;      // the strips that it goes on from, before it cuts
    std::uint32_t tag = 1;

    [[nodiscard]] std::vector<std::shared_ptr<const Strip>> last_strips() const;
  };

  template <class Work>
  Result<CutStatistics> guarded(TetMesh& mesh, Journal& journal, StageTimes& times, Work&& work);
  Status cut_stroke(const CutContext& context, const Stroke& stroke, std::uint32_t tag);
  Status cut_in_frames(const CutContext& context, const Stroke& stroke, std::uint32_t tag);
  Status end_whole(const CutContext& context, EndedStroke ended);
  Status move_at_rest(const CutContext& context, std::span<const Vec3> row);
  void divide_edge(std::span<const Vec3> row);
  void count_last_sheet(CutStatistics& statistics) const;
  void go_on_from(const EndedStroke& ended);
  [[nodiscard]] bool stands_in_material(const TetMesh& mesh, std::span<const Vec3> row);
  Status end_at_rest(const CutContext& context, EndedStroke ended);
  [[nodiscard]] bool meets_other_walls(const TetMesh& mesh, const Sheet& sheet) const;
  Status cut_at_row(const CutContext& context, std::span<const Vec3> row, const Strip& strip);
  Status go_over(const CutContext& context, std::span<const std::shared_ptr<const Strip>> strips);
  Status close_ring(const CutContext& context);
  void enter_material(const TetMesh& mesh);
  Status step_in_material(const CutContext& context, const std::vector<Vec3>& before);
  void put_in_place(const TetMesh& mesh, const std::vector<Vec3>& row);
  Status cut_to(const CutContext& context, const std::vector<Vec3>& row);
  void hold_where_it_turns_back();
  void note_course(std::span<const SosPoint> row);
  void leave_body(const CutContext& context, const std::vector<Vec3>& row);
  Status follow(const CutContext& context, BladeMotion::Move move);
  [[nodiscard]] std::vector<std::shared_ptr<const Strip>> strips_before(const Strip& strip) const;
  [[nodiscard]] bool meets_any(const Strip& strip, std::span<const std::shared_ptr<const Strip>> strips) const;
  void finish_sheet(const CutContext& context);
  void find_surface(const CutContext& context);
  [[nodiscard]] BladeMotion::Touches touches(const TetMesh& mesh) const;

  SheetCut sheet_cut_;
  IncisionFront front_;
  OpenStroke stroke_;
  EndedStrokes ended_;
  SplitTemplates templates_;
  ClosedComplex complex_;  // of whole tets: those that hold the blade's front
  SurfaceIndex surface_;
  StarWalker walker_;
  PieceFinder finder_;
};

/// Cuts a mesh along one whole stroke, at rest, with no incision to go on from: `PaperCutter::cut`.
Result<CutStatistics> cut_as_paper(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                                   unsigned threads, StageTimes& times);

}  // namespace v0
}  // namespace incise
