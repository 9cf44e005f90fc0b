// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "incise/cut/stroke.h"
#include "incise/geom/box.h"

namespace incise {
inline namespace v0 {
namespace app {

/// What a random stroke looks like.
enum class RandomKind : std::uint8_t {
  kPlane,  ///< a straight blade goes straight through the whole body
  kArc,    ///< a straight blade goes along a parabola through the whole body
  kSlit,   ///< a straight blade that reaches in from one side goes along an arc, and comes out again
  kCore,   ///< a ring goes in from one side: half of them through, half to some depth
};
/// The names of `RandomKind`, in its order.
inline constexpr std::array<const char*, 4> kRandomKindNames = {"plane", "arc", "slit", "core"};

/// Which strokes are made.
struct RandomStrokes {
  std::uint64_t seed = 0;
  std::uint32_t strokes = 1;
  std::vector<RandomKind> kinds = {RandomKind::kPlane, RandomKind::kArc, RandomKind::kSlit, RandomKind::kCore};
  double start = 0.2;  ///< s, when the first begins
  double seconds = 1;  ///< s, that each takes, above 0
  double pause = 0.1;  ///< s, between two
};

/// Makes strokes for a body at rest in `body`: equal seeds give equal strokes, bit for bit, on every compiler.
///
/// Each kind is as likely as the others, directions are uniform, and blades aim at the middle half of the box, so that
/// some miss a slender body. `kinds` has at least one entry. Cost: O(strokes).
[[nodiscard]] std::vector<Stroke> random_strokes(const RandomStrokes& wanted, const Box& body);

}  // namespace app
}  // namespace v0
}  // namespace incise
