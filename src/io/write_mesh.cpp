// SPDX-License-Identifier: Apache-2.0
// Writes meshes in the formats of the table. Each writer makes the whole text; `store_files` then writes it beside its
// place and renames.
#include <algorithm>
#include <array>

#include "incise/io/mesh_file.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/text.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

template <class T>
bool has_length(const std::vector<T>& labels, std::size_t n) {
  return labels.empty() || labels.size() == n;
}

template <std::size_t N>
bool in_range(const std::vector<std::array<std::uint32_t, N>>& rows, std::size_t n) {
  return std::all_of(rows.begin(), rows.end(), [n](const auto& row) {
    return std::all_of(row.begin(), row.end(), [n](std::uint32_t v) { return v < n; });
  });
}

const char* find_fault(const MeshData& data) {
  const auto& soup = data.soup;
  const std::size_t n = soup.points.size();
  if (soup.tets.empty()) return "the mesh has no tets";
  if (!in_range(soup.tets, n) || !in_range(data.triangles, n)) return "a vertex number is out of range";
  if (!std::all_of(soup.points.begin(), soup.points.end(), [](const Vec3& p) { return p.allFinite(); })) {
    return "a vertex is not finite";
  }
  if (!has_length(soup.regions, soup.tets.size()) || !has_length(data.piece, soup.tets.size()) ||
      !has_length(data.triangle_stroke, data.triangles.size()) || !has_length(data.origin_vertex, n) ||
      !has_length(data.cut_front, n)) {
    return "an array of labels has the wrong length";
  }
  return nullptr;
}

Error unknown_extension(std::string_view extension) {
  if (extension.empty()) {
    return {ErrorCode::kBadArgument,
            "the name of the file has no extension, which says the format; use " + writable_extensions()};
  }
  return {ErrorCode::kBadArgument,
          "no mesh can be written as " + in_quotes(extension) + "; use " + writable_extensions()};
}

const FormatRow* row_of(std::string_view extension) {
  for (const FormatRow& row : formats()) {
    if (!row.extension.empty() && row.extension == extension) return &row;
  }
  return nullptr;
}

/// The format of one's own that writes an extension; null where none does.
const MeshFormat* own_format(const std::vector<MeshFormat>& formats, std::string_view extension) {
  const auto at = std::find_if(formats.begin(), formats.end(), [&](const MeshFormat& format) {
    return format.write && !format.extension.empty() && format.extension == extension;
  });
  return at == formats.end() ? nullptr : &*at;
}

Result<std::string> bytes_for(std::string_view extension, const MeshData& data, const WriteOptions& options) {
  const MeshFormat* own = own_format(options.formats, extension);
  if (own == nullptr) return write_mesh_bytes(extension, data, options.msh);
  return guarded<std::string>(std::string(extension), [&]() -> Result<std::string> {
    if (const char* fault = find_fault(data)) return Error{ErrorCode::kBadArgument, fault};
    return own->write(data);
  });
}

}  // namespace

std::optional<WriteOptions> write_options_named(std::string_view name) {
  for (const FormatRow& row : formats()) {
    if (!row.option.empty() && row.option == name) return WriteOptions{std::string(row.extension), row.variant};
  }
  if (name == "msh") return WriteOptions{".msh", MshVariant::k41};
  return std::nullopt;
}

std::vector<std::string> write_option_names() {
  std::vector<std::string> names;
  for (const FormatRow& row : formats()) {
    if (!row.option.empty()) names.emplace_back(row.option);
  }
  return names;
}

Result<std::string> write_mesh_bytes(std::string_view extension, const MeshData& data, MshVariant msh) {
  return guarded<std::string>(std::string(extension), [&]() -> Result<std::string> {
    if (const char* fault = find_fault(data)) return Error{ErrorCode::kBadArgument, fault};
    const FormatRow* row = row_of(extension);
    if (row == nullptr) return unknown_extension(extension);
    if (row->write != nullptr) return row->write(data, extension == ".msh" ? msh : row->variant);
    return Error{ErrorCode::kUnsupported, "this build writes no " + std::string(extension) + "; use .mesh or .msh"};
  });
}

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path, const WriteOptions& options) {
  const Extension extension = extension_of(path);
  const std::string& name = options.extension.empty() ? extension.name : options.extension;
  const FormatRow* row = own_format(options.formats, name) == nullptr ? row_of(name) : nullptr;
  if (row == nullptr || row->twin.empty()) return {path};
  std::vector<std::filesystem::path> files;
  for (const std::string_view half : {std::max(row->extension, row->twin), std::min(row->extension, row->twin)}) {
    std::filesystem::path file = path;
    if (extension.gzipped) file.replace_extension();
    file.replace_extension(half);
    if (extension.gzipped) file += ".gz";
    files.push_back(std::move(file));
  }
  return files;
}

Status write_mesh(const std::filesystem::path& path, const MeshData& data, const WriteOptions& options) {
  if (Status status = check_place(path); !status.ok()) return status;
  const Extension extension = extension_of(path);
  const std::vector<std::filesystem::path> paths = mesh_files(path, options);
  std::vector<std::string> bytes;
  for (const std::filesystem::path& file : paths) {
    const bool is_half = paths.size() > 1;
    const std::string name = is_half || options.extension.empty() ? extension_of(file).name : options.extension;
    Result<std::string> made = bytes_for(name, data, options);
    if (!made) return made.error();
    bytes.push_back(std::move(made).value());
  }
  return store_packed(paths, std::move(bytes), extension.gzipped);
}

}  // namespace io
}  // namespace v0
}  // namespace incise
