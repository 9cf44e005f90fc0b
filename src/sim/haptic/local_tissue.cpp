// SPDX-License-Identifier: Apache-2.0
// Return mapping of an elastic body with dry yield along two axes, as in plasticity: first the elastic force, then as
// much slip along each axis as brings its part of the force back to the limit.
#include "incise/sim/local_tissue.h"

#include <Eigen/LU>
#include <algorithm>

namespace incise {
inline namespace v0 {

namespace {

/// Lets the tissue slip along `axis` until the force along it lies in [low, high].
void yield_along(const Vec3& axis, double low, double high, const Eigen::Matrix3d& stiffness, double& slip,
                 Vec3& force) {
  const double along = force.dot(axis);
  const double excess = std::clamp(along, low, high) - along;
  if (excess == 0) return;
  const Vec3 per_slip = stiffness * axis;
  const double distance = excess / per_slip.dot(axis);
  slip += distance;
  force += distance * per_slip;
}

}  // namespace

void LocalTissue::follow(const HapticSnapshot& snapshot) {
  snapshot_ = snapshot;
  cut_slip_ = edge_slip_ = 0;
  is_cutting_ = snapshot.ruptured;
}

LocalTissue::Limits LocalTissue::cut_limits() const {
  const double onset = is_cutting_ ? 1.0 : options_.onset;
  const double friction = snapshot_.friction_force();
  return {-(snapshot_.fracture_force() * onset + friction), friction};
}

void LocalTissue::switch_rupture(double force_along_cut) {
  if (!is_cutting_) {
    is_cutting_ = force_along_cut < cut_limits().low;
  } else if (-force_along_cut < -options_.arrest * cut_limits().low) {
    is_cutting_ = false;
  }
}

Vec3 LocalTissue::force(double spring, const Vec3& handle) {
  if (!snapshot_.touches) return Vec3::Zero();
  const Vec3& cut = snapshot_.cutting_direction;
  const Vec3 edge = snapshot_.edge_direction();
  Eigen::Matrix3d softness = snapshot_.compliance;
  softness.diagonal().array() += 1 / spring;
  const Eigen::Matrix3d stiffness = softness.inverse();  // of tissue and spring in a row; exists, since 1/spring > 0
  const Vec3 strain =
      snapshot_.compliance * snapshot_.force - (handle - snapshot_.tool_position) + cut_slip_ * cut + edge_slip_ * edge;
  Vec3 force = stiffness * strain;
  switch_rupture(force.dot(cut));
  const Limits limits = cut_limits();
  const double rub = snapshot_.friction_force();
  // Slip along one axis changes the force along the other a little; the second pass leaves a few percent of that.
  for (int pass = 0; pass < 2; ++pass) {
    yield_along(edge, -rub, rub, stiffness, edge_slip_, force);
    yield_along(cut, limits.low, limits.high, stiffness, cut_slip_, force);
  }
  const double along_edge = force.dot(edge);
  return force + (std::clamp(along_edge, -rub, rub) - along_edge) * edge;
}

}  // namespace v0
}  // namespace incise
