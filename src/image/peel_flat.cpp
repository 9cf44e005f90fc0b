// SPDX-License-Identifier: Apache-2.0
// Tets with two sides on the skin are looked at in turn, and those that their removal lays bare again; the edges of
// the skin are kept in a set, so that none gets more than two faces.
#include "image/peel_flat.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

/// Tets whose two sides of skin meet at a larger angle than this are flat: cosine of 140 degrees.
constexpr double kFlatCosine = -0.766;

/// Caps are lower than this share of the square root of twice their base's area.
constexpr double kCapHeight = 0.4;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

class Peeling {
 public:
  explicit Peeling(LabelledTets& mesh)
      : mesh_(mesh), neighbours_(find_neighbours(mesh)), is_touched_(mesh.points.size(), 0) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      for (std::size_t s = 0; s < 4; ++s) {
        if (neighbours_[t][s] == kNoTet) add_face(t, s);
      }
    }
  }

  std::uint64_t run() {
    std::uint64_t peeled = 0;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) peeled += peel(t) ? 1U : 0U;
    return peeled;
  }

 private:
  void add_face(std::size_t tet, std::size_t side) {
    const auto& c = mesh_.tets[tet];
    const auto& order = kSideCorners[side];
    for (std::size_t i = 0; i < 3; ++i) skin_edges_.insert(edge_of(c[order[i]], c[order[(i + 1) % 3]]));
  }

  /// The two sides of skin, where there are just two.
  [[nodiscard]] std::optional<std::array<std::size_t, 2>> skin_sides(std::size_t tet) const {
    std::array<std::size_t, 2> sides{};
    std::size_t n = 0;
    for (std::size_t s = 0; s < 4; ++s) {
      if (neighbours_[tet][s] != kNoTet) continue;
      if (n == 2) return std::nullopt;
      sides[n++] = s;
    }
    return n == 2 ? std::optional(sides) : std::nullopt;
  }

  [[nodiscard]] std::ptrdiff_t count_skin_sides(std::size_t tet) const {
    return std::count(neighbours_[tet].begin(), neighbours_[tet].end(), kNoTet);
  }

  /// Whether the sides meet at an angle near 180 degrees; `a`, `b`: their corners that the other does not have.
  [[nodiscard]] bool is_flat(std::uint32_t u, std::uint32_t v, std::uint32_t a, std::uint32_t b) const {
    const auto& p = mesh_.points;
    const Vec3 edge = p[v] - p[u];
    const Vec3 m = edge.cross(p[a] - p[u]), n = edge.cross(p[b] - p[u]);
    return m.dot(n) < kFlatCosine * m.norm() * n.norm();
  }

  bool peel(std::size_t tet) {
    for (const std::uint32_t p : mesh_.tets[tet]) {
      if (is_touched_[p] != 0) return false;
    }
    if (mesh_.labels[tet] == 0) return false;
    if (is_cap(tet, kNoTet)) return peel_cap(tet), true;
    return peel_flat(tet);
  }

  /// Whether all tets around an edge of a tet have its label. Else the label would touch itself there alone without it.
  [[nodiscard]] bool is_one_label_around(std::size_t tet, std::uint32_t a, std::uint32_t b) const {
    std::size_t from = tet, here = tet;
    do {
      std::uint32_t next = kNoTet;
      for (std::size_t s = 0; s < 4; ++s) {
        const std::uint32_t corner = mesh_.tets[here][s];
        const bool is_way_on = corner != a && corner != b && (here == tet || neighbours_[here][s] != from);
        if (is_way_on) next = neighbours_[here][s];
      }
      if (next == kNoTet || mesh_.labels[next] != mesh_.labels[tet]) return false;
      from = std::exchange(here, next);
    } while (here != tet);
    return true;
  }

  /// A tet of which two sides are skin; where one more has two sides of skin below, that goes with it as a cap.
  bool peel_flat(std::size_t tet) {
    const auto sides = skin_sides(tet);
    if (!sides) return false;
    const auto& c = mesh_.tets[tet];
    const std::uint32_t a = c[(*sides)[0]], b = c[(*sides)[1]];
    std::array<std::uint32_t, 2> on{};
    std::size_t n = 0;
    std::uint32_t cap = kNoTet;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == (*sides)[0] || i == (*sides)[1]) continue;
      const std::uint32_t below = neighbours_[tet][i];
      if (mesh_.labels[below] != mesh_.labels[tet]) return false;
      if (count_skin_sides(below) > 1) {
        if (cap != kNoTet || !is_cap(below, static_cast<std::uint32_t>(tet))) return false;
        cap = below;
      }
      on[n++] = c[i];
    }
    if (!is_flat(on[0], on[1], a, b) || skin_edges_.count(edge_of(a, b)) > 0) return false;
    if (!is_one_label_around(tet, a, b)) return false;
    skin_edges_.erase(edge_of(on[0], on[1]));
    skin_edges_.insert(edge_of(a, b));
    remove(tet);
    if (cap != kNoTet) peel_cap(cap);
    return true;
  }

  /// The side of a tet that is no skin, where three are: `gone` counts as if it were.
  [[nodiscard]] std::optional<std::size_t> base_of(std::size_t tet, std::uint32_t gone) const {
    std::optional<std::size_t> base;
    for (std::size_t s = 0; s < 4; ++s) {
      if (neighbours_[tet][s] == kNoTet || neighbours_[tet][s] == gone) continue;
      if (base) return std::nullopt;
      base = s;
    }
    return base;
  }

  /// Whether a tet is a flat cap: three sides are skin, and its apex is near the fourth, whose neighbour may lie bare.
  [[nodiscard]] bool is_cap(std::size_t tet, std::uint32_t gone) const {
    const auto base = base_of(tet, gone);
    if (!base) return false;
    const std::uint32_t below = neighbours_[tet][*base];
    const bool is_beside = gone != kNoTet && std::count(neighbours_[gone].begin(), neighbours_[gone].end(), below) > 0;
    if (is_beside || mesh_.labels[below] != mesh_.labels[tet] || count_skin_sides(below) > 1) return false;
    const auto& c = mesh_.tets[tet];
    const auto& order = kSideCorners[*base];
    const Vec3 &p = mesh_.points[c[order[0]]], &q = mesh_.points[c[order[1]]], &r = mesh_.points[c[order[2]]];
    const Vec3 normal = (q - p).cross(r - p);
    const double height = std::abs((mesh_.points[c[*base]] - p).dot(normal)), area2 = normal.norm();
    return height < kCapHeight * area2 * std::sqrt(area2);
  }

  void peel_cap(std::size_t tet) {
    const std::size_t base = *base_of(tet, kNoTet);
    const auto& c = mesh_.tets[tet];
    for (std::size_t i = 0; i < 4; ++i) {
      if (i != base) skin_edges_.erase(edge_of(c[base], c[i]));
    }
    remove(tet);
  }

  void remove(std::size_t tet) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t below = neighbours_[tet][i];
      if (below == kNoTet) continue;
      for (std::uint32_t& back : neighbours_[below]) {
        if (back == tet) back = kNoTet;
      }
    }
    neighbours_[tet] = {kNoTet, kNoTet, kNoTet, kNoTet};
    mesh_.labels[tet] = 0;
    for (const std::uint32_t p : mesh_.tets[tet]) is_touched_[p] = 1;
  }

  LabelledTets& mesh_;
  std::vector<std::array<std::uint32_t, 4>> neighbours_;
  std::set<Edge> skin_edges_;
  std::vector<char> is_touched_;  // points of tets that went: what is around them waits until it has moved
};

}  // namespace

std::uint64_t peel_flat_tets(LabelledTets& mesh) {
  const std::uint64_t peeled = Peeling(mesh).run();
  if (peeled > 0) mesh.drop_background();
  return peeled;
}

}  // namespace image
}  // namespace v0
}  // namespace incise
