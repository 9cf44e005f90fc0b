// SPDX-License-Identifier: Apache-2.0
// Each row is compared with what the stroke has swept: in the slit it is held, near it it waits, where it closes a
// ring or meets the sheet the sheet ends, and else it makes a strip (docs/internals.md, 3.1).
#include "cut/blade_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cut/blade_constants.h"
#include "cut/twist.h"
#include "incise/geom/closest.h"

namespace incise {
inline namespace v0 {

namespace {

std::array<std::uint64_t, 2> keys_of(const SosPoint& a, const SosPoint& b) {
  return {std::min(a.key, b.key), std::max(a.key, b.key)};
}

/// How far the point moves that moves furthest.
double step_between(const std::vector<SosPoint>& from, const std::vector<SosPoint>& to) {
  double step = 0;
  for (std::size_t c = 0; c < to.size(); ++c) step = std::max(step, (to[c].position - from[c].position).norm());
  return step;
}

double length_of(const std::vector<std::vector<SosPoint>>& rows) {
  double length = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) length += step_between(rows[i - 1], rows[i]);
  return length;
}

}  // namespace

void BladeMotion::begin(std::span<const Vec3> row, double spacing) {
  next_key_ = kFirstBladeKey;
  front_.clear();
  go_on(row, spacing);
}

void BladeMotion::begin_at(std::vector<SosPoint> front, std::uint64_t next_key, double spacing) {
  next_key_ = next_key;
  front_ = std::move(front);
  go_on(places_of(front_), spacing);
}

void BladeMotion::note_laid(std::span<const Vec3> before) {
  for (std::size_t c = 0; c < front_.size(); ++c) ways_[c] = front_[c].position - before[c];
  is_swept_.assign(front_.size() - 1, true);
  is_first_strip_ = false;
  before_ = front_;
  course_.begin(before, spacing_);
  course_.follow(front_);
}

void BladeMotion::go_on(std::span<const Vec3> row, double spacing) {
  spacing_ = spacing;
  is_closed_ = row.size() > 2 && row.front() == row.back();
  front_ = number(row);
  is_swept_.assign(row.size() - 1, false);
  last_.assign(row.begin(), row.end());
  left_ = last_;
  is_first_strip_ = true;
  ways_.assign(row.size(), Vec3::Zero());
  trail_.clear();
  beginning_ = {front_};
  next_over_ = 0;
  starts_at_wall_ = false;
  course_.begin(row, spacing);
  reaches_on_ = {};
  seams_ = {};
  seam_segments_.clear();
}

/// A row's points: one that stands where the front does is the front's.
BladeMotion::Row BladeMotion::number(std::span<const Vec3> row) {
  Row points(row.size());
  const bool stays_closed = is_closed_ && row.front() == row.back();
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (stays_closed && c + 1 == row.size()) {
      points[c] = points[0];
    } else if (!front_.empty() && row[c] == front_[c].position) {
      points[c] = front_[c];
    } else if (c > 0 && row[c] == row[c - 1]) {
      points[c] = points[c - 1];
    } else {
      points[c] = {row[c], next_key_++};
    }
  }
  return points;
}

double BladeMotion::distance2_to_front(const Vec3& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c + 1 < front_.size(); ++c) {
    const Vec3 &a = front_[c].position, &b = front_[c + 1].position;
    least = std::min(least, closest_on_triangle(point, a, b, b).distance2);
  }
  return least;
}

/// Whether all of a point's way lies in the slit behind the front. A blade that comes to the sheet from elsewhere, as
/// at the end of a ring, has cut up to there.
bool BladeMotion::goes_in_slit(const Vec3& from, const Vec3& to, const OwnSheet& sheet) const {
  const double reach = kSlitShare * spacing_;
  if (!is_on(to, sheet, reach)) return false;
  const double parts = std::clamp(std::ceil(2.0 * (to - from).norm() / reach), 2.0, kMostSlitSamples);
  for (double k = 1; k < parts; ++k) {
    if (!is_on(from + (k / parts) * (to - from), sheet, reach)) return false;
  }
  return true;
}

/// Within a distance of what the stroke has swept, and not ahead of its front.
bool BladeMotion::is_on(const Vec3& point, const OwnSheet& sheet, double distance) const {
  const SheetPlace place = sheet.closest(point, distance);
  if (!place.is_valid()) return false;
  const double tolerance = 1e-9 * spacing_;
  return distance2_to_front(place.point) > tolerance * tolerance;
}

/// How far a way from a place on the sheet leads away from it, in length units, at most `2 kWaitsNearSlit` spacings.
double BladeMotion::furthest_from(const OwnSheet& sheet, const Vec3& from, const Vec3& to) const {
  const double most = 2.0 * kWaitsNearSlit * spacing_;
  const double parts =
      std::clamp(std::ceil(4.0 * (to - from).norm() / (kWaitsNearSlit * spacing_)), 1.0, kMostSlitSamples);
  double furthest = 0;
  for (double k = parts; k >= 1 && furthest < most; --k) {
    const SheetPlace place = sheet.closest(from + (k / parts) * (to - from), most);
    furthest = std::max(furthest, place.is_valid() ? std::sqrt(place.distance2) : most);
  }
  return furthest;
}

/// Whether all that moves of a blade comes, from elsewhere, to what it swept well before: a ring is full, however
/// small.
bool BladeMotion::closes_ring(std::span<const std::size_t> points, std::span<const Vec3> row,
                              const OwnSheet& sheet) const {
  const double before = sheet.travel() - kFrontShare * spacing_;
  return std::all_of(points.begin(), points.end(), [&](std::size_t c) {
    return sheet.closest(row[c], kSlitShare * spacing_, before).is_valid() &&
           furthest_from(sheet, front_[c].position, row[c]) > kLeavesFor * spacing_;
  });
}

/// Whether a blade may still come back to its way: it moves beside its front, or behind it, without getting on, and is
/// close to what it has swept all the way. Laid at once, such strips would fold the sheet more finely than elements can
/// follow. One that goes round to where it began has left the sheet on its way.
bool BladeMotion::waits(std::span<const std::size_t> points, std::span<const Vec3> row, const OwnSheet& sheet,
                        bool flushes) const {
  const auto count = static_cast<double>(points.size());
  const FrontCourse::Progress progress = course_.progress(front_, row, points);
  if (!progress.is_known) return !flushes && progress.all < kSlitShare * spacing_ * count;
  if (progress.on >= (flushes ? 0.0 : kGetsOn) * progress.all) return false;
  if (closes_ring(points, row, sheet)) return false;
  double sum = 0;
  for (const std::size_t c : points) sum += furthest_from(sheet, front_[c].position, row[c]);
  return sum < kWaitsNearSlit * spacing_ * count;
}

/// Whether a blade on its way from where it left its slit to a row comes by its front.
bool BladeMotion::comes_by_front(std::span<const std::size_t> points, std::span<const Vec3> to) const {
  double sum = 0;
  for (const std::size_t c : points) {
    sum += std::sqrt(closest_on_triangle(front_[c].position, left_[c], to[c], to[c]).distance2);
  }
  return sum <= kByFront * spacing_ * static_cast<double>(points.size());
}

SweptSurface BladeMotion::lay(const Row& from, const Row& to) const {
  SweptSurface surface;
  const auto add = [&](const SosPoint& point) {
    const auto known = std::find_if(surface.points.begin(), surface.points.end(),
                                    [&](const SosPoint& p) { return p.key == point.key; });
    if (known != surface.points.end()) return static_cast<std::uint32_t>(known - surface.points.begin());
    surface.points.push_back(point);
    return static_cast<std::uint32_t>(surface.points.size() - 1);
  };
  const auto add_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t column) {
    if (a != b && b != c && c != a) surface.triangles.push_back({{a, b, c}, 0, static_cast<std::uint32_t>(column)});
  };
  for (std::size_t c = 0; c + 1 < to.size(); ++c) {
    if (from[c].key == to[c].key && from[c + 1].key == to[c + 1].key) continue;
    const std::uint32_t a = add(from[c]), b = add(from[c + 1]), d = add(to[c]), e = add(to[c + 1]);
    add_triangle(a, b, e, c);
    add_triangle(a, e, d, c);
  }
  return surface;
}

/// Whether a strip meets the sheet so far well behind the front. Beside it, where elements are still open, crossings
/// are counted and nothing is lost.
bool BladeMotion::meets(const SweptSurface& surface, const OwnSheet& sheet) const {
  Box box;
  for (const SosPoint& p : surface.points) box.extend(p.position);
  const Vec3 margin = Vec3::Constant(kMeetingShare * spacing_);
  return sheet.any_near({box.lo - margin, box.hi + margin}, [&](const Strip& strip) {
    return sheet.travel() - strip.travel > kFrontShare * spacing_ &&
           strips_meet(surface, strip.surface, strip.sheet, kMeetingShare * spacing_);
  });
}

/// Whether a point of the blade comes, from elsewhere, to beside where the blade was well before: as at the end of a
/// full turn. The two ends of the sheet lie beside each other there, and miss each other by what the blade trembled.
bool BladeMotion::comes_round(const Row& to, const OwnSheet& sheet) const {
  const auto distance2 = [&](const SosPoint& point) {
    return sheet.closest(point.position, kSlitShare * spacing_, sheet.travel() - kFrontShare * spacing_).distance2;
  };
  const double reach2 = std::pow(kSlitShare * spacing_, 2), on2 = std::pow(kMeetingShare * spacing_, 2);
  for (std::size_t c = 0; c < to.size(); ++c) {
    if (to[c].key == front_[c].key) continue;
    const double now2 = distance2(to[c]);
    if (now2 <= reach2 && now2 > on2 && distance2(front_[c]) > reach2) return true;
  }
  return false;
}

/// The first rows of a stroke, as far as a sheet that comes round goes over them once more.
void BladeMotion::note_beginning(const Row& to) {
  if (length_of(beginning_) < kLaidAgain * spacing_) beginning_.push_back(to);
}

/// Whether a blade comes, from elsewhere, to where its stroke began.
bool BladeMotion::comes_to_beginning(const Row& to) const {
  const Row& first = beginning_.front();
  const auto is_there = [&](const Vec3& point) {
    for (std::size_t c = 0; c + 1 < first.size(); ++c) {
      const Vec3 &a = first[c].position, &b = first[c + 1].position;
      if (closest_on_triangle(point, a, b, b).distance2 <= std::pow(kSlitShare * spacing_, 2)) return true;
    }
    return false;
  };
  if (length_of(beginning_) < kLaidAgain * spacing_) return false;
  for (std::size_t c = 0; c < to.size(); ++c) {
    if (!is_there(to[c].position) || is_there(front_[c].position)) return false;
  }
  return true;
}

BladeMotion::Move BladeMotion::go_over_beginning(const Surroundings& around) {
  if (next_over_ == 0 || next_over_ == beginning_.size()) {
    next_over_ = 0;
    return {};
  }
  return move_to(number(places_of(beginning_[next_over_++])), around);
}

/// The segments of the front that the strip to `to` leaves behind.
std::vector<std::array<std::uint64_t, 2>> BladeMotion::inner_segments(const Row& to) const {
  std::vector<std::array<std::uint64_t, 2>> inner = seam_segments_;
  for (std::size_t c = 0; c + 1 < to.size(); ++c) {
    const bool stays = to[c].key == front_[c].key && to[c + 1].key == front_[c + 1].key;  // the cut still ends there
    if (!stays && is_swept_[c]) inner.push_back(keys_of(front_[c], front_[c + 1]));
  }
  return inner;
}

BladeMotion::Move BladeMotion::move_to(const Row& to, const Surroundings& around) {
  Move move;
  SweptSurface surface = lay(front_, to);
  if (surface.triangles.empty()) {
    front_ = to;
    return move;
  }
  append(surface, seams_);
  for (std::size_t c = 0; c < to.size(); ++c) {
    if (to[c].key != front_[c].key) ways_[c] = to[c].position - front_[c].position;
  }
  Segments inner = inner_segments(to);
  if (around.has_older_cuts) {
    if (is_first_strip_) reach_back(surface, around);
    reach_from_ends(surface, to, around, inner);
  }
  move.strip = std::make_unique<Strip>(std::move(surface), inner);
  move.strip->row = to;
  note_swept(to);
  before_ = front_;
  leave_behind(front_);
  front_ = to;
  left_ = front();
  course_.follow(front_);
  is_first_strip_ = false;
  seams_ = {};
  seam_segments_.clear();
  return move;
}

/// The rows behind the front, as far as a new sheet overlaps the one before it.
void BladeMotion::leave_behind(const Row& row) {
  trail_.push_back(row);
  double travel = 0;
  std::size_t first = trail_.size() - 1;
  for (; first > 0 && travel < kLaidAgain * spacing_; --first) travel += step_between(trail_[first - 1], trail_[first]);
  trail_.erase(trail_.begin(), trail_.begin() + static_cast<std::ptrdiff_t>(first));
}

/// The next strip is the first of a sheet that starts at a row.
void BladeMotion::start_sheet(const Row& from) {
  front_ = from;
  is_swept_.assign(from.size() - 1, false);
  reaches_on_ = {};
  is_first_strip_ = true;
}

std::unique_ptr<Strip> BladeMotion::lay_anew(const Surroundings& around) {
  const Row to = front_;
  start_sheet(before_);
  if (!trail_.empty()) trail_.pop_back();
  return move_to(to, around).strip;
}

void BladeMotion::note_swept(const Row& to) {
  for (std::size_t c = 0; c + 1 < to.size(); ++c) {
    if (to[c].key != front_[c].key || to[c + 1].key != front_[c + 1].key) is_swept_[c] = true;
  }
}

BladeMotion::Proposal BladeMotion::propose(std::span<const Vec3> row) {
  Proposal proposal;
  proposal.row = number(row);
  proposal.surface = lay(front_, proposal.row);
  return proposal;
}

BladeMotion::Row BladeMotion::divided_row(const Row& row, const std::vector<std::vector<double>>& shares) {
  Row points = {row.front()};
  for (std::size_t c = 0; c + 1 < row.size(); ++c) {
    const SosPoint &a = row[c], &b = row[c + 1];
    for (std::size_t k = 0; k + 1 < shares[c].size(); ++k) {
      points.push_back({a.position + shares[c][k] * (b.position - a.position), next_key_++});
    }
    points.push_back(b);
  }
  return points;
}

/// The divided front is another polyline, if only by rounding: triangles without area close the seam.
void BladeMotion::refine(const std::vector<std::vector<double>>& shares) {
  Row refined = {front_.front()};
  for (std::size_t c = 0; c + 1 < front_.size(); ++c) {
    const SosPoint &a = front_[c], &b = front_[c + 1];
    std::vector<SosPoint> fan = {a};
    for (std::size_t k = 0; k + 1 < shares[c].size(); ++k) {
      fan.push_back({a.position + shares[c][k] * (b.position - a.position), next_key_++});
    }
    fan.push_back(b);
    for (std::size_t k = 1; k + 1 < fan.size(); ++k) {
      SweptSurface seam;
      seam.points = {a, fan[k], fan[k + 1]};
      seam.triangles.push_back({{0, 1, 2}, 0, static_cast<std::uint32_t>(c)});
      append(seams_, seam);
    }
    if (fan.size() > 2) seam_segments_.push_back(keys_of(a, b));
    refined.insert(refined.end(), fan.begin() + 1, fan.end());
  }
  for (std::vector<Row>* rows : {&trail_, &beginning_}) {
    for (Row& row : *rows) row = divided_row(row, shares);
  }
  std::vector<bool> is_swept;
  for (std::size_t c = 0; c < shares.size(); ++c) {
    is_swept.insert(is_swept.end(), shares[c].size(), bool{is_swept_[c]});
  }
  is_swept_ = std::move(is_swept);
  front_ = std::move(refined);
  ways_ = divided(ways_, shares);
  last_ = divided(last_, shares);
  left_ = divided(left_, shares);
  course_.refine(shares);
  if (is_first_strip_) {  // nothing was swept yet: there is no seam
    seams_ = {};
    seam_segments_.clear();
  }
}

std::vector<Vec3> BladeMotion::places_of(const Row& row) {
  std::vector<Vec3> points;
  for (const SosPoint& p : row) points.push_back(p.position);
  return points;
}

/// The blade leaves its slit elsewhere than at the front: a new sheet starts in the slit, where it left. In the air it
/// may go anywhere, and come back.
BladeMotion::Move BladeMotion::leave_slit(std::span<const Vec3> row, const OwnSheet& sheet, const Touches& touches,
                                          const Surroundings& around) {
  std::vector<Vec3> start = left_;
  bool is_at_wall = true;
  for (Vec3& p : start) {
    const SheetPlace place = sheet.closest(p, kSlitShare * spacing_);
    is_at_wall &= place.is_valid();
    if (place.is_valid()) p = place.point;
  }
  const Row from = number(start), to = number(row);
  const SweptSurface surface = lay(from, to);
  if (surface.triangles.empty() || !touches(surface)) {
    left_.assign(row.begin(), row.end());
    return {};
  }
  start_sheet(from);
  trail_.clear();
  starts_at_wall_ = is_at_wall;
  course_.begin(start, spacing_);
  Move move = move_to(to, around);
  move.starts_anew = true;
  return move;
}

/// The first row of a sheet reaches back. Where another one of this stroke has come to it, the last strips of that are
/// laid once more, bit for bit: what is cut there is air, and what is not ought to be. Elsewhere it does so where an
/// older cut is found, or is known to be.
void BladeMotion::reach_back(SweptSurface& surface, const Surroundings& around) {
  if (!trail_.empty()) {
    trail_.push_back(front_);
    for (std::size_t i = 0; i + 1 < trail_.size(); ++i) {
      SweptSurface again = lay(trail_[i], trail_[i + 1]);
      for (SweptTriangle& triangle : again.triangles) triangle.reaches_on = true;
      append(surface, again);
    }
    trail_.pop_back();
    return;
  }
  std::vector<Vec3> back(front_.size());
  for (std::size_t c = 0; c < back.size(); ++c) back[c] = -ways_[c];
  Surroundings known = around;
  known.reach = [&](const Vec3& place, const Vec3& outwards, const Vec3& normal) {
    return std::max(starts_at_wall_ ? kThroughSlit * spacing_ : 0.0, around.reach(place, outwards, normal));
  };
  reach_from_row(surface, front_, back, known);
}

/// `outwards`: where the row's points reach on to. Returns the columns that do.
std::vector<std::size_t> BladeMotion::reach_from_row(SweptSurface& surface, const Row& row,
                                                     std::span<const Vec3> outwards, const Surroundings& around) {
  BorderReach reach(around, spacing_, next_key_);
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c + 1 < row.size(); ++c) {
    if (row[c].key == row[c + 1].key) continue;
    const SweptSurface piece = reach.from_row(
        {row[c], outwards[c].normalized()}, {row[c + 1], outwards[c + 1].normalized()}, static_cast<std::uint32_t>(c));
    if (piece.triangles.empty()) continue;
    append(surface, piece);
    columns.push_back(c);
  }
  return columns;
}

/// The traces of the blade's ends. Consecutive pieces share their edge.
void BladeMotion::reach_from_ends(SweptSurface& surface, const Row& to, const Surroundings& around, Segments& inner) {
  const std::size_t last = to.size() - 1;
  for (const unsigned end : {0U, 1U}) {
    const std::size_t tip = end == 0 ? 0 : last, next = end == 0 ? 1 : last - 1;
    const SosPoint from = front_[tip], at = to[tip];
    if (is_closed_ || from.key == at.key) continue;
    const Vec3 out = (at.position - to[next].position).normalized();
    const Vec3 normal = out.cross(at.position - from.position);
    const bool did = reaches_on_[end];
    const double reach_from = around.reach(from.position, out, normal),
                 reach_at = around.reach(at.position, out, normal);
    const bool was_in = did || reach_from > 0, is_in = reach_at > 0;
    reaches_on_[end] = is_in || (was_in && around.is_outside(at.position));
    if (!was_in && !is_in) continue;
    const double reach = std::max(reach_from, reach_at);
    const bool starts = was_in || around.is_outside(from.position);  // else it begins with nothing, and ends so
    const SosPoint old = did ? ends_[end] : starts ? SosPoint{from.position + reach * out, next_key_++} : from;
    ends_[end] = reaches_on_[end] ? SosPoint{at.position + (is_in ? reach_at : reach) * out, next_key_++} : at;
    if (did) inner.push_back(keys_of(from, old));
    const auto column = static_cast<std::uint32_t>(end == 0 ? 0 : last - 1);
    add_reaching_triangle(surface, from, at, ends_[end], column);
    add_reaching_triangle(surface, from, ends_[end], old, column);
  }
}

BladeMotion::Move BladeMotion::reach_on(const Surroundings& around) {
  Move move;
  if (!around.has_older_cuts || is_first_strip_) return move;
  SweptSurface surface;
  Segments inner;
  for (const std::size_t c : reach_from_row(surface, front_, ways_, around)) {
    if (is_swept_[c]) inner.push_back(keys_of(front_[c], front_[c + 1]));
  }
  if (surface.triangles.empty()) return move;
  move.strip = std::make_unique<Strip>(std::move(surface), inner);
  move.strip->row = front_;
  return move;
}

/// A row whose ends stay before older walls that they pass by very little.
std::vector<Vec3> BladeMotion::drawn_back(std::span<const Vec3> row, const Surroundings& around) const {
  std::vector<Vec3> drawn(row.begin(), row.end());
  if (!around.has_older_cuts || is_closed_) return drawn;
  const std::size_t last = row.size() - 1;
  for (const auto& [tip, next] : {std::pair(std::size_t{0}, std::size_t{1}), std::pair(last, last - 1)}) {
    const Vec3 way = row[tip] - row[next];
    const double length = way.norm();
    if (!(length > 0)) continue;
    const double retreat = around.retreat(row[tip], way / length, length);
    if (retreat < kMostRetreat * length) drawn[tip] -= (retreat / length) * way;
  }
  return drawn;
}

/// How far a segment of a row is to stay back on its way from another row, before an older wall that it comes to.
double BladeMotion::retreat_of(std::span<const Vec3> from, std::span<const Vec3> row, std::size_t c,
                               const Surroundings& around) const {
  const double parts =
      std::clamp(std::ceil((row[c + 1] - row[c]).norm() / (kWallShare * spacing_)), 1.0, kMostWallPlaces);
  double retreat = 0;
  for (double k = 0; k <= parts; ++k) {
    const double t = k / parts;
    const Vec3 to = row[c] + t * (row[c + 1] - row[c]);
    const Vec3 way = to - from[c] - t * (from[c + 1] - from[c]);
    const double length = way.norm();
    if (length > 0) retreat = std::max(retreat, around.retreat(to, way / length, length));
  }
  return retreat;
}

/// Points of a row that comes from another one to an older wall, or through it by very little, stay before it: what
/// reaches on from there goes through, and leaves the lip behind alone. If the blade goes on, so do they.
void BladeMotion::stay_before_walls(std::span<const Vec3> from, std::vector<Vec3>& row,
                                    const Surroundings& around) const {
  std::vector<double> retreats(row.size(), 0.0);
  for (std::size_t c = 0; c + 1 < row.size(); ++c) {
    const double retreat = retreat_of(from, row, c, around);
    for (const std::size_t point : {c, c + 1}) retreats[point] = std::max(retreats[point], retreat);
  }
  for (std::size_t c = 0; c < row.size(); ++c) {
    const Vec3 way = row[c] - from[c];
    if (retreats[c] > 0 && way.norm() > 0) row[c] -= std::min(retreats[c] / way.norm(), 1.0) * way;
  }
}

BladeMotion::Move BladeMotion::advance(std::span<const Vec3> given, const OwnSheet& sheet, const Touches& touches,
                                       const Surroundings& around, bool flushes) {
  std::vector<Vec3> row = drawn_back(given, around);
  if (is_first_strip_ && around.has_older_cuts) {
    std::vector<Vec3> start = drawn_back(front(), around);
    stay_before_walls(row, start, around);  // a blade that starts at a wall, or a little behind it, spares that lip
    for (std::size_t c = 0; c < start.size(); ++c) front_[c].position = start[c];
  }
  if (around.has_older_cuts) stay_before_walls(front(), row, around);
  const double least2 = std::pow((flushes ? kStandsStill : kLeastBladeStep) * spacing_, 2);
  std::vector<Vec3> wanted(row.begin(), row.end());
  std::vector<std::size_t> free;  // points that are neither in the slit nor where the front is
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (goes_in_slit(last_[c], row[c], sheet) || (row[c] - front_[c].position).squaredNorm() <= least2) {
      wanted[c] = front_[c].position;
      left_[c] = row[c];
    } else {
      free.push_back(c);
    }
  }
  last_.assign(given.begin(), given.end());
  if (free.empty() || waits(free, row, sheet, flushes)) return {};
  if (!comes_by_front(free, row)) return leave_slit(row, sheet, touches, around);
  const Row to = number(wanted);
  const bool is_full_turn = comes_to_beginning(to);
  const bool does_meet = meets(lay(front_, to), sheet) || comes_round(to, sheet);
  next_over_ = is_full_turn ? 1 : 0;
  Move move = move_to(to, around);
  note_beginning(to);
  move.starts_anew = does_meet;
  move.is_full_turn = is_full_turn;
  return move;
}

BladeMotion::Move BladeMotion::end(const OwnSheet& sheet, const Touches& touches, const Surroundings& around) {
  const std::vector<Vec3> last = last_;
  return advance(last, sheet, touches, around, true);
}

}  // namespace v0
}  // namespace incise
