// SPDX-License-Identifier: Apache-2.0
// Reads byte by byte from the stream's buffer, so that a line without an end is noticed before it fills the memory.
#include "app/text/line_source.h"

#include <fstream>
#include <system_error>

#include "app/text/line_reader.h"
#include "app/text/text_file.h"

namespace incise {
inline namespace v0 {
namespace app {

namespace {

/// A header holds a scene at most, a line the positions of all vertices.
constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 27U, kMaxLineBytes = std::size_t{1} << 30U;

Error bad_file(const std::string& file_name, const std::string& what) {
  return {ErrorCode::kBadFile, file_name + what, {}};
}

}  // namespace

Result<LineSource> LineSource::open(const std::filesystem::path& path) {
  if (const Status status = check_readable(path); !status.ok()) return status.error();
  std::error_code code;
  if (std::filesystem::is_character_file(path, code) || std::filesystem::is_block_file(path, code)) {
    return bad_file(path.string(), ": is a device, which may have no end; give a file, or a pipe");
  }
  return LineSource(std::make_unique<std::ifstream>(path, std::ios::binary), path.string());
}

Result<std::string> LineSource::header() {
  if (header_) return *header_;
  std::string line;
  if (const Result<bool> got = read(line, kMaxHeaderBytes); !got.ok()) return got.error();
  if (has_line_end_ || line.empty() || line.front() != '{' || is_whole_json(line)) return *(header_ = std::move(line));
  return bad_line("the header is cut off, so nothing can be replayed; record again");
}

Error LineSource::bad_line(const std::string& what) const {
  return bad_file(file_name_, ":" + std::to_string(number_) + ": " + what);
}

Result<bool> LineSource::next(std::string& line) {
  const Result<bool> got = read(line, kMaxLineBytes);
  if (!got.ok()) return got;
  is_cut_off_ = *got && !has_line_end_ && !is_whole_json(line);
  return *got && !is_cut_off_;
}

/// Reads up to the next newline or the end; false where nothing is left.
Result<bool> LineSource::read(std::string& line, std::size_t most) {
  using Traits = std::istream::traits_type;
  std::streambuf& bytes = *text_->rdbuf();
  ++number_;
  has_line_end_ = false;
  line.clear();
  for (auto byte = bytes.sbumpc(); !Traits::eq_int_type(byte, Traits::eof()); byte = bytes.sbumpc()) {
    ++bytes_;
    if (byte == '\n') {
      has_line_end_ = true;
      return true;
    }
    if (byte == 0) return bad_line("a zero byte, which no text has; is this a recording?");
    if (line.size() == most) {
      return bad_line("the line is longer than " + std::to_string(most >> 20U) + " MiB; is this a recording?");
    }
    line += Traits::to_char_type(byte);
  }
  return !line.empty();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
