// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "app/text/json_tree.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Where a number must lie.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool is_open = false;  ///< without `low` itself
};

inline constexpr Range kAnyNumber{};
inline constexpr Range kAtLeast0{0};
inline constexpr Range kAbove0{0, std::numeric_limits<double>::infinity(), true};

/// "path.key", or the key alone.
[[nodiscard]] inline std::string under(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

/// Reads keys that may be left out, and numbers that must lie in a range. As in `JsonReader`, each returns false, and
/// keeps the first error, where a value is not as asked; what is left out stays as it is.
class RangeReader : public JsonReader {
 public:
  using JsonReader::JsonReader;

  bool ranged(const JsonValue& value, const std::string& path, const Range& range, double& out);
  bool optional_ranged(const JsonValue& object, const std::string& path, std::string_view key, const Range& range,
                       double& out);
  bool need_ranged(const JsonValue& object, const std::string& path, std::string_view key, const Range& range,
                   double& out);
  bool optional_whole(const JsonValue& object, const std::string& path, std::string_view key, std::uint64_t low,
                      std::uint64_t high, std::uint64_t& out);
  bool optional_boolean(const JsonValue& object, const std::string& path, std::string_view key, bool& out);
  bool optional_text(const JsonValue& object, const std::string& path, std::string_view key, std::string& out);
  bool optional_point(const JsonValue& object, const std::string& path, std::string_view key, Vec3& out);
  bool need_point(const JsonValue& object, const std::string& path, std::string_view key, Vec3& out);
};

}  // namespace app
}  // namespace v0
}  // namespace incise
