// SPDX-License-Identifier: Apache-2.0
// Any bytes go into the mesh and surface readers; what reads is checked, written and read back.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "incise/io/mesh_file.h"
#include "incise/io/surface_file.h"
#include "incise/mesh/defects.h"

namespace {

using namespace incise;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_mesh(const io::MeshFile& file) {
  const TetSoup& soup = file.data.soup;
  for (const auto& tet : soup.tets) {
    for (const std::uint32_t v : tet) require(v < soup.points.size());
  }
  for (const Vec3& p : soup.points) require(p.allFinite());
  (void)find_defects(soup);
  for (const char* extension : {".mesh", ".msh", ".vtk", ".vtu"}) {
    const Result<std::string> bytes = io::write_mesh_bytes(extension, file.data);
    require(bytes.ok());
    const Result<io::MeshFile> back = io::read_mesh_bytes(*bytes);
    require(back.ok() && back->data.soup.points == soup.points && back->data.soup.tets == soup.tets);
  }
}

}  // namespace

// The bytes 00 00 2D 2D 00 part the two files of a pair.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  io::ReadLimits limits;
  limits.max_inflated_bytes = std::uint64_t{1} << 24U;
  const std::size_t gap = all.find("\0\0--\0", 0, 5);
  const std::string second(gap == std::string_view::npos ? std::string_view() : all.substr(gap + 5));
  const io::SiblingLoader sibling = [&second](const std::string&) -> Result<std::string> { return second; };
  const Result<io::MeshFile> file = io::read_mesh_bytes(all.substr(0, gap), "fuzz", sibling, limits);
  if (file) {
    check_mesh(*file);
  } else {
    require(file.error().message.find(';') != std::string::npos);
  }
  const Result<io::SurfaceSoup> surface = io::read_surface_bytes(all, "fuzz", limits);
  if (surface) {
    for (const auto& triangle : surface->triangles) {
      for (const std::uint32_t v : triangle) require(v < surface->points.size());
    }
  }
  return 0;
}
