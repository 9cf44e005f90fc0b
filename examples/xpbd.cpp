// SPDX-License-Identifier: Apache-2.0
// A solver of one's own on the mirror of the journal: extended position-based dynamics (Macklin, Müller and Chentanez,
// MIG 2016) of edges and volumes. A beam is held at one end and slit along its whole length while it bends: two halves
// hang where it hung, since the copies of held vertices are held.
#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/components.h"
#include "incise/mesh/journal_mirror.h"
#include "incise/mesh/shapes.h"

namespace {

using incise::TetId, incise::Vec3, incise::VertexId;

constexpr std::uint32_t kHeld = 1;
constexpr double kFrame = 1.0 / 60, kCompliance = 5e-2;  // s; m/N: the beam weighs 20 N
constexpr unsigned kSubsteps = 20, kCutFrames = 60, kFrames = 90;

struct Xpbd {
  incise::JournalMirror mirror;
  std::vector<double> volume;  // of each tet at rest, times six

  explicit Xpbd(const incise::TetMesh& mesh) : mirror(mesh) {
    mesh.for_each_vertex([&](VertexId v) { mirror.vertex(v).marks = mesh.rest(v).x() == 0 ? kHeld : 0; });
    mesh.for_each_tet([&](TetId t) { measure(t); });
  }
  void follow(const incise::Journal& journal) {
    mirror.follow(journal);
    for (const TetId t : mirror.changed_tets()) measure(t);
  }
  void measure(TetId t) {
    volume.resize(mirror.tets().size());
    const auto x = [&](unsigned c) { return mirror.vertex(mirror.tet(t).vertices[c]).rest; };
    volume[t.value] = (x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0));
  }
  /// The inverse of its mass, at a density of 1: a quarter of each of its tets.
  double lightness(VertexId v) const {
    double mass = 0;
    for (const TetId t : mirror.tets_of(v)) mass += volume[t.value] / 24;
    return (mirror.vertex(v).marks & kHeld) != 0 || mass <= 0 ? 0 : 1 / mass;
  }
  void advance() {
    constexpr double h = kFrame / kSubsteps;
    std::vector<double> w;
    for (std::uint32_t v = 0; v < mirror.vertices().size(); ++v) w.push_back(lightness(VertexId(v)));
    for (unsigned step = 0; step < kSubsteps; ++step) {
      const std::vector<Vec3> before = mirror.positions();
      for (std::uint32_t v = 0; v < w.size(); ++v) {
        auto& vertex = mirror.vertex(VertexId(v));
        if (w[v] > 0) vertex.current += h * (vertex.velocity += h * Vec3(0, 0, -9.81));
      }
      for (std::uint32_t t = 0; t < volume.size(); ++t) {
        if (mirror.tets()[t].is_live()) project(mirror.tets()[t].vertices, volume[t], w, h);
      }
      for (std::uint32_t v = 0; v < w.size(); ++v) {
        auto& vertex = mirror.vertex(VertexId(v));
        vertex.velocity = 0.999 * (vertex.current - before[v]) / h;
      }
    }
  }
  void project(const incise::TetVertices& id, double rest_volume, const std::vector<double>& w, double h) {
    const auto x = [&](unsigned c) -> Vec3& { return mirror.vertex(id[c]).current; };
    for (unsigned a = 0; a < 4; ++a) {
      for (unsigned b = 0; b < a; ++b) {
        const double length = (mirror.vertex(id[a]).rest - mirror.vertex(id[b]).rest).norm();
        const Vec3 way = x(a) - x(b);
        const double sum = w[id[a].value] + w[id[b].value] + kCompliance / (h * h);
        const Vec3 pull = (way.norm() - length) / (sum * way.norm()) * way;
        x(a) -= w[id[a].value] * pull;
        x(b) += w[id[b].value] * pull;
      }
    }
    const Vec3 g[4] = {(x(3) - x(1)).cross(x(2) - x(1)), (x(2) - x(0)).cross(x(3) - x(0)),
                       (x(3) - x(0)).cross(x(1) - x(0)), (x(1) - x(0)).cross(x(2) - x(0))};
    double sum = 1e-30;
    for (unsigned c = 0; c < 4; ++c) sum += w[id[c].value] * g[c].squaredNorm();
    const double excess = g[3].dot(x(3) - x(0)) - rest_volume;
    for (unsigned c = 0; c < 4; ++c) x(c) -= w[id[c].value] * excess / sum * g[c];
  }
};

/// An edge along z that comes from the free end of the beam.
incise::BladePose blade_at(unsigned frame) {
  const double x = 2.3 - 2.6 * frame / kCutFrames;
  return {{Vec3(x, 0.48, -3), Vec3(x, 0.52, 2)}, Vec3(-1, 0, 0)};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) {
    std::fprintf(stderr, "%s: takes no arguments\nusage: %s\n", argv[1], argv[0]);
    return 2;
  }
  auto mesh = incise::TetMesh::build(incise::kuhn_box(Vec3(0, 0, 0), Vec3(2, 1, 1), {6, 3, 3}));
  if (!mesh.ok()) return 1;
  auto engine = incise::Engine::create(std::move(mesh).value());
  Xpbd solver(engine->mesh());
  bool is_ok = engine->begin_stroke(blade_at(0)).ok();
  for (unsigned frame = 1; frame <= kFrames && is_ok; ++frame) {
    if (frame <= kCutFrames) is_ok = engine->step(blade_at(frame)).ok();
    if (frame == kCutFrames) is_ok = is_ok && engine->end_stroke().ok();
    solver.follow(engine->journal());
    solver.advance();
    is_ok = is_ok && engine->set_positions(solver.mirror.positions()).ok();
  }
  double lowest = 0;
  std::size_t held = 0, let_go = 0;
  for (const auto& vertex : solver.mirror.vertices()) {
    if (!vertex.is_live) continue;
    lowest = std::min(lowest, vertex.current.z() - vertex.rest.z());
    if (vertex.rest.x() == 0) ++(vertex.marks == kHeld ? held : let_go);
  }
  const std::size_t pieces = incise::find_components(engine->mesh()).count();
  std::printf("%zu tets, %zu pieces; %zu held vertices of 16 at first, %zu let go; it sinks by %.3f\n",
              engine->mesh().tet_count(), pieces, held, let_go, -lowest);
  if (std::fflush(stdout) != 0) {
    std::fprintf(stderr, "the result cannot be written; make room where the output goes\n");
    return 1;
  }
  return is_ok && pieces == 2 && held > 16 && let_go == 0 && lowest > -1 && lowest < -0.1 ? 0 : 1;
}
