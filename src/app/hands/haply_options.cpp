// SPDX-License-Identifier: Apache-2.0
// The bounds of what may be asked of a Haply arm, and addresses as people write them, with IPv6 in brackets.
#include <charconv>
#include <cmath>

#include "app/hands/haply_device.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kMostForce = 20;  // N: twice what the strongest arms of its size give

}  // namespace

Status check(const HaplyOptions& options) {
  const auto bad = [](const char* what) { return Error{ErrorCode::kBadArgument, what, {}}; };
  if (options.host.empty()) return bad("Haply's service needs the name of a host, for instance localhost");
  if (options.port == 0) return bad("the port of Haply's service must lie in [1, 65535]; it is 10001 as installed");
  if (!(options.rate >= 10 && options.rate <= 10000)) return bad("exchanges must lie in [10, 10000] per s");
  if (!(options.max_force > 0 && options.max_force <= kMostForce)) return bad("the force must lie in (0, 20] N");
  if (!(std::isfinite(options.timeout) && options.timeout > 0)) return bad("the timeout must be above 0 s");
  if (!(std::isfinite(options.retry) && options.retry > 0)) return bad("the time between two tries must be above 0 s");
  return check(options.guard);
}

Status parse_haply_address(const std::string& text, HaplyOptions& options) {
  const Error bad{ErrorCode::kBadArgument,
                  "'" + text +
                      "' is no address of Haply's service; HOST, HOST:PORT or [ADDRESS]:PORT is, with a port "
                      "in [1, 65535]",
                  {}};
  const bool is_bracketed = !text.empty() && text.front() == '[';
  const std::size_t close = is_bracketed ? text.find(']') : 0;
  if (close == std::string::npos) return bad;
  const std::size_t colon = text.find(':', close);
  if (is_bracketed && colon != close + 1 && close + 1 != text.size()) return bad;
  const std::string host = is_bracketed ? text.substr(1, close - 1) : text.substr(0, colon);
  if (is_bracketed && host.empty()) return bad;
  HaplyOptions given = options;
  if (!host.empty()) given.host = host;
  if (colon != std::string::npos) {
    const char* begin = text.data() + colon + 1;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, given.port);
    if (error != std::errc() || stop != end || given.port == 0) return bad;
  }
  options = given;
  return {};
}

}  // namespace app
}  // namespace v0
}  // namespace incise
