// SPDX-License-Identifier: Apache-2.0
// The scalpel: a drag over a surface that moves and opens under the pointer becomes a blade's way through the tissue.
#pragma once

#include <optional>

#include "app/hands/hand_tool.h"
#include "app/view/picking.h"
#include "app/view/picture.h"

namespace incise {
inline namespace v0 {
namespace app {

/// One stroke at a time. The blade follows skin; where the pointer meets the inside of the wound or nothing at all, it
/// goes on in the plane through the last good place.
class Scalpel {
 public:
  /// The pointer goes down: on the body the blade is in place just above it, and goes in as the drag goes on; else it
  /// comes in from beside the body as soon as the drag comes onto it.
  void press(const PointerPlace& place, const ToolSettings& settings);
  /// Brings the blade to where the pointer is now. `size` of the body, length unit: no move goes further.
  void move(const PointerPlace& place, const ToolSettings& settings, double size);
  void end() { *this = {}; }

  [[nodiscard]] const std::optional<BladePose>& pose() const { return pose_; }
  /// The edge, and the blade behind it.
  void draw(Marks& marks) const;

 private:
  void begin(const PointerPlace& place, const ToolSettings& settings);
  void begin_from_air(const PointerPlace& place, const ToolSettings& settings);
  [[nodiscard]] bool is_on_surface(const PointerPlace& place, double depth) const;
  [[nodiscard]] std::optional<Vec3> on_plane(const PointerPlace& place, double furthest) const;
  void advance(const Vec3& to, double depth);
  void put(const ToolSettings& settings, double pressure);

  Ray pressed_;                    // through the pixel where the pointer went down
  Vec2 pixel_ = Vec2::Zero();      // of the last pose
  Vec3 point_ = Vec3::Zero();      // on the surface, of the last pose
  Vec3 normal_ = Vec3::UnitZ();    // outwards, smoothed along the drag
  Vec3 direction_ = Vec3::Zero();  // of travel, low-passed from zero: its length, at most 1, tells how settled it is
  Vec3 seen_ = Vec3::Zero();       // where the pointer last was on skin
  std::optional<BladePose> pose_;
};

/// The blade's edge upright at a place of the surface, from above it to `depth` below.
[[nodiscard]] BladePose upright_pose(const Vec3& point, const Vec3& normal, double depth);

}  // namespace app
}  // namespace v0
}  // namespace incise
