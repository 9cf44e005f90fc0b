// SPDX-License-Identifier: Apache-2.0
// Cuts a cube step by step while it moves, and keeps a copy of it by the journal alone: a template for solvers.
// After every call the copy is compared with the mesh, bit for bit.
#include <cstdio>
#include <string>
#include <utility>

#include "incise/engine/engine.h"
#include "incise/mesh/journal_mirror.h"
#include "incise/mesh/shapes.h"

namespace {

using incise::JournalMirror;
using incise::Vec3;

constexpr unsigned kSteps = 24;
constexpr double kStep = 1.0 / kSteps;  // seconds

/// A straight edge along y that comes down through the middle of a cell.
incise::BladePose blade_at(double time) {
  const double z = 1.2 - 1.4 * time;
  return {{Vec3(0.48, -0.2, z), Vec3(0.52, 1.2, z)}, Vec3(0, 0, -1)};
}

/// Stands for a solver: all vertices gain speed to the sides, and move.
void move_on(JournalMirror& mirror) {
  for (std::uint32_t slot = 0; slot < mirror.vertices().size(); ++slot) {
    JournalMirror::Vertex& vertex = mirror.vertex(incise::VertexId(slot));
    if (!vertex.is_live) continue;
    vertex.velocity.x() += kStep * (vertex.rest.x() < 0.5 ? -0.1 : 0.1);
    vertex.current += kStep * vertex.velocity;
  }
}

/// An engine and the copy of its mesh.
struct Pair {
  incise::Engine engine;
  JournalMirror mirror;
  bool is_equal = true;

  /// Called after each call that may change the mesh.
  void follow(const char* what) {
    mirror.follow(engine.journal());
    const std::string difference = mirror.difference(engine.mesh());
    std::printf("%-10s step %3zu of the journal: %5zu tets, %3zu fresh vertices%s%s\n", what, mirror.position(),
                engine.mesh().tet_count(), mirror.fresh().size(), difference.empty() ? "" : ", differs at ",
                difference.c_str());
    is_equal = is_equal && difference.empty();
  }
  /// Between two steps of the blade. A solver would first let the vertices in `mirror.fresh()` find their balance.
  bool move() {
    move_on(mirror);
    return engine.set_positions(mirror.positions()).ok();
  }
};

bool cut(Pair& pair) {
  if (!pair.engine.begin_stroke(blade_at(0)).ok()) return false;
  for (unsigned i = 1; i <= kSteps; ++i) {
    if (!pair.engine.step(blade_at(i * kStep)).ok()) return false;
    pair.follow("cut");
    if (!pair.move()) return false;
  }
  if (!pair.engine.end_stroke().ok()) return false;
  pair.follow("end");
  return true;
}

}  // namespace

int main() {
  auto mesh = incise::TetMesh::build(incise::kuhn_cube(5));
  if (!mesh.ok()) return 1;
  auto engine = incise::Engine::create(std::move(mesh).value());
  if (!engine.ok()) return 1;
  const JournalMirror mirror(engine->mesh());
  Pair pair{std::move(engine).value(), mirror};
  if (!cut(pair) || !pair.move()) return 1;

  pair.engine.undo();  // the journal's position falls: what the steps touched goes back, velocities of ours included
  pair.follow("undo");
  pair.engine.redo();  // and rises again: everything is as it was when it was undone
  pair.follow("redo");
  if (!pair.engine.improve().ok()) return 1;
  pair.follow("improve");
  std::printf("%s\n", pair.is_equal ? "bit for bit the same throughout" : "not the same");
  return pair.is_equal ? 0 : 1;
}
