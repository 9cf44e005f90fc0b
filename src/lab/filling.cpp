// SPDX-License-Identifier: Apache-2.0
// Which parts fill a tet follows from which points it has: schemes with all points are written down, sides of
// neighbours are divided alike by the numbers of their vertices.
#include "lab/filling.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include "incise/geom/quality.h"
#include "incise/mesh/tet_tables.h"

namespace incise {
inline namespace v0 {
namespace lab {

namespace {

using Triangle = std::array<PointCode, 3>;

constexpr bool has(unsigned bits, unsigned corner) {
  return ((bits >> corner) & 1U) != 0;
}

PointCode between(unsigned a, unsigned b) {
  return edge_code(kEdgeOfCorners[a][b]);
}

/// The two sides that an edge lies on.
std::array<unsigned, 2> sides_at(unsigned a, unsigned b) {
  const auto [c, d] = kEdgeCorners[opposite_edge(kEdgeOfCorners[a][b])];
  return {c, d};
}

std::array<unsigned, 3> corners_but(unsigned corner) {
  return {kSideCorners[corner][0], kSideCorners[corner][1], kSideCorners[corner][2]};
}

// --- sides of a tet beside divided ones ------------------------------------------------------------------------------

/// Triangles of a side without a point, two of whose edges have one.
void divide_at_two(unsigned common, unsigned q, unsigned r, const PointVertices& vertices,
                   std::vector<Triangle>& triangles) {
  const PointCode at_q = between(common, q), at_r = between(common, r);
  triangles.push_back({static_cast<PointCode>(common), at_q, at_r});
  const auto q_code = static_cast<PointCode>(q), r_code = static_cast<PointCode>(r);
  if (vertices[at_q] < vertices[at_r]) {
    triangles.insert(triangles.end(), {{at_q, q_code, r_code}, {at_q, r_code, at_r}});
  } else {
    triangles.insert(triangles.end(), {{at_r, q_code, r_code}, {at_q, q_code, at_r}});
  }
}

/// Triangles of a side without a point, by the points on its edges alone.
void divide_by_edges(unsigned side, const PointVertices& vertices, std::vector<Triangle>& triangles) {
  const auto c = corners_but(side);
  const auto is_split = [&](unsigned k) { return vertices[between(c[k], c[(k + 1) % 3])].is_valid(); };
  const unsigned count = unsigned{is_split(0)} + unsigned{is_split(1)} + unsigned{is_split(2)};
  const auto code = [](unsigned corner) { return static_cast<PointCode>(corner); };
  if (count == 0) triangles.push_back({code(c[0]), code(c[1]), code(c[2])});
  for (unsigned k = 0; k < 3 && count == 1; ++k) {
    if (!is_split(k)) continue;
    const unsigned p = c[k], q = c[(k + 1) % 3], r = c[(k + 2) % 3];
    triangles.insert(triangles.end(), {{code(p), between(p, q), code(r)}, {between(p, q), code(q), code(r)}});
  }
  for (unsigned k = 0; k < 3 && count == 2; ++k) {
    if (!is_split((k + 1) % 3)) divide_at_two(c[k], c[(k + 1) % 3], c[(k + 2) % 3], vertices, triangles);
  }
  if (count == 3) {
    const PointCode e0 = between(c[0], c[1]), e1 = between(c[1], c[2]), e2 = between(c[2], c[0]);
    triangles.insert(triangles.end(), {{code(c[0]), e0, e2}, {code(c[1]), e1, e0}, {code(c[2]), e2, e1}, {e0, e1, e2}});
  }
}

/// Triangles of a side with a point, all around it.
void divide_around(unsigned side, const PointVertices& vertices, std::vector<Triangle>& triangles) {
  const auto c = corners_but(side);
  for (unsigned k = 0; k < 3; ++k) {
    const auto p = static_cast<PointCode>(c[k]), q = static_cast<PointCode>(c[(k + 1) % 3]);
    const PointCode middle = between(p, q);
    if (vertices[middle].is_valid()) {
      triangles.insert(triangles.end(), {{side_code(side), p, middle}, {side_code(side), middle, q}});
    } else {
      triangles.push_back({side_code(side), p, q});
    }
  }
}

std::array<std::vector<Triangle>, 4> divide_sides(const PointVertices& vertices) {
  std::array<std::vector<Triangle>, 4> sides;
  for (unsigned s = 0; s < 4; ++s) {
    vertices[side_code(s)].is_valid() ? divide_around(s, vertices, sides[s]) : divide_by_edges(s, vertices, sides[s]);
  }
  return sides;
}

bool is_at(const Triangle& triangle, PointCode code) {
  return std::find(triangle.begin(), triangle.end(), code) != triangle.end();
}

/// Whether lines from a point on the tet's surface reach all triangles beside it: those of its own sides must end
/// there.
bool sees_all(PointCode apex, const std::array<std::vector<Triangle>, 4>& sides) {
  const unsigned support = support_of(apex);
  for (unsigned s = 0; s < 4; ++s) {
    if (has(support, s)) continue;
    const bool all_end =
        std::all_of(sides[s].begin(), sides[s].end(), [&](const Triangle& triangle) { return is_at(triangle, apex); });
    if (!all_end) return false;
  }
  return true;
}

// --- tets that are divided -------------------------------------------------------------------------------------------

unsigned lone_corner(unsigned beyond) {
  const bool is_one = std::popcount(beyond) == 1;
  return static_cast<unsigned>(std::countr_zero(is_one ? beyond : 15U & ~beyond));
}

/// Of the four parts at a corner those at one of its edges: the edge's point, and those of the sides at the edge.
Child at_edge(unsigned corner, unsigned other, bool is_beyond) {
  const auto [f, g] = sides_at(corner, other);
  return {{static_cast<PointCode>(corner), between(corner, other), side_code(f), side_code(g)}, is_beyond};
}

/// The fourth: to the points of the three sides at it.
Child at_sides(unsigned corner, bool is_beyond) {
  const auto [a, b, c] = corners_but(corner);
  return {{static_cast<PointCode>(corner), side_code(a), side_code(b), side_code(c)}, is_beyond};
}

/// The octahedron of three corners and the points of the sides opposite to them, around the line that joins such a
/// pair.
void fill_octahedron(std::array<unsigned, 3> corners, bool is_beyond, std::vector<Child>& children) {
  const auto [p, q, r] = corners;
  const auto axis = static_cast<PointCode>(p), q_code = static_cast<PointCode>(q), r_code = static_cast<PointCode>(r);
  const PointCode far = side_code(p), far_q = side_code(q), far_r = side_code(r);
  for (const auto& [x, y] :
       {std::pair(q_code, r_code), std::pair(r_code, far_q), std::pair(far_q, far_r), std::pair(far_r, q_code)}) {
    children.push_back({{axis, far, x, y}, is_beyond});
  }
}

std::vector<Child> fill_with_corner_cut_off(unsigned beyond, const PointVertices& vertices) {
  const unsigned lone = lone_corner(beyond);
  std::array<unsigned, 3> others = corners_but(lone);
  std::sort(others.begin(), others.end(), [&](unsigned a, unsigned b) { return vertices[a] < vertices[b]; });
  std::vector<Child> children = {at_sides(lone, has(beyond, lone))};
  for (const unsigned other : others) {
    children.push_back(at_edge(lone, other, has(beyond, lone)));
    children.push_back(at_edge(other, lone, has(beyond, other)));
  }
  fill_octahedron(others, has(beyond, others[0]), children);
  return children;
}

/// Corners a and b on one side, c and d on the other. The wall's inner part is a quadrilateral between the points of
/// the sides, divided by the line between those at a and b.
std::vector<Child> fill_in_halves(unsigned beyond, const PointVertices& vertices) {
  std::array<unsigned, 4> k = {0, 1, 2, 3};
  std::sort(k.begin(), k.end(), [&](unsigned a, unsigned b) { return vertices[a] < vertices[b]; });
  std::stable_partition(k.begin(), k.end(), [&](unsigned c) { return has(beyond, c) == has(beyond, k[0]); });
  const auto [a, b, c, d] = k;
  const bool first = has(beyond, a), second = has(beyond, c);
  const PointCode abc = side_code(d), abd = side_code(c), acd = side_code(b), bcd = side_code(a);
  const auto code = [](unsigned corner) { return static_cast<PointCode>(corner); };
  return {{{code(a), code(b), abc, abd}, first},
          at_edge(a, c, first),
          at_edge(a, d, first),
          at_sides(a, first),
          at_edge(b, c, first),
          at_edge(b, d, first),
          at_sides(b, first),
          at_edge(c, a, second),
          at_edge(c, b, second),
          at_edge(d, a, second),
          at_edge(d, b, second),
          {{code(c), abd, code(d), acd}, second},
          {{code(c), abd, acd, abc}, second},
          {{code(c), abd, abc, bcd}, second},
          {{code(c), abd, bcd, code(d)}, second}};
}

/// Where a point would lie in the tet (0,0,0), (1,0,0), (0,1,0), (0,0,1) if it were in the middle of its support.
Vec3 nominal_place(PointCode code) {
  const unsigned support = support_of(code);
  const double share = 1.0 / std::popcount(support);
  Vec3 place = Vec3::Zero();
  for (unsigned c = 1; c < 4; ++c) place[static_cast<int>(c) - 1] = has(support, c) ? share : 0.0;
  return place;
}

}  // namespace

unsigned support_of(PointCode code) {
  if (code < 4) return 1U << code;
  if (code < side_code(0)) {
    const auto [a, b] = kEdgeCorners[code - edge_code(0)];
    return (1U << a) | (1U << b);
  }
  return code < kInside ? 15U ^ (1U << (code - side_code(0))) : 15U;
}

std::vector<Child> fill_with_17(unsigned beyond) {
  std::vector<Child> children;
  for (unsigned c = 0; c < 4; ++c) {
    for (const unsigned other : corners_but(c)) children.push_back(at_edge(c, other, has(beyond, c)));
    children.push_back(at_sides(c, has(beyond, c)));
  }
  const bool is_half = std::popcount(beyond) == 2;
  const bool middle_is_beyond = is_half ? has(beyond, 0) : !has(beyond, lone_corner(beyond));
  children.push_back({{side_code(0), side_code(1), side_code(2), side_code(3)}, middle_is_beyond});
  orient(children);
  return children;
}

std::vector<Child> fill_adaptively(unsigned beyond, const PointVertices& vertices) {
  std::vector<Child> children =
      std::popcount(beyond) == 2 ? fill_in_halves(beyond, vertices) : fill_with_corner_cut_off(beyond, vertices);
  orient(children);
  return children;
}

std::vector<Child> fill_beside(const PointVertices& vertices) {
  const auto sides = divide_sides(vertices);
  PointCode apex = 0;
  while (apex < kInside && !(vertices[apex].is_valid() && sees_all(apex, sides))) ++apex;
  std::vector<Child> children;
  for (unsigned s = 0; s < 4; ++s) {
    if (apex < kInside && !has(support_of(apex), s)) continue;
    for (const Triangle& t : sides[s]) children.push_back({{t[0], t[1], t[2], apex}, false});
  }
  orient(children);
  return children;
}

void orient(std::vector<Child>& children) {
  for (Child& child : children) {
    std::array<Vec3, 4> p;
    for (unsigned k = 0; k < 4; ++k) p[k] = nominal_place(child.points[k]);
    if (signed_volume6(p[0], p[1], p[2], p[3]) < 0) std::swap(child.points[2], child.points[3]);
  }
}

}  // namespace lab
}  // namespace v0
}  // namespace incise
