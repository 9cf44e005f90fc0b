// SPDX-License-Identifier: Apache-2.0
// Writers of all mesh formats. Each makes the whole text; `store_files` then writes it beside its place and renames.
#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <type_traits>

#include "incise/io/base64.h"
#include "incise/io/mesh_file.h"
#include "io/cells.h"
#include "io/files.h"
#include "io/gzip.h"
#include "io/text.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

using Labels = std::vector<std::int32_t>;

std::int32_t label(const Labels& labels, std::size_t i) {
  return labels.empty() ? 0 : labels[i];
}

// Text with numbers that read back exactly.
class Text {
 public:
  Text& operator<<(std::string_view text) {
    out_ += text;
    return *this;
  }
  Text& operator<<(char c) {
    out_ += c;
    return *this;
  }
  Text& operator<<(double value) {
    append_double(out_, value);
    return *this;
  }
  template <class Int>
  requires std::is_integral_v<Int> Text& operator<<(Int value) {
    append_int(out_, static_cast<std::int64_t>(value));
    return *this;
  }
  Text& operator<<(const Vec3& p) { return *this << p.x() << ' ' << p.y() << ' ' << p.z(); }
  // Vertex numbers that count from `base`.
  template <std::size_t N>
  Text& row(const std::array<std::uint32_t, N>& vertices, std::uint32_t base) {
    for (std::size_t k = 0; k < N; ++k) *this << (k == 0 ? std::string_view() : " ") << vertices[k] + base;
    return *this;
  }

  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

bool has_strokes(const MeshData& data) {
  return !data.triangle_stroke.empty() && !data.has_foreign_labels;
}

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

// One array over all cells, tets first; the other kind has 0.
Labels cell_array(const MeshData& data, const Labels& of_tets, const Labels& of_triangles) {
  Labels all(of_tets);
  all.resize(data.soup.tets.size(), 0);
  all.insert(all.end(), of_triangles.begin(), of_triangles.end());
  all.resize(data.soup.tets.size() + data.triangles.size(), 0);
  return all;
}

struct NamedLabels {
  std::string_view name;
  Labels values;
};

std::vector<NamedLabels> point_arrays(const MeshData& data) {
  std::vector<NamedLabels> arrays;
  if (!data.origin_vertex.empty()) arrays.push_back({"origin_vertex", data.origin_vertex});
  if (!data.cut_front.empty()) arrays.push_back({"cut_front", data.cut_front});
  return arrays;
}

// What MSH 4 calls an entity: the tets of a region, or the triangles of a label, by their positions.
struct MshEntity {
  std::int32_t label;
  std::vector<std::size_t> members;
};

// In the order in which the labels come.
std::vector<MshEntity> msh_entities(const Labels& labels, std::size_t n) {
  std::vector<MshEntity> entities;
  std::map<std::int32_t, std::size_t> known;
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t value = label(labels, i);
    const auto [found, is_new] = known.try_emplace(value, entities.size());
    if (is_new) entities.push_back({value, {}});
    entities[found->second].members.push_back(i);
  }
  return entities;
}

// Gmsh MSH 4.1 in ASCII: what Gmsh, meshio and MuJoCo all read.
class Msh4Writer {
 public:
  explicit Msh4Writer(const MeshData& data)
      : data_(data),
        volumes_(msh_entities(data.soup.regions, data.soup.tets.size())),
        surfaces_(msh_entities(data.triangle_stroke, data.triangles.size())) {
    for (const MshEntity& volume : volumes_) list(volume, 1);
    for (const MshEntity& surface : surfaces_) list(surface, data.soup.tets.size() + 1);
    // Either every entity has a physical group or none: meshio reads no other files.
    has_groups_ = data.has_foreign_labels || !(volumes_.size() == 1 && volumes_[0].label == 0);
  }

  std::string run() {
    out_ << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    entities();
    nodes();
    elements();
    const auto& soup = data_.soup;
    element_data("region", soup.regions, {});
    element_data("piece", data_.piece, {});
    if (has_strokes(data_)) element_data("stroke", {}, data_.triangle_stroke);
    for (const NamedLabels& array : point_arrays(data_)) {
      data_section("NodeData", array.name, array.values.size());
      for (std::size_t i = 0; i < array.values.size(); ++i) out_ << i + 1 << ' ' << array.values[i] << '\n';
      out_ << "$EndNodeData\n";
    }
    return out_.take();
  }

 private:
  void list(const MshEntity& entity, std::size_t first) {
    for (const std::size_t member : entity.members) numbers_.push_back(first + member);
  }

  void entities() {
    Vec3 low = data_.soup.points[0], high = low;
    for (const Vec3& p : data_.soup.points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    out_ << "$Entities\n0 0 " << surfaces_.size() << ' ' << volumes_.size() << '\n';
    for (const auto* list : {&surfaces_, &volumes_}) {
      for (std::size_t i = 0; i < list->size(); ++i) {
        out_ << i + 1 << ' ' << low << ' ' << high << ' ';
        if (has_groups_) {
          out_ << "1 " << (*list)[i].label << " 0\n";
        } else {
          out_ << "0 0\n";
        }
      }
    }
    out_ << "$EndEntities\n";
  }

  void nodes() {
    const std::size_t n = data_.soup.points.size();
    out_ << "$Nodes\n1 " << n << " 1 " << n << "\n3 1 0 " << n << '\n';
    for (std::size_t i = 1; i <= n; ++i) out_ << i << '\n';
    for (const Vec3& p : data_.soup.points) out_ << p << '\n';
    out_ << "$EndNodes\n";
  }

  void elements() {
    const std::size_t n = numbers_.size();
    out_ << "$Elements\n" << volumes_.size() + surfaces_.size() << ' ' << n << " 1 " << n << '\n';
    std::size_t written = 0;
    blocks(volumes_, "3 ", " 4 ", data_.soup.tets, written);
    blocks(surfaces_, "2 ", " 2 ", data_.triangles, written);
    out_ << "$EndElements\n";
  }

  template <class Element>
  void blocks(const std::vector<MshEntity>& list, std::string_view dimension, std::string_view type,
              const std::vector<Element>& elements, std::size_t& written) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      out_ << dimension << i + 1 << type << list[i].members.size() << '\n';
      for (const std::size_t member : list[i].members) {
        (out_ << numbers_[written++] << ' ').row(elements[member], 1) << '\n';
      }
    }
  }

  void data_section(std::string_view section, std::string_view name, std::size_t n) {
    out_ << "$" << section << "\n1\n\"" << name << "\"\n1\n0\n3\n0\n1\n" << n << '\n';
  }

  // One value for every element, in the order of the blocks: readers such as meshio want no other.
  void element_data(std::string_view name, const Labels& of_tets, const Labels& of_triangles) {
    if (of_tets.empty() && of_triangles.empty()) return;
    const Labels values = cell_array(data_, of_tets, of_triangles);
    data_section("ElementData", name, values.size());
    for (const std::size_t number : numbers_) out_ << number << ' ' << values[number - 1] << '\n';
    out_ << "$EndElementData\n";
  }

  const MeshData& data_;
  std::vector<MshEntity> volumes_, surfaces_;
  std::vector<std::size_t> numbers_;  // of the elements, from 1, as the blocks list them
  bool has_groups_ = false;
  Text out_;
};

// $ElementData or $NodeData of MSH 2, with one value for every element or node.
void msh_data(Text& out, std::string_view section, std::string_view name, const Labels& values) {
  out << "$" << section << "\n1\n\"" << name << "\"\n1\n0\n3\n0\n1\n" << values.size() << '\n';
  for (std::size_t i = 0; i < values.size(); ++i) out << i + 1 << ' ' << values[i] << '\n';
  out << "$End" << section << '\n';
}

// Gmsh MSH 2.2 in ASCII, for programs that read no other.
std::string write_msh2(const MeshData& data) {
  Text out;
  const auto& soup = data.soup;
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << soup.points.size() << '\n';
  for (std::size_t i = 0; i < soup.points.size(); ++i) out << i + 1 << ' ' << soup.points[i] << '\n';
  out << "$EndNodes\n$Elements\n" << soup.tets.size() + data.triangles.size() << '\n';
  const auto element = [&out](std::size_t number, int type, std::int32_t physical) -> Text& {
    return out << number << ' ' << type << " 2 " << physical << ' ' << std::max(physical, 1) << ' ';
  };
  for (std::size_t i = 0; i < soup.tets.size(); ++i) {
    element(i + 1, 4, label(soup.regions, i)).row(soup.tets[i], 1) << '\n';
  }
  for (std::size_t i = 0; i < data.triangles.size(); ++i) {
    element(soup.tets.size() + i + 1, 2, label(data.triangle_stroke, i)).row(data.triangles[i], 1) << '\n';
  }
  out << "$EndElements\n";
  const auto cell_data = [&](std::string_view name, const Labels& of_tets, const Labels& of_triangles) {
    if (!of_tets.empty() || !of_triangles.empty()) {
      msh_data(out, "ElementData", name, cell_array(data, of_tets, of_triangles));
    }
  };
  cell_data("region", soup.regions, {});
  cell_data("piece", data.piece, {});
  if (has_strokes(data)) cell_data("stroke", {}, data.triangle_stroke);
  for (const NamedLabels& array : point_arrays(data)) msh_data(out, "NodeData", array.name, array.values);
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

// Little-endian bytes on every machine.
template <class T>
void append_bytes(std::string& out, T value) {
  std::uint64_t bits = 0;
  if constexpr (sizeof(T) == 8) {
    std::memcpy(&bits, &value, sizeof value);
  } else {
    bits = static_cast<std::make_unsigned_t<T>>(value);
  }
  for (std::size_t i = 0; i < sizeof value; ++i) out += static_cast<char>((bits >> (8 * i)) & 255U);
}

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
                                       "; use .mesh, .msh, .msh2, .vtk, .vtu, .node, .ele, .veg or .inp"};
}

}  // namespace

Result<std::string> write_mesh_bytes(std::string_view extension, const MeshData& data) {
  return guarded<std::string>(std::string(extension), [&]() -> Result<std::string> {
    if (const char* fault = find_fault(data)) return Error{ErrorCode::kBadArgument, fault};
    if (extension == ".mesh") return write_medit(data);
    if (extension == ".msh") return Msh4Writer(data).run();
    if (extension == ".msh2") return write_msh2(data);
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

Status write_mesh(const std::filesystem::path& path, const MeshData& data) {
  const Extension extension = extension_of(path);
  const bool pair = extension.name == ".node" || extension.name == ".ele";
  std::vector<std::string> names = {extension.name};
  if (pair) names = {".node", ".ele"};
  std::vector<std::filesystem::path> paths;
  std::vector<std::string> bytes;
  for (const std::string& name : names) {
    Result<std::string> made = write_mesh_bytes(name, data);
    if (!made) return made.error();
    bytes.push_back(std::move(made).value());
    std::filesystem::path target = path;
    if (pair) target = (extension.gzipped ? target.replace_extension() : target).replace_extension(name);
    if (pair && extension.gzipped) target += ".gz";
    paths.push_back(target);
  }
  return store_packed(paths, std::move(bytes), extension.gzipped);
}

}  // namespace io
}  // namespace v0
}  // namespace incise
