// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace incise {
inline namespace v0 {

/// How much a message matters.
enum class LogLevel : unsigned char { kDebug, kInfo, kWarning };

/// Where the library's messages go. The library itself prints nothing; an empty sink drops them.
/// Called on the thread that made the call which has something to say; must not throw.
using LogSink = std::function<void(LogLevel, std::string_view)>;

}  // namespace v0
}  // namespace incise
