// SPDX-License-Identifier: Apache-2.0
// Reads byte by byte from the stream's buffer, so that a line without an end is noticed before it fills the memory.
#include "app/text/line_source.h"

#include <fstream>

#include "app/text/line_reader.h"
#include "app/text/text_file.h"

namespace incise {
inline namespace v0 {
namespace app {

namespace {

constexpr std::size_t kMaxLineBytes = std::size_t{1} << 30U;

}  // namespace

Result<LineSource> LineSource::open(const std::filesystem::path& path) {
  if (const Status status = check_readable(path); !status.ok()) return status.error();
  return LineSource(std::make_unique<std::ifstream>(path, std::ios::binary), path.string());
}

Result<std::string> LineSource::header() {
  std::string line;
  if (const Result<bool> got = read(line); !got.ok()) return got.error();
  if (has_line_end_ || line.empty() || line.front() != '{' || is_whole_json(line)) return line;
  return Error{
      ErrorCode::kBadFile, file_name_ + ":1: the header is cut off, so nothing can be replayed; record again", {}};
}

Result<bool> LineSource::next(std::string& line) {
  const Result<bool> got = read(line);
  if (!got.ok()) return got;
  is_cut_off_ = *got && !has_line_end_ && !is_whole_json(line);
  return *got && !is_cut_off_;
}

/// Reads up to the next newline or the end; false where nothing is left.
Result<bool> LineSource::read(std::string& line) {
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
    if (line.size() == kMaxLineBytes) {
      return Error{ErrorCode::kBadFile,
                   file_name_ + ":" + std::to_string(number_) + ": the line is longer than 1 GiB; is this a recording?",
                   {}};
    }
    line += Traits::to_char_type(byte);
  }
  return !line.empty();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
