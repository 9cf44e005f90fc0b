// SPDX-License-Identifier: Apache-2.0
// The patterns by which walls divide a triangle, by how many of its edges they cross.
#include "mesh/surface_division.h"

#include <algorithm>

#include "mesh/constants.h"

namespace incise {
inline namespace v0 {
namespace {

void add_part(std::vector<FineTriangle>& parts, std::uint32_t a, std::uint32_t b, std::uint32_t c, unsigned lips) {
  if (a == b || b == c || c == a) return;  // the wall passes through a corner
  FineTriangle part;
  part.points = {a, b, c};
  part.lips = static_cast<std::uint8_t>(lips);
  parts.push_back(part);
}

/// The triangle turned so that corner `first` comes first.
DividedTriangle turned(const DividedTriangle& triangle, std::size_t first) {
  DividedTriangle result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.points[i] = triangle.points[(first + i) % 3];
    result.chains[i] = triangle.chains[(first + i) % 3];
  }
  return result;
}

class Division {
 public:
  Division(PointMaker& maker, std::vector<FineTriangle>& parts) : maker_(maker), parts_(parts) {}

  void divide(const DividedTriangle& triangle, unsigned halvings) {
    for (std::size_t i = 0; i < 3; ++i) {
      const EdgeChain& chain = triangle.chains[i];
      const auto joint = std::find_if(chain.begin(), chain.end(), [](const EdgePoint& p) { return !p.is_parted(); });
      if (joint != chain.end()) {
        return halve(turned(triangle, i), static_cast<std::size_t>(joint - chain.begin()), halvings);
      }
    }
    part(triangle);
  }

 private:
  /// At a point of the first edge that is not parted.
  void halve(const DividedTriangle& t, std::size_t joint, unsigned halvings) {
    const std::uint32_t middle = t.chains[0][joint].low;
    const EdgeChain across = halvings < kMostWallHalvings ? maker_.divide(middle, t.points[2]) : EdgeChain();
    const auto at = t.chains[0].begin() + static_cast<std::ptrdiff_t>(joint);
    divide({{t.points[0], middle, t.points[2]}, {EdgeChain(t.chains[0].begin(), at), across, t.chains[2]}},
           halvings + 1);
    divide({{middle, t.points[1], t.points[2]}, {EdgeChain(at + 1, t.chains[0].end()), t.chains[1], reversed(across)}},
           halvings + 1);
  }

  void part(const DividedTriangle& t) {
    std::array<bool, 3> is_crossed;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) count += (is_crossed[i] = !t.chains[i].empty()) ? 1U : 0U;
    const auto find = [&](bool crossed) {
      return static_cast<std::size_t>(std::find(is_crossed.begin(), is_crossed.end(), crossed) - is_crossed.begin());
    };
    if (count == 0) add_part(parts_, t.points[0], t.points[1], t.points[2], 0);
    if (count == 1) part_one(turned(t, find(true)));
    if (count == 2) part_two(turned(t, (find(false) + 2) % 3));
    if (count == 3) part_three(t);
  }

  /// The wall ends in the triangle: it is parted on to the far corner, which both parts keep.
  void part_one(const DividedTriangle& t) {
    const EdgePoint& p = t.chains[0].front();
    const auto& [a, b, c] = t.points;
    add_part(parts_, a, p.low, c, 2);
    add_part(parts_, p.high, b, c, 4);
  }

  /// The wall crosses the first edge and the last, and cuts the first corner off.
  void part_two(const DividedTriangle& t) {
    const EdgePoint &p = t.chains[0].front(), &q = t.chains[2].front();
    const auto& [a, b, c] = t.points;
    add_part(parts_, a, p.low, q.high, 2);
    add_part(parts_, p.high, b, c, 0);
    // At the corner itself both crossings are one place: the part between them would be flat.
    if (p.t > 0 || q.t < 1) add_part(parts_, p.high, c, q.low, 4);
  }

  /// Walls meet: each corner is cut off, and what is between hangs on what is there.
  void part_three(const DividedTriangle& t) {
    const EdgePoint &p = t.chains[0].front(), &q = t.chains[1].front(), &r = t.chains[2].front();
    add_part(parts_, t.points[0], p.low, r.high, 2);
    add_part(parts_, t.points[1], q.low, p.high, 2);
    add_part(parts_, t.points[2], r.low, q.high, 2);
    const auto middle = maker_.copy_to_middle({p.low, q.low, r.low});
    add_part(parts_, middle[0], middle[1], middle[2], 7);
  }

  PointMaker& maker_;
  std::vector<FineTriangle>& parts_;
};

}  // namespace

void divide_triangle(const DividedTriangle& triangle, PointMaker& maker, std::vector<FineTriangle>& parts) {
  Division(maker, parts).divide(triangle, 0);
}

EdgeChain reversed(const EdgeChain& chain) {
  EdgeChain result(chain.rbegin(), chain.rend());
  for (EdgePoint& point : result) {
    std::swap(point.low, point.high);
    point.t = 1 - point.t;
  }
  return result;
}

}  // namespace v0
}  // namespace incise
