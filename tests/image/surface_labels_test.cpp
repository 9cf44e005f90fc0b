// SPDX-License-Identifier: Apache-2.0
#include "incise/image/surface_labels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "image/winding_number.h"
#include "incise/image/mesh_labels.h"
#include "incise/mesh/validate.h"

namespace incise::surface_labels_test {
namespace {

using image::label_surface;
using image::WindingNumber;

constexpr double kPi = 3.14159265358979323846;

/// Appends a sphere of 2·n·n triangles or so, turned outwards.
void add_sphere(io::SurfaceSoup& soup, const Vec3& middle, double radius, std::uint32_t n) {
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const double a = kPi * i / n, b = kPi * j / n;
      soup.points.push_back(middle + radius * Vec3(i % n == 0 ? 0 : std::sin(a) * std::cos(b),
                                                   i % n == 0 ? 0 : std::sin(a) * std::sin(b), std::cos(a)));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const std::uint32_t a = first + i * 2 * n + j, b = first + i * 2 * n + (j + 1) % (2 * n);
      if (i > 0) soup.triangles.push_back({a, a + 2 * n, b});
      if (i + 1 < n) soup.triangles.push_back({b, a + 2 * n, b + 2 * n});
    }
  }
}

double share_of(const image::LabelImage& image, std::int32_t label) {
  const std::size_t l = image.find_label(label);
  return l == image.labels.size() ? 0 : static_cast<double>(image.count_voxels()[l]) * image.voxel_volume();
}

double ball(double radius) {
  return 4.0 / 3 * kPi * radius * radius * radius;
}

TEST(WindingNumber, is_one_inside_and_nought_outside) {
  io::SurfaceSoup soup;
  add_sphere(soup, Vec3(1, 2, 3), 5, 40);
  const WindingNumber winding(soup.points, soup.triangles);
  EXPECT_NEAR(winding(Vec3(1, 2, 3)), 1, 0.03);
  EXPECT_NEAR(winding(Vec3(4, 5, 5)), 1, 0.03);
  EXPECT_NEAR(winding(Vec3(5, 5, 5)), 0, 0.03);
  EXPECT_NEAR(winding(Vec3(100, 5, 5)), 0, 0.03);
}

TEST(WindingNumber, angles_need_no_libm) {
  for (int i = 0; i < 400; ++i) {
    const double a = -kPi + 2 * kPi * (i + 0.5) / 400;
    EXPECT_NEAR(image::angle_of(3 * std::sin(a), 3 * std::cos(a)), a, 1e-9);
  }
  EXPECT_EQ(image::angle_of(0, 0), 0);
}

TEST(SurfaceLabels, nested_spheres_become_labels_by_size) {
  io::SurfaceSoup soup;
  add_sphere(soup, Vec3(3, 0, 0), 4, 30);
  add_sphere(soup, Vec3(0, 0, 0), 12, 40);
  add_sphere(soup, Vec3(-6, 0, 0), 3, 30);
  const auto labels = label_surface(soup, 0.5);
  ASSERT_TRUE(labels.ok()) << labels.error().message;
  EXPECT_EQ(labels->parts, 3U);
  EXPECT_EQ(labels->open_edges, 0U);
  EXPECT_TRUE(labels->notes.empty());
  ASSERT_EQ(labels->volumes.size(), 4U);
  EXPECT_NEAR(labels->volumes[3] / ball(3), 1, 0.02);
  EXPECT_NEAR(labels->volumes[2] / ball(4), 1, 0.02);
  EXPECT_NEAR(labels->volumes[1] / (ball(12) - ball(4) - ball(3)), 1, 0.02);
  EXPECT_NEAR(share_of(labels->image, 3) / ball(3), 1, 0.03);
  EXPECT_NEAR(share_of(labels->image, 2) / ball(4), 1, 0.03);
  EXPECT_NEAR(share_of(labels->image, 1) / (ball(12) - ball(4) - ball(3)), 1, 0.03);
}

TEST(SurfaceLabels, holes_are_bridged) {
  io::SurfaceSoup soup;
  add_sphere(soup, Vec3(0, 0, 0), 10, 40);
  soup.triangles.erase(soup.triangles.begin() + 1000, soup.triangles.begin() + 1040);
  const auto labels = label_surface(soup, 0.5);
  ASSERT_TRUE(labels.ok()) << labels.error().message;
  EXPECT_GT(labels->open_edges, 0U);
  EXPECT_EQ(labels->notes.size(), 1U);
  EXPECT_NEAR(share_of(labels->image, 1) / ball(10), 1, 0.03);
}

TEST(SurfaceLabels, surfaces_that_pass_through_themselves_are_survived) {
  io::SurfaceSoup soup;
  add_sphere(soup, Vec3(0, 0, 0), 8, 40);
  for (Vec3& p : soup.points) {
    if (p.x() > 4) p.x() = 8 - p.x();  // a dent that comes out where it went in
  }
  const auto labels = label_surface(soup, 0.5);
  ASSERT_TRUE(labels.ok()) << labels.error().message;
  EXPECT_GT(share_of(labels->image, 1), 0.5 * ball(8));
}

/// The volume of a label is that of its voxels within what these can tell, and so is the one that is told.
void expect_volume(const image::SurfaceLabels& labels, std::int32_t label, double volume) {
  EXPECT_NEAR(share_of(labels.image, label) / volume, 1, 0.02) << label;
  EXPECT_NEAR(labels.volumes[labels.image.find_label(label)] / volume, 1, 0.01) << label;
}

/// What two balls share whose middles are `apart`.
double lens(double a, double b, double apart) {
  const double sum = a + b - apart;
  return kPi * sum * sum * (apart * apart + 2 * apart * (a + b) - 3 * (a - b) * (a - b)) / (12 * apart);
}

TEST(SurfaceLabels, a_part_that_passes_through_itself_has_the_volume_of_what_is_inside) {
  for (const double dent : {4.0, 5.0}) {  // one end of the ball goes in, and comes out of the other end inside out
    io::SurfaceSoup soup;
    add_sphere(soup, Vec3(0, 0, 0), 8, 60);
    for (Vec3& p : soup.points) {
      if (p.x() > dent) p.x() = dent - 6 * (p.x() - dent);
    }
    const auto labels = label_surface(soup, 0.4);
    ASSERT_TRUE(labels.ok()) << labels.error().message;
    ASSERT_EQ(labels->parts, 1U);
    EXPECT_NEAR(labels->volumes[1] / share_of(labels->image, 1), 1, 0.01) << dent;
  }
}

TEST(SurfaceLabels, overlapping_parts_have_the_volumes_of_their_regions) {
  for (const bool share_a_point : {false, true}) {
    for (const bool is_turned : {false, true}) {
      io::SurfaceSoup soup;
      add_sphere(soup, Vec3(0, 0, 0), 8, 40);
      const std::size_t first = soup.triangles.size();
      add_sphere(soup, share_a_point ? Vec3(0, 0, 2) : Vec3(5, 0, 3), 6, 40);  // the poles meet, or not
      for (std::size_t t = first; is_turned && t < soup.triangles.size(); ++t) {
        std::swap(soup.triangles[t][0], soup.triangles[t][1]);
      }
      const double common = share_a_point ? ball(6) : lens(8, 6, std::sqrt(34.0));
      const auto labels = label_surface(soup, 0.4);
      ASSERT_TRUE(labels.ok()) << labels.error().message;
      ASSERT_EQ(labels->parts, 2U);
      expect_volume(*labels, 1, ball(8) - common);
      expect_volume(*labels, 2, ball(6));
    }
  }
}

/// Boxes from a corner to another.
void add_box(io::SurfaceSoup& soup, const Vec3& lo, const Vec3& hi) {
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (unsigned c = 0; c < 8; ++c) {
    soup.points.emplace_back((c & 1U) != 0 ? hi.x() : lo.x(), (c & 2U) != 0 ? hi.y() : lo.y(),
                             (c & 4U) != 0 ? hi.z() : lo.z());
  }
  constexpr std::uint32_t kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& s : kSides) {
    soup.triangles.push_back({first + s[0], first + s[1], first + s[2]});
    soup.triangles.push_back({first + s[0], first + s[2], first + s[3]});
  }
}

TEST(SurfaceLabels, boxes_that_share_a_face_are_two_regions) {
  io::SurfaceSoup soup;
  add_box(soup, Vec3(0, 0, 0), Vec3(20, 20, 30));
  add_box(soup, Vec3(20, 0, 0), Vec3(30, 20, 30));
  for (const double voxel : {1.0, 0.7, 2.0}) {
    const auto labels = label_surface(soup, voxel);
    ASSERT_TRUE(labels.ok()) << labels.error().message;
    ASSERT_EQ(labels->parts, 2U);
    EXPECT_EQ(labels->open_edges, 0U);
    EXPECT_NEAR(labels->volumes[1], 12000, 1e-6);
    EXPECT_NEAR(labels->volumes[2], 6000, 1e-6);
    const Vec3& origin = labels->image.origin;
    for (const double x : {19.0, 21.0}) {
      const auto at = [&](double to, double from) {
        return static_cast<std::size_t>(std::lround((to - from) / voxel));
      };
      EXPECT_NE(labels->image.label(at(x, origin.x()), at(10, origin.y()), at(15, origin.z())), 0) << x;
    }
  }
}

TEST(SurfaceLabels, triangles_of_any_turn) {
  io::SurfaceSoup soup;
  add_sphere(soup, Vec3(0, 0, 0), 8, 30);
  for (auto& t : soup.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(share_of(label_surface(soup, 0.5)->image, 1) / ball(8), 1, 0.03);
}

TEST(SurfaceLabels, triangles_that_are_there_twice_count_once) {
  for (const bool is_double_sided : {false, true}) {
    io::SurfaceSoup soup;
    add_sphere(soup, Vec3(0, 0, 0), 10, 40);
    const std::vector<std::array<std::uint32_t, 3>> once = soup.triangles;
    for (const auto& [a, b, c] : once) {
      soup.triangles.push_back(is_double_sided ? std::array{b, a, c} : std::array{b, c, a});
    }
    const auto labels = label_surface(soup, 0.5);
    ASSERT_TRUE(labels.ok()) << labels.error().message;
    EXPECT_NEAR(share_of(labels->image, 1) / ball(10), 1, 0.02);
    EXPECT_NEAR(labels->volumes[1] / ball(10), 1, 0.02);
    ASSERT_EQ(labels->notes.size(), 1U);
    EXPECT_EQ(labels->notes[0].find(std::to_string(once.size()) + " triangles"), 0U) << labels->notes[0];
  }
}

TEST(SurfaceLabels, triangles_that_face_this_way_and_that_do_no_harm) {
  for (const bool has_hole : {false, true}) {
    io::SurfaceSoup soup;
    add_sphere(soup, Vec3(0, 0, 0), 10, 40);
    if (has_hole) soup.triangles.erase(soup.triangles.begin() + 1000, soup.triangles.begin() + 1002);
    std::uint32_t state = 1;
    for (auto& triangle : soup.triangles) {
      state = state * 1664525U + 1013904223U;
      if (state >> 31U != 0) std::swap(triangle[0], triangle[1]);
    }
    const auto labels = label_surface(soup, 0.5);
    ASSERT_TRUE(labels.ok()) << labels.error().message;
    EXPECT_NEAR(share_of(labels->image, 1) / ball(10), 1, 0.02);
    EXPECT_NEAR(labels->volumes[1] / ball(10), 1, 0.02);
    ASSERT_EQ(labels->notes.size(), has_hole ? 2U : 0U);
    if (has_hole) {
      EXPECT_NE(labels->notes[0].find("are turned"), std::string::npos) << labels->notes[0];
    }
  }
}

TEST(SurfaceLabels, a_sheet_encloses_nothing_and_is_said_to) {
  io::SurfaceSoup soup;
  add_sphere(soup, Vec3(0, 0, 0), 10, 40);
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  soup.points.insert(soup.points.end(), {Vec3(20, 0, 0), Vec3(30, 0, 0), Vec3(20, 10, 0)});
  soup.triangles.push_back({first, first + 1, first + 2});
  const auto labels = label_surface(soup, 0.5);
  ASSERT_TRUE(labels.ok()) << labels.error().message;
  EXPECT_EQ(labels->parts, 1U);
  ASSERT_EQ(labels->notes.size(), 1U);
  EXPECT_NE(labels->notes[0].find("what has them encloses nothing"), std::string::npos) << labels->notes[0];
}

TEST(SurfaceLabels, what_is_meshed_has_the_surfaces_volume) {
  io::SurfaceSoup soup;
  add_sphere(soup, Vec3(5, 5, 5), 12, 40);
  const auto labels = label_surface(soup, 0.8, 2);
  ASSERT_TRUE(labels.ok());
  image::MeshLabelsOptions options;
  options.size = 2.4;
  options.volumes = labels->volumes;
  const auto mesh = image::mesh_labels(labels->image, options);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_TRUE(validate(mesh->mesh, ValidateLevel::kGeometry).ok);
  EXPECT_NEAR(mesh->labels[0].volume / ball(12), 1, 0.01);
}

TEST(SurfaceLabels, says_what_is_wrong) {
  io::SurfaceSoup soup;
  EXPECT_NE(label_surface(soup, 1).error().message.find("has no triangles"), std::string::npos);
  add_sphere(soup, Vec3(0, 0, 0), 1, 10);
  EXPECT_NE(label_surface(soup, 0).error().message.find("larger size"), std::string::npos);
  EXPECT_NE(label_surface(soup, 1e-4).error().message.find("too many voxels"), std::string::npos);
  for (const double voxel : {10.0, 1e300}) {
    EXPECT_NE(label_surface(soup, voxel).error().message.find("encloses nothing"), std::string::npos);
  }
}

}  // namespace
}  // namespace incise::surface_labels_test
