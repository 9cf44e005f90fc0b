// SPDX-License-Identifier: Apache-2.0
// Messages about a number out of range are made from the range itself, so that they cannot say anything else.
#include "app/text/range_reader.h"

#include <cmath>

namespace incise {
inline namespace v0 {
namespace app {
namespace {

std::string words(const Range& range) {
  const std::string low = (range.is_open ? "above " : "at least ") + short_number(range.low);
  return std::isfinite(range.high) ? low + " and at most " + short_number(range.high) : low;
}

}  // namespace

bool RangeReader::ranged(const JsonValue& value, const std::string& path, const Range& range, double& out) {
  if (!number(value, path, out)) return false;
  const bool is_above = range.is_open ? out > range.low : out >= range.low;
  if (is_above && out <= range.high) return true;
  return fail(value, path, "is " + short_number(out) + "; it must be " + words(range));
}

bool RangeReader::optional_ranged(const JsonValue& object, const std::string& path, std::string_view key,
                                  const Range& range, double& out) {
  const JsonValue* value = object.find(key);
  return value == nullptr || ranged(*value, under(path, key), range, out);
}

bool RangeReader::need_ranged(const JsonValue& object, const std::string& path, std::string_view key,
                              const Range& range, double& out) {
  const JsonValue* value = member(object, path, key);
  return value != nullptr && ranged(*value, under(path, key), range, out);
}

bool RangeReader::optional_whole(const JsonValue& object, const std::string& path, std::string_view key,
                                 std::uint64_t low, std::uint64_t high, std::uint64_t& out) {
  const JsonValue* value = object.find(key);
  if (value == nullptr) return true;
  if (!whole(*value, under(path, key), out)) return false;
  if (out >= low && out <= high) return true;
  return fail(*value, under(path, key),
              "is " + std::to_string(out) + "; it must be from " + std::to_string(low) + " to " + std::to_string(high));
}

bool RangeReader::optional_boolean(const JsonValue& object, const std::string& path, std::string_view key, bool& out) {
  const JsonValue* value = object.find(key);
  return value == nullptr || boolean(*value, under(path, key), out);
}

bool RangeReader::optional_text(const JsonValue& object, const std::string& path, std::string_view key,
                                std::string& out) {
  const JsonValue* value = object.find(key);
  return value == nullptr || text(*value, under(path, key), out);
}

bool RangeReader::optional_point(const JsonValue& object, const std::string& path, std::string_view key, Vec3& out) {
  const JsonValue* value = object.find(key);
  return value == nullptr || numbers(*value, under(path, key), out.data(), 3);
}

bool RangeReader::need_point(const JsonValue& object, const std::string& path, std::string_view key, Vec3& out) {
  const JsonValue* value = member(object, path, key);
  return value != nullptr && numbers(*value, under(path, key), out.data(), 3);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
