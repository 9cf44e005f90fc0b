// SPDX-License-Identifier: Apache-2.0
// --device haply and what belongs to it, in the command and in the window.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/hands/device_hand.h"

namespace incise_apps {

struct DeviceArguments {
  std::string axes;     ///< empty: z is up in the scene
  double scale = 1;     ///< m of the world per m of the device
  double force = 3.3;   ///< N at most
  double blade_mm = 0;  ///< of edge; 0: as suits the body
  double delay_ms = 1;  ///< each way between the device and this program
};

/// Offers --device-axes, --device-scale, --device-force, --device-blade and --device-delay.
void add_device(CLI::App& app, DeviceArguments& arguments);
/// Whether a value of --device means a haptic device by Haply's service.
[[nodiscard]] bool is_haply(const std::string& device);
/// What can be told before it is opened. Nothing where `device` is no such device. Errors: kBadArgument.
[[nodiscard]] incise::Status check_device(const std::string& device, const DeviceArguments& arguments);
/// Connects to the device. Errors: as `check_device`, `HaplyDevice::open`.
[[nodiscard]] incise::Result<std::unique_ptr<incise::app::DeviceHand>> open_device(const std::string& device,
                                                                                   const DeviceArguments& arguments);

}  // namespace incise_apps
