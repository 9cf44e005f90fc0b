// SPDX-License-Identifier: Apache-2.0
// What the writers of all formats share.
#include "io/writer.h"

#include <map>

#include "io/cells.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

// Tets by label, in rising order of both; label 0 needs no set.
std::map<std::int32_t, std::vector<std::size_t>> tets_by_label(const Labels& labels) {
  std::map<std::int32_t, std::vector<std::size_t>> sets;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != 0) sets[labels[i]].push_back(i + 1);
  }
  return sets;
}

}  // namespace

Labels cell_array(const MeshData& data, const Labels& of_tets, const Labels& of_triangles) {
  Labels all(of_tets);
  all.resize(data.soup.tets.size(), 0);
  all.insert(all.end(), of_triangles.begin(), of_triangles.end());
  all.resize(data.soup.tets.size() + data.triangles.size(), 0);
  return all;
}

std::vector<NamedLabels> point_arrays(const MeshData& data) {
  std::vector<NamedLabels> arrays;
  if (!data.origin_vertex.empty()) arrays.push_back({"origin_vertex", data.origin_vertex});
  if (!data.cut_front.empty()) arrays.push_back({"cut_front", data.cut_front});
  return arrays;
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

void label_sets(Text& out, std::string_view opening, std::string_view prefix, const Labels& labels) {
  for (const auto& [value, tets] : tets_by_label(labels)) {
    out << opening << prefix << value << '\n';
    for (std::size_t i = 0; i < tets.size(); ++i) {
      out << tets[i] << (i % 8 == 7 || i + 1 == tets.size() ? ",\n" : ", ");
    }
  }
}

}  // namespace io
}  // namespace v0
}  // namespace incise
