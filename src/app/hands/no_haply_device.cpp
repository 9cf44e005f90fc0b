// SPDX-License-Identifier: Apache-2.0
// Stands for haply_device.cpp where the program is built without a WebSocket client.
#include "app/hands/haply_device.h"

namespace incise {
inline namespace v0 {
namespace app {

struct HaplyDevice::State {};

Result<std::unique_ptr<HaplyDevice>> HaplyDevice::open(const HaplyOptions& options) {
  if (Status status = check(options); !status.ok()) return status.error();
  return Error{ErrorCode::kUnsupported,
               "this program was built without Haply's service; install libboost-dev (Boost.Beast) and configure with "
               "-DINCISE_WITH_HAPLY=ON",
               {}};
}

HaplyDevice::HaplyDevice(std::unique_ptr<State> state) : state_(std::move(state)) {}
HaplyDevice::~HaplyDevice() = default;
DeviceState HaplyDevice::read(double /*time*/) {
  DeviceState state;
  state.is_live = false;
  return state;
}
void HaplyDevice::command(const Vec3& /*force*/) {}
HaplyStatistics HaplyDevice::statistics() const {
  return {};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
