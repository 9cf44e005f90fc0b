// SPDX-License-Identifier: Apache-2.0
#include "app/view/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/view/viewed_body.h"

namespace incise::app::camera_test {
namespace {

Vec3 in_clip(const Camera& camera, const Viewport& viewport, const Box& box, const Vec3& p) {
  const Eigen::Vector4d clip = to_clip(camera, viewport, box) * camera.to_view() * p.homogeneous();
  return clip.head<3>() / clip.w();
}

class Cameras : public testing::TestWithParam<Vec3> {
 protected:
  [[nodiscard]] Camera camera() const {
    Camera camera;
    camera.up = GetParam();
    frame_all(camera, viewport_, box_);
    return camera;
  }
  Viewport viewport_{1000, 600};
  Box box_{{-1, 2, 0}, {3, 3, 0.5}};
};

TEST_P(Cameras, RaysThroughPixelsLeadToWhatIsSeenThere) {
  const Camera c = camera();
  for (const Vec2& pixel : {Vec2(0, 0), Vec2(999, 599), Vec2(123.25, 456.75)}) {
    const Ray ray = ray_through(c, viewport_, pixel);
    EXPECT_NEAR(ray.direction.norm(), 1, 1e-12);
    EXPECT_LT((to_pixel(c, viewport_, ray.origin + 2.5 * ray.direction).value() - pixel).norm(), 1e-6);
  }
}

TEST_P(Cameras, PixelsAgreeWithTheMatrices) {
  const Camera c = camera();
  for (const Vec3& p : corners_of(box_)) {
    const Vec3 clip = in_clip(c, viewport_, box_, p);
    const Vec2 pixel = to_pixel(c, viewport_, p).value();
    EXPECT_NEAR(pixel.x() + 0.5, 0.5 * (clip.x() + 1) * viewport_.width, 1e-6);
    EXPECT_NEAR(pixel.y() + 0.5, 0.5 * (1 - clip.y()) * viewport_.height, 1e-6);
  }
}

TEST_P(Cameras, NothingBehindTheEyeIsInThePicture) {
  const Camera c = camera();
  EXPECT_FALSE(to_pixel(c, viewport_, c.eye() + c.backward()).has_value());
}

TEST_P(Cameras, OrbitKeepsTheDistanceAndUpStaysUp) {
  Camera c = camera();
  const Vec3 target = c.target;
  const double distance = c.distance;
  for (int i = 0; i < 100; ++i) {
    orbit(c, viewport_, {37.0 * i, i % 2 == 0 ? 5000 : -4000});
    EXPECT_NEAR((c.eye() - target).norm(), distance, 1e-9);
    EXPECT_GT(c.upward().dot(c.up), 0);
    EXPECT_NEAR(c.right().dot(c.up), 0, 1e-12);
  }
}

TEST_P(Cameras, AFullTurnComesBack) {
  Camera c = camera();
  const Vec3 eye = c.eye();
  orbit(c, viewport_, {2.0 * viewport_.height, 0});
  EXPECT_LT((c.eye() - eye).norm(), 1e-9);
}

TEST_P(Cameras, PanMovesWhatIsAtTheTargetWithThePointer) {
  Camera c = camera();
  const Vec3 before = c.target;
  const Vec2 from = to_pixel(c, viewport_, before).value();
  pan(c, viewport_, {30, -20});
  EXPECT_LT((to_pixel(c, viewport_, before).value() - from - Vec2(30, -20)).norm(), 1e-6);
}

TEST_P(Cameras, FrameAllShowsAllCornersWhateverTheShapeOfThePicture) {
  for (const Viewport& viewport : {Viewport{2000, 300}, Viewport{300, 2000}, Viewport{500, 500}}) {
    for (const Vec3& direction : {Vec3(1, 0.2, -0.3), Vec3(0, 0, -1), Vec3(-1, 1, 1), Vec3(0, 1, 0)}) {
      Camera c = camera();
      look_along(c, direction);
      frame_all(c, viewport, box_);
      double widest = 0;
      for (const Vec3& p : corners_of(box_)) {
        const Vec3 clip = in_clip(c, viewport, box_, p);
        EXPECT_LE(clip.cwiseAbs().maxCoeff(), 1);
        widest = std::max(widest, clip.head<2>().cwiseAbs().maxCoeff());
      }
      EXPECT_GT(widest, 0.8);  // and no smaller than need be
    }
  }
}

TEST_P(Cameras, NearAndFarPlanesContainTheBoxFromAfar) {
  Camera c = camera();
  for (const double factor : {1.0, 3.0, 10.0, 100.0}) {
    zoom(c, factor, box_);
    for (const Vec3& p : corners_of(box_)) EXPECT_LE(std::abs(in_clip(c, viewport_, box_, p).z()), 1);
  }
}

TEST_P(Cameras, ZoomStaysWithinBounds) {
  Camera c = camera();
  const double size = (box_.hi - box_.lo).norm();
  for (int i = 0; i < 200; ++i) zoom(c, 0.5, box_);
  EXPECT_NEAR(c.distance, 1e-3 * size, 1e-12);
  for (int i = 0; i < 200; ++i) zoom(c, 2, box_);
  EXPECT_NEAR(c.distance, 1e3 * size, 1e-6);
}

TEST_P(Cameras, LookAlongLooksThere) {
  Camera c = camera();
  for (const Vec3& direction : {Vec3(1, 0.2, -0.3), Vec3(0, 3, 0.1), Vec3(-1, 1, 1)}) {
    look_along(c, direction);
    EXPECT_LT((c.backward() + direction.normalized()).norm(), 1e-9);
  }
  look_along(c, -c.up);  // as steep as it gets
  EXPECT_GT(c.backward().dot(c.up), 0.99999);
}

TEST_P(Cameras, PixelSizeIsWhatAPixelCovers) {
  const Camera c = camera();
  const double size = c.pixel_size(viewport_, c.target);
  const Vec2 from = to_pixel(c, viewport_, c.target).value();
  const Vec2 to = to_pixel(c, viewport_, c.target + size * c.right()).value();
  EXPECT_NEAR((to - from).norm(), 1, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Up, Cameras, testing::Values(Vec3(0, 1, 0), Vec3(0, 0, 1)));

TEST(Camera, AnEmptyBoxLeavesTheCameraWhereItIs) {
  Camera c;
  const Vec3 eye = c.eye();
  frame_all(c, kSquare, Box());
  EXPECT_EQ(c.eye(), eye);
}

}  // namespace
}  // namespace incise::app::camera_test
