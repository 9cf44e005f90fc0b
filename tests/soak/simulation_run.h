// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "soak/simulations.h"

namespace incise::test {

/// What a scene did.
struct SimulationOutcome {
  std::string fault;         ///< which frame, and what is wrong; empty where nothing is
  std::string energy_fault;  ///< which frame has added too much energy, and how much
  unsigned frames = 0;       ///< done, the faulty one included
  std::uint64_t hash = 0;
  std::size_t tets = 0;
  double fastest = 0;       ///< of any vertex in any frame, m/s
  double energy_gain = 0;   ///< the most in one frame in which nothing was done to the body, of its peak
  double journal_gain = 0;  ///< the most of elastic energy at one step of the journal, likewise
};

/// Runs a scene up to the first fault. After each frame: places and momenta are finite, nothing flies apart, a body to
/// which nothing was done has gained no energy, and following the mesh has added next to none; where the mesh has
/// changed, the validity contract (where steps touched it; all of it after each stroke), and a conserved attribute's
/// sum through the frame's steps; the mass. With `log_every` above 0 it says on stderr at that interval of frames where
/// it is, how large the mesh is, and where the time went.
SimulationOutcome run_simulation(const SimulationCase& scene, unsigned threads, unsigned log_every = 0);

/// How long a campaign of simulations goes on.
struct SimulationLimits {
  std::uint64_t first_seed = 1;
  std::uint64_t scenes = 100;
  unsigned frames = 2000;      ///< of each
  double seconds = 0;          ///< 0: no limit
  bool judges_energy = false;  ///< whether too much of it is a failure, not only told
  unsigned log_every = 0;      ///< frames between two lines that say how far a scene is; 0: none
};

/// One scene after the other; every tenth is run twice more, the second time on two threads, and must end with the same
/// hash. Returns what the program should.
int soak_simulations(const SimulationLimits& limits);

}  // namespace incise::test
