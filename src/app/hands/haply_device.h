// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "app/hands/device_guard.h"
#include "incise/core/result.h"
#include "incise/sim/haptic_device.h"

namespace incise {
inline namespace v0 {
namespace app {

struct HaplyOptions {
  std::string host = "localhost";
  std::uint16_t port = 10001;
  double rate = 1000;      ///< exchanges per second, in [10, 10000]; the service answers as fast as it is asked
  double max_force = 3.3;  ///< N, in (0, 20]: what passes this is shortened
  double timeout = 2;      ///< s for looking up, connecting and the handshake together, and without the arm; above 0
  double retry = 0.5;      ///< s between two tries to connect again; above 0
  DeviceGuardOptions guard;
};

/// Errors: kBadArgument names the first option out of its range.
[[nodiscard]] Status check(const HaplyOptions& options);

/// Reads "HOST", "HOST:PORT", ":PORT" or "[ADDRESS]:PORT" over what `options` has. Errors: kBadArgument.
[[nodiscard]] Status parse_haply_address(const std::string& text, HaplyOptions& options);

/// What a connection did so far.
struct HaplyStatistics {
  std::uint64_t exchanges = 0;    ///< forces that were answered by a state
  std::uint64_t bad = 0;          ///< messages that made no sense
  std::uint64_t jumps = 0;        ///< places where no hand can have come, and speeds that none has
  std::uint64_t silences = 0;     ///< times that no answer came, or no force was taken
  std::uint64_t connections = 0;  ///< that were made, the first included
  bool is_connected = false;      ///< now
};

/// An Inverse3 of Haply Robotics, with or without a VerseGrip, by its makers' service (WebSocket, JSON).
///
/// A thread of its own exchanges forces for states at `rate`, connects again where the connection was lost, and lets
/// `read` and `command` neither wait nor allocate. Axes are the device's: right-handed, m, N. Until a `DeviceGuard`
/// believes what the service says, `read` is not live and the force sent is zero; so it is where `command` was not
/// called for `guard.silence`, and when this object goes away. No real device was used to test it.
/// **Source:** the interface as docs.haply.co has it for service 3.1, and the client of Isaac Lab (`se3_haply`).
class HaplyDevice final : public HapticDevice {
 public:
  /// Connects, and waits for the first message that tells of an arm. Errors: kBadArgument as `check`; kIo where there
  /// is no service, or no arm, with what to do; kUnsupported where the program was built without it.
  static Result<std::unique_ptr<HaplyDevice>> open(const HaplyOptions& options = {});
  ~HaplyDevice() override;  ///< sends no force, and closes the connection

  DeviceState read(double time) override;
  void command(const Vec3& force) override;
  [[nodiscard]] HaplyStatistics statistics() const;  ///< any thread

 private:
  struct State;
  explicit HaplyDevice(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
