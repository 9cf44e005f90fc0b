// SPDX-License-Identifier: Apache-2.0
// The profile paper: what the blade swept since the last frame is cut by bisection and Algorithms 1 and 2
// (docs/internals.md, 3.12).
#include "paper/paper_cut.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <utility>

#include "cut/blade_constants.h"
#include "cut/constants.h"
#include "cut/far_blade.h"
#include "cut/open_border.h"
#include "cut/spacing.h"
#include "incise/geom/closest.h"
#include "incise/mesh/bounds.h"
#include "paper/constants.h"
#include "paper/contact.h"

namespace incise {
inline namespace v0 {

namespace {

/// An edge whose ends reach on by a margin: one that ends on an older wall, but for rounding, meets it. Not that of a
/// ring.
std::vector<Vec3> with_margin(std::span<const Vec3> row, double margin) {
  std::vector<Vec3> wide(row.begin(), row.end());
  if (row.front() == row.back()) return wide;
  const auto reach_on = [margin](Vec3& end, const Vec3& inner) {
    const double length = (end - inner).norm();
    if (length > 0) end += margin / length * (end - inner);
  };
  reach_on(wide.front(), row[1]);
  reach_on(wide.back(), row[row.size() - 2]);
  return wide;
}

Stroke with_margin(Stroke stroke, double margin) {
  for (auto& row : stroke.edges) row = with_margin(row, margin);
  return stroke;
}

/// Whether a blade that stands where a stroke has ended goes back over what that has swept, in its slit.
bool goes_back(const EndedStroke& ended, std::span<const Vec3> to, double spacing) {
  const auto is_in_slit = [&](const Vec3& point) {
    for (const auto& strip : ended.strips) {
      const auto hit = strip->sheet.tree().closest(point, kSlitShare * spacing);
      if (!hit.is_valid()) continue;
      bool is_at_front = false;
      for (std::size_t c = 0; c + 1 < ended.row.size(); ++c) {
        const Vec3 &a = ended.row[c], &b = ended.row[c + 1];
        is_at_front |= closest_on_triangle(hit.point, a, b, b).distance2 <= std::pow(kStandsStill * spacing, 2);
      }
      if (!is_at_front) return true;
    }
    return false;
  };
  return std::all_of(to.begin(), to.end(), is_in_slit);
}

/// How a whole stroke has ended.
EndedStroke ended_at(const SweptSurface& surface, EdgeDivision edge, double spacing) {
  EndedStroke ended;
  std::vector<SosPoint> front;
  for (const std::uint32_t point : surface.front) {
    front.push_back(surface.points[point]);
    ended.row.push_back(front.back().position);
  }
  ended.motion.begin_at(std::move(front), kFirstBladeKey + surface.points.size(), spacing);
  ended.edge = std::move(edge);
  ended.strips = {
      std::make_shared<Strip>(last_part(surface, kStripsReach * spacing), std::vector<std::array<std::uint64_t, 2>>())};
  return ended;
}

}  // namespace

/// Runs some work; where it fails, what it did is taken back.
template <class Work>
Result<CutStatistics> PaperCutter::guarded(TetMesh& mesh, Journal& journal, StageTimes& times, Work&& work) {
  const IncisionFront before = front_;
  auto cut = cut_or_take_back(mesh, journal, times, std::forward<Work>(work));
  if (!cut) restore(before);
  return cut;
}

void PaperCutter::restore(IncisionFront front) {
  front_ = std::move(front);
  stroke_.may_go_on = false;
  ended_.clear();
  complex_.clear();
  surface_.forget();
}

/// The strips that the blade laid last, within `kStripsReach` elements of travel, those of a stroke that this one goes
/// on from among them; oldest first.
std::vector<std::shared_ptr<const Strip>> PaperCutter::OpenStroke::last_strips() const {
  const double from = sheet.travel() - kStripsReach * spacing;
  std::vector<std::shared_ptr<const Strip>> last;
  if (!gone_on_from.empty()) {
    const double before = gone_on_from.back()->travel;
    std::copy_if(gone_on_from.begin(), gone_on_from.end(), std::back_inserter(last),
                 [&](const auto& strip) { return strip->travel - before > from; });
  }
  std::copy_if(sheet.strips().begin(), sheet.strips().end(), std::back_inserter(last),
               [&](const auto& strip) { return strip->travel > from; });
  return last;
}

// --- a stroke as a whole

Result<CutStatistics> PaperCutter::cut(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                                       StageTimes& times) {
  if (Status status = check(stroke); !status) return status.error();
  return guarded(mesh, journal, times, [&](const CutContext& context) {
    context.statistics.steps = stroke.times.size() - 1;
    Status status = cut_stroke(context, stroke, tag);
    front_.leave_lips(context.mesh, walker_);
    return status;
  });
}

/// As one frame, or, where the sweep lies in many folds or meets itself, or goes on from where another stroke ended, in
/// as many as the stroke has.
Status PaperCutter::cut_stroke(const CutContext& context, const Stroke& stroke, std::uint32_t tag) {
  const double spacing = typical_spacing(context.mesh), twist = kTwist * spacing;
  const Stroke wide = with_margin(stroke, kCoincident * spacing), divided = with_divided_edge(wide, twist);
  const SweptSurface surface = sweep(divided, kOwnSlit * spacing);
  if (surface.triangles.empty()) return {};
  const double least = kCoincident * spacing;
  const EndedStroke* ended = ended_.find(wide.edges.front(), kStandsWithin * spacing);
  const bool goes_on = ended != nullptr && !goes_back(*ended, wide.edges[1], spacing);
  if (goes_on || count_sharp_turns(divided, least) > kMostTurns || meets_itself(surface, least)) {
    return cut_in_frames(context, stroke, tag);
  }
  stroke_ = OpenStroke();
  stroke_.tag = tag;
  stroke_.spacing = spacing;
  front_.begin_sheet();
  const Strip whole(surface, {});
  Status status = sheet_cut_.cut(context, SheetSoFar(whole), tag, front_);
  context.statistics.latent_faces += sheet_cut_.latent_faces();
  ++context.statistics.sheets;
  if (status) status = cut_at_row(context, divided.edges.front(), whole);
  if (status) status = end_whole(context, ended_at(surface, division_of(wide, twist), spacing));
  front_.end_sheet(context.mesh, whole.border);
  return status;
}

Status PaperCutter::cut_in_frames(const CutContext& context, const Stroke& stroke, std::uint32_t tag) {
  begin(context.mesh, context.journal, stroke.edges.front(), /*has_moved=*/false, tag);
  Status status;
  for (std::size_t row = 1; row < stroke.edges.size() && status; ++row) {
    status = move_at_rest(context, stroke.edges[row]);
  }
  if (status) status = follow(context, stroke_.motion.end(stroke_.sheet, touches(context.mesh), {}));
  count_last_sheet(context.statistics);
  if (status) status = end_whole(context, {stroke_.motion, stroke_.edge, stroke_.last_row, stroke_.last_strips()});
  front_.end_sheet(context.mesh, stroke_.sheet.border());
  return status;
}

/// A whole stroke whose blade has stopped inside the body is one that others go on from.
Status PaperCutter::end_whole(const CutContext& context, EndedStroke ended) {
  std::vector<Strip::Segment> row;
  for (std::size_t c = 0; c + 1 < ended.row.size(); ++c) {
    row.push_back({SosPoint{ended.row[c], kFirstBladeKey + c}, SosPoint{ended.row[c + 1], kFirstBladeKey + c + 1}});
  }
  find_surface(context);
  stroke_.may_go_on = lies_in_body(context.mesh, surface_, row);
  if (stroke_.may_go_on) return end_at_rest(context, std::move(ended));
  if (Status status = close_ring(context); !status) return status;
  ended_.add({});
  return {};
}

// --- frame by frame

void PaperCutter::begin(const TetMesh& mesh, const Journal& journal, std::span<const Vec3> given, bool has_moved,
                        std::uint32_t tag) {
  const double spacing = typical_spacing(mesh);
  const std::vector<Vec3> row = with_margin(given, kCoincident * spacing);
  surface_.follow(mesh, journal);
  if (has_moved && stands_in_material(mesh, row)) {
    stroke_.tag = tag;
    stroke_.has_cut = false;
    return;
  }
  const EndedStroke* ended = has_moved ? nullptr : ended_.find(row, kStandsWithin * spacing);
  const bool goes_on = ended != nullptr && ended_.is_last(*ended) && stroke_.may_go_on;
  if (!goes_on) front_.begin_sheet();
  stroke_ = OpenStroke();
  stroke_.tag = tag;
  stroke_.spacing = spacing;
  stroke_.last_row = row;
  stroke_.edge = EdgeDivision(row.size());
  if (has_moved) {
    stroke_.is_in_material = true;
    put_in_place(mesh, row);
  } else if (ended != nullptr) {
    stroke_.stands_at_end = true;
    go_on_from(*ended);
    stroke_.goes_over = !goes_on;
  } else {
    stroke_.first_row = row;
    stroke_.ring = Ring(row);
    stroke_.motion.begin(row, spacing);
  }
}

/// Goes on at rest from where another stroke ended.
void PaperCutter::go_on_from(const EndedStroke& ended) {
  stroke_.edge = ended.edge;
  stroke_.last_row = ended.row;
  stroke_.gone_on_from = ended.strips;
  stroke_.ring = ended.ring;
  stroke_.motion = ended.motion;
  stroke_.motion.go_on(ended.motion.front(), stroke_.spacing);
}

/// Whether a blade stands, in a body that moves, where that of the stroke that has ended there would.
bool PaperCutter::stands_in_material(const TetMesh& mesh, std::span<const Vec3> given) {
  if (!stroke_.may_go_on || !stroke_.is_in_material || given.size() != stroke_.edge.points()) return false;
  complex_.clear();
  stroke_.material.find_masters(mesh, surface_, complex_);
  return stroke_.material.stands_at(mesh, complex_, stroke_.edge.divided(given), kStandsWithin * stroke_.spacing);
}

Result<CutStatistics> PaperCutter::step(TetMesh& mesh, Journal& journal, std::span<const Vec3> row,
                                        const Vec3& direction, bool has_moved, StageTimes& times) {
  return guarded(mesh, journal, times, [&](const CutContext& context) -> Status {
    context.statistics.steps = 1;
    find_surface(context);
    if (has_moved && !stroke_.is_in_material) enter_material(context.mesh);
    if (!stroke_.is_in_material) return move_at_rest(context, row);
    stroke_.direction = direction;
    const std::vector<Vec3> to = stroke_.edge.divided(with_margin(row, kCoincident * stroke_.spacing));
    return step_in_material(context, std::exchange(stroke_.last_row, to));
  });
}

Status PaperCutter::move_at_rest(const CutContext& context, std::span<const Vec3> given) {
  const std::vector<Vec3> row = with_margin(given, kCoincident * stroke_.spacing);
  divide_edge(row);
  stroke_.last_row = stroke_.edge.divided(row);
  return follow(context, stroke_.motion.advance(stroke_.last_row, stroke_.sheet, touches(context.mesh), {}, false));
}

/// Divides the blade's edge where it turns on its way to a row.
void PaperCutter::divide_edge(std::span<const Vec3> row) {
  const auto parts = stroke_.edge.divide(stroke_.last_row, stroke_.edge.divided(row), kTwist * stroke_.spacing);
  if (parts.empty()) return;
  stroke_.motion.refine(parts);
  stroke_.last_row = divided(stroke_.last_row, parts);
}

Result<CutStatistics> PaperCutter::end(TetMesh& mesh, Journal& journal, StageTimes& times) {
  return guarded(mesh, journal, times, [&](const CutContext& context) {
    find_surface(context);
    Status status;
    if (stroke_.is_in_material) {
      if (stroke_.motion.is_at_start()) status = cut_to(context, stroke_.last_row);
      stroke_.is_last = true;
      if (status) status = cut_to(context, stroke_.last_row);
      stroke_.is_last = false;
      stroke_.material.find_tips(context.mesh, complex_);
      ended_.add({});
    } else {
      status = follow(context, stroke_.motion.end(stroke_.sheet, touches(context.mesh), {}));
      if (status) {
        status = end_at_rest(context, {stroke_.motion, stroke_.edge, stroke_.last_row, stroke_.last_strips()});
      }
    }
    count_last_sheet(context.statistics);
    front_.end_sheet(context.mesh, stroke_.sheet.border());
    front_.leave_lips(context.mesh, walker_);
    stroke_.may_go_on = status.ok();
    return status;
  });
}

/// Goes over the last strips of a stroke that has ended where this one does, if others have cut in between.
Status PaperCutter::end_at_rest(const CutContext& context, EndedStroke ended) {
  const EndedStroke* met = ended_.find(ended.row, kStandsWithin * stroke_.spacing);
  Status status;
  if (met != nullptr && !ended_.is_last(*met)) status = go_over(context, met->strips);
  if (status && !ended.strips.empty()) status = cut_at_row(context, ended.row, *ended.strips.back());
  if (status) status = close_ring(context);
  ended.ring = stroke_.ring;
  ended_.add(std::move(ended));
  return status;
}

/// Whether tets near a sheet have walls of other incisions than that under way.
bool PaperCutter::meets_other_walls(const TetMesh& mesh, const Sheet& sheet) const {
  const std::vector<TetId> near = find_near_tets(mesh, sheet);
  return std::any_of(near.begin(), near.end(), [&](TetId tet) {
    const TetLinks& links = mesh.links(tet);
    return std::any_of(links.begin(), links.end(), [&](const Link link) {
      return link.is_boundary() && link.tag() != 0 && !front_.is_of_sheet(link.tag());
    });
  });
}

/// Cuts along what lies within rounding of the row at which a strip begins or ends, on both sides of it: where that
/// lies on an older wall, it meets it.
Status PaperCutter::cut_at_row(const CutContext& context, std::span<const Vec3> row, const Strip& strip) {
  if (row.empty()) return {};
  const double margin = kCoincident * stroke_.spacing;
  std::vector<Vec3> before, behind;
  for (std::size_t c = 0; c < row.size(); ++c) {
    const auto hit = strip.sheet.tree().closest(row[c], stroke_.spacing);
    if (!hit.is_valid()) return {};
    const Vec3 along = row[std::min(c + 1, row.size() - 1)] - row[c > 0 ? c - 1 : 0];
    const Vec3 onwards = strip.sheet.normal(hit.triangle).cross(along).normalized();
    before.push_back(row[c] - margin * onwards);
    behind.push_back(row[c] + margin * onwards);
  }
  const Strip beside(sweep({"", {0.0, 1.0}, {before, behind}}, 0.0), {});
  if (beside.surface.triangles.empty() || !meets_other_walls(context.mesh, beside.sheet)) return {};
  return sheet_cut_.cut(context, SheetSoFar(beside), stroke_.tag, front_);
}

/// Cuts along strips once more. Edges that other strokes have made since may cross them.
Status PaperCutter::go_over(const CutContext& context, std::span<const std::shared_ptr<const Strip>> strips) {
  SweptSurface surface;
  for (const auto& strip : strips) append(surface, strip->surface);
  if (surface.triangles.empty()) return {};
  const Strip strip(std::move(surface), {});
  return sheet_cut_.cut(context, SheetSoFar(strip), stroke_.tag, front_);
}

void PaperCutter::count_last_sheet(CutStatistics& statistics) const {
  if (stroke_.has_cut) statistics.latent_faces += sheet_cut_.latent_faces();
  if (!stroke_.motion.is_at_start()) ++statistics.sheets;
}

void PaperCutter::find_surface(const CutContext& context) {
  const StageZone zone(context.times, Stage::kCollision);
  surface_.follow(context.mesh, context.journal);
}

BladeMotion::Touches PaperCutter::touches(const TetMesh& mesh) const {
  return [&mesh](const SweptSurface& surface) { return !find_near_tets(mesh, Sheet(surface)).empty(); };
}

/// The body has begun to move: from now on the blade is located in the elements as they stand.
void PaperCutter::enter_material(const TetMesh& mesh) {
  stroke_.is_in_material = true;
  complex_.clear();
  stroke_.material.take_over(mesh, surface_, stroke_.last_row, stroke_.motion.front(), stroke_.spacing, complex_);
  stroke_.motion.refine(stroke_.material.shares());
}

/// From where the blade was to where it is, in parts of at most an element; away from the body it is only put in place.
Status PaperCutter::step_in_material(const CutContext& context, const std::vector<Vec3>& before) {
  const std::vector<Vec3> to = stroke_.last_row;
  const Box body = current_bounds(context.mesh), near = enlarged(body, kNearBody);
  const double travel = std::max(stroke_.spacing, (body.hi - body.lo).norm() / kMostStepParts);
  std::vector<Vec3> row = before;
  for (const StepPart& part : divide_step(before, to, travel, near)) {
    const std::vector<Vec3> from = std::exchange(row, to);
    for (std::size_t c = 0; c < row.size() && part.end < 1; ++c) row[c] = before[c] + part.end * (to[c] - before[c]);
    const bool is_free = complex_.master_count() == 0;
    if (is_free && (!part.is_near || stroke_.material.is_graded())) {
      put_in_place(context.mesh, part.is_near ? from : row);
    }
    if (is_free && !part.is_near) continue;
    if (Status status = cut_to(context, row); !status) return status;
  }
  return {};
}

/// Starts anew with a blade that has not met the body yet.
void PaperCutter::put_in_place(const TetMesh& mesh, const std::vector<Vec3>& row) {
  complex_.clear();
  stroke_.material.begin(mesh, surface_, row, stroke_.spacing, complex_);
  stroke_.motion.begin(stroke_.material.anchors(), stroke_.spacing);
}

Status PaperCutter::cut_to(const CutContext& context, const std::vector<Vec3>& row) {
  BladeMotion::Proposal proposal;
  {
    const StageZone zone(context.times, Stage::kCollision);
    stroke_.material.locate(context.mesh, surface_, complex_, row, stroke_.direction, stroke_.is_last);
    hold_where_it_turns_back();
    proposal = stroke_.motion.propose(stroke_.material.wanted());
  }
  if (stroke_.material.is_in_air(context.mesh, surface_)) {
    leave_body(context, row);
    return {};
  }
  if (proposal.surface.triangles.empty()) return {};
  BladeMotion::Move move;
  note_course(proposal.row);
  move.strip = stroke_.motion.accept(proposal, {});
  stroke_.material.advance(context.mesh, surface_, complex_);
  Status status = follow(context, std::move(move));
  if (!status) return status;
  const StageZone zone(context.times, Stage::kCollision);
  complex_.clear();
  surface_.follow(context.mesh, context.journal);
  stroke_.material.find_masters(context.mesh, surface_, complex_);
  return status;
}

/// Holds the points of the blade that go back in the wound: no further than that is long.
void PaperCutter::hold_where_it_turns_back() {
  const double most = std::min(kLeavesWound * stroke_.spacing, stroke_.gone);
  const std::vector<Vec3> row = stroke_.material.wanted();
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool is_back = (row[i] - stroke_.material.anchors()[i]).dot(stroke_.course) < 0;
    if (is_back && stroke_.material.lead(i) < most) stroke_.material.hold(i);
  }
}

/// Where the front goes at rest: its mean way, new ones counting most.
void PaperCutter::note_course(std::span<const SosPoint> row) {
  Vec3 way = Vec3::Zero();
  for (std::size_t i = 0; i < row.size(); ++i) way += row[i].position - stroke_.material.anchors()[i];
  if (way.norm() > 0) stroke_.course = (0.5 * stroke_.course + way.normalized()).normalized();
  stroke_.gone += way.norm() / static_cast<double>(row.size());
}

/// A blade in the air cuts nothing: its sheet ends where it has left the body, and the next one begins where it comes
/// to the body again.
void PaperCutter::leave_body(const CutContext& context, const std::vector<Vec3>& row) {
  if (!stroke_.motion.is_at_start()) finish_sheet(context);
  const MaterialBlade before = stroke_.material;
  complex_.clear();
  stroke_.material.begin(context.mesh, surface_, row, stroke_.spacing, complex_);
  if (!stroke_.material.is_front_clear(context.mesh, surface_)) {
    stroke_.material = before;  // next to the body places at rest are uncertain: the next strip starts further off
  }
  stroke_.motion.begin(stroke_.material.anchors(), stroke_.spacing);
}

void PaperCutter::finish_sheet(const CutContext& context) {
  context.statistics.latent_faces += sheet_cut_.latent_faces();
  ++context.statistics.sheets;
  front_.end_sheet(context.mesh, stroke_.sheet.border());
  front_.begin_sheet();
  stroke_.sheet.clear();
  stroke_.course = Vec3::Zero();
  stroke_.gone = 0;
}

/// The strips that the blade laid within `kStripsReach` elements before a strip, if that goes on from them as on one
/// sheet. None where it meets some of them otherwise, or is as long as that itself.
std::vector<std::shared_ptr<const Strip>> PaperCutter::strips_before(const Strip& strip) const {
  if (stroke_.is_in_material || travel_of(strip.surface) > kStripsReach * stroke_.spacing) return {};
  std::vector<std::shared_ptr<const Strip>> strips = stroke_.last_strips();
  return meets_any(strip, strips) ? std::vector<std::shared_ptr<const Strip>>() : strips;
}

/// Whether a strip meets some earlier ones otherwise than as their neighbour on one sheet.
bool PaperCutter::meets_any(const Strip& strip, std::span<const std::shared_ptr<const Strip>> strips) const {
  return std::any_of(strips.begin(), strips.end(), [&](const auto& earlier) {
    return strips_meet(strip.surface, earlier->surface, earlier->sheet, kCoincident * stroke_.spacing);
  });
}

/// Cuts along what the blade's motion asks for.
Status PaperCutter::follow(const CutContext& context, BladeMotion::Move move) {
  if (move.strip == nullptr) return {};
  if (std::exchange(stroke_.stands_at_end, false)) {
    const EndedStroke* ended = ended_.find_at(stroke_.gone_on_from);
    if (ended != nullptr && !goes_back(*ended, stroke_.last_row, stroke_.spacing)) ended_.go_on_from(*ended);
  }
  if (std::exchange(stroke_.goes_over, false)) {
    if (Status status = go_over(context, stroke_.gone_on_from); !status) return status;
  }
  if (stroke_.sheet.travel() > kStripsReach * stroke_.spacing) stroke_.gone_on_from.clear();
  if (move.starts_anew) {
    finish_sheet(context);
    move.strip = stroke_.motion.lay_anew({});
  } else if (meets_any(*move.strip, stroke_.gone_on_from)) {
    front_.begin_sheet();
    stroke_.gone_on_from.clear();
  }
  const std::uint64_t cut_before = context.statistics.cut_tets;
  const Crumbs crumbs = stroke_.is_in_material ? Crumbs::kStay : Crumbs::kComeOff;
  Status status =
      sheet_cut_.cut(context, SheetSoFar(*move.strip, strips_before(*move.strip)), stroke_.tag, front_, crumbs);
  context.statistics.cut_tets = cut_before + sheet_cut_.divided_tets();  // few are crossed wholly in one frame
  stroke_.has_cut = stroke_.has_cut || sheet_cut_.divided_tets() > 0;
  const Strip& strip = stroke_.sheet.add(std::move(move.strip));
  const std::vector<Vec3> first_row = std::exchange(stroke_.first_row, {});
  if (!stroke_.is_in_material) stroke_.ring.note(stroke_.sheet.strips().back(), stroke_.last_row, stroke_.spacing);
  return status ? cut_at_row(context, first_row, strip) : status;
}

/// Where a blade that passes all through the body has come back to where its incision began, a ring is full. Tets at
/// the joint were cut when the wall on its other side was not known: where tissue is left, the ring is cut once more as
/// one sheet.
Status PaperCutter::close_ring(const CutContext& context) {
  if (!stroke_.ring.is_full()) return {};
  const Ring ring = std::exchange(stroke_.ring, {});
  find_surface(context);
  if (!ring.passes_through(context.mesh, surface_)) return {};
  const Strip sheet = ring.sheet();
  if (!is_joined_around(context.mesh, sheet.sheet, front_, finder_)) return {};
  return sheet_cut_.cut(context, SheetSoFar(sheet), stroke_.tag, front_, Crumbs::kStay);
}

Result<CutStatistics> cut_as_paper(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                                   unsigned threads, StageTimes& times) {
  return PaperCutter(threads).cut(mesh, journal, stroke, tag, times);
}

}  // namespace v0
}  // namespace incise
