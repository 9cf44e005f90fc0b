// SPDX-License-Identifier: Apache-2.0
#include "incise/image/image_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>

#include "image/image_bytes.h"
#include "io/gzip.h"

namespace incise::image_file_test {
namespace {

using namespace incise_test;
using image::ImageFile;
using image::read_labels_bytes;

const Storage& shorts() {
  return storages()[3];
}

/// The image of `test_values`, where `nifti_header` puts it.
void expect_test_image(const Result<ImageFile>& file) {
  ASSERT_TRUE(file.ok()) << file.error().message;
  const image::LabelImage& image = file->image;
  ASSERT_EQ(image.size, kTestSize);
  EXPECT_EQ(image.labels, (std::vector<std::int32_t>{0, 1, 2, 7}));
  const std::vector<int> values = test_values();
  for (std::size_t v = 0; v < values.size(); ++v) EXPECT_EQ(image.labels[image.voxels[v]], values[v]) << v;
  EXPECT_EQ(image.step[0], Vec3(-2, 0, 0));
  EXPECT_EQ(image.step[1], Vec3(0, 3, 0));
  EXPECT_EQ(image.step[2], Vec3(0, 0, 4));
  EXPECT_EQ(image.origin, Vec3(10, 20, 30));
}

io::SiblingLoader gives(const std::string& name, const std::string& bytes) {
  return [=](const std::string& asked) -> Result<std::string> {
    if (asked == name) return bytes;
    return Error{ErrorCode::kBadFile, asked + ": is not there; ask for " + name};
  };
}

std::string message_of(const std::string& bytes) {
  const Result<ImageFile> file = read_labels_bytes(bytes, "a.x");
  return file ? "(read without an error)" : file.error().message;
}

#define EXPECT_SAYS(bytes, part)                           \
  do {                                                     \
    const std::string said = message_of(bytes);            \
    EXPECT_EQ(said.find("a.x: "), 0U) << said;             \
    EXPECT_NE(said.find(part), std::string::npos) << said; \
    EXPECT_NE(said.find(';'), std::string::npos) << said;  \
  } while (false)

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ReadLabels, nifti_of_all_types_and_byte_orders) {
  for (const Storage& storage : storages()) {
    for (const bool is_big : {false, true}) {
      for (const int version : {1, 2}) {
        SCOPED_TRACE(std::string(storage.nrrd_type) + (is_big ? " big" : " little"));
        const std::string bytes = nifti(version, storage, is_big);
        expect_test_image(read_labels_bytes(bytes));
        expect_test_image(read_labels_bytes(gzipped(bytes)));
      }
    }
  }
}

TEST(ReadLabels, nrrd_of_all_types_and_byte_orders) {
  for (const Storage& storage : storages()) {
    for (const bool is_big : {false, true}) {
      SCOPED_TRACE(storage.nrrd_type);
      const std::string raw = raw_bytes(test_values(), storage, is_big);
      expect_test_image(read_labels_bytes(nrrd_header(storage, is_big) + raw));
      expect_test_image(read_labels_bytes(nrrd_header(storage, is_big, "gzip") + gzipped(raw)));
      expect_test_image(read_labels_bytes(nrrd_header(storage, is_big, "raw", "v.raw"), "a.nhdr", gives("v.raw", raw)));
      expect_test_image(
          read_labels_bytes(nrrd_header(storage, is_big, "gzip", "v.gz"), "a.nhdr", gives("v.gz", gzipped(raw))));
    }
  }
}

TEST(ReadLabels, meta_image_of_all_types_and_byte_orders) {
  for (const Storage& storage : storages()) {
    for (const bool is_big : {false, true}) {
      SCOPED_TRACE(storage.meta_type);
      const std::string raw = raw_bytes(test_values(), storage, is_big);
      const std::string packed = io::deflate_block(raw);
      expect_test_image(read_labels_bytes(meta_header(storage, is_big) + raw));
      expect_test_image(read_labels_bytes(meta_header(storage, is_big, true) + packed));
      expect_test_image(read_labels_bytes(meta_header(storage, is_big, false, "v.raw"), "a.mhd", gives("v.raw", raw)));
      expect_test_image(
          read_labels_bytes(meta_header(storage, is_big, true, "v.zraw"), "a.mhd", gives("v.zraw", packed)));
    }
  }
}

TEST(ReadLabels, nifti_pairs) {
  const std::string raw = raw_bytes(test_values(), shorts(), false);
  for (const int version : {1, 2}) {
    const std::string header = nifti_header(version, shorts(), false, true);
    expect_test_image(read_labels_bytes(header, "scans/a.hdr", gives("a.img", raw)));
    expect_test_image(read_labels_bytes(header, "scans/a.hdr", gives("a.img", gzipped(raw))));
  }
}

TEST(ReadLabels, a_pair_is_found_from_either_file) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "incise label pair";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.hdr", std::ios::binary) << nifti_header(1, shorts(), false, true);
  std::ofstream(folder / "a.img.gz", std::ios::binary) << gzipped(raw_bytes(test_values(), shorts(), false));
  expect_test_image(image::read_labels(folder / "a.hdr"));
  expect_test_image(image::read_labels(folder / "a.img.gz"));
  std::filesystem::remove_all(folder);
  EXPECT_FALSE(image::read_labels(folder / "a.hdr").ok());
}

TEST(ReadLabels, nifti_placed_by_a_quaternion) {
  std::string bytes = nifti(1, shorts(), false);
  put(bytes, 254, std::int16_t{0});
  put(bytes, 252, std::int16_t{1});
  const std::array<float, 4> pixdim = {-1, 2, 3, 4};
  for (std::size_t i = 0; i < 4; ++i) put(bytes, 76 + 4 * i, pixdim[i]);
  put(bytes, 260, 1.0F);  // c = 1: half a turn about y, so x and z change their signs; then left-handed
  const std::array<float, 3> offset = {10, 20, 30};
  for (std::size_t i = 0; i < 3; ++i) put(bytes, 268 + 4 * i, offset[i]);
  expect_test_image(read_labels_bytes(bytes));
  EXPECT_EQ(read_labels_bytes(bytes)->placed_by, "qform, RAS");
}

TEST(ReadLabels, nifti_in_metres) {
  std::string bytes = nifti(1, shorts(), false);
  bytes[123] = 1;
  EXPECT_EQ(read_labels_bytes(bytes)->image.step[0], Vec3(-2000, 0, 0));
}

TEST(ReadLabels, an_image_without_orientation_is_noted) {
  std::string bytes = nifti(1, shorts(), false);
  put(bytes, 254, std::int16_t{0});
  for (std::size_t i = 1; i < 4; ++i) put(bytes, 76 + 4 * i, 1.5F);
  const auto file = read_labels_bytes(bytes);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->image.spacing(), Vec3(1.5, 1.5, 1.5));
  EXPECT_EQ(file->notes.size(), 1U);
}

TEST(ReadLabels, the_scaling_of_the_header_holds) {
  std::string bytes = nifti(1, shorts(), false);
  put(bytes, 112, 2.0F);
  put(bytes, 116, 1.0F);
  const auto file = read_labels_bytes(bytes);
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->image.labels, (std::vector<std::int32_t>{1, 3, 5, 15}));
}

TEST(ReadLabels, nrrd_with_an_axis_of_one_layer) {
  std::string header = replaced(nrrd_header(shorts(), false), "dimension: 3", "dimension: 4");
  header = replaced(header, "sizes: 4", "sizes: 1 4");
  header = replaced(header, "directions: ", "directions: none ");
  expect_test_image(read_labels_bytes(header + raw_bytes(test_values(), shorts(), false)));
}

TEST(ReadLabels, nrrd_with_skips) {
  const std::string raw = raw_bytes(test_values(), shorts(), false);
  const std::string at_end = replaced(nrrd_header(shorts(), false, "raw", "v"), "my key:=x", "byte skip: -1");
  expect_test_image(read_labels_bytes(at_end, "a.nhdr", gives("v", "some header" + raw)));
  const std::string lines =
      replaced(nrrd_header(shorts(), false, "raw", "v"), "my key:=x", "line skip: 2\nbyte skip: 3");
  expect_test_image(read_labels_bytes(lines, "a.nhdr", gives("v", "one\ntwo\nxyz" + raw)));
}

/// The most memory that this process has had, bytes.
std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

TEST(ReadLabels, packed_voxels_are_never_held_unpacked) {
  constexpr std::size_t kSide = 300, kBytes = 4 * kSide * kSide * kSide;
  std::string bytes =
      "NRRD0004\ntype: unsigned int\ndimension: 3\nsizes: 300 300 300\nencoding: gzip\nendian: little\n"
      "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n\n";
  const std::string slice(kBytes / kSide, '\0');
  for (std::size_t k = 0; k < kSide; ++k) bytes += gzipped(slice);
  const std::size_t before = peak_memory();
  const auto file = read_labels_bytes(bytes);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->image.voxels.size(), kBytes / 4);
  EXPECT_LT(peak_memory() - before, kBytes);  // 2 bytes for each voxel of 4
}

TEST(ReadLabels, inrimage) {
  std::string header =
      "#INRIMAGE-4#{\nXDIM=4\nYDIM=3\nZDIM=2\nVDIM=1\nTYPE=unsigned fixed\nPIXSIZE=8 bits\nCPU=decm\n"
      "VX=2\nVY=3\nVZ=4\n";
  header += std::string(252 - header.size(), '\n') + "##}\n";
  const auto file = read_labels_bytes(header + raw_bytes(test_values(), storages()[0], false));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->image.spacing(), Vec3(2, 3, 4));
  EXPECT_EQ(file->image.label(3, 0, 0), 2);
}

TEST(ReadLabels, says_what_is_wrong) {
  const std::string good = nifti(1, shorts(), false);
  EXPECT_SAYS("", "not a label image");
  EXPECT_SAYS("MeshVersionFormatted 2", "not a label image");
  EXPECT_SAYS(good.substr(0, 340), "not a label image");
  EXPECT_SAYS(good.substr(0, good.size() - 1), "is it cut off?");
  EXPECT_SAYS(gzipped(good.substr(0, good.size() - 1)), "is it cut off?");
  EXPECT_SAYS(gzipped(good).substr(0, 60), "fetch the file again");
  std::string bytes = good;
  put(bytes, 42, std::int16_t{-3});
  EXPECT_SAYS(bytes, "axis of 0 voxels");
  bytes = good;
  put(bytes, 40, std::int16_t{4});
  put(bytes, 48, std::int16_t{20});
  EXPECT_SAYS(bytes, "20 volumes");
  bytes = good;
  put(bytes, 70, std::int16_t{32});
  EXPECT_SAYS(bytes, "NIfTI type 32");
  bytes = good;
  put(bytes, 280, 0.0F);
  EXPECT_SAYS(bytes, "mend the spacing");
  bytes = good;
  put(bytes, 284, std::numeric_limits<float>::quiet_NaN());
  EXPECT_SAYS(bytes, "mend the");
  EXPECT_SAYS(nrrd_header(shorts(), false, "bzip2"), "encoding 'bzip2'");
  EXPECT_SAYS(nrrd_header(shorts(), false, "raw", "v.raw"), "give both files");
  EXPECT_SAYS(replaced(nrrd_header(shorts(), false), "sizes: 4 3 2", "sizes: 4 3"), "sizes");
  for (const char* directions : {"(2,0,0) (0,-3,0) (0,0,4", "(2,0,0) (0,-3,0)", "(nan,0,0) (0,-3,0) (0,0,4)"}) {
    EXPECT_SAYS(replaced(nrrd_header(shorts(), false), "(2,0,0) (0,-3,0) (0,0,4)", directions), "space directions");
  }
  EXPECT_SAYS(replaced(nrrd_header(shorts(), false), "(-10,-20,30)", "(-10,nan,30)"), "space origin");
  const std::string spaced =
      replaced(nrrd_header(shorts(), false), "space directions: (2,0,0) (0,-3,0) (0,0,4)", "spacings: 2 3 4");
  EXPECT_SAYS(replaced(spaced, "2 3 4", "2 nan 4"), "spacings");
  EXPECT_SAYS(replaced(spaced, "2 3 4", "2 3"), "spacings");
  EXPECT_SAYS(replaced(meta_header(shorts(), false), "ElementDataFile", "Other"), "no ElementDataFile");
  EXPECT_SAYS(replaced(meta_header(shorts(), false), "MET_SHORT", "MET_RGB"), "type 'MET_RGB'");
}

TEST(ReadLabels, takes_no_memory_for_what_is_not_there) {
  std::string bytes = nifti(2, shorts(), false);
  for (std::size_t a = 1; a < 4; ++a) put(bytes, 16 + 8 * a, std::int64_t{2000});
  EXPECT_SAYS(bytes, "16000000000");
  EXPECT_SAYS(gzipped(bytes), "16000000000");
  for (std::size_t a = 1; a < 4; ++a) put(bytes, 16 + 8 * a, std::int64_t{1} << 20U);
  EXPECT_SAYS(bytes, "is the header damaged?");
}

TEST(ReadLabels, refuses_scans) {
  std::string bytes = nifti_header(1, storages()[8], false);
  for (const float value : {0.0F, 1.0F, 0.5F}) bytes.append(reinterpret_cast<const char*>(&value), 4);
  bytes.resize(352 + 24 * 4);
  EXPECT_SAYS(bytes, "0.5");
  bytes = nifti_header(1, shorts(), false);
  for (std::size_t a = 1; a < 4; ++a) put(bytes, 40 + 2 * a, std::int16_t{20});
  for (std::int16_t value = 0; value < 8000; ++value) bytes.append(reinterpret_cast<const char*>(&value), 2);
  EXPECT_SAYS(bytes, "more than 4096 values");
}

}  // namespace
}  // namespace incise::image_file_test
