// SPDX-License-Identifier: Apache-2.0
#include "cut/blade_motion.h"

#include <algorithm>
#include <cmath>

#include "incise/geom/closest.h"

namespace incise::inline v0 {

namespace {

/// A blade within this many spacings of what it swept before is in its own slit.
constexpr double kSlitShare = 0.25;
/// Points of a blade that moved less than this many spacings wait for more.
constexpr double kLeastStep = 0.05;
/// A strip whose middle lies this close to what was swept before lies on it.
constexpr double kCoverShare = 0.02;
/// Where a sheet meets itself, the new one starts so many spacings behind the front: cutting the same place again
/// changes nothing, and the cut stays whole where they join.
constexpr double kOverlapShare = 3.0;
/// Within so many spacings of travel behind the front a sheet does not count as meeting itself.
constexpr double kFrontShare = 1.5;
/// Strips that fold back onto earlier ones within so many spacings meet them.
constexpr double kMeetingShare = 1e-6;

std::array<std::uint64_t, 2> keys_of(const SosPoint& a, const SosPoint& b) {
  return {std::min(a.key, b.key), std::max(a.key, b.key)};
}

}  // namespace

void BladeMotion::begin(std::span<const Vec3> row, double spacing) {
  spacing_ = spacing;
  next_key_ = kFirstBladeKey;
  front_.clear();
  is_closed_ = row.size() > 2 && row.front() == row.back();
  first_ = front_ = number(row);
  is_swept_.assign(row.size() - 1, false);
  last_.assign(row.begin(), row.end());
  reach_lo_ = reach_hi_ = row.front();
  is_first_strip_ = true;
  is_held_ = false;
}

/// A row's points: one that stands where the front does is the front's.
BladeMotion::Row BladeMotion::number(std::span<const Vec3> row) {
  Row points(row.size());
  const bool returns = !is_first_strip_ && !front_.empty() && returns_to_start(row);
  const bool stays_closed = is_closed_ && row.front() == row.back();
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (returns) {
      points[c] = first_[c];
    } else if (stays_closed && c + 1 == row.size()) {
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

/// Whether the row is the first again, up to rounding, after a way around: not one that went out and back.
bool BladeMotion::returns_to_start(std::span<const Vec3> row) const {
  const double extent = (reach_hi_ - reach_lo_).norm();
  if (first_.size() != row.size()) return false;
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (!((row[c] - first_[c].position).norm() <= 1e-12 * extent)) return false;
  }
  return extent > 0 && front_.front().key != first_.front().key;
}

double BladeMotion::distance2_to_front(const Vec3& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c + 1 < front_.size(); ++c) {
    const Vec3 &a = front_[c].position, &b = front_[c + 1].position;
    least = std::min(least, closest_on_triangle(point, a, b, b).distance2);
  }
  return least;
}

/// Within a distance of what the stroke has swept, and not ahead of its front.
bool BladeMotion::is_on(const Vec3& point, const OwnSheet& sheet, double distance) const {
  const SheetPlace place = sheet.closest(point, distance);
  if (!place.is_valid()) return false;
  const double tolerance = 1e-9 * spacing_;
  return distance2_to_front(place.point) > tolerance * tolerance;
}

/// Whether a strip from the front to a row would lie on what was swept already.
bool BladeMotion::would_cover(const Row& to, const OwnSheet& sheet) const {
  for (std::size_t c = 0; c + 1 < to.size(); ++c) {
    const Vec3 middle = 0.25 * (front_[c].position + front_[c + 1].position + to[c].position + to[c + 1].position);
    if (is_on(middle, sheet, kCoverShare * spacing_)) return true;
  }
  return false;
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
  double travel = 0;
  for (auto strip = sheet.strips().rbegin(); strip != sheet.strips().rend(); ++strip) {
    if (travel > kFrontShare * spacing_ &&
        strips_meet(surface, (*strip)->surface, (*strip)->sheet, kMeetingShare * spacing_)) {
      return true;
    }
    travel += travel_of((*strip)->surface);
  }
  return false;
}

/// Whether a strip passes within an element of what was swept well behind the front.
bool BladeMotion::comes_near(const SweptSurface& surface, const OwnSheet& sheet) const {
  double travel = 0;
  for (auto strip = sheet.strips().rbegin(); strip != sheet.strips().rend(); ++strip) {
    const Sheet& earlier = (*strip)->sheet;
    for (const SweptTriangle& triangle : surface.triangles) {
      if (travel <= kFrontShare * spacing_) break;
      Box box;
      for (const std::uint32_t p : triangle.points) box.extend(surface.points[p].position);
      box.lo.array() -= spacing_;
      box.hi.array() += spacing_;
      bool is_near = false;
      if (box.overlaps(earlier.bounds())) earlier.tree().for_each_overlap(box, [&](std::uint32_t) { is_near = true; });
      if (is_near) return true;
    }
    travel += travel_of((*strip)->surface);
  }
  return false;
}

/// The strip as the first of a new sheet.
std::unique_ptr<Strip> BladeMotion::start_anew(const SweptSurface& surface, const OwnSheet& sheet) const {
  return std::make_unique<Strip>(with_overlap(surface, sheet), std::vector<std::array<std::uint64_t, 2>>());
}

/// The strip together with the last ones before it.
SweptSurface BladeMotion::with_overlap(const SweptSurface& surface, const OwnSheet& sheet) const {
  double travel = 0;
  auto first = sheet.strips().end();
  while (first != sheet.strips().begin() && travel < kOverlapShare * spacing_) {
    const SweptSurface& before = (*--first)->surface;
    if (strips_meet(surface, before, (*first)->sheet, kMeetingShare * spacing_)) {
      ++first;
      break;
    }
    travel += travel_of(before);
  }
  SweptSurface all;
  for (; first != sheet.strips().end(); ++first) append(all, (*first)->surface);
  append(all, surface);
  return all;
}

/// The segments of the front that the strip to `to` leaves behind, and those of the first row that it comes back to.
std::vector<std::array<std::uint64_t, 2>> BladeMotion::inner_segments(const Row& to) const {
  std::vector<std::array<std::uint64_t, 2>> inner;
  const bool returns =
      to.size() == first_.size() && to.front().key == first_.front().key && to.back().key == first_.back().key;
  inner = seam_segments_;
  for (std::size_t c = 0; c + 1 < to.size(); ++c) {
    const bool stays = to[c].key == front_[c].key && to[c + 1].key == front_[c + 1].key;  // the cut still ends there
    if (stays || !is_swept_[c]) continue;
    inner.push_back(keys_of(front_[c], front_[c + 1]));
    if (returns) inner.push_back(keys_of(first_[c], first_[c + 1]));
  }
  return inner;
}

BladeMotion::Move BladeMotion::move_to(const Row& to, const OwnSheet* sheet) {
  Move move;
  SweptSurface surface = lay(front_, to);
  if (surface.triangles.empty()) {
    front_ = to;
    return move;
  }
  append(surface, seams_);
  if (sheet != nullptr && meets(surface, *sheet)) {
    move.starts_anew = true;
    move.strip = start_anew(surface, *sheet);
  } else {
    move.comes_near = sheet != nullptr && comes_near(surface, *sheet);
    if (move.comes_near) move.anew = start_anew(surface, *sheet);
    move.strip = std::make_unique<Strip>(std::move(surface), inner_segments(to));
  }
  move.strip->row = to;
  if (move.anew) move.anew->row = to;
  note_swept(to);
  for (const SosPoint& p : to) {
    reach_lo_ = reach_lo_.cwiseMin(p.position);
    reach_hi_ = reach_hi_.cwiseMax(p.position);
  }
  front_ = to;
  is_first_strip_ = false;
  seams_ = {};
  seam_segments_.clear();
  return move;
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
  std::vector<bool> is_swept;
  for (std::size_t c = 0; c < shares.size(); ++c) {
    is_swept.insert(is_swept.end(), shares[c].size(), bool{is_swept_[c]});
  }
  is_swept_ = std::move(is_swept);
  front_ = std::move(refined);
  if (is_first_strip_) {  // nothing was swept yet: there is no seam
    first_ = front_;
    seams_ = {};
    seam_segments_.clear();
  }
}

std::vector<Vec3> BladeMotion::front() const {
  std::vector<Vec3> points;
  for (const SosPoint& p : front_) points.push_back(p.position);
  return points;
}

/// The blade leaves its slit elsewhere than at the front: a new sheet starts where it left. In the air it may go
/// anywhere, and come back.
BladeMotion::Move BladeMotion::leave_slit(std::span<const Vec3> before, std::span<const Vec3> row,
                                          const Touches& touches) {
  const Row from = number(before), to = number(row);
  Move move;
  SweptSurface surface = lay(from, to);
  if (surface.triangles.empty() || !touches(surface)) return move;
  move.starts_anew = true;
  move.strip = std::make_unique<Strip>(std::move(surface), std::vector<std::array<std::uint64_t, 2>>());
  move.strip->row = to;
  first_ = front_ = from;
  is_swept_.assign(to.size() - 1, false);
  note_swept(to);
  front_ = to;
  is_held_ = false;
  return move;
}

BladeMotion::Move BladeMotion::advance(std::span<const Vec3> row, const OwnSheet& sheet, const Touches& touches,
                                       bool flushes) {
  const double least2 = flushes ? 0.0 : kLeastStep * spacing_ * kLeastStep * spacing_;
  std::vector<Vec3> wanted(row.begin(), row.end());
  std::size_t in_slit = 0;
  // A blade that comes back to its start over fresh tissue closes the sheet: that is no way back in its slit.
  const bool closes = !is_first_strip_ && returns_to_start(row) && !would_cover(first_, sheet);
  for (std::size_t c = 0; c < row.size(); ++c) {
    const bool is_held = !closes && is_on(row[c], sheet, kSlitShare * spacing_);
    in_slit += is_held ? 1U : 0U;
    if (is_held || (row[c] - front_[c].position).squaredNorm() <= least2) wanted[c] = front_[c].position;
  }
  const std::vector<Vec3> before = last_;
  last_.assign(row.begin(), row.end());
  if (in_slit == row.size()) {
    is_held_ = true;
    return {};
  }
  const Row to = number(wanted);
  if (is_held_ && would_cover(to, sheet)) return leave_slit(before, row, touches);
  is_held_ = false;
  return move_to(to, &sheet);
}

BladeMotion::Move BladeMotion::end(const OwnSheet& sheet, const Touches& touches) {
  const std::vector<Vec3> last = last_;
  return advance(last, sheet, touches, true);
}

}  // namespace incise::inline v0
