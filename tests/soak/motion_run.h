// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "soak/motions.h"

namespace incise::test {

/// What went wrong with a case.
enum class Fault : std::uint8_t { kNone, kRefused, kInvalid, kVolume, kUndo, kRedo };

struct Outcome {
  Fault fault = Fault::kNone;
  std::string text;      ///< which stroke and step, and what; empty where nothing is wrong
  unsigned strokes = 0;  ///< done, the faulty one included
};

/// Cuts as the case says, up to the first fault. After each step: the mesh's topology in small bodies. After each
/// stroke: the whole validity contract, the volume, and that undo and redo restore the hashes. At the end: all back and
/// again. Violations that the input had are no fault unless they grow in number.
Outcome run_case(const MotionCase& motion);

}  // namespace incise::test
