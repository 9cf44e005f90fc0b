// SPDX-License-Identifier: Apache-2.0
#include "methods.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "incise/geom/quality.h"
#include "incise/mesh/tet_tables.h"

namespace incise::bench {

namespace {

using Tet = std::array<std::uint32_t, 4>;
using Face = std::array<std::uint32_t, 3>;

Face face_of(const Tet& tet, unsigned side) {
  const auto& c = kSideCorners[side];
  Face face = {tet[c[0]], tet[c[1]], tet[c[2]]};
  std::sort(face.begin(), face.end());
  return face;
}

bool is_cut(const TetSoup& soup, const Tet& tet, const Plane& plane) {
  bool is_above = false, is_below = false;
  for (const std::uint32_t v : tet) {
    is_above = is_above || plane.height(soup.points[v]) > 0;
    is_below = is_below || plane.height(soup.points[v]) < 0;
  }
  return is_above && is_below;
}

std::uint64_t count_cut(const TetSoup& soup, const Plane& plane) {
  return static_cast<std::uint64_t>(
      std::count_if(soup.tets.begin(), soup.tets.end(), [&](const Tet& tet) { return is_cut(soup, tet, plane); }));
}

double volume6(const TetSoup& soup, const Tet& tet) {
  return signed_volume6(soup.points[tet[0]], soup.points[tet[1]], soup.points[tet[2]], soup.points[tet[3]]);
}

std::vector<std::uint32_t> made_set(std::vector<std::uint32_t> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// The tets at each point.
std::vector<std::vector<std::uint32_t>> stars_of(const TetSoup& soup) {
  std::vector<std::vector<std::uint32_t>> stars(soup.points.size());
  for (std::uint32_t t = 0; t < soup.tets.size(); ++t) {
    for (const std::uint32_t v : soup.tets[t]) stars[v].push_back(t);
  }
  return stars;
}

/// Moves the nearer end of each crossed edge onto the plane, the nearest first.
void snap(TetSoup& soup, const Plane& plane) {
  const auto stars = stars_of(soup);
  std::map<std::uint32_t, double> distance;  // of the points to be moved
  for (const Tet& tet : soup.tets) {
    for (const auto& [i, j] : kEdgeCorners) {
      const double a = plane.height(soup.points[tet[i]]), b = plane.height(soup.points[tet[j]]);
      if (!(a * b < 0)) continue;
      const std::uint32_t nearer = std::abs(a) <= std::abs(b) ? tet[i] : tet[j];
      distance[nearer] = std::abs(plane.height(soup.points[nearer]));
    }
  }
  std::vector<std::pair<double, std::uint32_t>> order;
  for (const auto& [point, height] : distance) order.emplace_back(height, point);
  std::sort(order.begin(), order.end());
  for (const auto& [height, point] : order) {
    const Vec3 before = soup.points[point];
    soup.points[point] = before - plane.height(before) * plane.normal;
    const auto& star = stars[point];
    const bool stays_sound =
        std::all_of(star.begin(), star.end(), [&](std::uint32_t t) { return volume6(soup, soup.tets[t]) > 0; });
    if (!stays_sound) soup.points[point] = before;
  }
}

/// Groups with representatives.
class Groups {
 public:
  explicit Groups(std::size_t count) : root_(count) { std::iota(root_.begin(), root_.end(), std::size_t{0}); }
  std::size_t find(std::size_t at) {
    while (root_[at] != at) at = root_[at] = root_[root_[at]];
    return at;
  }
  void join(std::size_t a, std::size_t b) { root_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> root_;
};

/// Gives each group of tets at a point that hangs together by faces which are not `open` a point of its own. Returns
/// the points at open faces.
std::vector<std::uint32_t> separate(TetSoup& soup, const std::map<Face, std::vector<std::uint32_t>>& open) {
  std::vector<std::uint32_t> walls;
  for (const auto& [face, tets] : open) walls.insert(walls.end(), face.begin(), face.end());
  walls = made_set(walls);
  const auto stars = stars_of(soup);
  const std::vector<Tet> tets = soup.tets;
  std::vector<std::uint32_t> all = walls;
  for (const std::uint32_t v : walls) {
    const auto& star = stars[v];
    Groups groups(star.size());
    std::map<Face, std::size_t> seen;
    for (std::size_t k = 0; k < star.size(); ++k) {
      for (unsigned s = 0; s < 4; ++s) {
        if (tets[star[k]][s] == v) continue;
        const Face face = face_of(tets[star[k]], s);
        const auto [known, is_new] = seen.try_emplace(face, k);
        if (!is_new && open.find(face) == open.end()) groups.join(known->second, k);
      }
    }
    std::map<std::size_t, std::uint32_t> copies = {{groups.find(0), v}};
    for (std::size_t k = 0; k < star.size(); ++k) {
      const auto [copy, is_new] = copies.try_emplace(groups.find(k), static_cast<std::uint32_t>(soup.points.size()));
      if (is_new) {
        soup.points.push_back(soup.points[v]);
        all.push_back(copy->second);
      }
      std::replace(soup.tets[star[k]].begin(), soup.tets[star[k]].end(), v, copy->second);
    }
  }
  return made_set(all);
}

}  // namespace

Cut remove_tets(TetSoup body, const Plane& plane) {
  Cut cut;
  cut.cut_tets = count_cut(body, plane);
  std::map<Face, unsigned> of_removed;
  std::vector<Tet> kept;
  for (const Tet& tet : body.tets) {
    if (!is_cut(body, tet, plane)) {
      kept.push_back(tet);
      continue;
    }
    for (unsigned s = 0; s < 4; ++s) ++of_removed[face_of(tet, s)];
  }
  body.tets = std::move(kept);
  for (const Tet& tet : body.tets) {
    for (unsigned s = 0; s < 4; ++s) {
      const Face face = face_of(tet, s);
      if (of_removed.find(face) != of_removed.end()) {
        cut.wall_points.insert(cut.wall_points.end(), face.begin(), face.end());
      }
    }
  }
  cut.wall_points = made_set(cut.wall_points);
  cut.soup = std::move(body);
  return cut;
}

Cut snap_nodes(TetSoup body, const Plane& plane) {
  Cut cut;
  cut.cut_tets = count_cut(body, plane);
  snap(body, plane);
  const auto side_of = [&](const Tet& tet) {
    double sum = 0;
    for (const std::uint32_t v : tet) sum += plane.height(body.points[v]);
    return sum > 0;
  };
  std::map<Face, std::vector<std::uint32_t>> faces;
  for (std::uint32_t t = 0; t < body.tets.size(); ++t) {
    for (unsigned s = 0; s < 4; ++s) faces[face_of(body.tets[t], s)].push_back(t);
  }
  std::map<Face, std::vector<std::uint32_t>> open;
  for (const auto& [face, tets] : faces) {
    if (tets.size() == 2 && side_of(body.tets[tets[0]]) != side_of(body.tets[tets[1]])) open[face] = tets;
  }
  cut.wall_points = separate(body, open);
  cut.soup = std::move(body);
  return cut;
}

}  // namespace incise::bench
