// SPDX-License-Identifier: Apache-2.0
// Writers of all mesh formats. Each makes the whole text; `store_files` then writes it beside its place and renames.
#include <algorithm>
#include <limits>
#include <map>

#include "incise/io/base64.h"
#include "incise/io/mesh_file.h"
#include "io/cells.h"
#include "io/files.h"
#include "io/gzip.h"
#include "io/reader.h"
#include "io/writer.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

// Which labels are ours: without it a reader must take them for somebody else's.
void medit_mark(Text& out, const MeshData& data) {
  if (!has_strokes(data) && data.origin_vertex.empty() && data.cut_front.empty()) return;
  out << kMeditMark;
  if (has_strokes(data)) out << " stroke";
  if (!data.origin_vertex.empty()) out << " origin_vertex";
  if (!data.cut_front.empty()) out << " cut_front";
  out << '\n';
}

void medit_corners(Text& out, const Labels& cut_front) {
  const auto is_front = [](std::int32_t front) { return front != 0; };
  const auto n = std::count_if(cut_front.begin(), cut_front.end(), is_front);
  if (n > 0) out << "Corners\n" << n << '\n';
  for (std::size_t i = 0; i < cut_front.size(); ++i) {
    if (is_front(cut_front[i])) out << i + 1 << '\n';
  }
}

std::string write_medit(const MeshData& data) {
  Text out;
  out << "MeshVersionFormatted 2\nDimension 3\n";
  medit_mark(out, data);
  out << "Vertices\n" << data.soup.points.size() << '\n';
  for (std::size_t i = 0; i < data.soup.points.size(); ++i) {
    const std::int32_t origin = data.origin_vertex.empty() ? -1 : data.origin_vertex[i];
    const bool has_label = origin >= 0 && origin < std::numeric_limits<std::int32_t>::max();
    out << data.soup.points[i] << ' ' << (has_label ? origin + 1 : 0) << '\n';
  }
  medit_corners(out, data.cut_front);
  if (!data.triangles.empty()) out << "Triangles\n" << data.triangles.size() << '\n';
  for (std::size_t i = 0; i < data.triangles.size(); ++i) {
    out.row(data.triangles[i], 1) << ' ' << label(data.triangle_stroke, i) << '\n';
  }
  out << "Tetrahedra\n" << data.soup.tets.size() << '\n';
  for (std::size_t i = 0; i < data.soup.tets.size(); ++i) {
    out.row(data.soup.tets[i], 1) << ' ' << label(data.soup.regions, i) << '\n';
  }
  out << "End\n";
  return out.take();
}

std::vector<NamedLabels> cell_arrays(const MeshData& data) {
  std::vector<NamedLabels> arrays;
  arrays.push_back({"region", cell_array(data, data.soup.regions, {})});
  if (!data.piece.empty()) arrays.push_back({"piece", cell_array(data, data.piece, {})});
  if (!data.triangle_stroke.empty()) {
    const std::string_view name = data.has_foreign_labels ? kFaceLabel : "stroke";
    arrays.push_back({name, cell_array(data, {}, data.triangle_stroke)});
  }
  return arrays;
}

void vtk_scalars(Text& out, std::string_view name, const Labels& values) {
  out << "SCALARS " << name << " int 1\nLOOKUP_TABLE default\n";
  for (const std::int32_t value : values) out << value << '\n';
}

std::string write_vtk(const MeshData& data) {
  Text out;
  const auto& soup = data.soup;
  const std::size_t n_cells = soup.tets.size() + data.triangles.size();
  out << "# vtk DataFile Version 4.2\nwritten by Incise\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
      << soup.points.size() << " double\n";
  for (const Vec3& p : soup.points) out << p << '\n';
  out << "CELLS " << n_cells << ' ' << 5 * soup.tets.size() + 4 * data.triangles.size() << '\n';
  for (const auto& tet : soup.tets) (out << "4 ").row(tet, 0) << '\n';
  for (const auto& triangle : data.triangles) (out << "3 ").row(triangle, 0) << '\n';
  out << "CELL_TYPES " << n_cells << '\n';
  for (std::size_t i = 0; i < n_cells; ++i) out << (i < soup.tets.size() ? "10\n" : "5\n");
  out << "CELL_DATA " << n_cells << '\n';
  for (const NamedLabels& array : cell_arrays(data)) vtk_scalars(out, array.name, array.values);
  const std::vector<NamedLabels> arrays = point_arrays(data);
  if (!arrays.empty()) out << "POINT_DATA " << soup.points.size() << '\n';
  for (const NamedLabels& array : arrays) vtk_scalars(out, array.name, array.values);
  return out.take();
}

#if INCISE_WITH_VTU

// Inline base64, in zlib blocks where zlib is there: the one form that VTK, ParaView and meshio all read exactly.
class VtuWriter {
 public:
  explicit VtuWriter(const MeshData& data) : data_(data) {}

  std::string run() {
    const auto& soup = data_.soup;
    out_ +=
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\"";
    if (has_gzip()) out_ += " compressor=\"vtkZLibDataCompressor\"";
    out_ += ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" + std::to_string(soup.points.size()) +
            "\" NumberOfCells=\"" + std::to_string(n_cells()) + "\">\n<Points>\n";
    points();
    out_ += "</Points>\n<Cells>\n";
    cells();
    out_ += "</Cells>\n<CellData>\n";
    for (const NamedLabels& labels : cell_arrays(data_)) array("Int32", labels.name, 1, labels.values);
    out_ += "</CellData>\n<PointData>\n";
    for (const NamedLabels& labels : point_arrays(data_)) array("Int32", labels.name, 1, labels.values);
    out_ += "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::size_t n_cells() const { return data_.soup.tets.size() + data_.triangles.size(); }

  void points() {
    std::vector<double> flat;
    flat.reserve(3 * data_.soup.points.size());
    for (const Vec3& p : data_.soup.points) flat.insert(flat.end(), {p.x(), p.y(), p.z()});
    array("Float64", "Points", 3, flat);
  }

  void cells() {
    std::vector<std::int64_t> numbers;
    numbers.reserve(4 * n_cells());
    for (const auto& tet : data_.soup.tets) numbers.insert(numbers.end(), tet.begin(), tet.end());
    for (const auto& triangle : data_.triangles) numbers.insert(numbers.end(), triangle.begin(), triangle.end());
    array("Int64", "connectivity", 1, numbers);
    numbers.clear();
    const std::size_t n_tets = data_.soup.tets.size();
    for (std::size_t i = 0; i < n_cells(); ++i) {
      numbers.push_back(static_cast<std::int64_t>(i < n_tets ? 4 * (i + 1) : 4 * n_tets + 3 * (i - n_tets + 1)));
    }
    array("Int64", "offsets", 1, numbers);
    std::vector<std::uint8_t> types(n_tets, 10);
    types.resize(n_cells(), 5);
    array("UInt8", "types", 1, types);
  }

  template <class T>
  void array(std::string_view type, std::string_view name, int components, const std::vector<T>& values) {
    std::string bytes;
    bytes.reserve(values.size() * sizeof(T));
    for (const T value : values) append_bytes(bytes, value);
    out_ += "<DataArray type=\"" + std::string(type) + "\" Name=\"" + std::string(name) + "\" NumberOfComponents=\"" +
            std::to_string(components) + "\" format=\"binary\">\n";
    has_gzip() ? blocks(bytes) : plain(bytes);
    out_ += "\n</DataArray>\n";
  }

  void plain(const std::string& bytes) {
    std::string all;
    append_bytes(all, static_cast<std::uint64_t>(bytes.size()));
    append_base64(out_, all + bytes);
  }

  void blocks(std::string_view bytes) {
    constexpr std::size_t kBlock = 32768;
    std::string header;
    std::string packed;
    const std::size_t n = (bytes.size() + kBlock - 1) / kBlock;
    append_bytes(header, static_cast<std::uint64_t>(n));
    append_bytes(header, static_cast<std::uint64_t>(kBlock));
    append_bytes(header, static_cast<std::uint64_t>(bytes.size() % kBlock));
    for (std::size_t b = 0; b < n; ++b) {
      const std::string block = deflate_block(bytes.substr(b * kBlock, kBlock));
      append_bytes(header, static_cast<std::uint64_t>(block.size()));
      packed += block;
    }
    append_base64(out_, header);
    append_base64(out_, packed);
  }

  const MeshData& data_;
  std::string out_;
};

#endif

std::string write_node(const MeshData& data) {
  Text out;
  const bool origin = !data.origin_vertex.empty();
  if (origin) out << "# incise: origin_vertex\n";
  out << data.soup.points.size() << " 3 " << (origin ? 1 : 0) << " 0\n";
  for (std::size_t i = 0; i < data.soup.points.size(); ++i) {
    out << i << ' ' << data.soup.points[i];
    if (origin) out << ' ' << data.origin_vertex[i];
    out << '\n';
  }
  return out.take();
}

std::string write_ele(const MeshData& data) {
  Text out;
  const bool piece = !data.piece.empty();
  const bool region = piece || !data.soup.regions.empty();
  if (piece) out << "# incise: region piece\n";
  out << data.soup.tets.size() << " 4 " << (piece ? 2 : region ? 1 : 0) << '\n';
  for (std::size_t i = 0; i < data.soup.tets.size(); ++i) {
    (out << i << ' ').row(data.soup.tets[i], 0);
    if (region) out << ' ' << label(data.soup.regions, i);
    if (piece) out << ' ' << data.piece[i];
    out << '\n';
  }
  return out.take();
}

// Tets by label, in rising order of both; label 0 needs no set.
std::map<std::int32_t, std::vector<std::size_t>> tets_by_label(const Labels& labels) {
  std::map<std::int32_t, std::vector<std::size_t>> sets;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != 0) sets[labels[i]].push_back(i + 1);
  }
  return sets;
}

void label_sets(Text& out, std::string_view opening, std::string_view prefix, const Labels& labels) {
  for (const auto& [value, tets] : tets_by_label(labels)) {
    out << opening << prefix << value << '\n';
    for (std::size_t i = 0; i < tets.size(); ++i) {
      out << tets[i] << (i % 8 == 7 || i + 1 == tets.size() ? ",\n" : ", ");
    }
  }
}

std::string write_vega(const MeshData& data) {
  Text out;
  const auto& soup = data.soup;
  out << "# Vega mesh file, written by Incise\n*VERTICES\n" << soup.points.size() << " 3 0 0\n";
  for (std::size_t i = 0; i < soup.points.size(); ++i) out << i + 1 << ' ' << soup.points[i] << '\n';
  out << "\n*ELEMENTS\nTET\n" << soup.tets.size() << " 4 0\n";
  for (std::size_t i = 0; i < soup.tets.size(); ++i) (out << i + 1 << ' ').row(soup.tets[i], 1) << '\n';
  out << '\n';
  label_sets(out, "*SET ", "region_", soup.regions);
  label_sets(out, "*SET ", "piece_", data.piece);
  out << "*MATERIAL tissue\nENU, 1000, 10000, 0.45\n\n*REGION\nallElements, tissue\n";
  return out.take();
}

std::string write_abaqus(const MeshData& data) {
  Text out;
  const auto& soup = data.soup;
  out << "*HEADING\nwritten by Incise\n*NODE\n";
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    const Vec3& p = soup.points[i];
    out << i + 1 << ", " << p.x() << ", " << p.y() << ", " << p.z() << '\n';
  }
  out << "*ELEMENT, TYPE=C3D4, ELSET=region_0\n";
  for (std::size_t i = 0; i < soup.tets.size(); ++i) {
    const auto& t = soup.tets[i];
    out << i + 1 << ", " << t[0] + 1 << ", " << t[1] + 1 << ", " << t[2] + 1 << ", " << t[3] + 1 << '\n';
  }
  label_sets(out, "*ELSET, ELSET=", "region_", soup.regions);
  label_sets(out, "*ELSET, ELSET=", "piece_", data.piece);
  return out.take();
}

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
  return {ErrorCode::kBadArgument, "no mesh can be written as " + in_quotes(extension) +
                                       "; use .mesh, .msh, .vtk, .vtu, .node, .ele, .veg or .inp"};
}

}  // namespace

Labels cell_array(const MeshData& data, const Labels& of_tets, const Labels& of_triangles) {
  Labels all(of_tets);
  all.resize(data.soup.tets.size(), 0);
  all.insert(all.end(), of_triangles.begin(), of_triangles.end());
  all.resize(data.soup.tets.size() + data.triangles.size(), 0);
  return all;
}

std::vector<NamedLabels> point_arrays(const MeshData& data) {
  std::vector<NamedLabels> arrays;
  if (!data.origin_vertex.empty()) arrays.push_back({"origin_vertex", data.origin_vertex});
  if (!data.cut_front.empty()) arrays.push_back({"cut_front", data.cut_front});
  return arrays;
}

std::optional<WriteOptions> write_options_named(std::string_view name) {
  if (name == "msh" || name == "msh41") return WriteOptions{".msh", MshVariant::k41};
  if (name == "msh41-binary") return WriteOptions{".msh", MshVariant::k41Binary};
  if (name == "msh22") return WriteOptions{".msh", MshVariant::k22};
  for (const std::string_view plain : {"mesh", "vtk", "vtu", "node", "veg", "inp"}) {
    if (name == plain) return WriteOptions{"." + std::string(plain), MshVariant::k41};
  }
  return std::nullopt;
}

Result<std::string> write_mesh_bytes(std::string_view extension, const MeshData& data, MshVariant msh) {
  return guarded<std::string>(std::string(extension), [&]() -> Result<std::string> {
    if (const char* fault = find_fault(data)) return Error{ErrorCode::kBadArgument, fault};
    if (extension == ".mesh") return write_medit(data);
    if (extension == ".msh") return write_msh(data, msh);
    if (extension == ".vtk") return write_vtk(data);
    if (extension == ".node") return write_node(data);
    if (extension == ".ele") return write_ele(data);
    if (extension == ".veg") return write_vega(data);
    if (extension == ".inp") return write_abaqus(data);
    if (extension != ".vtu") return unknown_extension(extension);
#if INCISE_WITH_VTU
    return VtuWriter(data).run();
#else
    return Error{ErrorCode::kUnsupported, "this build writes no VTU; use .mesh or .msh"};
#endif
  });
}

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path, const WriteOptions& options) {
  const Extension extension = extension_of(path);
  const std::string& name = options.extension.empty() ? extension.name : options.extension;
  if (name != ".node" && name != ".ele") return {path};
  std::vector<std::filesystem::path> files;
  for (const char* half : {".node", ".ele"}) {
    std::filesystem::path file = path;
    if (extension.gzipped) file.replace_extension();
    file.replace_extension(half);
    if (extension.gzipped) file += ".gz";
    files.push_back(std::move(file));
  }
  return files;
}

Status write_mesh(const std::filesystem::path& path, const MeshData& data, const WriteOptions& options) {
  const Extension extension = extension_of(path);
  const std::vector<std::filesystem::path> paths = mesh_files(path, options);
  std::vector<std::string> bytes;
  for (const std::filesystem::path& file : paths) {
    const bool is_half = paths.size() > 1;
    const std::string name = is_half || options.extension.empty() ? extension_of(file).name : options.extension;
    Result<std::string> made = write_mesh_bytes(name, data, options.msh);
    if (!made) return made.error();
    bytes.push_back(std::move(made).value());
  }
  return store_packed(paths, std::move(bytes), extension.gzipped);
}

}  // namespace io
}  // namespace v0
}  // namespace incise
