// SPDX-License-Identifier: Apache-2.0
// Tets are reached through faces from the points of the front; each vertex gets the volume of its reached tets, and
// loads are shared by volume and distance. Springs that stay keep how far they have slipped.
#include "engine/process_zone.h"

#include <algorithm>

namespace incise {
inline namespace v0 {
namespace detail {

void ProcessZone::find(const TetMesh& mesh, std::span<const FrontPoint> points) {
  const std::vector<Bearer> before = std::move(bearers_);
  bearers_.clear();
  shares_.clear();
  is_reached_.resize(std::max<std::size_t>(is_reached_.size(), mesh.tet_slots()));
  bearer_of_.resize(std::max<std::size_t>(bearer_of_.size(), mesh.vertex_slots()));
  reach(mesh, points);
  for (std::uint32_t i = 0; i < points.size(); ++i) share_out(points[i], i);
  keep_lags(before);
  for (const TetId tet : reached_) is_reached_[tet.value] = 0;
  for (const Bearer& bearer : bearers_) bearer_of_[bearer.vertex.value] = 0;
}

/// Goes through the tissue from face to face, as far as some corner is within the radius of some point.
void ProcessZone::reach(const TetMesh& mesh, std::span<const FrontPoint> points) {
  reached_.clear();
  const auto see = [&](TetId tet) {
    if (is_reached_[tet.value] != 0) return;
    is_reached_[tet.value] = 1;
    reached_.push_back(tet);
    take(mesh, tet);
  };
  const auto is_near = [&](VertexId v) {
    return std::any_of(points.begin(), points.end(), [&](const FrontPoint& point) {
      return (mesh.rest(v) - point.rest).squaredNorm() < point.radius * point.radius;
    });
  };
  for (const FrontPoint& point : points) see(point.grip.tet);
  for (std::size_t next = 0; next < reached_.size(); ++next) {
    const TetId tet = reached_[next];
    const TetVertices corners = mesh.vertices(tet);
    if (std::none_of(corners.begin(), corners.end(), is_near)) continue;
    for (const Link link : mesh.links(tet)) {
      if (!link.is_boundary()) see(link.side().tet());
    }
  }
}

void ProcessZone::take(const TetMesh& mesh, TetId tet) {
  const TetVertices& v = mesh.vertices(tet);
  const Vec3& p = mesh.rest(v[0]);
  const double volume = (mesh.rest(v[1]) - p).cross(mesh.rest(v[2]) - p).dot(mesh.rest(v[3]) - p);
  for (const VertexId corner : v) {
    std::uint32_t& at = bearer_of_[corner.value];
    if (at == 0) {
      Bearer& bearer = bearers_.emplace_back();
      bearer.vertex = corner;
      bearer.rest = mesh.rest(corner);
      at = static_cast<std::uint32_t>(bearers_.size());
    }
    bearers_[at - 1].volume += std::max(volume, 0.0);
  }
}

void ProcessZone::share_out(const FrontPoint& point, std::uint32_t index) {
  const std::size_t first = shares_.size();
  const double radius2 = point.radius * point.radius;
  double sum = 0;
  for (std::uint32_t i = 0; i < bearers_.size(); ++i) {
    const double distance2 = (bearers_[i].rest - point.rest).squaredNorm();
    if (!(distance2 < radius2)) continue;
    const double near = 1 - distance2 / radius2;
    shares_.push_back({index, i, near * near * bearers_[i].volume});
    sum += shares_.back().weight;
  }
  if (!(sum > 0)) {  // tets are larger than the zone
    shares_.resize(first);
    for (unsigned k = 0; k < 4; ++k) {
      shares_.push_back({index, bearer_of_[point.grip.vertices[k].value] - 1, std::max(point.grip.weights[k], 0.0)});
      sum += shares_.back().weight;
    }
  }
  for (std::size_t k = first; k < shares_.size(); ++k) shares_[k].weight /= sum;
}

void ProcessZone::keep_lags(const std::vector<Bearer>& before) {
  is_fresh_.assign(bearers_.size(), true);
  for (const Bearer& old : before) {
    const std::uint32_t at = old.vertex.value < bearer_of_.size() ? bearer_of_[old.vertex.value] : 0;
    if (at == 0 || bearers_[at - 1].rest != old.rest) continue;
    bearers_[at - 1].lag = old.lag;
    is_fresh_[at - 1] = false;
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
