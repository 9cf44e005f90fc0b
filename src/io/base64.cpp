// SPDX-License-Identifier: Apache-2.0
// Base64 after RFC 4648 §4, with white space allowed between characters.
#include "incise/io/base64.h"

#include <algorithm>
#include <cstring>

namespace incise {
inline namespace v0 {
namespace io {
namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kForeign = 64;

constexpr std::array<std::uint8_t, 256> make_table() {
  std::array<std::uint8_t, 256> table = {};
  for (auto& entry : table) entry = kForeign;
  for (std::size_t i = 0; i < kAlphabet.size(); ++i) {
    table[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::uint8_t>(i);
  }
  return table;
}

constexpr auto kValues = make_table();

bool is_space(char c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

}  // namespace

// Decodes one group of four characters.
bool ByteSource::refill() {
  std::uint32_t bits = 0;
  int characters = 0;
  int padding = 0;
  while (characters + padding < 4) {
    if (pos_ == text_.size()) return false;
    const char c = text_[pos_++];
    if (is_space(c)) continue;
    const std::uint8_t value = kValues[static_cast<unsigned char>(c)];
    if (c == '=' && characters >= 2) {
      ++padding;
      bits <<= 6U;
    } else if (value == kForeign || padding > 0) {
      return false;
    } else {
      ++characters;
      bits = (bits << 6U) | value;
    }
  }
  buffer_ = {static_cast<char>((bits >> 16U) & 255U), static_cast<char>((bits >> 8U) & 255U),
             static_cast<char>(bits & 255U)};
  filled_ = static_cast<std::size_t>(3 - padding);
  held_ = filled_;
  return true;
}

bool ByteSource::read(char* out, std::size_t n) {
  if (n > remaining()) return false;
  if (!base64_) {
    if (n > 0) std::memcpy(out, text_.data() + pos_, n);
    pos_ += n;
    return true;
  }
  while (n > 0) {
    if (held_ == 0 && !refill()) return false;
    const std::size_t take = std::min(n, held_);
    std::memcpy(out, buffer_.data() + (filled_ - held_), take);
    held_ -= take;
    out += take;
    n -= take;
  }
  return true;
}

bool ByteSource::is_at_end() const {
  const std::string_view rest = text_.substr(pos_);
  return held_ == 0 && std::all_of(rest.begin(), rest.end(), is_space);
}

void append_base64(std::string& out, std::string_view bytes) {
  const auto byte = [bytes](std::size_t i) {
    return i < bytes.size() ? std::uint32_t{static_cast<unsigned char>(bytes[i])} : 0U;
  };
  out.reserve(out.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t bits = (byte(i) << 16U) | (byte(i + 1) << 8U) | byte(i + 2);
    const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
    out += kAlphabet[bits >> 18U];
    out += kAlphabet[(bits >> 12U) & 63U];
    out += left > 1 ? kAlphabet[(bits >> 6U) & 63U] : '=';
    out += left > 2 ? kAlphabet[bits & 63U] : '=';
  }
}

}  // namespace io
}  // namespace v0
}  // namespace incise
