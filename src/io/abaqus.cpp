// SPDX-License-Identifier: Apache-2.0
// Abaqus and CalculiX .inp: *NODE, *ELEMENT of tet types, *ELSET; everything else is passed over. After the keyword
// descriptions of the CalculiX CrunchiX user's manual.
#include <algorithm>
#include <map>

#include "incise/core/id.h"
#include "io/reader.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

constexpr std::int64_t kMaxId = std::int64_t{1} << 40U;

// A keyword line: "*ELEMENT, TYPE=C3D4, ELSET=Eall".
struct Card {
  std::string name;  // lower case
  std::map<std::string, std::string> options;

  [[nodiscard]] std::string option(const std::string& key) const {
    const auto found = options.find(key);
    return found == options.end() ? std::string() : found->second;
  }
};

Card parse_card(std::string_view line) {
  Card card;
  for (bool first = true;; first = false) {
    const std::size_t comma = line.find(',');
    const std::string_view part = trim(line.substr(0, comma));
    const std::size_t equals = part.find('=');
    if (first) {
      card.name = to_lower(part);
    } else if (equals == std::string_view::npos) {
      card.options[to_lower(part)] = "";
    } else {
      card.options[to_lower(trim(part.substr(0, equals)))] = trim(part.substr(equals + 1));
    }
    if (comma == std::string_view::npos) return card;
    line.remove_prefix(comma + 1);
  }
}

class AbaqusReader {
 public:
  explicit AbaqusReader(Job& job) : job_(job), in_(job.bytes, job.name, job.error) { in_.split_at_commas(); }

  bool run() {
    while (in_.remaining() > 0) {
      const std::size_t here = in_.position();
      const std::string_view line = trim(in_.line());
      if (line.empty() || line.substr(0, 2) == "**" || line[0] != '*') continue;
      if (!card(parse_card(card_text(here)))) return false;
    }
    left_out_.note(job_.out.notes);
    return resolve();
  }

 private:
  // A keyword line that ends with a comma goes on in the next line.
  std::string card_text(std::size_t from) {
    in_.seek(from);
    std::string text(trim(in_.line()));
    while (!text.empty() && text.back() == ',' && in_.remaining() > 0) text += trim(in_.line());
    return text;
  }

  bool card(const Card& card) {
    if (card.name == "*node") return nodes();
    if (card.name == "*element") return elements(card);
    if (card.name == "*elset") return element_set(card);
    if (card.name == "*include") {
      return in_.fail("*INCLUDE is not followed in .inp files; put the included lines in its place");
    }
    return true;
  }

  // Moves to the next row of data; false at a keyword or the end.
  bool next_row() {
    while (in_.skip_space()) {
      const std::string_view rest = in_.bytes().substr(in_.position(), 2);
      if (rest == "**") {
        in_.line();
        continue;
      }
      return rest[0] != '*';
    }
    return false;
  }

  bool nodes() {
    while (next_row()) {
      std::int64_t id = 0;
      Vec3& p = job_.soup().points.emplace_back(0.0, 0.0, 0.0);
      if (!in_.integer_in_line(id, "node number")) return false;
      for (int k = 0; k < 3; ++k) {
        if (!in_.real_in_line(p[k], "coordinate")) return false;
      }
      node_ids_.add(id);
      if (!in_.end_line("node")) return false;
    }
    return true;
  }

  bool elements(const Card& card) {
    const std::string type = to_lower(card.option("type"));
    const bool linear = type == "c3d4" || type == "c3d4h" || type == "dc3d4" || type == "c3d4t";
    const bool quadratic = type == "c3d10" || type == "c3d10m" || type == "c3d10h" || type == "dc3d10" ||
                           type == "c3d10t" || type == "c3d10mh" || type == "c3d10hs";
    if (!linear && !quadratic) {
      leave_out(type);
      return true;
    }
    std::int32_t region = 0;
    const std::string elset = card.option("elset");
    if (!parse_suffix(elset, "region_", region)) {
      region = elset_region_.emplace(elset, static_cast<std::int32_t>(elset_region_.size() + 1)).first->second;
    }
    while (next_row()) {
      if (!element(linear ? 4 : 10, region)) return false;
    }
    return true;
  }

  // Counts the rows of other elements; one that ends with a comma goes on in the next line.
  void leave_out(const std::string& type) {
    std::uint64_t n = 0;
    bool goes_on = false;
    while (next_row()) {
      n += goes_on ? 0 : 1;
      const std::string_view row = trim(in_.line());
      goes_on = !row.empty() && row.back() == ',';
    }
    left_out_.add("elements of type " + in_quotes(type), n);
  }

  // One element; its row may go on over lines.
  bool element(std::size_t width, std::int32_t region) {
    std::int64_t id = 0;
    std::array<std::int64_t, 10> row = {};
    if (!in_.integer_in_line(id, "element number")) return false;
    for (std::size_t k = 0; k < width; ++k) {
      if (in_.at_line_end() && !next_row()) return in_.fail("the element's row ends too early");
      if (!in_.integer_in_line(row[k], "node number")) return false;
    }
    tet_ids_.add(id);
    rows_.insert(rows_.end(), row.begin(), row.begin() + 4);
    mid_ids_.insert(mid_ids_.end(), row.begin() + 4, row.begin() + static_cast<std::ptrdiff_t>(width));
    job_.soup().regions.push_back(region);
    return in_.end_line("element");
  }

  bool element_set(const Card& card) {
    const std::string name = to_lower(card.option("elset"));
    if (name.substr(0, 7) != "region_" && name.substr(0, 6) != "piece_") return true;
    auto& members = sets_[name];
    const bool ranges = card.options.count("generate") > 0;
    while (next_row()) {
      std::vector<std::int64_t> row;
      while (!in_.at_line_end()) {
        std::int64_t id = 0;
        if (!in_.integer_in_line(id, "element number")) return false;
        row.push_back(id);
      }
      if (ranges && !expand(row)) return false;
      members.insert(members.end(), row.begin(), row.end());
    }
    return true;
  }

  bool expand(std::vector<std::int64_t>& row) {
    if (row.size() < 2) return in_.fail("GENERATE needs a first and a last number");
    const std::int64_t step = row.size() > 2 ? row[2] : 1;
    if (step < 1 || row[0] < 0 || row[1] < row[0] || row[1] > kMaxId || step > kMaxId ||
        (row[1] - row[0]) / step > static_cast<std::int64_t>(rows_.size())) {
      return in_.fail("GENERATE has an impossible range");
    }
    std::vector<std::int64_t> all;
    for (std::int64_t id = row[0]; id <= row[1]; id += step) all.push_back(id);
    row = std::move(all);
    return true;
  }

  // Node numbers become indices, now that all nodes are known.
  bool resolve() {
    if (!node_ids_.seal()) {
      return job_.fail("node " + std::to_string(node_ids_.repeated()) +
                       " is there twice; export one part without instances");
    }
    if (!tet_ids_.seal()) return job_.fail("element " + std::to_string(tet_ids_.repeated()) + " is there twice");
    auto& tets = job_.soup().tets;
    tets.resize(rows_.size() / 4);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!find(rows_[i], tets[i / 4][i % 4])) return false;
    }
    job_.mids.resize(mid_ids_.size());
    for (std::size_t i = 0; i < mid_ids_.size(); ++i) {
      if (!find(mid_ids_[i], job_.mids[i])) return false;
    }
    if (elset_region_.size() == 1) {
      for (std::int32_t& region : job_.soup().regions) region = region == 1 ? 0 : region;
    }
    return apply_sets();
  }

  bool find(std::int64_t id, std::uint32_t& out) {
    out = node_ids_.find(id);
    return out != kInvalidIndex ||
           job_.fail("an element names node " + std::to_string(id) + ", which is not there; export the mesh again");
  }

  // Sets region_N and piece_N are ours.
  bool apply_sets() {
    for (const auto& [name, members] : sets_) {
      std::int32_t value = 0;
      const bool is_region = parse_suffix(name, "region_", value);
      if (!is_region && !parse_suffix(name, "piece_", value)) continue;
      auto& labels = is_region ? job_.soup().regions : job_.out.data.piece;
      labels.resize(tet_ids_.size(), 0);
      for (const std::int64_t id : members) {
        const std::uint32_t t = tet_ids_.find(id);
        if (t == kInvalidIndex) return job_.fail("a set names element " + std::to_string(id) + ", which is not there");
        labels[t] = value;
      }
    }
    return true;
  }

  Job& job_;
  Cursor in_;
  LeftOut left_out_;
  IdMap node_ids_;
  IdMap tet_ids_;
  std::vector<std::int64_t> rows_;     // four node numbers per tet
  std::vector<std::int64_t> mid_ids_;  // node numbers of mid-edge nodes
  std::map<std::string, std::int32_t> elset_region_;
  std::map<std::string, std::vector<std::int64_t>> sets_;
};

}  // namespace

bool read_abaqus(Job& job) {
  job.out.format_name = "Abaqus .inp";
  return AbaqusReader(job).run();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
