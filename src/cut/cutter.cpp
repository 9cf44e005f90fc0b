// SPDX-License-Identifier: Apache-2.0
// The cutting pipeline: collision → incision faces → subdivision → separation (paper, Figure 1, first four boxes).
#include "cut/cutter.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <new>
#include <utility>

#include "cut/blade_constants.h"
#include "cut/blade_motion.h"
#include "cut/bridges.h"
#include "cut/constants.h"
#include "cut/far_blade.h"
#include "cut/front_carry.h"
#include "cut/kept_apart.h"
#include "cut/material_blade.h"
#include "cut/open_border.h"
#include "cut/piece_finder.h"
#include "cut/reversal.h"
#include "cut/spacing.h"
#include "cut/stroke_cut.h"
#include "cut/sweep.h"
#include "cut/twist.h"
#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {

namespace {

void add_triangles(SweptTriangles& to, const SweptSurface& surface) {
  const auto first = static_cast<std::uint32_t>(to.points.size());
  for (const SosPoint& point : surface.points) to.points.push_back(point.position);
  for (const SweptTriangle& triangle : surface.triangles) {
    to.triangles.push_back({first + triangle.points[0], first + triangle.points[1], first + triangle.points[2]});
  }
}

/// The one of some places that is nearest to all others.
Vec3 middle_of(std::span<const Vec3> places) {
  const auto sum_from = [&](const Vec3& place) {
    double sum = 0;
    for (const Vec3& other : places) sum += (other - place).norm();
    return sum;
  };
  return *std::min_element(places.begin(), places.end(),
                           [&](const Vec3& a, const Vec3& b) { return sum_from(a) < sum_from(b); });
}

/// Of a row's points from those of another one.
double greatest_distance(std::span<const Vec3> row, std::span<const Vec3> from) {
  double greatest = 0;
  for (std::size_t c = 0; c < row.size(); ++c) greatest = std::max(greatest, (row[c] - from[c]).norm());
  return greatest;
}

/// Whether a whole stroke cannot be one sheet: it meets itself, or closes at a corner.
bool needs_steps(const Stroke& stroke, const SweptSurface& surface, double least) {
  const bool closes_at_corner = comes_round(stroke, least) && count_sharp_turns(stroke, least) > 0;
  return closes_at_corner || meets_itself(surface, least);
}

}  // namespace

Cutter::Cutter(CutOptions options) : options_(options), stroke_cut_(options) {}

void Cutter::prepare(const TetMesh& mesh, const Journal& journal) {
  static_cast<void>(spacing_of(mesh, true));
  stroke_cut_.prepare(mesh, journal);
}

/// A typical edge. In a body that moves it is the same for all strokes: the edges of a mesh that was cut are shorter,
/// and a stroke that took its tolerances from them would leave edges that are shorter still.
double Cutter::spacing_of(const TetMesh& mesh, bool has_moved) {
  if (!(body_spacing_ > 0)) body_spacing_ = uncut_spacing(mesh);
  return has_moved ? body_spacing_ : typical_spacing(mesh);
}

void Cutter::begin(const TetMesh& mesh, const Journal& journal, std::span<const Vec3> row, bool has_moved,
                   std::uint32_t tag) {
  stroke_.tag = tag;
  stroke_.swept = {};
  stroke_.joints = {};
  stroke_.spacing = spacing_of(mesh, has_moved);
  stroke_cut_.begin(tag, stroke_.spacing);
  stroke_cut_.prepare(mesh, journal);
  stroke_.given_row.assign(row.begin(), row.end());
  stroke_.last_row = stroke_.given_row;
  stroke_.edge = EdgeDivision(row.size());
  stroke_.is_in_material = has_moved;
  stroke_.is_last = false;
  stroke_.is_at_front = OpenStroke::AtFront::kUnknown;
  stroke_.has_ended = stroke_.has_left = false;
  stroke_.direction = Vec3::Zero();
  if (!has_moved) {
    stroke_.motion.begin(row, stroke_.spacing);
    return;
  }
  stroke_.material.begin(mesh, stroke_cut_.surface(), row, stroke_.spacing, stroke_cut_.complex());
  stroke_.motion.begin(stroke_.material.anchors(), stroke_.spacing);
}

Result<CutStatistics> Cutter::step(TetMesh& mesh, Journal& journal, std::span<const Vec3> row, const Vec3& direction,
                                   bool has_moved, StageTimes& times) {
  return guarded(mesh, journal, times, [&](const CutContext& context) -> Status {
    context.statistics.steps = 1;
    if (has_moved && !stroke_.is_in_material) {
      enter_material(context.mesh);
    }
    stroke_.given_row.assign(row.begin(), row.end());
    if (!stroke_.is_in_material) return move_at_rest(context, row);
    const std::vector<Vec3> before = std::exchange(stroke_.last_row, stroke_.edge.divided(row));
    stroke_.direction = direction;
    return step_in_material(context, before, direction);
  });
}

Status Cutter::move_at_rest(const CutContext& context, std::span<const Vec3> row) {
  divide_edge(row);
  stroke_.last_row = stroke_.edge.divided(row);
  if (goes_on_shortly(context.mesh, stroke_.last_row)) return {};
  return follow_round(context, stroke_.motion.advance(stroke_.last_row, stroke_cut_.sheet(), touches(context.mesh),
                                                      surroundings(context), false));
}

/// Follows a move at rest, and on over the stroke's beginning where it has come round.
Status Cutter::follow_round(const CutContext& context, BladeMotion::Move move) {
  if (move.is_full_turn) move.starts_anew = true;
  Status status = follow(context, std::move(move));
  while (status) {
    BladeMotion::Move next = stroke_.motion.go_over_beginning(surroundings(context));
    if (next.strip == nullptr) break;
    status = follow(context, std::move(next));
  }
  return status;
}

Result<CutStatistics> Cutter::end(TetMesh& mesh, Journal& journal, StageTimes& times) {
  return guarded(mesh, journal, times, [&](const CutContext& context) {
    Status status;
    if (stroke_.is_in_material) {
      if (stroke_.motion.is_at_start()) status = cut_to(context, stroke_.last_row, stroke_.direction, true);
      stroke_.is_last = true;
      if (status && !stroke_.has_ended) status = cut_to(context, stroke_.last_row, stroke_.direction, true);
      stroke_.is_last = false;
      if (status) status = end_in_point(context);
    } else {
      status = end_at_rest(context);
    }
    if (status) status = end_sheets(context);
    return status;
  });
}

Status Cutter::end_at_rest(const CutContext& context) {
  if (goes_on_shortly(context.mesh, stroke_.last_row)) return end_shortly(context, stroke_.last_row);
  return follow_round(context, stroke_.motion.end(stroke_cut_.sheet(), touches(context.mesh), surroundings(context)));
}

Status Cutter::end_sheets(const CutContext& context) {
  if (Status status = follow(context, stroke_.motion.reach_on(surroundings(context))); !status) return status;
  if (!(stroke_.has_left && stroke_.motion.is_at_start())) finish_sheet(context);
  cut_bridges(context, stroke_.swept, stroke_.joints, stroke_.tag);
  return {};
}

std::shared_ptr<const Cutter::Pause> Cutter::pause(const TetMesh& mesh) const {
  auto pause = std::make_shared<Pause>(Pause{stroke_cut_.pause(), stroke_});
  if (stroke_.is_in_material) pause->stroke.material.find_tips(mesh, stroke_cut_.complex());
  return pause;
}

bool Cutter::may_go_on(TetMesh& mesh, Journal& journal, const Pause& pause, std::size_t first_step,
                       std::span<const Vec3> row, bool has_moved) {
  const OpenStroke& paused = pause.stroke;
  if (row.size() != paused.given_row.size()) return false;
  if (!has_moved && !paused.is_in_material) {
    return greatest_distance(row, paused.given_row) <= kStandsWithin * paused.spacing;
  }
  const std::size_t end = journal.position();
  if (!resume(mesh, journal, pause, first_step, has_moved, paused.tag)) return false;
  const bool stands = stroke_.material.stands_at(mesh, stroke_cut_.complex(), stroke_.edge.divided(row),
                                                 kStandsWithin * stroke_.spacing);
  stroke_cut_.forget();
  forget_tried(mesh, journal, end);
  return stands;
}

/// Takes back what was only tried. The surface goes back with it while the journal knows the way; without memory for
/// that it is looked at anew when it is needed.
void Cutter::forget_tried(TetMesh& mesh, Journal& journal, std::size_t end) noexcept {
  try {
    while (journal.position() > end) journal.undo(mesh);
    stroke_cut_.prepare(mesh, journal);
  } catch (const std::bad_alloc&) {
    stroke_cut_.forget();
  }
  journal.take_back(mesh, end);
}

bool Cutter::go_on(TetMesh& mesh, Journal& journal, const Pause& pause, std::size_t first_step,
                   std::span<const Vec3> row, bool has_moved, std::uint32_t tag) {
  if (!resume(mesh, journal, pause, first_step, has_moved, tag)) return false;
  if (stroke_.is_in_material) {  // it starts from where the tissue has taken it, not from where it stopped
    stroke_.given_row.assign(row.begin(), row.end());
    stroke_.last_row = stroke_.edge.divided(row);
    stroke_.material.carry_to(stroke_.last_row);
  }
  return true;
}

bool Cutter::resume(TetMesh& mesh, Journal& journal, const Pause& pause, std::size_t first_step, bool has_moved,
                    std::uint32_t tag) {
  const std::size_t end = journal.position();
  bool goes_on = false;
  try {
    goes_on = take_end_back(mesh, journal, first_step);
    if (goes_on) take_up(mesh, journal, pause, has_moved, tag);
  } catch (const std::bad_alloc&) {
    goes_on = false;
  }
  if (!goes_on) {
    stroke_cut_.forget();
    journal.take_back(mesh, end);
  }
  return goes_on;
}

bool Cutter::Pause::is_near(std::span<const Vec3> row) const {
  return greatest_distance(row, stroke.given_row) <= kMostWait * stroke.spacing;
}

bool Cutter::Pause::has_got_on(std::span<const Vec3> from, std::span<const Vec3> to) const {
  return greatest_distance(to, stroke.given_row) >
         greatest_distance(from, stroke.given_row) + kStandsWithin * stroke.spacing;
}

/// Deterministic: what was tried and taken back comes out again.
std::optional<CutStatistics> Cutter::go_on_through(TetMesh& mesh, Journal& journal, const Pause& pause,
                                                   std::size_t first_step, std::span<const std::vector<Vec3>> rows,
                                                   bool ends, std::uint32_t tag, StageTimes& times) {
  const std::size_t before = journal.position();
  const auto between_sheets = std::exchange(between_sheets_, {});
  std::optional<CutStatistics> sum;
  try {
    KeptApart pieces;
    StageTimes tried;
    bool is_cut = go_on_along(mesh, journal, pause, first_step, rows, tag, tried).ok();
    if (is_cut && ends) is_cut = end(mesh, journal, tried).ok();
    if (is_cut) pieces.look_after(mesh, journal, first_step);
    forget_tried(mesh, journal, before);
    times += tried;
    if (is_cut && pieces.would_stay(mesh)) {
      if (const auto cut = go_on_along(mesh, journal, pause, first_step, rows, tag, times); cut.ok()) sum = *cut;
    }
  } catch (const std::bad_alloc&) {
    sum.reset();
  }
  if (!sum) forget_tried(mesh, journal, before);
  between_sheets_ = between_sheets;
  return sum;
}

/// Takes back what ended a stroke, and moves its blade along rows.
Result<CutStatistics> Cutter::go_on_along(TetMesh& mesh, Journal& journal, const Pause& pause, std::size_t first_step,
                                          std::span<const std::vector<Vec3>> rows, std::uint32_t tag,
                                          StageTimes& times) {
  for (std::size_t i = journal.position(); i-- > first_step;) reverse(mesh, journal, i);
  take_up(mesh, journal, pause, /*has_moved=*/false, tag);
  CutStatistics sum;
  for (const std::vector<Vec3>& row : rows.subspan(1)) {
    Result<CutStatistics> cut = step(mesh, journal, row, Vec3::Zero(), /*has_moved=*/false, times);
    if (!cut) return cut;
    sum += *cut;
  }
  return sum;
}

Result<CutStatistics> Cutter::cut(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                                  StageTimes& times) {
  if (Status status = check(stroke); !status) {
    return status.error();
  }
  return guarded(mesh, journal, times, [&](const CutContext& context) {
    context.statistics.steps = stroke.times.size() - 1;
    return cut_stroke(context, stroke, tag);
  });
}

bool Cutter::leaves_front(const TetMesh& mesh, const Journal& journal, const Stroke& stroke) {
  const double spacing = spacing_of(mesh, false);
  SweptSurface surface = sweep(with_divided_edge(stroke, kTwist * spacing), kOwnSlit * spacing);
  if (surface.triangles.empty()) return false;
  stroke_cut_.prepare(mesh, journal);
  return lies_in_body(mesh, stroke_cut_.surface(), Strip(std::move(surface), {}).border);
}

/// Takes back what ended a stroke. Returns whether all pieces stay apart.
bool Cutter::take_end_back(TetMesh& mesh, Journal& journal, std::size_t first_step) {
  const std::size_t end = journal.position();
  const std::uint32_t pieces = pieces_at(mesh, journal, first_step, end);
  for (std::size_t i = end; i-- > first_step;) reverse(mesh, journal, i);
  return pieces_at(mesh, journal, first_step, end) == pieces;
}

/// Puts the band, the sheet and the blade of a paused stroke back.
void Cutter::take_up(const TetMesh& mesh, const Journal& journal, const Pause& pause, bool has_moved,
                     std::uint32_t tag) {
  stroke_ = pause.stroke;
  stroke_.tag = tag;
  stroke_cut_.go_on(*pause.cut, mesh, tag);
  stroke_cut_.prepare(mesh, journal);
  if (has_moved && !stroke_.is_in_material) enter_material(mesh);
}

/// How many pieces there are where some steps of the journal changed something.
std::uint32_t Cutter::pieces_at(const TetMesh& mesh, const Journal& journal, std::size_t first, std::size_t last) {
  std::vector<TetId> seeds;
  const auto add = [&](TetId tet) {
    if (mesh.is_live(tet)) seeds.push_back(tet);
  };
  for (std::size_t i = first; i < last; ++i) {
    journal.step(i).for_each_tet_before([&](TetId tet) { add(tet); });
    for (const TetId tet : journal.step(i).new_tets) add(tet);
  }
  return finder_.find(mesh, seeds);
}

/// Runs some work; where it fails, what it did is taken back.
template <class Work>
Result<CutStatistics> Cutter::guarded(TetMesh& mesh, Journal& journal, StageTimes& times, Work&& work) {
  auto cut = cut_or_take_back(mesh, journal, times, std::forward<Work>(work));
  if (!cut) stroke_cut_.forget();
  return cut;
}

BladeMotion::Touches Cutter::touches(const TetMesh& mesh) const {
  return [&](const SweptSurface& surface) { return stroke_cut_.touches(mesh, surface); };
}

/// The body has begun to move: from now on the blade is located in the elements as they stand.
void Cutter::enter_material(const TetMesh& mesh) {
  stroke_.is_in_material = true;
  stroke_cut_.enter_material(mesh);
  stroke_.material.take_over(mesh, stroke_cut_.surface(), stroke_.last_row, stroke_.motion.front(), stroke_.spacing,
                             stroke_cut_.complex());
  stroke_.motion.refine(stroke_.material.shares());
}

/// Divides the blade's edge where it turns on its way to a row.
void Cutter::divide_edge(std::span<const Vec3> row) {
  const auto parts = stroke_.edge.divide(stroke_.last_row, stroke_.edge.divided(row), kTwist * stroke_.spacing);
  if (parts.empty()) return;
  stroke_.motion.refine(parts);
  stroke_.last_row = divided(stroke_.last_row, parts);
}

/// From where the blade was to `stroke_.last_row`, in parts of at most an element.
Status Cutter::step_in_material(const CutContext& context, const std::vector<Vec3>& before, const Vec3& direction) {
  const double travel = greatest_distance(stroke_.last_row, before);
  if (travel > kMostStepParts * stroke_.spacing || stroke_.material.is_graded()) {
    return step_from_far(context, before, direction);
  }
  // Where the blade was tells nothing in a body that has moved since: only what lies ahead of the front counts.
  const std::vector<Vec3> from =
      stroke_.material.front_of(context.mesh, stroke_cut_.complex(), before, stroke_.last_row);
  const double way = greatest_distance(stroke_.last_row, from);
  const double parts = std::clamp(std::ceil(way / stroke_.spacing), 1.0, kMostStepParts);
  for (double part = 1; part <= parts; ++part) {
    std::vector<Vec3> row = stroke_.last_row;
    for (std::size_t c = 0; c < row.size() && part < parts; ++c) {
      row[c] = from[c] + (part / parts) * (stroke_.last_row[c] - from[c]);
    }
    if (Status status = cut_to(context, row, direction); !status) return status;
  }
  return {};
}

/// The same for a blade that reaches far beyond the body, or goes far: away from the body it is only put in place.
Status Cutter::step_from_far(const CutContext& context, const std::vector<Vec3>& before, const Vec3& direction) {
  const std::vector<Vec3> to = stroke_.last_row;
  const Box body = current_bounds(context.mesh), near = enlarged(body, kNearBody);
  const double travel = std::max(stroke_.spacing, (body.hi - body.lo).norm() / kMostStepParts);
  std::vector<Vec3> row = before;
  for (const StepPart& part : divide_step(before, to, travel, near)) {
    const std::vector<Vec3> from = std::exchange(row, to);
    for (std::size_t c = 0; c < row.size() && part.end < 1; ++c) row[c] = before[c] + part.end * (to[c] - before[c]);
    const bool is_free = stroke_cut_.complex().size() == 0;
    if (is_free && (!part.is_near || stroke_.material.is_graded()))
      put_in_place(context.mesh, context.journal, part.is_near ? from : row);
    if (is_free && !part.is_near) continue;
    if (Status status = cut_to(context, row, direction); !status) return status;
  }
  return {};
}

/// Starts anew with a blade that has not met the body yet.
void Cutter::put_in_place(const TetMesh& mesh, const Journal& journal, const std::vector<Vec3>& row) {
  stroke_cut_.prepare(mesh, journal);
  stroke_.material.begin(mesh, stroke_cut_.surface(), row, stroke_.spacing, stroke_cut_.complex());
  stroke_.motion.begin(stroke_.material.anchors(), stroke_.spacing);
}

/// `ends`: a stroke that is short ends there.
Status Cutter::cut_to(const CutContext& context, const std::vector<Vec3>& row, const Vec3& direction, bool ends) {
  BladeMotion::Proposal proposal = propose(context, row, direction);
  if (stroke_.material.is_in_air(context.mesh, stroke_cut_.surface())) {
    leave_body(context, row);
    return {};
  }
  if (proposal.surface.triangles.empty()) return {};
  std::vector<Vec3> to;
  for (const SosPoint& p : proposal.row) to.push_back(p.position);
  if (goes_on_shortly(context.mesh, to)) {
    stroke_.has_ended = ends;
    return ends ? end_shortly(context, to) : Status{};
  }
  BladeMotion::Move move;
  move.strip = stroke_.motion.accept(proposal, surroundings(context));
  stroke_.material.advance(context.mesh, stroke_cut_.surface(), stroke_cut_.complex());
  return follow(context, std::move(move));
}

/// A blade in the air cuts nothing: its sheet ends where it has left the body, and the next one begins where it comes
/// to the body again.
void Cutter::leave_body(const CutContext& context, const std::vector<Vec3>& row) {
  if (!stroke_.motion.is_at_start()) {
    finish_sheet(context);
    stroke_cut_.begin(stroke_.tag, stroke_.spacing);
    if (between_sheets_) between_sheets_();
    stroke_.has_left = true;
    stroke_.motion.begin(stroke_.material.anchors(), stroke_.spacing);
  }
  const MaterialBlade before = stroke_.material;
  stroke_cut_.prepare(context.mesh, context.journal);
  stroke_.material.begin(context.mesh, stroke_cut_.surface(), row, stroke_.spacing, stroke_cut_.complex());
  if (stroke_.material.is_front_clear(context.mesh, stroke_cut_.surface())) {
    stroke_.motion.begin(stroke_.material.anchors(), stroke_.spacing);
  } else {
    stroke_.material = before;  // next to the body places at rest are uncertain: the next strip starts further off
  }
}

/// Looks for the blade in the tissue as it stands: the strip that it would cut.
BladeMotion::Proposal Cutter::propose(const CutContext& context, const std::vector<Vec3>& row, const Vec3& direction) {
  const StageZone zone(context.times, Stage::kCollision);
  stroke_cut_.prepare(context.mesh, context.journal);
  stroke_.material.locate(context.mesh, stroke_cut_.surface(), stroke_cut_.complex(), row, direction, stroke_.is_last);
  BladeMotion::Proposal proposal = stroke_.motion.propose(stroke_.material.wanted());
  while (!proposal.surface.triangles.empty() && hold_where_it_closes(context.mesh, proposal)) {
    proposal = stroke_.motion.propose(stroke_.material.wanted());
  }
  return proposal;
}

/// Holds the points of the blade beside which a strip would close the cut again, unless they are far ahead. Returns
/// whether there were any.
bool Cutter::hold_where_it_closes(const TetMesh& mesh, const BladeMotion::Proposal& proposal) {
  const Strip strip(proposal.surface, {});
  bool has_held = false;
  for (const auto& [column, is_apart, is_left] : stroke_cut_.recrossed_columns(mesh, strip)) {
    const double greatest = (is_left ? kTurnBack : kGiveWay) * stroke_.spacing;
    for (const std::size_t point : {std::size_t{column}, std::size_t{column} + 1}) {
      if (!stroke_.material.is_accepted(point)) continue;
      const bool is_elsewhere = !is_left || stroke_.material.is_in_tissue(point);  // beside the body it merely follows
      if (!is_apart && is_elsewhere && stroke_.material.lead(point) > greatest) continue;
      stroke_.material.hold(point);
      has_held = true;
    }
  }
  return has_held;
}

/// What a border of the sheet finds: an older cut to reach on into, or the end of the body.
Surroundings Cutter::surroundings(const CutContext& context) {
  const TetMesh& mesh = context.mesh;
  stroke_cut_.prepare(mesh, context.journal);  // walls are where the last step left them
  Surroundings found;
  const OlderWalls older = stroke_cut_.older_walls(mesh);
  if (!older.exist()) return found;
  found.has_older_cuts = true;
  found.is_outside = [this, &mesh](const Vec3& place) {
    return !locate(mesh, stroke_cut_.surface(), {place, ~std::uint64_t{0} - 1}).is_valid();
  };
  found.reach = [this, older, is_outside = found.is_outside](const Vec3& place, const Vec3& outwards,
                                                             const Vec3& normal) {
    const double along = kReachOn * stroke_.spacing, across = kReachThrough * stroke_.spacing;
    const double beside = (options_.snap > 0 ? kBesideWall : kBesideExactly) * stroke_.spacing;
    const auto is_open = [&](double share) {
      const Vec3 beyond = place + share * along * outwards;
      return older.pass(beyond, normal, beside, kInsideOlder * stroke_.spacing) || is_outside(beyond);
    };
    if (older.pass(place, normal, beside, kWeld * stroke_.spacing) &&
        std::all_of(kReachSamples.begin(), kReachSamples.end(), is_open)) {
      return along;
    }
    return older.meet(place - kInsideOlder * stroke_.spacing * outwards,
                      place + kWeldThrough * stroke_.spacing * outwards)
               ? across
               : 0.0;
  };
  found.retreat = [this, older](const Vec3& place, const Vec3& outwards, double length) {
    const double behind = std::min(kWeld * stroke_.spacing, length), before = kBeforeWall * stroke_.spacing;
    const double met = older.first_met(place - behind * outwards, place + before * outwards, kSteepSine);
    return met <= 1.0 ? (1.0 - met) * (behind + before) : 0.0;
  };
  return found;
}

/// Whether a stroke has only begun, at the front of older cuts.
bool Cutter::goes_on_shortly(const TetMesh& mesh, std::span<const Vec3> row) {
  if (!stroke_.motion.is_at_start() || options_.snap <= 0 || stroke_.is_at_front == OpenStroke::AtFront::kNo)
    return false;
  const std::vector<Vec3> start = stroke_.motion.front();
  const double travel = greatest_distance(row, start);
  if (!(travel > 0) || travel > kCarry * stroke_.spacing) return false;
  if (stroke_.is_at_front == OpenStroke::AtFront::kUnknown) {
    stroke_.is_at_front = lies_at_front(mesh, start, row) ? OpenStroke::AtFront::kYes : OpenStroke::AtFront::kNo;
  }
  return stroke_.is_at_front == OpenStroke::AtFront::kYes;
}

/// Whether all of a row that is in the body lies at the front of older cuts, seen along its way to another row.
bool Cutter::lies_at_front(const TetMesh& mesh, std::span<const Vec3> start, std::span<const Vec3> row) const {
  const OlderWalls older = stroke_cut_.older_walls(mesh);
  if (!older.exist()) return false;
  const auto is_inside = [&](const Vec3& place) {
    return locate(mesh, stroke_cut_.surface(), {place, ~std::uint64_t{0} - 1}).is_valid();
  };
  bool is_at_front = false;
  for (std::size_t c = 0; c + 1 < row.size(); ++c) {
    const Vec3 along = start[c + 1] - start[c];
    const Vec3 beside = kStartShare * stroke_.spacing * along.normalized();  // the skin is near: fronts end off it
    const double parts = std::clamp(std::ceil(along.norm() / (kStartShare * stroke_.spacing)), 1.0, kMostStarts);
    for (double k = 0; k <= parts; ++k) {
      const Vec3 place = start[c] + (k / parts) * along;
      const Vec3 normal = (row[c] + (k / parts) * (row[c + 1] - row[c]) - place).cross(along);
      const bool is_at = normal.squaredNorm() > 0 &&
                         older.pass(place, normal, kBesideWall * stroke_.spacing, kAtFront * stroke_.spacing);
      if (!is_at && is_inside(place) && is_inside(place - beside) && is_inside(place + beside)) return false;
      is_at_front |= is_at;
    }
  }
  return is_at_front;
}

/// Takes the front of older cuts along from one row to another. Returns how far the last of it is left behind.
double Cutter::carry(const CutContext& context, std::span<const Vec3> from, std::span<const Vec3> to) {
  stroke_cut_.prepare(context.mesh, context.journal);
  Transaction transaction(context.mesh, true);
  const double left = carry_front(transaction, stroke_cut_.surface(), from, to, stroke_.spacing);
  context.journal.append_if_changed(transaction.commit());
  return left;
}

/// The same for the blade as it stands; what it swept is what walls are judged by.
double Cutter::carry_along(const CutContext& context, std::span<const Vec3> row) {
  add_triangles(stroke_.swept, stroke_.motion.propose(row).surface);
  return carry(context, stroke_.motion.front(), row);
}

/// Ends a short stroke. A front that cannot follow is drawn back and cut from there; what was drawn back in vain
/// follows as far as it can.
Status Cutter::end_shortly(const CutContext& context, std::span<const Vec3> row) {
  if (carry_along(context, row) <= kLag * stroke_.spacing) return {};
  const std::vector<Vec3> back = drawn_back(stroke_.motion.front(), row);
  static_cast<void>(carry(context, row, back));
  stroke_cut_.begin(stroke_.tag, stroke_.spacing);
  stroke_cut_.prepare(context.mesh, context.journal);
  stroke_.motion.begin(back, stroke_.spacing);
  Status status = follow_to(context, row);
  if (status) status = follow(context, stroke_.motion.reach_on(surroundings(context)));
  if (!status) return status;
  finish_sheet(context);
  static_cast<void>(carry(context, back, row));
  stroke_cut_.begin(stroke_.tag, stroke_.spacing);
  stroke_.motion.begin(row, stroke_.spacing);
  return {};
}

/// A closed edge that ends as a point has cut off what it went round: what tissue that moved, or points that were held,
/// left of its front is drawn together.
Status Cutter::end_in_point(const CutContext& context) {
  const std::vector<Vec3>& row = stroke_.last_row;
  if (stroke_.motion.is_at_start() || row.size() < 3 || row.front() != row.back()) return {};
  for (const Vec3& place : row) {
    if ((place - row.front()).norm() > kStandsWithin * stroke_.spacing) return {};
  }
  const std::vector<Vec3> front = stroke_.motion.front();
  return follow_to(context, std::vector<Vec3>(front.size(), middle_of(front)));
}

/// Cuts from the front to a row that the tissue did not choose.
Status Cutter::follow_to(const CutContext& context, std::span<const Vec3> row) {
  BladeMotion::Move move;
  move.strip = stroke_.motion.accept(stroke_.motion.propose(row), surroundings(context));
  if (stroke_.is_in_material) stroke_.material.find_masters(context.mesh, stroke_cut_.surface(), stroke_cut_.complex());
  return follow(context, std::move(move));
}

/// A row that is about an element behind another one, against its way.
std::vector<Vec3> Cutter::drawn_back(std::vector<Vec3> row, std::span<const Vec3> to) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t c = 0; c < row.size(); ++c) sum += to[c] - row[c];
  for (std::size_t c = 0; c < row.size(); ++c) {
    const Vec3 way = to[c] - row[c];
    row[c] -= kDrawBack * stroke_.spacing * (way.squaredNorm() > 0 ? way : sum).normalized();
  }
  return row;
}

void Cutter::finish_sheet(const CutContext& context) {
  stroke_cut_.finish(context, rules());
  ++context.statistics.sheets;
}

/// What the sheets of a stroke left joined where they meet is opened, now that all of them are known.
void Cutter::cut_bridges(const CutContext& context, const SweptTriangles& swept, const SweptTriangles& joints,
                         std::uint32_t tag) {
  if (joints.triangles.empty() || options_.snap <= 0) return;
  stroke_cut_.prepare(context.mesh, context.journal);
  const std::size_t vertices = context.mesh.vertex_count();
  Transaction transaction(context.mesh);
  const std::vector<Side> opened =
      incise::cut_bridges(transaction, stroke_cut_.surface(), swept, joints, stroke_.spacing, tag);
  context.journal.append_if_changed(transaction.commit());
  context.statistics.incision_faces += growth(0, opened.size()) / 2;
  context.statistics.copied_vertices += context.mesh.vertex_count() - vertices;
  if (!opened.empty()) stroke_cut_.part_edges(context, opened);
}

/// Notes that one sheet ends and another one begins where the blade is, or was.
void Cutter::note_joint(std::span<const Vec3> row) {
  SweptTriangles& joints = stroke_.joints;
  for (std::size_t c = 0; c + 1 < row.size(); ++c) {
    const auto first = static_cast<std::uint32_t>(joints.points.size());
    joints.points.insert(joints.points.end(), {row[c], row[c + 1]});
    joints.triangles.push_back({first, first + 1, first + 1});
  }
}

/// Cuts along what the blade's motion asks for. A strip that meets what the sheet has cut through is the first of a
/// new sheet, to which the one so far is an older cut.
Status Cutter::follow(const CutContext& context, BladeMotion::Move move) {
  if (move.strip == nullptr) return {};
  if (move.starts_anew || comes_back(context, *move.strip)) {
    finish_sheet(context);
    stroke_cut_.begin(stroke_.tag, stroke_.spacing);
    if (between_sheets_) between_sheets_();
    stroke_cut_.prepare(context.mesh, context.journal);
    if (stroke_.is_in_material)
      stroke_.material.find_masters(context.mesh, stroke_cut_.surface(), stroke_cut_.complex());
    note_joint(stroke_.motion.before());
    note_joint(stroke_.motion.front());
    move.strip = stroke_.motion.lay_anew(surroundings(context));
  }
  add_triangles(stroke_.swept, move.strip->surface);
  stroke_cut_.keep_pieces(stroke_.is_in_material);
  Status status = stroke_cut_.advance(context, std::move(move.strip), rules());
  if (!status) return status;
  const bool must_finish = stroke_cut_.must_finish();
  if (!must_finish) {
    const auto pinned = stroke_.is_in_material ? stroke_.material.masters() : std::vector<std::uint32_t>();
    stroke_cut_.bake(context, rules(), pinned);
  }
  if (must_finish || stroke_cut_.is_pinched(context.mesh)) go_on_from_front(context);
  return status;
}

/// Whether a strip comes back to what the sheet is done with.
bool Cutter::comes_back(const CutContext& context, const Strip& strip) {
  if (!stroke_.is_in_material && stroke_cut_.crosses_own_cut(context, strip, kPassesApart)) return true;
  return stroke_cut_.comes_back(context.mesh, strip);
}

/// Finishes the sheet where it is; the next one goes on from there.
void Cutter::go_on_from_front(const CutContext& context) {
  finish_sheet(context);
  stroke_cut_.begin(stroke_.tag, stroke_.spacing);
  stroke_cut_.prepare(context.mesh, context.journal);
  stroke_.motion.begin_anew();
  note_joint(stroke_.motion.front());
  if (stroke_.is_in_material) stroke_.material.find_masters(context.mesh, stroke_cut_.surface(), stroke_cut_.complex());
}

/// In a body that moves, front points keep still while they can: each that is made anew disturbs the solver.
FrontRules Cutter::rules() const {
  FrontRules rules;
  rules.reach = stroke_.is_in_material ? kPointReach * stroke_.spacing : 0.0;
  return rules;
}

/// At once, or, where the sweep meets itself or closes at a corner, as if its blade had come in steps.
Status Cutter::cut_stroke(const CutContext& context, const Stroke& stroke, std::uint32_t tag) {
  stroke_.is_in_material = false;
  const double spacing = stroke_.spacing = spacing_of(context.mesh, false);
  SweptSurface surface = sweep(with_divided_edge(stroke, kTwist * spacing), kOwnSlit * spacing);
  if (surface.triangles.empty()) return {};
  if (needs_steps(stroke, surface, kCoincident * spacing)) return cut_in_steps(context, stroke, tag);
  if (Status status = cut_strip(context, std::move(surface), tag); !status) return status;
  ++context.statistics.sheets;
  return {};
}

Status Cutter::cut_in_steps(const CutContext& context, const Stroke& stroke, std::uint32_t tag) {
  begin(context.mesh, context.journal, stroke.edges.front(), /*has_moved=*/false, tag);
  Status status = lay_rows(context, stroke);
  if (status) status = end_at_rest(context);
  if (status) status = end_sheets(context);
  return status;
}

Status Cutter::lay_rows(const CutContext& context, const Stroke& stroke) {
  Status status;
  for (std::size_t row = 1; row < stroke.edges.size() && status; ++row) {
    status = move_at_rest(context, stroke.edges[row]);
  }
  return status;
}

Result<CutStatistics> Cutter::cut_to_end(TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                                         StageTimes& times) {
  return guarded(mesh, journal, times, [&](const CutContext& context) {
    context.statistics.steps = stroke.times.size() - 1;
    begin(mesh, journal, stroke.edges.front(), /*has_moved=*/false, tag);
    stroke_.given_row = stroke.edges.back();
    const double spacing = stroke_.spacing;
    SweptSurface surface = sweep(with_divided_edge(stroke, kTwist * spacing), kOwnSlit * spacing);
    if (stroke_cut_.older_walls(mesh).exist() || needs_steps(stroke, surface, kCoincident * spacing)) {
      return lay_rows(context, stroke);
    }
    return lay_at_once(context, stroke, std::move(surface));
  });
}

/// What a stroke sweeps as its only strip: the blade goes on from the end of that.
Status Cutter::lay_at_once(const CutContext& context, const Stroke& stroke, SweptSurface surface) {
  stroke_.edge = division_of(stroke, kTwist * stroke_.spacing);
  stroke_.last_row = stroke_.edge.divided(stroke.edges.back());
  std::vector<SosPoint> front;
  for (const std::uint32_t point : surface.front) front.push_back(surface.points[point]);
  stroke_.motion.begin_at(front, kFirstBladeKey + surface.points.size(), stroke_.spacing);
  stroke_.motion.note_laid(stroke_.edge.divided(stroke.edges[stroke.edges.size() - 2]));
  BladeMotion::Move move;
  move.strip = std::make_unique<Strip>(std::move(surface), std::vector<std::array<std::uint64_t, 2>>());
  move.strip->row = std::move(front);
  return follow(context, std::move(move));
}

/// What a stroke swept, as one sheet in one step.
Status Cutter::cut_strip(const CutContext& context, SweptSurface part, std::uint32_t tag) {
  stroke_cut_.begin(tag, stroke_.spacing);
  auto strip = std::make_unique<Strip>(std::move(part), std::vector<std::array<std::uint64_t, 2>>());
  Status status = stroke_cut_.advance(context, std::move(strip), rules());
  stroke_cut_.finish(context, rules());
  return status;
}

}  // namespace v0
}  // namespace incise
