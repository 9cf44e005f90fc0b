// SPDX-License-Identifier: Apache-2.0
// Vega FEM's .veg, after the description of the format in the Vega user's manual.
#include <map>
#include <memory>

#include "incise/core/id.h"
#include "io/reader.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

constexpr std::size_t kMaxIncludes = 8;  // files open at once; an include that names itself stops here

// A file among those that *INCLUDE nests.
struct Layer {
  Layer(std::string name_in, std::string bytes_in, Error& error)
      : name(std::move(name_in)), bytes(std::move(bytes_in)), in(bytes, name, error) {
    set_up();
  }
  Layer(const std::string& name_in, std::string_view view, Error& error) : name(name_in), in(view, name, error) {
    set_up();
  }
  Layer(const Layer&) = delete;
  Layer& operator=(const Layer&) = delete;

  void set_up() {
    in.set_comment('#');
    in.split_at_commas();
  }

  const std::string name;
  const std::string bytes;
  Cursor in;
};

class VegaReader {
 public:
  explicit VegaReader(Job& job) : job_(job) {
    layers_.push_back(std::make_unique<Layer>(job.name, job.bytes, job.error));
  }

  bool run() {
    while (next_row()) {
      const std::string_view keyword = in().word_in_line();
      if (!section(keyword)) return false;
    }
    return job_.error.message.empty() && apply_sets();
  }

 private:
  Cursor& in() { return layers_.back()->in; }

  // Moves to the next line that says something, into and out of included files.
  bool next_row() {
    for (;;) {
      while (!in().skip_space()) {
        if (layers_.size() == 1) return false;
        layers_.pop_back();
      }
      if (!same_word(in().peek(), "*INCLUDE")) return true;
      in().word();
      if (!include(std::string(trim(in().line())))) return false;
    }
  }
  bool at_keyword() { return in().peek().substr(0, 1) == "*"; }

  bool include(const std::string& name) {
    if (layers_.size() == kMaxIncludes) return in().fail("*INCLUDE is nested too deeply");
    if (!job_.sibling) return in().fail("*INCLUDE cannot be followed here");
    Result<std::string> bytes = job_.sibling(name);
    if (!bytes) return in().fail("*INCLUDE: " + bytes.error().message);
    included_ += bytes->size();
    if (included_ > job_.limits.max_inflated_bytes) return in().fail("included files are too large together");
    layers_.push_back(std::make_unique<Layer>(name, std::move(bytes).value(), job_.error));
    return true;
  }

  bool section(std::string_view keyword) {
    if (same_word(keyword, "*VERTICES")) return vertices();
    if (same_word(keyword, "*ELEMENTS")) return elements();
    if (same_word(keyword, "*SET")) return set();
    if (same_word(keyword, "*REGION")) return region();
    if (keyword.substr(0, 1) != "*") return in().fail("expected a section, found " + in_quotes(keyword));
    while (next_row() && !at_keyword()) in().line();  // *MATERIAL and private sections
    return job_.error.message.empty();
  }

  bool header(std::int64_t& n, std::int64_t& width, std::size_t row_bytes) {
    if (!next_row()) return in().fail("the file ends within a section");
    if (!in().integer_in_line(n, "number of rows") || !in().integer_in_line(width, "numbers per row")) return false;
    in().line();
    // Rows may stand in an included file, whose size is not known yet.
    const bool fits = n >= 0 && static_cast<std::uint64_t>(n) <= in().remaining() / row_bytes;
    if (fits || (next_row() && layers_.size() > 1 && static_cast<std::uint64_t>(n) <= in().remaining() / row_bytes)) {
      return true;
    }
    return in().fail("the number of rows is " + std::to_string(n) + ", more than the rest of the file can hold");
  }

  bool vertices() {
    std::int64_t n = 0;
    std::int64_t width = 0;
    if (!job_.soup().points.empty()) return in().fail("there are two sections *VERTICES");
    if (!header(n, width, 8)) return false;
    if (width != 3) return in().fail("vertices must have 3 coordinates");
    job_.soup().points.resize(static_cast<std::size_t>(n));
    for (Vec3& p : job_.soup().points) {
      std::int64_t id = 0;
      if (!row_id(id)) return false;
      vertex_ids_.add(id);
      for (int k = 0; k < 3; ++k) {
        if (!in().real_in_line(p[k], "coordinate")) return false;
      }
      if (!in().end_line("row")) return false;
    }
    return vertex_ids_.seal() || in().fail("vertex " + std::to_string(vertex_ids_.repeated()) + " is there twice");
  }

  bool row_id(std::int64_t& id) {
    if (!next_row()) return in().fail("the file ends before the number of rows in the section's header");
    return in().integer_in_line(id, "row number");
  }

  bool elements() {
    std::int64_t n = 0;
    std::int64_t width = 0;
    if (!next_row()) return in().fail("the file ends within a section");
    const std::string kind(in().word_in_line());
    if (!same_word(kind, "TET") && !same_word(kind, "TETS")) {
      return job_.fail("elements of kind " + in_quotes(kind) + " are no tets; mesh the volume with tets",
                       ErrorCode::kUnsupported);
    }
    in().line();
    if (!header(n, width, 10)) return false;
    if (width != 4) return in().fail("tets must have 4 vertices");
    job_.soup().tets.reserve(static_cast<std::size_t>(n));
    for (std::int64_t i = 0; i < n; ++i) {
      std::int64_t id = 0;
      if (!row_id(id)) return false;
      tet_ids_.add(id);
      for (std::uint32_t& v : job_.soup().tets.emplace_back()) {
        if (!vertex(v)) return false;
      }
      if (!in().end_line("row")) return false;
    }
    return tet_ids_.seal() || in().fail("element " + std::to_string(tet_ids_.repeated()) + " is there twice");
  }

  bool vertex(std::uint32_t& out) {
    std::int64_t id = 0;
    if (!in().integer_in_line(id, "vertex number")) return false;
    out = vertex_ids_.find(id);
    return out != kInvalidIndex || in().fail("vertex number " + std::to_string(id) + " is not among the vertices");
  }

  bool set() {
    auto& members = sets_[std::string(in().word_in_line())];
    while (next_row() && !at_keyword()) {
      while (!in().at_line_end()) {
        std::int64_t id = 0;
        if (!in().integer_in_line(id, "element number")) return false;
        members.push_back(id);
      }
    }
    return job_.error.message.empty();
  }

  bool region() {
    if (!next_row() || at_keyword()) return in().fail("*REGION must be followed by a set and a material");
    regions_.emplace_back(in().word_in_line());
    in().line();
    return true;
  }

  bool label(std::vector<std::int32_t>& labels, const std::vector<std::int64_t>& members, std::int32_t value) {
    labels.resize(job_.soup().tets.size(), 0);
    for (const std::int64_t id : members) {
      const std::uint32_t t = tet_ids_.find(id);
      if (t == kInvalidIndex) return job_.fail("a set names element " + std::to_string(id) + ", which is not there");
      labels[t] = value;
    }
    return true;
  }

  // Sets region_N and piece_N are ours; else the sets that *REGION names count from 1 in order.
  bool apply_sets() {
    bool ours = false;
    for (const auto& [name, members] : sets_) {
      std::int32_t value = 0;
      if (parse_suffix(name, "piece_", value) && !label(job_.out.data.piece, members, value)) return false;
      if (!parse_suffix(name, "region_", value)) continue;
      ours = true;
      if (!label(job_.soup().regions, members, value)) return false;
    }
    if (ours || regions_.size() < 2) return true;
    for (std::size_t i = 0; i < regions_.size(); ++i) {
      const auto found = sets_.find(regions_[i]);
      if (found == sets_.end()) continue;  // allElements
      if (!label(job_.soup().regions, found->second, static_cast<std::int32_t>(i + 1))) return false;
    }
    return true;
  }

  Job& job_;
  std::vector<std::unique_ptr<Layer>> layers_;
  std::uint64_t included_ = 0;
  IdMap vertex_ids_;
  IdMap tet_ids_;
  std::map<std::string, std::vector<std::int64_t>> sets_;
  std::vector<std::string> regions_;
};

}  // namespace

bool read_vega(Job& job) {
  job.out.format_name = "Vega .veg";
  return VegaReader(job).run();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
