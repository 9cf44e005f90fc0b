// SPDX-License-Identifier: Apache-2.0
#include "incise/image/mesh_labels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "image/made_images.h"
#include "image/organ_judge.h"
#include "incise/mesh/bounds.h"

namespace incise::mesh_labels_test {
namespace {

using namespace incise_test;
using image::LabelMesh;
using image::mesh_labels;
using image::MeshLabelsOptions;

MeshLabelsOptions of_size(double size) {
  MeshLabelsOptions options;
  options.size = size;
  return options;
}

/// What every mesh of a made image is asked for.
void expect_good(const MadeImage& made, const MeshLabelsOptions& options) {
  SCOPED_TRACE(made.name);
  const Result<LabelMesh> mesh = mesh_labels(to_image(made), options);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  const OrganFigures figures = judge(made, mesh->mesh);
  EXPECT_TRUE(figures.is_valid);
  EXPECT_GE(figures.quality.dihedral_min_deg, 8);
  EXPECT_LE(figures.quality.lr_max, 30);
  EXPECT_EQ(figures.nonmanifold_edges, 0U);
  EXPECT_EQ(figures.singleton_vertices, 0U);
  EXPECT_EQ(figures.surfaces, 1U);
  EXPECT_LE(figures.mean_error, 0.3);
  EXPECT_LE(figures.p99_error, 1.0);
  for (std::size_t l = 0; l < made.labels.size(); ++l) {
    EXPECT_NEAR(figures.volume_error[l], 0, made.is_wide[l] ? 0.02 : 0.05) << made.labels[l];
  }
}

TEST(MeshLabels, ball_in_ball) {
  expect_good(ball_in_ball(), of_size(4));
}

TEST(MeshLabels, three_labels_meet_in_lines) {
  expect_good(triple_junctions(), of_size(4));
}

TEST(MeshLabels, thin_vessels) {
  expect_good(vessel_tree(), of_size(4));
}

TEST(MeshLabels, noise) {
  expect_good(noisy_balls(), of_size(4));
}

TEST(MeshLabels, a_shell_of_two_voxels) {
  expect_good(thin_shell(18), of_size(4));
}

TEST(MeshLabels, a_block_keeps_its_edges_and_its_flat_sides) {
  for (const bool is_turned : {false, true}) {
    const MadeImage made = block(is_turned);
    expect_good(made, of_size(4));
    const OrganFigures figures = judge(made, mesh_labels(to_image(made), of_size(4))->mesh);
    EXPECT_LE(figures.mean_error, 0.12);
    EXPECT_LE(figures.p99_error, 0.6);
  }
}

TEST(MeshLabels, without_grading_and_maintenance) {
  MeshLabelsOptions options = of_size(4);
  options.grade = 0;
  options.improve = false;
  expect_good(ball_in_ball(), options);
}

TEST(MeshLabels, threads_do_not_change_bits) {
  MeshLabelsOptions options = of_size(5);
  const image::LabelImage image = to_image(triple_junctions());
  const Result<LabelMesh> one = mesh_labels(image, options);
  options.threads = 3;
  const Result<LabelMesh> three = mesh_labels(image, options);
  ASSERT_TRUE(one.ok() && three.ok());
  EXPECT_EQ(one->mesh.hash(), three->mesh.hash());
}

/// A small ball of label 7.
image::LabelImage small_ball() {
  MadeImage made;
  made.truth = [](const Vec3& p) { return (p - Vec3(11, 12, 13)).norm() < 8 ? 7 : 0; };
  made.extent = 25;
  made.labels = {7};
  return to_image(made);
}

TEST(MeshLabels, the_mesh_lies_where_the_scanner_saw_it) {
  image::LabelImage image = small_ball();
  image.step = {Vec3(0, -2, 0), Vec3(0, 0, 3), Vec3(4, 0, 0)};
  image.origin = Vec3(-100, 50, 7);
  const Result<LabelMesh> mesh = mesh_labels(image, of_size(8));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  const Box box = rest_bounds(mesh->mesh);
  const Vec3 middle = 0.5 * (box.lo + box.hi), extent = box.hi - box.lo;
  EXPECT_NEAR((middle - Vec3(-100 + 4 * 13, 50 - 2 * 11, 7 + 3 * 12)).norm(), 0, 2.5);
  EXPECT_NEAR(extent.x(), 64, 4);
  EXPECT_NEAR(extent.y(), 32, 4);
  EXPECT_NEAR(extent.z(), 48, 4);
  ASSERT_EQ(mesh->labels.size(), 1U);
  EXPECT_EQ(mesh->labels[0].label, 7);
  EXPECT_NEAR(mesh->labels[0].volume / mesh->labels[0].image_volume, 1, 0.02);
}

TEST(MeshLabels, mirrored_axes_give_positive_tets) {
  image::LabelImage image = small_ball();
  const Result<LabelMesh> straight = mesh_labels(image, of_size(4));
  image.step[0] = -image.step[0];
  const Result<LabelMesh> mirrored = mesh_labels(image, of_size(4));
  ASSERT_TRUE(straight.ok() && mirrored.ok());
  EXPECT_EQ(straight->labels[0].tets > 0, mirrored->labels[0].tets > 0);
  EXPECT_GT(mirrored->labels[0].volume, 0);
}

TEST(MeshLabels, an_organ_cut_by_the_edge_of_the_image_is_closed_there) {
  MadeImage made;
  made.truth = [](const Vec3& p) { return p.x() + p.y() < 25 ? 1 : 2; };
  made.extent = 25;
  made.labels = {1, 2};
  const Result<LabelMesh> mesh = mesh_labels(to_image(made), of_size(3));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  for (const image::LabelOutcome& label : mesh->labels) EXPECT_NEAR(label.volume / label.image_volume, 1, 0.02);
}

TEST(MeshLabels, islands_are_counted) {
  image::LabelImage image = small_ball();
  image.voxels[image.index(1, 1, 1)] = 1;
  const Result<LabelMesh> mesh = mesh_labels(image, of_size(4));
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->island_voxels, 1U);
}

TEST(MeshLabels, says_what_is_wrong) {
  const auto message = [](const image::LabelImage& image, const MeshLabelsOptions& options) {
    const Result<LabelMesh> mesh = mesh_labels(image, options);
    return mesh ? std::string("(meshed)") : mesh.error().message;
  };
  image::LabelImage image = small_ball();
  EXPECT_NE(message(image, of_size(0)).find("above 0 mm"), std::string::npos);
  for (const double size : {1e-6, 0.2}) {
    EXPECT_NE(message(image, of_size(size)).find("half a voxel"), std::string::npos) << size;
  }
  MeshLabelsOptions options = of_size(4);
  options.smooth = 0;
  EXPECT_NE(message(image, options).find("smoothing"), std::string::npos);
  EXPECT_NE(message(image, of_size(1e6)).find("a smaller size"), std::string::npos);
  image::keep_labels(image, {});
  EXPECT_NE(message(image, of_size(4)).find("choose other labels"), std::string::npos);
}

TEST(MeshLabels, what_the_image_is_not_fit_for_is_no_bad_argument) {
  image::LabelImage image = small_ball();
  EXPECT_EQ(mesh_labels(image, of_size(0)).error().code, ErrorCode::kBadArgument);
  EXPECT_EQ(mesh_labels(image, of_size(0.2)).error().code, ErrorCode::kBadFile);
  const Error huge = mesh_labels(image, of_size(1e300)).error();
  EXPECT_EQ(huge.code, ErrorCode::kBadFile);
  EXPECT_NE(huge.message.find("of 1e+300 mm"), std::string::npos) << huge.message;
  std::fill(image.voxels.begin(), image.voxels.end(), std::uint16_t{0});
  EXPECT_EQ(mesh_labels(image, of_size(2)).error().code, ErrorCode::kBadFile);
}

TEST(MeshLabels, a_line_of_voxels_is_said_to_be_too_thin) {
  image::LabelImage image = small_ball();
  std::fill(image.voxels.begin(), image.voxels.end(), std::uint16_t{0});
  for (std::size_t i = 0; i < image.size[0]; ++i) image.voxels[image.index(i, 12, 12)] = 1;
  const Result<LabelMesh> mesh = mesh_labels(image, of_size(1));
  ASSERT_FALSE(mesh.ok());
  EXPECT_NE(mesh.error().message.find("no label is thick enough"), std::string::npos) << mesh.error().message;
}

}  // namespace
}  // namespace incise::mesh_labels_test
