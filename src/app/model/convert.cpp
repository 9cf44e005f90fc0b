// SPDX-License-Identifier: Apache-2.0
// A file is first read as a mesh; only where it is none, and a surface is asked for, as a surface.
#include "app/model/convert.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "app/model/extension.h"
#include "incise/io/load_file.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_loader.h"
#include "incise/io/surface_file.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kSurfaces = {".obj", ".stl", ".ply", ".off"};

bool is_stdin(const fs::path& in) {
  return in == "/dev/stdin";
}

/// Whether a file that is no mesh may be a surface.
bool may_be_surface(const fs::path& in, const Error& why_no_mesh) {
  return is_surface_extension(in) || (is_stdin(in) && why_no_mesh.code == ErrorCode::kUnsupported);
}

Result<BoundaryOf> boundary_of(io::MeshFile file, const fs::path& in) {
  Result<io::LoadedMesh> loaded = io::build_mesh(std::move(file), in);
  if (!loaded.ok()) return loaded.error();
  return BoundaryOf{io::to_surface(loaded->mesh), loaded->source.notes};
}

Result<Conversion> convert_to_surface(const fs::path& in, const fs::path& out,
                                      const std::function<void()>& before_writing) {
  const Result<BoundaryOf> boundary = read_boundary(in);
  if (!boundary.ok()) return boundary.error();
  if (before_writing) before_writing();
  if (const Status status = io::write_surface(out, boundary->surface); !status.ok()) return status.error();
  return Conversion{boundary->notes, {out}, boundary->surface.points.size(), 0, boundary->surface.triangles.size()};
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

Result<BoundaryOf> read_boundary(const fs::path& in) {
  Result<std::string> bytes = std::string();
  if (is_stdin(in)) bytes = io::load_mesh_or_surface(in);  // it comes once
  if (!bytes.ok()) return bytes.error();
  Result<io::MeshFile> file = is_stdin(in) ? io::read_mesh_bytes(*bytes, in.string()) : io::read_mesh(in);
  if (file.ok()) return boundary_of(std::move(file).value(), in);
  if (!may_be_surface(in, file.error())) return file.error();
  Result<io::SurfaceSoup> surface = is_stdin(in) ? io::read_surface_bytes(*bytes, in.string()) : io::read_surface(in);
  if (!surface.ok()) return surface.error();
  return BoundaryOf{std::move(surface).value(), {}};
}

Result<Conversion> convert(const fs::path& in, const fs::path& out, const io::WriteOptions& options,
                           const std::function<void()>& before_writing) {
  const bool wants_surface = options.extension.empty() && is_surface_extension(out);
  if (!wants_surface && options.extension.empty() && !is_mesh_extension(out)) {
    return Error{
        ErrorCode::kBadArgument,
        out.string() + ": unknown extension; use " + mesh_extensions() + ", or for surfaces " + kSurfaceExtensions,
        {}};
  }
  if (wants_surface) return convert_to_surface(in, out, before_writing);
  Result<io::MeshFile> file = io::read_mesh(in);
  if (!file.ok()) return file.error();
  io::drop_mid_nodes(*file);
  if (before_writing) before_writing();
  const io::MeshData& data = file->data;
  if (const Status status = io::write_mesh(out, data, options); !status.ok()) return status.error();
  return Conversion{file->notes, io::mesh_files(out, options), data.soup.points.size(), data.soup.tets.size(),
                    data.triangles.size()};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
