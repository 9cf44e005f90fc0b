// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cut/closed_complex.h"
#include "cut/constants.h"
#include "cut/contact_walk.h"
#include "cut/cut_context.h"
#include "cut/front_points.h"
#include "cut/older_walls.h"
#include "cut/rebuild.h"
#include "cut/snapping.h"
#include "cut/strip.h"
#include "cut/strip_crossing.h"
#include "cut/surface_index.h"
#include "cut/wake.h"
#include "incise/core/profile.h"
#include "incise/cut/options.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

/// The cut of one stroke, strip by strip: collision → subdivision → separation (paper, Figure 1, first four boxes).
///
/// After each strip the mesh is cut up to where the strip ends, inside elements; those that the blade is still in are
/// made anew by the next one. Source: docs/internals.md (exact front). Differs from the paper, which cuts whole
/// elements after the fact (its §4.5).
class StrokeCut {
 public:
  explicit StrokeCut(CutOptions options) : options_(options), complex_(templates_), rebuild_(templates_) {}

  /// In a body that moves no step may join two pieces, whatever the blade does: at rest a sheet is finished before it
  /// comes back to what it has cut through.
  void keep_pieces(bool keeps_pieces) {
    keeps_pieces_ = keeps_pieces;
    complex_.set_in_motion(keeps_pieces);
  }
  /// The body has begun to move: `surface` has all walls from now on. Cost: O(walls of the band).
  void enter_material(const TetMesh& mesh) {
    keep_pieces(true);
    surface_.take_in(mesh, [](Side) { return false; });
  }
  /// Starts afresh: the next strip is the first of a sheet. Walls get `tag`. `spacing`: the length of a typical edge.
  void begin(std::uint32_t tag, double spacing);
  /// Finds the mesh's surface ahead of the first touch. Cost: O(tets) once, then O(edits since).
  void prepare(const TetMesh& mesh, const Journal& journal);
  /// Cuts along one more strip, and appends what changed to the journal: at most one step, and one for each round of
  /// bisections of edges that the strip passes through twice.
  /// Errors: kOutOfMemory where ids would run out; the last strip is then not cut.
  /// Cost: O(tets that the strip meets).
  Status advance(const CutContext& context, std::unique_ptr<Strip> strip, const FrontRules& rules);
  /// Settles what the blade has left behind, and lets go of it as far as the cut can no longer see it: its tets are
  /// ordinary ones from then on. `pinned`: masters that are kept all the same. Appends journal steps, as `finish` does
  /// for what is left in the end. Cost: O(masters kept), and that of what is settled.
  void bake(const CutContext& context, const FrontRules& rules, std::span<const std::uint32_t> pinned);
  /// A column of a strip that would close the cut again.
  struct RecrossedColumn {
    std::uint32_t column;
    bool is_apart;  ///< what it would join has come apart: two pieces
    bool is_left;   ///< it would come back to what the blade has left: no harm, but a new sheet
  };
  /// The columns of a strip that would cross edges which the sheet has crossed before, or between tets that have come
  /// apart: there it would close the cut; and those that would come back to what the blade has left. Each once. Adopts
  /// what the strip meets, and changes nothing else. Cost: as `advance` without the rebuild, and that of `PieceFinder`.
  [[nodiscard]] std::vector<RecrossedColumn> recrossed_columns(const TetMesh& mesh, const Strip& strip);
  /// Whether a strip crosses an edge that the sheet has crossed elsewhere and is done with: the two would cancel there.
  /// Crossings nearer than `least_apart` of the edge are one. Adopts what the strip meets.
  [[nodiscard]] bool crosses_own_cut(const CutContext& context, const Strip& strip, double least_apart);
  /// Whether the strip that was last looked at by one of the two above passes through what the blade has left: the
  /// sheet must be finished first, and is an older cut to it.
  [[nodiscard]] bool comes_back(const TetMesh& mesh, const Strip& strip);
  /// Whether two fans of tets touch along an edge beside which two pieces meet, so that no face may be left joined
  /// there: the sheet must be finished, which parts such edges.
  [[nodiscard]] bool must_finish() const { return must_finish_; }
  /// Whether fans of tets touch along an edge of the cut: no blade may pass before `finish` has parted them. Cost: O(1)
  /// where no step has left such edges.
  [[nodiscard]] bool is_pinched(const TetMesh& mesh);
  /// The sheet and its band as they stand, so that a stroke may go on once they were finished.
  class Pause;
  [[nodiscard]] std::shared_ptr<const Pause> pause() const;
  /// Goes on from there; `mesh` must be as it was then, but for current positions. Walls get `tag` from now on.
  /// Cost: O(band + strips).
  void go_on(const Pause& pause, const TetMesh& mesh, std::uint32_t tag);
  /// Ends the sheet: what it cut stays as it is. Repairs what was left joined for the time being.
  void finish(const CutContext& context, const FrontRules& rules);
  /// Parts the edges of some walls along which two fans of tets touch, in a step of its own. Cost: O(walls).
  void part_edges(const CutContext& context, std::span<const Side> walls);
  /// Forgets a sheet whose cut was taken back.
  void forget();

  /// Whether a surface meets the body at rest. Cost: the cells of the surface index that it passes through.
  [[nodiscard]] bool touches(const TetMesh& mesh, const SweptSurface& surface) const;
  [[nodiscard]] const OwnSheet& sheet() const { return sheet_; }
  /// Whether a live tet has a vertex of the band that is kept: nobody else may change it.
  [[nodiscard]] bool is_busy(const TetMesh& mesh, TetId tet) const {
    return complex_.find(tet) != Master::kNone || complex_.is_held(mesh, tet);
  }
  [[nodiscard]] ClosedComplex& complex() { return complex_; }
  [[nodiscard]] const ClosedComplex& complex() const { return complex_; }
  [[nodiscard]] const SurfaceIndex& surface() const { return surface_; }
  /// The walls that are not of the sheet under way; the surface must be up to date (`prepare`).
  [[nodiscard]] OlderWalls older_walls(const TetMesh& mesh) const { return {mesh, surface_, complex_}; }

 private:
  void collide(const CutContext& context, const Strip& strip);
  void look(const CutContext& context, const Strip& strip);
  [[nodiscard]] bool is_own_wall(const TetMesh& mesh, Side side) const;
  bool bisect(const CutContext& context, const std::vector<BetweenCrossings>& between);
  void flag(const TetMesh& mesh, const Strip& strip);
  /// Where a strip crosses an edge, once.
  struct Crossed {
    std::uint32_t edge;
    VertexId a, b;  ///< its ends: indices are used again
    double t;
    Vec3 normal;
  };
  void cross(const TetMesh& mesh, const Crossed& crossed);
  void take_waiting(const TetMesh& mesh);
  [[nodiscard]] bool is_whole_around(const TetMesh& mesh, std::uint32_t edge) const;
  [[nodiscard]] bool is_entered(const TetMesh& mesh, const Strip& strip, const Master& master) const;
  bool find_reached(const TetMesh& mesh, const Strip& strip);
  [[nodiscard]] bool is_reached(std::uint32_t edge) const;
  [[nodiscard]] bool is_graze(const TetMesh& mesh, const Strip& strip, const StripCrossing& crossing) const;
  void refresh_around(std::uint32_t edge);
  [[nodiscard]] bool is_left(const StripCrossing& crossing) const;
  template <class Visit>
  void for_each_left(const TetMesh& mesh, const Strip& strip, Visit&& visit);
  [[nodiscard]] std::vector<bool> find_apart(const TetMesh& mesh, std::span<const StripCrossing> crossings);
  void place_front(const TetMesh& mesh, std::span<const std::uint32_t> masters, const FrontRules& given,
                   CutStatistics& statistics);
  void count_cut(CutStatistics& statistics);
  void rebuild(const CutContext& context, bool closes_pinched);
  void let_go_of_older_cut(const TetMesh& mesh);
  [[nodiscard]] bool is_idle_cone(const TetMesh& mesh, const Master& master) const;
  bool make_idle_cones_whole(const TetMesh& mesh);
  void bake_behind(const CutContext& context, const FrontRules& rules, std::span<const std::uint32_t> pinned);
  void settle(const CutContext& context, const FrontRules& rules);
  [[nodiscard]] bool may_let_go(std::uint32_t edge) const;
  [[nodiscard]] bool ends_at_older_cut(const OlderWalls& older, std::uint32_t index, double scale) const;
  void settle_front(const CutContext& context, const FrontRules& rules);
  [[nodiscard]] SnapRules snap_rules(const TetMesh& mesh);
  void choose_on(const TetMesh& mesh, std::span<const std::uint32_t> masters, const SnapRules& rules,
                 CutStatistics& statistics);
  void land(const CutContext& context);
  [[nodiscard]] double snap() const { return options_.snap; }
  [[nodiscard]] double beside() const { return snap() > 0 ? kBesideWall : kBesideExactly; }

  CutOptions options_;
  SplitTemplates templates_;
  ClosedComplex complex_;
  OwnSheet sheet_;
  SurfaceIndex surface_;
  ContactWalk walk_;
  StripCrossings crossings_;
  SnapScratch snapping_;
  std::vector<OnVertex> on_;  // chosen so far
  Rebuild rebuild_;
  StarWalker walker_;
  PieceFinder pieces_;
  Wake wake_;
  SideSigns left_sides_;
  const std::vector<StripCrossing>* crossed_ = nullptr;  // of the current strip
  const std::vector<std::uint32_t>* met_ = nullptr;      // likewise
  const Strip* looked_at_ = nullptr;                     // the strip that both are of, where the mesh is still the same
  std::vector<bool> reached_;     // by master: through faces, from where the current strip itself is
  std::vector<Crossed> waiting_;  // crossings of what reaches on that nothing has reached yet
  std::vector<Side> pinched_;     // walls beside edges to be parted once the sheet is finished
  double spacing_ = 0.0;
  bool must_finish_ = false, keeps_pieces_ = false;
  bool has_let_go_ = false;  // masters, whose walls the surface index is to take in
  StrokeTags tags_;
  std::uint32_t step_ = 0;
  std::uint32_t first_look_ = 0;  // the first of the steps that look at the current strip
};

class StrokeCut::Pause {
 private:
  friend class StrokeCut;
  ClosedComplex::Image complex_;
  OwnSheet sheet_;
  ContactWalk::Memory walk_;
  std::vector<VertexId> coincident_;
  std::vector<OnVertex> on_;
  std::vector<Crossed> waiting_;
  std::vector<Side> pinched_;
  double spacing_ = 0.0;
  bool must_finish_ = false, keeps_pieces_ = false;
  std::uint32_t first_tag_ = 1;
};

}  // namespace v0
}  // namespace incise
