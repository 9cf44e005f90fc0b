// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {
namespace app {

enum class ValidityState : std::uint8_t { kUnknown, kChecking, kValid, kBroken };

struct ValidityLight {
  ValidityState state = ValidityState::kUnknown;
  std::string text;  ///< a few words that do without colour, for instance "valid" or "2 singleton_cut_vertex"
};

/// Checks the validity contract of a mesh on a thread of its own, so that neither drawing nor simulation waits.
///
/// What the mesh had wrong at first are the input's own defects; more of them, or other ones, break the contract.
/// Not thread-safe itself: one thread calls.
class ValidityMonitor {
 public:
  /// @param volume_tolerance  relative, see `volume_tolerance`. Starts with a check of `mesh` as it is.
  ValidityMonitor(const TetMesh& mesh, double volume_tolerance);
  ValidityMonitor(ValidityMonitor&&) noexcept;
  ValidityMonitor& operator=(ValidityMonitor&&) noexcept;
  ~ValidityMonitor();  ///< waits for a check under way

  /// The mesh has changed. Takes a copy as soon as no check is under way, and none before that.
  /// Cost: O(slots) to copy, about 10 ns per tet. Returns whether it was taken.
  bool check(const TetMesh& mesh);
  [[nodiscard]] ValidityLight light() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
