// SPDX-License-Identifier: Apache-2.0
// A whole solver that is cut: masses and springs along the edges of tets, implicit Euler in time. A cube hangs from its
// top and is cut from one side, step by step, until it hangs by a ligament. Masses and momenta follow the journal as
// conserved attributes; places are those of the mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/attributes.h"
#include "incise/mesh/components.h"
#include "incise/mesh/shapes.h"

namespace {

using incise::TetId, incise::Vec3, incise::VertexId;

constexpr double kDensity = 1, kStiffness = 600;  // at rest the cube's edge is 1 and it weighs 9.81
constexpr double kFrame = 1.0 / 60;               // seconds
constexpr unsigned kSweeps = 20, kCutFrames = 45, kFrames = 150;
const Vec3 kGravity(0, 0, -9.81);

/// Kept with the mesh by the journal alone: whatever a step does to vertices and tets, the sums stay.
struct Matter {
  incise::Attributes attributes;
  incise::AttributeId mass, momentum;

  explicit Matter(const incise::TetMesh& mesh) : attributes(mesh) {
    mass = *attributes.add(mesh, {"mass", incise::Domain::kVertex, 1, incise::Transfer::kConserve});
    momentum = *attributes.add(mesh, {"momentum", incise::Domain::kVertex, 3, incise::Transfer::kConserve});
    mesh.for_each_vertex([&](VertexId v) { mass_of(v) = kDensity * attributes.lumped_volume(v); });
  }
  double& mass_of(VertexId v) { return attributes.value(mass, v.value)[0]; }
  Eigen::Map<Vec3> momentum_of(VertexId v) { return Eigen::Map<Vec3>(attributes.value(momentum, v.value).data()); }
  /// Mass and the three components of momentum.
  std::array<double, 4> sums(const incise::TetMesh& mesh) {
    std::array<double, 4> sums{};
    mesh.for_each_vertex([&](VertexId v) {
      sums[0] += mass_of(v);
      for (unsigned i = 0; i < 3; ++i) sums[i + 1] += momentum_of(v)[i];
    });
    return sums;
  }
};

struct Spring {
  VertexId to;
  double stiffness, length;
};

/// Each tet holds its six edges, in proportion to its volume; they are listed at both ends.
std::vector<std::vector<Spring>> springs_of(const incise::TetMesh& mesh) {
  std::vector<std::vector<Spring>> springs(mesh.vertex_slots());
  mesh.for_each_tet([&](TetId tet) {
    for (const VertexId a : mesh.vertices(tet)) {
      for (const VertexId b : mesh.vertices(tet)) {
        const double length = (mesh.rest(a) - mesh.rest(b)).norm();
        if (a != b) springs[a.value].push_back({b, kStiffness * mesh.rest_volume(tet) / (length * length), length});
      }
    }
  });
  return springs;
}

/// One implicit step. Each vertex in turn goes where its inertia and its springs, as they point now, are least: an
/// average with weights above zero, which lowers the energy however stiff a sliver is. No step of time is too long.
std::vector<Vec3> advance(const incise::TetMesh& mesh, Matter& matter) {
  const auto springs = springs_of(mesh);
  std::vector<Vec3> start(mesh.vertex_slots(), Vec3::Zero()), aim = start, x = start;
  std::vector<VertexId> loose;
  mesh.for_each_vertex([&](VertexId v) {
    x[v.value] = start[v.value] = mesh.current(v);
    matter.momentum_of(v) *= mesh.rest(v).z() < 1;  // the top is held
    if (mesh.rest(v).z() == 1) return;
    loose.push_back(v);
    x[v.value] += kFrame / matter.mass_of(v) * matter.momentum_of(v);
    aim[v.value] = x[v.value] + kFrame * kFrame * kGravity;
  });
  for (unsigned sweep = 0; sweep < kSweeps; ++sweep) {
    for (const VertexId v : loose) {
      double weight = matter.mass_of(v) / (kFrame * kFrame);
      Vec3 sum = weight * aim[v.value];
      for (const Spring& spring : springs[v.value]) {
        const Vec3 way = x[v.value] - x[spring.to.value];
        weight += spring.stiffness;
        sum += spring.stiffness * (x[spring.to.value] + spring.length / std::max(way.norm(), 1e-12) * way);
      }
      x[v.value] = sum / weight;
    }
  }
  for (const VertexId v : loose) matter.momentum_of(v) = matter.mass_of(v) / kFrame * (x[v.value] - start[v.value]);
  return x;
}

/// How far the two sides of the wound stand apart: a vertex that was cut is two, at one place of the rest shape.
double widest_gap(const incise::TetMesh& mesh) {
  std::map<std::array<double, 3>, Vec3> seen;
  double gap = 0;
  mesh.for_each_vertex([&](VertexId v) {
    const Vec3& rest = mesh.rest(v);
    const auto twin = seen.emplace(std::array<double, 3>{rest.x(), rest.y(), rest.z()}, mesh.current(v)).first;
    gap = std::max(gap, (twin->second - mesh.current(v)).norm());
  });
  return gap;
}

/// A straight edge along y that goes in through the side x = 0.
incise::BladePose blade_at(unsigned frame) {
  const double x = -0.05 + 0.75 * frame / kCutFrames;
  return {{Vec3(x, -0.2, 0.47), Vec3(x, 1.2, 0.47)}, Vec3(1, 0, 0)};
}

}  // namespace

int main() {
  auto mesh = incise::TetMesh::build(incise::kuhn_cube(6));
  if (!mesh.ok()) return 1;
  auto engine = incise::Engine::create(std::move(mesh).value());
  if (!engine.ok()) return 1;
  Matter matter(engine->mesh());
  const double mass = matter.sums(engine->mesh())[0];
  double mass_error = 0, momentum_error = 0, gap = 0;
  bool is_ok = engine->begin_stroke(blade_at(0)).ok();
  for (unsigned frame = 1; frame <= kFrames && is_ok; ++frame) {
    const auto before = matter.sums(engine->mesh());
    if (frame <= kCutFrames) is_ok = engine->step(blade_at(frame)).ok();
    if (frame == kCutFrames) is_ok = is_ok && engine->end_stroke().ok();
    is_ok = is_ok && matter.attributes.follow(engine->journal(), engine->mesh()).ok();
    const auto after = matter.sums(engine->mesh());
    mass_error = std::max(mass_error, std::abs(after[0] / mass - 1));
    for (unsigned i = 1; i < 4; ++i) momentum_error = std::max(momentum_error, std::abs(after[i] - before[i]) / mass);
    is_ok = is_ok && engine->set_positions(advance(engine->mesh(), matter)).ok();
    gap = widest_gap(engine->mesh());
    if (frame % 15 == 0) std::printf("frame %3u: %4zu tets, gap %.3f\n", frame, engine->mesh().tet_count(), gap);
  }
  const std::size_t pieces = incise::find_components(engine->mesh()).count();
  std::printf("mass off by %.1e, momentum by %.1e of the mass per step of the journal\n", mass_error, momentum_error);
  std::printf("%zu piece, the wound is %.3f wide\n", pieces, gap);
  return is_ok && mass_error < 1e-12 && momentum_error < 1e-12 && pieces == 1 && gap > 0.05 ? 0 : 1;
}
