// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incise/core/result.h"
#include "incise/geom/vec.h"

namespace incise {
inline namespace v0 {
namespace app {

/// A parsed JSON value that knows its line, so that messages can name it. Duplicate keys are refused on reading.
struct JsonValue {
  enum class Kind : std::uint8_t { kNull, kBool, kNumber, kString, kArray, kObject };

  Kind kind = Kind::kNull;
  std::uint32_t line = 1;         ///< where the value ends, for arrays and objects where it begins
  double number = 0;              ///< of kNumber; 0 or 1 of kBool
  bool is_whole = false;          ///< a number written as an integer from 0 to 2^64 - 1
  std::uint64_t whole = 0;        ///< that integer
  std::string text;               ///< of kString
  std::vector<JsonValue> items;   ///< of kArray; the values of kObject
  std::vector<std::string> keys;  ///< of kObject, one per item

  [[nodiscard]] const JsonValue* find(std::string_view key) const;
};

struct JsonLimits {
  std::size_t max_bytes = std::size_t{64} << 20U;
  std::size_t max_values = std::size_t{1} << 23U;
  std::size_t max_depth = 16;
};

/// Parses a whole document, whose first line is the file's line `first_line`. Errors: kBadFile "FILE:LINE: what".
Result<JsonValue> parse_json(std::string_view text, std::string_view file_name, const JsonLimits& limits = {},
                             std::uint32_t first_line = 1);

/// Walks a tree and remembers the first error, named by file, line and JSON path.
class JsonReader {
 public:
  /// `place`: where in its document the tree stands, in front of all paths; empty: it is the document.
  explicit JsonReader(std::string_view file_name, std::string place = {})
      : file_name_(file_name), place_(std::move(place)) {}

  [[nodiscard]] bool ok() const { return !failed_; }
  [[nodiscard]] const Error& error() const { return error_; }

  /// Every one of these returns false, and keeps the first error, where the value is not as asked.
  ///
  /// `is_format` asks for an object that names this format and version, `points` for an array of at least two points.
  bool is_format(const JsonValue& root, std::string_view format, std::uint32_t version);
  bool is_object(const JsonValue& value, const std::string& path, const std::vector<std::string_view>& known_keys);
  const JsonValue* member(const JsonValue& object, const std::string& path, std::string_view key);
  bool is_array(const JsonValue& value, const std::string& path, std::size_t min_items, std::size_t max_items);
  bool number(const JsonValue& value, const std::string& path, double& out);
  bool numbers(const JsonValue& value, const std::string& path, double* out, std::size_t count);
  bool points(const JsonValue& value, const std::string& path, std::size_t max_points, std::vector<Vec3>& out);
  bool whole(const JsonValue& value, const std::string& path, std::uint64_t& out);
  bool boolean(const JsonValue& value, const std::string& path, bool& out);
  bool text(const JsonValue& value, const std::string& path, std::string& out);
  bool fail(const JsonValue& value, const std::string& path, const std::string& what);

 private:
  std::string file_name_, place_;
  Error error_;
  bool failed_ = false;
};

/// "path[index]".
[[nodiscard]] std::string at(const std::string& path, std::size_t index);
/// For messages: six digits after the point at most.
[[nodiscard]] std::string short_number(double x);

}  // namespace app
}  // namespace v0
}  // namespace incise
