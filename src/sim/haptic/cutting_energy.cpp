// SPDX-License-Identifier: Apache-2.0
// Work by the trapezoidal rule between two places of the tool; what is dissipated is what is left over.
#include "incise/sim/cutting_energy.h"

#include <cmath>

namespace incise {
inline namespace v0 {

void CuttingEnergy::move_tool(const Vec3& force, const Vec3& position) {
  if (is_moving_) external_ -= 0.5 * (force_ + force).dot(position - position_);
  force_ = force;
  position_ = position;
  is_moving_ = true;
}

EnergyBalance CuttingEnergy::balance() const {
  EnergyBalance balance;
  balance.external = external_;
  balance.stored = stored_ - stored_at_start_;
  balance.fracture = fracture_;
  balance.friction = friction_;
  balance.dissipated = external_ - balance.stored - fracture_ - friction_;
  balance.tolerance = tolerance_.absolute + tolerance_.relative * std::abs(external_);
  return balance;
}

}  // namespace v0
}  // namespace incise
