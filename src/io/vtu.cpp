// SPDX-License-Identifier: Apache-2.0
// VTU: unstructured grids of VTK's XML family, after "VTK XML Formats" of VTK's documentation. Raw appended data
// are no XML: they are split off before the parser sees the file.
#include "io/reader.h"

#if INCISE_WITH_VTU

#include <algorithm>
#include <bit>
#include <cstring>
#include <pugixml.hpp>
#include <type_traits>

#include "incise/io/base64.h"
#include "io/cells.h"
#include "io/gzip.h"
#include "io/region_names.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

struct VtuType {
  std::string_view name;
  std::size_t bytes;
  char kind;  // i: signed, u: unsigned, f: real
};

constexpr std::array<VtuType, 10> kVtuTypes = {{{"Int8", 1, 'i'},
                                                {"UInt8", 1, 'u'},
                                                {"Int16", 2, 'i'},
                                                {"UInt16", 2, 'u'},
                                                {"Int32", 4, 'i'},
                                                {"UInt32", 4, 'u'},
                                                {"Int64", 8, 'i'},
                                                {"UInt64", 8, 'u'},
                                                {"Float32", 4, 'f'},
                                                {"Float64", 8, 'f'}}};

std::uint64_t load_bits(const char* p, std::size_t n, bool big) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < n; ++i) {
    bits = (bits << 8U) | static_cast<unsigned char>(p[big ? i : n - 1 - i]);
  }
  return bits;
}

template <class T>
T decode(const char* p, const VtuType& type, bool big) {
  const std::uint64_t bits = load_bits(p, type.bytes, big);
  if (type.kind == 'f' && type.bytes == 4) {
    const auto half = static_cast<std::uint32_t>(bits);
    float value = 0;
    std::memcpy(&value, &half, sizeof value);
    return static_cast<T>(value);
  }
  if (type.kind == 'f') {
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return static_cast<T>(value);
  }
  const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
  const bool is_signed = type.kind != 'u' && type.bytes < 8;
  const auto number = static_cast<std::int64_t>(is_signed ? (bits ^ sign) - sign : bits);
  if constexpr (std::is_same_v<T, CellInt>) {
    return to_cell_int(number);
  } else {
    return static_cast<T>(number);
  }
}

// Where the appended section is, if there is one.
struct Appended {
  std::size_t tag = std::string_view::npos;  // of '<'
  std::string_view payload;                  // after '_'
  bool base64 = false;
};

class VtuReader {
 public:
  explicit VtuReader(Job& job) : job_(job), cells_(job) {}

  bool run() {
    if (!split_appended() || !parse() || !read_root()) return false;
    const pugi::xml_node grid = root_.child("UnstructuredGrid");
    if (!grid) {
      return job_.fail("VTKFile of type " + in_quotes(root_.attribute("type").value()) +
                           " holds no tets; Incise reads UnstructuredGrid: mesh the volume first",
                       ErrorCode::kUnsupported);
    }
    read_names(find_array(grid.child("FieldData"), std::string(kVtuNames).c_str()));
    for (const pugi::xml_node piece : grid.children("Piece")) {
      if (!read_piece(piece)) return false;
    }
    cells_.finish_notes();
    job_.out.format_name = std::string("VTU ") + (encoding_.empty() ? "ascii" : encoding_) + (zlib_ ? " zlib" : "");
    return true;
  }

 private:
  bool fail(std::size_t offset, const std::string& what) {
    Cursor(job_.bytes, job_.name, job_.error).fail_at(offset, what);
    return false;
  }
  bool fail(const pugi::xml_node& node, const std::string& what) {
    return fail(static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)), what);
  }

  bool split_appended() {
    appended_.tag = job_.bytes.find("<AppendedData");
    if (appended_.tag == std::string_view::npos) return true;
    const std::size_t close = job_.bytes.find('>', appended_.tag);
    const std::size_t mark = job_.bytes.find('_', close == std::string_view::npos ? job_.bytes.size() : close);
    const std::size_t end = job_.bytes.rfind("</AppendedData");
    if (mark == std::string_view::npos || end == std::string_view::npos || end <= mark) {
      return fail(appended_.tag, "the section AppendedData is cut short");
    }
    const std::string_view tag = job_.bytes.substr(appended_.tag, close - appended_.tag);
    appended_.base64 = tag.find("base64") != std::string_view::npos;
    appended_.payload = job_.bytes.substr(mark + 1, end - mark - 1);
    return true;
  }

  bool parse() {
    xml_.assign(job_.bytes.substr(0, appended_.tag));
    if (appended_.tag != std::string_view::npos) xml_ += "</VTKFile>";
    const auto result = document_.load_buffer_inplace(xml_.data(), xml_.size(), pugi::parse_minimal | pugi::parse_cdata,
                                                      pugi::encoding_utf8);
    if (result) return true;
    return fail(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)),
                std::string("the XML is not well formed: ") + result.description());
  }

  bool read_root() {
    root_ = document_.child("VTKFile");
    if (!root_) return job_.fail("XML without a VTKFile element; Incise reads .vtu", ErrorCode::kUnsupported);
    big_ = std::strcmp(root_.attribute("byte_order").value(), "BigEndian") == 0;
    wide_ = std::strcmp(root_.attribute("header_type").value(), "UInt64") == 0;
    const std::string_view compressor = root_.attribute("compressor").value();
    zlib_ = compressor == "vtkZLibDataCompressor";
    if (compressor.empty() || (zlib_ && has_gzip())) return true;
    return job_.fail(
        "compressor " + in_quotes(compressor) + " is unknown here; save it with zlib or without compression",
        ErrorCode::kUnsupported);
  }

  bool read_count(const pugi::xml_node& piece, const char* name, std::size_t& out) {
    std::int64_t value = 0;
    if (!parse_int(piece.attribute(name).value(), value) || value < 0 || value >= 0xFFFFFFFF) {
      return fail(piece, std::string(name) + " must be a number below 2^32");
    }
    out = static_cast<std::size_t>(value);
    return true;
  }

  bool read_piece(const pugi::xml_node& piece) {
    std::size_t n_points = 0;
    std::size_t n_cells = 0;
    if (!read_count(piece, "NumberOfPoints", n_points) || !read_count(piece, "NumberOfCells", n_cells)) return false;
    const std::size_t first = job_.soup().points.size();
    return read_points(piece, n_points) && read_cells(piece, first, n_points, n_cells) &&
           read_labels(piece.child("CellData"), n_cells, true) &&
           read_labels(piece.child("PointData"), n_points, false);
  }

  // Lines, byte by byte. Other encodings are passed over: names are no geometry.
  void read_names(const pugi::xml_node& array) {
    if (std::strcmp(array.attribute("format").value(), "ascii") != 0) return;
    Error ignored;
    Cursor in(array.child_value(), job_.name, ignored);
    std::string entry;
    for (std::string_view word = in.word(); !word.empty(); word = in.word()) {
      std::int64_t byte = 0;
      if (!parse_int(word, byte) || byte < 0 || byte > 255) return;
      if (byte != '\n') {
        entry += static_cast<char>(byte);
        continue;
      }
      take_entry(entry, job_.out.data.region_names);
      entry.clear();
    }
  }

  bool read_points(const pugi::xml_node& piece, std::size_t n) {
    std::vector<double> flat;
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    if (!array) return fail(piece, "a piece has no Points");
    if (!read_array(array, n * 3, flat)) return false;
    auto& points = job_.soup().points;
    points.reserve(points.size() + n);
    for (std::size_t i = 0; i < n; ++i) points.emplace_back(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]);
    return true;
  }

  static pugi::xml_node find_array(const pugi::xml_node& parent, const char* name) {
    return parent.find_child_by_attribute("DataArray", "Name", name);
  }

  bool read_cells(const pugi::xml_node& piece, std::size_t first, std::size_t n_points, std::size_t n_cells) {
    const pugi::xml_node cells = piece.child("Cells");
    const pugi::xml_node types = find_array(cells, "types");
    const pugi::xml_node offsets = find_array(cells, "offsets");
    const pugi::xml_node connectivity = find_array(cells, "connectivity");
    if (!types || !offsets || !connectivity) {
      // A piece of points only has nothing to cut; other pieces may.
      return n_cells == 0 || fail(piece, "Cells must hold connectivity, offsets and types");
    }
    std::vector<CellInt> type_of;
    std::vector<CellInt> begin;
    std::vector<CellInt> vertex;
    if (!read_array(types, n_cells, type_of) || !read_array(offsets, n_cells, begin)) return false;
    begin.insert(begin.begin(), 0);
    if (begin.back() < 0) return fail(offsets, "the last offset is negative");
    if (!read_array(connectivity, static_cast<std::size_t>(begin.back()), vertex)) return false;
    return cells_.add(type_of, begin, vertex, first, n_points);
  }

  bool read_labels(const pugi::xml_node& data, std::size_t n, bool of_cells) {
    for (const pugi::xml_node array : data.children("DataArray")) {
      const std::string_view name = array.attribute("Name").value();
      if (!(of_cells ? CellSorter::wants_cell_array(name) : CellSorter::wants_point_array(name))) continue;
      if (array.attribute("NumberOfComponents").as_int(1) != 1) continue;
      std::vector<double> values;
      if (!read_array(array, n, values)) return false;
      of_cells ? cells_.label_cells(name, values) : cells_.label_points(name, values);
    }
    return true;
  }

  const VtuType* scalar_type(const pugi::xml_node& array) {
    const std::string_view name = array.attribute("type").value();
    const auto found =
        std::find_if(kVtuTypes.begin(), kVtuTypes.end(), [name](const VtuType& t) { return t.name == name; });
    if (found != kVtuTypes.end()) return &*found;
    fail(array, "type " + in_quotes(name) + " of a DataArray is unknown");
    return nullptr;
  }

  // Exactly `n` numbers.
  template <class T>
  bool read_array(const pugi::xml_node& array, std::size_t n, std::vector<T>& out) {
    const VtuType* type = scalar_type(array);
    if (type == nullptr) return false;
    if (std::is_integral_v<T> && type->kind == 'f') return fail(array, "numbers of cells must be integers");
    const std::string_view format = array.attribute("format").value();
    const std::string_view text = array.child_value();
    if (format != "ascii")
      encoding_ = format == "appended" ? (appended_.base64 ? "appended base64" : "appended raw") : "base64";
    if (format == "ascii" || format.empty()) return read_ascii(array, text, n, out);
    if (format == "binary") return read_binary(array, ByteSource(text, true), true, n, *type, out);
    if (format != "appended") return fail(array, "format " + in_quotes(format) + " of a DataArray is unknown");
    std::int64_t offset = 0;
    if (!parse_int(array.attribute("offset").value(), offset) || offset < 0 ||
        static_cast<std::uint64_t>(offset) > appended_.payload.size()) {
      return fail(array, "offset lies outside the section AppendedData");
    }
    const auto rest = appended_.payload.substr(static_cast<std::size_t>(offset));
    return read_binary(array, ByteSource(rest, appended_.base64), false, n, *type, out);
  }

  template <class T>
  bool read_ascii(const pugi::xml_node& array, std::string_view text, std::size_t n, std::vector<T>& out) {
    if (n > (text.size() + 1) / 2) return fail_size(array, n);
    Error error;
    Cursor in(text, job_.name, error);
    out.resize(n);
    for (T& value : out) {
      const std::string_view word = in.word();
      if (word.empty()) return fail_size(array, n);
      if (!parse_value(word, value)) {
        return fail(static_cast<std::size_t>(word.data() - xml_.data()),
                    in_quotes(word) + " is no number of that type");
      }
    }
    return !in.skip_space() || fail_size(array, n);
  }
  static bool parse_value(std::string_view word, double& out) { return parse_double(word, out); }
  static bool parse_value(std::string_view word, CellInt& out) {
    std::int64_t wide = 0;
    const bool is_number = parse_int(word, wide);
    out = to_cell_int(wide);
    return is_number;
  }

  bool fail_size(const pugi::xml_node& array, std::size_t n) {
    return fail(array, "DataArray " + in_quotes(array.attribute("Name").value()) + " must hold " + std::to_string(n) +
                           " numbers, and does not: the counts of the piece or the data are wrong");
  }

  bool read_header(ByteSource& source, std::uint64_t& out) {
    std::array<char, 8> raw = {};
    const std::size_t n = wide_ ? 8 : 4;
    if (!source.read(raw.data(), n)) return false;
    out = load_bits(raw.data(), n, big_);
    return true;
  }

  // `is_alone`: the text is this array's and nothing else's.
  template <class T>
  bool read_binary(const pugi::xml_node& array, ByteSource source, bool is_alone, std::size_t n, const VtuType& type,
                   std::vector<T>& out) {
    std::string raw;
    const std::size_t bytes = n * type.bytes;
    const bool got = zlib_ ? read_blocks(source, bytes, raw) : read_plain(source, bytes, raw);
    if (!got || (is_alone && !source.is_at_end())) return fail_size(array, n);
    out.resize(n);
    for (std::size_t i = 0; i < n; ++i) out[i] = decode<T>(raw.data() + i * type.bytes, type, big_);
    return true;
  }

  bool read_plain(ByteSource& source, std::size_t bytes, std::string& raw) {
    std::uint64_t announced = 0;
    if (!read_header(source, announced)) return bytes == 0;
    if (announced != bytes || bytes > source.remaining()) return false;
    raw.resize(bytes);
    return source.read(raw.data(), bytes);
  }

  // Header: number of blocks, size of a block, size of the last if it is shorter, then compressed sizes.
  bool read_blocks(ByteSource& source, std::size_t bytes, std::string& raw) {
    std::uint64_t n_blocks = 0;
    std::uint64_t size = 0;
    std::uint64_t last = 0;
    if (!read_header(source, n_blocks)) return bytes == 0;
    if (n_blocks == 0) return bytes == 0;
    if (!read_header(source, size) || !read_header(source, last)) return false;
    const std::uint64_t full = n_blocks - (last > 0 ? 1 : 0);
    if (n_blocks > source.remaining() / (wide_ ? 8 : 4) || last > size) return false;
    if (size == 0 || (full > 0 && size > bytes / full) || full * size + last != bytes) return false;
    if (bytes / kMaxInflation > source.remaining()) return false;
    std::vector<std::uint64_t> packed(n_blocks);
    for (std::uint64_t& p : packed) {
      if (!read_header(source, p)) return false;
    }
    raw.resize(bytes);
    std::string block;
    for (std::size_t b = 0; b < n_blocks; ++b) {
      if (packed[b] > source.remaining()) return false;
      block.resize(packed[b]);
      const std::size_t length = b < full ? size : last;
      if (!source.read(block.data(), block.size()) || !inflate_to(block, raw.data() + b * size, length)) return false;
    }
    return true;
  }

  Job& job_;
  CellSorter cells_;
  Appended appended_;
  std::string xml_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  std::string encoding_;
  bool big_ = false;
  bool wide_ = false;
  bool zlib_ = false;
};

}  // namespace

bool read_vtu(Job& job) {
  return VtuReader(job).run();
}

}  // namespace io
}  // namespace v0
}  // namespace incise

#else

namespace incise {
inline namespace v0 {
namespace io {

bool read_vtu(Job& job) {
  return job.fail("this build reads no VTU; convert it to .mesh or .msh", ErrorCode::kUnsupported);
}

}  // namespace io
}  // namespace v0
}  // namespace incise

#endif
