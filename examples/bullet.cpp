// SPDX-License-Identifier: Apache-2.0
// Somebody else's solver: a soft body of Bullet (masses and springs along the edges of tets) follows the cut of a beam
// that hangs between two walls, by the mirror of the journal. Where the blade has passed, two halves hang down.
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "incise/mesh/components.h"
#include "incise/mesh/journal_mirror.h"
#include "incise/mesh/shapes.h"

namespace {

using incise::TetId, incise::Vec3, incise::VertexId;

constexpr std::uint32_t kHeld = 1;
constexpr double kDensity = 1000, kLength = 0.4;  // kg/m³, m
constexpr int kFrames = 120, kCutBegins = 20, kCutEnds = 80;
const btVector3 kGravity(0, 0, btScalar(-9.81));

btVector3 to_bullet(const Vec3& p) {
  return {static_cast<btScalar>(p.x()), static_cast<btScalar>(p.y()), static_cast<btScalar>(p.z())};
}
Vec3 to_incise(const btVector3& p) {
  return {p.x(), p.y(), p.z()};
}

/// Nodes by vertex slot. Those of free slots have no mass and no links, and stay where they are.
class BulletFollower {
 public:
  BulletFollower(btSoftBodyWorldInfo& world, const incise::TetMesh& mesh) : body(&world), mirror_(mesh) {
    mesh.for_each_vertex([&](VertexId v) {
      const double x = mesh.rest(v).x();
      mirror_.vertex(v).marks = std::min(x, kLength - x) < 1e-9 ? kHeld : 0;
    });
    body.appendMaterial()->m_kLST = btScalar(0.1);  // before the first node, which would point to nothing else
    body.m_cfg.piterations = 60;
    body.m_cfg.kDP = btScalar(0.01);
    body.m_cfg.collisions = 0;
    std::vector<VertexId> all;
    mesh.for_each_vertex([&](VertexId v) { all.push_back(v); });
    rebuild(all);
  }
  /// Where the nodes went; for `Engine::set_positions`.
  std::vector<Vec3> positions() {
    for (int i = 0; i < body.m_nodes.size(); ++i) {
      auto& vertex = mirror_.vertex(VertexId(static_cast<std::uint32_t>(i)));
      vertex.current = to_incise(body.m_nodes[i].m_x);
      vertex.velocity = to_incise(body.m_nodes[i].m_v);
    }
    return mirror_.positions();
  }
  void follow(const incise::Journal& journal) {
    mirror_.follow(journal);
    if (!mirror_.changed_tets().empty()) rebuild(mirror_.fresh());
  }
  [[nodiscard]] bool is_sound(const incise::TetMesh& mesh) const { return mirror_.difference(mesh).empty(); }

  btSoftBody body;

 private:
  void rebuild(const std::vector<VertexId>& fresh) {
    while (body.m_nodes.size() < static_cast<int>(mirror_.vertices().size())) body.appendNode({0, 0, 0}, 0);
    for (const VertexId v : fresh) {
      btSoftBody::Node& node = body.m_nodes[static_cast<int>(v.value)];
      node.m_x = node.m_q = to_bullet(mirror_.vertex(v).current);
      node.m_v = to_bullet(mirror_.vertex(v).velocity);
    }
    std::vector<double> mass(mirror_.vertices().size());
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& tet : mirror_.tets()) {
      if (tet.is_live()) add(tet.vertices, mass, edges);
    }
    for (std::uint32_t v = 0; v < mass.size(); ++v) {
      const bool is_held = mirror_.vertex(VertexId(v)).marks == kHeld;
      body.setMass(static_cast<int>(v), is_held ? 0 : static_cast<btScalar>(mass[v]));
    }
    link(edges);
  }
  void add(const incise::TetVertices& v, std::vector<double>& mass,
           std::set<std::pair<std::uint32_t, std::uint32_t>>& edges) const {
    const auto x = [&](unsigned c) -> const Vec3& { return mirror_.vertex(v[c]).rest; };
    const double volume = (x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0)) / 6;
    for (unsigned a = 0; a < 4; ++a) {
      mass[v[a].value] += kDensity * volume / 4;
      for (unsigned b = 0; b < a; ++b) edges.insert(std::minmax(v[a].value, v[b].value));
    }
  }
  /// Bullet takes out links by their place alone: they are listed anew.
  void link(const std::set<std::pair<std::uint32_t, std::uint32_t>>& edges) {
    body.m_links.resize(0);
    for (const auto& [a, b] : edges) {
      body.appendLink(static_cast<int>(a), static_cast<int>(b));
      const double length = (mirror_.vertex(VertexId(a)).rest - mirror_.vertex(VertexId(b)).rest).norm();
      body.m_links[body.m_links.size() - 1].m_rl = static_cast<btScalar>(length);
    }
    for (int i = 0; i < body.m_links.size(); ++i) body.m_links[i].m_c1 = body.m_links[i].m_rl * body.m_links[i].m_rl;
    body.updateLinkConstants();  // updateConstants would take lengths as they are now for lengths at rest
  }

  incise::JournalMirror mirror_;
};

/// An edge along y that comes down through the middle.
incise::BladePose blade_at(int frame) {
  const double z = 0.3 - 0.012 * (frame - kCutBegins);
  return {{Vec3(0.177, -0.2, z), Vec3(0.186, 0.4, z)}, Vec3(0, 0, -1)};
}

bool cut(incise::Engine& engine, int frame) {
  if (frame == kCutBegins) return engine.begin_stroke(blade_at(frame)).ok();
  if (frame > kCutBegins && frame <= kCutEnds) return engine.step(blade_at(frame)).ok();
  return frame != kCutEnds + 1 || engine.end_stroke().ok();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) {
    std::fprintf(stderr, "%s: takes no arguments\nusage: %s\n", argv[1], argv[0]);
    return 2;
  }
  auto mesh = incise::TetMesh::build(incise::kuhn_box(Vec3(0, 0, 0), Vec3(kLength, 0.1, 0.1), {12, 3, 3}));
  if (!mesh.ok()) return 1;
  auto engine = incise::Engine::create(std::move(mesh).value());
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(kGravity);
  world.getWorldInfo().m_gravity = kGravity;
  BulletFollower follower(world.getWorldInfo(), engine->mesh());
  world.addSoftBody(&follower.body);
  double before = 0, lowest = 0;
  bool is_ok = true;
  for (int frame = 0; frame < kFrames && is_ok; ++frame) {
    world.stepSimulation(btScalar(1.0 / 60), 8, btScalar(1.0 / 240));
    const std::vector<Vec3> places = follower.positions();
    is_ok = engine->set_positions(places).ok() && cut(*engine, frame);
    follower.follow(engine->journal());
    is_ok = is_ok && follower.is_sound(engine->mesh());
    lowest = 0;
    engine->mesh().for_each_vertex([&](VertexId v) { lowest = std::min(lowest, engine->mesh().current(v).z()); });
    if (frame == kCutBegins) before = lowest;
  }
  world.removeSoftBody(&follower.body);
  const std::size_t pieces = incise::find_components(engine->mesh()).count();
  std::printf("Bullet %d: %zu tets, %zu pieces; sagged by %.3f m before the cut, by %.3f m after\n", btGetVersion(),
              engine->mesh().tet_count(), pieces, -before, -lowest);
  if (std::fflush(stdout) != 0) {
    std::fprintf(stderr, "the result cannot be written; make room where the output goes\n");
    return 1;
  }
  return is_ok && pieces == 2 && lowest < before - 0.02 && lowest > -kLength ? 0 : 1;
}
