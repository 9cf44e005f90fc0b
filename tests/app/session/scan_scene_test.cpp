// SPDX-License-Identifier: Apache-2.0
// From a scan to a session, as far as a window is not needed.
#include "app/session/scan_scene.h"

#include <gtest/gtest.h>

#include <string>

#include "app/session/session.h"
#include "incise/io/mesh_file.h"
#include "incise/sim/tissue.h"
#include "support/folder.h"

namespace incise::scan_scene_test {
namespace {

/// A MetaImage of 24³ voxels of 1 mm: a ball of label 1 with a ball of label 2 in it.
std::string balls() {
  std::string bytes =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nElementSpacing = 1 1 1\n"
      "DimSize = 24 24 24\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
  for (int v = 0; v < 24 * 24 * 24; ++v) {
    const double x = v % 24 - 11.6, y = v / 24 % 24 - 11.7, z = v / 576 - 11.4;
    const double r2 = x * x + y * y + z * z;
    bytes += r2 < 16 ? '\2' : (r2 < 81 ? '\1' : '\0');
  }
  return bytes;
}

TEST(ScanScene, is_a_body_of_tissues_by_the_names_of_its_labels) {
  const incise_test::Folder folder;
  app::OrganJob job;
  job.input = folder.write("balls.mha", balls());
  job.names = folder.write("names.txt", "1 right kidney\n2 something\n");
  job.size = 4;
  job.layers = {{"fat", 3}};
  const std::string mesh = folder / "kept.msh";
  const auto made = app::make_scan_scene(job, mesh, Vec3::UnitY());
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_EQ(made->scene.options.body.length_unit, 1e-3);
  EXPECT_LT(made->scene.options.body.gravity.y(), -9);
  std::string notes;
  for (const std::string& note : made->notes) notes += note + "\n";
  EXPECT_NE(notes.find("region 1 (right kidney) is made of kidney"), std::string::npos) << notes;
  EXPECT_NE(notes.find("region 3 (fat) is made of fat"), std::string::npos) << notes;
  EXPECT_NE(notes.find("region 2 (something) is made of soft tissue"), std::string::npos) << notes;
  const auto file = io::read_mesh(mesh);
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->data.region_names.at(3), "fat");
  const auto session = app::Session::open(made->scene, {});
  ASSERT_TRUE(session.ok()) << session.error().message;
  const Materials& materials = session->scene().options.materials;
  EXPECT_EQ(materials.of(1).young, find_tissue("kidney")->material.young);
  EXPECT_EQ(materials.of(3).toughness, find_tissue("fat")->material.toughness);
  EXPECT_EQ(materials.of(2).young, materials.fallback.young);
}

TEST(ScanScene, says_what_is_wrong_with_the_scan) {
  const incise_test::Folder folder;
  app::OrganJob job;
  job.input = folder / "none.nii.gz";
  job.size = 4;
  EXPECT_FALSE(app::make_scan_scene(job, folder / "kept.msh", Vec3::UnitZ()).ok());
  job.input = folder.write("balls.mha", balls());
  job.layers = {{"skin", 0.2}};
  const auto thin = app::make_scan_scene(job, folder / "kept.msh", Vec3::UnitZ());
  ASSERT_FALSE(thin.ok());
  EXPECT_NE(thin.error().message.find("layer skin of 0.2 mm is thinner"), std::string::npos) << thin.error().message;
}

}  // namespace
}  // namespace incise::scan_scene_test
