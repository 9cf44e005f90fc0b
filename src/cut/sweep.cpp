// SPDX-License-Identifier: Apache-2.0
// Points get numbers first, equal ones one number; strips are laid in the order of time, without what would cover
// older ones. Self-crossings are pairs of triangles whose boxes overlap, found by a tree (docs/internals.md, 3.1).
#include "cut/sweep.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "cut/blade_constants.h"
#include "incise/geom/closest.h"
#include "incise/geom/intersect.h"

namespace incise {
inline namespace v0 {

namespace {

/// Numbers the points of a stroke's rows and columns, with equal neighbours as one.
class PointGrid {
 public:
  PointGrid(const Stroke& stroke, std::vector<SosPoint>& points) : stroke_(stroke), points_(points) {
    const std::size_t rows = stroke.edges.size(), columns = stroke.edges[0].size();
    index_.assign(rows, std::vector<std::uint32_t>(columns, 0));
    is_closed_ = columns > 2 && std::all_of(stroke.edges.begin(), stroke.edges.end(),
                                            [](const auto& edge) { return edge.front() == edge.back(); });
    const bool returns = rows > 2 && returns_to_start();
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t c = 0; c < columns; ++c) {
        index_[r][c] = returns && r + 1 == rows ? index_[0][c] : number(r, c);
      }
    }
  }
  [[nodiscard]] std::uint32_t at(std::size_t row, std::size_t column) const { return index_[row][column]; }

 private:
  [[nodiscard]] const Vec3& point(std::size_t row, std::size_t column) const { return stroke_.edges[row][column]; }
  std::uint32_t number(std::size_t r, std::size_t c) {
    if (is_closed_ && c + 1 == stroke_.edges[r].size()) return index_[r][0];
    if (r > 0 && point(r, c) == point(r - 1, c)) return index_[r - 1][c];
    if (c > 0 && point(r, c) == point(r, c - 1)) return index_[r][c - 1];
    const auto index = static_cast<std::uint32_t>(points_.size());
    points_.push_back({point(r, c), kFirstBladeKey + index});
    return index;
  }
  /// The last polyline is the first again, up to rounding.
  [[nodiscard]] bool returns_to_start() const {
    const auto& first = stroke_.edges.front();
    const auto& last = stroke_.edges.back();
    double extent = 0, gap = 0;
    for (const auto& edge : stroke_.edges) {
      for (std::size_t c = 0; c < edge.size(); ++c) {
        extent = std::max(extent, (edge[c] - first[0]).norm());
      }
    }
    for (std::size_t c = 0; c < first.size(); ++c) {
      gap = std::max(gap, (last[c] - first[c]).norm());
    }
    // A blade that went out and back the same way returns too, but encloses nothing: its rows are no ring.
    const bool turns_back = stroke_.edges.size() == 3 || first == stroke_.edges[stroke_.edges.size() - 2];
    return gap <= 1e-12 * extent && !turns_back;
  }

  const Stroke& stroke_;
  std::vector<SosPoint>& points_;
  std::vector<std::vector<std::uint32_t>> index_;
  bool is_closed_ = false;
};

using Corners = std::array<SosPoint, 3>;

Corners corners(const SweptSurface& surface, std::uint32_t triangle) {
  const auto& p = surface.triangles[triangle].points;
  return {surface.points[p[0]], surface.points[p[1]], surface.points[p[2]]};
}

double distance2_to(const SweptSurface& surface, std::uint32_t triangle, const Vec3& point) {
  const auto t = corners(surface, triangle);
  return closest_on_triangle(point, t[0].position, t[1].position, t[2].position).distance2;
}

/// Lays the strips of a stroke one after the other.
class Sweeper {
 public:
  Sweeper(const Stroke& stroke, double slit, SweptSurface& surface)
      : stroke_(stroke), slit2_(slit * slit), surface_(surface), grid_(stroke, surface.points) {}

  void run() {
    std::size_t front = 0;  // the row that the last strip ended at
    bool is_held = false;   // the blade has been in its own slit since
    for (std::size_t row = 1; row < stroke_.edges.size(); ++row) {
      if ((is_held || turns_back(row)) && is_in_slit(row)) {
        is_held = true;
        continue;
      }
      const bool leaves_elsewhere = is_held && would_cover(front, row);
      lay_strip(leaves_elsewhere ? row - 1 : front, row);
      front = row;
      is_held = false;
    }
    for (std::size_t c = 0; c < stroke_.edges[front].size(); ++c) surface_.front.push_back(grid_.at(front, c));
  }

 private:
  [[nodiscard]] const Vec3& place(std::size_t row, std::size_t column) const { return stroke_.edges[row][column]; }
  /// Whether some point moves against its last motion.
  [[nodiscard]] bool turns_back(std::size_t row) const {
    for (std::size_t c = 0; row >= 2 && c < stroke_.edges[row].size(); ++c) {
      if ((place(row, c) - place(row - 1, c)).dot(place(row - 1, c) - place(row - 2, c)) < 0) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] bool is_swept(const Vec3& point) const {
    for (auto t = static_cast<std::uint32_t>(surface_.triangles.size()); t-- > 0;) {
      if (distance2_to(surface_, t, point) <= slit2_) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] bool is_in_slit(std::size_t row) const {
    return std::all_of(stroke_.edges[row].begin(), stroke_.edges[row].end(),
                       [&](const Vec3& point) { return is_swept(point); });
  }
  /// Whether the strip between two rows would lie on what was swept already. One that is narrower than the slit, and
  /// so within it of the row that it goes on from, need not.
  [[nodiscard]] bool would_cover(std::size_t from, std::size_t to) const {
    for (std::size_t c = 0; c + 1 < stroke_.edges[to].size(); ++c) {
      const Vec3 &a = place(from, c), &b = place(from, c + 1), &d = place(to, c), &e = place(to, c + 1);
      const Vec3 centre = 0.25 * (a + b + d + e);
      if (is_swept(centre) && closest_on_triangle(centre, a, b, b).distance2 > slit2_) {
        return true;
      }
    }
    return false;
  }
  void lay_strip(std::size_t from, std::size_t to) {
    for (std::size_t c = 0; c + 1 < stroke_.edges[to].size(); ++c) {
      const std::uint32_t a = grid_.at(from, c), b = grid_.at(from, c + 1), d = grid_.at(to, c),
                          e = grid_.at(to, c + 1);
      add_triangle({a, b, e}, to - 1, c);
      add_triangle({a, e, d}, to - 1, c);
    }
  }
  void add_triangle(const std::array<std::uint32_t, 3>& points, std::size_t step, std::size_t column) {
    if (points[0] != points[1] && points[1] != points[2] && points[2] != points[0]) {
      surface_.triangles.push_back({points, static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(column)});
    }
  }

  const Stroke& stroke_;
  double slit2_;
  SweptSurface& surface_;
  PointGrid grid_;
};

// --- self-crossing ---------------------------------------------------------------------------------------------------

Corners::const_iterator find_key(const Corners& triangle, const SosPoint& p) {
  return std::find_if(triangle.begin(), triangle.end(), [&](const SosPoint& q) { return p.key == q.key; });
}

long shared_points(const Corners& a, const Corners& b) {
  return std::count_if(a.begin(), a.end(), [&](const SosPoint& p) { return find_key(b, p) != b.end(); });
}

/// Whether two triangles that share one corner cross besides, as those of an edge that has turned all round do.
bool cross_besides(Corners a, Corners b) {
  if (shared_points(a, b) != 1) return false;
  const auto corner = std::find_if(a.begin(), a.end(), [&](const SosPoint& p) { return find_key(b, p) != b.end(); });
  std::rotate(b.begin(), b.begin() + (find_key(b, *corner) - b.begin()), b.end());
  std::rotate(a.begin(), corner, a.end());
  return triangles_cross_besides(a, b);
}

Vec3 area_vector(const std::array<SosPoint, 3>& t) {
  return (t[1].position - t[0].position).cross(t[2].position - t[0].position);
}

/// Whether the centre of one triangle lies within `slit` of the other: they cover the same place.
bool covers(const std::array<SosPoint, 3>& a, const std::array<SosPoint, 3>& b, double slit) {
  const Vec3 centre = (a[0].position + a[1].position + a[2].position) / 3.0;
  const auto hit = closest_on_triangle(centre, b[0].position, b[1].position, b[2].position);
  return hit.distance2 <= slit * slit;
}

/// Whether two triangles of a sweep meet otherwise than as neighbours on one sheet.
bool meet(const Corners& a, const Corners& b, double slit) {
  const double reach = std::min(slit, 1e-3 * std::sqrt(std::min(area_vector(a).norm(), area_vector(b).norm())));
  if (shared_points(a, b) == 0 && triangles_cross(a, b)) return true;
  return covers(a, b, reach) || covers(b, a, reach);
}

/// Whether one triangle laps over another one: a place a little inside one of its corners, or of the middles of its
/// edges, lies within `slit` of the other, but for what they share.
bool laps(const Corners& a, const Corners& b, double slit) {
  const auto is_shared = [&](const SosPoint& p) {
    return std::any_of(b.begin(), b.end(), [&](const SosPoint& q) { return p.key == q.key; });
  };
  const Vec3 centre = (a[0].position + a[1].position + a[2].position) / 3.0;
  const auto is_on = [&](const Vec3& p) {
    const Vec3 place = p + kLapInset * (centre - p);
    return closest_on_triangle(place, b[0].position, b[1].position, b[2].position).distance2 <= slit * slit;
  };
  bool does_lap = false;
  for (unsigned k = 0; k < 3; ++k) {
    const SosPoint &p = a[k], &q = a[(k + 1) % 3];
    if (is_shared(p)) continue;
    does_lap = does_lap || is_on(p.position) || is_on(0.5 * (p.position + q.position));
  }
  return does_lap;
}

Box box_of(const SweptSurface& surface, std::uint32_t triangle, double margin) {
  const auto t = corners(surface, triangle);
  Box box{t[0].position, t[0].position};
  for (const SosPoint& p : t) {
    box.lo = box.lo.cwiseMin(p.position);
    box.hi = box.hi.cwiseMax(p.position);
  }
  box.lo.array() -= margin;
  box.hi.array() += margin;
  return box;
}

/// For each triangle, the last earlier triangle that it meets, plus one; 0 for none.
std::vector<std::uint32_t> last_met(const SweptSurface& surface, double slit) {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const SosPoint& p : surface.points) points.push_back(p.position);
  for (const SweptTriangle& t : surface.triangles) triangles.push_back(t.points);
  const TriangleTree tree(points, triangles);
  std::vector<std::uint32_t> met(triangles.size(), 0);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    tree.for_each_overlap(box_of(surface, i, slit), [&](std::uint32_t j) {
      if (j >= i || j + 1 <= met[i]) return;
      const Corners a = corners(surface, i), b = corners(surface, j);
      if (meet(a, b, slit) || cross_besides(a, b)) met[i] = j + 1;
    });
  }
  return met;
}

/// Where a part must end so that its border keeps clear of the place that triangle `meeting` meets: tets around the
/// border are left whole, and would leave a hole in a sheet that passes through them too. A loop too tight for that
/// ends at `meeting`.
std::uint32_t end_before(const SweptSurface& surface, std::uint32_t meeting, std::uint32_t met, std::uint32_t start,
                         double clearance) {
  const auto target = corners(surface, met);
  const auto is_near = [&](std::uint32_t triangle) {
    const auto t = corners(surface, triangle);
    return std::any_of(t.begin(), t.end(), [&](const SosPoint& p) {
      return closest_on_triangle(p.position, target[0].position, target[1].position, target[2].position).distance2 <
             clearance * clearance;
    });
  };
  std::uint32_t end = meeting;
  while (end > start + 1 && is_near(end - 1)) {
    --end;
  }
  return end > start + 1 && end > met + 1 ? end : meeting;
}

/// How far the blade travels in each step, at the point that travels furthest.
std::vector<double> travel_of_steps(const SweptSurface& surface) {
  std::vector<double> travel(surface.triangles.empty() ? 0 : surface.triangles.back().step + std::size_t{1}, 0.0);
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    const auto t = corners(surface, i);
    double& longest = travel[surface.triangles[i].step];
    // The corners are (a, b, e) or (a, e, d): earlier ends first, later ones last.
    longest =
        std::max({longest, std::min((t[2].position - t[1].position).norm(), (t[2].position - t[0].position).norm())});
  }
  return travel;
}

/// The first triangle of the overlap before `start`: whole steps back over at least `overlap` of travel, but not to
/// `not_before`.
std::uint32_t overlap_start(const SweptSurface& surface, const std::vector<double>& travel, std::uint32_t start,
                            std::uint32_t not_before, double overlap) {
  double covered = 0;
  std::uint32_t first = start;
  while (first > not_before && covered < overlap) {
    const std::uint32_t step = surface.triangles[first - 1].step;
    while (first > not_before && surface.triangles[first - 1].step == step) {
      --first;
    }
    covered += travel[step];
  }
  return first;
}

std::vector<std::uint32_t> all_triangles(const SweptSurface& surface) {
  std::vector<std::uint32_t> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace

SweptSurface sweep(const Stroke& stroke, double slit) {
  SweptSurface surface;
  Sweeper(stroke, slit, surface).run();
  return surface;
}

std::vector<std::vector<std::uint32_t>> split_at_self_crossings(const SweptSurface& surface, double overlap,
                                                                double slit) {
  std::vector<std::vector<std::uint32_t>> parts;
  const auto count = static_cast<std::uint32_t>(surface.triangles.size());
  if (count == 0) {
    return parts;
  }
  const std::vector<std::uint32_t> met = last_met(surface, slit);
  const std::vector<double> travel = travel_of_steps(surface);
  std::uint32_t start = 0;  // first triangle that only this part cuts
  std::uint32_t first = 0;  // with the overlap
  for (std::uint32_t i = 0; i <= count; ++i) {
    if (i < count && met[i] <= first) {
      continue;
    }
    const std::uint32_t end = i < count ? end_before(surface, i, met[i] - 1, start, 2.0 / 3.0 * overlap) : i;
    std::vector<std::uint32_t> part(end - first);
    std::iota(part.begin(), part.end(), first);
    parts.push_back(std::move(part));
    start = end;
    first = i < count ? overlap_start(surface, travel, start, met[i], overlap) : end;
  }
  return parts;
}

bool meets_itself(const SweptSurface& surface, double slit) {
  const std::vector<std::uint32_t> met = last_met(surface, slit);
  return std::any_of(met.begin(), met.end(), [](std::uint32_t earlier) { return earlier != 0; });
}

bool strips_meet(const SweptSurface& strip, const SweptSurface& earlier, const Sheet& sheet, double slit) {
  bool do_meet = false;
  for (std::uint32_t i = 0; i < strip.triangles.size() && !do_meet; ++i) {
    const Box box = box_of(strip, i, slit);
    if (!box.overlaps(sheet.bounds())) continue;
    sheet.tree().for_each_overlap(box, [&](std::uint32_t j) {
      const Corners a = corners(strip, i), b = corners(earlier, j);
      do_meet = do_meet || meet(a, b, slit) || laps(a, b, slit) || laps(b, a, slit);
    });
  }
  return do_meet;
}

double travel_of(const SweptSurface& surface) {
  const std::vector<double> travel = travel_of_steps(surface);
  return std::accumulate(travel.begin(), travel.end(), 0.0);
}

SweptSurface last_part(const SweptSurface& surface, double length) {
  const auto end = static_cast<std::uint32_t>(surface.triangles.size());
  const std::uint32_t first = overlap_start(surface, travel_of_steps(surface), end, 0, length);
  constexpr auto kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> index(surface.points.size(), kNone);
  SweptSurface part;
  for (std::uint32_t t = first; t < end; ++t) {
    part.triangles.push_back(surface.triangles[t]);
    for (std::uint32_t& point : part.triangles.back().points) {
      if (index[point] == kNone) {
        index[point] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(surface.points[point]);
      }
      point = index[point];
    }
  }
  return part;
}

void append(SweptSurface& surface, const SweptSurface& more) {
  std::vector<std::uint32_t> index;
  for (const SosPoint& point : more.points) {
    const auto known = std::find_if(surface.points.begin(), surface.points.end(),
                                    [&](const SosPoint& p) { return p.key == point.key; });
    index.push_back(static_cast<std::uint32_t>(known - surface.points.begin()));
    if (known == surface.points.end()) surface.points.push_back(point);
  }
  for (SweptTriangle triangle : more.triangles) {
    for (std::uint32_t& p : triangle.points) p = index[p];
    surface.triangles.push_back(triangle);
  }
}

bool comes_round(const Stroke& stroke, double length) {
  const std::vector<Vec3>&first = stroke.edges.front(), &last = stroke.edges.back();
  for (std::size_t column = 0; column < first.size(); ++column) {
    if ((last[column] - first[column]).norm() > length) return false;
  }
  return true;
}

std::size_t count_sharp_turns(const Stroke& stroke, double length) {
  const std::size_t rows = stroke.edges.size();
  const std::size_t moves = comes_round(stroke, length) ? rows : rows - 1;  // the first one follows on the last
  std::size_t most = 0;
  for (std::size_t column = 0; column < stroke.edges.front().size(); ++column) {
    std::optional<Vec3> way;
    std::size_t turns = 0;
    for (std::size_t i = 0; i < moves; ++i) {
      const std::size_t row = i % (rows - 1);
      const Vec3 move = stroke.edges[row + 1][column] - stroke.edges[row][column];
      if (move.norm() <= length) continue;
      turns += way && move.normalized().dot(*way) < kSharpTurn ? 1U : 0U;
      way = move.normalized();
    }
    most = std::max(most, turns);
  }
  return most;
}

Sheet::Sheet(const SweptSurface& surface) : Sheet(surface, all_triangles(surface)) {}

Sheet::Sheet(const SweptSurface& surface, const std::vector<std::uint32_t>& triangles) : surface_(&surface) {
  std::vector<Vec3> points;
  points.reserve(surface.points.size());
  for (const SosPoint& p : surface.points) points.push_back(p.position);
  bounds_ = {Vec3::Constant(1e300), Vec3::Constant(-1e300)};
  double area = 0;
  for (const std::uint32_t t : triangles) {
    triangles_.push_back(surface.triangles[t].points);
    reaches_on_.push_back(surface.triangles[t].reaches_on);
    const auto p = corners(surface, t);
    for (const SosPoint& q : p) {
      bounds_.lo = bounds_.lo.cwiseMin(q.position);
      bounds_.hi = bounds_.hi.cwiseMax(q.position);
    }
    mean_normal_ += area_vector(p);
    area += area_vector(p).norm();
  }
  tree_ = TriangleTree(points, triangles_);
  find_normals();
  const double length = mean_normal_.norm();
  mean_normal_ = length > 0.01 * area && length > 0 ? Vec3(mean_normal_ / length) : Vec3(Vec3::Zero());
}

void Sheet::find_normals() {
  const auto corner = [&](std::size_t t, unsigned k) -> const Vec3& {
    return (*surface_).points[triangles_[t][k]].position;
  };
  std::vector<std::size_t> flat;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Vec3 a = corner(t, 1) - corner(t, 0), b = corner(t, 2) - corner(t, 0);
    normals_.push_back(a.cross(b));
    const double size2 = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
    if (!(normals_.back().squaredNorm() > kSeamShare * kSeamShare * size2 * size2)) flat.push_back(t);
  }
  if (flat.empty()) return;
  std::vector<Vec3> own = normals_;
  for (const std::size_t t : flat) own[t] = Vec3::Zero();
  for (const std::size_t t : flat) {
    const Vec3 centre = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t other = 0; other < triangles_.size(); ++other) {
      if (own[other].isZero(0.0)) continue;
      const double distance2 =
          closest_on_triangle(centre, corner(other, 0), corner(other, 1), corner(other, 2)).distance2;
      if (!(distance2 < least)) continue;
      least = distance2;
      normals_[t] = own[other];
    }
  }
}

}  // namespace v0
}  // namespace incise
