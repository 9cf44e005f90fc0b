// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "incise/core/result.h"
#include "incise/io/numbers.h"

namespace incise {
inline namespace v0 {
namespace io {

/// Append the shortest decimal number (at most 17 digits) that reads back to the same bits.
void append_double(std::string& out, double value);

void append_int(std::string& out, std::int64_t value);

/// "100 bytes", "64 MiB" or "4 GiB": whole ones, rounded down.
[[nodiscard]] std::string size_text(std::uint64_t bytes);

/// Equal but for ASCII case.
[[nodiscard]] bool same_word(std::string_view a, std::string_view b);

[[nodiscard]] std::string to_lower(std::string_view text);

/// Trim spaces, tabs and carriage returns.
[[nodiscard]] std::string_view trim(std::string_view text);

/// Whether this is text whose lines end in carriage returns alone, as old programs of the Macintosh write them.
[[nodiscard]] bool ends_lines_by_return(std::string_view bytes);

/// The same text with a line feed in the place of each carriage return.
[[nodiscard]] std::string with_line_feeds(std::string_view bytes);

/// `text` in quotes, cut to 40 characters, with unprintable ones as '?'.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Reads tokens from text, and records the first error with its line.
class Cursor {
 public:
  Cursor(std::string_view bytes, const std::string& name, Error& error) : bytes_(bytes), name_(name), error_(error) {}

  /// Words end at commas too.
  void split_at_commas() { comma_ = true; }
  /// A word that begins with this character hides the rest of its line.
  void set_comment(char c) { comment_ = c; }

  /// The bytes are no text: errors name a byte offset instead of a line.
  void set_binary() { binary_ = true; }

  [[nodiscard]] std::size_t position() const { return pos_; }
  void seek(std::size_t pos) { pos_ = pos; }
  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - pos_; }
  [[nodiscard]] std::string_view bytes() const { return bytes_; }

  /// Skip white space, line ends and comments; false at the end.
  bool skip_space();
  /// Skip white space and a comment within the line; true at a line end or the end.
  bool at_line_end();
  /// The next word of this line or of a later one; empty at the end.
  std::string_view word();
  /// The next word of this line; empty at its end.
  std::string_view word_in_line();
  /// The rest of the line without its end; moves to the next line.
  std::string_view line();
  /// The word that would come next; empty at the end.
  std::string_view peek();

  // Each of these fails with a message that says `what` was expected.
  bool real(double& out, const char* what);
  bool integer(std::int64_t& out, const char* what);
  bool real_in_line(double& out, const char* what);
  bool integer_in_line(std::int64_t& out, const char* what);
  /// Fails unless the line, or the file, ends here.
  bool end_line(const char* what);
  /// A count of rows that the remaining bytes can hold: at least `fields` numbers each.
  bool count(std::int64_t& out, std::size_t fields, const char* what);

  /// Record an error at the current place, unless there is one already. Always false.
  bool fail(const std::string& what);
  bool fail_at(std::size_t pos, const std::string& what);

 private:
  [[nodiscard]] bool is_separator(char c) const;
  bool read_real(std::string_view token, double& out, const char* what);
  bool read_integer(std::string_view token, std::int64_t& out, const char* what);

  std::string_view bytes_;
  const std::string& name_;
  Error& error_;
  std::size_t pos_ = 0;
  char comment_ = '\0';
  bool comma_ = false;
  bool binary_ = false;
};

}  // namespace io
}  // namespace v0
}  // namespace incise
