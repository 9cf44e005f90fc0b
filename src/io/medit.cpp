// SPDX-License-Identifier: Apache-2.0
// MEDIT .mesh, ASCII. Keywords and rows as in "MEDIT: An interactive mesh visualization software", INRIA RT-0253.
#include "incise/core/id.h"
#include "io/reader.h"
#include "io/region_names.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

class MeditReader {
 public:
  explicit MeditReader(Job& job) : job_(job), in_(job.bytes, job.name, job.error) { in_.set_comment('#'); }

  bool run() {
    std::int64_t version = 0;
    if (!same_word(in_.word(), "MeshVersionFormatted") || !in_.integer(version, "format version")) {
      return in_.fail("a MEDIT file begins with 'MeshVersionFormatted' and a number");
    }
    while (in_.skip_space()) {
      const std::string_view keyword = in_.word();
      if (same_word(keyword, "End")) break;
      if (!section(keyword)) return false;
    }
    left_out_.note(job_.out.notes);
    return has_vertices_ || in_.fail("there is no Vertices section");
  }

 private:
  bool section(std::string_view keyword) {
    if (same_word(keyword, "Dimension")) return dimension();
    if (same_word(keyword, "Vertices")) return vertices();
    if (same_word(keyword, "Tetrahedra")) return tets(4);
    if (same_word(keyword, "TetrahedraP2")) return tets(10);
    if (same_word(keyword, "Triangles")) return triangles();
    if (same_word(keyword, "Corners") && is_ours_.front) return corners();
    if (same_word(keyword, "Quadrilaterals")) return leave_out("quadrilaterals");
    if (same_word(keyword, "Hexahedra")) return leave_out("hexahedra");
    if (same_word(keyword, "Prisms")) return leave_out("prisms");
    if (same_word(keyword, "Pyramids")) return leave_out("pyramids");
    skip_numbers();
    return true;
  }

  bool leave_out(std::string_view kind) {
    std::int64_t n = 0;
    if (!in_.count(n, 4, "number of elements")) return false;
    left_out_.add(kind, static_cast<std::uint64_t>(n));
    skip_numbers();
    return true;
  }

  // Sections of no use here hold numbers only; the next keyword begins with a letter.
  void skip_numbers() {
    double number = 0;
    while (!in_.peek().empty() && parse_double(in_.peek(), number)) in_.word();
  }

  bool dimension() {
    std::int64_t n = 0;
    if (!in_.integer(n, "dimension")) return false;
    if (n == 2) return in_.fail("the mesh is flat, of dimension 2; Incise cuts volumes");
    return n == 3 || in_.fail("dimension must be 3");
  }

  // The label at the end of a row; rows without one have label 0.
  bool label(std::int32_t& out, const char* what) {
    std::int64_t value = 0;
    out = 0;
    if (in_.at_line_end()) return in_.end_line("row");
    if (!in_.integer_in_line(value, what)) return false;
    if (!to_label(value, out)) return in_.fail(std::string(what) + " does not fit 32 bits");
    return in_.end_line("row");
  }

  // The names after the mark, which stands before the vertices, say what the labels of this file are.
  void find_mark() {
    const std::string_view head = in_.bytes().substr(0, in_.position());
    const std::size_t at = head.find("\n" + std::string(kMeditMark));
    if (at == std::string_view::npos) return;
    Error ignored;
    Cursor names(head.substr(at + 1 + kMeditMark.size()), job_.name, ignored);
    for (std::string_view name = names.word_in_line(); !name.empty(); name = names.word_in_line()) {
      is_ours_.stroke |= name == "stroke";
      is_ours_.origin |= name == "origin_vertex";
      is_ours_.front |= name == "cut_front";
    }
  }

  void find_names() {
    const std::string_view head = in_.bytes().substr(0, in_.position());
    const std::string mark = "\n" + std::string(kMeditRegion) + " ";
    for (std::size_t at = head.find(mark); at != std::string_view::npos; at = head.find(mark, at + 1)) {
      const std::size_t from = at + mark.size();
      take_entry(head.substr(from, head.find('\n', from) - from), job_.out.data.region_names);
    }
  }

  bool vertices() {
    std::int64_t n = 0;
    if (has_vertices_) return in_.fail("there are two Vertices sections");
    find_mark();
    find_names();
    if (!in_.count(n, 3, "number of vertices")) return false;
    has_vertices_ = true;
    auto& points = job_.soup().points;
    points.resize(static_cast<std::size_t>(n));
    auto& origins = job_.out.data.origin_vertex;
    if (is_ours_.origin) origins.reserve(points.size());
    if (is_ours_.front) job_.out.data.cut_front.assign(points.size(), 0);
    std::int32_t number = 0;
    for (Vec3& p : points) {
      in_.skip_space();
      for (int k = 0; k < 3; ++k) {
        if (!in_.real_in_line(p[k], "coordinate")) return false;
      }
      if (!label(number, "vertex label")) return false;
      if (is_ours_.origin) origins.push_back(number > 0 ? number - 1 : -1);
    }
    return true;
  }

  bool corners() {
    std::int64_t n = 0;
    if (!has_vertices_) return in_.fail("the section Corners comes before the vertices");
    if (!in_.count(n, 1, "number of corners")) return false;
    for (std::int64_t i = 0; i < n; ++i) {
      std::uint32_t corner = 0;
      in_.skip_space();
      if (!vertex(corner)) return false;
      job_.out.data.cut_front[corner] = 1;
    }
    return true;
  }

  bool vertex(std::uint32_t& out) {
    std::int64_t value = 0;
    if (!in_.integer_in_line(value, "vertex number")) return false;
    const std::size_t n = has_vertices_ ? job_.soup().points.size() : kInvalidIndex;
    return to_index(value, n, out, 1) || in_.fail("vertex number " + std::to_string(value) + " is out of range");
  }

  bool tets(std::size_t nodes) {
    std::int64_t n = 0;
    if (!in_.count(n, nodes, "number of tetrahedra")) return false;
    auto& soup = job_.soup();
    soup.tets.reserve(soup.tets.size() + static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i) {
      in_.skip_space();
      std::array<std::uint32_t, 10> row = {};
      for (std::size_t k = 0; k < nodes; ++k) {
        if (!vertex(row[k])) return false;
      }
      soup.tets.push_back({row[0], row[1], row[2], row[3]});
      job_.mids.insert(job_.mids.end(), row.begin() + 4, row.begin() + static_cast<std::ptrdiff_t>(nodes));
      if (!label(soup.regions.emplace_back(), "tet label")) return false;
    }
    return true;
  }

  bool triangles() {
    std::int64_t n = 0;
    if (!in_.count(n, 3, "number of triangles")) return false;
    auto& data = job_.out.data;
    data.has_foreign_labels = !is_ours_.stroke;
    data.triangles.reserve(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i) {
      in_.skip_space();
      for (std::uint32_t& v : data.triangles.emplace_back()) {
        if (!vertex(v)) return false;
      }
      if (!label(data.triangle_stroke.emplace_back(), "triangle label")) return false;
    }
    return true;
  }

  Job& job_;
  Cursor in_;
  bool has_vertices_ = false;
  LeftOut left_out_;
  struct {
    bool stroke = false, origin = false, front = false;
  } is_ours_;  // which labels Incise wrote
};

}  // namespace

bool read_medit(Job& job) {
  job.out.format_name = "MEDIT .mesh ASCII";
  return MeditReader(job).run();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
