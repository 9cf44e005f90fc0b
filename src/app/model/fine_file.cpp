// SPDX-License-Identifier: Apache-2.0
// What is drawn, skin and walls together, is written as one list of triangles; `.glb` keeps the two apart.
#include "app/model/fine_file.h"

#include "app/model/convert.h"
#include "incise/io/surface_file.h"

namespace incise {
inline namespace v0 {
namespace app {

Result<FineSurface> read_fine_surface(const std::filesystem::path& path) {
  const Result<io::SurfaceSoup> surface = io::read_surface(path);
  if (!surface.ok()) return surface.error();
  return io::to_fine_surface(*surface);
}

std::string drawn_file_problem(const std::filesystem::path& path) {
  if (path.extension() == ".glb" || is_surface_extension(path)) return {};
  return path.string() + ": unknown extension; a drawn surface is written as .glb " + kSurfaceExtensions;
}

Status write_drawn(const std::filesystem::path& path, const GltfBody& body) {
  if (path.extension() == ".glb") return write_glb(path, body);
  io::SurfaceSoup soup;
  soup.points = body.positions;
  soup.triangles = body.surface.skin;
  soup.triangles.insert(soup.triangles.end(), body.surface.walls.begin(), body.surface.walls.end());
  for (const DrawnPoint& point : body.surface.points) soup.texture.push_back(point.texture);
  soup.texture_triangles = soup.triangles;
  soup.normals = body.normals;
  soup.normal_triangles = soup.triangles;
  return io::write_surface(path, soup);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
