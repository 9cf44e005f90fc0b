// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace incise {
inline namespace v0 {
namespace io {

/// Reads bytes in order from raw or base64 text; streams that are padded and then go on are joined.
class ByteSource {
 public:
  /// `text` as the file has it; `base64`: encoded, else raw bytes.
  ByteSource(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  /// An upper bound of the bytes that are left.
  [[nodiscard]] std::size_t remaining() const {
    return base64_ ? (text_.size() - pos_) / 4 * 3 + 3 + held_ : text_.size() - pos_;
  }
  /// Read exactly `n` bytes; false where the text ends or holds foreign characters.
  [[nodiscard]] bool read(char* out, std::size_t n);
  /// Whether nothing is left but white space.
  [[nodiscard]] bool is_at_end() const;

 private:
  bool refill();

  std::string_view text_;
  bool base64_;
  std::size_t pos_ = 0;
  std::array<char, 3> buffer_ = {};
  std::size_t held_ = 0;  // bytes at the end of `buffer_` that are not yet read
  std::size_t filled_ = 0;
};

/// Append `bytes` as one padded base64 stream.
void append_base64(std::string& out, std::string_view bytes);

}  // namespace io
}  // namespace v0
}  // namespace incise
