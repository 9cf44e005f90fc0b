// SPDX-License-Identifier: Apache-2.0
// Finds the format of a mesh from its content, and gets bytes from the disk.
#include "incise/io/mesh_file.h"

#include <algorithm>
#include <new>
#include <system_error>
#include <vector>

#include "io/files.h"
#include "io/formats.h"
#include "io/gzip.h"
#include "io/reader.h"
#include "io/surface_kind.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

bool refuse(Job& job, const std::string& what) {
  return job.fail(what + " cannot be read; " + readable_formats(), ErrorCode::kUnsupported);
}

constexpr const char* kSurface = "a surface (it holds no tets; incise mesh fills it)";

// Known formats that are of no use here, by their first bytes.
const char* unsupported_kind(std::string_view bytes) {
  using std::string_view_literals::operator""sv;
  if (bytes.starts_with("\x89HDF\r\n")) return "HDF5 (.h5)";
  if (bytes.starts_with("MATLAB 5.0")) return "MATLAB (.mat)";
  if (bytes.starts_with("\1\0\0\0"sv) || bytes.starts_with("\0\0\0\1"sv)) return "binary MEDIT (.meshb)";
  if (bytes.starts_with("solid ") || bytes.starts_with("OFF") || is_binary_stl(bytes)) return kSurface;
  if (bytes.starts_with("NRRD") || is_image(bytes)) return "a label image (incise mesh makes a mesh of it)";
  return foreign_kind(bytes);
}

/// How many lines are looked at to tell one kind of text from another.
constexpr unsigned kLinesToTell = 200;

/// Calls `visit(line)` with the first lines, trimmed, until it returns true; returns whether it did.
template <class Visit>
bool any_line(std::string_view bytes, Visit&& visit) {
  std::size_t at = 0;
  for (unsigned i = 0; at < bytes.size() && i < kLinesToTell; ++i) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    if (visit(trim(bytes.substr(at, end - at)))) return true;
    at = end + 1;
  }
  return false;
}

/// A bulk data file of finite elements; its comments begin with '$', as the sections of Gmsh do.
bool is_nastran(std::string_view bytes) {
  return any_line(bytes, [](std::string_view line) {
    return line.starts_with("BEGIN BULK") || line.starts_with("GRID") || line.starts_with("CTETRA") ||
           line.starts_with("CEND");
  });
}

std::vector<double> numbers_in(std::string_view line) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    double number = 0;
    if (end > at && parse_double(line.substr(at, end - at), number)) numbers.push_back(number);
    at = end + 1;
  }
  return numbers;
}

/// A surface in the manner of .obj: lines of vertices and of faces.
bool is_obj(std::string_view bytes) {
  const auto has = [bytes](const char* word) {
    return any_line(bytes, [word](std::string_view line) { return line.starts_with(word); });
  };
  return has("v ") && (has("f ") || has("vn ") || has("vt ") || has("mtllib ") || has("o ") || has("g "));
}

/// The numbers of the first two lines that have any, without comments.
struct FirstNumbers {
  std::vector<double> first, second;
};
FirstNumbers first_numbers(std::string_view bytes) {
  FirstNumbers found;
  any_line(bytes, [&](std::string_view line) {
    line = trim(line.substr(0, line.find('#')));
    if (line.empty()) return false;
    const bool is_second = !found.first.empty();
    (is_second ? found.second : found.first) = numbers_in(line);
    return is_second || found.first.empty();
  });
  return found;
}

/// Points in space, or tets of four or ten nodes.
bool may_be_tetgen(const std::vector<double>& first) {
  return first.size() > 1 && (first[1] == 3 || first[1] == 4 || first[1] == 10);
}

/// What a text that begins with numbers alone is, where that is known and of no use here.
const char* unsupported_numbers(std::string_view bytes) {
  const auto [first, second] = first_numbers(bytes);
  if (first.size() == 1 && first[0] == -1) return "I-DEAS universal (.unv)";
  if (first.size() == 5) return "AVS UCD (.inp)";
  if (first.size() != 3 || may_be_tetgen(first)) return nullptr;
  const bool is_plane = second.size() == 3;  // a vertex and its label
  return is_plane ? "FreeFem (.msh of a plane mesh)" : "FreeFem (.msh of a mesh in space)";
}

/// Known formats of text that are of no use here.
const char* unsupported_text(std::string_view bytes) {
  const bool is_gmsh = any_line(bytes, [](std::string_view line) {
    return line.starts_with("$MeshFormat") || line.starts_with("$NOD") || line.starts_with("$Nodes");
  });
  if (!is_gmsh && is_obj(bytes)) return kSurface;
  if (!is_gmsh && is_nastran(bytes)) return "Nastran bulk data (.bdf, .nas)";
  return unsupported_numbers(bytes);
}

/// A file's bytes without a mark of their order, and its first line that says something.
Beginning beginning_of(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const std::string_view line = trim(bytes.substr(at, end - at));
    if (!line.empty() && line[0] != '#') return {bytes, line};
    at = end + 1;
  }
  return {bytes, {}};
}

const FormatRow* find_format(std::string_view bytes) {
  const Beginning beginning = beginning_of(bytes);
  for (const FormatRow& row : formats()) {
    if (row.recognises != nullptr && row.recognises(beginning)) return &row;
  }
  return nullptr;
}

/// What a reader of one's own makes of the bytes.
bool run(Job& job, const MeshFormat& format) {
  Result<MeshData> data = format.read(job.bytes, job.name, job.sibling);
  if (!data) {
    job.error = data.error();
    return false;
  }
  job.out.format_name = format.name;
  job.out.data = std::move(data).value();
  return finish(job);
}

void drop_byte_order_mark(std::string_view& bytes) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (bytes.starts_with(kMark)) bytes.remove_prefix(kMark.size());
}

/// The format of a file that begins so; null, with the job's error, where it is of no use here.
const FormatRow* format_of(Job& job) {
  const auto refused = [&job](const char* kind) { return refuse(job, kind), nullptr; };
  if (const char* kind = unsupported_kind(job.bytes)) return refused(kind);
  const std::string_view trimmed = trim(job.bytes.substr(0, 64));
  if (trimmed.starts_with("{") || trimmed.starts_with("[")) return refused("JSON");
  const FormatRow* format = find_format(job.bytes);
  if (format == nullptr || format->is_vague) {
    if (const char* kind = unsupported_text(job.bytes)) return refused(kind);
  }
  return format != nullptr ? format : refused("this kind of file");
}

bool run(Job& job, const std::vector<MeshFormat>& own) {
  if (job.bytes.empty()) return job.fail("the file is empty; export the mesh again");
  drop_byte_order_mark(job.bytes);
  for (const MeshFormat& format : own) {
    if (format.recognises && format.read && format.recognises(job.bytes)) return run(job, format);
  }
  const FormatRow* format = format_of(job);
  return format != nullptr && format->read(job) && finish(job);
}

// Messages end with a remedy, as the contract of errors asks.
Error complete(Error error) {
  if (error.message.find(';') == std::string::npos) error.message += "; the file is damaged: export the mesh again";
  return error;
}

Result<MeshFile> read_plain(std::string_view bytes, const std::string& name, const SiblingLoader& load,
                            const ReadLimits& limits, const std::vector<MeshFormat>& own) {
  std::string converted;
  if (ends_lines_by_return(bytes)) bytes = converted = with_line_feeds(bytes);
  SiblingLoader sibling;
  if (load) {
    sibling = [&load](const std::string& other) {
      Result<std::string> loaded = load(other);
      return loaded.ok() && ends_lines_by_return(*loaded) ? Result<std::string>(with_line_feeds(*loaded)) : loaded;
    };
  }
  Job job{name, bytes, sibling, limits, {}, {}};
  if (!run(job, own)) return complete(std::move(job.error));
  return std::move(job.out);
}

}  // namespace

// Of a format that is known by little more is asked: what a file of it has at its beginning.
bool has_what_its_format_begins_with(const Beginning& beginning) {
  const auto has = [&](std::string_view text) { return beginning.bytes.find(text) != std::string_view::npos; };
  double number = 0;
  if (beginning.line.starts_with("<")) return has("VTKFile");
  if (beginning.line.starts_with("ply")) return has("end_header");
  if (!parse_double(beginning.line.substr(0, beginning.line.find_first_of(" \t")), number)) return true;
  return may_be_tetgen(first_numbers(beginning.bytes).first);
}

std::optional<Error> check_mesh_beginning(std::string_view beginning, const std::string& name) {
  constexpr std::size_t kEnough = std::size_t{1} << 18U;
  std::string converted;
  if (is_gzip(beginning)) {
    converted = gunzip_beginning(beginning, kEnough);
    return converted.size() < kEnough ? std::nullopt : check_mesh_beginning(converted, name);
  }
  if (ends_lines_by_return(beginning)) beginning = converted = with_line_feeds(beginning);
  drop_byte_order_mark(beginning);
  Job job{name, beginning, {}, {}, {}, {}};
  const FormatRow* format = format_of(job);
  if (format != nullptr && has_what_its_format_begins_with(beginning_of(beginning))) return std::nullopt;
  if (format != nullptr) refuse(job, "this kind of file");
  return complete(std::move(job.error));
}

Result<MeshFile> read_mesh_bytes(std::string_view bytes, const std::string& name, const SiblingLoader& sibling,
                                 const ReadLimits& limits, const std::vector<MeshFormat>& own) {
  return guarded<MeshFile>(name, [&]() -> Result<MeshFile> {
    if (!is_gzip(bytes)) return read_plain(bytes, name, sibling, limits, own);
    std::string inflated;
    std::string why;
    if (!gunzip(bytes, limits.max_inflated_bytes, inflated, why)) return Error{ErrorCode::kBadFile, name + ": " + why};
    Result<MeshFile> file = read_plain(inflated, name, sibling, limits, own);
    if (file) file->gzipped = true;
    return file;
  });
}

Result<MeshFile> read_mesh(const std::filesystem::path& path, const ReadLimits& limits,
                           const std::vector<MeshFormat>& own) {
  const std::string name = path.string();
  return guarded<MeshFile>(name, [&]() -> Result<MeshFile> {
    // A format of one's own may be known by anything.
    const BeginningCheck check =
        own.empty() ? [&name](std::string_view b) { return check_mesh_beginning(b, name); } : BeginningCheck();
    Result<std::string> bytes = load_file_if(path, limits, check);
    if (!bytes) return bytes.error();
    const SiblingLoader sibling = [&path, &limits](const std::string& other) {
      // TetGen asks with the whole path; *INCLUDE with one that is relative to the file.
      const std::filesystem::path wanted(other);
      const bool beside = wanted.parent_path() == path.parent_path();
      return load_either(beside ? wanted : path.parent_path() / wanted, limits);
    };
    return read_mesh_bytes(*bytes, name, sibling, limits, own);
  });
}

}  // namespace io
}  // namespace v0
}  // namespace incise
