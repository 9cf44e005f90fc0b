// SPDX-License-Identifier: Apache-2.0
// PLY after Greg Turk's description of the format; tets are lists of an element of their own, as OpenSurgSim has them.
#include "io/ply.h"

#include <algorithm>
#include <cstring>

#include "io/reader.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

struct ScalarType {
  std::string_view name;
  std::string_view other_name;
  std::size_t bytes;
  char kind;  // i: signed, u: unsigned, f: real
};

constexpr std::array<ScalarType, 9> kScalarTypes = {{{"char", "int8", 1, 'i'},
                                                     {"uchar", "uint8", 1, 'u'},
                                                     {"short", "int16", 2, 'i'},
                                                     {"ushort", "uint16", 2, 'u'},
                                                     {"int", "int32", 4, 'i'},
                                                     {"uint", "uint32", 4, 'u'},
                                                     {"float", "float32", 4, 'f'},
                                                     {"double", "float64", 8, 'f'},
                                                     {"unsigned int", "uint32_t", 4, 'u'}}};

struct Property {
  std::string name;
  const ScalarType* count = nullptr;  // of a list's length; null for a scalar
  const ScalarType* type = nullptr;
};

struct Element {
  std::string name;
  std::int64_t n = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name, Error& error, PlyContent& out)
      : in_(bytes, name, error), out_(out) {}

  bool run() {
    if (!header()) return false;
    for (const Element& element : elements_) {
      if (!read(element)) return false;
    }
    return true;
  }

 private:
  bool header() {
    in_.line();  // ply
    while (in_.skip_space()) {
      const std::string_view keyword = in_.word_in_line();
      if (keyword == "end_header") {
        in_.line();
        binary_ = out_.format != "ascii";
        big_ = out_.format == "binary_big_endian";
        if (binary_) in_.set_binary();
        return true;
      }
      if (keyword == "format" && !format()) return false;
      if (keyword == "element" && !element()) return false;
      if (keyword == "property" && !property()) return false;
      in_.line();  // what is left, or a comment
    }
    return in_.fail("the header does not end");
  }

  bool format() {
    out_.format = in_.word_in_line();
    return out_.format == "ascii" || out_.format == "binary_little_endian" || out_.format == "binary_big_endian" ||
           in_.fail("format must be ascii, binary_little_endian or binary_big_endian");
  }

  bool element() {
    Element& e = elements_.emplace_back();
    e.name = in_.word_in_line();
    if (!in_.integer_in_line(e.n, "number of elements")) return false;
    return e.n >= 0 || in_.fail("number of elements is negative");
  }

  const ScalarType* type(std::string_view name) {
    const auto found = std::find_if(kScalarTypes.begin(), kScalarTypes.end(),
                                    [name](const ScalarType& t) { return t.name == name || t.other_name == name; });
    if (found != kScalarTypes.end()) return &*found;
    in_.fail("type " + in_quotes(name) + " of a property is unknown");
    return nullptr;
  }

  bool property() {
    if (elements_.empty()) return in_.fail("a property comes before any element");
    Property& p = elements_.back().properties.emplace_back();
    std::string_view word = in_.word_in_line();
    if (word == "list") {
      p.count = type(in_.word_in_line());
      if (p.count == nullptr) return false;
      if (p.count->kind == 'f') return in_.fail("a list's length must be an integer");
      word = in_.word_in_line();
    }
    p.type = type(word);
    p.name = in_.word_in_line();
    return p.type != nullptr;
  }

  static bool is_tet_element(std::string_view name) {
    return name == "3d_element" || name == "tet" || name == "tets" || name == "tetrahedron" || name == "tetrahedra" ||
           name == "cell";
  }

  // The least that a row can take.
  [[nodiscard]] std::size_t row_bytes(const Element& e) const {
    std::size_t bytes = 0;
    for (const Property& p : e.properties) bytes += binary_ ? (p.count != nullptr ? p.count : p.type)->bytes : 2;
    return bytes;
  }

  bool read(const Element& e) {
    const std::size_t least = row_bytes(e);
    if (least == 0) return e.n == 0 || in_.fail("element " + in_quotes(e.name) + " has no properties");
    if (static_cast<std::uint64_t>(e.n) > (in_.remaining() + 1) / least) {
      return in_.fail("element " + in_quotes(e.name) + " announces more rows than the rest of the file can hold");
    }
    if (is_tet_element(e.name)) out_.has_tets = true;
    for (std::int64_t i = 0; i < e.n; ++i) {
      if (!binary_ && !in_.skip_space()) return in_.fail("the file ends too early");
      if (!row(e)) return false;
      if (!binary_ && !in_.end_line("row")) return false;
    }
    return true;
  }

  bool row(const Element& e) {
    Vec3 p(0, 0, 0);
    for (const Property& property : e.properties) {
      if (property.count != nullptr) {
        if (!list(property) || !keep_list(e, property)) return false;
        continue;
      }
      const bool coordinate = property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
      double value = 0;
      if (!(coordinate ? number(*property.type, value) : skip_number(*property.type))) return false;
      if (coordinate) p[property.name[0] - 'x'] = value;
    }
    if (e.name == "vertex") out_.points.push_back(p);
    return true;
  }

  bool number(const ScalarType& type, double& out) {
    if (!binary_) return in_.real_in_line(out, "number");
    if (in_.remaining() < type.bytes) return in_.fail("the file ends too early");
    std::uint64_t bits = 0;
    const char* p = in_.bytes().data() + in_.position();
    for (std::size_t i = 0; i < type.bytes; ++i) {
      bits = (bits << 8U) | static_cast<unsigned char>(p[big_ ? i : type.bytes - 1 - i]);
    }
    in_.seek(in_.position() + type.bytes);
    out = decode(bits, type);
    return true;
  }

  // Properties of no use here may be NaN.
  bool skip_number(const ScalarType& type) {
    double ignored = 0;
    if (binary_) return number(type, ignored);
    return !in_.word_in_line().empty() || in_.fail("number missing: the row ends too early");
  }

  static double decode(std::uint64_t bits, const ScalarType& type) {
    if (type.kind == 'f' && type.bytes == 4) {
      const auto half = static_cast<std::uint32_t>(bits);
      float value = 0;
      std::memcpy(&value, &half, sizeof value);
      return static_cast<double>(value);
    }
    if (type.kind == 'f') {
      double value = 0;
      std::memcpy(&value, &bits, sizeof value);
      return value;
    }
    if (type.kind == 'u') return static_cast<double>(bits);
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
    return static_cast<double>(static_cast<std::int64_t>((bits ^ sign) - sign));
  }

  bool list(const Property& property) {
    double n = 0;
    if (!number(*property.count, n)) return false;
    const double most =
        static_cast<double>(in_.remaining() + 1) / (binary_ ? static_cast<double>(property.type->bytes) : 2);
    if (!(n >= 0) || n > most || n != static_cast<double>(static_cast<std::int64_t>(n))) {
      return in_.fail("a list's length is wrong");
    }
    list_.resize(static_cast<std::size_t>(n));
    for (double& value : list_) {
      if (!number(*property.type, value)) return false;
    }
    return true;
  }

  bool index(double value, std::uint32_t& out) {
    if (value >= 0 && value < static_cast<double>(out_.points.size()) &&
        value == static_cast<double>(static_cast<std::int64_t>(value))) {
      out = static_cast<std::uint32_t>(value);
      return true;
    }
    return in_.fail("a vertex number is not below the number of vertices, " + std::to_string(out_.points.size()));
  }

  bool keep_list(const Element& e, const Property& property) {
    const bool vertices = property.name == "vertex_indices" || property.name == "vertex_index";
    if (is_tet_element(e.name) && (vertices || e.properties.size() == 1)) {
      if (list_.size() != 4) return in_.fail("a tet must list 4 vertices, not " + std::to_string(list_.size()));
      auto& tet = out_.tets.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) {
        if (!index(list_[k], tet[k])) return false;
      }
    }
    if (e.name != "face" || !vertices) return true;
    if (list_.size() < 3) return in_.fail("a face must list at least 3 vertices");
    for (std::size_t k = 2; k < list_.size(); ++k) {
      auto& triangle = out_.triangles.emplace_back();
      if (!index(list_[0], triangle[0]) || !index(list_[k - 1], triangle[1]) || !index(list_[k], triangle[2])) {
        return false;
      }
    }
    return true;
  }

  Cursor in_;
  PlyContent& out_;
  std::vector<Element> elements_;
  std::vector<double> list_;
  bool binary_ = false;
  bool big_ = false;
};

// The file with line feeds in its header, where that ends its lines in carriage returns alone and binary rows follow;
// else nothing.
std::string with_lines_in_header(std::string_view bytes) {
  constexpr std::string_view kEnd = "end_header\r";
  if (!bytes.starts_with("ply\r") || bytes.starts_with("ply\r\n")) return {};
  const std::size_t at = bytes.find(kEnd);
  if (at == std::string_view::npos) return {};
  const std::size_t length = at + kEnd.size();
  return with_line_feeds(bytes.substr(0, length)) + std::string(bytes.substr(length));
}

}  // namespace

bool read_ply(std::string_view bytes, const std::string& name, Error& error, PlyContent& out) {
  const std::string converted = with_lines_in_header(bytes);
  return PlyReader(converted.empty() ? bytes : converted, name, error, out).run();
}

bool read_ply_tets(Job& job) {
  PlyContent content;
  if (!read_ply(job.bytes, job.name, job.error, content)) return false;
  if (!content.has_tets) {
    return job.fail("this PLY holds a surface, without an element for tets; fill it with incise mesh",
                    ErrorCode::kUnsupported);
  }
  job.out.format_name = "PLY with tets, " + content.format;
  job.soup().points = std::move(content.points);
  job.soup().tets = std::move(content.tets);
  job.out.data.triangles = std::move(content.triangles);
  return true;
}

}  // namespace io
}  // namespace v0
}  // namespace incise
