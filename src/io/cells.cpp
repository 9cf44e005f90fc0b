// SPDX-License-Identifier: Apache-2.0
// Cells come in any number of arrays: tets and triangles keep their slot, labels that come later go there, and what is
// left out is counted by its kind.
#include "io/cells.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

bool is_tet(CellInt type) {
  return type == kVtkTet || type == kVtkTet10;
}

CellInt nodes_of(CellInt type) {
  return type == kVtkTriangle ? 3 : type == kVtkTet ? 4 : type == kVtkTet10 ? 10 : 0;
}

// What cells that are left out are called, after vtkCellType.h; empty for points and lines, which nobody misses.
std::string kind_of(CellInt type) {
  constexpr std::array<std::string_view, 28> kKinds = {"empty cells",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "triangles",
                                                       "triangle strips",
                                                       "polygons",
                                                       "pixels",
                                                       "quadrilaterals",
                                                       "tets",
                                                       "voxels",
                                                       "hexahedra",
                                                       "prisms",
                                                       "pyramids",
                                                       "pentagonal prisms",
                                                       "hexagonal prisms",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "quadratic triangles",
                                                       "quadratic quadrilaterals",
                                                       "quadratic tets",
                                                       "quadratic hexahedra",
                                                       "quadratic prisms",
                                                       "quadratic pyramids"};
  if (type >= 0 && static_cast<std::size_t>(type) < kKinds.size() && (type < 17 || type > 20)) {
    return std::string(kKinds[static_cast<std::size_t>(type)]);
  }
  if (type == 42) return "polyhedra";
  if (type == 71) return "Lagrange tets";
  if (type == 78) return "Bezier tets";
  return "cells of type " + std::to_string(type);
}

}  // namespace

bool CellSorter::fail_index(CellInt vertex, std::size_t n) {
  return job_.fail("a cell names vertex " + std::to_string(vertex) + " (from 0) of " + std::to_string(n) +
                   "; export the mesh again");
}

bool CellSorter::add_tet(const CellInt* nodes, std::size_t n_nodes, std::size_t first_vertex, std::size_t n_vertices) {
  std::array<std::uint32_t, 10> row = {};
  for (std::size_t k = 0; k < n_nodes; ++k) {
    if (!to_index(nodes[k], n_vertices, row[k])) return fail_index(nodes[k], n_vertices);
    row[k] += static_cast<std::uint32_t>(first_vertex);
  }
  auto& soup = job_.soup();
  slot_.push_back(static_cast<std::uint32_t>(soup.tets.size()));
  soup.tets.push_back({row[0], row[1], row[2], row[3]});
  job_.mids.insert(job_.mids.end(), row.begin() + 4, row.begin() + static_cast<std::ptrdiff_t>(n_nodes));
  return true;
}

bool CellSorter::add(const std::vector<CellInt>& types, const std::vector<CellInt>& offsets,
                     const std::vector<CellInt>& connectivity, std::size_t first_vertex, std::size_t n_vertices) {
  auto& data = job_.out.data;
  if (offsets.size() != types.size() + 1) return job_.fail("the numbers of cells and of cell types differ");
  types_ = types;
  slot_.clear();
  slot_.reserve(types.size());
  region_rank_ = 0;
  data.soup.tets.reserve(data.soup.tets.size() + types.size());
  for (std::size_t c = 0; c < types.size(); ++c) {
    const CellInt begin = offsets[c];
    const CellInt end = offsets[c + 1];
    if (begin < 0 || end < begin || static_cast<std::uint64_t>(end) > connectivity.size()) {
      return job_.fail("cell " + std::to_string(c) + " has offsets " + std::to_string(begin) + " to " +
                       std::to_string(end) + " outside the connectivity; export the mesh again");
    }
    const CellInt expected = nodes_of(types[c]);
    if (expected != 0 && end - begin != expected) {
      return job_.fail("cell " + std::to_string(c) + " of type " + std::to_string(types[c]) + " has " +
                       std::to_string(end - begin) + " vertices; export the mesh again");
    }
    const CellInt* nodes = connectivity.data() + begin;
    if (is_tet(types[c])) {
      if (!add_tet(nodes, static_cast<std::size_t>(expected), first_vertex, n_vertices)) return false;
    } else if (types[c] == kVtkTriangle) {
      slot_.push_back(static_cast<std::uint32_t>(data.triangles.size()));
      auto& triangle = data.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        if (!to_index(nodes[k], n_vertices, triangle[k])) return fail_index(nodes[k], n_vertices);
        triangle[k] += static_cast<std::uint32_t>(first_vertex);
      }
    } else {
      slot_.push_back(0);
      left_out_.add(kind_of(types[c]));
    }
  }
  return true;
}

bool CellSorter::wants_cell_array(std::string_view name) {
  return name == "piece" || name == "stroke" || name == kFaceLabel || region_rank(name) > 0;
}

void CellSorter::put(std::vector<std::int32_t>& labels, std::size_t i, double value) {
  if (labels.size() <= i) labels.resize(i + 1, 0);
  if (!to_label(value, labels[i])) {
    labels[i] = 0;
    ++fractions_;
  }
}

// Strokes take the place of foreign labels, not the other way round.
void CellSorter::label_triangles(std::string_view name, const std::vector<double>& values) {
  auto& data = job_.out.data;
  const bool is_stroke = name == "stroke";
  if (!is_stroke && has_strokes_) return;
  if (is_stroke && data.has_foreign_labels) data.triangle_stroke.clear();
  has_strokes_ = is_stroke;
  data.has_foreign_labels = !is_stroke;
  for (std::size_t c = 0; c < types_.size() && c < values.size(); ++c) {
    if (types_[c] == kVtkTriangle) put(data.triangle_stroke, slot_[c], values[c]);
  }
}

void CellSorter::label_cells(std::string_view name, const std::vector<double>& values) {
  auto& data = job_.out.data;
  if (name == "stroke" || name == kFaceLabel) return label_triangles(name, values);
  const int rank = region_rank(name);
  if (rank > 0 && rank < region_rank_) return;
  if (rank > 0) region_rank_ = rank;
  for (std::size_t c = 0; c < types_.size() && c < values.size(); ++c) {
    if (is_tet(types_[c])) put(rank > 0 ? data.soup.regions : data.piece, slot_[c], values[c]);
  }
}

void CellSorter::label_points(std::string_view name, const std::vector<double>& values) {
  if (!wants_point_array(name)) return;
  auto& labels = name == "cut_front" ? job_.out.data.cut_front : job_.out.data.origin_vertex;
  const std::size_t first = job_.soup().points.size() - values.size();
  for (std::size_t i = 0; i < values.size(); ++i) put(labels, first + i, values[i]);
}

void CellSorter::finish_notes() {
  auto& out = job_.out;
  const auto pad = [](std::vector<std::int32_t>& labels, std::size_t n) {
    if (!labels.empty()) labels.resize(n, 0);
  };
  pad(out.data.soup.regions, out.data.soup.tets.size());
  pad(out.data.piece, out.data.soup.tets.size());
  pad(out.data.triangle_stroke, out.data.triangles.size());
  pad(out.data.origin_vertex, out.data.soup.points.size());
  pad(out.data.cut_front, out.data.soup.points.size());
  left_out_.note(out.notes);
  if (fractions_ > 0) out.notes.push_back(std::to_string(fractions_) + " labels that are not integers became 0");
}

}  // namespace io
}  // namespace v0
}  // namespace incise
