// SPDX-License-Identifier: Apache-2.0
#include "render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "pictures.h"
#include "render/image.h"

using incise::ErrorCode;
using incise_test::Drawing;
namespace renderer_test {
namespace app = incise::app;

namespace {

constexpr std::size_t kBlock = 4096;
constexpr std::size_t kPointBlock = kBlock * sizeof(Eigen::Vector3f);

void expect_drawn(Drawing& drawing, const app::Picture& picture) {
  const auto status = drawing.draw(picture);
  ASSERT_TRUE(status.ok()) << status.error().message;
  EXPECT_EQ(drawing.complaints(), "");
}

void expect_refused(Drawing& drawing, const app::Picture& picture) {
  const auto status = drawing.draw(picture);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kBadArgument);
  EXPECT_EQ(drawing.complaints(), "");
}

app::Picture with_marks() {
  app::Picture picture = incise_test::sheet(8);
  picture.marks.lines.push_back({{0, 0, 0.3F}, {1, 1, 0.3F}, app::Ink::kBlade, 3, true, true});
  picture.marks.balls.push_back({{0.5F, 0.5F, 0.2F}, app::Ink::kHook, 0.1F, false});
  picture.marks.triangles.push_back({{{{0, 0, 0.2F}, {1, 0, 0.2F}, {0, 1, 0.4F}}}, app::Ink::kIncision, 0.5F});
  return picture;
}

}  // namespace

TEST(Renderer, same_picture_uploads_nothing) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture picture = with_marks();
  expect_drawn(drawing, picture);
  EXPECT_GT(drawing.statistics().bytes_uploaded, 0U);
  EXPECT_EQ(drawing.statistics().triangles, 128U);
  EXPECT_EQ(drawing.statistics().points, 81U);
  EXPECT_EQ(drawing.statistics().marks, 3U);
  expect_drawn(drawing, picture);
  EXPECT_EQ(drawing.statistics().bytes_uploaded, 0U);
  picture.surface.topology = incise_test::copy_of(picture.surface);
  picture.camera.azimuth += 0.1;
  expect_drawn(drawing, picture);
  EXPECT_EQ(drawing.statistics().bytes_uploaded, 0U) << "an equal topology, seen from elsewhere";
}

TEST(Renderer, small_changes_upload_their_blocks) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture picture = incise_test::sheet(200);
  expect_drawn(drawing, picture);
  auto topology = incise_test::copy_of(picture.surface);
  topology->looks[70000].flags = app::TriangleLook::kWall;
  picture.surface.topology = topology;
  expect_drawn(drawing, picture);
  EXPECT_EQ(drawing.statistics().bytes_uploaded, kBlock * sizeof(app::TriangleLook));
  picture.surface.positions[10000].z() += 0.1F;
  expect_drawn(drawing, picture);
  EXPECT_EQ(drawing.statistics().bytes_uploaded, 2 * kPointBlock) << "positions, and normals of the same block";
}

TEST(Renderer, shrinks_and_grows) {
  std::vector<incise::render::Image> expected;
  for (const std::uint32_t n : {60U, 3U, 90U}) {
    Drawing fresh;
    INCISE_SKIP_WITHOUT(fresh);
    expect_drawn(fresh, incise_test::sheet(n));
    expected.push_back(fresh.read());
  }
  Drawing drawing;
  for (const std::size_t i : {0U, 1U, 2U, 1U, 0U}) {
    constexpr std::array<std::uint32_t, 3> kSizes = {60, 3, 90};
    expect_drawn(drawing, incise_test::sheet(kSizes[i]));
    EXPECT_EQ(compare(expected[i], drawing.read()).greatest, 0) << kSizes[i];
  }
}

TEST(Renderer, empty_picture_is_background) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture picture;
  expect_drawn(drawing, picture);
  const auto dark = drawing.read();
  picture.surface.topology = std::make_shared<app::SurfaceTopology>();
  expect_drawn(drawing, picture);
  EXPECT_EQ(compare(dark, drawing.read()).greatest, 0);
  EXPECT_EQ(dark.at(0, 100), dark.at(319, 100));
  EXPECT_EQ(drawing.statistics().triangles, 0U);
}

TEST(Renderer, picture_without_topology_forgets_what_was_there) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture nothing;
  expect_drawn(drawing, nothing);
  const auto before = drawing.read();
  expect_drawn(drawing, incise_test::sheet(4));
  EXPECT_GT(compare(before, drawing.read()).differing, 0.1);
  expect_drawn(drawing, nothing);
  EXPECT_EQ(compare(before, drawing.read()).greatest, 0);
}

TEST(Renderer, absurd_cameras_are_refused) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kMost = std::numeric_limits<double>::infinity();
  const app::Picture sane = incise_test::sheet(4);
  const auto refused = [&](auto change) {
    app::Picture picture = sane;
    change(picture.camera);
    expect_refused(drawing, picture);
  };
  refused([&](app::Camera& c) { c.distance = 0; });
  refused([&](app::Camera& c) { c.distance = kMost; });
  refused([&](app::Camera& c) { c.distance = 1e300; });
  refused([&](app::Camera& c) { c.azimuth = kNan; });
  refused([&](app::Camera& c) { c.target.x() = kNan; });
  refused([&](app::Camera& c) { c.target.x() = 1e300; });
  refused([&](app::Camera& c) { c.up.setZero(); });
  refused([&](app::Camera& c) { c.field_of_view = 4; });
  expect_drawn(drawing, sane);
}

TEST(Renderer, surfaces_that_contradict_themselves_are_refused) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture picture = incise_test::sheet(4);
  picture.surface.positions.pop_back();
  expect_refused(drawing, picture);
  picture = incise_test::sheet(4);
  auto topology = incise_test::copy_of(picture.surface);
  topology->triangles[3][1] = 1000;
  picture.surface.topology = topology;
  expect_refused(drawing, picture);
  picture = incise_test::sheet(4);
  picture.surface.positions[2].y() = std::numeric_limits<float>::infinity();
  expect_refused(drawing, picture);
  picture = incise_test::sheet(4);
  picture.options.skin_opacity = 0;
  expect_refused(drawing, picture);
}

TEST(Renderer, sizes_out_of_range_are_refused) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  const app::Picture picture = incise_test::sheet(4);
  for (const app::Viewport viewport : {app::Viewport{0, 240}, {320, 0}, {-1, -1}, {1 << 20, 10}}) {
    const auto status = drawing.renderer().draw(picture, viewport, drawing.target().framebuffer());
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::kBadArgument);
    EXPECT_FALSE(incise::render::OffscreenTarget::create(viewport).ok());
  }
  EXPECT_EQ(drawing.complaints(), "");
}

TEST(Renderer, sizes_of_one_pixel_and_odd_ones_are_drawn) {
  for (const app::Viewport viewport : {app::Viewport{1, 1}, {3, 5}, {321, 7}}) {
    Drawing drawing(viewport);
    INCISE_SKIP_WITHOUT(drawing);
    expect_drawn(drawing, with_marks());
  }
}

TEST(Renderer, every_option_draws_without_complaint) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture picture = with_marks();
  for (unsigned bits = 0; bits < 64; ++bits) {
    picture.options.theme = (bits & 1U) != 0 ? app::Theme::kLight : app::Theme::kDark;
    picture.options.shows_wireframe = (bits & 2U) != 0;
    picture.options.shows_surface = (bits & 4U) == 0;
    picture.options.skin_opacity = (bits & 8U) != 0 ? 0.4 : 1;
    picture.options.shows_occlusion = (bits & 16U) != 0;
    picture.options.color = (bits & 32U) != 0 ? app::ColorBy::kQuality : app::ColorBy::kTissue;
    expect_drawn(drawing, picture);
    EXPECT_FALSE(is_blank(drawing.read()));
  }
}

TEST(Renderer, without_samples_the_picture_is_about_the_same) {
  Drawing smooth;
  INCISE_SKIP_WITHOUT(smooth);
  const app::Picture picture = incise_test::sheet(8);
  expect_drawn(smooth, picture);
  const auto expected = smooth.read();
  Drawing rough(incise_test::kSmall, 0);
  expect_drawn(rough, picture);
  EXPECT_EQ(rough.renderer().samples(), 0U);
  EXPECT_LT(compare(expected, rough.read(), 24).differing, 0.03);
}

TEST(Renderer, marks_that_are_no_numbers_do_no_harm) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  app::Picture picture = incise_test::sheet(4);
  picture.marks.lines.push_back({{kNan, 0, 0}, {1, 1, 0}, app::Ink::kBlade, kNan, true, true});
  picture.marks.balls.push_back({{0, kNan, 0}, app::Ink::kPin, kNan, false});
  picture.marks.triangles.push_back({{{{kNan, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, app::Ink::kTool, 0.5F});
  picture.marks.balls.push_back({{0, 0, 0}, static_cast<app::Ink>(200), 4, true});
  expect_drawn(drawing, picture);
}

// --- solids and shadows

namespace {

double mean_lightness(const incise::render::Image& image) {
  double sum = 0;
  for (const incise::render::Image::Pixel& pixel : image.pixels) sum += pixel[0] + pixel[1] + pixel[2];
  return sum / static_cast<double>(3 * image.pixels.size());
}

/// A flat sheet that is seen from 25 degrees above it, in one colour.
app::Picture flat_sheet() {
  app::Picture picture = incise_test::sheet(8);
  for (Eigen::Vector3f& at : picture.surface.positions) at.z() = 0;
  picture.camera.elevation = 25 * std::numbers::pi / 180;
  picture.options.color = app::ColorBy::kStroke;
  picture.options.shows_occlusion = picture.options.shows_shadows = false;
  return picture;
}

app::Picture below_a_punch() {
  app::Picture picture = incise_test::sheet(8);
  app::Instrument punch;
  punch.kind = app::InstrumentKind::kPunch;
  punch.tip = incise::Vec3(0.5, 0.5, 0.4);
  punch.millimetre = 0.004;
  punch.opening = 0.15;
  picture.marks.instruments.push_back(punch);
  return picture;
}

}  // namespace

TEST(Renderer, an_instrument_is_drawn_and_its_ghost_is_seen_through) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture picture = below_a_punch();
  expect_drawn(drawing, picture);
  const auto solid = drawing.read();
  picture.marks.instruments[0].is_ghost = true;
  expect_drawn(drawing, picture);
  const auto ghost = drawing.read();
  picture.marks.instruments.clear();
  expect_drawn(drawing, picture);
  const auto none = drawing.read();
  EXPECT_GT(compare(solid, none).differing, 0.01);
  EXPECT_GT(compare(ghost, none).differing, 0.01);
  EXPECT_GT(compare(ghost, solid).differing, 0.005);
}

TEST(Renderer, shadows_darken_tissue_below_an_instrument_and_no_colour_that_tells_a_number) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture picture = below_a_punch();
  picture.options.shows_occlusion = false;
  expect_drawn(drawing, picture);
  const auto lit = drawing.read();
  picture.options.shows_shadows = true;
  expect_drawn(drawing, picture);
  const auto shaded = drawing.read();
  EXPECT_LT(mean_lightness(shaded), mean_lightness(lit) - 0.1);
  EXPECT_GT(compare(shaded, lit).differing, 0.002);
  picture.options.color = app::ColorBy::kQuality;
  expect_drawn(drawing, picture);
  const auto told = drawing.read();
  picture.options.shows_shadows = false;
  expect_drawn(drawing, picture);
  EXPECT_EQ(compare(drawing.read(), told).differing, 0);
}

TEST(Renderer, an_instrument_that_is_not_finite_is_left_out) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture picture = below_a_punch();
  picture.marks.instruments[0].tip.x() = std::numeric_limits<double>::quiet_NaN();
  expect_drawn(drawing, picture);
  const auto with = drawing.read();
  picture.marks.instruments.clear();
  expect_drawn(drawing, picture);
  EXPECT_EQ(compare(drawing.read(), with).differing, 0);
}

TEST(Renderer, lines_that_go_on_from_each_other_are_one) {
  Drawing drawing(incise_test::kSmall, 0);
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture picture = flat_sheet();
  const std::array<Eigen::Vector3f, 4> way = {
      Eigen::Vector3f(0.2F, 0.4F, 0.1F), {0.4F, 0.6F, 0.1F}, {0.6F, 0.6F, 0.1F}, {0.8F, 0.4F, 0.1F}};
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    picture.marks.lines.push_back({way[i], way[i + 1], app::Ink::kPicked, 6, false, false});
  }
  expect_drawn(drawing, picture);
  const incise::render::Image image = drawing.read();
  const auto ink_at = [&](const Eigen::Vector3f& place) {
    const auto pixel = to_pixel(picture.camera, incise_test::kSmall, place.cast<double>()).value();
    return image.at(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  };
  const auto ink = ink_at(0.5F * (way[1] + way[2]));
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    for (int step = 0; step <= 40; ++step) {
      const float share = static_cast<float>(step) / 40;
      EXPECT_EQ(ink_at((1 - share) * way[i] + share * way[i + 1]), ink) << i << ", " << share;
    }
  }
}

TEST(Renderer, a_mark_on_tissue_that_is_seen_aslant_is_drawn_whole) {
  Drawing drawing;
  INCISE_SKIP_WITHOUT(drawing);
  app::Picture picture = flat_sheet();
  expect_drawn(drawing, picture);
  const incise::render::Image bare = drawing.read();
  const Eigen::Vector3f centre(0.5F, 0.5F, 0);
  picture.marks.balls.push_back({centre, app::Ink::kHook, 12, true});
  expect_drawn(drawing, picture);
  const incise::render::Image marked = drawing.read();
  const auto middle = to_pixel(picture.camera, incise_test::kSmall, centre.cast<double>()).value();
  int above = 0, below = 0;
  for (int y = 0; y < marked.height; ++y) {
    for (int x = 0; x < marked.width; ++x) {
      if (marked.at(x, y) != bare.at(x, y)) ++(y < middle.y() ? above : below);
    }
  }
  EXPECT_GT(above, 200);
  EXPECT_NEAR(below, above, 0.15 * above);
}

}  // namespace renderer_test
