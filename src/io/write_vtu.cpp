// SPDX-License-Identifier: Apache-2.0
// .vtu, of VTK's XML formats.
#include "io/region_names.h"
#include "io/writer.h"

#if INCISE_WITH_VTU

#include "incise/io/base64.h"
#include "io/gzip.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

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
    out_ += ">\n<UnstructuredGrid>\n";
    names();
    out_ += "<Piece NumberOfPoints=\"" + std::to_string(soup.points.size()) + "\" NumberOfCells=\"" +
            std::to_string(n_cells()) + "\">\n<Points>\n";
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

  // Field data: a line such as "3 fat" for each region that has a name, byte by byte: arrays of strings stop meshio.
  void names() {
    std::string lines;
    for (const auto& [region, name] : data_.region_names) lines += to_entry(region, name) + "\n";
    if (lines.empty()) return;
    out_ += "<FieldData>\n<DataArray type=\"UInt8\" Name=\"" + std::string(kVtuNames) + "\" NumberOfTuples=\"" +
            std::to_string(lines.size()) + "\" format=\"ascii\">\n";
    for (const char c : lines) out_ += std::to_string(static_cast<unsigned char>(c)) + (c == '\n' ? "\n" : " ");
    out_ += "</DataArray>\n</FieldData>\n";
  }

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

}  // namespace

std::string write_vtu(const MeshData& data, MshVariant /*variant*/) {
  return VtuWriter(data).run();
}

}  // namespace io
}  // namespace v0
}  // namespace incise

#endif
