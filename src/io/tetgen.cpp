// SPDX-License-Identifier: Apache-2.0
// TetGen's .node and .ele, after "TetGen's file formats" of its manual; and what else is called that: tabs, headers
// of one to four fields, numbering from 0 or 1.
#include "incise/core/id.h"
#include "io/reader.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

// Written by Incise into .ele as the first line, so that its second attribute is known to be the piece.
constexpr std::string_view kPieceMark = "# incise: region piece";
constexpr std::string_view kOriginMark = "# incise: origin_vertex";

constexpr std::int64_t kMaxCount = std::int64_t{1} << 40U;

struct Header {
  std::array<std::int64_t, 4> field = {};
  std::size_t size = 0;
};

// One of the two files.
class Part {
 public:
  Part(std::string_view bytes, const std::string& name, Error& error) : in(bytes, name, error) { in.set_comment('#'); }

  bool header(Header& h) {
    if (!in.skip_space()) return in.fail("the file is empty");
    while (!in.at_line_end()) {
      std::int64_t value = 0;
      const std::string_view word = in.word_in_line();
      if (!parse_int(word, value) || value < 0 || value > kMaxCount) {
        return in.fail("the header must hold numbers, not " + in_quotes(word) +
                       "; files of Chaste's binary variant (BIN) must be converted to text");
      }
      if (h.size == h.field.size()) return in.fail("the header must hold 1 to 4 numbers");
      h.field[h.size++] = value;
    }
    return in.end_line("header");
  }

  // A row's number, which must rise by one from 0 or 1.
  bool row_number(std::int64_t i) {
    std::int64_t id = 0;
    if (!in.skip_space()) return in.fail("the file ends before the number of rows in its header");
    if (!in.integer_in_line(id, "row number")) return false;
    if (i == 0) base = id;
    if (base != 0 && base != 1) return in.fail("rows must be numbered from 0 or 1, not from " + std::to_string(base));
    return id == base + i || in.fail("row number " + std::to_string(id) + " should be " + std::to_string(base + i));
  }

  bool rest_is_empty() {
    return !in.skip_space() ||
           in.fail("there are more rows than the header says, beginning with " + in_quotes(in.peek()));
  }

  Cursor in;
  std::int64_t base = 0;
};

class TetGenReader {
 public:
  TetGenReader(Job& job, std::string_view node, std::string_view ele, const std::string& node_name,
               const std::string& ele_name)
      : job_(job),
        node_(node, node_name, job.error),
        ele_(ele, ele_name, job.error),
        has_origin_(node.substr(0, kOriginMark.size()) == kOriginMark),
        has_piece_(ele.substr(0, kPieceMark.size()) == kPieceMark) {}

  bool run() { return nodes() && elements(); }

 private:
  bool nodes() {
    Header h;
    if (!node_.header(h)) return false;
    if (h.size > 1 && h.field[1] != 3) return node_.in.fail("dimension must be 3");
    const std::int64_t n = h.field[0];
    if (static_cast<std::uint64_t>(n) > node_.in.remaining() / 8) return fail_count(node_, n);
    job_.soup().points.resize(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i) {
      Vec3& p = job_.soup().points[static_cast<std::size_t>(i)];
      if (!node_.row_number(i)) return false;
      for (int k = 0; k < 3; ++k) {
        if (!node_.in.real_in_line(p[k], "coordinate")) return false;
      }
      if (has_origin_ && !attribute(node_, job_.out.data.origin_vertex.emplace_back())) return false;
      const std::int64_t extra = h.size > 2 ? h.field[2] + (h.size > 3 ? h.field[3] : 0) - (has_origin_ ? 1 : 0) : 0;
      if (!trailing(node_, extra, h.size > 2)) return false;
    }
    return node_.rest_is_empty();
  }

  static bool fail_count(Part& part, std::int64_t n) {
    return part.in.fail("the header announces " + std::to_string(n) + " rows, more than the rest of the file can hold");
  }

  // Attributes and markers of no use here; `at_least` of them where the header says so.
  static bool trailing(Part& part, std::int64_t at_least, bool counted) {
    double ignored = 0;
    std::int64_t found = 0;
    for (; !part.in.at_line_end(); ++found) {
      if (!part.in.real_in_line(ignored, "attribute")) return false;
    }
    if (counted && found < at_least) return part.in.fail("the row has fewer attributes than the header says");
    return part.in.end_line("row");
  }

  bool attribute(Part& part, std::int32_t& out) {
    double value = 0;
    if (!part.in.real_in_line(value, "attribute")) return false;
    if (to_label(value, out)) return true;
    out = 0;
    ++fractions_;
    return true;
  }

  bool elements() {
    Header h;
    if (!ele_.header(h)) return false;
    const std::int64_t n = h.field[0];
    const std::int64_t width = h.size > 1 ? h.field[1] : 4;
    if (width != 4 && width != 10) return ele_.in.fail("tets must have 4 or 10 nodes, not " + std::to_string(width));
    if (static_cast<std::uint64_t>(n) > ele_.in.remaining() / 10) return fail_count(ele_, n);
    job_.soup().tets.reserve(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i) {
      if (!ele_.row_number(i) || !element(static_cast<std::size_t>(width), h)) return false;
    }
    if (fractions_ > 0) {
      job_.out.notes.push_back(std::to_string(fractions_) + " attributes that are not integers became region 0");
    }
    return ele_.rest_is_empty();
  }

  bool element(std::size_t width, const Header& h) {
    std::array<std::uint32_t, 10> row = {};
    const std::size_t n_points = job_.soup().points.size();
    for (std::size_t k = 0; k < width; ++k) {
      std::int64_t v = 0;
      if (!ele_.in.integer_in_line(v, "vertex number")) return false;
      if (!to_index(v, n_points, row[k], node_.base)) {
        return ele_.in.fail("vertex number " + std::to_string(v) + " is not among the " + std::to_string(n_points) +
                            " nodes");
      }
    }
    job_.soup().tets.push_back({row[0], row[1], row[2], row[3]});
    job_.mids.insert(job_.mids.end(), row.begin() + 4, row.begin() + static_cast<std::ptrdiff_t>(width));
    std::int64_t expected = h.size > 2 ? h.field[2] : 0;
    std::int32_t& region = job_.soup().regions.emplace_back(0);
    if (expected > 0 || !ele_.in.at_line_end()) {
      if (!attribute(ele_, region)) return false;
      --expected;
    }
    if (has_piece_) {
      if (!attribute(ele_, job_.out.data.piece.emplace_back())) return false;
      --expected;
    }
    return trailing(ele_, expected, h.size > 2);
  }

  Job& job_;
  Part node_;
  Part ele_;
  bool has_origin_;
  bool has_piece_;
  std::uint64_t fractions_ = 0;
};

// Numbers in the first and second row that are not comments.
std::array<std::size_t, 2> row_widths(std::string_view bytes, double& second_field) {
  const std::string name;
  Error error;
  Cursor in(bytes, name, error);
  in.set_comment('#');
  std::array<std::size_t, 2> widths = {};
  for (std::size_t& width : widths) {
    in.skip_space();
    for (; !in.at_line_end(); ++width) {
      const std::string_view word = in.word_in_line();
      if (&width == widths.data() && width == 1 && !parse_double(word, second_field)) second_field = 0;
    }
  }
  return widths;
}

// .node says dimension 3 in its header, .ele 4 or 10 nodes; a header of one number tells by the rows' width.
bool looks_like_nodes(std::string_view bytes, const std::string& name) {
  const std::string lower = to_lower(name);
  const auto ends_with = [&lower](std::string_view end) {
    return lower.size() >= end.size() && std::string_view(lower).substr(lower.size() - end.size()) == end;
  };
  double second = 0;
  const auto widths = row_widths(bytes, second);
  if (widths[0] > 1 && second == 3) return true;
  if (widths[0] > 1 && (second == 4 || second == 10)) return false;
  if (ends_with(".node") || ends_with(".node.gz")) return true;
  return widths[1] == 4;
}

// The other half's name: "a.ele" and "a.ele.gz" give "a.node".
std::string replace_extension(const std::string& name, std::string_view with) {
  std::string stem = name;
  if (stem.size() > 3 && to_lower(stem).substr(stem.size() - 3) == ".gz") stem.resize(stem.size() - 3);
  const std::size_t slash = stem.find_last_of("/\\");
  const std::size_t dot = stem.rfind('.');
  if (dot != std::string::npos && (slash == std::string::npos || dot > slash)) stem.resize(dot);
  return stem + std::string(with);
}

}  // namespace

bool read_tetgen(Job& job) {
  job.out.format_name = "TetGen .node/.ele";
  const bool given_nodes = looks_like_nodes(job.bytes, job.name);
  const std::string other = replace_extension(job.name, given_nodes ? ".ele" : ".node");
  if (!job.sibling) return job.fail("TetGen files come in pairs, and " + other + " cannot be looked for here");
  const Result<std::string> bytes = job.sibling(other);
  if (!bytes) return job.fail("TetGen files come in pairs: " + bytes.error().message);
  if (given_nodes) return TetGenReader(job, job.bytes, *bytes, job.name, other).run();
  return TetGenReader(job, *bytes, job.bytes, other, job.name).run();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
