// SPDX-License-Identifier: Apache-2.0
#include "oracle/convex_arrangement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace incise::oracle {

namespace {

using Real = long double;
using Point = std::array<Real, 3>;
using Simplex = std::array<Point, 4>;
using Polygon = std::vector<Point>;
/// The side of every plane, one bit each: set where positive.
using Sides = std::vector<bool>;

Point point_of(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Real dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real volume_of(const Simplex& s) {
  return std::abs(dot(cross(s[1] - s[0], s[2] - s[0]), s[3] - s[0])) / 6;
}

/// Twice the area vector of a plane polygon.
Point area2_of(const Polygon& p) {
  Point sum = {0, 0, 0};
  for (std::size_t i = 2; i < p.size(); ++i) {
    const Point n = cross(p[i - 1] - p[0], p[i] - p[0]);
    sum = {sum[0] + n[0], sum[1] + n[1], sum[2] + n[2]};
  }
  return sum;
}

/// A plane with a unit normal, and the height within which points lie on it.
class Divider {
 public:
  Divider(const Plane& plane, Real tolerance) : normal_(point_of(plane.normal)), tolerance_(tolerance) {
    const Real length = std::sqrt(dot(normal_, normal_));
    for (Real& x : normal_) x /= length;
    offset_ = static_cast<Real>(plane.offset) / length;
  }
  /// Signed height, 0 for points on the plane.
  [[nodiscard]] Real height(const Point& p) const {
    const Real h = dot(normal_, p) - offset_;
    return std::abs(h) <= tolerance_ ? 0 : h;
  }

 private:
  Point normal_;
  Real offset_ = 0;
  Real tolerance_;
};

Point crossing(const Point& a, const Point& b, Real height_a, Real height_b) {
  const Real t = height_a / (height_a - height_b);
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// Divides a simplex into simplices on one side each.
void divide(const Simplex& s, const std::array<Real, 4>& height, std::array<std::vector<Simplex>, 2>& sides) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (height[i] * height[j] < 0) {
        const Point c = crossing(s[i], s[j], height[i], height[j]);
        for (const std::size_t end : {i, j}) {
          Simplex part = s;
          std::array<Real, 4> part_height = height;
          part[end] = c;
          part_height[end] = 0;
          divide(part, part_height, sides);
        }
        return;
      }
    }
  }
  const bool is_positive = *std::max_element(height.begin(), height.end()) > 0;
  sides[is_positive ? 1 : 0].push_back(s);
}

void divide(const std::vector<Simplex>& simplices, const Divider& divider, std::array<std::vector<Simplex>, 2>& sides) {
  for (const Simplex& s : simplices) {
    divide(s, {divider.height(s[0]), divider.height(s[1]), divider.height(s[2]), divider.height(s[3])}, sides);
  }
}

/// Divides a convex polygon (Sutherland & Hodgman, both sides). One that lies in the plane is on neither.
void divide(const Polygon& polygon, const Divider& divider, std::array<Polygon, 2>& sides) {
  bool has_side = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Real height_a = divider.height(a), height_b = divider.height(b);
    has_side = has_side || height_a != 0;
    if (height_a >= 0) sides[1].push_back(a);
    if (height_a <= 0) sides[0].push_back(a);
    if (height_a * height_b < 0) {
      const Point c = crossing(a, b, height_a, height_b);
      sides[0].push_back(c);
      sides[1].push_back(c);
    }
  }
  if (!has_side) {
    sides = {};
  }
}

/// The part of a tet on the same sides of all planes.
struct Cell {
  Sides sides;
  std::vector<Simplex> simplices;
  std::size_t id = 0;
};

std::vector<Cell> cells_of(const Simplex& tet, const std::vector<Divider>& dividers) {
  std::vector<Cell> cells(1);
  cells[0].simplices = {tet};
  for (const Divider& divider : dividers) {
    std::vector<Cell> next;
    for (const Cell& cell : cells) {
      std::array<std::vector<Simplex>, 2> parts;
      divide(cell.simplices, divider, parts);
      for (const bool side : {false, true}) {
        if (parts[side ? 1 : 0].empty()) continue;
        next.push_back({cell.sides, std::move(parts[side ? 1 : 0])});
        next.back().sides.push_back(side);
      }
    }
    cells = std::move(next);
  }
  return cells;  // ascending by sides, as they were divided in that order
}

/// The sides of all planes on which a face has an area, ascending.
std::vector<Sides> sides_of_face(const Polygon& face, const std::vector<Divider>& dividers, Real cutoff) {
  struct Part {
    Sides sides;
    Polygon polygon;
  };
  const Point whole = area2_of(face);
  const Real least = cutoff * std::sqrt(dot(whole, whole));
  std::vector<Part> parts = {{{}, face}};
  for (const Divider& divider : dividers) {
    std::vector<Part> next;
    for (const Part& part : parts) {
      std::array<Polygon, 2> halves;
      divide(part.polygon, divider, halves);
      for (const bool side : {false, true}) {
        Polygon& half = halves[side ? 1 : 0];
        const Point area2 = area2_of(half);
        if (std::sqrt(dot(area2, area2)) <= least) continue;
        next.push_back({part.sides, std::move(half)});
        next.back().sides.push_back(side);
      }
    }
    parts = std::move(next);
  }
  std::vector<Sides> sides;
  for (Part& part : parts) sides.push_back(std::move(part.sides));
  return sides;
}

class Pieces {
 public:
  void add(Real volume) {
    parent_.push_back(parent_.size());
    volume_.push_back(volume);
  }
  [[nodiscard]] std::size_t size() const { return parent_.size(); }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a != b) {
      parent_[std::max(a, b)] = std::min(a, b);
      volume_[std::min(a, b)] += volume_[std::max(a, b)];
    }
  }
  [[nodiscard]] Arrangement to_arrangement(Real least) const {
    Arrangement result;
    Real total = 0, crumbs = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      if (parent_[i] != i) continue;
      total += volume_[i];
      if (volume_[i] > least) {
        result.volumes.push_back(static_cast<double>(volume_[i]));
      } else {
        ++result.crumbs;
        crumbs += volume_[i];
      }
    }
    std::sort(result.volumes.begin(), result.volumes.end());
    result.total = static_cast<double>(total);
    result.crumb_volume = static_cast<double>(crumbs);
    return result;
  }

 private:
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  std::vector<std::size_t> parent_;
  std::vector<Real> volume_;
};

std::vector<Divider> dividers_of(const Body& body, const std::vector<Plane>& planes, const Cutoff& cutoff) {
  double largest = 0;
  for (const Vec3& p : body.points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  std::vector<Divider> dividers;
  for (const Plane& plane : planes) {
    dividers.emplace_back(plane, static_cast<Real>(cutoff.on_plane) * static_cast<Real>(largest));
  }
  return dividers;
}

using Face = std::array<std::uint32_t, 3>;

/// The tets at every face, faces named by ascending vertices.
std::map<Face, std::vector<std::size_t>> tets_at_faces(const Body& body) {
  std::map<Face, std::vector<std::size_t>> tets_at;
  for (std::size_t t = 0; t < body.tets.size(); ++t) {
    const auto& v = body.tets[t];
    for (Face face : {Face{v[1], v[2], v[3]}, Face{v[0], v[2], v[3]}, Face{v[0], v[1], v[3]}, Face{v[0], v[1], v[2]}}) {
      std::sort(face.begin(), face.end());
      tets_at[face].push_back(t);
    }
  }
  return tets_at;
}

const Cell* find_cell(const std::vector<Cell>& cells, const Sides& sides) {
  const auto at = std::lower_bound(cells.begin(), cells.end(), sides,
                                   [](const Cell& cell, const Sides& s) { return cell.sides < s; });
  return at != cells.end() && at->sides == sides ? &*at : nullptr;
}

}  // namespace

Arrangement arrange(const Body& body, const std::vector<Plane>& planes, const Cutoff& cutoff) {
  const std::vector<Divider> dividers = dividers_of(body, planes, cutoff);
  Pieces pieces;
  Real total = 0;
  std::vector<std::vector<Cell>> cells;
  for (const auto& v : body.tets) {
    const Simplex tet = {point_of(body.points[v[0]]), point_of(body.points[v[1]]), point_of(body.points[v[2]]),
                         point_of(body.points[v[3]])};
    total += volume_of(tet);
    cells.push_back(cells_of(tet, dividers));
    for (Cell& cell : cells.back()) {
      cell.id = pieces.size();
      Real volume = 0;
      for (const Simplex& s : cell.simplices) volume += volume_of(s);
      pieces.add(volume);
      cell.simplices.clear();
    }
  }
  for (const auto& [face, tets] : tets_at_faces(body)) {
    if (tets.size() < 2) continue;
    const Polygon polygon = {point_of(body.points[face[0]]), point_of(body.points[face[1]]),
                             point_of(body.points[face[2]])};
    for (const Sides& sides : sides_of_face(polygon, dividers, static_cast<Real>(cutoff.area))) {
      for (std::size_t i = 1; i < tets.size(); ++i) {
        const Cell *a = find_cell(cells[tets[0]], sides), *b = find_cell(cells[tets[i]], sides);
        if (a != nullptr && b != nullptr) pieces.join(a->id, b->id);
      }
    }
  }
  const Real mean = body.tets.empty() ? 0 : total / static_cast<Real>(body.tets.size());
  return pieces.to_arrangement(static_cast<Real>(cutoff.volume) * mean);
}

}  // namespace incise::oracle
