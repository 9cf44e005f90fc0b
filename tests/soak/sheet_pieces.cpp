// SPDX-License-Identifier: Apache-2.0
#include "soak/sheet_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "soak/face_list.h"

namespace incise::test {
namespace {

using Tet = std::array<std::uint32_t, 4>;

std::vector<double> heights_over(const TetSoup& soup, const SheetPlane& plane) {
  std::vector<double> heights;
  heights.reserve(soup.points.size());
  for (const Vec3& p : soup.points) heights.push_back(plane.height(p));
  return heights;
}

/// A plane through a vertex, as far as rounding can tell.
bool hits_vertex(const TetSoup& soup, const std::vector<double>& heights) {
  double size = 0;
  for (const Vec3& p : soup.points) size = std::max({size, std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
  return std::any_of(heights.begin(), heights.end(), [&](double h) { return std::abs(h) < 1e-11 * size; });
}

template <class Corners>
double highest(const std::vector<double>& heights, const Corners& corners) {
  double best = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t v : corners) best = std::max(best, heights[v]);
  return best;
}

/// How far each piece above height 0 reaches up.
std::vector<double> reaches_above(const TetSoup& soup, const std::vector<TetFace>& faces,
                                  const std::vector<double>& heights) {
  Groups groups(soup.tets.size());
  for_each_face(faces, [&](std::size_t first, std::size_t end) {
    if (highest(heights, faces[first].corners) <= 0) return;
    for (std::size_t i = first + 1; i < end; ++i) groups.join(faces[first].tet, faces[i].tet);
  });
  std::vector<double> reach(soup.tets.size(), 0);
  for (std::size_t t = 0; t < soup.tets.size(); ++t) {
    double& most = reach[groups.of(t)];
    most = std::max(most, highest(heights, soup.tets[t]));
  }
  reach.erase(std::remove(reach.begin(), reach.end(), 0.0), reach.end());
  return reach;
}

/// Points all over a body, a quarter of an edge apart along its edges.
template <class Visit>
void for_each_sample(const TetSoup& soup, const Visit& visit) {
  for (const Tet& t : soup.tets) {
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned j = 0; j < i; ++j) {
        for (unsigned k = 0; k <= 4; ++k) {
          visit(soup.points[t[i]] + 0.25 * k * (soup.points[t[j]] - soup.points[t[i]]));
        }
      }
    }
  }
}

/// Whether a tet crosses a plane while all of it lies between two heights over another.
bool is_joined(const TetSoup& soup, const std::vector<double>& across, const std::vector<double>& over, double low,
               double high) {
  return std::any_of(soup.tets.begin(), soup.tets.end(), [&](const Tet& t) {
    const auto lies_on = [&](double sign) {
      return std::any_of(t.begin(), t.end(), [&](auto v) { return sign * across[v] > 0; });
    };
    const auto is_within = [&](std::uint32_t v) { return over[v] > low && over[v] < high; };
    return lies_on(1) && lies_on(-1) && std::all_of(t.begin(), t.end(), is_within);
  });
}

}  // namespace

std::optional<std::size_t> pieces_of_plane(const TetSoup& soup, const SheetPlane& plane, double thin) {
  std::vector<double> heights = heights_over(soup, plane);
  if (hits_vertex(soup, heights)) return std::nullopt;
  const std::vector<TetFace> faces = sorted_faces(soup.tets);
  std::vector<double> reaches = reaches_above(soup, faces, heights);
  for (double& h : heights) h = -h;
  const std::vector<double> below = reaches_above(soup, faces, heights);
  reaches.insert(reaches.end(), below.begin(), below.end());
  if (std::any_of(reaches.begin(), reaches.end(), [&](double reach) { return reach < thin; })) return std::nullopt;
  return reaches.size();
}

std::optional<std::size_t> pieces_of_star(const TetSoup& soup, const std::vector<SheetPlane>& planes, double thin) {
  std::set<std::vector<bool>> cells;
  for_each_sample(soup, [&](const Vec3& p) {
    std::vector<bool> cell;
    for (const SheetPlane& plane : planes) {
      const double height = plane.height(p);
      if (std::abs(height) >= thin) cell.push_back(height > 0);
    }
    if (cell.size() == planes.size()) cells.insert(cell);
  });
  if (cells.size() != 2 * planes.size()) return std::nullopt;
  return cells.size();
}

std::optional<std::size_t> pieces_of_tee(const TetSoup& soup, const SheetPlane& wall, const SheetPlane& divider,
                                         double from, double thin) {
  bool has_left = false, has_right = false, has_below = false;
  for_each_sample(soup, [&](const Vec3& p) {
    const bool is_above = wall.height(p) >= thin + std::max(from, 0.0);
    has_left = has_left || (is_above && divider.height(p) >= thin);
    has_right = has_right || (is_above && divider.height(p) <= -thin);
    has_below = has_below || wall.height(p) <= -thin;
  });
  if (!has_left || !has_right || !has_below) return std::nullopt;
  const std::vector<double> over = heights_over(soup, wall), across = heights_over(soup, divider);
  const double margin = 0.2 * thin, endless = std::numeric_limits<double>::infinity();
  if (from <= 0 && is_joined(soup, across, over, -endless, from - margin)) return 3;
  if (from >= 2 * thin && is_joined(soup, across, over, margin, from - margin)) return 2;
  return std::nullopt;
}

}  // namespace incise::test
