// SPDX-License-Identifier: Apache-2.0
// Legacy .vtk.
#include "io/writer.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

void vtk_scalars(Text& out, std::string_view name, const Labels& values) {
  out << "SCALARS " << name << " int 1\nLOOKUP_TABLE default\n";
  for (const std::int32_t value : values) out << value << '\n';
}

}  // namespace

std::string write_vtk(const MeshData& data, MshVariant /*variant*/) {
  Text out;
  const auto& soup = data.soup;
  const std::size_t n_cells = soup.tets.size() + data.triangles.size();
  out << "# vtk DataFile Version 4.2\nwritten by Incise\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
      << soup.points.size() << " double\n";
  for (const Vec3& p : soup.points) out << p << '\n';
  out << "CELLS " << n_cells << ' ' << 5 * soup.tets.size() + 4 * data.triangles.size() << '\n';
  for (const auto& tet : soup.tets) (out << "4 ").row(tet, 0) << '\n';
  for (const auto& triangle : data.triangles) (out << "3 ").row(triangle, 0) << '\n';
  out << "CELL_TYPES " << n_cells << '\n';
  for (std::size_t i = 0; i < n_cells; ++i) out << (i < soup.tets.size() ? "10\n" : "5\n");
  out << "CELL_DATA " << n_cells << '\n';
  for (const NamedLabels& array : cell_arrays(data)) vtk_scalars(out, array.name, array.values);
  const std::vector<NamedLabels> arrays = point_arrays(data);
  if (!arrays.empty()) out << "POINT_DATA " << soup.points.size() << '\n';
  for (const NamedLabels& array : arrays) vtk_scalars(out, array.name, array.values);
  return out.take();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
