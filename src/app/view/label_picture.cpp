// SPDX-License-Identifier: Apache-2.0
// A clip plane through the body's middle, facing the eye, opens bodies of several regions.
#include "app/view/label_picture.h"

#include "incise/mesh/bounds.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

const Vec3 kFromFront(0.45, 0.85, 0.4);  // from the body to the eye

bool has_several_regions(const TetMesh& mesh) {
  bool has_first = false, has_several = false;
  std::int32_t first = 0;
  mesh.for_each_tet([&](TetId tet) {
    if (!has_first) first = mesh.region(tet);
    has_first = true;
    has_several = has_several || mesh.region(tet) != first;
  });
  return has_several;
}

}  // namespace

Picture picture_of_labels(const TetMesh& mesh, const Journal& journal, const Viewport& viewport) {
  Picture picture;
  SurfaceView view(mesh, journal);
  const Box body = current_bounds(mesh);
  if (has_several_regions(mesh)) {
    // What is in front of the middle: -y <= -middle.
    view.set_options({HalfSpace{-Vec3::UnitY(), -0.5 * (body.lo.y() + body.hi.y())}});
    view.follow(mesh, journal);
  }
  view.fill(mesh, picture.surface);
  picture.options.theme = Theme::kLight;
  picture.options.color = ColorBy::kRegion;
  picture.options.shows_wireframe = true;
  look_along(picture.camera, -kFromFront);
  frame_points(picture.camera, viewport, picture.surface.positions);
  return picture;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
