// SPDX-License-Identifier: Apache-2.0
#include "soak/sheet.h"

#include <algorithm>
#include <cmath>

#include "support/random_strokes.h"

namespace incise::test {

Frame random_frame(Random& random) {
  const Vec3 n = random_direction(random), a = n.cross(random_direction(random)).normalized();
  return {n, a, n.cross(a)};
}

Vec3 inner_point(const TetSoup& soup, Random& random) {
  const auto& t =
      soup.tets[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(soup.tets.size()) - 1))];
  return (soup.points[t[0]] + soup.points[t[1]] + soup.points[t[2]] + soup.points[t[3]]) / 4.0;
}

Sheet::Sheet(const AttackedBody& body, const Frame& frame, const Vec3& through)
    : n(frame.n), a(frame.a), b(frame.b), q(through), way{HUGE_VAL, -HUGE_VAL} {
  for (const auto& t : body.soup.tets) {
    for (const std::uint32_t v : t) {
      const double s = (body.soup.points[v] - q).dot(b);
      way = {std::min(way.from, s), std::max(way.to, s)};
    }
  }
  way = {way.from - 0.7 * body.edge, way.to + 0.7 * body.edge};
  width = {-1.3 * body.diagonal, 1.3 * body.diagonal};
}

Edge Sheet::at(double s, const Span& w, double lift) const {
  const Vec3 middle = q + s * b + lift * n;
  return {middle + w.from * a, middle + w.to * a};
}

Edges Sheet::sweep(const Span& s, unsigned steps, const Span& w, double lift) const {
  Edges edges;
  for (unsigned i = 0; i <= steps; ++i) edges.push_back(at(s.at(static_cast<double>(i) / steps), w, lift));
  return edges;
}

Vec3 Sheet::turned(const Vec3& x, const Vec3& y, double turns) {
  const auto [c, s] = on_circle(turns);
  return c * x + s * y;
}

}  // namespace incise::test
