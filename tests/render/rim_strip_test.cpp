// SPDX-License-Identifier: Apache-2.0
#include "render/rim_strip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "pictures.h"
#include "render/image.h"

using incise_test::Drawing;
namespace rim_strip_test {
namespace app = incise::app;
using incise::render::Image;
using incise::render::RimStrip;

namespace {

using Edge = std::array<std::uint32_t, 2>;
constexpr app::Viewport kWide{640, 480};
constexpr double kHalfWidth = 1.5;  // pixels, that of marks_shaders.h
constexpr double kFar = 6;          // pixels from a rim, from which it is the same how far
constexpr double kInexact = 0.1;    // pixels: of where a rim is
constexpr double kBead = 0.1;       // of a pixel: darker by more is seen
constexpr int kRounded = 4;         // pixels right on the line between two stretches, which both may draw
constexpr int kRounding = 3;        // of a channel

std::shared_ptr<app::SurfaceTopology> rims_of(std::size_t points, const std::vector<Edge>& edges) {
  auto topology = std::make_shared<app::SurfaceTopology>();
  topology->vertices.resize(points);
  topology->contour_edges = edges;
  return topology;
}

/// A flat sheet with rims at these points above it, seen from obliquely above.
app::Picture with_rims(const std::vector<Eigen::Vector3f>& points, const std::vector<Edge>& edges) {
  app::Picture picture = incise_test::sheet(1);
  for (Eigen::Vector3f& at : picture.surface.positions) at.z() = 0;
  auto topology = incise_test::copy_of(picture.surface);
  const auto first = static_cast<std::uint32_t>(picture.surface.positions.size());
  for (const auto& [from, to] : edges) topology->contour_edges.push_back({first + from, first + to});
  picture.surface.positions.insert(picture.surface.positions.end(), points.begin(), points.end());
  topology->vertices.resize(picture.surface.positions.size());
  picture.surface.topology = topology;
  picture.options.color = app::ColorBy::kStroke;
  picture.options.shows_occlusion = picture.options.shows_shadows = false;
  picture.camera.elevation = 0.9;
  app::frame_all(picture.camera, kWide, app::bounds_of(picture.surface));
  return picture;
}

double way_to(const Eigen::Vector2d& at, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double share = std::clamp((at - a).dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
  return (at - a - share * along).norm();
}

/// Pixels from each pixel's centre to the nearest of a picture's rims, up to `kFar`.
std::vector<double> ways_to_rims(const app::Picture& picture) {
  std::vector<double> ways(static_cast<std::size_t>(kWide.width * kWide.height), kFar);
  for (const auto& [from, to] : picture.surface.topology->contour_edges) {
    const auto on_picture = [&](std::uint32_t point) {
      return to_pixel(picture.camera, kWide, picture.surface.positions[point].cast<double>()).value();
    };
    const Eigen::Vector2d a = on_picture(from), b = on_picture(to);
    const Eigen::Vector2i lo = (a.cwiseMin(b).array() - kFar).cast<int>().cwiseMax(0);
    const Eigen::Vector2i hi = (a.cwiseMax(b).array() + kFar).cast<int>();
    for (int y = lo.y(); y <= std::min(hi.y(), kWide.height - 1); ++y) {
      for (int x = lo.x(); x <= std::min(hi.x(), kWide.width - 1); ++x) {
        double& way = ways[static_cast<std::size_t>(y * kWide.width + x)];
        way = std::min(way, way_to(Eigen::Vector2d(x, y), a, b));
      }
    }
  }
  return ways;
}

struct Faults {
  int slits = 0;  // pixels within a rim that are not its ink
  int blots = 0;  // pixels beside it that differ from the picture without it
  int beads = 0;  // pixels at its border that are darker than by the ink's share of them
  int inked = 0;
};

/// How dark a pixel is, between ground and ink.
double share_of(const Image::Pixel& pixel, const Image::Pixel& ground, const Image::Pixel& ink) {
  return (ground[1] - pixel[1]) / static_cast<double>(ground[1] - ink[1]);
}

bool is_same(const Image::Pixel& a, const Image::Pixel& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(a[i] - b[i]) > kRounding) return false;
  }
  return true;
}

Faults faults_of(Drawing& drawing, const app::Picture& picture) {
  EXPECT_TRUE(drawing.draw(picture).ok());
  const Image with = drawing.read();
  app::Picture bare = picture;
  auto topology = incise_test::copy_of(picture.surface);
  topology->contour_edges.clear();
  bare.surface.topology = topology;
  EXPECT_TRUE(drawing.draw(bare).ok());
  EXPECT_EQ(drawing.complaints(), "");
  const Image without = drawing.read();
  const std::vector<double> ways = ways_to_rims(picture);
  const auto nearest = static_cast<std::size_t>(std::min_element(ways.begin(), ways.end()) - ways.begin());
  const Image::Pixel ink = with.pixels[nearest];
  Faults faults;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double cover = std::clamp(0.5 + kHalfWidth - ways[i], 0.0, 1.0);
    const bool is_within = ways[i] < kHalfWidth - 0.5 - kInexact;
    if (is_within && !is_same(with.pixels[i], ink)) ++faults.slits;
    if (ways[i] > kHalfWidth + 1 && !is_same(with.pixels[i], without.pixels[i])) ++faults.blots;
    if (is_within) ++faults.inked;
    if (share_of(with.pixels[i], without.pixels[i], ink) > cover + kBead) ++faults.beads;
  }
  return faults;
}

void expect_whole(Drawing& drawing, const app::Picture& picture) {
  const Faults faults = faults_of(drawing, picture);
  EXPECT_GT(faults.inked, 100);
  EXPECT_EQ(faults.slits, 0);
  EXPECT_EQ(faults.blots, 0);
  EXPECT_LE(faults.beads, kRounded);
}

/// A closed rim of two lips that meet at sharp ends, jagged, `opened` wide in the middle.
app::Picture wound(double opened, std::size_t stretches, double jag) {
  std::vector<Eigen::Vector3f> points;
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < 2 * stretches; ++i) {
    const double turn = std::numbers::pi * static_cast<double>(i) / static_cast<double>(stretches);
    const double y = opened * std::sin(turn) + (i % 2 == 0 ? jag : -jag);
    const double height =
        0.02 + 0.005 * static_cast<double>(7 * i % 5);  // so that stretches are not as far from the eye
    points.emplace_back(Eigen::Vector3d(0.5 + 0.4 * std::cos(turn), 0.5 + y, height).cast<float>());
    const auto from = static_cast<std::uint32_t>(i);
    edges.push_back({from, static_cast<std::uint32_t>((i + 1) % (2 * stretches))});
  }
  return with_rims(points, edges);
}

}  // namespace

TEST(RimStrip, stretches_of_a_closed_rim_share_their_joints) {
  RimStrip strip;
  strip.find(rims_of(5, {{3, 1}, {0, 2}, {1, 2}, {0, 3}}));
  const std::vector<RimStrip::Stretch> expected = {{0, 3, 1, 2}, {3, 0, 2, 1}, {3, 1, 2, 0}, {2, 0, 3, 1}};
  EXPECT_EQ(strip.stretches(), expected);
}

TEST(RimStrip, ends_and_crossings_go_nowhere) {
  RimStrip strip;
  strip.find(rims_of(5, {{0, 1}, {1, 2}, {1, 3}, {3, 4}}));
  const std::vector<RimStrip::Stretch> expected = {{0, 0, 1, 1}, {1, 1, 2, 2}, {1, 1, 3, 4}, {1, 3, 4, 4}};
  EXPECT_EQ(strip.stretches(), expected);
}

TEST(RimStrip, is_found_anew_for_another_topology_alone) {
  RimStrip strip;
  const auto topology = rims_of(3, {{0, 1}});
  strip.find(topology);
  topology->contour_edges.push_back({1, 2});
  strip.find(topology);
  EXPECT_EQ(strip.stretches().size(), 1U);
  strip.find(std::make_shared<app::SurfaceTopology>(*topology));
  EXPECT_EQ(strip.stretches().size(), 2U);
  strip.find(nullptr);
  EXPECT_TRUE(strip.stretches().empty());
}

TEST(RimStrip, edges_at_points_that_there_are_not_are_left_out) {
  RimStrip strip;
  strip.find(rims_of(2, {{0, 1}, {1, 7}}));
  EXPECT_EQ(strip.stretches(), (std::vector<RimStrip::Stretch>{{0, 0, 1, 1}}));
}

TEST(RimStrip, has_neither_slits_nor_beads_where_a_wound_is_open) {
  Drawing drawing(kWide, 0);
  INCISE_SKIP_WITHOUT(drawing);
  expect_whole(drawing, wound(0.2, 12, 0));
  expect_whole(drawing, wound(0.2, 12, 0.01));
  expect_whole(drawing, wound(0.2, 7, 0.05));
}

TEST(RimStrip, covers_all_where_stretches_are_as_small_as_pixels) {
  Drawing drawing(kWide, 0);
  INCISE_SKIP_WITHOUT(drawing);
  for (const double jag : {0.0, 0.002}) {
    const Faults faults = faults_of(drawing, wound(0.2, jag > 0 ? 700 : 200, jag));
    EXPECT_EQ(faults.slits, 0) << jag;
    EXPECT_EQ(faults.blots, 0) << jag;
  }
}

TEST(RimStrip, covers_all_where_lips_nearly_meet) {
  Drawing drawing(kWide, 0);
  INCISE_SKIP_WITHOUT(drawing);
  for (const double opened : {0.0, 0.004, 0.01}) {
    const Faults faults = faults_of(drawing, wound(opened, 16, 0));
    EXPECT_EQ(faults.slits, 0) << opened;
    EXPECT_EQ(faults.blots, 0) << opened;
  }
}

TEST(RimStrip, covers_all_where_rims_cross) {
  Drawing drawing(kWide, 0);
  INCISE_SKIP_WITHOUT(drawing);
  const std::vector<Eigen::Vector3f> points = {
      {0.2F, 0.5F, 0}, {0.5F, 0.5F, 0}, {0.8F, 0.5F, 0}, {0.45F, 0.2F, 0}, {0.6F, 0.8F, 0}};
  const Faults faults = faults_of(drawing, with_rims(points, {{0, 1}, {1, 2}, {3, 1}, {1, 4}}));
  EXPECT_EQ(faults.slits, 0);
  EXPECT_EQ(faults.blots, 0);
}

}  // namespace rim_strip_test
