// SPDX-License-Identifier: Apache-2.0
// Looks at pictures for scripts. usage: incise_picture_check A.png [B.png]
// Exit 0 where A is a picture of something and, with B, differs from it by more than a pointer does; else 1.
#include <cstdio>

#include "render/image.h"

namespace {

using namespace incise;

constexpr double kLeastShare = 2e-4;  // of pixels, that a change of the body changes

int say(const char* what, const char* file, int code) {
  std::printf("%s: %s\n", file, what);
  return code;
}

int check(const char* file, render::Image& image) {
  Result<render::Image> read = render::read_png(file);
  if (!read.ok()) return say(read.error().message.c_str(), file, 1);
  image = std::move(read).value();
  return render::is_blank(image) ? say("is blank", file, 1) : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) return say("usage: incise_picture_check A.png [B.png]", "", 2);
  render::Image a, b;
  if (const int code = check(argv[1], a); code != 0) return code;
  if (argc == 2) return say("is a picture", argv[1], 0);
  if (const int code = check(argv[2], b); code != 0) return code;
  const render::ImageDifference difference = render::compare(a, b);
  std::printf("%g of the pixels differ\n", difference.differing);
  return difference.differing > kLeastShare ? 0 : say("is the same picture", argv[2], 1);
}
