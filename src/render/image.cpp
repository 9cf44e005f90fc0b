// SPDX-License-Identifier: Apache-2.0
// PNG by stb with zlib's packing. Images that are opaque all over are written with three bytes for each pixel.
#include "render/image.h"

#include <zlib.h>

#include <cstdlib>

namespace {

/// stb_image_write's own packing is a third larger; zlib's best is 4 % smaller, and takes a second for a window. What
/// it returns is freed with std::free.
unsigned char* pack(unsigned char* data, int size, int* packed_size, int /*level*/) {
  uLongf packed = compressBound(static_cast<uLong>(size));
  auto* bytes = static_cast<unsigned char*>(std::malloc(packed));
  if (bytes != nullptr && compress2(bytes, &packed, data, static_cast<uLong>(size), Z_DEFAULT_COMPRESSION) != Z_OK) {
    std::free(bytes);
    bytes = nullptr;
  }
  *packed_size = static_cast<int>(packed);
  return bytes;
}

}  // namespace

#define STBIW_ZLIB_COMPRESS pack
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "app/text/text_file.h"

namespace incise {
inline namespace v0 {
namespace render {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t{1} << 30U;
constexpr int kMostPixels = 16384;  // per side
constexpr int kChannels = 4;

struct FreePixels {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

bool is_whole(const Image& image) {
  return image.width > 0 && image.height > 0 &&
         image.pixels.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

void append(void* text, void* data, int size) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

/// Three bytes per pixel: smaller files. Empty where a pixel is translucent.
std::vector<std::uint8_t> without_opacity(const Image& image) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * image.pixels.size());
  for (const auto& [red, green, blue, opacity] : image.pixels) {
    if (opacity != 255) return {};
    bytes.insert(bytes.end(), {red, green, blue});
  }
  return bytes;
}

int difference(const Image::Pixel& a, const Image::Pixel& b, std::size_t channel) {
  return std::abs(int{a[channel]} - int{b[channel]});
}

bool have_same_size(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size();
}

}  // namespace

Result<std::string> png_bytes(const Image& image) {
  if (!is_whole(image)) return Error{ErrorCode::kBadArgument, "there are no pixels to write", {}};
  std::string text;
  const std::vector<std::uint8_t> opaque = without_opacity(image);
  const int channels = opaque.empty() ? kChannels : 3;
  const void* data = opaque.empty() ? static_cast<const void*>(image.pixels.data()) : opaque.data();
  if (stbi_write_png_to_func(append, &text, image.width, image.height, channels, data, channels * image.width) == 0) {
    return Error{ErrorCode::kOutOfMemory, "there is no memory to pack the picture", {}};
  }
  return text;
}

Status write_png(const Image& image, const fs::path& path) {
  const Result<std::string> bytes = png_bytes(image);
  if (!bytes.ok()) return Error{bytes.error().code, path.string() + ": " + bytes.error().message, {}};
  std::error_code code;
  const fs::path folder = path.parent_path();
  if (!folder.empty() && !fs::is_directory(folder, code)) {
    return Error{ErrorCode::kIo, path.string() + ": there is no folder " + folder.string() + "; make it first", {}};
  }
  return app::write_text_file(path, *bytes);
}

Result<Image> read_png(const fs::path& path) {
  const Result<std::string> text = app::read_text_file(path, kMostBytes);
  if (!text.ok()) return text.error();
  const auto* bytes = reinterpret_cast<const stbi_uc*>(text->data());
  const int size = static_cast<int>(text->size());
  Image image;
  int channels = 0;
  if (stbi_info_from_memory(bytes, size, &image.width, &image.height, &channels) == 0) {
    return Error{ErrorCode::kBadFile, path.string() + ": is no PNG", {}};
  }
  if (image.width > kMostPixels || image.height > kMostPixels) {
    return Error{ErrorCode::kBadFile, path.string() + ": has more than 16384 pixels on a side", {}};
  }
  const std::unique_ptr<stbi_uc, FreePixels> pixels(
      stbi_load_from_memory(bytes, size, &image.width, &image.height, &channels, kChannels));
  if (!pixels) return Error{ErrorCode::kBadFile, path.string() + ": the PNG is broken: " + stbi_failure_reason(), {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  std::memcpy(image.pixels.data(), pixels.get(), image.pixels.size() * sizeof(Image::Pixel));
  return image;
}

ImageDifference compare(const Image& a, const Image& b, int threshold) {
  if (!have_same_size(a, b)) return {255, 255, 1, false};
  ImageDifference all;
  std::size_t differing = 0, sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    int most = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const int one = difference(a.pixels[i], b.pixels[i], channel);
      sum += static_cast<std::size_t>(one);
      most = std::max(most, one);
    }
    all.greatest = std::max(all.greatest, most);
    differing += most > threshold ? 1 : 0;
  }
  const double count = std::max<double>(1, static_cast<double>(a.pixels.size()));
  all.mean = static_cast<double>(sum) / (3 * count);
  all.differing = static_cast<double>(differing) / count;
  return all;
}

Image difference_image(const Image& a, const Image& b) {
  if (!have_same_size(a, b)) return {};
  Image image{a.width, a.height, std::vector<Image::Pixel>(a.pixels.size(), {0, 0, 0, 255})};
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const int bright = std::min(255, 4 * difference(a.pixels[i], b.pixels[i], channel));
      image.pixels[i][channel] = static_cast<std::uint8_t>(bright);
    }
  }
  return image;
}

bool is_blank(const Image& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(),
                     [&](const Image::Pixel& pixel) { return pixel == image.pixels.front(); });
}

}  // namespace render
}  // namespace v0
}  // namespace incise
