// SPDX-License-Identifier: Apache-2.0
#include "render/image.h"

#include <gtest/gtest.h>

#include "support/folder.h"

using incise::ErrorCode;
using incise::render::Image;

namespace image_test {
namespace {

Image checks(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto level = static_cast<std::uint8_t>(16 * x + y);
      image.pixels.push_back({level, static_cast<std::uint8_t>(255 - level), 7, 255});
    }
  }
  return image;
}

}  // namespace

TEST(Image, png_reads_back_as_written) {
  const incise_test::Folder folder;
  const Image image = checks(13, 7);
  ASSERT_TRUE(write_png(image, folder / "a.png").ok());
  const auto back = incise::render::read_png(folder / "a.png");
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->width, 13);
  EXPECT_EQ(back->height, 7);
  EXPECT_EQ(back->pixels, image.pixels);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"}) << "nothing is left beside it";
}

TEST(Image, write_into_a_missing_folder_names_it) {
  const incise_test::Folder folder;
  const auto status = write_png(checks(2, 2), folder / "none/a.png");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kIo);
  EXPECT_NE(status.error().message.find("none/a.png"), std::string::npos);
  EXPECT_NE(status.error().message.find("make it first"), std::string::npos);
}

TEST(Image, write_refuses_what_is_no_whole_image) {
  const incise_test::Folder folder;
  EXPECT_EQ(write_png(Image{}, folder / "a.png").error().code, ErrorCode::kBadArgument);
  Image torn = checks(4, 4);
  torn.pixels.pop_back();
  EXPECT_EQ(write_png(torn, folder / "a.png").error().code, ErrorCode::kBadArgument);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Image, read_refuses_what_is_no_png) {
  const incise_test::Folder folder;
  for (const std::string text : {"", "hello", "\x89PNG\r\n\x1a\n"}) {
    const auto image = incise::render::read_png(folder.write("a.png", text));
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(image.error().code, ErrorCode::kBadFile);
    EXPECT_NE(image.error().message.find("a.png"), std::string::npos);
  }
  EXPECT_EQ(incise::render::read_png(folder / "none.png").error().code, ErrorCode::kBadFile);
}

TEST(Image, read_refuses_a_png_that_ends_early) {
  const incise_test::Folder folder;
  ASSERT_TRUE(write_png(checks(13, 7), folder / "a.png").ok());
  std::string text = incise_test::read(folder / "a.png");
  text.resize(text.size() / 2);
  EXPECT_EQ(incise::render::read_png(folder.write("b.png", text)).error().code, ErrorCode::kBadFile);
}

TEST(Image, compare_counts_what_differs) {
  const Image a = checks(10, 10);
  Image b = a;
  EXPECT_EQ(compare(a, b).greatest, 0);
  b.pixels[5][2] = 107;
  const auto one = compare(a, b, 16);
  EXPECT_EQ(one.greatest, 100);
  EXPECT_DOUBLE_EQ(one.differing, 0.01);
  EXPECT_DOUBLE_EQ(one.mean, 100.0 / 300);
  EXPECT_DOUBLE_EQ(compare(a, b, 100).differing, 0);
  EXPECT_EQ(difference_image(a, b).pixels[5], (Image::Pixel{0, 0, 255, 255}));
  EXPECT_FALSE(compare(a, checks(5, 5)).is_same_size);
}

TEST(Image, blank_has_one_colour) {
  Image image{3, 3, std::vector<Image::Pixel>(9, {1, 2, 3, 255})};
  EXPECT_TRUE(is_blank(image));
  image.pixels[8][0] = 9;
  EXPECT_FALSE(is_blank(image));
  EXPECT_TRUE(is_blank(Image{}));
}

}  // namespace image_test
