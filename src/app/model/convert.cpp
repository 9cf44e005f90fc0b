// SPDX-License-Identifier: Apache-2.0
// A file is first read as a mesh; only where it is none, and a surface is asked for, as a surface.
#include "app/model/convert.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "app/model/extension.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_loader.h"
#include "incise/io/surface_file.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kSurfaces = {".obj", ".stl", ".ply", ".off"};

Result<Conversion> write_surface(const fs::path& out, const io::SurfaceSoup& surface, Conversion done) {
  if (const Status status = io::write_surface(out, surface); !status.ok()) return status.error();
  done.files = {out};
  done.vertices = surface.points.size();
  done.triangles = surface.triangles.size();
  return done;
}

Result<Conversion> convert_surface(const fs::path& in, const fs::path& out) {
  Result<io::SurfaceSoup> surface = io::read_surface(in);
  if (!surface.ok()) return surface.error();
  return write_surface(out, *surface, {});
}

Result<Conversion> mesh_to_surface(io::MeshFile file, const fs::path& in, const fs::path& out) {
  Result<io::LoadedMesh> loaded = io::build_mesh(std::move(file), in);
  if (!loaded.ok()) return loaded.error();
  Conversion done;
  done.notes = loaded->source.notes;
  return write_surface(out, io::to_surface(loaded->mesh), std::move(done));
}

}  // namespace

bool is_mesh_extension(const fs::path& path) {
  const std::vector<std::string> meshes = io::written_extensions();
  return std::find(meshes.begin(), meshes.end(), extension_of(path)) != meshes.end();
}

std::string mesh_extensions() {
  std::string text;
  for (const std::string& extension : io::written_extensions()) text += (text.empty() ? "" : " ") + extension;
  return text + ", each also with .gz";
}

bool is_surface_extension(const fs::path& path) {
  return std::find(kSurfaces.begin(), kSurfaces.end(), extension_of(path)) != kSurfaces.end();
}

Result<Conversion> convert(const fs::path& in, const fs::path& out, const io::WriteOptions& options) {
  const bool wants_surface = options.extension.empty() && is_surface_extension(out);
  if (!wants_surface && options.extension.empty() && !is_mesh_extension(out)) {
    return Error{
        ErrorCode::kBadArgument,
        out.string() + ": unknown extension; use " + mesh_extensions() + ", or for surfaces " + kSurfaceExtensions,
        {}};
  }
  Result<io::MeshFile> file = io::read_mesh(in);
  if (!file.ok()) return wants_surface && is_surface_extension(in) ? convert_surface(in, out) : file.error();
  if (wants_surface) return mesh_to_surface(std::move(file).value(), in, out);
  io::drop_mid_nodes(*file);
  const io::MeshData& data = file->data;
  if (const Status status = io::write_mesh(out, data, options); !status.ok()) return status.error();
  return Conversion{file->notes, io::mesh_files(out, options), data.soup.points.size(), data.soup.tets.size(),
                    data.triangles.size()};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
