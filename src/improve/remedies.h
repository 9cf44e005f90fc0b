// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "improve/care.h"
#include "incise/core/profile.h"

namespace incise {
inline namespace v0 {

/// One way to make the surroundings of a tet better.
struct Remedy {
  /// Which tets it is tried on.
  enum class For : std::uint8_t { kAll, kBad };

  Stage stage = Stage::kImprove;  ///< kMerge or kImprove: what it counts as, and which option switches it off
  For which = For::kAll;
  /// Tries it on a tet. Returns whether it changed the mesh: as `Care` says, and for the better by `kLeastGain` at
  /// least; else it must leave everything as it was.
  std::function<bool(Care&, TetId)> improve;
};

/// A remedy by an operation, a class with `bool improve(Care&, TetId)` that keeps its scratch memory between calls.
template <class Operation>
Remedy remedy_by(Stage stage, Remedy::For which = Remedy::For::kAll) {
  return {stage, which,
          [operation = std::make_shared<Operation>()](Care& care, TetId tet) { return operation->improve(care, tet); }};
}

/// The remedies of the profile incise, in the order in which they are tried: collapses first, since they leave fewer
/// tets behind. Here a new one is registered.
[[nodiscard]] std::vector<Remedy> usual_remedies();

/// Remedies in the order in which they are tried.
class Remedies {
 public:
  explicit Remedies(std::vector<Remedy> remedies = usual_remedies()) : remedies_(std::move(remedies)) {}

  /// The first remedy that helps changes the mesh. Returns whether there was one.
  bool improve(Care& care, TetId tet, const MaintainOptions& options, StageTimes& times) const;

 private:
  std::vector<Remedy> remedies_;
};

}  // namespace v0
}  // namespace incise
