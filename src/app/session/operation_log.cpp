// SPDX-License-Identifier: Apache-2.0
// A list that forgets its oldest entry; the count goes on, so that displays notice.
#include "app/session/operation_log.h"

#include <utility>

namespace incise {
inline namespace v0 {
namespace app {

void OperationLog::add(Operation operation) {
  if (operations_.size() >= kMost) operations_.erase(operations_.begin());
  operations_.push_back(std::move(operation));
  ++count_;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
