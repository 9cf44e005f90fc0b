// SPDX-License-Identifier: Apache-2.0
// Triangle surfaces: STL, OBJ, OFF, PLY.
#include <algorithm>
#include <cstring>
#include <numeric>
#include <tuple>

#include "incise/io/surface_file.h"
#include "io/files.h"
#include "io/gzip.h"
#include "io/ply.h"
#include "io/reader.h"
#include "io/text.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

constexpr std::size_t kStlHeader = 84;    // 80 bytes of text and a count
constexpr std::size_t kStlTriangle = 50;  // normal, three points, two spare bytes

std::uint32_t load_u32(const char* p) {
  std::uint32_t bits = 0;
  for (std::size_t i = 4; i-- > 0;) bits = (bits << 8U) | static_cast<unsigned char>(p[i]);
  return bits;
}

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

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kStlHeader && (bytes.size() - kStlHeader) / kStlTriangle >= load_u32(bytes.data() + 80) &&
         (bytes.size() - kStlHeader) == std::size_t{load_u32(bytes.data() + 80)} * kStlTriangle;
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

// "7", "7/1", "7//3", "-1": the vertex counts from 1, or back from the last.
bool obj_index(std::string_view word, std::size_t n, std::uint32_t& out) {
  std::int64_t value = 0;
  if (!parse_int(word.substr(0, word.find('/')), value)) return false;
  if (value < 0) value += static_cast<std::int64_t>(n) + 1;
  return to_index(value, n, out, 1);
}

bool read_obj(Cursor& in, SurfaceSoup& out) {
  in.set_comment('#');
  while (in.skip_space()) {
    const std::string_view word = in.word_in_line();
    if (word == "v") {
      Vec3& p = out.points.emplace_back();
      for (int k = 0; k < 3; ++k) {
        if (!in.real_in_line(p[k], "coordinate")) return false;
      }
    } else if (word == "f") {
      std::vector<std::uint32_t> polygon;
      while (!in.at_line_end()) {
        const std::string_view corner = in.word_in_line();
        if (!obj_index(corner, out.points.size(), polygon.emplace_back())) {
          return in.fail("face corner " + in_quotes(corner) + " names no vertex before it");
        }
      }
      if (polygon.size() < 3) return in.fail("a face needs at least 3 corners");
      add_fan(out, polygon);
    }
    in.line();
  }
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
  if (same_word(bytes.substr(0, 5), "solid")) return read_ascii_stl(in, out);
  const std::string_view first = trim(bytes);
  if (first.substr(0, 3) == "OFF") return read_off(in, out);
  return read_obj(in, out);
}

bool check(const std::string& name, Error& error, const SurfaceSoup& surface) {
  const auto finite = [](const Vec3& p) { return p.allFinite(); };
  const char* what = nullptr;
  if (surface.triangles.empty()) what = ": holds no triangles; Incise reads .obj, .stl, .ply and .off surfaces";
  if (!std::all_of(surface.points.begin(), surface.points.end(), finite)) {
    what = ": a vertex is not finite; export the surface again";
  }
  if (what != nullptr) error = {ErrorCode::kBadFile, name + what};
  return what == nullptr;
}

Result<SurfaceSoup> read_plain(std::string_view bytes, const std::string& name) {
  SurfaceSoup out;
  Error error;
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
  for (const auto& triangle : s.triangles) {
    out += 'f';
    append_row(out, triangle, 1);
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
  return std::all_of(s.triangles.begin(), s.triangles.end(), [&s](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&s](std::uint32_t v) { return v < s.points.size(); });
  });
}

}  // namespace

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
    const Result<std::string> bytes = load_file(path, limits);
    if (!bytes) return bytes.error();
    return read_surface_bytes(*bytes, name, limits);
  });
}

Status write_surface(const std::filesystem::path& path, const SurfaceSoup& surface) {
  if (!is_sound(surface)) return Error{ErrorCode::kBadArgument, "a vertex number of the surface is out of range"};
  const Extension extension = extension_of(path);
  std::string bytes;
  if (extension.name == ".obj") bytes = write_obj(surface);
  if (extension.name == ".stl") bytes = write_stl(surface);
  if (extension.name == ".ply") bytes = write_ply(surface);
  if (extension.name == ".off") bytes = write_off(surface);
  if (bytes.empty()) {
    return Error{ErrorCode::kBadArgument,
                 "no surface can be written as " + in_quotes(extension.name) + "; use .obj, .stl, .ply or .off"};
  }
  return store_packed({path}, {std::move(bytes)}, extension.gzipped);
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
