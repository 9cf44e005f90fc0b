// SPDX-License-Identifier: Apache-2.0
#include "cut/stroke_cut.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cut/dividable.h"
#include "cut/neighbourhood.h"
#include "incise/geom/closest.h"
#include "incise/geom/intersect.h"
#include "incise/mesh/verbs.h"

namespace incise::inline v0 {

namespace {

/// Split points keep this share of their edge on either side, where snapping is on.
constexpr double kSplitClamp = 0.02;
/// Two crossings of one edge closer than this share of it are one graze, not two sheets.
constexpr double kGrazeShare = 0.02;
/// Two crossings of one edge in different steps that are further apart are two passes of the blade.
constexpr double kApart = 0.05;
/// The margin of front points once the blade has stopped: nothing has to be simulated beside them until they are
/// maintained.
constexpr double kFinalMargin = 0.04;
/// An edge crossed twice is bisected at most so often.
constexpr unsigned kMaxBisectionRounds = 8;

}  // namespace

void StrokeCut::begin(std::uint32_t tag) {
  forget();
  tag_ = tag;
}

void StrokeCut::forget() {
  complex_.clear();
  sheet_.clear();
  walk_.clear();
  snapping_.coincident.clear();
  on_.clear();
}

Status StrokeCut::advance(TetMesh& mesh, Journal& journal, std::unique_ptr<Strip> next, const FrontRules& rules,
                          CutStatistics& statistics, StageTimes& times) {
  if (next->sheet.triangle_count() == 0) return {};
  const Strip& strip = sheet_.add(std::move(next));
  std::vector<OnVertex> on;
  {
    const StageZone zone(times, Stage::kCollision);
    collide(mesh, journal, strip);
    flag(mesh, strip);
    walk_.keep_front(mesh, complex_, strip.row);
    on = choose_on_vertices(mesh, sheet_, snap(), *met_, complex_, snapping_);
    for (const OnVertex& vertex : on) {
      for (const std::uint32_t master : complex_.star(mesh, vertex.master, vertex.vertex)) complex_.mark_dirty(master);
    }
    place_front(mesh, rules, statistics);
    count_cut(statistics);
  }
  if (std::size_t{mesh.tet_slots()} + kMostChildren * complex_.dirty().size() >= TetMesh::kMaxTets) {
    return Error{ErrorCode::kOutOfMemory, "the cut would need more than 2^28 tets; use a coarser mesh", {}};
  }
  if (complex_.dirty().empty()) return {};
  for (const std::uint32_t index : *met_) {
    if (complex_[index].is_pinched || complex_[index].has_latent_faces) complex_.mark_dirty(index);
  }
  const StageZone zone(times, Stage::kSubdivide);
  statistics.snapped_vertices += on.size();
  on_.insert(on_.end(), on.begin(), on.end());
  rebuild(mesh, journal, true, statistics);
  return {};
}

/// Finds what the strip meets and crosses; edges crossed twice are bisected in between and looked at again. Not where
/// earlier strips have been: how they pass the new edges would not be known.
void StrokeCut::collide(TetMesh& mesh, Journal& journal, const Strip& strip) {
  first_look_ = step_ + 1;
  for (unsigned round = 0;; ++round) {
    ++step_;
    surface_.follow(mesh, journal);
    met_ = &walk_.find(mesh, strip, surface_, complex_, step_);
    complex_.set_scope(*met_);
    crossed_ = &crossings_.find(mesh, strip, *met_, complex_, step_);
    const std::vector<BetweenCrossings> twice = find_doubly_crossed(mesh, strip, *crossed_, complex_, kGrazeShare);
    if (twice.empty() || round == kMaxBisectionRounds || !bisect(mesh, journal, twice)) {
      return;
    }
  }
}

bool StrokeCut::bisect(TetMesh& mesh, Journal& journal, const std::vector<BetweenCrossings>& between) {
  Transaction transaction(mesh);
  std::vector<TetId> ring;
  for (const BetweenCrossings& place : between) {
    const ClosedEdge edge = complex_.edges()[place.edge];
    if (complex_[place.master].split == nullptr || mesh.is_overshared_at_load(edge.a, edge.b)) continue;
    bool is_whole = !complex_.has_copies(edge.a) && !complex_.has_copies(edge.b);
    complex_.for_each_around(place.edge, [&](std::uint32_t master) {
      is_whole &= !complex_[master].is_divided() && complex_[master].first_met >= first_look_;
    });
    if (!is_whole) continue;
    const SplitEdgePlan plan =
        plan_split_edge(mesh, edge.a, edge.b, complex_.children(complex_[place.master])[0], place.t);
    if (!plan) continue;
    for (const TetId tet : plan.ring) {
      if (const std::uint32_t master = complex_.find(tet); master != Master::kNone) complex_.release(master);
    }
    apply(transaction, plan);
  }
  Step step = transaction.commit();
  if (step.is_empty()) return false;
  journal.append(std::move(step));
  return true;
}

void StrokeCut::refresh_around(std::uint32_t edge) {
  complex_.for_each_around(edge, [&](std::uint32_t master) {
    complex_.refresh_flags(master);
    complex_.mark_dirty(master);
  });
}

/// Takes the strip's crossings into the complex: an edge is flagged while it is crossed an odd number of times.
void StrokeCut::flag(const TetMesh& mesh, const Strip& strip) {
  const double clamp = snap() > 0 ? kSplitClamp : 0.0;
  for (const StripCrossing& crossing : *crossed_) {
    if (crossing.count % 2 == 0) continue;
    ClosedEdge& edge = complex_.edges()[crossing.edge];
    edge.is_blocked |= mesh.touched_itself_at_load() && mesh.is_overshared_at_load(edge.a, edge.b);
    complex_.toggle(crossing.edge);
    if (edge.is_crossed) {
      const double t = 0.5 * (crossing.t + crossing.t_last);
      edge.t = std::min(std::max(crossing.count > 1 ? t : crossing.t, clamp), 1.0 - clamp);
      edge.position = mesh.rest(edge.a) + edge.t * (mesh.rest(edge.b) - mesh.rest(edge.a));
      edge.normal = strip.sheet.normal(crossing.triangle).normalized();
    }
    refresh_around(crossing.edge);
  }
}

/// Front points for the faces where the cut ends now. Edges whose division would make a tet that is not sound are left
/// out of the cut, and the front looked at again.
void StrokeCut::place_front(const TetMesh& mesh, const FrontRules& rules, CutStatistics& statistics) {
  update_front_points(mesh, sheet_, *met_, rules, step_, complex_);
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

void StrokeCut::rebuild(TetMesh& mesh, Journal& journal, bool closes_pinched, CutStatistics& statistics) {
  const std::size_t tets = mesh.tet_count(), vertices = mesh.vertex_count();
  Transaction transaction(mesh);
  const RebuildStatistics done = rebuild_.run(transaction, complex_, sheet_, {tag_, snap() > 0, closes_pinched});
  Step step = transaction.commit();
  statistics.created_tets += mesh.tet_count() - tets;
  statistics.new_vertices += mesh.vertex_count() - vertices;
  statistics.copied_vertices += done.copied_vertices;
  // A step may close more sides than it opens; the sum over a stroke counts what is open at its end.
  const auto opened = static_cast<std::int64_t>(done.opened_sides) - static_cast<std::int64_t>(done.closed_sides);
  statistics.incision_faces += static_cast<std::uint64_t>(opened / 2);
  statistics.crumbs_kept += done.crumbs_kept;
  statistics.latent_faces += done.latent_faces;
  if (!step.is_empty()) journal.append(std::move(step));
}

std::vector<std::uint32_t> StrokeCut::recrossed_columns(const TetMesh& mesh, const Strip& strip) {
  ++step_;
  met_ = &walk_.find(mesh, strip, surface_, complex_, step_);
  crossed_ = &crossings_.find(mesh, strip, *met_, complex_, step_);
  std::vector<std::uint32_t> columns;
  for (const StripCrossing& crossing : *crossed_) {
    if (crossing.count % 2 == 1 && complex_.edges()[crossing.edge].is_crossed) {
      columns.push_back(strip.surface.triangles[crossing.triangle].column);
    }
  }
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

bool StrokeCut::crosses_own_cut(const TetMesh& mesh, const Strip& strip) {
  ++step_;
  met_ = &walk_.find(mesh, strip, surface_, complex_, step_);
  crossed_ = &crossings_.find(mesh, strip, *met_, complex_, step_);
  return std::any_of(crossed_->begin(), crossed_->end(), [&](const StripCrossing& crossing) {
    const ClosedEdge& edge = complex_.edges()[crossing.edge];
    if (crossing.count % 2 == 0 || !edge.is_crossed || std::abs(crossing.t - edge.t) < kApart) return false;
    bool is_done = true;
    complex_.for_each_around(crossing.edge, [&](std::uint32_t m) { is_done &= !has_odd_face(complex_[m].flagged); });
    return is_done;
  });
}

bool StrokeCut::lies_on_walls(const TetMesh& mesh, std::span<const Vec3> row, double distance) const {
  constexpr unsigned kSamples = 64;
  constexpr double kMost = 0.8;
  unsigned inside = 0, on_wall = 0;
  for (std::size_t c = 0; c + 1 < row.size(); ++c) {
    for (unsigned i = 0; i < kSamples; ++i) {
      const Vec3 place = row[c] + ((i + 0.5) / kSamples) * (row[c + 1] - row[c]);
      if (surface_.bounds().distance2(place) > 0) continue;
      const bool is_near = is_near_older_wall(mesh, place, distance);
      on_wall += is_near ? 1U : 0U;
      inside += is_near || locate(mesh, surface_, {place, ~std::uint64_t{0} - 1}).is_valid() ? 1U : 0U;
    }
  }
  return on_wall > 0 && on_wall >= kMost * inside;
}

bool StrokeCut::is_near_older_wall(const TetMesh& mesh, const Vec3& place, double distance) const {
  bool is_near = false;
  const Vec3 reach = Vec3::Constant(distance);
  surface_.for_each_near(mesh, {place - reach, place + reach}, [&](Side side) {
    const std::uint32_t tag = mesh.link(side).tag();
    if (is_near || tag == 0 || tag == tag_) return;
    const auto v = mesh.vertices(side);
    is_near =
        closest_on_triangle(place, mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2])).distance2 <= distance * distance;
  });
  return is_near;
}

bool StrokeCut::touches(const TetMesh& mesh, const SweptSurface& surface) const {
  bool does_touch = false;
  for (const SweptTriangle& triangle : surface.triangles) {
    const std::array<SosPoint, 3> p = {surface.points[triangle.points[0]], surface.points[triangle.points[1]],
                                       surface.points[triangle.points[2]]};
    for_each_side_near(mesh, surface_, {p[0].position, p[1].position, p[2].position}, [&](Side side) {
      const auto v = mesh.vertices(side);
      does_touch = does_touch ||
                   triangles_cross(p, {SosPoint{mesh.rest(v[0]), v[0].value}, SosPoint{mesh.rest(v[1]), v[1].value},
                                       SosPoint{mesh.rest(v[2]), v[2].value}});
    });
  }
  return does_touch || locate(mesh, surface_, surface.points.back()).is_valid();
}

void StrokeCut::finish(TetMesh& mesh, Journal& journal, CutStatistics& statistics, StageTimes& times) {
  const StageZone zone(times, Stage::kSeparate);
  land(mesh, journal, statistics);
  place_front_points(mesh, kFinalMargin, complex_);
  if (!complex_.dirty().empty()) rebuild(mesh, journal, true, statistics);
  for (std::uint32_t i = 0; i < complex_.size(); ++i) {
    if (complex_[i].split != nullptr && (complex_[i].is_pinched || complex_[i].has_latent_faces))
      complex_.mark_dirty(i);
  }
  if (!complex_.dirty().empty()) {
    rebuild(mesh, journal, false, statistics);
    part_edges(mesh, journal, statistics);
  }
  forget();
}

/// The vertices that took part in the cut move onto its sheet.
void StrokeCut::land(TetMesh& mesh, Journal& journal, CutStatistics& statistics) {
  Transaction transaction(mesh, true);
  statistics.bent_vertices += move_on_vertices(transaction, sheet_, snap(), on_, complex_);
  Step step = transaction.commit();
  if (!step.is_empty()) journal.append(std::move(step));
}

void StrokeCut::part_edges(TetMesh& mesh, Journal& journal, CutStatistics& statistics) {
  const std::size_t tets = mesh.tet_count(), vertices = mesh.vertex_count();
  Transaction transaction(mesh);
  statistics.pinched_edges += part_pinched_edges(transaction, rebuild_.opened(), walker_);
  Step step = transaction.commit();
  statistics.created_tets += mesh.tet_count() - tets;
  statistics.new_vertices += mesh.vertex_count() - vertices;
  if (!step.is_empty()) journal.append(std::move(step));
}

}  // namespace incise::inline v0
