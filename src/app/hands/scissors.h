// SPDX-License-Identifier: Apache-2.0
// Scissors: one blade goes under the skin, the other closes onto it and cuts what is between.
#pragma once

#include <optional>

#include "app/hands/hand_tool.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Open scissors that are put onto a body. Points in length units, as the body stands.
struct ScissorsPlace {
  Vec3 hinge = Vec3::Zero();
  Vec3 upper_tip = Vec3::Zero();  ///< of the blade that closes, in the air
  Vec3 lower_tip = Vec3::Zero();  ///< of the blade that stays
};

/// Puts scissors from one place of a picture to another. On skin the lower blade goes in at the first place and is as
/// deep as the settings say at the second one. From beside the body, or from a wall, it lies that deep all the way.
/// Nothing where neither place is on the body, or both are the same.
[[nodiscard]] std::optional<ScissorsPlace> place_scissors(const PointerPlace& from, const PointerPlace& to,
                                                          const ToolSettings& settings);
/// The closing, in 0.4 s.
///
/// The cutting edge is that of the upper blade, which turns about the hinge down to the lower one. The lower one moves
/// along itself as it goes in and opens nothing.
[[nodiscard]] Stroke to_stroke(const ScissorsPlace& place);
/// Both blades, open, as a preview.
void draw(const ScissorsPlace& place, Marks& marks);

}  // namespace app
}  // namespace v0
}  // namespace incise
