// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "incise/geom/vec.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::bench {

/// What a body of Bullet is made of, in SI units.
struct BulletMaterial {
  double density = 1000;  ///< kg/m³
  double young = 30e3;    ///< Pa
  double poisson = 0.45;
  double damping = 0;  ///< of the moduli, s; with damping a step takes half as long again
};

/// Bullet's deformable body as a peer: stable neo-Hookean tets, implicit Euler with one Newton step per step of time by
/// conjugate gradients with the masses as preconditioner, in single precision as it is packaged. No contact, no sleep.
/// With 10 kPa and less the iteration meets negative directions, and the body may fly off: keep it stiffer.
class BulletBody {
 public:
  /// @param mesh  in metres; every slot live.
  /// @param held  vertices that stay where they are.
  BulletBody(const TetMesh& mesh, const BulletMaterial& material, std::span<const VertexId> held);
  BulletBody(BulletBody&&) noexcept;
  ~BulletBody();

  /// One implicit step of `dt` seconds under gravity (0, 0, -9.81).
  void step(double dt);
  /// By vertex slot, in metres.
  [[nodiscard]] std::vector<Vec3> positions() const;
  static std::string version();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace incise::bench
