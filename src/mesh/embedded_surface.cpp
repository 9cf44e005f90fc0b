// SPDX-License-Identifier: Apache-2.0
// The public face of `SurfaceKeeper`: checks what is given and hands on; places and normals as the body stands are
// computed here.
#include "incise/mesh/embedded_surface.h"

#include <algorithm>
#include <string>

#include "mesh/constants.h"
#include "mesh/surface_keeper.h"
#include "mesh/turned_normals.h"

namespace incise {
inline namespace v0 {
namespace {

Status check(const FineSurface& surface) {
  const auto bad = [](std::string what, std::uint64_t id) {
    return Error{ErrorCode::kBadArgument, std::move(what), {id}};
  };
  const std::size_t n = surface.points.size();
  if (surface.triangles.empty()) return bad("the surface has no triangles", 0);
  if (!surface.texture.empty() && surface.texture.size() != n) {
    return bad("the surface has texture coordinates for " + std::to_string(surface.texture.size()) + " of its points",
               surface.texture.size());
  }
  if (!surface.normals.empty() && surface.normals.size() != n) {
    return bad("the surface has normals for " + std::to_string(surface.normals.size()) + " of its points",
               surface.normals.size());
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!surface.points[i].allFinite()) return bad("point " + std::to_string(i) + " of the surface is not finite", i);
  }
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    for (const std::uint32_t p : surface.triangles[i]) {
      if (p >= n) return bad("triangle " + std::to_string(i) + " of the surface has a point out of range", i);
    }
  }
  return {};
}

}  // namespace

EmbeddedSurface::EmbeddedSurface(std::unique_ptr<Keeper> keeper) : keeper_(std::move(keeper)) {}
EmbeddedSurface::EmbeddedSurface(EmbeddedSurface&&) noexcept = default;
EmbeddedSurface& EmbeddedSurface::operator=(EmbeddedSurface&&) noexcept = default;
EmbeddedSurface::~EmbeddedSurface() = default;

Result<EmbeddedSurface> EmbeddedSurface::bind(FineSurface surface, const TetMesh& mesh, const Journal& journal,
                                              const EmbedOptions& options) {
  if (const Status status = check(surface); !status.ok()) return status.error();
  if (mesh.tet_count() == 0) return Error{ErrorCode::kBadArgument, "a surface cannot hang on a mesh without tets"};
  if (!(options.greatest_distance > 0)) {
    return Error{ErrorCode::kBadArgument, "the greatest distance of a surface from its mesh must be above 0"};
  }
  auto keeper = std::make_unique<Keeper>(std::move(surface), mesh, journal);
  if (const std::uint32_t far = keeper->bind_all(mesh, options.greatest_distance); far != kInvalidIndex) {
    return Error{ErrorCode::kBadArgument,
                 "point " + std::to_string(far) + " of the surface lies " +
                     std::to_string(keeper->greatest_distance()) +
                     " length units outside the mesh: do both have the same unit and place?",
                 {far}};
  }
  return EmbeddedSurface(std::move(keeper));
}

Status EmbeddedSurface::follow(const Journal& journal, const TetMesh& mesh) {
  return keeper_->follow(journal, mesh);
}
std::size_t EmbeddedSurface::position() const {
  return keeper_->position();
}
std::uint64_t EmbeddedSurface::version() const {
  return keeper_->version();
}
std::span<const FinePoint> EmbeddedSurface::points() const {
  return {keeper_->points().data(), keeper_->points().size()};
}
std::span<const FineTriangle> EmbeddedSurface::triangles() const {
  return {keeper_->triangles().data(), keeper_->triangles().size()};
}
const FineSurface& EmbeddedSurface::source() const {
  return keeper_->source();
}
double EmbeddedSurface::greatest_distance() const {
  return keeper_->greatest_distance();
}
const FineChanges& EmbeddedSurface::changes() const {
  return keeper_->changes();
}
double EmbeddedSurface::reach() const {
  return keeper_->reach();
}
std::size_t EmbeddedSurface::looked_at() const {
  return keeper_->looked_at();
}

void EmbeddedSurface::fill(const TetMesh& mesh, std::vector<Vec3>& positions) const {
  const std::vector<FinePoint>& all = keeper_->points();
  positions.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    positions[i] = all[i].is_live() ? current_place(mesh, all[i].binding) : all[i].rest;
  }
}

void EmbeddedSurface::fill_normals(std::span<const Vec3> positions, std::vector<Vec3>& normals) const {
  const std::vector<FinePoint>& all = keeper_->points();
  std::vector<Vec3> at_rest(all.size(), Vec3::Zero()), now(all.size(), Vec3::Zero());
  for (const FineTriangle& triangle : keeper_->triangles()) {
    if (!triangle.is_live()) continue;
    const auto& [a, b, c] = triangle.points;
    const Vec3 rest = (all[b].rest - all[a].rest).cross(all[c].rest - all[a].rest);
    const Vec3 current = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
    for (const std::uint32_t p : triangle.points) {
      at_rest[p] += rest;
      now[p] += current;
    }
  }
  normals.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    normals[i] = turned_with(all[i].normal, at_rest[i], now[i]);
  }
}

Binding EmbeddedSurface::locate(const TetMesh& mesh, const Vec3& rest, const Vec3& towards) const {
  NearTets near(keeper_->extent());
  Box box;
  box.extend(rest);
  near.gather(mesh, keeper_->grid(), box, keeper_->reach());
  return bind_to(mesh, near.locate(rest + kAskedTowards * (towards - rest)), rest);
}

std::optional<Vec3> EmbeddedSurface::find_nearest(const Vec3& rest, double reach) const {
  const TriangleTree::Hit hit = keeper_->tree().closest(rest, reach);
  return hit.is_valid() ? std::optional<Vec3>(hit.point) : std::nullopt;
}

}  // namespace v0
}  // namespace incise
