// SPDX-License-Identifier: Apache-2.0
// What legacy VTK and VTU share: cells by type, and labels by name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/reader.h"

namespace incise {
inline namespace v0 {
namespace io {

/// Numbers of cells as files hold them; those that do not fit become -1, which no cell may hold.
using CellInt = std::int32_t;
constexpr CellInt to_cell_int(std::int64_t n) {
  return n == static_cast<CellInt>(n) ? static_cast<CellInt>(n) : -1;
}

/// The name of other programs' labels of triangles, so that they are not taken for strokes when they come back.
inline constexpr std::string_view kFaceLabel = "face_label";

inline constexpr CellInt kVtkTriangle = 5;
inline constexpr CellInt kVtkTet = 10;
inline constexpr CellInt kVtkTet10 = 24;

/// Sorts cells into tets and triangles, and the labels of cells likewise.
class CellSorter {
 public:
  explicit CellSorter(Job& job) : job_(job) {}

  /// Append cells: `offsets` has one entry more than `types`; vertex numbers count from `first_vertex`.
  bool add(const std::vector<CellInt>& types, const std::vector<CellInt>& offsets,
           const std::vector<CellInt>& connectivity, std::size_t first_vertex, std::size_t n_vertices);

  /// Whether an array of this name is of use.
  [[nodiscard]] static bool wants_cell_array(std::string_view name);
  [[nodiscard]] static bool wants_point_array(std::string_view name) {
    return name == "origin_vertex" || name == "cut_front";
  }

  /// Labels of the cells that the last `add` brought, one per cell.
  void label_cells(std::string_view name, const std::vector<double>& values);
  void label_points(std::string_view name, const std::vector<double>& values);

  /// Call once at the end.
  void finish_notes();

 private:
  bool fail_index(CellInt vertex, std::size_t n);
  bool add_tet(const CellInt* nodes, std::size_t n_nodes, std::size_t first_vertex, std::size_t n_vertices);
  void put(std::vector<std::int32_t>& labels, std::size_t i, double value);
  void label_triangles(std::string_view name, const std::vector<double>& values);

  Job& job_;
  std::vector<std::uint32_t> slot_;  // per cell of the last block: position among the tets or the triangles
  std::vector<CellInt> types_;
  int region_rank_ = 0;
  bool has_strokes_ = false;
  LeftOut left_out_;
  std::uint64_t fractions_ = 0;
};

}  // namespace io
}  // namespace v0
}  // namespace incise
