// SPDX-License-Identifier: Apache-2.0
#include "soak/models.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace incise::test {

namespace fs = std::filesystem;

std::vector<fs::path> corpus_files() {
  std::vector<fs::path> files;
  const char* root = std::getenv("INCISE_CORPUS");
  if (root == nullptr || !fs::is_directory(fs::path(root) / "tets")) return files;
  for (const auto& entry : fs::directory_iterator(fs::path(root) / "tets")) {
    // A TetGen mesh is named by either of its files.
    if (entry.is_regular_file() && entry.path().extension() != ".node") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TetSoup to_soup(const TetMesh& mesh) {
  TetSoup soup;
  std::vector<std::uint32_t> number(mesh.vertex_slots());
  mesh.for_each_vertex([&](VertexId v) {
    number[v.value] = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(mesh.rest(v));
  });
  mesh.for_each_tet([&](TetId tet) {
    const TetVertices& v = mesh.vertices(tet);
    soup.tets.push_back({number[v[0].value], number[v[1].value], number[v[2].value], number[v[3].value]});
  });
  return soup;
}

}  // namespace incise::test
