// SPDX-License-Identifier: Apache-2.0
// What the lines of all recordings have in common.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/text/json_tree.h"
#include "app/text/json_write.h"
#include "incise/core/result.h"
#include "incise/improve/options.h"

namespace incise {
inline namespace v0 {
namespace app {

inline constexpr JsonLimits kLineLimits = {std::size_t{1} << 30U, std::size_t{1} << 24U, 16};
inline constexpr std::array<const char*, 6> kErrorNames = {"bad_argument",  "bad_file", "unsupported",
                                                           "out_of_memory", "io",       "internal"};

/// The value of an enumeration that has a name, by its place among them.
template <class Enum, std::size_t kCount>
[[nodiscard]] bool find_name(const std::array<const char*, kCount>& names, const std::string& name, Enum& out) {
  for (std::size_t i = 0; i < kCount; ++i) {
    if (name != names[i]) continue;
    out = static_cast<Enum>(i);
    return true;
  }
  return false;
}

/// The name of an error in recordings and messages.
[[nodiscard]] const char* name_of(ErrorCode code);

/// One line of JSON, with a newline at the end.
[[nodiscard]] std::string line_of(const Json& root);
/// Whether a text can be the whole of a line: JSON that was cut off never is. Cost: O(size).
[[nodiscard]] bool is_whole_json(std::string_view text);

/// What all kinds of lines are read with. Each returns false where the value is not as asked, and keeps the error.
class LineReader {
 public:
  explicit LineReader(std::string_view file_name) : read_(file_name) {}

  [[nodiscard]] const Error& error() const { return read_.error(); }

 protected:
  bool read_text(const JsonValue& root, const std::string& path, const char* key, std::string& out) {
    const JsonValue* value = read_.member(root, path, key);
    return value != nullptr && read_.text(*value, key, out);
  }
  bool read_whole(const JsonValue& root, const std::string& path, const char* key, std::uint64_t& out) {
    const JsonValue* value = read_.member(root, path, key);
    return value != nullptr && read_.whole(*value, key, out);
  }
  bool read_flag(const JsonValue& root, const std::string& path, const char* key, bool& out) {
    const JsonValue* value = read_.member(root, path, key);
    return value != nullptr && read_.boolean(*value, key, out);
  }
  /// Work units; null where there is no limit.
  bool read_limit(const JsonValue& root, const std::string& path, const char* key, std::uint64_t& out) {
    const JsonValue* value = read_.member(root, path, key);
    if (value == nullptr) return false;
    out = kUnlimitedWork;
    return value->kind == JsonValue::Kind::kNull || read_.whole(*value, key, out);
  }
  bool read_hash(const JsonValue& root, const std::string& path, std::uint64_t& out) {
    const JsonValue* value = read_.member(root, path, "hash");
    std::string text;
    if (value == nullptr || !read_.text(*value, "hash", text)) return false;
    if (text.size() != 16 || text.find_first_not_of("0123456789abcdef") != std::string::npos) {
      return read_.fail(*value, "hash", "must be 16 hexadecimal digits in lower case");
    }
    out = std::stoull(text, nullptr, 16);
    return true;
  }
  /// Which of the calls with these names a line is.
  template <class Names, class Kind>
  bool read_call_kind(const JsonValue& root, const std::string& path, const Names& names, Kind& out) {
    std::string name;
    if (root.kind != JsonValue::Kind::kObject) return read_.fail(root, path, "must be an object");
    if (!read_text(root, path, "call", name)) return false;
    if (find_name(names, name, out)) return true;
    std::string known;
    for (const char* one : names) known += (known.empty() ? "" : ", ") + std::string(one);
    return read_.fail(*root.find("call"), path, "\"" + name + "\" is unknown; known are: " + known);
  }
  /// How a call failed; nothing where it did not.
  bool read_error(const JsonValue& root, std::optional<ErrorCode>& out) {
    const JsonValue* value = root.find("error");
    std::string name;
    if (value == nullptr) return true;
    if (!read_.text(*value, "error", name)) return false;
    return find_name(kErrorNames, name, out.emplace()) || read_.fail(*value, "error", "\"" + name + "\" is unknown");
  }

  JsonReader read_;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
