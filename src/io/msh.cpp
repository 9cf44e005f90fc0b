// SPDX-License-Identifier: Apache-2.0
// Gmsh MSH 1.0, 2.x and 4.1, ASCII and binary, after the format chapter of the Gmsh reference manual.
#include <algorithm>
#include <bit>
#include <cstring>
#include <map>

#include "incise/core/id.h"
#include "io/reader.h"
#include "io/region_names.h"
#include "io/writer.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

constexpr int kTriangle = 2;
constexpr int kTet = 4;
constexpr int kTet10 = 11;

// Nodes per element type 0 to 31; 0 where the type does not exist.
constexpr std::array<std::uint8_t, 32> kNodesOfType = {0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                                       8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};

// What elements that are left out are called; empty for points and lines, which nobody misses.
constexpr std::array<std::string_view, 32> kKindOfType = {"",
                                                          "",
                                                          "",
                                                          "quadrilaterals",
                                                          "",
                                                          "hexahedra",
                                                          "prisms",
                                                          "pyramids",
                                                          "",
                                                          "triangles6",
                                                          "quadrilaterals9",
                                                          "",
                                                          "hexahedra27",
                                                          "prisms18",
                                                          "pyramids14",
                                                          "",
                                                          "quadrilaterals8",
                                                          "hexahedra20",
                                                          "prisms15",
                                                          "pyramids13",
                                                          "triangles9",
                                                          "triangles10",
                                                          "triangles12",
                                                          "triangles15",
                                                          "triangles15",
                                                          "triangles21",
                                                          "",
                                                          "",
                                                          "",
                                                          "",
                                                          "",
                                                          ""};

std::size_t nodes_of(std::int64_t type) {
  return type >= 0 && type < 32 ? kNodesOfType[static_cast<std::size_t>(type)] : 0;
}
bool is_tet(std::int64_t type) {
  return type == kTet || type == kTet10 || (type >= 29 && type <= 31);
}

// One code path for ASCII and binary: integers, sizes and reals of a row, and its end.
class Source {
 public:
  explicit Source(Job& job) : text(job.bytes, job.name, job.error) {}

  Cursor text;
  bool binary = false;
  bool swap = false;
  std::size_t size_bytes = 8;

  bool begin_row() { return binary || text.skip_space() || text.fail("the file ends too early"); }
  bool end_row() { return binary || text.end_line("row"); }

  bool integer(std::int64_t& out, const char* what) {
    if (!binary) return text.integer_in_line(out, what);
    std::int32_t raw = 0;
    if (!take(raw, what)) return false;
    out = raw;
    return true;
  }
  bool size(std::int64_t& out, const char* what) {
    if (!binary) return text.integer_in_line(out, what);
    if (size_bytes == 4) return integer(out, what);
    return take(out, what);
  }
  bool real(double& out, const char* what) { return binary ? take(out, what) : text.real_in_line(out, what); }

  // Bounding boxes hold numbers beyond the largest double, other people's data NaN.
  bool skip_real(const char* what) {
    if (binary) return skip(8);
    return !text.word_in_line().empty() || fail(std::string(what) + " missing: the row ends too early");
  }

  // A number of rows that the rest of the file can hold.
  bool fits(std::int64_t n, std::size_t ascii_bytes, std::size_t binary_bytes, const char* what) {
    const std::size_t each = binary ? binary_bytes : ascii_bytes;
    if (n >= 0 && static_cast<std::uint64_t>(n) <= (text.remaining() + 1) / each) return true;
    return fail(std::string(what) + " is " + std::to_string(n) + ", more than the rest of the file can hold");
  }
  bool skip(std::size_t n) {
    if (n > text.remaining()) return fail("the file ends too early");
    text.seek(text.position() + n);
    return true;
  }
  bool fail(const std::string& what) { return text.fail(what); }

 private:
  template <class T>
  bool take(T& out, const char* what) {
    if (text.remaining() < sizeof(T)) return fail(std::string(what) + " missing: the file ends too early");
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), text.bytes().data() + text.position(), sizeof(T));
    if (swap) std::reverse(raw.begin(), raw.end());
    std::memcpy(&out, raw.data(), sizeof(T));
    text.seek(text.position() + sizeof(T));
    return true;
  }
};

/// The mesh of a file as far as it is read, and what all of its sections need.
struct MshMesh {
  explicit MshMesh(Job& given) : job(given), in(given) {}

  void name_format(const char* number) {
    job.out.format_name = std::string("Gmsh MSH ") + number + (in.binary ? " binary" : " ASCII");
  }

  // The line of a count, with what the rest of the file can hold.
  bool count_line(std::int64_t& n, std::size_t ascii_bytes, std::size_t binary_bytes, const char* what) {
    // Versions 1 and 2 write counts as text in binary files too.
    if (!in.text.integer(n, what)) return false;
    in.text.line();
    return in.fits(n, ascii_bytes, binary_bytes, what);
  }

  bool coordinates(Vec3& p) {
    return in.real(p[0], "coordinate") && in.real(p[1], "coordinate") && in.real(p[2], "coordinate");
  }

  bool seal_nodes() {
    if (node_ids.seal()) return true;
    return in.fail("node number " + std::to_string(node_ids.repeated()) + " is there twice");
  }

  bool node(std::uint32_t& out, bool wide) {
    std::int64_t id = 0;
    if (!(wide ? in.size(id, "node number") : in.integer(id, "node number"))) return false;
    out = node_ids.find(id);
    return out != kInvalidIndex || in.fail("node number " + std::to_string(id) + " is not among the nodes");
  }

  // The nodes of one element of a known type; tets and triangles are kept.
  bool element(std::int64_t id, std::int64_t type, std::int64_t label, bool wide) {
    const std::size_t n = nodes_of(type);
    std::array<std::uint32_t, 56> row = {};
    for (std::size_t i = 0; i < n; ++i) {
      if (!node(row[i], wide)) return false;
    }
    std::int32_t tag = 0;
    if (!to_label(label, tag)) return in.fail("physical tag does not fit 32 bits");
    auto& data = job.out.data;
    if (is_tet(type)) {
      tet_ids.add(id);
      data.soup.tets.push_back({row[0], row[1], row[2], row[3]});
      data.soup.regions.push_back(tag);
      job.mids.insert(job.mids.end(), row.begin() + 4, row.begin() + static_cast<std::ptrdiff_t>(n));
    } else if (type == kTriangle) {
      triangle_ids.add(id);
      data.triangles.push_back({row[0], row[1], row[2]});
      data.triangle_stroke.push_back(tag);
      data.has_foreign_labels = true;  // until $ElementData says that they are strokes
    } else {
      left_out.add(kKindOfType[static_cast<std::size_t>(type)]);
    }
    return true;
  }

  bool check_type(std::int64_t type) {
    return nodes_of(type) > 0 || in.fail("element type " + std::to_string(type) + " is unknown");
  }

  bool seal_elements() {
    left_out.note(job.out.notes);
    if (tet_ids.seal() && triangle_ids.seal()) return true;
    return in.fail("an element number is there twice");
  }

  Job& job;
  Source in;
  int version = 0;
  bool has_nodes = false, has_elements = false;
  LeftOut left_out;
  std::vector<std::int32_t> tet_order, triangle_order;
  IdMap node_ids, tet_ids, triangle_ids;
};

/// Nodes and elements of versions 1 and 2: a row each.
class MshRows {
 public:
  explicit MshRows(MshMesh& msh) : msh_(msh) {}

  bool nodes_2() {
    std::int64_t n = 0;
    if (msh_.version == 1) msh_.name_format("1.0");
    if (!msh_.count_line(n, 8, 28, "number of nodes")) return false;
    msh_.job.soup().points.resize(static_cast<std::size_t>(n));
    for (Vec3& p : msh_.job.soup().points) {
      std::int64_t id = 0;
      if (!msh_.in.begin_row() || !msh_.in.integer(id, "node number") || !msh_.coordinates(p) || !msh_.in.end_row())
        return false;
      msh_.node_ids.add(id);
    }
    return msh_.seal_nodes();
  }

  bool elements_1() {
    std::int64_t n = 0;
    if (!msh_.has_nodes) return msh_.in.text.fail("$ELM comes before $NOD");
    if (!msh_.count_line(n, 12, 12, "number of elements")) return false;
    for (std::int64_t i = 0; i < n; ++i) {
      std::int64_t id = 0;
      std::int64_t type = 0;
      std::int64_t physical = 0;
      std::int64_t elementary = 0;
      std::int64_t nodes = 0;
      if (!msh_.in.begin_row() || !msh_.in.integer(id, "element number") || !msh_.in.integer(type, "element type") ||
          !msh_.in.integer(physical, "physical region") || !msh_.in.integer(elementary, "elementary region") ||
          !msh_.in.integer(nodes, "number of nodes")) {
        return false;
      }
      if (nodes_of(type) == 0 || static_cast<std::size_t>(nodes) != nodes_of(type)) {
        return msh_.in.fail("element type " + std::to_string(type) + " cannot have " + std::to_string(nodes) +
                            " nodes");
      }
      if (!msh_.element(id, type, physical, false) || !msh_.in.end_row()) return false;
    }
    return msh_.seal_elements();
  }

  bool elements_2() {
    std::int64_t n = 0;
    if (!msh_.count_line(n, 8, 8, "number of elements")) return false;
    if (msh_.in.binary) return elements_2_binary(n) && msh_.seal_elements();
    for (std::int64_t i = 0; i < n; ++i) {
      std::int64_t id = 0;
      std::int64_t type = 0;
      std::int64_t n_tags = 0;
      std::int64_t physical = 0;
      if (!msh_.in.begin_row() || !msh_.in.integer(id, "element number") || !msh_.in.integer(type, "element type") ||
          !msh_.check_type(type) || !msh_.in.integer(n_tags, "number of tags") || !tags(n_tags, physical) ||
          !msh_.element(id, type, physical, false) || !msh_.in.end_row()) {
        return false;
      }
    }
    return msh_.seal_elements();
  }

 private:
  bool tags(std::int64_t n, std::int64_t& physical) {
    std::int64_t ignored = 0;
    if (n < 0 || n > 1000) return msh_.in.fail("number of tags is " + std::to_string(n));
    for (std::int64_t i = 0; i < n; ++i) {
      if (!msh_.in.integer(i == 0 ? physical : ignored, "tag")) return false;
    }
    return true;
  }

  bool elements_2_binary(std::int64_t n) {
    for (std::int64_t done = 0; done < n;) {
      std::int64_t type = 0;
      std::int64_t follow = 0;
      std::int64_t n_tags = 0;
      if (!msh_.in.integer(type, "element type") || !msh_.check_type(type) ||
          !msh_.in.integer(follow, "number of elements") || !msh_.in.integer(n_tags, "number of tags")) {
        return false;
      }
      if (follow < 1 || follow > n - done) return msh_.in.fail("a block of elements is longer than the section");
      for (std::int64_t i = 0; i < follow; ++i) {
        std::int64_t id = 0;
        std::int64_t physical = 0;
        if (!msh_.in.integer(id, "element number") || !tags(n_tags, physical) ||
            !msh_.element(id, type, physical, false)) {
          return false;
        }
      }
      done += follow;
    }
    return true;
  }

  MshMesh& msh_;
};

/// Nodes and elements of version 4: a block for each entity.
class MshBlocks {
 public:
  explicit MshBlocks(MshMesh& msh) : msh_(msh) {}

  bool entities() {
    std::array<std::int64_t, 4> n = {};
    if (!msh_.in.begin_row()) return false;
    for (std::int64_t& k : n) {
      if (!msh_.in.size(k, "number of entities") || !msh_.in.fits(k, 8, 28, "number of entities")) return false;
    }
    for (std::size_t dim = 0; dim < 4; ++dim) {
      for (std::int64_t i = 0; i < n[dim]; ++i) {
        if (!entity(dim)) return false;
      }
    }
    return true;
  }

  bool nodes_4() {
    std::int64_t n_blocks = 0;
    std::int64_t n = 0;
    if (!header_4(n_blocks, n, "number of nodes")) return false;
    if (!msh_.in.fits(n, 8, 24 + msh_.in.size_bytes, "number of nodes")) return false;
    msh_.job.soup().points.reserve(static_cast<std::size_t>(n));
    for (std::int64_t b = 0; b < n_blocks; ++b) {
      if (!node_block(n)) return false;
    }
    if (static_cast<std::int64_t>(msh_.node_ids.size()) != n)
      return msh_.in.fail("there are fewer nodes than the header says");
    return msh_.seal_nodes();
  }

  bool elements_4() {
    std::int64_t n_blocks = 0;
    std::int64_t n = 0;
    if (!header_4(n_blocks, n, "number of elements")) return false;
    if (!msh_.in.fits(n, 4, 2 * msh_.in.size_bytes, "number of elements")) return false;
    std::int64_t done = 0;
    for (std::int64_t b = 0; b < n_blocks; ++b) {
      if (!element_block(n, done)) return false;
    }
    if (done != n) return msh_.in.fail("there are fewer elements than the header says");
    return msh_.seal_elements();
  }

 private:
  bool entity(std::size_t dim) {
    std::int64_t tag = 0;
    std::int64_t n = 0;
    std::int64_t value = 0;
    if (!msh_.in.begin_row() || !msh_.in.integer(tag, "entity tag")) return false;
    for (int i = 0; i < (dim == 0 ? 3 : 6); ++i) {
      if (!msh_.in.skip_real("bounding box")) return false;
    }
    if (!msh_.in.size(n, "number of physical tags") || !msh_.in.fits(n, 2, 4, "number of physical tags")) return false;
    for (std::int64_t i = 0; i < n; ++i) {
      if (!msh_.in.integer(value, "physical tag")) return false;
      if (i == 0) physical_[{static_cast<std::int64_t>(dim), tag}] = value;
    }
    if (dim == 0) return msh_.in.end_row();
    if (!msh_.in.size(n, "number of bounding entities") || !msh_.in.fits(n, 2, 4, "number of bounding entities"))
      return false;
    for (std::int64_t i = 0; i < n; ++i) {
      if (!msh_.in.integer(value, "bounding entity")) return false;
    }
    return msh_.in.end_row();
  }

  bool header_4(std::int64_t& n_blocks, std::int64_t& n, const char* what) {
    std::int64_t ignored = 0;
    return msh_.in.begin_row() && msh_.in.size(n_blocks, "number of blocks") && msh_.in.size(n, what) &&
           msh_.in.size(ignored, "lowest number") && msh_.in.size(ignored, "highest number") && msh_.in.end_row() &&
           msh_.in.fits(n_blocks, 8, 12 + msh_.in.size_bytes, "number of blocks");
  }

  bool node_block(std::int64_t n_all) {
    std::int64_t dim = 0;
    std::int64_t tag = 0;
    std::int64_t parametric = 0;
    std::int64_t n = 0;
    if (!msh_.in.begin_row() || !msh_.in.integer(dim, "entity dimension") || !msh_.in.integer(tag, "entity tag") ||
        !msh_.in.integer(parametric, "parametric") || !msh_.in.size(n, "number of nodes in the block") ||
        !msh_.in.end_row()) {
      return false;
    }
    if (n < 0 || n > n_all - static_cast<std::int64_t>(msh_.node_ids.size())) {
      return msh_.in.fail("there are more nodes than the header says");
    }
    if (dim < 0 || dim > 3) return msh_.in.fail("entity dimension is " + std::to_string(dim));
    for (std::int64_t i = 0; i < n; ++i) {
      std::int64_t id = 0;
      if (!msh_.in.begin_row() || !msh_.in.size(id, "node number") || !msh_.in.end_row()) return false;
      msh_.node_ids.add(id);
    }
    for (std::int64_t i = 0; i < n; ++i) {
      double ignored = 0;
      if (!msh_.in.begin_row() || !msh_.coordinates(msh_.job.soup().points.emplace_back())) return false;
      for (std::int64_t k = 0; parametric != 0 && k < dim; ++k) {
        if (!msh_.in.real(ignored, "parametric coordinate")) return false;
      }
      if (!msh_.in.end_row()) return false;
    }
    return true;
  }

  bool element_block(std::int64_t n_all, std::int64_t& done) {
    std::int64_t dim = 0;
    std::int64_t tag = 0;
    std::int64_t type = 0;
    std::int64_t n = 0;
    if (!msh_.in.begin_row() || !msh_.in.integer(dim, "entity dimension") || !msh_.in.integer(tag, "entity tag") ||
        !msh_.in.integer(type, "element type") || !msh_.check_type(type) ||
        !msh_.in.size(n, "number of elements in the block") || !msh_.in.end_row()) {
      return false;
    }
    if (n < 0 || n > n_all - done) return msh_.in.fail("there are more elements than the header says");
    const auto found = physical_.find({dim, tag});
    const std::int64_t physical = found == physical_.end() ? 0 : found->second;
    for (std::int64_t i = 0; i < n; ++i) {
      std::int64_t id = 0;
      if (!msh_.in.begin_row() || !msh_.in.size(id, "element number") || !msh_.element(id, type, physical, true) ||
          !msh_.in.end_row()) {
        return false;
      }
    }
    done += n;
    return true;
  }

  MshMesh& msh_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> physical_;  // (dimension, entity) → physical tag
};

/// What is said of nodes and elements, of which known names are kept.
class MshLabels {
 public:
  explicit MshLabels(MshMesh& msh) : msh_(msh) {}

  // $ElementData and $NodeData: tags, then a number and values per row. Known names are kept.
  bool data(bool of_elements) {
    Cursor& text = msh_.in.text;
    std::int64_t n = 0;
    std::string name;
    if (!text.count(n, 1, "number of string tags")) return false;
    text.line();
    for (std::int64_t i = 0; i < n; ++i) {
      const std::string_view tag = trim(text.line());
      if (i == 0) name = tag.size() >= 2 ? std::string(tag.substr(1, tag.size() - 2)) : std::string();
    }
    double ignored = 0;
    if (!text.count(n, 1, "number of real tags")) return false;
    for (std::int64_t i = 0; i < n; ++i) {
      if (!text.real(ignored, "real tag")) return false;
    }
    std::array<std::int64_t, 3> sizes = {0, 1, 0};  // time step, components, rows
    if (!text.count(n, 1, "number of integer tags")) return false;
    for (std::int64_t i = 0; i < n; ++i) {
      std::int64_t value = 0;
      if (!text.integer(value, "integer tag")) return false;
      if (i < 3) sizes[static_cast<std::size_t>(i)] = value;
    }
    text.line();
    return data_rows(of_elements, name, sizes[1], sizes[2]);
  }

  // $PhysicalNames: dimension, number and name of each group, as text in binary files too. Those of volumes are kept.
  bool names() {
    Cursor& text = msh_.in.text;
    std::int64_t n = 0;
    if (!text.count(n, 5, "number of physical names")) return false;
    text.line();
    for (std::int64_t i = 0; i < n; ++i) {
      std::int64_t dimension = 0, number = 0;
      if (!text.integer(dimension, "dimension") || !text.integer(number, "physical tag")) return false;
      std::string_view name = trim(text.line());
      if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
      std::int32_t region = 0;
      if (dimension == 3 && to_label(number, region)) take_region_name(region, name, msh_.job.out.data.region_names);
    }
    return true;
  }

  // Of a file that Incise wrote: the blocks of entities took elements out of their order.
  void restore_order() {
    auto& data = msh_.job.out.data;
    const Order tets = sorted(msh_.tet_order, data.soup.tets.size());
    reorder(data.soup.tets, tets);
    reorder(data.soup.regions, tets);
    reorder(data.piece, tets);
    const Order triangles = sorted(msh_.triangle_order, data.triangles.size());
    reorder(data.triangles, triangles);
    reorder(data.triangle_stroke, triangles);
  }

 private:
  using Order = std::vector<std::size_t>;

  // Where the element for each place stands; empty where no order is known.
  static Order sorted(const std::vector<std::int32_t>& places, std::size_t n) {
    Order from;
    if (places.size() != n) return from;
    for (std::size_t i = 0; i < n; ++i) from.push_back(i);
    std::stable_sort(from.begin(), from.end(), [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
    return from;
  }

  template <class T>
  static void reorder(std::vector<T>& values, const Order& from) {
    if (values.size() != from.size()) return;
    std::vector<T> old = std::move(values);
    values.clear();
    values.reserve(old.size());
    for (const std::size_t i : from) values.push_back(old[i]);
  }

  bool data_rows(bool of_elements, const std::string& name, std::int64_t components, std::int64_t n) {
    if (components < 1 || components > 100)
      return msh_.in.fail("number of components is " + std::to_string(components));
    const auto width = static_cast<std::size_t>(components);
    if (!msh_.in.fits(n, 2 + 2 * width, 4 + 8 * width, "number of values")) return false;
    const bool wanted = width == 1 && is_label_name(name);
    if (wanted && of_elements && name == "stroke") take_strokes();
    for (std::int64_t i = 0; i < n; ++i) {
      std::int64_t id = 0;
      double value = 0;
      if (!msh_.in.begin_row() || !msh_.in.integer(id, "number")) return false;
      for (std::size_t k = 0; k < width; ++k) {
        if (!(wanted ? msh_.in.real(value, "value") : msh_.in.skip_real("value"))) return false;
      }
      if (!msh_.in.end_row()) return false;
      if (wanted) keep(of_elements, name, id, value);
    }
    return true;
  }

  static bool is_label_name(std::string_view name) {
    return name == "region" || name == "piece" || name == "stroke" || name == "origin_vertex" || name == "cut_front" ||
           name == kMshOrder;
  }

  // Triangles that the data leave out are skin, whatever their physical tag.
  void take_strokes() {
    auto& data = msh_.job.out.data;
    if (data.has_foreign_labels) data.triangle_stroke.assign(data.triangles.size(), 0);
    data.has_foreign_labels = false;
  }

  static void put(std::vector<std::int32_t>& labels, std::size_t n, std::uint32_t at, double value) {
    std::int32_t label = 0;
    if (at >= n || !to_label(value, label)) return;
    labels.resize(n, 0);
    labels[at] = label;
  }

  void keep(bool of_elements, const std::string& name, std::int64_t id, double value) {
    auto& data = msh_.job.out.data;
    const std::size_t n_tets = data.soup.tets.size();
    if (!of_elements) {
      const bool is_front = name == "cut_front";
      if (!is_front && name != "origin_vertex") return;
      put(is_front ? data.cut_front : data.origin_vertex, data.soup.points.size(), msh_.node_ids.find(id), value);
    } else if (name == "region") {
      put(data.soup.regions, n_tets, msh_.tet_ids.find(id), value);
    } else if (name == "piece") {
      put(data.piece, n_tets, msh_.tet_ids.find(id), value);
    } else if (name == kMshOrder) {
      put(msh_.tet_order, n_tets, msh_.tet_ids.find(id), value);
      put(msh_.triangle_order, data.triangles.size(), msh_.triangle_ids.find(id), value);
    } else if (name == "stroke") {
      put(data.triangle_stroke, data.triangles.size(), msh_.triangle_ids.find(id), value);
    }
  }

  MshMesh& msh_;
};

/// Reads section by section.
class MshReader {
 public:
  explicit MshReader(Job& job) : msh_(job) {}

  bool run() {
    while (msh_.in.text.skip_space()) {
      const std::string_view section = trim(msh_.in.text.line());
      if (section.empty() || section[0] != '$')
        return msh_.in.text.fail("expected a section, found " + in_quotes(section));
      if (!read_section(section.substr(1))) return false;
    }
    if (msh_.version == 0) return msh_.in.text.fail("there is no $MeshFormat section; export it from Gmsh as MSH 4.1");
    if (!msh_.has_nodes || !msh_.has_elements)
      return msh_.in.text.fail("the sections of nodes and elements must both be there");
    if (msh_.job.mids.empty()) labels_.restore_order();
    return true;
  }

 private:
  bool read_section(std::string_view name) {
    if (name == "MeshFormat") return mesh_format();
    if (name == "NOD" || name == "ELM") msh_.version = 1;
    if (name == "NOD") return once(msh_.has_nodes, "$NOD") && rows_.nodes_2() && end_section("ENDNOD");
    if (name == "ELM") return once(msh_.has_elements, "$ELM") && rows_.elements_1() && end_section("ENDELM");
    if (msh_.version == 0 && (name == "Nodes" || name == "Elements" || name == "Entities")) {
      return msh_.in.text.fail("$" + std::string(name) +
                               " comes before any $MeshFormat; export it from Gmsh as MSH 4.1");
    }
    if (name == "Nodes") {
      return once(msh_.has_nodes, "$Nodes") && (msh_.version == 2 ? rows_.nodes_2() : blocks_.nodes_4()) &&
             end_section("EndNodes");
    }
    if (name == "Elements") {
      if (!msh_.has_nodes) return msh_.in.text.fail("$Elements comes before $Nodes");
      return once(msh_.has_elements, "$Elements") && (msh_.version == 2 ? rows_.elements_2() : blocks_.elements_4()) &&
             end_section("EndElements");
    }
    if (name == "Entities" && msh_.version == 4) return blocks_.entities() && end_section("EndEntities");
    if (name == "PhysicalNames") return labels_.names() && end_section("EndPhysicalNames");
    if (name == "ElementData") return labels_.data(true) && end_section("EndElementData");
    if (name == "NodeData") return labels_.data(false) && end_section("EndNodeData");
    return skip_section(name);
  }

  bool once(bool& seen, const char* name) {
    if (seen) return msh_.in.text.fail(std::string("there are two sections ") + name);
    return seen = true;
  }

  bool end_section(std::string_view name) {
    const std::string_view found = msh_.in.text.word();
    if (found.size() == name.size() + 1 && found[0] == '$' && found.substr(1) == name) return true;
    return msh_.in.fail("expected $" + std::string(name) + ", found " + in_quotes(found) + ": the count may be wrong");
  }

  // $EndName at the start of a line ends a section that Incise has no use for.
  bool skip_section(std::string_view name) {
    const std::string upper = "\n$END" + std::string(name);
    const std::string mixed = "\n$End" + std::string(name);
    const std::size_t from = msh_.in.text.position() == 0 ? 0 : msh_.in.text.position() - 1;
    std::size_t at = msh_.in.text.bytes().find(mixed, from);
    if (at == std::string_view::npos) at = msh_.in.text.bytes().find(upper, from);
    if (at == std::string_view::npos) return msh_.in.text.fail("section $" + std::string(name) + " does not end");
    msh_.in.text.seek(at + mixed.size());
    msh_.in.text.line();
    return true;
  }

  bool mesh_format() {
    double version = 0;
    std::int64_t type = 0;
    std::int64_t size = 0;
    Cursor& text = msh_.in.text;
    if (!text.real(version, "format version") || !text.integer(type, "file type") || !text.integer(size, "data size")) {
      return false;
    }
    if (version >= 2 && version < 3) {
      msh_.version = 2;
    } else if (version == 4.1) {
      msh_.version = 4;
    } else {
      return msh_.job.fail("MSH versions 1.0, 2.x and 4.1 can be read, but not " +
                               std::to_string(version).substr(0, 3) + "; export it from Gmsh as MSH 4.1",
                           ErrorCode::kUnsupported);
    }
    if ((type != 0 && type != 1) || (size != 4 && size != 8)) return text.fail("file type or data size is unknown");
    msh_.in.size_bytes = static_cast<std::size_t>(size);
    text.line();
    if (type == 1 && !byte_order()) return false;
    msh_.name_format(msh_.version == 2 ? "2.2" : "4.1");
    return end_section("EndMeshFormat") && (text.line(), true);
  }

  bool byte_order() {
    msh_.in.binary = true;
    msh_.in.text.set_binary();
    std::int64_t one = 0;
    if (!msh_.in.integer(one, "byte order mark")) return false;
    msh_.in.swap = one != 1;
    return one == 1 || one == 0x01000000 || msh_.in.fail("the byte order mark is neither 1 nor 1 swapped");
  }

  MshMesh msh_;
  MshRows rows_{msh_};
  MshBlocks blocks_{msh_};
  MshLabels labels_{msh_};
};

}  // namespace

bool read_msh(Job& job) {
  return MshReader(job).run();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
