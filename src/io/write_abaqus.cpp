// SPDX-License-Identifier: Apache-2.0
// Abaqus .inp.
#include "io/writer.h"

namespace incise {
inline namespace v0 {
namespace io {
std::string write_abaqus(const MeshData& data, MshVariant /*variant*/) {
  Text out;
  const auto& soup = data.soup;
  out << "*HEADING\nwritten by Incise\n*NODE\n";
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    const Vec3& p = soup.points[i];
    out << i + 1 << ", " << p.x() << ", " << p.y() << ", " << p.z() << '\n';
  }
  out << "*ELEMENT, TYPE=C3D4, ELSET=region_0\n";
  for (std::size_t i = 0; i < soup.tets.size(); ++i) {
    const auto& t = soup.tets[i];
    out << i + 1 << ", " << t[0] + 1 << ", " << t[1] + 1 << ", " << t[2] + 1 << ", " << t[3] + 1 << '\n';
  }
  label_sets(out, "*ELSET, ELSET=", "region_", soup.regions);
  label_sets(out, "*ELSET, ELSET=", "piece_", data.piece);
  return out.take();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
