// SPDX-License-Identifier: Apache-2.0
// Cuts the paper's cube of 750 tets through the middle of a layer of cells.
#include <cstdio>

#include "incise/engine/engine.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/shapes.h"

int main() {
  auto mesh = incise::TetMesh::build(incise::kuhn_cube(5));
  if (!mesh.ok()) return 1;
  const std::size_t before = mesh->tet_count();
  const auto plane = incise::plane_stroke(incise::rest_bounds(*mesh), incise::Vec3(1, 0, 0), 0.5);

  incise::EngineOptions options;
  options.maintain.merge = options.maintain.improve = false;  // cut, and leave the new tets as they come
  auto engine = incise::Engine::create(std::move(mesh).value(), options);
  const auto report = engine->cut(*plane);
  if (!report.ok()) {
    std::fprintf(stderr, "%s\n", report.error().message.c_str());
    return 1;
  }
  const auto pieces = incise::find_components(engine->mesh());
  std::printf("%zu -> %zu tets, %zu pieces\n", before, engine->mesh().tet_count(), pieces.count());
  for (std::size_t i = 0; i < pieces.count(); ++i) {
    std::printf("piece %zu: volume %.17g\n", i, pieces.volume[i]);
  }
  engine->undo();
  return engine->mesh().tet_count() == before ? 0 : 1;
}
