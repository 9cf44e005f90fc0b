// SPDX-License-Identifier: Apache-2.0
// The blade parser on any bytes: an error, or strokes that keep their promises.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "app/scene/blade_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto blade = incise::app::parse_blade_file(text, "fuzz.json");
  if (!blade.ok()) {
    if (blade.error().message.rfind("fuzz.json:", 0) != 0) std::abort();
    return 0;
  }
  for (const incise::app::BladeStroke& stroke : *blade) {
    if (!incise::check(stroke.stroke).ok()) std::abort();
  }
  return 0;
}
