// SPDX-License-Identifier: Apache-2.0
// TetGen's .node and .ele.
#include "io/writer.h"

namespace incise {
inline namespace v0 {
namespace io {
std::string write_node(const MeshData& data, MshVariant /*variant*/) {
  Text out;
  const bool origin = !data.origin_vertex.empty();
  if (origin) out << "# incise: origin_vertex\n";
  out << data.soup.points.size() << " 3 " << (origin ? 1 : 0) << " 0\n";
  for (std::size_t i = 0; i < data.soup.points.size(); ++i) {
    out << i << ' ' << data.soup.points[i];
    if (origin) out << ' ' << data.origin_vertex[i];
    out << '\n';
  }
  return out.take();
}

std::string write_ele(const MeshData& data, MshVariant /*variant*/) {
  Text out;
  const bool piece = !data.piece.empty();
  const bool region = piece || !data.soup.regions.empty();
  if (piece) out << "# incise: region piece\n";
  out << data.soup.tets.size() << " 4 " << (piece ? 2 : region ? 1 : 0) << '\n';
  for (std::size_t i = 0; i < data.soup.tets.size(); ++i) {
    (out << i << ' ').row(data.soup.tets[i], 0);
    if (region) out << ' ' << label(data.soup.regions, i);
    if (piece) out << ' ' << data.piece[i];
    out << '\n';
  }
  return out.take();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
