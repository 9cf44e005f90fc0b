// SPDX-License-Identifier: Apache-2.0
// What Haply's Inverse Service says and hears: JSON of its version 3.1 and later.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "incise/sim/haptic_device.h"

namespace incise {
inline namespace v0 {
namespace app {

/// One message of the service, as far as a blade needs it.
struct HaplyReading {
  std::string device;     ///< the arm's id as it is written in JSON: a text in quotation marks, or a number
  DeviceState state;      ///< SI units, the device's axes; of the grip's orientation and buttons what there is
  bool has_grip = false;  ///< whether there was any of it
};

/// Reads a message. Nothing where it is no JSON, has no arm (`device`, or the first one where that is empty), or no
/// place of it; where numbers are missing or not finite. Buttons a, b and c are bits 0, 1 and 2. Never throws.
[[nodiscard]] std::optional<HaplyReading> parse_haply(std::string_view text, const std::string& device);

/// The message that has the arm exert a force, N, in the device's axes. No force that is not finite.
[[nodiscard]] std::string haply_force(const std::string& device, const Vec3& force);

}  // namespace app
}  // namespace v0
}  // namespace incise
