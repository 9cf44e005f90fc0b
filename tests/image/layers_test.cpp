// SPDX-License-Identifier: Apache-2.0
#include "incise/image/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "image/made_images.h"
#include "image/organ_judge.h"
#include "incise/geom/triangle_tree.h"
#include "incise/image/mesh_labels.h"
#include "incise/io/mesh_export.h"
#include "support/campaign.h"

namespace incise::layers_test {
namespace {

using namespace incise_test;
using image::grow_layers;
using image::LabelImage;
using image::LayeredImage;
using image::LayerOptions;
using image::mesh_labels;

const Vec3 kMiddle(28.3, 27.8, 28.1);
constexpr double kRadius = 20;

LayerOptions layers_of(std::vector<image::Layer> layers, double size) {
  LayerOptions options;
  options.layers = std::move(layers);
  options.size = size;
  return options;
}

/// A ball of label 7 whose upper half is of label 8, with layers as they should come out: labels 9, 10, and so on.
MadeImage layered_ball(const std::vector<double>& thickness) {
  MadeImage made;
  made.name = "layered ball";
  made.extent = 56;
  made.truth = [thickness](const Vec3& p) {
    double depth = kRadius - (p - kMiddle).norm();
    if (depth < 0) return 0;
    for (std::size_t l = 0; l < thickness.size(); ++l) {
      if (depth < thickness[l]) return static_cast<std::int32_t>(9 + l);
      depth -= thickness[l];
    }
    return p.z() > kMiddle.z() ? 8 : 7;
  };
  for (std::size_t l = 0; l < thickness.size() + 2; ++l) {
    made.labels.push_back(static_cast<std::int32_t>(7 + l));
    made.is_wide.push_back(false);
  }
  return made;
}

/// Points of the faces between two regions.
std::vector<Vec3> points_between(const TetMesh& mesh, std::int32_t a, std::int32_t b) {
  std::vector<Vec3> points;
  mesh.for_each_tet([&](TetId tet) {
    for (unsigned s = 0; s < 4; ++s) {
      const Side side(tet, s);
      const Link link = mesh.link(side);
      if (mesh.region(tet) != a || link.is_boundary() || mesh.region(link.side().tet()) != b) continue;
      for (const VertexId v : mesh.vertices(side)) points.push_back(mesh.rest(v));
    }
  });
  return points;
}

/// Mean difference between a wanted depth and the distance to the skin that the mesh has.
double thickness_error(const TetMesh& mesh, const std::vector<Vec3>& inner, double depth) {
  const io::SurfaceSoup skin = io::to_surface(mesh);
  const TriangleTree tree(skin.points, skin.triangles);
  double sum = 0;
  for (const Vec3& p : inner) sum += std::abs(std::sqrt(tree.closest(p).distance2) - depth);
  return sum / static_cast<double>(inner.size());
}

/// The labels that lie at the surface.
std::set<std::int32_t> labels_outside(const TetMesh& mesh) {
  std::set<std::int32_t> labels;
  mesh.for_each_tet([&](TetId tet) {
    for (const Link link : mesh.links(tet)) {
      if (link.is_boundary()) labels.insert(mesh.region(tet));
    }
  });
  return labels;
}

bool is_near(double value, const std::vector<double>& places, double error) {
  return std::any_of(places.begin(), places.end(), [&](double p) { return std::abs(value - p) < error; });
}

TEST(Layers, voxels_of_a_ball_are_told_by_their_exact_depth) {
  const MadeImage made = layered_ball({3, 6});
  const auto layered = grow_layers(to_image(layered_ball({})), layers_of({{"skin", 3}, {"fat", 6}}, 4));
  ASSERT_TRUE(layered.ok()) << layered.error().message;
  EXPECT_EQ(layered->labels, (std::vector<std::int32_t>{9, 10}));
  EXPECT_EQ(layered->finer, (std::array<std::size_t, 3>{1, 1, 1}));
  EXPECT_EQ(layered->cut_off, 0U);
  EXPECT_TRUE(layered->swallowed.empty());
  const LabelImage& out = layered->image;
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < out.voxels.size(); ++v) {
    const Vec3 p(static_cast<double>(v % 56), static_cast<double>(v / 56 % 56), static_cast<double>(v / 3136));
    const double r = (p - kMiddle).norm();
    const std::int32_t label = out.labels[out.voxels[v]];
    if (label == made.truth(p)) continue;
    ++wrong;
    ASSERT_TRUE(is_near(r, {kRadius - 3, kRadius - 9}, 0.4)) << label << " at radius " << r;
  }
  EXPECT_LE(wrong, 600U);  // of the 8000 within half a voxel of where layers end
}

/// What a mesh of the ball with skin and fat of 6 mm is asked for.
void expect_thickness(double skin, double size) {
  SCOPED_TRACE(skin);
  const MadeImage made = layered_ball({skin, 6});
  const auto layered = grow_layers(to_image(layered_ball({})), layers_of({{"skin", skin}, {"fat", 6}}, size));
  ASSERT_TRUE(layered.ok()) << layered.error().message;
  image::MeshLabelsOptions options;
  options.size = size;
  options.smooth = layered->smooth;
  const auto mesh = mesh_labels(layered->image, options);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  const OrganFigures figures = judge(made, mesh->mesh);
  EXPECT_EQ(labels_outside(mesh->mesh), (std::set<std::int32_t>{9}));
  EXPECT_TRUE(points_between(mesh->mesh, 9, 7).empty());
  EXPECT_LE(thickness_error(mesh->mesh, points_between(mesh->mesh, 9, 10), skin), 0.2);
  EXPECT_LE(thickness_error(mesh->mesh, points_between(mesh->mesh, 10, 7), skin + 6), 0.2);
  EXPECT_LE(figures.mean_error, 0.2);
  EXPECT_EQ(figures.nonmanifold_edges, 0U);
  EXPECT_EQ(figures.singleton_vertices, 0U);
  EXPECT_TRUE(figures.is_valid);
  EXPECT_GE(figures.quality.dihedral_min_deg, 8);
  EXPECT_LE(figures.quality.lr_max, 30);
}

TEST(Layers, of_three_voxels_have_their_thickness_in_the_mesh) {
  if (!test::is_whole_campaign())
    GTEST_SKIP() << "thinner ones are meshed by day; at night (INCISE_CAMPAIGNS_ALL=1) these, too";
  expect_thickness(3, 5);
}

TEST(Layers, thinner_than_two_voxels_have_their_thickness_in_the_mesh) {
  expect_thickness(1.5, 5);
}

TEST(Layers, thinner_than_the_finest_tets_are_refused) {
  const LabelImage image = to_image(layered_ball({}));
  const auto thin = grow_layers(image, layers_of({{"fat", 8}, {"skin", 1.4}}, 5));
  ASSERT_FALSE(thin.ok());
  EXPECT_EQ(
      thin.error().message,
      "layer skin of 1.4 mm is thinner than 1.2 times the finest tets, 1.25 mm (5 mm halved 2 times); give a size "
      "of 4.667 mm at most, more halvings, or a thicker layer");
  EXPECT_TRUE(grow_layers(image, layers_of({{"fat", 8}, {"skin", 1.4}}, 4.6)).ok());
}

TEST(Layers, deeper_than_the_body_are_refused) {
  const LabelImage image = to_image(layered_ball({}));
  const auto deep = grow_layers(image, layers_of({{"skin", 3}, {"fat", 18}, {"muscle", 4}}, 5));
  ASSERT_FALSE(deep.ok());
  EXPECT_NE(deep.error().message.find("layer muscle of 4 mm lies deeper than the body is thick"), std::string::npos);
  EXPECT_FALSE(grow_layers(image, layers_of({{"skin", 0}}, 5)).ok());
  EXPECT_FALSE(grow_layers(image, layers_of({}, 5)).ok());
}

TEST(Layers, may_take_from_some_labels_alone) {
  LayerOptions options = layers_of({{"skin", 3}, {"fat", 4}}, 5);
  options.within = {7};
  const LabelImage image = to_image(layered_ball({}));
  const auto layered = grow_layers(image, options);
  ASSERT_TRUE(layered.ok());
  const auto before = image.count_voxels(), after = layered->image.count_voxels();
  EXPECT_EQ(after[image.find_label(8)], before[image.find_label(8)]);
  EXPECT_EQ(after[image.find_label(7)] + layered->voxels[0] + layered->voxels[1], before[image.find_label(7)]);
}

TEST(Layers, swallow_a_label_and_say_so) {
  MadeImage made = layered_ball({});
  const Truth plain = made.truth;
  made.truth = [plain](const Vec3& p) {
    const bool is_mark = (p - kMiddle - Vec3(0, 0, 17.5)).norm() < 2;
    return is_mark ? 9 : plain(p);
  };
  made.labels = {7, 8, 9};
  const auto layered = grow_layers(to_image(made), layers_of({{"fat", 6}}, 5));
  ASSERT_TRUE(layered.ok());
  EXPECT_EQ(layered->swallowed, (std::vector<std::int32_t>{9}));
  EXPECT_EQ(layered->labels, (std::vector<std::int32_t>{10}));
}

/// The labels along a line of voxels through the middle.
std::vector<std::int32_t> line(const LabelImage& image, std::size_t axis) {
  std::vector<std::int32_t> labels;
  std::array<std::size_t, 3> at = {image.size[0] / 2, image.size[1] / 2, image.size[2] / 2};
  for (at[axis] = 0; at[axis] < image.size[axis]; ++at[axis]) labels.push_back(image.label(at[0], at[1], at[2]));
  return labels;
}

/// A bar along k with a cavity in its middle; it reaches the image's ends.
LabelImage bar_with_cavity() {
  LabelImage image;
  image.size = {24, 24, 24};
  image.labels = {0, 1};
  for (std::size_t v = 0; v < 24 * 24 * 24; ++v) {
    const double x = static_cast<double>(v % 24) - 11.5, y = static_cast<double>(v / 24 % 24) - 11.5;
    const double z = static_cast<double>(v / 576) - 11.5;
    const bool is_cavity = Vec3(x, y, z).norm() < 3;
    image.voxels.push_back(std::abs(x) < 9 && std::abs(y) < 9 && !is_cavity ? 1 : 0);
  }
  return image;
}

TEST(Layers, do_not_grow_around_cavities_nor_where_the_image_cuts_the_body_off) {
  const auto layered = grow_layers(bar_with_cavity(), layers_of({{"skin", 3}}, 4));
  ASSERT_TRUE(layered.ok()) << layered.error().message;
  EXPECT_EQ(layered->cut_off, 2U * 18 * 18);
  const std::vector<std::int32_t> along = line(layered->image, 2), across = line(layered->image, 0);
  EXPECT_EQ(std::count(along.begin(), along.end(), 2), 0);
  EXPECT_EQ(across,
            (std::vector<std::int32_t>{0, 0, 0, 2, 2, 2, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 0, 0, 0}));
}

TEST(Layers, thick_slices_are_made_finer_along_their_axis) {
  LabelImage image = bar_with_cavity();
  image.step[1] *= 4;
  const auto layered = grow_layers(image, layers_of({{"skin", 2}}, 4));
  ASSERT_TRUE(layered.ok()) << layered.error().message;
  EXPECT_EQ(layered->finer, (std::array<std::size_t, 3>{1, 4, 1}));
  EXPECT_EQ(layered->image.size, (std::array<std::size_t, 3>{24, 96, 24}));
  EXPECT_NEAR(layered->image.origin.y(), image.origin.y() - 1.5, 1e-12);
  const std::vector<std::int32_t> across = line(layered->image, 1);
  EXPECT_EQ(std::count(across.begin(), across.end(), 2), 4);
  EXPECT_EQ(std::count(across.begin(), across.end(), 1), 72 - 4 - 24);
}

TEST(Layers, threads_do_not_change_bits) {
  LayerOptions options = layers_of({{"skin", 1.5}, {"fat", 4}}, 5);
  const LabelImage image = to_image(layered_ball({}));
  const auto one = grow_layers(image, options);
  options.threads = 3;
  const auto three = grow_layers(image, options);
  ASSERT_TRUE(one.ok() && three.ok());
  EXPECT_EQ(one->image.voxels, three->image.voxels);
}

}  // namespace
}  // namespace incise::layers_test
