// SPDX-License-Identifier: Apache-2.0
// What tests of pictures and tools share: views of a block, and a block that is simulated and touched.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "app/hands/tools.h"
#include "app/view/camera.h"
#include "app/view/picture.h"
#include "app/view/surface_view.h"
#include "incise/engine/simulation.h"
#include "incise/mesh/shapes.h"

namespace incise::app {

inline const Box kUnitBox{Vec3::Zero(), Vec3::Ones()};
inline const Viewport kSquare{800, 800};

inline std::array<Vec3, 8> corners_of(const Box& box) {
  std::array<Vec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i) {
    corners[i] = {((i & 1U) != 0 ? box.hi : box.lo).x(), ((i & 2U) != 0 ? box.hi : box.lo).y(),
                  ((i & 4U) != 0 ? box.hi : box.lo).z()};
  }
  return corners;
}

inline TetMesh cube_mesh(std::uint32_t cells) {
  return TetMesh::build(kuhn_cube(cells)).value();
}

/// A camera that looks at a box, along a direction.
inline Camera camera_along(const Vec3& direction, const Box& box = kUnitBox) {
  Camera camera;
  look_along(camera, direction);
  frame_all(camera, kSquare, box);
  return camera;
}

/// The mesh's surface from scratch, at its current place.
inline SurfaceFrame surface_of(const TetMesh& mesh) {
  SurfaceFrame frame;
  SurfaceView(mesh, Journal()).fill(mesh, frame);
  return frame;
}

/// A cube of side 20 mm in m, held at its bottom, that a person sees and touches.
class TouchedCube {
 public:
  static constexpr double kSide = 0.02;
  static constexpr double kYoung = 30e3;  // Pa

  explicit TouchedCube(std::uint32_t cells = 6, const Vec3& view = {0.3, 0.4, -1}) {
    SimulationOptions options;
    options.body.gravity = Vec3::Zero();
    options.engine.maintain.work_units = 20000;
    options.materials.fallback.young = kYoung;
    const Box box{Vec3::Zero(), Vec3::Constant(kSide)};
    Result<TetMesh> mesh = TetMesh::build(kuhn_box(box.lo, box.hi, {cells, cells, cells}));
    sim_.emplace(Simulation::create(std::move(mesh).value(), options).value());
    sim_->mesh().for_each_vertex([&](VertexId v) {
      if (sim_->mesh().rest(v).z() < 1e-9) {
        EXPECT_TRUE(sim_->body().hold(v, std::numeric_limits<double>::infinity()).ok());
      }
    });
    view_.emplace(sim_->mesh(), sim_->engine().journal());
    view_->fill(sim_->mesh(), surface_);
    camera_ = camera_along(view, box);
    tools_.set(settings_for(box, kYoung, 1));
    frame();  // from now on the body stands otherwise than at rest, if only by rounding
    frame();
  }

  [[nodiscard]] Simulation& sim() { return *sim_; }
  [[nodiscard]] const TetMesh& mesh() const { return sim_->mesh(); }
  [[nodiscard]] ToolMachine& tools() { return tools_; }
  [[nodiscard]] Camera& camera() { return camera_; }
  [[nodiscard]] const SurfaceFrame& surface() const { return surface_; }
  [[nodiscard]] ToolContext context() const { return {kSquare, &surface_, bounds_of(surface_)}; }
  [[nodiscard]] Vec2 pixel(const Vec3& point) const { return to_pixel(camera_, kSquare, point).value(); }

  void send(const PointerEvent& event) { tools_.handle(event, context(), camera_); }
  void send(PointerEvent::Kind kind, const Vec2& pixel) {
    PointerEvent event;
    event.kind = kind;
    event.pixel = pixel;
    send(event);
  }
  /// One frame of what the hands do now; the view follows.
  void frame() {
    FrameInput input;
    input.blade = tools_.hands().blade;
    input.hooks = tools_.hands().hooks;
    const Result<FrameReport> report = sim_->frame(input);
    ASSERT_TRUE(report.ok()) << report.error().message;
    view_->follow(sim_->mesh(), sim_->engine().journal());
    view_->fill(sim_->mesh(), surface_);
  }
  /// A drag of the chosen tool from pixel to pixel, one frame per event. The pointer is released.
  void drag(const Vec2& from, const Vec2& to, int moves) {
    press_and_move(from, to, moves);
    send(PointerEvent::Kind::kRelease, to);
    frame();
  }
  void press_and_move(const Vec2& from, const Vec2& to, int moves) {
    send(PointerEvent::Kind::kPress, from);
    frame();
    for (int i = 1; i <= moves; ++i) {
      send(PointerEvent::Kind::kMove, from + (to - from) * i / moves);
      frame();
    }
  }

 private:
  std::optional<Simulation> sim_;
  std::optional<SurfaceView> view_;
  SurfaceFrame surface_;
  Camera camera_;
  ToolMachine tools_{ToolSettings{}};
};

}  // namespace incise::app
