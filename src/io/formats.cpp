// SPDX-License-Identifier: Apache-2.0
// Here a format is registered: the declarations of its reader and its writer, which nobody else calls, and its rows.
#include "io/formats.h"

#include <algorithm>
#include <array>
#include <vector>

namespace incise {
inline namespace v0 {
namespace io {

bool read_medit(Job& job);
bool read_msh(Job& job);
bool read_vtk(Job& job);
bool read_vtu(Job& job);
bool read_tetgen(Job& job);
bool read_vega(Job& job);
bool read_abaqus(Job& job);
bool read_ply_tets(Job& job);

std::string write_medit(const MeshData& data, MshVariant variant);
std::string write_msh(const MeshData& data, MshVariant variant);
std::string write_vtk(const MeshData& data, MshVariant variant);
#if INCISE_WITH_VTU
std::string write_vtu(const MeshData& data, MshVariant variant);
#else
constexpr std::string (*write_vtu)(const MeshData&, MshVariant) = nullptr;
#endif
constexpr std::string_view kVtuTitle = INCISE_WITH_VTU ? ".vtu" : "";  // a build without says so of such a file
std::string write_node(const MeshData& data, MshVariant variant);
std::string write_ele(const MeshData& data, MshVariant variant);
std::string write_vega(const MeshData& data, MshVariant variant);
std::string write_abaqus(const MeshData& data, MshVariant variant);

namespace {

bool is_vtk(const Beginning& b) {
  return b.bytes.starts_with("# vtk DataFile");
}
bool is_ply(const Beginning& b) {
  return b.bytes.starts_with("ply\n") || b.bytes.starts_with("ply\r");
}
bool is_msh(const Beginning& b) {
  return b.line.starts_with("$");
}
bool is_vtu(const Beginning& b) {
  return b.line.starts_with("<");
}
bool is_medit(const Beginning& b) {
  return same_word(b.line.substr(0, 20), "MeshVersionFormatted");
}
bool is_tetgen(const Beginning& b) {
  double number = 0;
  return parse_double(b.line.substr(0, b.line.find_first_of(" \t")), number);
}

/// Lines that begin with '*' tell Vega from Abaqus: the first that only one of them has.
enum class Starred : std::uint8_t { kNeither, kVega, kAbaqus };
Starred starred(const Beginning& b) {
  for (std::size_t at = 0; b.line.starts_with("*") && at < b.bytes.size();) {
    const std::size_t end = std::min(b.bytes.find('\n', at), b.bytes.size());
    const std::string_view line = trim(b.bytes.substr(at, end - at));
    const std::string_view keyword = trim(line.substr(0, line.find(',')));
    if (same_word(keyword, "*VERTICES") || same_word(keyword, "*ELEMENTS")) return Starred::kVega;
    if (same_word(keyword, "*NODE") || same_word(keyword, "*HEADING") || same_word(keyword, "*ELEMENT")) {
      return Starred::kAbaqus;
    }
    if (to_lower(line.substr(0, 9)).starts_with("*include ") && line.find('=') == std::string_view::npos)
      return Starred::kVega;
    at = end + 1;
  }
  return Starred::kNeither;
}
bool is_vega(const Beginning& b) {
  return starred(b) == Starred::kVega;
}
bool is_abaqus(const Beginning& b) {
  return starred(b) == Starred::kAbaqus;
}

constexpr std::array kFormats = {
    FormatRow{"MEDIT .mesh", is_medit, read_medit, false, ".mesh", write_medit, "mesh"},
    FormatRow{"Gmsh .msh", is_msh, read_msh, true, ".msh", write_msh, "msh41", MshVariant::k41},
    FormatRow{"", nullptr, nullptr, false, ".msh", write_msh, "msh41-binary", MshVariant::k41Binary},
    FormatRow{"", nullptr, nullptr, false, ".msh", write_msh, "msh22", MshVariant::k22},
    FormatRow{"", nullptr, nullptr, false, ".msh2", write_msh, "", MshVariant::k22},
    FormatRow{"legacy .vtk", is_vtk, read_vtk, false, ".vtk", write_vtk, "vtk"},
    FormatRow{kVtuTitle, is_vtu, read_vtu, false, ".vtu", write_vtu, "vtu"},
    FormatRow{"TetGen .node/.ele", is_tetgen, read_tetgen, true, ".node", write_node, "node", MshVariant::k41, ".ele"},
    FormatRow{"", nullptr, nullptr, false, ".ele", write_ele, "", MshVariant::k41, ".node"},
    FormatRow{"Vega .veg", is_vega, read_vega, false, ".veg", write_vega, "veg"},
    FormatRow{"Abaqus .inp", is_abaqus, read_abaqus, false, ".inp", write_abaqus, "inp"},
    FormatRow{"tetrahedral .ply", is_ply, read_ply_tets},
};

/// "a, b and c", with a word before the last.
std::string listed(const std::vector<std::string>& names, std::string_view before_last) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " " + std::string(before_last) + " " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace

std::span<const FormatRow> formats() {
  return kFormats;
}

std::string readable_formats() {
  std::vector<std::string> titles;
  for (const FormatRow& row : kFormats) {
    if (!row.title.empty()) titles.emplace_back(row.title);
  }
  return "Incise reads " + listed(titles, "and");
}

std::vector<std::string> written_extensions() {
  std::vector<std::string> extensions;
  for (const FormatRow& row : kFormats) {
    const bool is_new = std::find(extensions.begin(), extensions.end(), row.extension) == extensions.end();
    if (row.write != nullptr && is_new) extensions.emplace_back(row.extension);
  }
  return extensions;
}

std::string writable_extensions() {
  return listed(written_extensions(), "or");
}

}  // namespace io
}  // namespace v0
}  // namespace incise
