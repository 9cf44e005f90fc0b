// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "incise/geom/vec.h"
#include "io/text.h"

namespace incise {
inline namespace v0 {
namespace io {

/// What is of use in a PLY file.
struct PlyContent {
  std::string format;  ///< "ascii", "binary_little_endian" or "binary_big_endian"
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< faces; polygons as fans
  std::vector<std::array<std::uint32_t, 4>> tets;       ///< lists of four of an element `3d_element`, `tet`, ...
  bool has_tets = false;
};

/// Read a PLY file, ASCII or binary, with any elements and properties. Sets `error` on failure.
bool read_ply(std::string_view bytes, const std::string& name, Error& error, PlyContent& out);

}  // namespace io
}  // namespace v0
}  // namespace incise
