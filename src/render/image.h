// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace render {

/// A picture of `width × height` pixels, row by row from the upper left; red, green, blue (sRGB) and opacity.
struct Image {
  using Pixel = std::array<std::uint8_t, 4>;
  int width = 0, height = 0;
  std::vector<Pixel> pixels;

  [[nodiscard]] const Pixel& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// The bytes of a PNG. Errors: kBadArgument for an image whose size and pixels do not agree or that has none.
/// Cost: about 100 ns per pixel.
[[nodiscard]] Result<std::string> png_bytes(const Image& image);

/// Writes a PNG beside its place and renames it. Errors: kBadArgument for an image whose size and pixels do not agree
/// or that has none; kIo, naming the file. Cost: about 100 ns per pixel.
[[nodiscard]] Status write_png(const Image& image, const std::filesystem::path& path);

/// Reads a PNG of up to 16384 × 16384 pixels. Errors: kBadFile, naming the file. Cost: about 30 ns per pixel.
[[nodiscard]] Result<Image> read_png(const std::filesystem::path& path);

/// How much two images differ. Differences are those of red, green and blue, in [0, 255].
struct ImageDifference {
  double mean = 0;           ///< absolute, over all pixels and channels
  int greatest = 0;          ///< of any channel of any pixel
  double differing = 0;      ///< share of pixels with a channel that differs by more than the threshold, in [0, 1]
  bool is_same_size = true;  ///< where false the rest says: everything differs
};

/// Compares two images, opacity aside. Cost: O(pixels).
[[nodiscard]] ImageDifference compare(const Image& a, const Image& b, int threshold = 16);

/// The differences as an image: black where there are none, four times as bright as they are. Empty for images of
/// different sizes.
[[nodiscard]] Image difference_image(const Image& a, const Image& b);

/// Whether all of it has one colour, as a drawing that failed has; true for no pixels at all.
[[nodiscard]] bool is_blank(const Image& image);

}  // namespace render
}  // namespace v0
}  // namespace incise
