// SPDX-License-Identifier: Apache-2.0
// A scene's view says as much as it likes; the rest follows from gravity and from the body's box.
#include "app/view/scene_camera.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// A direction of any finite length but zero; stable, so that the squares neither vanish nor overflow.
Vec3 unit_of(const Vec3& direction) {
  return direction.stableNormalized();
}

Vec3 up_of(const SceneView& view, const Vec3& gravity) {
  if (view.up) return unit_of(*view.up);
  return gravity.isZero(0) ? Vec3(Vec3::UnitZ()) : Vec3(-unit_of(gravity));
}

}  // namespace

Camera camera_of(const Scene& scene, const Box& body, const Viewport& viewport) {
  const SceneView view = scene.view.value_or(SceneView{});
  Camera camera;
  camera.up = up_of(view, scene.options.body.gravity);
  if (view.from) look_along(camera, -unit_of(*view.from));
  frame_all(camera, viewport, body);
  if (view.target) camera.target = *view.target;
  if (view.distance) camera.distance = *view.distance;
  camera.distance /= view.zoom;
  return camera;
}

ViewOptions view_options_of(const Scene& scene) {
  const SceneView view = scene.view.value_or(SceneView{});
  ViewOptions options;
  options.theme = view.theme;
  options.color = view.color;
  options.shows_wireframe = view.shows_wireframe;
  options.skin_opacity = view.skin_opacity;
  options.look = view.look;
  return options;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
