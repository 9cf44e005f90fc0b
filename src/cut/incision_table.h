// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cut/closed_complex.h"

namespace incise {
inline namespace v0 {

/// Which faces between the children of a master the sheet passes.
struct PassedFaces {
  std::uint64_t passed = 0;      ///< bit k: the k-th pair of `SplitTemplate::inner`
  bool is_middle_whole = false;  ///< the children stay connected by the others: a point that all of them have is one
};

/// Tells it by the template, the flags and what else decides it. Masters at a front are alike: each case is worked out
/// once and then looked up.
class IncisionTable {
 public:
  IncisionTable() : cases_(kCases) {}
  /// Cost: O(1), or O(children) for a case that is new. Valid until the next call.
  const PassedFaces& find(const Master& master, const ClosedComplex& complex);

 private:
  static constexpr std::size_t kCases = 2048;  // those that land on one place take turns
  struct Case {
    std::uint64_t key = 0;
    PassedFaces faces;
  };
  std::vector<Case> cases_;
  PassedFaces last_;
};

}  // namespace v0
}  // namespace incise
