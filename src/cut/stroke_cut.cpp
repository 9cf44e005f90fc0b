// SPDX-License-Identifier: Apache-2.0
// The pipeline of a strip, stage by stage: collide, bisect what is crossed twice, flag, snap, front points, rebuild;
// then the wake, and at the end of a sheet what is left of it (docs/internals.md, 3).
#include "cut/stroke_cut.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "cut/constants.h"
#include "cut/parity.h"
#include "cut/pinched_edges.h"
#include "cut/spacing.h"
#include "incise/geom/closest.h"
#include "incise/geom/intersect.h"
#include "incise/mesh/verbs.h"

namespace incise {
inline namespace v0 {

namespace {

/// Whether an edge of the complex is one of a side of a master.
bool has_edge(const Master& master, unsigned side, std::uint32_t edge) {
  return std::any_of(kSideEdges[side].begin(), kSideEdges[side].end(),
                     [&](unsigned e) { return master.edges[e] == edge; });
}

}  // namespace

void StrokeCut::begin(std::uint32_t tag, double spacing) {
  forget();
  tags_ = {tag, tag};
  spacing_ = spacing;
  keep_pieces(false);
}

void StrokeCut::forget() {
  complex_.clear();
  sheet_.clear();
  walk_.clear();
  snapping_.coincident.clear();
  on_.clear();
  waiting_.clear();
  pinched_.clear();
  must_finish_ = false;
  has_let_go_ = true;
  looked_at_ = nullptr;
}

std::shared_ptr<const StrokeCut::Pause> StrokeCut::pause() const {
  auto pause = std::make_shared<Pause>();
  pause->complex_ = complex_.image();
  pause->sheet_ = sheet_;
  pause->walk_ = walk_.memory();
  pause->coincident_ = snapping_.coincident;
  pause->on_ = on_;
  pause->waiting_ = waiting_;
  pause->spacing_ = spacing_;
  pause->pinched_ = pinched_;
  pause->must_finish_ = must_finish_;
  pause->keeps_pieces_ = keeps_pieces_;
  pause->first_tag_ = tags_.first;
  return pause;
}

void StrokeCut::go_on(const Pause& pause, const TetMesh& mesh, std::uint32_t tag) {
  begin(tag, pause.spacing_);
  complex_.restore(pause.complex_, mesh);
  sheet_ = pause.sheet_;
  walk_.restore(pause.walk_);
  snapping_.coincident = pause.coincident_;
  on_ = pause.on_;
  waiting_ = pause.waiting_;
  pinched_ = pause.pinched_;
  must_finish_ = pause.must_finish_;
  keep_pieces(pause.keeps_pieces_);
  tags_.first = pause.first_tag_;
}

Status StrokeCut::advance(const CutContext& context, std::unique_ptr<Strip> next, const FrontRules& rules) {
  if (next->sheet.triangle_count() == 0) return {};
  const Strip& strip = sheet_.add(std::move(next));
  {
    const StageZone zone(context.times, Stage::kCollision);
    collide(context, strip);
    flag(context.mesh, strip);
    walk_.keep_front(context.mesh, complex_, strip.row);
    choose_on(context.mesh, *met_, snap_rules(context.mesh), context.statistics);
    place_front(context.mesh, *met_, rules, context.statistics);
    count_cut(context.statistics);
  }
  if (std::size_t{context.mesh.tet_slots()} + SplitTemplate::kMostChildren * complex_.dirty().size() >=
      TetMesh::kMaxTets) {
    return Error{ErrorCode::kOutOfMemory, "the cut would need more than 2^28 tets; use a coarser mesh", {}};
  }
  if (complex_.dirty().empty()) return {};
  for (const std::uint32_t index : *met_) {
    if (complex_[index].is_pinched || complex_[index].has_latent_faces) complex_.mark_dirty(index);
  }
  const StageZone zone(context.times, Stage::kSubdivide);
  rebuild(context, true);
  return {};
}

/// Finds what the strip meets and crosses; edges crossed twice are bisected in between and looked at again. Not where
/// earlier strips have been: how they pass the new edges would not be known.
void StrokeCut::collide(const CutContext& context, const Strip& strip) {
  if (looked_at_ != &strip) look(context, strip);
  looked_at_ = nullptr;  // the mesh will change
  first_look_ = step_;
  for (unsigned round = 0;; ++round) {
    const std::vector<BetweenCrossings> twice =
        find_doubly_crossed(context.mesh, strip, *crossed_, complex_, kGrazeShare);
    if (twice.empty() || round == kMaxBisectionRounds || !bisect(context, twice)) {
      return;
    }
    look(context, strip);
  }
}

void StrokeCut::prepare(const TetMesh& mesh, const Journal& journal) {
  const auto is_own = [&](Side side) { return is_own_wall(mesh, side); };
  if (std::exchange(has_let_go_, false)) surface_.take_in(mesh, is_own);
  surface_.follow(mesh, journal, is_own);
}

/// Whether a wall is one that the sheet makes anew while the blade is beside it. In a body that moves the blade asks
/// for those as well.
bool StrokeCut::is_own_wall(const TetMesh& mesh, Side side) const {
  return !keeps_pieces_ && tags_.own(mesh.link(side)) && is_inside_master(complex_, side);
}

/// Finds what a strip meets and crosses as the mesh stands.
void StrokeCut::look(const CutContext& context, const Strip& strip) {
  ++step_;
  prepare(context.mesh, context.journal);
  met_ = &walk_.find(context.mesh, strip, surface_, complex_, step_);
  crossed_ = &crossings_.find(context.mesh, strip, *met_, complex_, step_);
}

bool StrokeCut::bisect(const CutContext& context, const std::vector<BetweenCrossings>& between) {
  Transaction transaction(context.mesh);
  std::vector<TetId> ring;
  for (const BetweenCrossings& place : between) {
    const ClosedEdge edge = complex_.edges()[place.edge];
    if (complex_[place.master].split == nullptr || context.mesh.is_overshared_at_load(edge.a, edge.b)) continue;
    bool is_whole = !complex_.has_copies(edge.a) && !complex_.has_copies(edge.b);
    complex_.for_each_around(place.edge, [&](std::uint32_t master) {
      is_whole &= !complex_[master].is_divided() && complex_[master].first_met >= first_look_;
    });
    if (!is_whole) continue;
    const SplitEdgePlan plan =
        plan_split_edge(context.mesh, edge.a, edge.b, complex_.children(complex_[place.master])[0], place.t);
    const auto is_master = [&](TetId tet) { return complex_.find(tet) != Master::kNone; };
    // What is no master has been left by the blade: it would stay whole beside divided ones.
    if (!plan || !std::all_of(plan.ring.begin(), plan.ring.end(), is_master)) continue;
    for (const TetId tet : plan.ring) complex_.release(complex_.find(tet));
    has_let_go_ = true;
    apply(transaction, plan);
  }
  return context.journal.append_if_changed(transaction.commit());
}

void StrokeCut::refresh_around(std::uint32_t edge) {
  complex_.for_each_around(edge, [&](std::uint32_t master) {
    complex_.refresh_flags(master);
    complex_.mark_dirty(master);
  });
}

/// Takes the strip's crossings into the complex: an edge is flagged while it is crossed an odd number of times.
void StrokeCut::flag(const TetMesh& mesh, const Strip& strip) {
  const bool is_all_reached = find_reached(mesh, strip);
  for (const StripCrossing& crossing : *crossed_) {
    if (crossing.count % 2 == 0) continue;
    const ClosedEdge& edge = complex_.edges()[crossing.edge];
    const double t = crossing.count > 1 ? 0.5 * (crossing.t + crossing.t_last) : crossing.t;
    const Crossed crossed{crossing.edge, edge.a, edge.b, t, strip.sheet.normal(crossing.triangle).normalized()};
    if ((is_all_reached || is_reached(crossing.edge)) && is_whole_around(mesh, crossing.edge)) {
      cross(mesh, crossed);
    } else {
      waiting_.push_back(crossed);
    }
  }
  take_waiting(mesh);
}

void StrokeCut::cross(const TetMesh& mesh, const Crossed& crossed) {
  const double clamp = snap() > 0 ? kSplitClamp : 0.0;
  ClosedEdge& edge = complex_.edges()[crossed.edge];
  edge.is_blocked |= mesh.touched_itself_at_load() && mesh.is_overshared_at_load(edge.a, edge.b);
  complex_.toggle(crossed.edge);
  if (edge.is_crossed) {
    edge.t = std::min(std::max(crossed.t, clamp), 1.0 - clamp);
    edge.position = mesh.rest(edge.a) + edge.t * (mesh.rest(edge.b) - mesh.rest(edge.a));
    edge.normal = crossed.normal;
    edge.travel = sheet_.travel();
  }
  refresh_around(crossed.edge);
}

/// Whether the complex has all tets around an edge.
bool StrokeCut::is_whole_around(const TetMesh& mesh, std::uint32_t edge) const {
  bool is_whole = true;
  complex_.for_each_around(edge, [&](std::uint32_t m) {
    const Master& master = complex_[m];
    for (unsigned s = 0; s < 4; ++s) {
      const auto& edges = kSideEdges[s];
      const bool has_edge =
          std::any_of(edges.begin(), edges.end(), [&](unsigned e) { return master.edges[e] == edge; });
      if (has_edge && master.behind[s] == Master::kNone) {
        is_whole &= complex_.outside(mesh, master, s).is_boundary();
      }
    }
  });
  return is_whole;
}

/// What reaches on may be ahead of the sheet itself: it counts once that has come to a tet beside it.
void StrokeCut::take_waiting(const TetMesh& mesh) {
  const auto is_gone = [&](const Crossed& c) {
    const ClosedEdge& edge = complex_.edges()[c.edge];
    bool is_lost = edge.a != c.a || edge.b != c.b || complex_.is_settled(c.a) || complex_.is_settled(c.b);
    complex_.for_each_around(c.edge, [&](std::uint32_t m) { is_lost |= complex_.is_half_baked(m); });
    return is_lost;
  };
  std::erase_if(waiting_, is_gone);
  for (std::size_t i = 0; i < waiting_.size();) {
    bool has_come = false;
    complex_.for_each_around(waiting_[i].edge, [&](std::uint32_t m) { has_come |= complex_[m].flagged != 0; });
    if (!has_come || !is_whole_around(mesh, waiting_[i].edge)) {
      ++i;
      continue;
    }
    cross(mesh, waiting_[i]);
    waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;  // those beside it may follow
  }
}

/// Whether a strip, but for what reaches on, comes into a tet through its faces: it need not cross an edge there.
bool StrokeCut::is_entered(const TetMesh& mesh, const Strip& strip, const Master& master) const {
  const auto corner = [&](unsigned c) { return SosPoint{mesh.rest(master.vertices[c]), master.vertices[c].value}; };
  const auto pierces = [&](const SosPoint& p, const SosPoint& q) {
    return std::any_of(kSideCorners.begin(), kSideCorners.end(), [&](const auto& k) {
      return segment_crosses_triangle(p, q, corner(k[0]), corner(k[1]), corner(k[2]));
    });
  };
  Box around;
  for (unsigned c = 0; c < 4; ++c) around.extend(mesh.rest(master.vertices[c]));
  bool is_entered = false;
  strip.sheet.tree().for_each_overlap(around, [&](std::uint32_t t) {
    if (is_entered || strip.sheet.reaches_on(t)) return;
    const SosPoint p = strip.sheet.point(t, 0), q = strip.sheet.point(t, 1), r = strip.sheet.point(t, 2);
    is_entered = pierces(p, q) || pierces(q, r) || pierces(r, p);
  });
  return is_entered;
}

/// What joins a strip to an older cut may pass through that cut's wall, and must not notch the other lip: it counts
/// only in masters that are reached through faces from those that the sheet itself is in. Returns whether all are.
bool StrokeCut::find_reached(const TetMesh& mesh, const Strip& strip) {
  bool reaches_on = false;
  for (std::uint32_t t = 0; t < strip.sheet.triangle_count(); ++t) reaches_on |= strip.sheet.reaches_on(t);
  if (!reaches_on) return true;
  reached_.assign(complex_.size(), false);
  std::vector<std::uint32_t> queue;
  const auto reach = [&](std::uint32_t master) {
    if (reached_[master] || complex_[master].seen != step_) return;
    reached_[master] = true;
    queue.push_back(master);
  };
  for (const StripCrossing& crossing : *crossed_) {
    if (strip.sheet.reaches_on(crossing.triangle) && strip.sheet.reaches_on(crossing.triangle_last)) continue;
    complex_.for_each_around(crossing.edge, reach);
  }
  for (const std::uint32_t master : *met_) {
    if (complex_[master].flagged != 0 || is_entered(mesh, strip, complex_[master])) reach(master);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const std::uint32_t behind : complex_[queue[i]].behind) {
      if (behind != Master::kNone) reach(behind);
    }
  }
  return false;
}

bool StrokeCut::is_reached(std::uint32_t edge) const {
  bool is_reached = false;
  complex_.for_each_around(edge, [&](std::uint32_t master) { is_reached |= reached_[master]; });
  return is_reached;
}

/// Front points for the faces where the cut ends now. Edges whose division would make a tet that is not sound are left
/// out of the cut, and the front looked at again.
void StrokeCut::place_front(const TetMesh& mesh, std::span<const std::uint32_t> masters, const FrontRules& given,
                            CutStatistics& statistics) {
  const OlderWalls older = older_walls(mesh);
  FrontRules rules = given;
  rules.spacing = spacing_;
  rules.beside = beside();
  rules.older = &older;
  update_front_points(mesh, sheet_, masters, rules, step_, complex_);
  while (true) {
    const std::vector<std::uint32_t> dirty = complex_.dirty();
    update_front_points(mesh, sheet_, dirty, rules, step_, complex_);
    const auto blocked = block_unsound(mesh, complex_.dirty(), snap() > 0, templates_, complex_);
    if (blocked.empty()) return;
    statistics.blocked_edges += blocked.size();
    for (const std::uint32_t edge : blocked) refresh_around(edge);
  }
}

void StrokeCut::count_cut(CutStatistics& statistics) {
  for (const std::uint32_t index : complex_.dirty()) {
    Master& master = complex_[index];
    if (!master.is_cut && master.flagged != 0) {
      master.is_cut = true;
      ++statistics.cut_tets;
    }
  }
}

void StrokeCut::rebuild(const CutContext& context, bool closes_pinched) {
  const std::size_t tets = context.mesh.tet_count(), vertices = context.mesh.vertex_count();
  Transaction transaction(context.mesh);
  const double crumb_share = snap() > 0 ? kCrumbShare : kExactCrumbShare;
  const RebuildStatistics done = rebuild_.run(
      transaction, complex_, sheet_, {tags_, crumb_share, spacing_, snap() * spacing_, keeps_pieces_, closes_pinched});
  Step step = transaction.commit();
  context.statistics.created_tets += growth(tets, context.mesh.tet_count());
  context.statistics.new_vertices += growth(vertices, context.mesh.vertex_count());
  context.statistics.copied_vertices += done.copied_vertices;
  // A step may close more sides than it opens; the sum over a stroke counts what is open at its end.
  context.statistics.incision_faces += growth(done.own_sides_before, done.own_sides_after) / 2;
  context.statistics.crumbs_kept += done.crumbs_kept;
  context.statistics.latent_faces += done.latent_faces;
  for (const Side side : rebuild_.left_pinched()) {
    if (tags_.own(context.mesh.link(side))) pinched_.push_back(side);
  }
  must_finish_ = done.left_pinched > 0;
  for (const auto& [from, to] : rebuild_.renamed()) {
    for (OnVertex& on : on_) on.vertex = on.vertex == from ? to : on.vertex;
  }
  context.journal.append_if_changed(std::move(step));
}

/// For each crossing whether the divided masters around its edge are of more than one piece.
std::vector<bool> StrokeCut::find_apart(const TetMesh& mesh, std::span<const StripCrossing> crossings) {
  std::vector<TetId> seeds;
  std::vector<std::size_t> ends;
  for (const StripCrossing& crossing : crossings) {
    if (crossing.count % 2 == 1) {
      complex_.for_each_around(crossing.edge, [&](std::uint32_t m) {
        if (!complex_[m].is_divided()) return;
        const auto children = complex_.children(complex_[m]);
        seeds.insert(seeds.end(), children.begin(), children.end());
      });
    }
    ends.push_back(seeds.size());
  }
  std::vector<bool> is_apart(crossings.size(), false);
  if (pieces_.find(mesh, seeds) < 2) return is_apart;
  for (std::size_t k = 0, i = 0; k < crossings.size(); ++k) {
    for (const std::size_t first = i; i < ends[k]; ++i) {
      if (pieces_.piece_of(i) != pieces_.piece_of(first)) is_apart[k] = true;
    }
  }
  return is_apart;
}

std::vector<StrokeCut::RecrossedColumn> StrokeCut::recrossed_columns(const TetMesh& mesh, const Strip& strip) {
  ++step_;
  looked_at_ = nullptr;
  met_ = &walk_.find(mesh, strip, surface_, complex_, step_);
  crossed_ = &crossings_.find(mesh, strip, *met_, complex_, step_);
  const std::vector<bool> is_apart = find_apart(mesh, *crossed_);
  std::vector<RecrossedColumn> columns;
  for (std::size_t k = 0; k < crossed_->size(); ++k) {
    const StripCrossing& crossing = (*crossed_)[k];
    if (crossing.count % 2 == 0 || !(is_apart[k] || complex_.edges()[crossing.edge].is_crossed)) continue;
    columns.push_back({strip.surface.triangles[crossing.triangle].column, is_apart[k], false});
  }
  for_each_left(mesh, strip, [&](const SheetCrossings& crossings) {
    columns.push_back({strip.surface.triangles[crossings.triangle].column, false, true});
  });
  std::sort(columns.begin(), columns.end(), [](const RecrossedColumn& a, const RecrossedColumn& b) {
    return std::tuple(a.column, !a.is_apart, !a.is_left) < std::tuple(b.column, !b.is_apart, !b.is_left);
  });
  columns.erase(std::unique(columns.begin(), columns.end(),
                            [](const RecrossedColumn& a, const RecrossedColumn& b) { return a.column == b.column; }),
                columns.end());
  return columns;
}

bool StrokeCut::crosses_own_cut(const CutContext& context, const Strip& strip, double least_apart) {
  if (sheet_.strips().empty()) return false;
  const TetMesh& mesh = context.mesh;
  look(context, strip);
  looked_at_ = &strip;
  return std::any_of(crossed_->begin(), crossed_->end(), [&](const StripCrossing& crossing) {
    const ClosedEdge& edge = complex_.edges()[crossing.edge];
    if (crossing.count % 2 == 0 || !edge.is_crossed || std::abs(crossing.t - edge.t) < least_apart ||
        sheet_.travel() - edge.travel < kCornerTravel * spacing_) {
      return false;
    }
    bool is_done = true;
    complex_.for_each_around(crossing.edge, [&](std::uint32_t m) { is_done &= !has_odd_face(complex_[m].flagged); });
    return is_done && !is_graze(mesh, strip, crossing);
  });
}

/// Whether a strip crosses an edge at a vertex that is settled.
bool StrokeCut::is_left(const StripCrossing& crossing) const {
  const ClosedEdge& edge = complex_.edges()[crossing.edge];
  if (crossing.count % 2 == 0) return false;
  bool is_left = complex_.is_settled(edge.a) || complex_.is_settled(edge.b);
  complex_.for_each_around(crossing.edge, [&](std::uint32_t m) { is_left |= complex_.is_half_baked(m); });
  return is_left;
}

/// Calls `visit(crossings)` for the edges of what the blade has left that the strip, last looked for, crosses.
template <class Visit>
void StrokeCut::for_each_left(const TetMesh& mesh, const Strip& strip, Visit&& visit) {
  for (const StripCrossing& crossing : *crossed_) {
    if (is_left(crossing)) visit(crossing);
  }
  left_sides_.begin(mesh, strip.sheet);
  for (const TetVertices& v : walk_.left_behind()) {
    for (const auto& [i, j] : kEdgeCorners) {
      const auto [a, b] = std::minmax(v[i], v[j]);
      const SheetCrossings crossings = find_crossings(mesh, strip.sheet, left_sides_, a, b);
      if (crossings.is_odd()) visit(crossings);
    }
  }
}

bool StrokeCut::comes_back(const TetMesh& mesh, const Strip& strip) {
  bool comes_back = false;
  if (sheet_.strips().empty()) return false;
  for_each_left(mesh, strip, [&](const SheetCrossings& /*crossings*/) { comes_back = true; });
  return comes_back;
}

/// Whether two crossings of an edge, by the sheet so far and by a strip, belong to one smooth part: the cut follows the
/// chord, as within one strip.
bool StrokeCut::is_graze(const TetMesh& mesh, const Strip& strip, const StripCrossing& crossing) const {
  const ClosedEdge& edge = complex_.edges()[crossing.edge];
  const Vec3 place = mesh.rest(edge.a) + crossing.t * (mesh.rest(edge.b) - mesh.rest(edge.a));
  return incise::is_graze(
      edge.position, edge.normal, place, strip.sheet.normal(crossing.triangle), [&](const Vec3& middle, double reach) {
        return sheet_.closest(middle, reach).is_valid() || strip.sheet.tree().closest(middle, reach).is_valid();
      });
}

bool StrokeCut::touches(const TetMesh& mesh, const SweptSurface& surface) const {
  bool does_touch = false;
  for (const SweptTriangle& triangle : surface.triangles) {
    const std::array<SosPoint, 3> p = {surface.points[triangle.points[0]], surface.points[triangle.points[1]],
                                       surface.points[triangle.points[2]]};
    const auto look_at = [&](Side side) {
      const auto v = mesh.vertices(side);
      does_touch = does_touch ||
                   triangles_cross(p, {SosPoint{mesh.rest(v[0]), v[0].value}, SosPoint{mesh.rest(v[1]), v[1].value},
                                       SosPoint{mesh.rest(v[2]), v[2].value}});
    };
    for_each_side_near(mesh, surface_, {p[0].position, p[1].position, p[2].position}, look_at);
    surface_.for_each_waiting(mesh, look_at);
  }
  return does_touch || locate(mesh, surface_, surface.points.back()).is_valid();
}

SnapRules StrokeCut::snap_rules(const TetMesh& mesh) {
  SnapRules rules{snap(), spacing_, {}};
  if (!keeps_pieces_) return rules;
  rules.hangs_together = [this, &mesh](std::span<const std::uint32_t> masters) {
    std::vector<TetId> tets;
    for (const std::uint32_t m : masters) {
      const auto children = complex_.children(complex_[m]);
      tets.insert(tets.end(), children.begin(), children.end());
    }
    return pieces_.find(mesh, tets) == 1;
  };
  return rules;
}

/// Chooses vertices that take part in the cut, and has the tets around them made anew.
void StrokeCut::choose_on(const TetMesh& mesh, std::span<const std::uint32_t> masters, const SnapRules& rules,
                          CutStatistics& statistics) {
  const std::vector<OnVertex> on = choose_on_vertices(mesh, sheet_, rules, masters, complex_, snapping_);
  for (const OnVertex& vertex : on) {
    for (const std::uint32_t master : complex_.star(mesh, vertex.master, vertex.vertex)) complex_.mark_dirty(master);
  }
  statistics.snapped_vertices += on.size();
  on_.insert(on_.end(), on.begin(), on.end());
}

/// Where the sheet ends a little beyond the rim of an older cut, that cut ends here: what is crossed between the two
/// would make slivers of no use.
void StrokeCut::let_go_of_older_cut(const TetMesh& mesh) {
  const OlderWalls older = older_walls(mesh);
  if (!older.exist()) return;
  std::vector<std::uint32_t> waiting;  // edges; each that is let go brings its neighbours here
  const auto wait = [&](const Master& master) {
    for (unsigned e = 0; e < 6; ++e) {
      if (needs_split(master, e) && complex_.edges()[master.edges[e]].is_crossed) waiting.push_back(master.edges[e]);
    }
  };
  for (const std::uint32_t i : wake_.settling()) {
    if (has_odd_face(complex_[i].flagged)) wait(complex_[i]);
  }
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    const ClosedEdge& edge = complex_.edges()[waiting[i]];
    const double scale = uncut_length((mesh.rest(edge.b) - mesh.rest(edge.a)).norm(), spacing_);
    if (!edge.is_flagged() || !may_let_go(waiting[i]) || !ends_at_older_cut(older, waiting[i], scale)) continue;
    complex_.toggle(waiting[i]);
    refresh_around(waiting[i]);
    complex_.for_each_around(waiting[i], [&](std::uint32_t master) { wait(complex_[master]); });
  }
}

/// Whether the tets around an edge are being settled: all, and now.
bool StrokeCut::may_let_go(std::uint32_t edge) const {
  bool is_settled = wake_.is_near(complex_.edges()[edge].a) || wake_.is_near(complex_.edges()[edge].b);
  complex_.for_each_around(edge, [&](std::uint32_t m) { is_settled |= complex_[m].is_settled; });
  return !is_settled;
}

/// Whether the cut ends in faces that have a certain edge, and nowhere in them further than an older cut reaches.
bool StrokeCut::ends_at_older_cut(const OlderWalls& older, std::uint32_t index, double scale) const {
  const ClosedEdge& edge = complex_.edges()[index];
  const auto is_there = [&](const Vec3& place) {
    return older.pass(place, edge.normal, beside() * scale, kLetGo * scale);
  };
  if (!is_there(edge.position)) return false;
  bool does_end = false, goes_on = false;
  complex_.for_each_around(index, [&](std::uint32_t m) {
    const Master& master = complex_[m];
    for (unsigned s = 0; s < 4; ++s) {
      if (!is_odd_side(master, s) || !has_edge(master, s, index)) continue;
      const std::uint32_t end = master.points[s];
      does_end = true;
      goes_on |= end != Master::kNone && complex_.point(end).is_explained && !is_there(complex_.point(end).pierced);
    }
  });
  return does_end && !goes_on;
}

/// The blade goes no further: its border is where it is, but for what lies at an older cut.
void StrokeCut::settle_front(const CutContext& context, const FrontRules& rules) {
  if (sheet_.strips().empty()) return;
  prepare(context.mesh, context.journal);
  let_go_of_older_cut(context.mesh);
  if (complex_.dirty().empty()) return;
  ++step_;
  const std::vector<std::uint32_t> changed = complex_.dirty();
  place_front(context.mesh, changed, rules, context.statistics);
}

/// What the sheet does to these masters is known: their vertices land, and their front points move to their last place.
void StrokeCut::settle(const CutContext& context, const FrontRules& rules) {
  settle_front(context, rules);
  if (!complex_.dirty().empty()) rebuild(context, true);
  land(context);
  place_front_points(context.mesh, sheet_, wake_, kFinalMargin, complex_);
  if (!complex_.dirty().empty()) rebuild(context, true);
  if (make_idle_cones_whole(context.mesh)) rebuild(context, true);
}

void StrokeCut::bake(const CutContext& context, const FrontRules& rules, std::span<const std::uint32_t> pinned) {
  const StageZone zone(context.times, Stage::kSeparate);
  bake_behind(context, rules, pinned);
  complex_.hold_vertices(context.mesh);
}

void StrokeCut::bake_behind(const CutContext& context, const FrontRules& rules, std::span<const std::uint32_t> pinned) {
  wake_.find(context.mesh, complex_, sheet_.strips().back()->row, (keeps_pieces_ ? kMovingBand : kBand) * spacing_,
             pinned);
  if (wake_.settling().empty()) return;
  settle(context, rules);
  if (wake_.let_go(complex_) == 0) return;
  surface_.take_in(context.mesh, [&](Side side) { return is_own_wall(context.mesh, side); });
  walk_.forget_released(complex_);
  std::erase_if(snapping_.coincident, [&](VertexId v) { return !complex_.is_on(v); });
}

bool StrokeCut::is_pinched(const TetMesh& mesh) {
  const bool is_pinched = has_pinched_edges(mesh, pinched_, walker_);
  if (!is_pinched) pinched_.clear();
  return is_pinched;
}

void StrokeCut::finish(const CutContext& context, const FrontRules& rules) {
  const StageZone zone(context.times, Stage::kSeparate);
  wake_.find(context.mesh, complex_, {}, 0.0, {});
  settle(context, rules);
  for (std::uint32_t i = 0; i < complex_.size(); ++i) {
    if (complex_[i].split != nullptr && (complex_[i].is_pinched || complex_[i].has_latent_faces))
      complex_.mark_dirty(i);
  }
  if (!complex_.dirty().empty()) {
    rebuild(context, false);
    const std::vector<Side> opened = sides_of(rebuild_.opened());
    pinched_.insert(pinched_.end(), opened.begin(), opened.end());
  }
  if (!pinched_.empty()) part_edges(context, pinched_);
  forget();
}

/// Whether nothing in a master is split or open: its front points divide it for nothing.
bool StrokeCut::is_idle_cone(const TetMesh& mesh, const Master& master) const {
  if (!Divider::is_cone(master) || split_edges(master) != 0) return false;
  const auto& inner = master.split->inner;
  return std::none_of(inner.begin(), inner.end(),
                      [&](const auto& sides) { return mesh.link(complex_.facet(master, sides[0])).is_boundary(); });
}

/// Takes the front points out of sides between masters in which nothing came open. Returns whether there were any.
bool StrokeCut::make_idle_cones_whole(const TetMesh& mesh) {
  std::vector<std::uint32_t> needless;
  const auto is_idle = [&](std::uint32_t index) {
    return index == Master::kNone ||
           (!wake_.has_near(complex_[index]) && !complex_.is_half_baked(index) && is_idle_cone(mesh, complex_[index]));
  };
  for (const std::uint32_t i : wake_.settling()) {
    if (!is_idle(i)) continue;
    for (unsigned s = 0; s < 4; ++s) {
      const std::uint32_t at = complex_[i].points[s];
      if (at != Master::kNone && is_idle(complex_[i].behind[s])) needless.push_back(at);
    }
  }
  std::sort(needless.begin(), needless.end());
  needless.erase(std::unique(needless.begin(), needless.end()), needless.end());
  for (const std::uint32_t at : needless) {
    for (const std::uint32_t master : complex_.point(at).masters) {
      if (master != Master::kNone) complex_.mark_dirty(master);
    }
    complex_.remove_point(at);
  }
  return !needless.empty();
}

/// The vertices that took part in the cut move onto its sheet, once nothing near them is open.
void StrokeCut::land(const CutContext& context) {
  const auto waits = [&](const OnVertex& on) { return wake_.is_near(on.vertex); };
  const auto first = std::stable_partition(on_.begin(), on_.end(), waits);
  if (first == on_.end()) return;
  const std::vector<OnVertex> landing(first, on_.end());
  on_.erase(first, on_.end());
  Transaction transaction(context.mesh, true);
  context.statistics.bent_vertices += move_on_vertices(transaction, sheet_, snap(), landing, complex_);
  context.journal.append_if_changed(transaction.commit());
}

void StrokeCut::part_edges(const CutContext& context, std::span<const Side> walls) {
  const std::size_t tets = context.mesh.tet_count(), vertices = context.mesh.vertex_count();
  Transaction transaction(context.mesh);
  context.statistics.pinched_edges += part_pinched_edges(transaction, walls, walker_);
  Step step = transaction.commit();
  context.statistics.created_tets += growth(tets, context.mesh.tet_count());
  context.statistics.new_vertices += growth(vertices, context.mesh.vertex_count());
  context.journal.append_if_changed(std::move(step));
}

}  // namespace v0
}  // namespace incise
