// SPDX-License-Identifier: Apache-2.0
// Pictures as they looked when somebody last looked at them. INCISE_UPDATE_GOLDENS=1 takes them as they are now.
#include "render/render_picture.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "pictures.h"

namespace render_picture_test {
namespace {

namespace app = incise::app;
namespace fs = std::filesystem;
using incise::render::Image;

// Other versions of a rasteriser, and other machines' vector instructions, round edges and shades otherwise.
constexpr double kMostMean = 1.5;        // of 255
constexpr double kMostDiffering = 0.02;  // share of pixels
constexpr int kThreshold = 24;           // of 255, above which a pixel differs

// What has many edges packs badly: smaller, to keep the repository small.
constexpr app::Viewport kMedium{240, 180}, kTiny{192, 144};

bool updates() {
  const char* wish = std::getenv("INCISE_UPDATE_GOLDENS");
  return wish != nullptr && std::string(wish) == "1";
}

void keep_for_a_look(const Image& image, const Image& golden, const std::string& name) {
  const fs::path folder = fs::path(INCISE_PICTURES);
  std::error_code code;
  fs::create_directories(folder, code);
  const fs::path drawn = folder / (name + ".png"), difference = folder / (name + "_difference.png");
  EXPECT_TRUE(write_png(image, drawn).ok());
  EXPECT_TRUE(write_png(incise::render::difference_image(image, golden), difference).ok());
  ADD_FAILURE() << "look at " << drawn << " and " << difference
                << "; where it is right, run with INCISE_UPDATE_GOLDENS=1";
}

void expect_golden(const app::Picture& picture, const std::string& name,
                   const app::Viewport& viewport = incise_test::kSmall) {
  const auto image = incise::render::render_picture(picture, viewport);
  if (!image.ok() && image.error().code == incise::ErrorCode::kUnsupported) GTEST_SKIP() << image.error().message;
  ASSERT_TRUE(image.ok()) << image.error().message;
  const fs::path path = fs::path(INCISE_GOLDEN) / (name + ".png");
  if (updates()) {
    ASSERT_TRUE(write_png(*image, path).ok());
  }
  const auto golden = incise::render::read_png(path);
  ASSERT_TRUE(golden.ok()) << golden.error().message;
  const auto difference = compare(*image, *golden, kThreshold);
  EXPECT_LE(difference.mean, kMostMean);
  EXPECT_LE(difference.differing, kMostDiffering);
  if (difference.mean > kMostMean || difference.differing > kMostDiffering) keep_for_a_look(*image, *golden, name);
}

const incise_test::WoundedCube& cube() {
  static const incise_test::WoundedCube kWounded;
  return kWounded;
}

/// One mark of each kind in several inks, in and around the cube.
app::Marks marks() {
  app::Marks marks;
  for (int i = 0; i < 12; ++i) {
    const auto ink = static_cast<app::Ink>(i);
    const float x = -0.15F + 0.12F * static_cast<float>(i);
    marks.lines.push_back({{x, -0.1F, 0.05F}, {x, -0.1F, 0.6F}, ink, 3, false, i % 2 == 1});
    marks.balls.push_back({{x, -0.1F, 0.75F}, ink, 6, true});
    marks.triangles.push_back({{{{x, -0.1F, 0.9F}, {x + 0.1F, -0.1F, 0.9F}, {x, -0.1F, 1.15F}}}, ink, 0.5F});
  }
  marks.lines.push_back({{0.1F, 1.2F, 0.2F}, {0.9F, 0.5F, 1.2F}, app::Ink::kBlade, 4, true, false});
  marks.balls.push_back({{1.0F, 0.3F, 1.0F}, app::Ink::kTool, 0.15F, false});
  return marks;
}

}  // namespace

TEST(RenderPicture, tissue_with_wounds) {
  expect_golden(cube().picture(), "tissue");
}

TEST(RenderPicture, light_theme) {
  app::Picture picture = cube().picture();
  picture.options.theme = app::Theme::kLight;
  expect_golden(picture, "light");
}

TEST(RenderPicture, quality_with_wireframe) {
  app::Picture picture = cube().picture();
  picture.options.color = app::ColorBy::kQuality;
  picture.options.shows_wireframe = true;
  expect_golden(picture, "quality_wireframe", kMedium);
}

TEST(RenderPicture, translucent_skin_with_marks) {
  app::Picture picture = cube().picture();
  picture.options.skin_opacity = 0.35;
  picture.marks = marks();
  expect_golden(picture, "translucent_marks", kTiny);
}

TEST(RenderPicture, opaque_skin_with_marks_in_the_light) {
  app::Picture picture = cube().picture();
  picture.options.theme = app::Theme::kLight;
  picture.marks = marks();
  expect_golden(picture, "light_marks", kTiny);
}

TEST(RenderPicture, clip_plane_shows_the_inside) {
  app::SurfaceOptions options;
  options.clip = app::HalfSpace{incise::Vec3(0, 1, 0), 0.45};
  expect_golden(cube().picture(options), "clip");
}

TEST(RenderPicture, regions) {
  app::Picture picture = cube().picture();
  picture.options.color = app::ColorBy::kRegion;
  expect_golden(picture, "regions");
}

TEST(RenderPicture, strokes) {
  app::Picture picture = cube().picture();
  picture.options.color = app::ColorBy::kStroke;
  expect_golden(picture, "strokes");
}

TEST(RenderPicture, errors_come_back) {
  const auto image = incise::render::render_picture({}, {0, 0});
  if (!image.ok() && image.error().code == incise::ErrorCode::kUnsupported) GTEST_SKIP() << image.error().message;
  ASSERT_FALSE(image.ok());
  EXPECT_EQ(image.error().code, incise::ErrorCode::kBadArgument);
}

}  // namespace render_picture_test
