// SPDX-License-Identifier: Apache-2.0
// Legacy VTK 2.0 to 5.1, ASCII and binary (big endian), after "VTK File Formats" of the VTK user's guide.
#include <algorithm>
#include <cstring>
#include <type_traits>

#include "io/cells.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

enum class Kind : std::uint8_t { kSigned, kUnsigned, kReal, kBit, kString };

struct TypeInfo {
  std::string_view name;
  std::size_t bytes;
  Kind kind;
};

constexpr std::array<TypeInfo, 17> kTypes = {{{"bit", 1, Kind::kBit},
                                              {"char", 1, Kind::kSigned},
                                              {"signed_char", 1, Kind::kSigned},
                                              {"unsigned_char", 1, Kind::kUnsigned},
                                              {"short", 2, Kind::kSigned},
                                              {"unsigned_short", 2, Kind::kUnsigned},
                                              {"int", 4, Kind::kSigned},
                                              {"unsigned_int", 4, Kind::kUnsigned},
                                              {"vtkidtype", 4, Kind::kSigned},
                                              {"long", 8, Kind::kSigned},
                                              {"unsigned_long", 8, Kind::kUnsigned},
                                              {"vtktypeint64", 8, Kind::kSigned},
                                              {"vtktypeuint64", 8, Kind::kUnsigned},
                                              {"float", 4, Kind::kReal},
                                              {"double", 8, Kind::kReal},
                                              {"vtktypeint32", 4, Kind::kSigned},
                                              {"string", 1, Kind::kString}}};

// One big-endian number of a binary file.
template <class T>
T decode(const char* p, const TypeInfo& type) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < type.bytes; ++i) bits = (bits << 8U) | static_cast<unsigned char>(p[i]);
  if (type.kind == Kind::kReal && type.bytes == 4) {
    const auto half = static_cast<std::uint32_t>(bits);
    float value = 0;
    std::memcpy(&value, &half, sizeof value);
    return static_cast<T>(value);
  }
  if (type.kind == Kind::kReal) {
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return static_cast<T>(value);
  }
  const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
  const bool is_signed = type.kind != Kind::kUnsigned && type.bytes < 8;
  const auto number = static_cast<std::int64_t>(is_signed ? (bits ^ sign) - sign : bits);
  if constexpr (std::is_same_v<T, CellInt>) {
    return to_cell_int(number);
  } else {
    return static_cast<T>(number);
  }
}

/// The numbers of a file, as text or bytes.
class VtkNumbers {
 public:
  explicit VtkNumbers(Cursor& in) : in_(in) {}

  void set_binary() {
    binary_ = true;
    in_.set_binary();
  }
  [[nodiscard]] bool is_binary() const { return binary_; }

  // A count; `check_size` compares it with the rest of the file once the type is known.
  bool size(std::int64_t& n, const char* what) {
    if (!in_.integer(n, what)) return false;
    return (n >= 0 && n < (std::int64_t{1} << 40U)) || in_.fail(std::string(what) + " is " + std::to_string(n));
  }

  const TypeInfo* type(std::string_view name) {
    const auto found =
        std::find_if(kTypes.begin(), kTypes.end(), [name](const TypeInfo& t) { return same_word(t.name, name); });
    if (found != kTypes.end()) return &*found;
    in_.fail("data type " + in_quotes(name) + " is unknown");
    return nullptr;
  }

  bool check_size(std::size_t n, const TypeInfo& type) {
    const std::size_t most = binary_ ? in_.remaining() / type.bytes : (in_.remaining() + 1) / 2;
    if (n <= most) return true;
    return in_.fail(std::to_string(n) + " numbers are announced, more than the rest of the file can hold");
  }

  // `n` numbers in the file's encoding; binary ones begin after the line end.
  template <class T>
  bool values(std::size_t n, const TypeInfo& type, std::vector<T>& out) {
    if (std::is_integral_v<T> && type.kind == Kind::kReal) return in_.fail("numbers of cells must be integers");
    if (binary_ && !in_.at_line_end()) return in_.fail("binary data must begin on a new line");
    if (binary_) in_.line();
    if (!check_size(n, type)) return false;
    out.resize(n);
    if (binary_) {
      for (std::size_t i = 0; i < n; ++i) {
        out[i] = decode<T>(in_.bytes().data() + in_.position() + i * type.bytes, type);
      }
      in_.seek(in_.position() + n * type.bytes);
      return true;
    }
    for (T& value : out) {
      if (!ascii_value(value)) return false;
    }
    return true;
  }

  // Arrays of no use here may hold anything, NaN included.
  bool skip_values(std::size_t n, const TypeInfo& type) {
    if (type.kind == Kind::kString) return skip_strings(n);
    if (!binary_) return skip_words(n, type);
    const std::size_t bytes = type.kind == Kind::kBit ? (n + 7) / 8 : n * type.bytes;
    in_.line();
    if (bytes > in_.remaining()) return check_size(n, type) && in_.fail("the file ends within an array");
    in_.seek(in_.position() + bytes);
    return true;
  }

 private:
  bool ascii_value(double& out) { return in_.real(out, "number"); }
  bool ascii_value(CellInt& out) {
    std::int64_t wide = 0;
    const bool is_number = in_.integer(wide, "integer");
    out = to_cell_int(wide);
    return is_number;
  }

  bool skip_words(std::size_t n, const TypeInfo& type) {
    if (!check_size(n, type)) return false;
    for (std::size_t i = 0; i < n; ++i) {
      if (in_.word().empty()) return in_.fail("the file ends within an array");
    }
    return true;
  }

  bool skip_strings(std::size_t n) {
    if (binary_) return in_.fail("binary arrays of strings are not understood; remove them");
    in_.line();
    for (std::size_t i = 0; i < n && in_.remaining() > 0; ++i) in_.line();
    return true;
  }

  Cursor& in_;
  bool binary_ = false;
};

class VtkReader {
 public:
  explicit VtkReader(Job& job) : job_(job), in_(job.bytes, job.name, job.error), cells_(job) {}

  bool run() {
    if (!header()) return false;
    while (in_.skip_space()) {
      if (!section(in_.word())) return false;
    }
    if (offsets_.empty() || types_.empty()) return in_.fail("the sections CELLS and CELL_TYPES must both be there");
    if (!sorted_ && !sort_cells()) return false;
    cells_.finish_notes();
    return true;
  }

 private:
  bool header() {
    const std::string_view first = trim(in_.line());
    const std::size_t space = first.rfind(' ');
    const std::string version(space == std::string_view::npos ? "" : first.substr(space + 1));
    in_.line();  // title
    const std::string_view encoding = trim(in_.line());
    if (same_word(encoding, "BINARY")) {
      numbers_.set_binary();
    } else if (!same_word(encoding, "ASCII")) {
      return in_.fail("line 3 must be ASCII or BINARY");
    }
    job_.out.format_name = "legacy VTK " + version.substr(0, 8) + (numbers_.is_binary() ? " binary" : " ASCII");
    double number = 0;
    if (!parse_double(version, number) || number < 1 || number >= 6) return in_.fail("version must be 2.0 to 5.1");
    return true;
  }

  bool section(std::string_view keyword) {
    if (same_word(keyword, "DATASET")) return dataset();
    if (same_word(keyword, "POINTS")) return points();
    if (same_word(keyword, "CELLS")) return cells();
    if (same_word(keyword, "CELL_TYPES")) return cell_types();
    if (same_word(keyword, "CELL_DATA")) return begin_data(true);
    if (same_word(keyword, "POINT_DATA")) return begin_data(false);
    if (same_word(keyword, "FIELD")) return field();
    if (same_word(keyword, "METADATA")) return metadata();
    return attribute(keyword);
  }

  bool dataset() {
    const std::string_view kind = in_.word();
    if (same_word(kind, "UNSTRUCTURED_GRID")) return true;
    return job_.fail("DATASET " + std::string(kind.substr(0, 30)) +
                         " holds no tets; Incise reads UNSTRUCTURED_GRID: mesh the volume first",
                     ErrorCode::kUnsupported);
  }

  bool points() {
    std::int64_t n = 0;
    if (!job_.soup().points.empty()) return in_.fail("there are two POINTS sections");
    if (!numbers_.size(n, "number of points")) return false;
    const TypeInfo* t = numbers_.type(in_.word());
    if (t == nullptr) return false;
    std::vector<double> flat;
    if (!numbers_.values(static_cast<std::size_t>(n) * 3, *t, flat)) return false;
    auto& out = job_.soup().points;
    out.resize(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
    return true;
  }

  bool cells() {
    std::int64_t n = 0;
    std::int64_t total = 0;
    if (!offsets_.empty()) return in_.fail("there are two CELLS sections");
    if (!numbers_.size(n, "number of cells") || !numbers_.size(total, "size of the cells")) return false;
    const std::size_t here = in_.position();
    in_.line();
    const bool split = same_word(in_.peek().substr(0, 7), "OFFSETS");
    if (split) return split_cells(static_cast<std::size_t>(n), static_cast<std::size_t>(total));
    in_.seek(here);
    std::vector<CellInt> flat;
    if (!numbers_.values(static_cast<std::size_t>(total), kTypes[6], flat)) return false;
    return unpack_cells(static_cast<std::size_t>(n), flat);
  }

  // Version 5: OFFSETS type, n offsets, CONNECTIVITY type, indices.
  bool split_cells(std::size_t n, std::size_t total) {
    in_.word();
    const TypeInfo* t = numbers_.type(in_.word());
    if (t == nullptr || !numbers_.values(n, *t, offsets_)) return false;
    if (!same_word(in_.word(), "CONNECTIVITY")) return in_.fail("expected CONNECTIVITY");
    t = numbers_.type(in_.word());
    return t != nullptr && numbers_.values(total, *t, connectivity_);
  }

  // Before version 5: a count and that many indices per cell. The counts are squeezed out in place.
  bool unpack_cells(std::size_t n, std::vector<CellInt>& flat) {
    std::size_t from = 0;
    std::size_t to = 0;
    offsets_.reserve(n + 1);
    offsets_.push_back(0);
    for (std::size_t c = 0; c < n; ++c) {
      const CellInt nodes = from < flat.size() ? flat[from++] : -1;
      if (nodes < 0 || static_cast<std::uint64_t>(nodes) > flat.size() - from) {
        return in_.fail("cell " + std::to_string(c) + " runs past the end of CELLS: the size in its header is wrong");
      }
      for (CellInt k = 0; k < nodes; ++k) flat[to++] = flat[from++];
      offsets_.push_back(static_cast<CellInt>(to));
    }
    if (from != flat.size()) return in_.fail("CELLS holds more numbers than its cells use");
    flat.resize(to);
    connectivity_ = std::move(flat);
    return true;
  }

  bool cell_types() {
    std::int64_t n = 0;
    if (!types_.empty()) return in_.fail("there are two CELL_TYPES sections");
    return numbers_.size(n, "number of cell types") && numbers_.values(static_cast<std::size_t>(n), kTypes[6], types_);
  }

  bool sort_cells() {
    sorted_ = true;
    const std::size_t n = job_.soup().points.size();
    return cells_.add(types_, offsets_, connectivity_, 0, n);
  }

  bool begin_data(bool of_cells) {
    std::int64_t n = 0;
    of_cells_ = of_cells;
    if (!numbers_.size(n, "number of values")) return false;
    n_data_ = static_cast<std::size_t>(n);
    if (offsets_.empty() || types_.empty()) return in_.fail("data come before CELLS and CELL_TYPES");
    if (!sorted_ && !sort_cells()) return false;
    const std::size_t expected = of_cells ? types_.size() : job_.soup().points.size();
    return n_data_ == expected || in_.fail("there are " + std::to_string(n_data_) + " values for " +
                                           std::to_string(expected) + (of_cells ? " cells" : " points"));
  }

  // Reads an array; keeps it where its name says that it is of use.
  bool array(const std::string& name, std::size_t components, std::size_t tuples, const TypeInfo& type) {
    if (components > 1000 || tuples > in_.remaining()) return in_.fail("array " + in_quotes(name) + " is too large");
    const bool wanted =
        n_data_ > 0 && (of_cells_ ? CellSorter::wants_cell_array(name) : CellSorter::wants_point_array(name));
    if (!wanted || components != 1 || tuples != n_data_ || type.kind == Kind::kBit || type.kind == Kind::kString) {
      return numbers_.skip_values(components * tuples, type);
    }
    std::vector<double> got;
    if (!numbers_.values(tuples, type, got)) return false;
    of_cells_ ? cells_.label_cells(name, got) : cells_.label_points(name, got);
    return true;
  }

  bool field() {
    std::int64_t n = 0;
    in_.word();
    if (!numbers_.size(n, "number of arrays")) return false;
    for (std::int64_t i = 0; i < n; ++i) {
      const std::string name(in_.word());
      if (same_word(name, "METADATA")) {
        if (!metadata()) return false;
        --i;
        continue;
      }
      std::int64_t components = 0;
      std::int64_t tuples = 0;
      if (!numbers_.size(components, "number of components") || !numbers_.size(tuples, "number of tuples"))
        return false;
      const TypeInfo* t = numbers_.type(in_.word());
      if (t == nullptr || !array(name, static_cast<std::size_t>(components), static_cast<std::size_t>(tuples), *t)) {
        return false;
      }
    }
    return true;
  }

  // Runs to the next empty line.
  bool metadata() {
    in_.line();
    while (in_.remaining() > 0 && !trim(in_.line()).empty()) {
    }
    return true;
  }

  bool attribute(std::string_view keyword) {
    const std::string name(in_.word_in_line());
    if (same_word(keyword, "SCALARS")) return scalars(name);
    if (same_word(keyword, "LOOKUP_TABLE")) return lookup_table();
    if (same_word(keyword, "COLOR_SCALARS")) {
      std::int64_t n = 0;
      if (!numbers_.size(n, "number of components")) return false;
      return array("", static_cast<std::size_t>(n), n_data_, numbers_.is_binary() ? kTypes[3] : kTypes[13]);
    }
    if (same_word(keyword, "VECTORS") || same_word(keyword, "NORMALS")) return typed_array(name, 3);
    if (same_word(keyword, "TENSORS")) return typed_array(name, 9);
    if (same_word(keyword, "TENSORS6")) return typed_array(name, 6);
    if (same_word(keyword, "GLOBAL_IDS") || same_word(keyword, "PEDIGREE_IDS")) return typed_array(name, 1);
    if (same_word(keyword, "TEXTURE_COORDINATES")) {
      std::int64_t n = 0;
      return numbers_.size(n, "number of components") && typed_array(name, static_cast<std::size_t>(n));
    }
    return in_.fail("keyword " + in_quotes(keyword) + " is unknown, or the numbers before it are more than announced");
  }

  bool typed_array(const std::string& name, std::size_t components) {
    const TypeInfo* t = numbers_.type(in_.word());
    return t != nullptr && array(name, components, n_data_, *t);
  }

  // SCALARS name type [components], then usually LOOKUP_TABLE name.
  bool scalars(const std::string& name) {
    const TypeInfo* t = numbers_.type(in_.word_in_line());
    std::int64_t components = 1;
    if (t == nullptr || (!in_.at_line_end() && !in_.integer_in_line(components, "number of components"))) return false;
    if (components < 1 || components > 4) return in_.fail("SCALARS must have 1 to 4 components");
    const std::size_t here = in_.position();
    in_.line();
    if (same_word(in_.peek(), "LOOKUP_TABLE")) {
      in_.word();
      in_.word();
    } else {
      in_.seek(here);
    }
    return array(name, static_cast<std::size_t>(components), n_data_, *t);
  }

  bool lookup_table() {
    std::int64_t n = 0;
    if (!numbers_.size(n, "size of the table")) return false;
    return numbers_.skip_values(static_cast<std::size_t>(n) * 4, numbers_.is_binary() ? kTypes[3] : kTypes[13]);
  }

  Job& job_;
  Cursor in_;
  VtkNumbers numbers_{in_};
  CellSorter cells_;
  bool of_cells_ = false;
  bool sorted_ = false;
  std::size_t n_data_ = 0;
  std::vector<CellInt> types_;
  std::vector<CellInt> offsets_;
  std::vector<CellInt> connectivity_;
};

}  // namespace

bool read_vtk(Job& job) {
  return VtkReader(job).run();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
