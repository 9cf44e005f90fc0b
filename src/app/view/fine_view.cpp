// SPDX-License-Identifier: Apache-2.0
// A drawing's slots become a topology's: free ones stay as empty triangles, so that what did not change keeps its
// place.
#include "app/view/fine_view.h"

#include <algorithm>
#include <limits>

namespace incise {
inline namespace v0 {
namespace app {

Result<FineView> FineView::bind(FineSurface surface, const TetMesh& mesh, const Journal& journal) {
  Result<EmbeddedSurface> bound = EmbeddedSurface::bind(std::move(surface), mesh, journal);
  if (!bound.ok()) return bound.error();
  return FineView(std::move(bound).value());
}

Status FineView::show(const TetMesh& mesh, const Journal& journal, SurfaceFrame& frame) {
  if (const Status followed = follow(mesh, journal); !followed.ok()) return followed;
  frame.topology = topology_;
  const std::vector<DrawnPoint>& points = drawing_->points();
  frame.positions.resize(points.size());
  Eigen::Vector3f last = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].binding.tet.is_valid()) last = current_place(mesh, points[i].binding).cast<float>();
    frame.positions[i] = last;  // free points stand somewhere on the surface
  }
  return {};
}

Status FineView::follow(const TetMesh& mesh, const Journal& journal) {
  if (const Status followed = surface_.follow(journal, mesh); !followed.ok()) {
    Result<EmbeddedSurface> bound = EmbeddedSurface::bind(surface_.source(), mesh, journal);
    if (!bound.ok()) return bound.error();
    surface_ = std::move(bound).value();
    drawing_.reset();
  }
  if (drawing_ && !drawing_->follow(surface_, mesh, journal)) return {};
  if (!drawing_) drawing_.emplace(surface_, mesh, journal);
  publish(mesh);
  return {};
}

void FineView::publish(const TetMesh& mesh) {
  auto topology = std::make_shared<SurfaceTopology>();
  topology->version = ++version_;
  add_triangles(mesh, *topology);
  add_points(mesh, *topology);
  topology_ = std::move(topology);
}

void FineView::add_triangles(const TetMesh& mesh, SurfaceTopology& topology) const {
  const std::vector<DrawnTriangle>& triangles = drawing_->triangles();
  std::uint32_t newest = 1;
  for (const DrawnTriangle& triangle : triangles) newest = std::max(newest, triangle.stroke);
  topology.triangles.resize(triangles.size(), {0, 0, 0});
  topology.looks.resize(triangles.size());
  topology.sides.resize(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [points, stroke, kind] = triangles[i];
    if (kind == DrawnTriangle::Kind::kFree) continue;
    const Binding& binding = drawing_->points()[points[0]].binding;
    TriangleLook look{0, static_cast<std::uint8_t>(stroke), static_cast<std::uint8_t>(mesh.region(binding.tet)), 0};
    if (kind != DrawnTriangle::Kind::kSkin) look.flags = TriangleLook::kWall;
    if (stroke == newest) look.flags |= TriangleLook::kNewest;
    topology.triangles[i] = points;
    topology.looks[i] = look;
    topology.sides[i] = Side(binding.tet, std::min(unsigned{binding.side}, 3U));
    ++topology.used;
  }
}

void FineView::add_points(const TetMesh& mesh, SurfaceTopology& topology) {
  const std::vector<DrawnPoint>& points = drawing_->points();
  topology.vertices.resize(points.size());
  topology.rest.resize(points.size(), Eigen::Vector3f::Zero());
  topology.depths.resize(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Binding& binding = points[i].binding;
    if (!binding.tet.is_valid()) continue;
    const auto nearest = std::max_element(binding.weights.begin(), binding.weights.end());
    topology.vertices[i] = mesh.vertices(binding.tet)[static_cast<std::size_t>(nearest - binding.weights.begin())];
    topology.rest[i] = points[i].rest.cast<float>();
  }
  depths_.resize(points.size());
  for (std::size_t i = 0; i < topology.triangles.size(); ++i) {
    if ((topology.looks[i].flags & (TriangleLook::kWall | TriangleLook::kUnused)) != TriangleLook::kWall) continue;
    for (const std::uint32_t point : topology.triangles[i]) topology.depths[point] = depth_of(point);
  }
}

/// From the fine surface. It is asked anew only where another point has taken the slot.
float FineView::depth_of(std::size_t point) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const Vec3& rest = drawing_->points()[point].rest;
  Depth& known = depths_[point];
  if (known.depth < 0 || known.rest != rest) {
    known = {rest, static_cast<float>((surface_.find_nearest(rest, kEndless).value_or(rest) - rest).norm())};
  }
  return known.depth;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
