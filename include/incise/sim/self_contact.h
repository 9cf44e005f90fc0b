// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {

/// Contact of a body with itself and of its pieces with each other.
///
/// Each vertex of the surface is kept out of the nearest face that faces it, by a spring that only pushes, with
/// Coulomb's friction against an anchor that stays from step to step. Works with `Relaxation::kBlockDescent` alone.
/// *Differs* from the barrier of Li et al. 2020 (IPC), which needs a gap above 0: the walls of a fresh cut have none.
struct SelfContactOptions {
  bool on = false;        ///< whether there is any
  double friction = 0.3;  ///< of tissue on tissue, at least 0; wet tissue: 0.05 to 0.3
  double stiffness = 0;   ///< Pa per metre of depth, at least 0; 0: Young's modulus of the softer side by its edges
};

}  // namespace v0
}  // namespace incise
