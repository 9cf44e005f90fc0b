// SPDX-License-Identifier: Apache-2.0
// One cut of a moving body, checked at every step: does it fall apart as it should, and into nothing else?
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "deforming/blade_motion.h"
#include "deforming/soft_body.h"
#include "incise/cut/options.h"

namespace incise::test {

enum class BodyKind : std::uint8_t {
  kBeam,      ///< 2 × 1 × 0.667, jittered Kuhn
  kCube,      ///< 1 × 1 × 1, jittered Kuhn
  kBall,      ///< radius 0.6, curved skin
  kShuffled,  ///< the beam with its faces swapped at random and its points renumbered: as irregular as TetGen's
};
inline constexpr unsigned kBodyKinds = 4;

/// What moves the body.
enum class Mover : std::uint8_t {
  kSolver,  ///< `SoftBody`, held at both ends, stretched
  kField,   ///< positions prescribed: it sways and bends, and the lips of the wound stand apart
};

struct LeakSettings {
  BodyKind body = BodyKind::kBeam;
  Motion motion = Motion::kStraight;
  Mover mover = Mover::kSolver;
  unsigned steps = 120;    ///< of the blade, over 2 seconds
  std::uint64_t seed = 1;  ///< of the body's jitter, and of the blade's slant and place
  double stretch = 0.25;   ///< of the ends, for the solver
  double amplitude = 0.3;  ///< of sway and gap, in spacings, for the field
  CutOptions cut;
  bool maintains = false;    ///< at the end of the stroke
  unsigned check_every = 1;  ///< steps between two full validations; 0: at the end alone
};

/// What became of a run. Lengths in spacings, energies as shares of the run's peak of elastic energy.
struct LeakResult {
  std::size_t expected = 2, pieces = 0, crumbs = 0;  ///< crumbs: pieces below 0.02 spacings³, not among `pieces`
  std::size_t invalid = 0;                           ///< checks that found the mesh broken, its volume included
  double volume_change = 0;                          ///< of the body at rest by the end, as a share
  double turned_over = 0;    ///< most volume that the engine turned inside out as the body stood, as a share
  std::size_t inverted = 0;  ///< most tets inside out as the body stood, right after a cut
  double energy_up = 0;      ///< greatest rise at a step of the journal, the fresh vertices relaxed
  double energy_up_raw = 0;  ///< the same before that
  double energy_down = 0;    ///< greatest fall, relaxed
  double speed = 0;          ///< greatest of a vertex, length / s
  double front_mean = 0, front_max = 0;  ///< from points of the blade in uncut tissue to the nearest lip
  std::size_t front_points = 0;          ///< how many such points
  std::size_t tets = 0;                  ///< at the end
  double engine_ms = 0, solver_ms = 0;   ///< times of the whole run
  std::string failure;  ///< the first thing that is no matter of degree: an error, not finite, a broken mesh
  [[nodiscard]] bool is_exact() const { return pieces == expected && crumbs == 0; }
};

/// The rise of elastic energy at one step of the journal that a run may show, of its peak.
inline constexpr double kEnergyRise = 0.03;

/// What the paper's smoothing and merging may change of a body's volume: its walls and its skin are curved.
inline constexpr double kPaperVolume = 3e-3;

/// The body at rest; `spacing` becomes the length of its usual edge.
TetSoup make_body(BodyKind kind, std::uint64_t seed, double& spacing);
const char* name_of(BodyKind kind);

/// Cuts with `Engine::begin_stroke`, `step` and `end_stroke`, poses in the world, while the body moves.
/// Cost: about 1 s for 120 steps through the beam.
LeakResult run_leak(const LeakSettings& settings);

}  // namespace incise::test
