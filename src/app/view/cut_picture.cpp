// SPDX-License-Identifier: Apache-2.0
// The walls' mean normal, both lips alike, says from where they are seen at a slant. Pieces are moved apart; where
// that shows nothing, the skin becomes translucent.
#include "app/view/cut_picture.h"

#include "app/view/spread_pieces.h"
#include "incise/mesh/components.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kSpread = 0.25;
constexpr double kPictureSeeThrough = 0.4;
constexpr double kLeastGrowth = 1.02;
constexpr double kAcross = 0.8, kAlong = 0.45, kAbove = 0.5;  // where the eye is, against the walls

/// Across the walls, on average, whichever way; zero where there are none. Both lips of a wall count alike.
Vec3 across_walls(const SurfaceFrame& frame) {
  const SurfaceTopology& topology = *frame.topology;
  Vec3 sum = Vec3::Zero();
  for (std::size_t slot = 0; slot < topology.triangles.size(); ++slot) {
    if ((topology.looks[slot].flags & TriangleLook::kWall) == 0) continue;
    const auto& [a, b, c] = topology.triangles[slot];
    const Vec3 origin = frame.positions[a].cast<double>();
    const Vec3 ab = frame.positions[b].cast<double>() - origin, ac = frame.positions[c].cast<double>() - origin;
    const Vec3 normal = ab.cross(ac);
    sum += sum.dot(normal) < 0 ? Vec3(-normal) : normal;
  }
  return sum;
}

/// Moves pieces apart. Returns whether that lets anything be seen: a core within its ring stays where it is.
bool spread(const TetMesh& mesh, SurfaceFrame& frame) {
  const Box before = bounds_of(frame);
  spread_pieces(mesh, find_components(mesh), kSpread, frame);
  const Box after = bounds_of(frame);
  return (after.hi - after.lo).norm() > kLeastGrowth * (before.hi - before.lo).norm();
}

Camera aim(const Vec3& across, const SurfaceFrame& frame, const Viewport& viewport) {
  Camera camera;
  if (across.norm() > 0) {
    const Vec3 normal = across.normalized();
    Vec3 along = camera.up.cross(normal);
    along = along.norm() > 1e-3 ? Vec3(along.normalized()) : Vec3(Vec3::UnitX());
    // Of the two sides of a wall, that on which a camera stands where nobody says otherwise.
    const Vec3 side = normal.dot(camera.backward()) < 0 ? Vec3(-normal) : normal;
    look_along(camera, -(kAcross * side + kAlong * along + kAbove * camera.up));
  }
  frame_points(camera, viewport, frame.positions);
  return camera;
}

}  // namespace

Result<Picture> picture_of_cut(const TetMesh& mesh, const Journal& journal, const Viewport& viewport, FineView* fine) {
  Picture picture;
  if (fine == nullptr) {
    SurfaceView(mesh, journal).fill(mesh, picture.surface);
  } else if (const Status shown = fine->show(mesh, journal, picture.surface); !shown.ok()) {
    return shown.error();
  }
  const Vec3 across = across_walls(picture.surface);
  const bool has_spread = spread(mesh, picture.surface);
  picture.options.theme = Theme::kLight;
  picture.options.shows_newest = false;
  if (!has_spread && across.norm() > 0) picture.options.skin_opacity = kPictureSeeThrough;
  picture.camera = aim(across, picture.surface, viewport);
  return picture;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
