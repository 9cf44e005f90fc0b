// SPDX-License-Identifier: Apache-2.0
// The accuracy of a cut: two-sided distance between the swept surface, clipped to the body, and the walls made.
#include "accuracy.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "incise/geom/quality.h"
#include "incise/geom/triangle_tree.h"

namespace incise::bench {

namespace {

using Triangle = std::array<Vec3, 3>;

double area_of(const Triangle& t) {
  return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
}

TriangleTree tree_of(const std::vector<Triangle>& soup) {
  std::vector<Vec3> points;
  std::vector<TriangleTree::Triangle> triangles;
  for (const Triangle& t : soup) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), t.begin(), t.end());
    triangles.push_back({first, first + 1, first + 2});
  }
  return {points, triangles};
}

/// The greatest and the mean distance of samples on a soup from a surface.
class Distances {
 public:
  Distances(const std::vector<Triangle>& soup, const TriangleTree& surface) {
    for (const Triangle& t : soup) {
      add(t, surface);
    }
  }
  [[nodiscard]] double greatest() const { return greatest_; }
  [[nodiscard]] double mean() const { return area_ > 0 ? integral_ / area_ : 0.0; }

 private:
  /// The corners, and the centroids of 25 equal parts.
  void add(const Triangle& t, const TriangleTree& surface) {
    constexpr unsigned kParts = 5;
    double sum = 0;
    const auto sample = [&](double u, double v) {
      const Vec3 point = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      const double distance = std::sqrt(surface.closest(point).distance2);
      greatest_ = std::max(greatest_, distance);
      return distance;
    };
    sample(0, 0), sample(1, 0), sample(0, 1);
    for (unsigned i = 0; i < kParts; ++i) {
      for (unsigned j = 0; i + j < kParts; ++j) {
        sum += sample((i + 1.0 / 3) / kParts, (j + 1.0 / 3) / kParts);
        if (i + j + 1 < kParts) {
          sum += sample((i + 2.0 / 3) / kParts, (j + 2.0 / 3) / kParts);
        }
      }
    }
    const double area = area_of(t);
    area_ += area;
    integral_ += area * sum / (kParts * kParts);
  }

  double greatest_ = 0, integral_ = 0, area_ = 0;
};

/// Keeps the part of a convex polygon on the positive side of side `corner`'s plane.
std::vector<Vec3> clip_by_side(const std::vector<Vec3>& polygon, const std::array<Vec3, 4>& tet, unsigned corner) {
  const auto& [i, j, k] = kSideCorners[corner];
  const Vec3 inward = (tet[k] - tet[i]).cross(tet[j] - tet[i]);
  std::vector<Vec3> kept;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec3& p = polygon[n];
    const Vec3& q = polygon[(n + 1) % polygon.size()];
    const double at_p = inward.dot(p - tet[i]), at_q = inward.dot(q - tet[i]);
    if (at_p >= 0) kept.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return kept;
}

std::vector<Triangle> walls_of(const TetMesh& mesh, std::uint32_t tag) {
  std::vector<Triangle> walls;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Side side(tet, s);
      if (mesh.link(side) == Link::boundary(tag)) {
        const auto v = mesh.vertices(side);
        walls.push_back({mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2])});
      }
    }
  });
  return walls;
}

double sum_areas(const std::vector<Triangle>& soup) {
  return std::accumulate(soup.begin(), soup.end(), 0.0, [](double sum, const Triangle& t) { return sum + area_of(t); });
}

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

Body::Body(const TetMesh& mesh) {
  double sum = 0;
  mesh.for_each_tet([&](TetId tet) {
    std::array<Vec3, 4>& corners = tets_.emplace_back();
    for (unsigned c = 0; c < 4; ++c) corners[c] = mesh.rest(mesh.vertices(tet)[c]);
    for (const auto& [a, b] : kEdgeCorners) sum += (corners[a] - corners[b]).norm();
  });
  mean_edge_ = tets_.empty() ? 1.0 : sum / (6.0 * static_cast<double>(tets_.size()));
  volume_ = total_volume(mesh);
}

std::vector<Triangle> Body::clip(const SweptTriangles& sweep) const {
  const TriangleTree tree(sweep.points, sweep.triangles);
  std::vector<Triangle> parts;
  for (const std::array<Vec3, 4>& tet : tets_) {
    Box box;
    for (const Vec3& corner : tet) box.extend(corner);
    tree.for_each_overlap(box, [&](std::uint32_t index) {
      const auto& [a, b, c] = sweep.triangles[index];
      std::vector<Vec3> polygon = {sweep.points[a], sweep.points[b], sweep.points[c]};
      for (unsigned corner = 0; corner < 4 && polygon.size() > 2; ++corner) {
        polygon = clip_by_side(polygon, tet, corner);
      }
      for (std::size_t i = 2; i < polygon.size(); ++i) {
        parts.push_back({polygon[0], polygon[i - 1], polygon[i]});
      }
    });
  }
  return parts;
}

Accuracy measure_accuracy(const TetMesh& mesh, const Body& body, const Stroke& stroke, std::uint32_t stroke_number) {
  const SweptTriangles sweep = swept_triangles(stroke);
  const std::vector<Triangle> clipped = body.clip(sweep);
  const std::vector<Triangle> walls = walls_of(mesh, stroke_number);
  Accuracy out;
  out.sweep_area = sum_areas(clipped);
  if (clipped.empty() || walls.empty()) {
    return out;
  }
  const Distances from_walls(walls, TriangleTree(sweep.points, sweep.triangles));
  const Distances from_sweep(clipped, tree_of(walls));
  const double h = body.mean_edge();
  out.hausdorff = std::max(from_walls.greatest(), from_sweep.greatest()) / h;
  out.mean = std::max(from_walls.mean(), from_sweep.mean()) / h;
  out.area_error = std::abs(0.5 * sum_areas(walls) - out.sweep_area) / out.sweep_area;
  return out;
}

double total_volume(const TetMesh& mesh) {
  long double sum = 0;
  mesh.for_each_tet([&](TetId tet) { sum += static_cast<long double>(mesh.rest_volume6(tet)); });
  return static_cast<double>(sum / 6);
}

std::size_t count_pieces_of_plane(const TetMesh& mesh, const Vec3& normal, double offset) {
  const auto is_above = [&](VertexId v) { return normal.dot(mesh.rest(v)) > offset; };
  UnionFind parts(2 * std::size_t{mesh.tet_slots()});
  std::vector<bool> exists(2 * std::size_t{mesh.tet_slots()}, false);
  mesh.for_each_tet([&](TetId tet) {
    for (const VertexId v : mesh.vertices(tet)) {
      exists[2 * std::size_t{tet.value} + (is_above(v) ? 1U : 0U)] = true;
    }
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh.link(Side(tet, s));
      if (link.is_boundary()) continue;
      for (const VertexId v : mesh.vertices(Side(tet, s))) {
        const std::size_t part = is_above(v) ? 1U : 0U;
        parts.join(2 * std::size_t{tet.value} + part, 2 * std::size_t{link.side().tet().value} + part);
      }
    }
  });
  std::size_t pieces = 0;
  for (std::size_t i = 0; i < exists.size(); ++i) {
    pieces += exists[i] && parts.find(i) == i ? 1U : 0U;
  }
  return pieces;
}

}  // namespace incise::bench
