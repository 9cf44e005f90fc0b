// SPDX-License-Identifier: Apache-2.0
#include "bullet_body.h"

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <btBulletDynamicsCommon.h>

namespace incise::bench {

namespace {

const btVector3 kGravity(0, 0, btScalar(-9.81));

btVector3 to_bullet(const Vec3& p) {
  return {static_cast<btScalar>(p.x()), static_cast<btScalar>(p.y()), static_cast<btScalar>(p.z())};
}

btSoftBody::TetraScratch at_rest() {
  btSoftBody::TetraScratch scratch;
  scratch.m_F.setIdentity();
  scratch.m_cofF.setIdentity();
  scratch.m_corotation.setIdentity();
  scratch.m_trace = 3;
  scratch.m_J = 1;
  return scratch;
}

}  // namespace

class BulletBody::Impl {
 public:
  Impl(const TetMesh& mesh, const BulletMaterial& material, std::span<const VertexId> held)
      : neo_hookean_(static_cast<btScalar>(material.young / (2 * (1 + material.poisson))),
                     static_cast<btScalar>(material.young * material.poisson /
                                           ((1 + material.poisson) * (1 - 2 * material.poisson))),
                     static_cast<btScalar>(material.damping)),
        gravity_(kGravity) {
    solver_.setDeformableSolver(&deformable_solver_);
    world_.setGravity(kGravity);
    world_.getWorldInfo().m_gravity = kGravity;
    world_.setImplicit(true);
    world_.setUseProjection(true);  // without it the implicit step has no preconditioner, and moves nothing
    world_.setLineSearch(false);
    build(mesh);
    weigh(mesh, material.density, held);
    world_.addSoftBody(&body_);
    world_.addForce(&body_, &neo_hookean_);
    world_.addForce(&body_, &gravity_);
  }
  ~Impl() { world_.removeSoftBody(&body_); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void step(double dt) {
    const auto time = static_cast<btScalar>(dt);
    world_.stepSimulation(time, 1, time);
  }
  [[nodiscard]] std::vector<Vec3> positions() const {
    std::vector<Vec3> places;
    for (int i = 0; i < body_.m_nodes.size(); ++i) {
      const btVector3& x = body_.m_nodes[i].m_x;
      places.emplace_back(x.x(), x.y(), x.z());
    }
    return places;
  }

 private:
  void build(const TetMesh& mesh) {
    body_.appendMaterial();  // the nodes point to it
    mesh.for_each_vertex([&](VertexId v) { body_.appendNode(to_bullet(mesh.rest(v)), 1); });
    mesh.for_each_tet([&](TetId t) {
      const TetVertices& v = mesh.vertices(t);
      body_.appendTetra(static_cast<int>(v[0].value), static_cast<int>(v[1].value), static_cast<int>(v[2].value),
                        static_cast<int>(v[3].value));
    });
    body_.m_cfg.collisions = 0;
    body_.m_cfg.kDP = 0;
    body_.setSelfCollision(false);
    body_.setActivationState(DISABLE_DEACTIVATION);
    body_.m_sleepingThreshold = 0;
    // Bullet's readers of files do this; without it the forces read beyond the arrays.
    body_.initializeDmInverse();
    const btSoftBody::TetraScratch rest = at_rest();
    body_.m_tetraScratches.resize(body_.m_tetras.size(), rest);
    body_.m_tetraScratchesTn.resize(body_.m_tetras.size(), rest);
  }
  void weigh(const TetMesh& mesh, double density, std::span<const VertexId> held) {
    std::vector<double> mass(mesh.vertex_slots());
    mesh.for_each_tet([&](TetId t) {
      for (const VertexId v : mesh.vertices(t)) {
        mass[v.value] += density * mesh.rest_volume(t) / 4;
      }
    });
    for (const VertexId v : held) {
      mass[v.value] = 0;  // for Bullet: does not move
    }
    for (std::size_t v = 0; v < mass.size(); ++v) {
      body_.setMass(static_cast<int>(v), static_cast<btScalar>(mass[v]));
    }
  }

  // In the order in which they need each other.
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btDeformableBodySolver deformable_solver_;
  btDeformableMultiBodyConstraintSolver solver_;
  btDeformableMultiBodyDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_, &deformable_solver_};
  btSoftBody body_{&world_.getWorldInfo()};
  btDeformableNeoHookeanForce neo_hookean_;
  btDeformableGravityForce gravity_;
};

BulletBody::BulletBody(const TetMesh& mesh, const BulletMaterial& material, std::span<const VertexId> held)
    : impl_(std::make_unique<Impl>(mesh, material, held)) {}
BulletBody::BulletBody(BulletBody&&) noexcept = default;
BulletBody::~BulletBody() = default;

void BulletBody::step(double dt) {
  impl_->step(dt);
}
std::vector<Vec3> BulletBody::positions() const {
  return impl_->positions();
}
std::string BulletBody::version() {
  return std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
}

}  // namespace incise::bench
