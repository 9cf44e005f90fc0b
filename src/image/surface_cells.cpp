// SPDX-License-Identifier: Apache-2.0
// Around each edge the triangles are sorted by angle, and sides that face each other are joined (union-find): each set
// of sides left at the end walls in one region.
#include "image/surface_cells.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "image/winding_number.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// Sets that grow together.
class SideSets {
 public:
  explicit SideSets(std::size_t n) : parent_(n) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// A triangle at an edge that goes from the point of the lower number to the other.
struct EdgeUse {
  std::uint32_t low, high, triangle, apex;
  bool is_upwards;   ///< the triangle goes along the edge in its direction
  double angle = 0;  ///< around the edge, counter-clockwise seen against it
};

/// The side where a triangle's normal points is twice its number, the other one more.
std::uint32_t side_of(const EdgeUse& use, bool is_ahead) {
  return 2 * use.triangle + (use.is_upwards == is_ahead ? 0U : 1U);
}

class CellFinder {
 public:
  CellFinder(const std::vector<Vec3>& points, const std::vector<SurfaceCells::Triangle>& triangles)
      : points_(points), triangles_(triangles), sides_(2 * triangles.size()) {}

  SurfaceCells run() {
    join_facing_sides();
    collect();
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::vector<EdgeUse> find_uses() const {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = triangles_[t][i], to = triangles_[t][(i + 1) % 3];
        uses.push_back({std::min(from, to), std::max(from, to), t, triangles_[t][(i + 2) % 3], from < to});
      }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& x, const EdgeUse& y) {
      return std::tie(x.low, x.high, x.triangle) < std::tie(y.low, y.high, y.triangle);
    });
    return uses;
  }

  void join_facing_sides() {
    std::vector<EdgeUse> uses = find_uses();
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
      while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) ++end;
      if (end - begin == 1) ++out_.open_edges;
      if (end - begin > 2) sort_around(uses.data() + begin, uses.data() + end);
      for (std::size_t i = begin; i < end; ++i) {
        const EdgeUse& next = uses[i + 1 < end ? i + 1 : begin];
        sides_.join(side_of(uses[i], true), side_of(next, false));
      }
    }
  }

  void sort_around(EdgeUse* begin, EdgeUse* end) const {
    const Vec3 along = (points_[begin->high] - points_[begin->low]).normalized();
    const auto across = [&](const EdgeUse& use) {
      const Vec3 to = points_[use.apex] - points_[use.low];
      return Vec3(to - to.dot(along) * along);
    };
    const Vec3 x = across(*begin), y = along.cross(x);
    for (EdgeUse* use = begin; use != end; ++use) use->angle = angle_of(across(*use).dot(y), across(*use).dot(x));
    std::sort(begin, end, [](const EdgeUse& a, const EdgeUse& b) {
      return std::tie(a.angle, a.triangle) < std::tie(b.angle, b.triangle);
    });
  }

  /// Six times the volume below a triangle.
  [[nodiscard]] double volume6(const SurfaceCells::Triangle& t, const Vec3& from) const {
    return (points_[t[0]] - from).dot((points_[t[1]] - from).cross(points_[t[2]] - from));
  }

  void collect() {
    constexpr std::uint32_t kNoShell = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(2 * triangles_.size(), kNoShell);  // of each root
    std::vector<SurfaceCells::Cell> shells;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const std::array<std::uint32_t, 2> roots = {sides_.root(2 * t), sides_.root(2 * t + 1)};
      if (roots[0] == roots[1]) continue;
      for (const std::size_t s : {std::size_t{1}, std::size_t{0}}) {
        std::uint32_t& n = number[roots[s]];
        if (n == kNoShell) {
          n = static_cast<std::uint32_t>(shells.size());
          shells.emplace_back();
        }
        SurfaceCells::Triangle wall = triangles_[t];
        if (s == 0) std::swap(wall[1], wall[2]);
        shells[n].triangles.push_back(wall);
        shells[n].volume += volume6(wall, points_[shells[n].triangles[0][0]]) / 6;
      }
    }
    const auto is_cell = [&](std::uint32_t side) {
      const std::uint32_t n = number[sides_.root(side)];
      return n != kNoShell && shells[n].volume > 0;
    };
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!is_cell(2 * t) && !is_cell(2 * t + 1)) out_.open.push_back(triangles_[t]);
    }
    for (SurfaceCells::Cell& shell : shells) {
      if (shell.volume > 0) out_.closed.push_back(std::move(shell));
    }
  }

  const std::vector<Vec3>& points_;
  const std::vector<SurfaceCells::Triangle>& triangles_;
  SideSets sides_;
  SurfaceCells out_;
};

}  // namespace

SurfaceCells find_cells(const std::vector<Vec3>& points, const std::vector<SurfaceCells::Triangle>& triangles) {
  return CellFinder(points, triangles).run();
}

}  // namespace image
}  // namespace v0
}  // namespace incise
