// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "app/jobs/scene_hand.h"
#include "incise/engine/simulation.h"
#include "incise/geom/box.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A person's hand that has the blade of a simulation, frame by frame, at the pace of the clock.
class LiveHand {
 public:
  virtual ~LiveHand() = default;
  LiveHand(const LiveHand&) = delete;
  LiveHand& operator=(const LiveHand&) = delete;

  /// The simulation of a body begins. @param body  around it, length unit. @param scene  of it.
  virtual void begin(const Scene& scene, const Box& body) = 0;
  /// The blade in the next frame, length unit; nothing while the hand keeps away from `body`.
  [[nodiscard]] virtual std::optional<BladePose> blade(const Box& body) = 0;
  /// What the tissue does after the frame.
  virtual void feel(const HapticSnapshot& snapshot) = 0;
  /// What was felt so far.
  [[nodiscard]] virtual HapticFigures figures() const = 0;

 protected:
  LiveHand() = default;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
