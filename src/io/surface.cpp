// SPDX-License-Identifier: Apache-2.0
// Triangle surfaces: STL, OBJ, OFF, PLY.
#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <tuple>

#include "incise/io/surface_file.h"
#include "io/files.h"
#include "io/gzip.h"
#include "io/ply.h"
#include "io/reader.h"
#include "io/surface_kind.h"
#include "io/text.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

float load_float(const char* p) {
  const std::uint32_t bits = load_u32(p);
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void append_float(std::string& out, double number) {
  const auto value = static_cast<float>(number);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (unsigned i = 0; i < 4; ++i) out += static_cast<char>((bits >> (8 * i)) & 255U);
}

// Text has no zero bytes, the numbers of binary files have.
bool is_cut_binary_stl(std::string_view bytes) {
  return bytes.size() >= kStlHeader && bytes.find('\0') != std::string_view::npos && !is_binary_stl(bytes);
}

// What a binary STL file whose length does not suit its header is told.
std::string wrong_length(std::string_view bytes) {
  const std::size_t room = bytes.size() - kStlHeader, spare = room % kStlTriangle;
  return ": as a binary STL file its header counts " + std::to_string(load_u32(bytes.data() + 80)) +
         " triangles, but the file holds " + std::to_string(room / kStlTriangle) +
         (spare > 0 ? " and " + std::to_string(spare) + " bytes more" : "") +
         "; copy the file again, or export the surface again";
}

void add_corner(SurfaceSoup& out, std::uint32_t k, const Vec3& p) {
  if (k == 0) out.triangles.emplace_back();
  out.triangles.back()[k] = static_cast<std::uint32_t>(out.points.size());
  out.points.push_back(p);
}

bool read_binary_stl(std::string_view bytes, SurfaceSoup& out) {
  const std::uint32_t n = load_u32(bytes.data() + 80);
  for (std::size_t i = 0; i < n; ++i) {
    const char* p = bytes.data() + kStlHeader + i * kStlTriangle + 12;
    for (std::uint32_t k = 0; k < 3; ++k, p += 12) {
      add_corner(out, k, {load_float(p), load_float(p + 4), load_float(p + 8)});
    }
  }
  return true;
}

bool read_ascii_stl(Cursor& in, SurfaceSoup& out) {
  std::uint32_t corner = 0;
  in.line();
  while (in.skip_space()) {
    const std::string_view word = in.word_in_line();
    if (same_word(word, "endsolid")) return corner == 0 || in.fail("a facet ends too early");
    if (same_word(word, "vertex")) {
      Vec3 p;
      for (int k = 0; k < 3; ++k) {
        if (!in.real_in_line(p[k], "coordinate")) return false;
      }
      add_corner(out, corner, p);
      corner = (corner + 1) % 3;
    }
    in.line();
  }
  return in.fail("endsolid is missing");
}

// Appends a polygon as a fan.
void add_fan(SurfaceSoup& out, const std::vector<std::uint32_t>& polygon) {
  for (std::size_t k = 2; k < polygon.size(); ++k) out.triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
}

// The numbers of one corner of a face, from 0: place, texture coordinate and normal.
using ObjCorner = std::array<std::uint32_t, 3>;

// "7", "7/1", "7//3", "-1": numbers count from 1, or back from the last. What is wrong with the second and the third is
// as if it were not there.
bool obj_corner(std::string_view word, const std::array<std::size_t, 3>& counts, ObjCorner& out) {
  out = {kInvalidIndex, kInvalidIndex, kInvalidIndex};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string_view number = word.substr(0, word.find('/'));
    std::int64_t value = 0;
    bool is_there = parse_int(number, value);
    if (value < 0) value += static_cast<std::int64_t>(counts[i]) + 1;
    is_there = is_there && to_index(value, counts[i], out[i], 1);
    if (!is_there) out[i] = kInvalidIndex;
    if (i == 0 && !is_there) return false;
    if (number.size() == word.size()) break;
    word.remove_prefix(number.size() + 1);
  }
  return true;
}

// Appends a polygon as a fan, with what its corners have besides places.
void add_obj_fan(SurfaceSoup& out, const std::vector<ObjCorner>& polygon) {
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const auto row = [&](std::size_t i) {
      return std::array<std::uint32_t, 3>{polygon[0][i], polygon[k - 1][i], polygon[k][i]};
    };
    out.triangles.push_back(row(0));
    out.texture_triangles.push_back(row(1));
    out.normal_triangles.push_back(row(2));
  }
}

bool read_obj_face(Cursor& in, SurfaceSoup& out) {
  std::vector<ObjCorner> polygon;
  while (!in.at_line_end()) {
    const std::string_view corner = in.word_in_line();
    if (!obj_corner(corner, {out.points.size(), out.texture.size(), out.normals.size()}, polygon.emplace_back())) {
      return in.fail("face corner " + in_quotes(corner) + " names no vertex before it");
    }
  }
  if (polygon.size() < 3) return in.fail("a face needs at least 3 corners");
  add_obj_fan(out, polygon);
  return true;
}

bool read_obj_row(Cursor& in, std::string_view word, SurfaceSoup& out) {
  if (word == "f") return read_obj_face(in, out);
  if (word == "vt") {
    auto& at = out.texture.emplace_back();
    if (!in.real_in_line(at[0], "texture coordinate")) return false;
    return in.at_line_end() || in.real_in_line(at[1], "texture coordinate");
  }
  if (word != "v" && word != "vn") return true;
  Vec3& p = word == "v" ? out.points.emplace_back() : out.normals.emplace_back();
  for (int k = 0; k < 3; ++k) {
    if (!in.real_in_line(p[k], "coordinate")) return false;
  }
  return true;
}

bool has_any(const std::vector<std::array<std::uint32_t, 3>>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const auto& row) {
    return std::any_of(row.begin(), row.end(), [](std::uint32_t v) { return v != kInvalidIndex; });
  });
}

bool read_obj(Cursor& in, SurfaceSoup& out) {
  in.set_comment('#');
  while (in.skip_space()) {
    if (!read_obj_row(in, in.word_in_line(), out)) return false;
    in.line();
  }
  if (!has_any(out.texture_triangles)) out.texture_triangles.clear();
  if (!has_any(out.normal_triangles)) out.normal_triangles.clear();
  return true;
}

bool read_off(Cursor& in, SurfaceSoup& out) {
  std::int64_t n_points = 0;
  std::int64_t n_faces = 0;
  std::int64_t n_edges = 0;
  in.set_comment('#');
  const std::string_view word = in.word();
  if (word != "OFF") return in.fail("only plain OFF is read, not " + in_quotes(word));
  if (!in.integer(n_points, "number of vertices") || !in.count(n_faces, 1, "number of faces") ||
      !in.integer(n_edges, "number of edges")) {
    return false;
  }
  if (n_points < 0 || static_cast<std::uint64_t>(n_points) > in.remaining() / 5) {
    return in.fail("number of vertices is more than the rest of the file can hold");
  }
  out.points.resize(static_cast<std::size_t>(n_points));
  for (Vec3& p : out.points) {
    for (int k = 0; k < 3; ++k) {
      if (!in.real(p[k], "coordinate")) return false;
    }
    in.line();
  }
  for (std::int64_t i = 0; i < n_faces; ++i) {
    std::int64_t n = 0;
    if (!in.count(n, 1, "number of corners")) return false;
    std::vector<std::uint32_t> polygon(static_cast<std::size_t>(n));
    for (std::uint32_t& v : polygon) {
      std::int64_t value = 0;
      if (!in.integer_in_line(value, "vertex number")) return false;
      if (!to_index(value, out.points.size(), v))
        return in.fail("vertex number " + std::to_string(value) + " is out of range");
    }
    in.line();
    add_fan(out, polygon);
  }
  return true;
}

bool read_surface_as(std::string_view bytes, const std::string& name, Error& error, SurfaceSoup& out) {
  Cursor in(bytes, name, error);
  if (bytes.substr(0, 3) == "ply") {
    PlyContent content;
    if (!read_ply(bytes, name, error, content)) return false;
    out.points = std::move(content.points);
    out.triangles = std::move(content.triangles);
    return true;
  }
  if (is_binary_stl(bytes)) return read_binary_stl(bytes, out);
  if (const char* kind = foreign_kind(bytes)) {
    error = {ErrorCode::kUnsupported,
             name + ": is " + kind + "; Incise reads .obj, .stl, .ply and .off surfaces, any of them gzipped"};
    return false;
  }
  if (is_cut_binary_stl(bytes)) {
    error = {ErrorCode::kBadFile, name + wrong_length(bytes)};
    return false;
  }
  if (same_word(bytes.substr(0, 5), "solid")) return read_ascii_stl(in, out);
  const std::string_view first = trim(bytes);
  if (first.substr(0, 3) == "OFF") return read_off(in, out);
  return read_obj(in, out);
}

constexpr const char* kNoTriangles = ": holds no triangles; Incise reads .obj, .stl, .ply and .off surfaces";

bool check(const std::string& name, Error& error, const SurfaceSoup& surface) {
  const auto finite = [](const Vec3& p) { return p.allFinite(); };
  const char* what = nullptr;
  if (surface.triangles.empty()) what = kNoTriangles;
  if (!std::all_of(surface.points.begin(), surface.points.end(), finite)) {
    what = ": a vertex is not finite; export the surface again";
  }
  if (what != nullptr) error = {ErrorCode::kBadFile, name + what};
  return what == nullptr;
}

Result<SurfaceSoup> read_plain(std::string_view bytes, const std::string& name) {
  SurfaceSoup out;
  Error error;
  std::string converted;
  if (!is_binary_stl(bytes) && ends_lines_by_return(bytes)) bytes = converted = with_line_feeds(bytes);
  if (read_surface_as(bytes, name, error, out) && check(name, error, out)) return out;
  if (error.message.find(';') == std::string::npos) error.message += "; the file is damaged: export the surface again";
  return error;
}

// Numbers of a row, with a space before each.
template <class Row>
void append_row(std::string& out, const Row& row, std::uint32_t base) {
  for (const std::uint32_t v : row) {
    out += ' ';
    append_int(out, std::int64_t{v} + base);
  }
  out += '\n';
}

void append_point(std::string& out, const Vec3& p) {
  append_double(out, p.x());
  out += ' ';
  append_double(out, p.y());
  out += ' ';
  append_double(out, p.z());
  out += '\n';
}

std::string write_obj(const SurfaceSoup& s) {
  std::string out = "# written by Incise\n";
  for (const Vec3& p : s.points) {
    out += "v ";
    append_point(out, p);
  }
  for (const auto& at : s.texture) {
    out += "vt ";
    append_double(out, at[0]);
    out += ' ';
    append_double(out, at[1]);
    out += '\n';
  }
  for (const Vec3& normal : s.normals) {
    out += "vn ";
    append_point(out, normal);
  }
  const auto append_number = [&out](const auto& rows, std::size_t i, std::size_t k) {
    if (!rows.empty() && rows[i][k] != kInvalidIndex) append_int(out, std::int64_t{rows[i][k]} + 1);
  };
  for (std::size_t i = 0; i < s.triangles.size(); ++i) {
    out += 'f';
    for (std::size_t k = 0; k < 3; ++k) {
      out += ' ';
      append_int(out, std::int64_t{s.triangles[i][k]} + 1);
      if (!s.texture_triangles.empty() || !s.normal_triangles.empty()) out += '/';
      append_number(s.texture_triangles, i, k);
      if (!s.normal_triangles.empty()) out += '/';
      append_number(s.normal_triangles, i, k);
    }
    out += '\n';
  }
  return out;
}

// OFF and PLY differ in their headers only.
std::string write_rows(const SurfaceSoup& s, std::string out) {
  for (const Vec3& p : s.points) append_point(out, p);
  for (const auto& triangle : s.triangles) {
    out += '3';
    append_row(out, triangle, 0);
  }
  return out;
}

std::string write_off(const SurfaceSoup& s) {
  return write_rows(s, "OFF\n" + std::to_string(s.points.size()) + " " + std::to_string(s.triangles.size()) + " 0\n");
}

std::string write_ply(const SurfaceSoup& s) {
  return write_rows(
      s, "ply\nformat ascii 1.0\ncomment written by Incise\nelement vertex " + std::to_string(s.points.size()) +
             "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
             std::to_string(s.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n");
}

std::string write_stl(const SurfaceSoup& s) {
  std::string out = "binary STL, written by Incise";
  out.resize(80, ' ');
  for (unsigned i = 0; i < 4; ++i) out += static_cast<char>((s.triangles.size() >> (8 * i)) & 255U);
  for (const auto& t : s.triangles) {
    const Vec3 normal = (s.points[t[1]] - s.points[t[0]]).cross(s.points[t[2]] - s.points[t[0]]);
    const double length = normal.norm();
    for (int k = 0; k < 3; ++k) append_float(out, length > 0 ? normal[k] / length : 0);
    for (const std::uint32_t v : t) {
      for (int k = 0; k < 3; ++k) append_float(out, s.points[v][k]);
    }
    out.append(2, '\0');
  }
  return out;
}

bool is_sound(const SurfaceSoup& s) {
  const auto are_below = [&s](const auto& rows, std::size_t count, bool may_lack) {
    return (rows.size() == s.triangles.size() || (may_lack && rows.empty())) &&
           std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
             return std::all_of(row.begin(), row.end(),
                                [&](std::uint32_t v) { return v < count || (may_lack && v == kInvalidIndex); });
           });
  };
  return are_below(s.triangles, s.points.size(), false) && are_below(s.texture_triangles, s.texture.size(), true) &&
         are_below(s.normal_triangles, s.normals.size(), true);
}

}  // namespace

// An .obj has no mark of its own: a line with a vertex tells it.
std::optional<Error> check_surface_beginning(std::string_view beginning, const std::string& name) {
  const std::string_view first = trim(beginning);
  const bool is_marked = first.starts_with("ply") || first.starts_with("OFF") || same_word(first.substr(0, 5), "solid");
  if (is_gzip(beginning) || is_marked || may_be_binary_stl(beginning, ReadLimits().max_inflated_bytes))
    return std::nullopt;
  for (std::size_t at = 0; at < first.size();) {
    const std::size_t end = std::min(first.find_first_of("\r\n", at), first.size());
    const std::string_view line = trim(first.substr(at, end - at));
    if (line.starts_with("v ") || line.starts_with("v\t")) return std::nullopt;
    at = end + 1;
  }
  return Error{ErrorCode::kUnsupported, name + kNoTriangles};
}

Result<SurfaceSoup> read_surface_bytes(std::string_view bytes, const std::string& name, const ReadLimits& limits) {
  return guarded<SurfaceSoup>(name, [&]() -> Result<SurfaceSoup> {
    if (!is_gzip(bytes)) return read_plain(bytes, name);
    std::string inflated;
    std::string why;
    if (!gunzip(bytes, limits.max_inflated_bytes, inflated, why)) return Error{ErrorCode::kBadFile, name + ": " + why};
    return read_plain(inflated, name);
  });
}

Result<SurfaceSoup> read_surface(const std::filesystem::path& path, const ReadLimits& limits) {
  const std::string name = path.string();
  return guarded<SurfaceSoup>(name, [&]() -> Result<SurfaceSoup> {
    const Result<std::string> bytes =
        load_file_if(path, limits, [&name](std::string_view b) { return check_surface_beginning(b, name); });
    if (!bytes) return bytes.error();
    return read_surface_bytes(*bytes, name, limits);
  });
}

Result<std::string> write_surface_bytes(std::string_view extension, const SurfaceSoup& surface) {
  return guarded<std::string>(std::string(extension), [&]() -> Result<std::string> {
    if (!is_sound(surface)) return Error{ErrorCode::kBadArgument, "a vertex number of the surface is out of range"};
    if (extension == ".obj") return write_obj(surface);
    if (extension == ".stl") return write_stl(surface);
    if (extension == ".ply") return write_ply(surface);
    if (extension == ".off") return write_off(surface);
    return Error{ErrorCode::kBadArgument,
                 "no surface can be written as " + in_quotes(extension) + "; use .obj, .stl, .ply or .off"};
  });
}

Status write_surface(const std::filesystem::path& path, const SurfaceSoup& surface) {
  if (Status status = check_place(path); !status.ok()) return status;
  const Extension extension = extension_of(path);
  Result<std::string> bytes = write_surface_bytes(extension.name, surface);
  if (!bytes.ok()) return bytes.error();
  return store_packed({path}, {std::move(bytes).value()}, extension.gzipped);
}

FineSurface to_fine_surface(const SurfaceSoup& surface) {
  SurfaceSoup welded = surface;
  weld(welded);
  const bool has_texture = !welded.texture_triangles.empty();
  const bool has_normals =
      !welded.normal_triangles.empty() &&
      std::all_of(welded.normal_triangles.begin(), welded.normal_triangles.end(), [&](const auto& row) {
        return std::all_of(row.begin(), row.end(),
                           [&](std::uint32_t n) { return n != kInvalidIndex && welded.normals[n].norm() > 0; });
      });
  FineSurface fine;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> numbers;  // of corners that are alike
  for (std::size_t i = 0; i < welded.triangles.size(); ++i) {
    auto& triangle = fine.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t at = has_texture ? welded.texture_triangles[i][k] : kInvalidIndex;
      const std::uint32_t normal = has_normals ? welded.normal_triangles[i][k] : kInvalidIndex;
      const auto [found, is_new] =
          numbers.try_emplace({welded.triangles[i][k], at, normal}, static_cast<std::uint32_t>(numbers.size()));
      triangle[k] = found->second;
      if (!is_new) continue;
      fine.points.push_back(welded.points[welded.triangles[i][k]]);
      if (has_texture) fine.texture.push_back(at == kInvalidIndex ? std::array<double, 2>{} : welded.texture[at]);
      if (has_normals) fine.normals.push_back(welded.normals[normal].normalized());
    }
  }
  return fine;
}

std::size_t weld(SurfaceSoup& surface) {
  const auto& points = surface.points;
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&points](std::uint32_t v) { return std::make_tuple(points[v].x(), points[v].y(), points[v].z()); };
  std::stable_sort(order.begin(), order.end(), [&key](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  std::vector<Vec3> kept;
  std::vector<std::uint32_t> renumbered(points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    renumbered[v] = first[v] == v ? static_cast<std::uint32_t>(kept.size()) : renumbered[first[v]];
    if (first[v] == v) kept.push_back(points[v]);
  }
  const std::size_t gone = points.size() - kept.size();
  surface.points = std::move(kept);
  for (auto& triangle : surface.triangles) {
    for (std::uint32_t& v : triangle) v = renumbered[v];
  }
  return gone;
}

}  // namespace io
}  // namespace v0
}  // namespace incise
