// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace incise {
inline namespace v0 {

/// How much a message matters.
enum class LogLevel : unsigned char { kDebug, kInfo, kWarning };

/// Where the library's messages go. The library itself prints nothing; an empty sink drops them.
/// It is called on the thread of the call that the message is about, and must not throw.
using LogSink = std::function<void(LogLevel, std::string_view)>;

}  // namespace v0
}  // namespace incise
