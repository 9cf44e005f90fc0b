// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace app {

/// The lines of a recording, which may be longer than memory, one after the other. Its last line may be cut off.
class LineSource {
 public:
  /// `file_name` stands for FILE in messages.
  LineSource(std::unique_ptr<std::istream> text, std::string file_name)
      : text_(std::move(text)), file_name_(std::move(file_name)) {}
  /// Errors: kBadFile, naming the file; devices are refused, pipes are not.
  static Result<LineSource> open(const std::filesystem::path& path);

  /// The first line, however often it is asked for. Errors: kBadFile where it is cut off, above 128 MiB, or has a zero
  /// byte, which no text has.
  Result<std::string> header();
  /// Reads the next line; false at the end, or where the line is cut off. Errors: kBadFile for a line above 1 GiB, or
  /// with a zero byte.
  Result<bool> next(std::string& line);
  [[nodiscard]] const std::string& file_name() const { return file_name_; }
  [[nodiscard]] std::uint32_t number() const { return number_; }  ///< of the line read last, from 1
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }    ///< that were read so far
  /// Whether the end, once it was reached, was within a line.
  [[nodiscard]] bool is_cut_off() const { return is_cut_off_; }

 private:
  Result<bool> read(std::string& line, std::size_t most);
  [[nodiscard]] Error bad_line(const std::string& what) const;

  std::unique_ptr<std::istream> text_;
  std::string file_name_;
  std::optional<std::string> header_;
  std::uint32_t number_ = 0;
  std::uint64_t bytes_ = 0;
  bool has_line_end_ = true;
  bool is_cut_off_ = false;
};

}  // namespace app
}  // namespace v0
}  // namespace incise
