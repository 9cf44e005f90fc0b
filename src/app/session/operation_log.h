// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace incise {
inline namespace v0 {
namespace app {

/// What a person did, or had done, in the order in which it happened.
struct Operation {
  enum class Kind : std::uint8_t { kStroke, kSuture, kUndo, kRedo, kReset, kRecording, kReplay, kNotice };
  Kind kind = Kind::kNotice;
  double time = 0;   ///< s of the simulation
  std::string text;  ///< a line for people
};

/// Keeps the newest `kMost` operations.
class OperationLog {
 public:
  static constexpr std::size_t kMost = 1000;

  void add(Operation operation);
  [[nodiscard]] const std::vector<Operation>& operations() const { return operations_; }
  /// How many were ever added: tells a display whether there is something new.
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  std::vector<Operation> operations_;
  std::uint64_t count_ = 0;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
