// SPDX-License-Identifier: Apache-2.0
// Vega FEM's .veg.
#include "io/writer.h"

namespace incise {
inline namespace v0 {
namespace io {
std::string write_vega(const MeshData& data, MshVariant /*variant*/) {
  Text out;
  const auto& soup = data.soup;
  out << "# Vega mesh file, written by Incise\n*VERTICES\n" << soup.points.size() << " 3 0 0\n";
  for (std::size_t i = 0; i < soup.points.size(); ++i) out << i + 1 << ' ' << soup.points[i] << '\n';
  out << "\n*ELEMENTS\nTET\n" << soup.tets.size() << " 4 0\n";
  for (std::size_t i = 0; i < soup.tets.size(); ++i) (out << i + 1 << ' ').row(soup.tets[i], 1) << '\n';
  out << '\n';
  label_sets(out, "*SET ", "region_", soup.regions);
  label_sets(out, "*SET ", "piece_", data.piece);
  out << "*MATERIAL tissue\nENU, 1000, 10000, 0.45\n\n*REGION\nallElements, tissue\n";
  return out.take();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
