// SPDX-License-Identifier: Apache-2.0
// The parser hands over events one by one; characters are counted on their way to it, which tells the line of each
// value. Bounds on depth and size are checked as the tree grows.
#include "app/text/json_tree.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/text/formatted.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

using Kind = JsonValue::Kind;

// Hands characters to the parser and counts the lines that it has taken.
class LineCounter {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  LineCounter(const char* at, std::uint32_t* line) : at_(at), line_(line) {}
  reference operator*() const { return *at_; }
  LineCounter& operator++() {
    if (*at_ == '\n') ++*line_;
    ++at_;
    return *this;
  }
  LineCounter operator++(int) {
    LineCounter old = *this;
    ++*this;
    return old;
  }
  friend bool operator!=(const LineCounter& a, const LineCounter& b) { return a.at_ != b.at_; }

 private:
  const char* at_;
  std::uint32_t* line_;
};

class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(const std::uint32_t& line, const JsonLimits& limits) : line_(line), limits_(limits) {}

  bool null() override { return add(Kind::kNull, 0); }
  bool boolean(bool value) override { return add(Kind::kBool, value ? 1 : 0); }
  bool number_integer(number_integer_t value) override { return add(Kind::kNumber, static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override {
    if (!add(Kind::kNumber, static_cast<double>(value))) return false;
    last_->is_whole = true;
    last_->whole = value;
    return true;
  }
  bool number_float(number_float_t value, const string_t&) override { return add(Kind::kNumber, value); }
  bool string(string_t& value) override {
    if (!add(Kind::kString, 0)) return false;
    last_->text = std::move(value);
    return true;
  }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Kind::kObject); }
  bool start_array(std::size_t) override { return open(Kind::kArray); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    auto& keys = open_.back()->keys;
    if (std::find(keys.begin(), keys.end(), name) != keys.end()) return refuse("the key \"" + name + "\" occurs twice");
    if (keys.size() >= kMaxKeys) return refuse("an object has more than " + std::to_string(kMaxKeys) + " keys");
    keys.push_back(std::move(name));
    return true;
  }
  bool parse_error(std::size_t, const std::string& last_token, const nlohmann::detail::exception& error) override {
    const std::string what = error.what();
    const std::size_t reason = what.find("syntax error");
    if (reason != std::string::npos) return refuse("not valid JSON: " + what.substr(reason));
    return refuse("not valid JSON near \"" + last_token + "\"");
  }

  [[nodiscard]] const std::string& problem() const { return problem_; }
  JsonValue take() { return std::move(root_); }

 private:
  static constexpr std::size_t kMaxKeys = 64;

  bool refuse(std::string what) {
    if (problem_.empty()) problem_ = std::move(what);
    return false;
  }
  bool add(Kind kind, double number) {
    if (++values_ > limits_.max_values) return refuse("more than " + std::to_string(limits_.max_values) + " values");
    last_ = &root_;
    if (!open_.empty()) last_ = &open_.back()->items.emplace_back();
    last_->kind = kind;
    last_->line = line_;
    last_->number = number;
    return true;
  }
  bool open(Kind kind) {
    if (open_.size() >= limits_.max_depth) return refuse("nested deeper than " + std::to_string(limits_.max_depth));
    if (!add(kind, 0)) return false;
    open_.push_back(last_);
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  const std::uint32_t& line_;
  const JsonLimits& limits_;
  JsonValue root_;
  JsonValue* last_ = nullptr;
  std::vector<JsonValue*> open_;  // items of a container move only while none of them is open
  std::size_t values_ = 0;
  std::string problem_;
};

Error bad_file(std::string_view file_name, std::uint32_t line, const std::string& what) {
  return {ErrorCode::kBadFile, std::string(file_name) + ":" + std::to_string(line) + ": " + what, {}};
}

std::string shown(const JsonValue& value) {
  switch (value.kind) {
    case Kind::kNull:
      return "null";
    case Kind::kBool:
      return value.number != 0 ? "true" : "false";
    case Kind::kNumber:
      return "a number";
    case Kind::kString:
      return "a string";
    case Kind::kArray:
      return "an array";
    case Kind::kObject:
      return "an object";
  }
  return "something else";
}

}  // namespace

const JsonValue* JsonValue::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] == key) return &items[i];
  }
  return nullptr;
}

Result<JsonValue> parse_json(std::string_view text, std::string_view file_name, const JsonLimits& limits,
                             std::uint32_t first_line) {
  std::uint32_t line = first_line;
  if (text.size() > limits.max_bytes) {
    return bad_file(file_name, line, "larger than " + std::to_string(limits.max_bytes >> 20U) + " MiB");
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return bad_file(file_name, line, first_line == 1 ? "the file is empty" : "the line is empty");
  }
  if (text.substr(0, 2) == "\x1f\x8b") return bad_file(file_name, line, "the file is gzipped; gunzip it first");
  TreeBuilder builder(line, limits);
  const LineCounter begin(text.data(), &line);
  const LineCounter end(text.data() + text.size(), &line);
  if (!nlohmann::json::sax_parse(begin, end, &builder)) return bad_file(file_name, line, builder.problem());
  return builder.take();
}

bool JsonReader::fail(const JsonValue& value, const std::string& path, const std::string& what) {
  if (failed_) return false;
  std::string where = place_ + (place_.empty() || path.empty() || path[0] == '[' ? "" : ".") + path;
  if (where.empty()) where = "the document";
  error_ = bad_file(file_name_, value.line, where + " " + what);
  failed_ = true;
  return false;
}

bool JsonReader::is_object(const JsonValue& value, const std::string& path,
                           const std::vector<std::string_view>& known_keys) {
  if (value.kind != Kind::kObject) return fail(value, path, "must be an object, not " + shown(value));
  for (std::size_t i = 0; i < value.keys.size(); ++i) {
    if (std::find(known_keys.begin(), known_keys.end(), value.keys[i]) != known_keys.end()) continue;
    std::string known;
    for (const std::string_view key : known_keys) known += (known.empty() ? "" : ", ") + std::string(key);
    return fail(value.items[i], path, "has the unknown key \"" + value.keys[i] + "\"; known here: " + known);
  }
  return true;
}

const JsonValue* JsonReader::member(const JsonValue& object, const std::string& path, std::string_view key) {
  const JsonValue* found = object.find(key);
  if (found == nullptr) fail(object, path, "lacks the key \"" + std::string(key) + "\"");
  return found;
}

bool JsonReader::is_format(const JsonValue& root, std::string_view format, std::uint32_t version) {
  if (root.kind != Kind::kObject) return fail(root, "", "must be an object, not " + shown(root));
  const JsonValue* name = member(root, "", "format");
  const JsonValue* number = name ? member(root, "", "version") : nullptr;
  if (number == nullptr) return false;
  if (name->kind != Kind::kString || name->text != format) {
    return fail(*name, "format", "must be \"" + std::string(format) + "\"");
  }
  double found = 0;
  if (!this->number(*number, "version", found)) return false;
  if (found == version) return true;
  return fail(*number, "version",
              "is " + short_number(found) + "; this program reads version " + std::to_string(version));
}

bool JsonReader::is_array(const JsonValue& value, const std::string& path, std::size_t min_items,
                          std::size_t max_items) {
  if (value.kind != Kind::kArray) return fail(value, path, "must be an array, not " + shown(value));
  const std::size_t count = value.items.size();
  if (count >= min_items && count <= max_items) return true;
  const bool is_few = count < min_items;
  return fail(value, path,
              "has " + std::to_string(count) + " entries; it needs " + (is_few ? "at least " : "at most ") +
                  std::to_string(is_few ? min_items : max_items));
}

bool JsonReader::number(const JsonValue& value, const std::string& path, double& out) {
  if (value.kind != Kind::kNumber) return fail(value, path, "must be a finite number, not " + shown(value));
  if (!std::isfinite(value.number)) return fail(value, path, "is not finite");
  out = value.number;
  return true;
}

bool JsonReader::numbers(const JsonValue& value, const std::string& path, double* out, std::size_t count) {
  if (value.kind != Kind::kArray || value.items.size() != count) {
    return fail(value, path, "must be an array of " + std::to_string(count) + " numbers");
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!number(value.items[i], at(path, i), out[i])) return false;
  }
  return true;
}

bool JsonReader::points(const JsonValue& value, const std::string& path, std::size_t max_points,
                        std::vector<Vec3>& out) {
  if (!is_array(value, path, 2, max_points)) return false;
  out.resize(value.items.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!numbers(value.items[i], at(path, i), out[i].data(), 3)) return false;
  }
  return true;
}

bool JsonReader::whole(const JsonValue& value, const std::string& path, std::uint64_t& out) {
  if (!value.is_whole) return fail(value, path, "must be a whole number from 0 to 2^64 - 1");
  out = value.whole;
  return true;
}

bool JsonReader::boolean(const JsonValue& value, const std::string& path, bool& out) {
  if (value.kind != Kind::kBool) return fail(value, path, "must be true or false, not " + shown(value));
  out = value.number != 0;
  return true;
}

bool JsonReader::text(const JsonValue& value, const std::string& path, std::string& out) {
  if (value.kind != Kind::kString) return fail(value, path, "must be a string, not " + shown(value));
  out = value.text;
  // As a file's name it would end there for the system, and go on for whoever compares it.
  return out.find('\0') == std::string::npos || fail(value, path, "must not have a null character in it");
}

std::string at(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

std::string short_number(double x) {
  constexpr double kSmall = 1e-5, kLarge = 1e15;  // beyond these all digits would say less
  if (x != 0 && !(std::abs(x) >= kSmall && std::abs(x) < kLarge)) return formatted("{:.6g}", x);
  std::string text = std::to_string(x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
