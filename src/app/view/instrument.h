// SPDX-License-Identifier: Apache-2.0
// Surgical instruments as solids, made in code: each stands with what it cuts or holds by at a given place.
#pragma once

#include <cstdint>
#include <vector>

#include "app/view/solid.h"

namespace incise {
inline namespace v0 {
namespace app {

enum class InstrumentKind : std::uint8_t { kScalpel, kForceps, kHook, kRetractor, kScissors, kPunch };

/// Where an instrument is. Lengths in the mesh's unit.
struct Instrument {
  InstrumentKind kind = InstrumentKind::kScalpel;
  Vec3 tip = Vec3::Zero();    ///< where it works: the deepest place of a scalpel's edge, what forceps and hooks hold
  Vec3 up = Vec3::UnitZ();    ///< unit: from the tip towards the hand
  Vec3 ahead = Vec3::Zero();  ///< where it goes, or pulls to; only its part across `up` counts. Zero: any way
  double millimetre = 0.001;  ///< of its measures, in length units, above 0; see `instrument_millimetre`
  double opening = 0;         ///< of forceps, between the tips; of a punch, the radius; length units
  Vec3 hinge = Vec3::Zero(), other_tip = Vec3::Zero();  ///< of scissors, whose blades end at both tips
  bool is_ghost = false;                                ///< seen through: nobody's hand holds it
};

/// A millimetre as drawn: three fifths of a real one, to hide less; more where a blade would be too short for a cut.
[[nodiscard]] double instrument_millimetre(double metres_per_unit, double depth);

/// Adds the triangles of an instrument.
void add_solid(const Instrument& instrument, std::vector<SolidCorner>& out);

}  // namespace app
}  // namespace v0
}  // namespace incise
