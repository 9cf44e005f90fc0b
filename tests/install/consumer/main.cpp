// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "incise/incise.h"

// Uses installed headers and a symbol of the installed archives, nothing else.
int main() {
  incise::TetSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  soup.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  const incise::Result<incise::TetMesh> mesh = incise::TetMesh::build(soup);
  if (!mesh.ok()) {
    std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
    return 1;
  }
  std::printf("Incise %s: %zu tets, %zu vertices\n", INCISE_VERSION, mesh.value().tet_count(),
              mesh.value().vertex_count());
  return mesh.value().tet_count() == 2 ? 0 : 1;
}
