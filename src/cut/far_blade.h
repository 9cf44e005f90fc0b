// SPDX-License-Identifier: Apache-2.0
// Blades that reach far beyond the body, or come from far away: where along them, and when, they can be near it.
#pragma once

#include <span>
#include <vector>

#include "incise/geom/box.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// A box that is larger on all sides by a share of its diagonal.
[[nodiscard]] Box enlarged(const Box& box, double share);

/// Divides a segment for a blade that must be dense where the body is: shares of its length, ascending, the last one 1.
///
/// Parts are at most `spacing` long in `near` and beside it, and grow with the distance from there.
/// Cost: O(parts): those in the box, and some twenty for each thousandfold of its size beyond.
[[nodiscard]] std::vector<double> graded_shares(const Vec3& from, const Vec3& to, double spacing, const Box& near);

/// A part of a step: up to this share of the way.
struct StepPart {
  double end = 1;
  bool is_near = true;  ///< the blade may meet the box on the way
};

/// Divides a step of a blade from row to row: where it may meet `near`, its points travel at most `travel` in a part.
/// Cost: O(points · parts), and a logarithm of the distances.
[[nodiscard]] std::vector<StepPart> divide_step(std::span<const Vec3> from, std::span<const Vec3> to, double travel,
                                                const Box& near);

}  // namespace v0
}  // namespace incise
