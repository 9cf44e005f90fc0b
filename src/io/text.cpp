// SPDX-License-Identifier: Apache-2.0
// Numbers as digits and a power of ten: one rounding where both are exact, which is nearly always, and the library's
// slow way elsewhere.
#include "io/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace incise {
inline namespace v0 {
namespace io {
namespace {

constexpr std::array<double, 23> kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                                 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

constexpr std::uint64_t kExactMantissa = std::uint64_t{1} << 53U;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// A decimal number taken apart: ±mantissa·10^exponent, exact unless `long_mantissa`.
struct Decimal {
  std::uint64_t mantissa = 0;
  int exponent = 0;
  bool negative = false;
  bool long_mantissa = false;
  bool fortran = false;
};

// Reads digits into the mantissa; returns how many there were.
int scan_digits(std::string_view token, std::size_t& i, Decimal& d, int step) {
  int digits = 0;
  for (; i < token.size() && is_digit(token[i]); ++i, ++digits) {
    if (d.mantissa > 100'000'000'000'000'000ULL) {
      d.long_mantissa = true;
      continue;
    }
    d.mantissa = d.mantissa * 10 + static_cast<std::uint64_t>(token[i] - '0');
    d.exponent += step;
  }
  return digits;
}

bool scan_exponent(std::string_view token, std::size_t& i, Decimal& d) {
  if (i == token.size()) return true;
  const char mark = token[i++];
  if (mark != 'e' && mark != 'E' && mark != 'd' && mark != 'D') return false;
  d.fortran = mark == 'd' || mark == 'D';
  bool minus = false;
  if (i < token.size() && (token[i] == '+' || token[i] == '-')) minus = token[i++] == '-';
  if (i == token.size()) return false;
  int value = 0;
  for (; i < token.size(); ++i) {
    if (!is_digit(token[i])) return false;
    value = std::min(value * 10 + (token[i] - '0'), 100000);
  }
  d.exponent += minus ? -value : value;
  return true;
}

bool scan(std::string_view token, Decimal& d) {
  std::size_t i = 0;
  if (i < token.size() && (token[i] == '+' || token[i] == '-')) d.negative = token[i++] == '-';
  int digits = scan_digits(token, i, d, 0);
  if (i < token.size() && token[i] == '.') {
    ++i;
    digits += scan_digits(token, i, d, -1);
  }
  return digits > 0 && scan_exponent(token, i, d) && i == token.size();
}

// The slow, exact way; `token` is known to be a plain decimal number.
bool convert(std::string_view token, const Decimal& d, double& out) {
  std::string text(token[0] == '+' ? token.substr(1) : token);
  if (d.fortran) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
  }
#if defined(__cpp_lib_to_chars)
  const auto got = std::from_chars(text.data(), text.data() + text.size(), out);
  if (got.ec == std::errc()) return true;
  out = d.negative ? -0.0 : 0.0;
  return d.exponent < 0;  // out of range: too small is zero, too large is an error
#else
  out = std::strtod(text.c_str(), nullptr);  // the web's C library has one locale
  return std::isfinite(out);
#endif
}

}  // namespace

bool parse_double(std::string_view token, double& out) {
  Decimal d;
  if (!scan(token, d)) return false;
  if (d.long_mantissa || d.mantissa >= kExactMantissa || std::abs(d.exponent) > 22) return convert(token, d, out);
  // Both factors are exact, so that one rounding is left.
  const double mantissa = d.negative ? -static_cast<double>(d.mantissa) : static_cast<double>(d.mantissa);
  const double power = kPowersOfTen[static_cast<std::size_t>(std::abs(d.exponent))];
  out = d.exponent < 0 ? mantissa / power : mantissa * power;
  return true;
}

bool parse_int(std::string_view token, std::int64_t& out) {
  if (!token.empty() && token[0] == '+') token.remove_prefix(1);
  const auto got = std::from_chars(token.data(), token.data() + token.size(), out);
  return got.ec == std::errc() && got.ptr == token.data() + token.size();
}

void append_double(std::string& out, double value) {
  std::array<char, 40> buffer;
#if defined(__cpp_lib_to_chars)
  const auto got = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  out.append(buffer.data(), got.ptr);
#else
  out.append(buffer.data(), static_cast<std::size_t>(std::snprintf(buffer.data(), buffer.size(), "%.17g", value)));
#endif
}

void append_int(std::string& out, std::int64_t value) {
  std::array<char, 24> buffer;
  const auto got = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  out.append(buffer.data(), got.ptr);
}

namespace {
char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
}  // namespace

std::string size_text(std::uint64_t bytes) {
  if (bytes < (1U << 20U)) return std::to_string(bytes) + " bytes";
  return bytes < (1U << 30U) ? std::to_string(bytes >> 20U) + " MiB" : std::to_string(bytes >> 30U) + " GiB";
}

bool same_word(std::string_view a, std::string_view b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string to_lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), lower);
  return out;
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

bool ends_lines_by_return(std::string_view bytes) {
  const auto has = [&](char c) { return bytes.find(c) != std::string_view::npos; };
  return has('\r') && !has('\n') && !has('\0');
}

std::string with_line_feeds(std::string_view bytes) {
  std::string text(bytes);
  std::replace(text.begin(), text.end(), '\r', '\n');
  return text;
}

std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (text.size() > 40 ? "...'" : "'");
}

bool Cursor::is_separator(char c) const {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f' || (comma_ && c == ',');
}

bool Cursor::at_line_end() {
  while (pos_ < bytes_.size() && bytes_[pos_] != '\n' && is_separator(bytes_[pos_])) ++pos_;
  if (comment_ != '\0' && pos_ < bytes_.size() && bytes_[pos_] == comment_) {
    pos_ = std::min(bytes_.find('\n', pos_), bytes_.size());
  }
  return pos_ == bytes_.size() || bytes_[pos_] == '\n';
}

bool Cursor::skip_space() {
  while (at_line_end()) {
    if (pos_ == bytes_.size()) return false;
    ++pos_;
  }
  return true;
}

std::string_view Cursor::word_in_line() {
  if (at_line_end()) return {};
  const std::size_t first = pos_;
  while (pos_ < bytes_.size() && !is_separator(bytes_[pos_])) ++pos_;
  return bytes_.substr(first, pos_ - first);
}

std::string_view Cursor::word() {
  skip_space();
  return word_in_line();
}

std::string_view Cursor::peek() {
  skip_space();
  const std::size_t first = pos_;
  const std::string_view next = word_in_line();
  pos_ = first;
  return next;
}

std::string_view Cursor::line() {
  const std::size_t first = pos_;
  const std::size_t end = std::min(bytes_.find('\n', pos_), bytes_.size());
  pos_ = std::min(end + 1, bytes_.size());
  return bytes_.substr(first, end - first);
}

bool Cursor::read_real(std::string_view token, double& out, const char* what) {
  if (parse_double(token, out)) return true;
  if (token.empty()) return fail(std::string(what) + " missing: the file or the row ends too early");
  return fail(std::string(what) + " must be a finite number, not " + in_quotes(token));
}

bool Cursor::read_integer(std::string_view token, std::int64_t& out, const char* what) {
  if (parse_int(token, out)) return true;
  if (token.empty()) return fail(std::string(what) + " missing: the file or the row ends too early");
  return fail(std::string(what) + " must be an integer, not " + in_quotes(token));
}

bool Cursor::real(double& out, const char* what) {
  return read_real(word(), out, what);
}
bool Cursor::integer(std::int64_t& out, const char* what) {
  return read_integer(word(), out, what);
}
bool Cursor::real_in_line(double& out, const char* what) {
  return read_real(word_in_line(), out, what);
}
bool Cursor::integer_in_line(std::int64_t& out, const char* what) {
  return read_integer(word_in_line(), out, what);
}

bool Cursor::end_line(const char* what) {
  if (at_line_end()) return true;
  return fail(std::string(what) + " has more fields than it should: " + in_quotes(peek()));
}

bool Cursor::count(std::int64_t& out, std::size_t fields, const char* what) {
  if (!integer(out, what)) return false;
  if (out < 0) return fail(std::string(what) + " is negative");
  const std::size_t most = (remaining() + 1) / (2 * fields);  // a digit and a separator each
  if (static_cast<std::uint64_t>(out) <= most) return true;
  return fail(std::string(what) + " is " + std::to_string(out) + ", more than the rest of the file can hold");
}

bool Cursor::fail(const std::string& what) {
  return fail_at(pos_, what);
}

bool Cursor::fail_at(std::size_t pos, const std::string& what) {
  if (!error_.message.empty()) return false;
  std::string place;
  if (binary_) {
    place = ": at byte " + std::to_string(pos);
  } else {
    const auto upto = bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(pos, bytes_.size()));
    place = ":" + std::to_string(std::count(bytes_.begin(), upto, '\n') + 1);
  }
  error_.code = ErrorCode::kBadFile;
  error_.message = name_ + place + ": " + what;
  return false;
}

}  // namespace io
}  // namespace v0
}  // namespace incise
