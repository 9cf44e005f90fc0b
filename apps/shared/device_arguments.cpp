// SPDX-License-Identifier: Apache-2.0
// Options become those of the device and of the hand, each checked by its own `check`; only then is the device opened.
#include "shared/device_arguments.h"

#include <utility>

#include "app/hands/haply_device.h"

namespace incise_apps {
namespace {

using namespace incise;

constexpr std::string_view kHaply = "haply";

Result<app::HaplyOptions> haply_of(const std::string& device, const DeviceArguments& arguments) {
  app::HaplyOptions options;
  options.max_force = arguments.force;
  if (device.size() > kHaply.size()) {
    const Status status = app::parse_haply_address(device.substr(kHaply.size() + 1), options);
    if (!status.ok()) return status.error();
  }
  if (const Status status = check(options); !status.ok()) return status.error();
  return options;
}

Result<app::DeviceHandOptions> hand_of(const DeviceArguments& arguments) {
  app::DeviceHandOptions options;
  options.scale = arguments.scale;
  options.loop.tool.max_force = arguments.force;
  options.loop.tool.passivity.link_delay = 1e-3 * arguments.delay_ms;
  if (arguments.blade_mm > 0) options.blade_length = 1e-3 * arguments.blade_mm;
  if (!arguments.axes.empty()) {
    const Result<Eigen::Matrix3d> axes = app::parse_axes(arguments.axes);
    if (!axes.ok()) return axes.error();
    options.axes = *axes;
  }
  if (const Status status = check(options); !status.ok()) return status.error();
  return options;
}

}  // namespace

void add_device(CLI::App& app, DeviceArguments& arguments) {
  app.add_option("--device-axes", arguments.axes,
                 "Haptic device: which of its axes is the scene's x, y and z, as in x,-z,y (default: its z is up)");
  app.add_option("--device-scale", arguments.scale, "Haptic device: metres in the scene per metre of the hand")
      ->check(CLI::Range(1e-3, 1e3));
  app.add_option("--device-force", arguments.force, "Haptic device: newtons at most (default 3.3)")
      ->check(CLI::Range(0.01, 20.0));
  app.add_option(
         "--device-blade", arguments.blade_mm,
         "Haptic device: millimetres of cutting edge (default: a third of the body's shortest side, at most 20)")
      ->check(CLI::Range(0.01, 1e4));
  app.add_option("--device-delay", arguments.delay_ms,
                 "Haptic device: milliseconds each way between it and this program, 0 to 50 (default 1)")
      ->check(CLI::Range(0.0, 50.0));
}

bool is_haply(const std::string& device) {
  return device == kHaply || device.rfind(std::string(kHaply) + "=", 0) == 0;
}

Status check_device(const std::string& device, const DeviceArguments& arguments) {
  if (!is_haply(device)) return {};
  if (const Result<app::HaplyOptions> haply = haply_of(device, arguments); !haply.ok()) return haply.error();
  if (const Result<app::DeviceHandOptions> hand = hand_of(arguments); !hand.ok()) return hand.error();
  return {};
}

Result<std::unique_ptr<app::DeviceHand>> open_device(const std::string& device, const DeviceArguments& arguments) {
  const Result<app::DeviceHandOptions> hand = hand_of(arguments);
  if (!hand.ok()) return hand.error();
  const Result<app::HaplyOptions> haply = haply_of(device, arguments);
  if (!haply.ok()) return haply.error();
  Result<std::unique_ptr<app::HaplyDevice>> opened = app::HaplyDevice::open(*haply);
  if (!opened.ok()) return opened.error();
  return app::DeviceHand::create(std::move(opened).value(), *hand);
}

}  // namespace incise_apps
