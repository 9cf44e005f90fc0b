// SPDX-License-Identifier: Apache-2.0
#include "cut/flagged_body.h"

#include <algorithm>

#include "support/engines.h"

namespace incise::test {

FlaggedBody::FlaggedBody(TetSoup soup) : mesh_(build(std::move(soup))), complex_(templates_), rebuild_(templates_) {
  mesh_.for_each_tet([&](TetId tet) { complex_.adopt(mesh_, tet); });
}

void FlaggedBody::toggle(std::uint32_t at, double t) {
  complex_.toggle(at);
  ClosedEdge& edge = complex_.edges()[at];
  if (edge.is_crossed) {
    edge.t = t;
    edge.position = mesh_.rest(edge.a) + t * (mesh_.rest(edge.b) - mesh_.rest(edge.a));
  }
  complex_.for_each_around(at, [&](std::uint32_t master) {
    complex_.refresh_flags(master);
    complex_.mark_dirty(master);
  });
}

void FlaggedBody::toggle_some(Random& random, double share) {
  for (std::uint32_t edge = 0; edge < complex_.edges().size(); ++edge) {
    if (random.real(0, 1) < share) toggle(edge, random.real(0.05, 0.95));
  }
}

void FlaggedBody::put_on(VertexId vertex) {
  std::vector<std::uint32_t> star;
  for (std::uint32_t m = 0; m < complex_.size(); ++m) {
    const auto& corners = complex_[m].vertices;
    if (std::find(corners.begin(), corners.end(), vertex) == corners.end()) continue;
    if (std::count_if(corners.begin(), corners.end(), [&](VertexId v) { return complex_.is_on(v); }) == 3) return;
    star.push_back(m);
  }
  complex_.set_on(vertex);
  for (const std::uint32_t m : star) {
    const auto& corners = complex_[m].vertices;
    const auto corner = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
    complex_[m].on = static_cast<std::uint8_t>(complex_[m].on | 1U << corner);
    complex_.mark_dirty(m);
  }
}

void FlaggedBody::put_some_on(Random& random, double share) {
  std::vector<VertexId> closed;
  for (const ClosedEdge& edge : complex_.edges().edges()) closed.insert(closed.end(), {edge.a, edge.b});
  std::sort(closed.begin(), closed.end());
  closed.erase(std::unique(closed.begin(), closed.end()), closed.end());
  for (const VertexId vertex : closed) {
    if (random.real(0, 1) < share && !complex_.is_on(vertex)) put_on(vertex);
  }
}

void FlaggedBody::mark_dirty(const FrontPoint& point) {
  for (const std::uint32_t master : point.masters) {
    if (master != Master::kNone) complex_.mark_dirty(master);
  }
}

void FlaggedBody::place(Random& random, FrontPoint& point) const {
  double sum = 0;
  for (double& w : point.weights) sum += w = random.real(0.05, 1);
  point.position = Vec3::Zero();
  for (unsigned k = 0; k < 3; ++k) point.position += point.weights[k] / sum * mesh_.rest(point.face[k]);
}

void FlaggedBody::add_point(Random& random, std::uint32_t master, unsigned side) {
  FrontPoint point;
  for (unsigned k = 0; k < 3; ++k) point.face[k] = complex_[master].vertices[kSideCorners[side][k]];
  const std::uint32_t behind = complex_[master].behind[side];
  point.masters = {master, behind};
  place(random, point);
  const std::uint32_t at = complex_.add_point(point);
  complex_[master].points[side] = at;
  if (behind != Master::kNone) {
    const auto& sides = complex_[behind].behind;
    complex_[behind].points[static_cast<std::size_t>(std::find(sides.begin(), sides.end(), master) - sides.begin())] =
        at;
  }
  mark_dirty(point);
}

void FlaggedBody::place_points(Random& random, double moved_share) {
  for (std::uint32_t m = 0; m < complex_.size(); ++m) {
    for (unsigned s = 0; s < 4; ++s) {
      const std::uint32_t at = complex_[m].points[s];
      if (!is_odd_side(complex_[m], s) || !has_split_on(complex_[m], s)) {
        if (at == Master::kNone) continue;
        mark_dirty(complex_.point(at));
        complex_.remove_point(at);
      } else if (at == Master::kNone) {
        add_point(random, m, s);
      } else if (random.real(0, 1) < moved_share) {
        place(random, complex_.point(at));
        mark_dirty(complex_.point(at));
      }
    }
  }
}

void FlaggedBody::stand(Random& random, double reach) {
  std::vector<Vec3> current(mesh_.vertex_slots(), Vec3::Zero());
  mesh_.for_each_vertex([&](VertexId v) { current[v.value] = mesh_.rest(v) + random.point(-reach, reach); });
  mesh_.set_current(current);
}

RebuildStatistics FlaggedBody::rebuild(const Rebuild::Settings& settings) {
  Transaction transaction(mesh_);
  const RebuildStatistics result = rebuild_.run(transaction, complex_, no_sheet_, settings);
  journal_.append(transaction.commit());
  return result;
}

}  // namespace incise::test
