// SPDX-License-Identifier: Apache-2.0
// MEDIT .mesh.
#include <algorithm>
#include <limits>

#include "io/reader.h"
#include "io/region_names.h"
#include "io/writer.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

// Which labels are ours: without it a reader must take them for somebody else's.
void medit_mark(Text& out, const MeshData& data) {
  if (!has_strokes(data) && data.origin_vertex.empty() && data.cut_front.empty()) return;
  out << kMeditMark;
  if (has_strokes(data)) out << " stroke";
  if (!data.origin_vertex.empty()) out << " origin_vertex";
  if (!data.cut_front.empty()) out << " cut_front";
  out << '\n';
}

void medit_corners(Text& out, const Labels& cut_front) {
  const auto is_front = [](std::int32_t front) { return front != 0; };
  const auto n = std::count_if(cut_front.begin(), cut_front.end(), is_front);
  if (n > 0) out << "Corners\n" << n << '\n';
  for (std::size_t i = 0; i < cut_front.size(); ++i) {
    if (is_front(cut_front[i])) out << i + 1 << '\n';
  }
}

}  // namespace

std::string write_medit(const MeshData& data, MshVariant /*variant*/) {
  Text out;
  out << "MeshVersionFormatted 2\nDimension 3\n";
  medit_mark(out, data);
  for (const auto& [region, name] : data.region_names) out << kMeditRegion << ' ' << to_entry(region, name) << '\n';
  out << "Vertices\n" << data.soup.points.size() << '\n';
  for (std::size_t i = 0; i < data.soup.points.size(); ++i) {
    const std::int32_t origin = data.origin_vertex.empty() ? -1 : data.origin_vertex[i];
    const bool has_label = origin >= 0 && origin < std::numeric_limits<std::int32_t>::max();
    out << data.soup.points[i] << ' ' << (has_label ? origin + 1 : 0) << '\n';
  }
  medit_corners(out, data.cut_front);
  if (!data.triangles.empty()) out << "Triangles\n" << data.triangles.size() << '\n';
  for (std::size_t i = 0; i < data.triangles.size(); ++i) {
    out.row(data.triangles[i], 1) << ' ' << label(data.triangle_stroke, i) << '\n';
  }
  out << "Tetrahedra\n" << data.soup.tets.size() << '\n';
  for (std::size_t i = 0; i < data.soup.tets.size(); ++i) {
    out.row(data.soup.tets[i], 1) << ' ' << label(data.soup.regions, i) << '\n';
  }
  out << "End\n";
  return out.take();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
