// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "soak/simulations.h"

namespace incise::test {

/// What a scene did.
struct SimulationOutcome {
  std::string fault;    ///< which frame, and what is wrong; empty where nothing is
  unsigned frames = 0;  ///< done, the faulty one included
  std::uint64_t hash = 0;
  std::size_t tets = 0;
  double fastest = 0;      ///< of any vertex in any frame, m/s
  double energy_gain = 0;  ///< the most in one frame in which nothing was done to the body, of its weight by its size
};

/// Runs a scene up to the first fault. After each frame: places and momenta are finite, nothing flies apart, and a body
/// to which nothing was done has gained no energy; where the mesh has changed, the validity contract (its geometry
/// after each stroke), and a conserved attribute's sum through the frame's steps; the mass.
SimulationOutcome run_simulation(const SimulationCase& scene, unsigned threads);

/// How long a campaign of simulations goes on.
struct SimulationLimits {
  std::uint64_t first_seed = 1;
  std::uint64_t scenes = 100;
  unsigned frames = 2000;  ///< of each
  double seconds = 0;      ///< 0: no limit
};

/// One scene after the other; every tenth is run twice more, the second time on two threads, and must end with the same
/// hash. Returns what the program should.
int soak_simulations(const SimulationLimits& limits);

}  // namespace incise::test
