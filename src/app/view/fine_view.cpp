// SPDX-License-Identifier: Apache-2.0
#include "app/view/fine_view.h"

#include <algorithm>
#include <limits>

#include "app/model/fine_file.h"
#include "app/scene/scene_simulation.h"

namespace incise {
inline namespace v0 {
namespace app {

Result<FineView> FineView::bind(FineSurface surface, const TetMesh& mesh, const Journal& journal) {
  Result<EmbeddedSurface> bound = EmbeddedSurface::bind(std::move(surface), mesh, journal);
  if (!bound.ok()) return bound.error();
  return FineView(std::move(bound).value());
}

Status FineView::show(const TetMesh& mesh, const Journal& journal, SurfaceFrame& frame) {
  if (const Status followed = surface_.follow(journal, mesh); !followed.ok()) {
    Result<EmbeddedSurface> bound = EmbeddedSurface::bind(surface_.source(), mesh, journal);
    if (!bound.ok()) return bound.error();
    surface_ = std::move(bound).value();
    topology_.reset();
  }
  if (!topology_ || shown_ != surface_.version() || position_ != journal.position()) {
    drawn_ = draw(surface_, mesh);
    ++version_;
    topology_ = topology_of(mesh);
    shown_ = surface_.version();
    position_ = journal.position();
  }
  frame.topology = topology_;
  frame.positions.resize(drawn_.points.size());
  for (std::size_t i = 0; i < drawn_.points.size(); ++i) {
    frame.positions[i] = current_place(mesh, drawn_.points[i].binding).cast<float>();
  }
  return {};
}

Result<std::optional<FineView>> fine_view_of(const Scene& scene, const TetMesh& mesh, const Journal& journal) {
  if (scene.model.surface.empty()) return std::optional<FineView>();
  const Result<std::filesystem::path> path = find_model(scene, scene.model.surface);
  if (!path.ok()) return path.error();
  Result<FineSurface> surface = read_fine_surface(*path);
  if (!surface.ok()) return surface.error();
  Result<FineView> view = FineView::bind(std::move(surface).value(), mesh, journal);
  if (!view.ok()) return Error{view.error().code, path->string() + ": " + view.error().message, view.error().ids};
  return std::optional<FineView>(std::move(view).value());
}

std::shared_ptr<const SurfaceTopology> FineView::topology_of(const TetMesh& mesh) const {
  auto topology = std::make_shared<SurfaceTopology>();
  topology->version = version_;
  std::uint32_t newest = 0;
  for (const std::uint32_t stroke : drawn_.wall_strokes) newest = std::max(newest, stroke);
  const auto add = [&](const std::array<std::uint32_t, 3>& triangle, std::uint32_t stroke) {
    const Binding& binding = drawn_.points[triangle[0]].binding;
    TriangleLook look{0, static_cast<std::uint8_t>(stroke), static_cast<std::uint8_t>(mesh.region(binding.tet)), 0};
    if (stroke > 0) look.flags = TriangleLook::kWall;
    if (stroke > 0 && stroke == newest) look.flags |= TriangleLook::kNewest;
    topology->triangles.push_back(triangle);
    topology->looks.push_back(look);
    topology->sides.emplace_back(binding.tet, std::min(unsigned{binding.side}, 3U));
  };
  for (const auto& triangle : drawn_.skin) add(triangle, 0);
  for (std::size_t i = 0; i < drawn_.walls.size(); ++i) add(drawn_.walls[i], drawn_.wall_strokes[i]);
  for (std::size_t i = 0; i < drawn_.points.size(); ++i) {
    const DrawnPoint& point = drawn_.points[i];
    const auto nearest = std::max_element(point.binding.weights.begin(), point.binding.weights.end());
    const auto corner = static_cast<std::size_t>(nearest - point.binding.weights.begin());
    topology->vertices.push_back(mesh.vertices(point.binding.tet)[corner]);
    topology->rest.push_back(point.rest.cast<float>());
    double depth = 0;
    if (i >= drawn_.skin_points) {
      const double endless = std::numeric_limits<double>::infinity();
      depth = (surface_.find_nearest(point.rest, endless).value_or(point.rest) - point.rest).norm();
    }
    topology->depths.push_back(static_cast<float>(depth));
  }
  topology->used = topology->triangles.size();
  return topology;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
